/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sph/neighbours.h"
#include "base/memory.h"
#include "sph/state.h"

#include <math.h>
#include <string.h>

/* More cells than this for each particle are made larger: few particles that fly far away shall not cost memory. */
enum { CELLS_PER_PARTICLE = 16, FEWEST_CELLS = 4096 };

struct neighbours *neighbours_open(struct store *store, int dimension, double reach, double wide_reach, double skin)
{
    struct neighbours *neighbours = memory_array(1, sizeof *neighbours, "neighbours");
    neighbours->store = store;
    neighbours->dimension = dimension;
    neighbours->skin = skin;
    neighbours->near.reach = reach;
    neighbours->wide.reach = wide_reach;
    neighbours->near.first = memory_array(store->count + 1, sizeof(int64_t), "neighbours");
    if (wide_reach > 0)
        neighbours->wide.first = memory_array(store->count + 1, sizeof(int64_t), "neighbours");
    neighbours->cell_of = memory_array(store->count, sizeof(int32_t), "cells");
    neighbours->order = memory_array(store->count, sizeof(int32_t), "cells");
    return neighbours;
}

void neighbours_repeat(struct neighbours *neighbours, double low, double period)
{
    neighbours->period_low = low;
    neighbours->period = period;
}

void neighbours_close(struct neighbours *neighbours)
{
    if (!neighbours)
        return;
    memory_free(neighbours->near.first);
    memory_free(neighbours->near.list);
    memory_free(neighbours->wide.first);
    memory_free(neighbours->wide.list);
    memory_free(neighbours->cell_first);
    memory_free(neighbours->cell_of);
    memory_free(neighbours->order);
    memory_free(neighbours);
}

size_t neighbours_bytes(const struct neighbours *neighbours)
{
    const size_t count = neighbours->store->count;
    return (neighbours->near.list_capacity + neighbours->wide.list_capacity) * sizeof(int32_t)
         + (count + 1) * sizeof(int64_t) * (neighbours->wide.reach > 0 ? 2 : 1) + 2 * count * sizeof(int32_t)
         + neighbours->cells_capacity * sizeof(int32_t);
}

/* --- cells --- */

static bool is_removed(const struct store *store, size_t p)
{
    return store->integer[COLUMN_STATE][p] == SPH_REMOVED;
}

/* The grid of cells over the box of all particles, where they were listed. */
static void lay_grid(struct neighbours *neighbours)
{
    const struct store *store = neighbours->store;
    double size = fmax(neighbours->near.reach, neighbours->wide.reach) + neighbours->skin, span[3] = {0, 0, 0};
    for (int a = 0; a < neighbours->dimension; a++) {
        const double *x = store->real[COLUMN_LISTED_POSITION][a];
        double low = INFINITY, high = -INFINITY;
        for (size_t p = 0; p < store->count; p++) {
            if (is_removed(store, p))
                continue;
            low = x[p] < low ? x[p] : low;
            high = x[p] > high ? x[p] : high;
        }
        neighbours->low[a] = low;
        span[a] = isfinite(high - low) ? high - low : 0;
    }
    if (neighbours->period > 0) {
        neighbours->low[0] = neighbours->period_low;
        span[0] = neighbours->period;
    }
    const double most = (double)CELLS_PER_PARTICLE * (double)store->count + FEWEST_CELLS;
    for (;; size *= 2) {
        double cells = 1;
        for (int a = 0; a < 3; a++)
            cells *= floor(span[a] / size) + 1;
        if (cells <= most)
            break;
    }
    for (int a = 0; a < 3; a++) {
        neighbours->cells[a] = (int)floor(span[a] / size) + 1;
        neighbours->cell_size[a] = size;
    }
    if (neighbours->period > 0) { /* whole cells in a period */
        neighbours->cells[0] = (int)fmax(1, floor(span[0] / size));
        neighbours->cell_size[0] = span[0] / neighbours->cells[0];
    }
}

static int cell_along(const struct neighbours *neighbours, int a, double x)
{
    const double cell = floor((x - neighbours->low[a]) / neighbours->cell_size[a]);
    if (!(cell > 0))
        return 0;
    return cell < neighbours->cells[a] ? (int)cell : neighbours->cells[a] - 1;
}

static int32_t cell_at(const struct neighbours *neighbours, const int at[3])
{
    return (int32_t)(((int64_t)at[2] * neighbours->cells[1] + at[1]) * neighbours->cells[0] + at[0]);
}

static int32_t cell_count(const struct neighbours *neighbours)
{
    return (int32_t)((int64_t)neighbours->cells[0] * neighbours->cells[1] * neighbours->cells[2]);
}

static void find_cell(const struct neighbours *neighbours, size_t p, int at[3])
{
    double *const *x = neighbours->store->real[COLUMN_LISTED_POSITION];
    for (int a = 0; a < 3; a++)
        at[a] = a < neighbours->dimension ? cell_along(neighbours, a, x[a][p]) : 0;
}

/* Counting sort: order has the particles cell by cell; removed ones come last. */
static void sort_into_cells(struct neighbours *neighbours)
{
    const struct store *store = neighbours->store;
    const int32_t cells = cell_count(neighbours);
    neighbours->cell_first = memory_grow(neighbours->cell_first, &neighbours->cells_capacity, (size_t)cells + 2,
                                         sizeof(int32_t), "cells");
    int32_t *first = neighbours->cell_first;
    memset(first, 0, ((size_t)cells + 2) * sizeof *first);
#pragma omp parallel for schedule(static) if (neighbours->is_shared)
    for (size_t p = 0; p < store->count; p++) {
        int at[3];
        find_cell(neighbours, p, at);
        neighbours->cell_of[p] = is_removed(store, p) ? cells : cell_at(neighbours, at);
    }
    for (size_t p = 0; p < store->count; p++)
        first[neighbours->cell_of[p] + 1]++;
    for (int32_t c = 0; c <= cells; c++)
        first[c + 1] += first[c];
    for (size_t p = store->count; p-- > 0;) /* from the end, so that first[c + 1] counts down to the start of c */
        neighbours->order[--first[neighbours->cell_of[p] + 1]] = (int32_t)p;
    memmove(first, first + 1, ((size_t)cells + 1) * sizeof *first);
    first[cells + 1] = (int32_t)store->count;
}

/* --- lists --- */

/* A search: whose neighbours, within what distance, and where they are listed (NULL: only counted). */
struct search {
    const struct neighbours *neighbours;
    size_t p;
    double x[3], reach2;
    int32_t *list;
    int32_t count;
};

/* Looks at the particles of cells from ... to of one row, which lie one behind the other, as seen from `shift` along x. */
static void search_row(struct search *search, int from, int to, int j, int k, double shift)
{
    const struct neighbours *neighbours = search->neighbours;
    double *const *x = neighbours->store->real[COLUMN_LISTED_POSITION];
    const bool is_flat = neighbours->dimension == 2;
    const int32_t first = neighbours->cell_first[cell_at(neighbours, (int[]){from, j, k})];
    const int32_t end = neighbours->cell_first[cell_at(neighbours, (int[]){to, j, k}) + 1];
    for (int32_t n = first; n < end; n++) {
        const int32_t q = neighbours->order[n];
        const double d0 = x[0][q] + shift - search->x[0], d1 = x[1][q] - search->x[1], d2 = is_flat ? 0 : x[2][q] - search->x[2];
        if (!(d0 * d0 + d1 * d1 + d2 * d2 < search->reach2) || (size_t)q == search->p)
            continue;
        if (search->list)
            search->list[search->count] = q;
        search->count++;
    }
}

/* Lists the neighbours of p, or only counts them where `list` is NULL; returns how many there are. */
static int32_t list_one(const struct neighbours *neighbours, size_t p, double reach2, int32_t *list)
{
    double *const *x = neighbours->store->real[COLUMN_LISTED_POSITION];
    struct search search = {neighbours, p, {x[0][p], x[1][p], x[2][p]}, reach2, list, 0};
    const int last = neighbours->cells[0] - 1;
    int at[3], low[3], high[3];
    find_cell(neighbours, p, at);
    for (int a = 0; a < 3; a++) {
        low[a] = at[a] > 0 ? at[a] - 1 : 0;
        high[a] = at[a] + 1 < neighbours->cells[a] ? at[a] + 1 : neighbours->cells[a] - 1;
    }
    for (int k = low[2]; k <= high[2]; k++)
        for (int j = low[1]; j <= high[1]; j++) {
            if (neighbours->period > 0 && at[0] == 0)
                search_row(&search, last, last, j, k, -neighbours->period);
            search_row(&search, low[0], high[0], j, k, 0);
            if (neighbours->period > 0 && at[0] == last)
                search_row(&search, 0, 0, j, k, neighbours->period);
        }
    return search.count;
}

static void make_lists(struct neighbours *neighbours, struct neighbour_lists *lists)
{
    const struct store *store = neighbours->store;
    const double reach = lists->reach + neighbours->skin, reach2 = reach * reach;
    if (lists->reach <= 0)
        return;
    lists->first[0] = 0;
#pragma omp parallel for schedule(dynamic, 256) if (neighbours->is_shared)
    for (size_t p = 0; p < store->count; p++)
        lists->first[p + 1] = is_removed(store, p) ? 0 : list_one(neighbours, p, reach2, NULL);
    for (size_t p = 0; p < store->count; p++)
        lists->first[p + 1] += lists->first[p];
    lists->list = memory_grow(lists->list, &lists->list_capacity, (size_t)lists->first[store->count], sizeof(int32_t),
                              "neighbours");
#pragma omp parallel for schedule(dynamic, 256) if (neighbours->is_shared)
    for (size_t p = 0; p < store->count; p++)
        if (lists->first[p + 1] > lists->first[p])
            list_one(neighbours, p, reach2, lists->list + lists->first[p]);
}

static void build(struct neighbours *neighbours, bool sorts)
{
    struct store *store = neighbours->store;
    lay_grid(neighbours);
    sort_into_cells(neighbours);
    if (sorts) {
        store_reorder(store, neighbours->order, store->count);
        for (size_t p = 0; p < store->count; p++)
            neighbours->order[p] = (int32_t)p;
    }
    make_lists(neighbours, &neighbours->near);
    make_lists(neighbours, &neighbours->wide);
    neighbours->builds++;
}

/* The square of the way of the particle that has moved farthest since lists were made. */
static double farthest_way(const struct neighbours *neighbours)
{
    const struct store *store = neighbours->store;
    double *const *x = store->real[COLUMN_POSITION], *const *y = store->real[COLUMN_LISTED_POSITION];
    double most = 0;
#pragma omp parallel for schedule(static) reduction(max : most) if (neighbours->is_shared)
    for (size_t p = 0; p < store->count; p++) {
        const double d0 = x[0][p] - y[0][p], d1 = x[1][p] - y[1][p], d2 = x[2][p] - y[2][p];
        const double way = d0 * d0 + d1 * d1 + d2 * d2;
        if (!is_removed(store, p) && way > most)
            most = way;
    }
    return most;
}

/* Into the period; particles that are no numbers stay. */
static void bring_back(struct neighbours *neighbours)
{
    double *x = neighbours->store->real[COLUMN_POSITION][0];
    for (size_t p = 0; p < neighbours->store->count; p++) {
        const double periods = floor((x[p] - neighbours->period_low) / neighbours->period);
        if (periods != 0 && isfinite(periods))
            x[p] -= periods * neighbours->period;
    }
}

bool neighbours_follow(struct neighbours *neighbours)
{
    struct store *store = neighbours->store;
    if (neighbours->builds > 0 && 4 * farthest_way(neighbours) <= neighbours->skin * neighbours->skin)
        return false;
    if (neighbours->period > 0)
        bring_back(neighbours);
    for (int a = 0; a < 3; a++)
        memcpy(store->real[COLUMN_LISTED_POSITION][a], store->real[COLUMN_POSITION][a], store->count * sizeof(double));
    build(neighbours, true);
    return true;
}

void neighbours_restore(struct neighbours *neighbours)
{
    build(neighbours, false);
}
