/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reproducing kernel shape functions (Liu, Jun, Zhang 1995; spec 2): kernels times a polynomial that makes their sum
 * reproduce the monomials of a basis. */
#ifndef RKPM_SHAPE_H
#define RKPM_SHAPE_H

#include "deck/scene_rkpm.h"
#include "rkpm/basis.h"
#include "rkpm/kernel.h"
#include "rkpm/search.h"

#include <stdbool.h>

/* The shape functions at one point that are not zero there. */
struct shape_row {
    int count;
    int32_t *node;
    double *value;
    double *gradient[3];
    int order;    /* of what they reproduce: that of the basis, or less; -1: no node is near */
    double reach; /* the supports' factor here: 1, or more where too few nodes were near */
};

struct rkpm_shape {
    int dimension;
    double *const *x; /* nodes' coordinates, by axis */
    struct rkpm_support support; /* its radius is the scale s of offsets too */
    enum basis_form form;
    struct basis basis[3]; /* those to fall back on: of order 0 and 1, and the one asked for */
    int top;               /* place of the last one */
    struct search search;
    struct shape_row row;  /* of the last point */
    double *monomials;     /* of its nodes */
    double *kernel;
    double *kernel_slope[3];
    size_t most;           /* nodes that it has room for */
    long enlarged, lowered; /* points where the support was enlarged, or the order had to be lowered */
};

/* Order up to which all monomials are reproduced: 1, 1, 2. */
int rkpm_shape_order(enum basis_form form);

/* Shape functions of nodes x[axis][node], which stay where they are. */
void rkpm_shape_open(struct rkpm_shape *shape, int dimension, enum basis_form form, size_t count, double *const *x,
                     const struct rkpm_support *support);
void rkpm_shape_close(struct rkpm_shape *shape);

/* The same shape functions with a row of their own, for another thread: `shape` has to stay open. */
void rkpm_shape_open_copy(struct rkpm_shape *copy, const struct rkpm_shape *shape);
void rkpm_shape_close_copy(struct rkpm_shape *copy);

/* Values at a point, with gradients (2.3). The row holds until the next call.
 * Where nodes are too few for the basis the supports are enlarged by 1.2 up to three times, then the order is lowered, down
 * to 0 with gradients of zero. */
const struct shape_row *rkpm_shape_at(struct rkpm_shape *shape, const double point[3], enum gradient_form gradient);

#endif
