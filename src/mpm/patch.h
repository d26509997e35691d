/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A patch is a block's nodes with those of its neighbours that its particles reach: nodes 0 ... 4
 * along each axis for supports of a cell, -1 ... 5 for wider ones. Blocks keep 64 numbers a field. */
#ifndef MPM_PATCH_H
#define MPM_PATCH_H

#include "base/threads.h"
#include "particles/cell_list.h"

/* Nodes that lie side by side in one block and in the patch. */
struct patch_row {
    int neighbour; /* index of the block among the neighbours */
    int mirrored;  /* seen from that block: index of the block whose patch this is */
    int node, place;
};

struct patch_layout {
    int edge;   /* nodes along an axis */
    int row;    /* numbers from one row to the next: rows of wide supports don't cross cache lines */
    int nodes;  /* numbers to keep for a field */
    int origin; /* place of the block's own node 0 along an axis */
    struct patch_row rows[160]; /* those of four nodes first, then those of two, then single nodes */
    int end_of_four, end_of_two, end;
};

/* Four nodes of a row, or two. */
typedef double patch_four __attribute__((vector_size(BLOCK_EDGE * sizeof(double)), aligned(sizeof(double)), may_alias));
typedef double patch_two __attribute__((vector_size(2 * sizeof(double)), aligned(sizeof(double)), may_alias));

/* Goes over the rows from `begin` to `stop`, of nodes of one type, and over `count` fields of each. */
#define PATCH_READ_ROWS(type, begin, stop)                                                                             \
    for (int r = begin; r < stop; r++) {                                                                               \
        const double *from = source[layout->rows[r].neighbour] + layout->rows[r].node;                                 \
        double *to = patch + layout->rows[r].place;                                                                    \
        for (int f = 0; f < count; f++, from += BLOCK_CELLS, to += nodes)                                              \
            *(type *)to = *(const type *)from;                                                                         \
    }

/* Fills `count` fields of a patch from the blocks around it. */
THREADS_INLINE void patch_read(const struct patch_layout *layout, const double *const source[BLOCK_NEIGHBOURS], int count, double *patch)
{
    const int nodes = layout->nodes;
    PATCH_READ_ROWS(patch_four, 0, layout->end_of_four)
    PATCH_READ_ROWS(patch_two, layout->end_of_four, layout->end_of_two)
    PATCH_READ_ROWS(double, layout->end_of_two, layout->end)
}

/* The other way, and adding. A block that gives nothing is left out: it has no patch. */
#define PATCH_SUM_ROWS(type, begin, stop)                                                                              \
    for (int r = begin; r < stop; r++) {                                                                               \
        const double *from = source[layout->rows[r].mirrored];                                                         \
        if (!from)                                                                                                     \
            continue;                                                                                                  \
        from += layout->rows[r].place;                                                                                 \
        double *to = sum + layout->rows[r].node;                                                                       \
        for (int f = 0; f < count; f++, from += nodes, to += BLOCK_CELLS)                                              \
            *(type *)to += *(const type *)from;                                                                        \
    }

/* Adds `count` fields of the patches around a block (NULL: none) to the block's own nodes. */
THREADS_INLINE void patch_sum(const struct patch_layout *layout, const double *const source[BLOCK_NEIGHBOURS], int count, double *sum)
{
    const int nodes = layout->nodes;
    PATCH_SUM_ROWS(patch_four, 0, layout->end_of_four)
    PATCH_SUM_ROWS(patch_two, layout->end_of_four, layout->end_of_two)
    PATCH_SUM_ROWS(double, layout->end_of_two, layout->end)
}

#undef PATCH_READ_ROWS
#undef PATCH_SUM_ROWS

#endif
