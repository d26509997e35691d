/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The background grid: node values in blocks of 4 x 4 x 4 nodes, only where particles reach. */
#ifndef MPM_GRID_H
#define MPM_GRID_H

#include "base/threads.h"
#include "particles/cell_list.h"

/* What a node holds in the course of a step. */
enum node_field {
    NODE_MASS,
    NODE_MOMENTUM, /* x y z; the velocity P/m once the momentum equation is integrated */
    NODE_FORCE = NODE_MOMENTUM + 3, /* x y z; then the acceleration F/m */
    NODE_STRAINING = NODE_FORCE + 3, /* x y z: momentum, then velocity, that strains the particles */
    NODE_FIELDS = NODE_STRAINING + 3
};

/* A patch is a block's nodes with those of its neighbours that its cells touch: 5 x 5 x 5. */
enum { PATCH_EDGE = BLOCK_EDGE + 1, PATCH_NODES = 128, PATCH_FIELDS = 7 };

struct grid {
    const struct cell_list *cells;
    int32_t nodes[3];
    long boundary[6];
    int boundary_layers; /* the codes act on this many outermost node layers */
    double mass_cutoff;
    double *node;   /* [block][field][64] */
    double *patch;  /* [active block][PATCH_FIELDS][PATCH_NODES]: what its particles give to nodes */
    uint8_t *fixed; /* [block][64], bits 1 2 4 for x y z */
    size_t node_capacity, patch_capacity, fixed_capacity;
    long version;
};

struct grid *grid_open(const struct cell_list *cells, const long boundary[6], int boundary_layers, double mass_cutoff);
void grid_close(struct grid *grid);

/* Follows a change of the blocks of the cell list. */
void grid_follow(struct grid *grid);

/* The 64 values of a field in a block. */
THREADS_INLINE double *grid_field(const struct grid *grid, int32_t block, int field)
{
    return grid->node + ((size_t)block * NODE_FIELDS + (size_t)field) * BLOCK_CELLS;
}

/* Where a block's particles put what they give to node fields: PATCH_FIELDS fields in the order of
 * the pass. No other block writes there; collecting sums the patches in a fixed order. */
static inline double (*grid_patch(const struct grid *grid, int32_t block))[PATCH_NODES]
{
    return (double(*)[PATCH_NODES])(grid->patch + (size_t)block * PATCH_FIELDS * PATCH_NODES);
}

/* Copies `count` fields from `first` of a block's patch of nodes to patch[0 ... count-1]. */
void grid_read_patch(const struct grid *grid, int32_t block, int first, int count, double patch[][PATCH_NODES]);

/* Place in a patch of the low corner of cell c of the block. */
THREADS_INLINE int grid_patch_corner(int c)
{
    return c % BLOCK_EDGE + PATCH_EDGE * (c / BLOCK_EDGE % BLOCK_EDGE) + PATCH_EDGE * PATCH_EDGE * (c / (BLOCK_EDGE * BLOCK_EDGE));
}

/* The passes below sum fields 0 ... count-1 of the patches into `count` node fields from `first`,
 * and go on with each block at once. */

/* Spec 6 D: P += F step, zero in fixed directions; then velocity and acceleration of the nodes
 * above the cutoff, zero elsewhere. */
void grid_integrate(struct grid *grid, int first, int count, double step);

/* Straining velocity from the momentum fields at `first` + 0, 1, 2 of those summed (the mass comes
 * first when it is among them), zero in fixed directions. */
void grid_straining_velocity(struct grid *grid, int first, int count);

/* Bytes of the node storage. */
size_t grid_bytes(const struct grid *grid);

#endif
