/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rkpm/search.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

/* Nodes far apart get larger cells: no more of them than this along an axis. */
static const double MOST_CELLS = 500;
/* And no more than so many per node. */
static const double CELLS_PER_NODE = 4, LEAST_CELLS = 64;

/* Cells over the extent of the nodes. */
static void choose_cells(struct search *search, size_t count, double *const x[3], const double size[3])
{
    for (int a = 0; a < 3; a++) {
        double low = 0, high = 0;
        for (size_t i = 0; i < count && a < search->dimension; i++) {
            low = i == 0 ? x[a][i] : fmin(low, x[a][i]);
            high = i == 0 ? x[a][i] : fmax(high, x[a][i]);
        }
        search->low[a] = low;
        search->size[a] = a < search->dimension ? fmax(size[a], (high - low) / MOST_CELLS) : 1;
        search->cells[a] = (int)floor((high - low) / search->size[a]) + 1;
    }
    while ((double)search->cells[0] * search->cells[1] * search->cells[2] > CELLS_PER_NODE * (double)count + LEAST_CELLS)
        for (int a = 0; a < search->dimension; a++) {
            search->cells[a] = (search->cells[a] + 1) / 2;
            search->size[a] *= 2;
        }
}

static size_t cell_of(const struct search *search, double *const x[3], size_t node)
{
    int cell[3] = {0};
    for (int a = 0; a < search->dimension; a++) {
        cell[a] = (int)floor((x[a][node] - search->low[a]) / search->size[a]);
        cell[a] = cell[a] < search->cells[a] ? cell[a] : search->cells[a] - 1;
    }
    return search_cell(search, cell);
}

/* Counting sort. */
static void sort_nodes(struct search *search, size_t count, double *const x[3])
{
    const size_t cells = (size_t)search->cells[0] * (size_t)search->cells[1] * (size_t)search->cells[2];
    search->first = memory_grow(search->first, &search->first_capacity, cells + 1, sizeof *search->first, "cells of nodes");
    search->node = memory_grow(search->node, &search->node_capacity, count, sizeof *search->node, "cells of nodes");
    memset(search->first, 0, (cells + 1) * sizeof *search->first);
    for (size_t i = 0; i < count; i++)
        search->first[cell_of(search, x, i) + 1]++;
    for (size_t c = 0; c < cells; c++)
        search->first[c + 1] += search->first[c];
    /* first[c] goes up to the end of its cell, and from the last node on back to the start */
    for (size_t i = count; i-- > 0;) {
        const size_t c = cell_of(search, x, i);
        search->node[--search->first[c + 1]] = (int32_t)i;
    }
    for (size_t c = 0; c < cells; c++)
        search->first[c] = search->first[c + 1];
    search->first[cells] = (int32_t)count;
    for (int a = 0; a < search->dimension; a++) {
        search->place[a] = memory_grow(search->place[a], &search->place_capacity[a], count, sizeof(double), "cells of nodes");
        for (size_t k = 0; k < count; k++)
            search->place[a][k] = x[a][search->node[k]];
    }
}

void search_open(struct search *search, int dimension, size_t count, double *const x[3], const double size[3])
{
    *search = (struct search){.dimension = dimension};
    search_renew(search, count, x, size);
}

void search_renew(struct search *search, size_t count, double *const x[3], const double size[3])
{
    choose_cells(search, count, x, size);
    sort_nodes(search, count, x);
}

void search_close(struct search *search)
{
    memory_free(search->first);
    memory_free(search->node);
    for (int a = 0; a < 3; a++)
        memory_free(search->place[a]);
}

void search_range(const struct search *search, const double point[3], double reach, int from[3], int to[3])
{
    for (int a = 0; a < 3; a++) {
        const double place = a < search->dimension ? (point[a] - search->low[a]) / search->size[a] : 0, last = search->cells[a] - 1;
        from[a] = (int)fmin(fmax(floor(place - reach), 0), last + 1);
        to[a] = (int)fmax(fmin(floor(place + reach), last), -1);
        if (a >= search->dimension)
            from[a] = to[a] = 0;
    }
}

/* Nodes in the cells up to `width` away from a cell. */
static size_t nodes_around(const struct search *search, const int middle[3], int width)
{
    size_t count = 0;
    int from[3], to[3], cell[3];
    for (int a = 0; a < 3; a++) {
        from[a] = middle[a] > width ? middle[a] - width : 0;
        to[a] = middle[a] + width < search->cells[a] ? middle[a] + width : search->cells[a] - 1;
    }
    for (cell[2] = from[2]; cell[2] <= to[2]; cell[2]++)
        for (cell[1] = from[1]; cell[1] <= to[1]; cell[1]++)
            for (cell[0] = from[0]; cell[0] <= to[0]; cell[0]++) {
                const size_t c = search_cell(search, cell);
                count += (size_t)(search->first[c + 1] - search->first[c]);
            }
    return count;
}

size_t search_most(const struct search *search, double reach)
{
    size_t most = 0;
    int cell[3];
    for (cell[2] = 0; cell[2] < search->cells[2]; cell[2]++)
        for (cell[1] = 0; cell[1] < search->cells[1]; cell[1]++)
            for (cell[0] = 0; cell[0] < search->cells[0]; cell[0]++) {
                const size_t count = nodes_around(search, cell, (int)ceil(reach));
                most = count > most ? count : most;
            }
    return most;
}
