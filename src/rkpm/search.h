/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which nodes are near a point: nodes sorted into cells as large as the support. */
#ifndef RKPM_SEARCH_H
#define RKPM_SEARCH_H

#include <stddef.h>
#include <stdint.h>

struct search {
    int dimension;
    double low[3], size[3]; /* corner of the first cell, cells' sides */
    int cells[3];
    int32_t *first;         /* per cell: place of its first node in `node`; one more at the end */
    int32_t *node;          /* by cells, in a cell by number */
    double *place[3];       /* of nodes in that order */
    size_t first_capacity, node_capacity, place_capacity[3];
};

/* Cells of the given sides around nodes x[axis][node], which lie anywhere. */
void search_open(struct search *search, int dimension, size_t count, double *const x[3], const double size[3]);
void search_close(struct search *search);

/* The same after nodes have moved, or of a search that has only a dimension so far. Room is kept from call to call, and grows only where the nodes need more cells. */
void search_renew(struct search *search, size_t count, double *const x[3], const double size[3]);

/* The cells that reach nearer than `reach` cells' sides to a point: from[axis] to to[axis]; empty where to < from. */
void search_range(const struct search *search, const double point[3], double reach, int from[3], int to[3]);

static inline size_t search_cell(const struct search *search, const int cell[3])
{
    return ((size_t)cell[2] * (size_t)search->cells[1] + (size_t)cell[1]) * (size_t)search->cells[0] + (size_t)cell[0];
}

/* Cells along the first axis follow each other: nodes of those from `cell` to `last` along it are node[from] to node[to - 1]. */
static inline void search_span(const struct search *search, const int cell[3], int last, int32_t *from, int32_t *to)
{
    const size_t c = search_cell(search, cell);
    *from = last < cell[0] ? 0 : search->first[c];
    *to = last < cell[0] ? 0 : search->first[c + (size_t)(last - cell[0]) + 1];
}

/* The most nodes that any point has in its range. */
size_t search_most(const struct search *search, double reach);

#endif
