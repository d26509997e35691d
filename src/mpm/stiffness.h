/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The elastic stiffness of the particles on a lattice of trilinear cells, K = sum of V B^T D B, without
 * its matrix. In a cell the gradients of a trilinear field are polynomials, so all that K needs to know of
 * the cell's particles are the moments of their volumes,
 *     m(a, b, c) = sum of V / size^2 x^a y^b z^c,  a, b, c = 0 ... 2,
 * in local coordinates from the middle of the cell: applying K costs the same for any number of particles
 * in a cell. A lattice of twice the cell size has moments that follow from these, and its K is just the
 * restriction of the finer one. */
#ifndef MPM_STIFFNESS_H
#define MPM_STIFFNESS_H

#include "mpm/mpm.h"

enum {
    STIFFNESS_MOMENTS = 27, /* m(a, b, c) is number a + 3 b + 9 c */
    STIFFNESS_SET = STIFFNESS_MOMENTS * BLOCK_CELLS, /* numbers of a set of moments of a block */
    STIFFNESS_PATCH = 128,  /* numbers kept for a field of a block's 5 x 5 x 5 nodes */
    STIFFNESS_VECTOR = 3 * BLOCK_CELLS /* numbers of a block in a vector: x, y, z of its 64 nodes */
};

/* A block of 4 x 4 x 4 cells and nodes. */
struct stiffness_block {
    int32_t at[3];
    int32_t neighbour[BLOCK_NEIGHBOURS]; /* as in struct cell_block */
    uint16_t rows;  /* bit j + 4 k: a cell of row (j, k) holds particles */
    uint8_t free[BLOCK_CELLS], fixed[BLOCK_CELLS]; /* bits 1 2 4 for x y z: unknown, and held at zero */
};

/* One lattice. Vectors have STIFFNESS_VECTOR numbers a block, zero where a node is not free. */
struct stiffness {
    const struct patch_layout *layout; /* of supports of one cell */
    double size;
    int32_t n_blocks, active; /* blocks 0 ... active - 1 have cells with particles */
    struct stiffness_block *blocks;
    int sets;          /* sets of moments: 1, of V; or 3 where materials differ, of V, V lambda, V mu */
    double lame, shear, bulk; /* of the one material */
    bool averages_volume; /* bbar: then lambda is -2/3 mu, and the bulk modulus acts on the cell's mean */
    double *moments;   /* [active][sets][row of four cells][STIFFNESS_MOMENTS][4] */
    double *cell_bulk; /* [active][64] bulk modulus of the cell, with bbar and several materials */
    double *patch;     /* [active][6][STIFFNESS_PATCH] */
    double *inverse;   /* [n_blocks][6][64]: inverse of the 3 x 3 blocks on the diagonal */
    size_t blocks_capacity, moments_capacity, bulk_capacity, patch_capacity, inverse_capacity;
};

void stiffness_close(struct stiffness *stiffness);

/* Makes room for n_blocks blocks, whose first `active` have cells; `blocks` is to be filled in. */
void stiffness_open(struct stiffness *stiffness, int32_t n_blocks, int32_t active);

/* The lattice of the program's grid: blocks, materials and moments of its particles; `softening`, by place in
 * memory, reduces their shear moduli (NULL: all elastic). What is free has to be filled in, then
 * stiffness_diagonal called. */
void stiffness_of_particles(struct stiffness *stiffness, const struct mpm *mpm, const double *softening);

/* Where a set's moments of cell c begin; the next one is BLOCK_EDGE numbers further. */
static inline int stiffness_cell(int c)
{
    return c / BLOCK_EDGE * STIFFNESS_MOMENTS * BLOCK_EDGE + c % BLOCK_EDGE;
}

/* Notes which rows of cells hold particles. */
void stiffness_find_rows(struct stiffness *stiffness);

/* Inverse of the diagonal blocks of K; what has no stiffness is no longer free, a node without any not held. */
void stiffness_diagonal(struct stiffness *stiffness);

/* y = K x on the free nodes. */
void stiffness_apply(const struct stiffness *stiffness, const double *x, double *y);

/* The same in two parts: forces of block b's cells to its patch; and the sum of patches around block b,
 * with `masked` on free nodes only. */
void stiffness_give(const struct stiffness *stiffness, const double *x, int32_t b);
void stiffness_collect(const struct stiffness *stiffness, int32_t b, double sum[STIFFNESS_VECTOR], bool masked);

/* Displacement gradients of block b's particles under displacements x: their largest component, and, unless NULL,
 * the deviatoric strains xx yy zz yz xz xy (halves of engineering shears) by place in memory. */
double stiffness_strains(const struct mpm *mpm, const struct stiffness *stiffness, const double *x, int32_t b,
                         double *const deviator[6]);

/* z = inverse diagonal times r, of block b: factor times it is added to `share` times z. */
void stiffness_jacobi(const struct stiffness *stiffness, int32_t b, const double *r, double factor, double share, double *z);

/* Values of a vector at a block's 5 x 5 x 5 nodes, to patch[3][STIFFNESS_PATCH]. */
void stiffness_read(const struct stiffness *stiffness, const double *x, int32_t b, double *patch);

/* Fewer blocks than this are not worth a second thread. */
enum { STIFFNESS_SHARED = 100 };

#endif
