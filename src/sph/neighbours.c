/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sph/neighbours.h"
#include "base/memory.h"
#include "base/threads.h"
#include "particles/state.h"

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
    for (int a = 0; a < 3; a++)
        neighbours->sorted[a] = memory_array(store->count, sizeof(double), "cells");
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
    for (int a = 0; a < 3; a++)
        memory_free(neighbours->sorted[a]);
    memory_free(neighbours);
}

size_t neighbours_bytes(const struct neighbours *neighbours)
{
    const size_t count = neighbours->store->count;
    return (neighbours->near.list_capacity + neighbours->wide.list_capacity) * sizeof(int32_t)
         + (count + 1) * sizeof(int64_t) * (neighbours->wide.reach > 0 ? 2 : 1) + count * (2 * sizeof(int32_t) + 3 * sizeof(double))
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

/* Squares of distances are found for so many particles at once. */
enum { BLOCK = 64 };

/* A search for the neighbours of one particle, near ones and, where there are such lists, all in reach of the wide ones. */
struct search {
    const struct neighbours *neighbours;
    int32_t self;                /* its place in the order of cells */
    double x[3], near2, far2;
    int32_t *near, *wide;        /* where they are listed; near NULL: they are only counted */
    int32_t near_count, wide_count;
};

THREADS_INLINE void find_squares(const struct search *search, int32_t start, int count, double shift, double *square)
{
    double *const *x = search->neighbours->sorted;
    const double x0 = search->x[0] - shift, x1 = search->x[1], x2 = search->x[2];
    const double *from0 = x[0] + start, *from1 = x[1] + start, *from2 = x[2] + start;
    for (int i = 0; i < count; i++) {
        const double d0 = from0[i] - x0, d1 = from1[i] - x1, d2 = from2[i] - x2;
        square[i] = d0 * d0 + d1 * d1 + d2 * d2;
    }
    if (search->self >= start && search->self < start + count)
        square[search->self - start] = INFINITY;
}

THREADS_INLINE void count_block(struct search *search, const double *square, int count)
{
    int32_t near = 0, wide = 0;
    for (int i = 0; i < count; i++) {
        near += square[i] < search->near2;
        wide += square[i] < search->far2;
    }
    search->near_count += near;
    search->wide_count += wide;
}

THREADS_INLINE void list_block(struct search *search, int32_t start, const double *square, int count)
{
    int found[BLOCK], n = 0;
    for (int i = 0; i < count; i++) {
        found[n] = i;
        n += square[i] < search->far2;
    }
    for (int k = 0; k < n; k++) {
        const int32_t q = search->neighbours->order[start + found[k]];
        if (search->wide)
            search->wide[search->wide_count++] = q;
        if (square[found[k]] < search->near2)
            search->near[search->near_count++] = q;
    }
}

/* Looks at the particles of cells from ... to of one row, which lie one behind the other, as seen from `shift` along x. */
THREADS_INLINE void search_row(struct search *search, int from, int to, int j, int k, double shift)
{
    const struct neighbours *neighbours = search->neighbours;
    const int32_t first = neighbours->cell_first[cell_at(neighbours, (int[]){from, j, k})];
    const int32_t end = neighbours->cell_first[cell_at(neighbours, (int[]){to, j, k}) + 1];
    for (int32_t start = first; start < end; start += BLOCK) {
        double square[BLOCK];
        const int count = end - start < BLOCK ? end - start : BLOCK;
        find_squares(search, start, count, shift, square);
        if (search->near)
            list_block(search, start, square, count);
        else
            count_block(search, square, count);
    }
}

THREADS_VECTORISED
static void search_around(struct search *search, const int at[3])
{
    const struct neighbours *neighbours = search->neighbours;
    const int last = neighbours->cells[0] - 1;
    int low[3], high[3];
    for (int a = 0; a < 3; a++) {
        low[a] = at[a] > 0 ? at[a] - 1 : 0;
        high[a] = at[a] + 1 < neighbours->cells[a] ? at[a] + 1 : neighbours->cells[a] - 1;
    }
    for (int k = low[2]; k <= high[2]; k++)
        for (int j = low[1]; j <= high[1]; j++) {
            if (neighbours->period > 0 && at[0] == 0)
                search_row(search, last, last, j, k, -neighbours->period);
            search_row(search, low[0], high[0], j, k, 0);
            if (neighbours->period > 0 && at[0] == last)
                search_row(search, 0, 0, j, k, neighbours->period);
        }
}

/* Lists the neighbours of the particle at a place of the order, or only counts them (first[p + 1] of both lists). */
static void search_for(struct neighbours *neighbours, int32_t self, bool only_counts)
{
    struct neighbour_lists *near = &neighbours->near, *wide = &neighbours->wide;
    const size_t p = (size_t)neighbours->order[self];
    const double reach = near->reach + neighbours->skin, far = wide->reach > 0 ? wide->reach + neighbours->skin : reach;
    struct search search = {.neighbours = neighbours, .self = self, .near2 = reach * reach, .far2 = far * far};
    int at[3];
    for (int a = 0; a < 3; a++)
        search.x[a] = neighbours->sorted[a][self];
    if (!only_counts) {
        search.near = near->list + near->first[p];
        search.wide = wide->reach > 0 ? wide->list + wide->first[p] : NULL;
    }
    find_cell(neighbours, p, at);
    search_around(&search, at);
    if (!only_counts)
        return;
    near->first[p + 1] = search.near_count;
    if (wide->reach > 0)
        wide->first[p + 1] = search.wide_count;
}

/* Sums up the counts and makes room. */
static void lay_lists(struct neighbour_lists *lists, size_t count)
{
    lists->first[0] = 0;
    for (size_t p = 0; p < count; p++)
        lists->first[p + 1] += lists->first[p];
    lists->list = memory_grow(lists->list, &lists->list_capacity, (size_t)lists->first[count] + 1, sizeof(int32_t), "neighbours");
}

/* Removed particles come last in the order: they have no neighbours and are none. */
static void make_lists(struct neighbours *neighbours)
{
    const size_t count = neighbours->store->count;
    const int32_t there = neighbours->cell_first[cell_count(neighbours)];
#pragma omp parallel for schedule(dynamic, 256) if (neighbours->is_shared)
    for (int32_t n = 0; n < there; n++)
        search_for(neighbours, n, true);
    for (size_t n = (size_t)there; n < count; n++) {
        neighbours->near.first[neighbours->order[n] + 1] = 0;
        if (neighbours->wide.reach > 0)
            neighbours->wide.first[neighbours->order[n] + 1] = 0;
    }
    lay_lists(&neighbours->near, count);
    if (neighbours->wide.reach > 0)
        lay_lists(&neighbours->wide, count);
#pragma omp parallel for schedule(dynamic, 256) if (neighbours->is_shared)
    for (int32_t n = 0; n < there; n++)
        search_for(neighbours, n, false);
}

/* Places in the order of cells; in two dimensions all have the same z. */
static void sort_places(struct neighbours *neighbours)
{
    double *const *x = neighbours->store->real[COLUMN_LISTED_POSITION];
    for (int a = 0; a < 3; a++)
        for (size_t n = 0; n < neighbours->store->count; n++)
            neighbours->sorted[a][n] = a < neighbours->dimension ? x[a][neighbours->order[n]] : 0;
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
    sort_places(neighbours);
    make_lists(neighbours);
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
