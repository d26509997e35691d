/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What conjugate gradients are slow at, long waves, found on a coarse grid: displacements that are linear between its nodes
 * (additive two-level preconditioning, Smith, Bjorstad and Gropp, Domain Decomposition, 1996). */
#ifndef RKPM_COARSE_H
#define RKPM_COARSE_H

#include "base/envelope.h"
#include "rkpm/body.h"

struct coarse {
    const struct body *body;
    int corners;          /* of a cell: 2 to the dimension */
    long cells[3];
    int32_t nodes;        /* of the grid */
    int32_t *corner;      /* per row of the body's matrix, `corners` grid nodes each */
    double *share;        /* and the row's shares of them */
    int32_t *first;       /* per unknown of the grid: the first one that it is coupled with */
    struct envelope envelope;
    double *unknown;
};

/* A grid of about one node in four along each axis. */
void coarse_open(struct coarse *coarse, const struct body *body);
void coarse_close(struct coarse *coarse);

/* Takes the body's matrix; rows that `is_left_out` says have no part. */
void coarse_factor(struct coarse *coarse, const bool *is_left_out);

/* z += P (P^T K P)^-1 P^T r. */
void coarse_add(struct coarse *coarse, const bool *is_left_out, const double *r, double *z);

#endif
