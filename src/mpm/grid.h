/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The background grid: node values in blocks of 4 x 4 x 4 nodes, only where particles reach. */
#ifndef MPM_GRID_H
#define MPM_GRID_H

#include "base/threads.h"
#include "mpm/patch.h"
#include "particles/cell_list.h"

/* What a node holds in the course of a step. */
enum node_field {
    NODE_MASS,
    NODE_MOMENTUM, /* x y z; the velocity P/m once the momentum equation is integrated */
    NODE_FORCE = NODE_MOMENTUM + 3, /* x y z; then the acceleration F/m */
    NODE_STRAINING = NODE_FORCE + 3, /* x y z: momentum, then velocity, that strains the particles */
    NODE_NORMAL = NODE_STRAINING + 3, /* x y z: sum of mass times gradient; only with contact */
    NODE_FIELDS = NODE_NORMAL,        /* without contact */
    NODE_FIELDS_CONTACT = NODE_NORMAL + 3
};

enum { PATCH_FIELDS = 7, PATCH_FIELDS_CONTACT = 10, LARGEST_PATCH = 392 };

struct scene_hold;

struct grid {
    const struct cell_list *cells;
    int32_t nodes[3];
    long boundary[6];
    int boundary_layers; /* the codes act on this many outermost node layers */
    double mass_cutoff;
    double light_mass; /* nodes below it are light: see grid_integrate_block; 0: none */
    double damping; /* force per velocity on each node */
    bool may_damp;  /* at some time */
    const struct scene_hold *holds; /* of the scene */
    size_t n_holds;
    double *node;   /* [block][fields][64] */
    double *patch;  /* [active block][patch_fields][layout.nodes]: what its particles give to nodes */
    struct patch_layout layout;
    int fields, patch_fields; /* kept for each node and patch */
    int32_t shared_blocks;    /* fewer blocks than this are not worth a second thread */
    uint8_t *fixed; /* [block][64], bits 1 2 4 for x y z */
    double *nothing; /* zeros in place of the nodes or the patch of a block that is missing */
    double *damped; /* per block: energy that nodal damping took; NULL without damping */
    size_t node_capacity, patch_capacity, fixed_capacity, damped_capacity;
    long version;
};

/* What a grid is made for. Along an axis a block's patch has `low` nodes (0 or 1) below its own, and
 * `high` (1 or 2) above. */
struct grid_form {
    int low, high;
    int fields, patch_fields;
    int boundary_layers;
};

struct grid *grid_open(const struct cell_list *cells, struct grid_form form, const long boundary[6], double mass_cutoff);
void grid_close(struct grid *grid);

/* Nodes that the deck holds, besides those of the boundary codes. */
void grid_hold(struct grid *grid, const struct scene_hold *holds, size_t n_holds);

/* Energy that nodal damping took in the last integration, with the kinetic energy of the nodes' changes of
 * velocity: that of the particles' changes has to be taken off, the difference is lost between them. */
double grid_damped_energy(const struct grid *grid);

/* Follows a change of the blocks of the cell list. */
void grid_follow(struct grid *grid);

/* The 64 values of a field in a block. */
THREADS_INLINE double *grid_field(const struct grid *grid, int32_t block, int field)
{
    return grid->node + ((size_t)block * (size_t)grid->fields + (size_t)field) * BLOCK_CELLS;
}

/* Where a block's particles put what they give to field f of a pass: no other block writes there;
 * collecting sums the patches in a fixed order. */
THREADS_INLINE double *grid_patch(const struct grid *grid, int32_t block, int f)
{
    return grid->patch + ((size_t)block * (size_t)grid->patch_fields + (size_t)f) * (size_t)grid->layout.nodes;
}

/* Copies `count` fields from `first` of a block's patch of nodes to patch[0 ... count-1], each of
 * layout.nodes numbers. */
void grid_read_patch(const struct grid *grid, int32_t block, int first, int count, double *patch);

/* Place in a patch of the low corner of cell c of the block. */
THREADS_INLINE int grid_patch_corner(int c, int row, int edge, int origin)
{
    int i = c % BLOCK_EDGE + origin, j = c / BLOCK_EDGE % BLOCK_EDGE + origin, k = c / (BLOCK_EDGE * BLOCK_EDGE) + origin;
    return i + row * (j + edge * k);
}

/* Sums the patches' fields from `from_field` on into `count` node fields from `first` of a block. */
void grid_collect(struct grid *grid, int32_t block, int first, int count, int from_field);

/* The passes below sum fields 0 ... count-1 of the patches into `count` node fields from `first`,
 * and go on with each block at once. */

/* Spec 6 D: P += F step, zero in fixed directions; then velocity and acceleration of the nodes
 * above the cutoff, zero elsewhere; with nodal damping. */
void grid_integrate(struct grid *grid, int first, int count, double step);

/* The same in two parts, with room for contact between them: momentum and force as such, and their
 * division by the mass. The last three of the fields summed are the normals. */
void grid_integrate_momentum(struct grid *grid, int first, int count, double step);
void grid_divide(struct grid *grid, double step);

/* Straining velocity from the momentum fields at `first` + 0, 1, 2 of those summed (the mass comes
 * first when it is among them), zero in fixed directions. */
void grid_straining_velocity(struct grid *grid, int first, int count);

/* Sums field 0 and 1 of the patches and puts their quotient (0 where the second is 0) into `first`. */
void grid_quotient(struct grid *grid, int first);

/* What these passes do with one block once its nodes are summed. */
void grid_integrate_block(struct grid *grid, int32_t block, double step);
void grid_straining_block(struct grid *grid, int32_t block, int source);

/* Bytes of the node storage. */
size_t grid_bytes(const struct grid *grid);

#endif
