/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Preconditioner of the stiffness: lattices of twice, four times, ... the cell size, each with the
 * stiffness of the same particles, down to one that is small enough for a direct solution (a V-cycle;
 * Trottenberg, Oosterlee, Schueller, Multigrid, 2001). On each level Chebyshev polynomials of the
 * Jacobi iteration with 3 x 3 blocks take out what the next one can't see (Adams, Brezina, Hu,
 * Tuminaro, J. Comput. Phys. 188, 2003). It is symmetric and positive. */
#ifndef MPM_MULTIGRID_H
#define MPM_MULTIGRID_H

#include "base/envelope.h"
#include "mpm/light_nodes.h"
#include "mpm/stiffness.h"

enum { MULTIGRID_LEVELS = 16 };

struct multigrid_level {
    struct stiffness stiffness;
    int32_t (*child)[8];  /* per block: those of the finer level that lie in it, or -1 */
    int32_t *parent;      /* per block: that of the coarser level */
    double *residual, *step, *image; /* vectors of the level; those below of the coarser ones only */
    double *source, *solution;
    size_t child_capacity, parent_capacity, residual_capacity, step_capacity, image_capacity, source_capacity;
    size_t solution_capacity;
    double largest;       /* bound of the eigenvalues of the inverse diagonal times K */
};

struct multigrid {
    struct multigrid_level level[MULTIGRID_LEVELS];
    int n_levels;
    struct envelope coarsest;
    int32_t *unknown;     /* of the coarsest level: place of each unknown in a vector, in order of elimination */
    size_t unknown_capacity;
    const struct light_nodes *light; /* of the finest level, the caller's */
    const uint8_t *fixed; /* per node of it: directions that are held */
    long applications;    /* of the finest stiffness, since the start */
};

void multigrid_close(struct multigrid *multigrid);

/* Takes the particles of the run (`softening` as in stiffness.h) and makes all levels; bounds of eigenvalues are those of the last time where
 * `keeps_bounds` says that the particles have hardly moved since. A node with
 * stiffness is free in the directions that no boundary holds. */
void multigrid_open(struct multigrid *multigrid, const struct mpm *mpm, const struct light_nodes *light,
                    const double *softening, bool keeps_bounds);

/* Numbers in a vector of the finest level. */
size_t multigrid_count(const struct multigrid *multigrid);

/* y = K x; z = B r. Fit struct conjugate_problem, with the multigrid as context. Light nodes, which have to stay as
 * they are while it is in use, follow the others in K and are zero in all vectors. */
void multigrid_apply(void *multigrid, const double *x, double *y);
void multigrid_precondition(void *multigrid, const double *r, double *z);

#endif
