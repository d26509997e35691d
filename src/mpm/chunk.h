/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Particles of a block in portions that fit the first-level cache. A portion that lies in one
 * piece in memory is worked on in place, others are copied to the thread's workspace and back. */
#ifndef MPM_CHUNK_H
#define MPM_CHUNK_H

#include "base/threads.h"
#include "mpm/mpm.h"

enum {
    CHUNK_PARTICLES = 64,
    LANES = 4,                          /* particles whose grid values are evaluated together */
    CHUNK_ROOM = CHUNK_PARTICLES + LANES /* a cell's last lanes may run over */
};

typedef double lanes __attribute__((vector_size(LANES * sizeof(double)), aligned(sizeof(double)), may_alias));

/* Arrays of one thread. */
struct workspace {
    double local[3][CHUNK_ROOM];    /* position in the cell, 0 ... 1 */
    double gathered[3][CHUNK_ROOM]; /* velocity or acceleration from the grid */
    double strain[6][CHUNK_ROOM], spin[3][CHUNK_ROOM], trace[CHUNK_ROOM];
    double volume_before[CHUNK_ROOM], work[CHUNK_ROOM], terms[2][CHUNK_ROOM];
    double copy[48][CHUNK_ROOM]; /* columns of a portion that is not in one piece */
    double **history;            /* where the portion's history is, a pointer a column */
    double *history_copy;        /* room for it, CHUNK_ROOM a column */
    double patch[8 * LARGEST_PATCH];
    double vectors[2][LANES * LARGEST_PATCH]; /* two vector fields of the patch, node by node */
    double weight[3][3][CHUNK_ROOM], slope[3][3][CHUNK_ROOM]; /* of wide supports, per axis and node */
    int32_t base[CHUNK_ROOM];                                 /* their lowest node in the patch */
    uint8_t cell[CHUNK_ROOM];
    double acceleration_step; /* of the chunk when transfers blend: the step times flip's share */
    double affine[9][CHUNK_ROOM]; /* velocity gradient of the chunk, with xfer apic */
    double cell_mean[BLOCK_CELLS]; /* averages over the block's cells, with bbar */
};

struct chunk {
    const struct cell_block *block;
    int32_t block_index;
    const int32_t *order; /* places of the particles in memory */
    int32_t from;         /* index of the first one in the block */
    int32_t count;
    bool is_one_piece;
    struct workspace *workspace;
};

/* The next portion of a block; false after the last. Start with .count = 0. */
THREADS_INLINE bool chunk_next(const struct mpm *mpm, struct chunk *chunk)
{
    int32_t from = chunk->from + chunk->count;
    int32_t left = chunk->block->count - from;
    if (left <= 0)
        return false;
    chunk->from = from;
    chunk->count = left < CHUNK_PARTICLES ? left : CHUNK_PARTICLES;
    chunk->order = mpm->cells->order + chunk->block->first + from;
    int differs = 0;
    for (int32_t j = 0; j < chunk->count; j++)
        differs |= chunk->order[j] - chunk->order[0] - j;
    chunk->is_one_piece = differs == 0;
    return true;
}

/* A column component of the portion: in place, or copied to `copy`. */
THREADS_INLINE double *chunk_read(const struct chunk *chunk, double *column, double *copy)
{
    if (chunk->is_one_piece)
        return column + chunk->order[0];
    for (int32_t j = 0; j < chunk->count; j++)
        copy[j] = column[chunk->order[j]];
    return copy;
}

/* Puts a changed copy back. */
THREADS_INLINE void chunk_write(const struct chunk *chunk, double *column, const double *copy)
{
    if (chunk->is_one_piece)
        return;
    for (int32_t j = 0; j < chunk->count; j++)
        column[chunk->order[j]] = copy[j];
}

/* Strain and spin increments and trace of particle j from its velocity gradient times the step
 * g[component][axis] (spec 6.2). */
THREADS_INLINE void chunk_set_gradient(struct workspace *w, int32_t j, double g[3][3])
{
    w->strain[0][j] = g[0][0];
    w->strain[1][j] = g[1][1];
    w->strain[2][j] = g[2][2];
    w->strain[3][j] = g[2][1] + g[1][2];
    w->strain[4][j] = g[0][2] + g[2][0];
    w->strain[5][j] = g[1][0] + g[0][1];
    w->spin[0][j] = 0.5 * (g[2][1] - g[1][2]);
    w->spin[1][j] = 0.5 * (g[0][2] - g[2][0]);
    w->spin[2][j] = 0.5 * (g[1][0] - g[0][1]);
    w->trace[j] = g[0][0] + g[1][1] + g[2][2];
}

/* The other way: g[component][axis] from strain and spin increments. */
THREADS_INLINE void chunk_get_gradient(const struct workspace *w, int32_t j, double g[3][3])
{
    for (int a = 0; a < 3; a++)
        g[a][a] = w->strain[a][j];
    g[2][1] = 0.5 * w->strain[3][j] + w->spin[0][j], g[1][2] = 0.5 * w->strain[3][j] - w->spin[0][j];
    g[0][2] = 0.5 * w->strain[4][j] + w->spin[1][j], g[2][0] = 0.5 * w->strain[4][j] - w->spin[1][j];
    g[1][0] = 0.5 * w->strain[5][j] + w->spin[2][j], g[0][1] = 0.5 * w->strain[5][j] - w->spin[2][j];
}

/* The cells of a chunk that hold particles, one after the other: particles from ... to - 1. */
struct cell_walk {
    int cell;
    int32_t from, to;
};

THREADS_INLINE bool walk_next(const struct chunk *chunk, struct cell_walk *walk)
{
    const int32_t *first = chunk->block->cell_first;
    int32_t end = chunk->from + chunk->count;
    walk->from = walk->to;
    if (walk->to == chunk->count)
        return false;
    while (first[walk->cell + 1] <= chunk->from + walk->from)
        walk->cell++;
    walk->to = (first[walk->cell + 1] < end ? first[walk->cell + 1] : end) - chunk->from;
    return true;
}

/* Low corner of a cell of the chunk's block, along axis a. */
THREADS_INLINE double chunk_cell_low(const struct mpm *mpm, const struct chunk *chunk, int cell, int a)
{
    const struct cell_frame *frame = &mpm->cells->frame;
    int in_block = (cell >> (2 * a)) & (BLOCK_EDGE - 1);
    return frame->low[a] + (double)(chunk->block->at[a] * BLOCK_EDGE + in_block) * frame->size;
}

#endif
