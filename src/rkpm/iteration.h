/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Linear systems of bodies by iteration: conjugate gradients, or stabilised biconjugate ones where the matrix is not symmetric. Held rows are taken out of the system without its full transformation
 * (spec rkpm 4): coefficients d_B of held nodes follow from the others, d_B = L_BB^-1 (g - L_BF d_F), and the system is
 * T^T K T d_F = T^T (b - K c). */
#ifndef RKPM_ITERATION_H
#define RKPM_ITERATION_H

#include "base/banded.h"
#include "base/bicgstab.h"
#include "base/conjugate.h"
#include "base/incomplete.h"
#include "rkpm/coarse.h"

struct iteration {
    const struct body *body;
    struct coarse coarse;         /* of symmetric matrices */
    struct incomplete incomplete; /* of the others */
    bool *is_held;        /* per row */
    int32_t *place;       /* per held row: where it is in the order of the matrix's rows */
    struct banded rows, columns; /* L_BB and its transpose */
    double *inverse;      /* of the blocks on the diagonal, of symmetric matrices */
    double *whole, *image, *held, *residual, *solution;
    struct conjugate_room conjugate;
    struct bicgstab_room bicgstab;
    long iterations;      /* of the last solution */
};

void iteration_open(struct iteration *iteration, const struct body *body);
void iteration_close(struct iteration *iteration);

/* Takes the body's matrix; false where a node has no stiffness, or held rows depend on each other. */
bool iteration_factor(struct iteration *iteration);

/* Coefficients by rows, to 1e-10 of the right side, of matrices that are not symmetric to round-off; false where that is not reached. */
bool iteration_solve(struct iteration *iteration, const double *right, const double *given, double *coefficients);

#endif
