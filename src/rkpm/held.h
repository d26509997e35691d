/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Displacements that are held exactly (spec rkpm 4): sums of coefficients times shape functions at nodes of held sides
 * (transformation), or times hats on the boundary (Lagrange multipliers); the same along all axes. */
#ifndef RKPM_HELD_H
#define RKPM_HELD_H

#include "rkpm/points.h"

/* One number times the coefficient of a node. */
struct held_term {
    int32_t row, node;
    double value;
};

struct held {
    int32_t rows;
    int32_t *of_node;        /* per node: its row, or -1 */
    int32_t *node;           /* per row */
    struct held_term *term;  /* a node may come more than once in a row */
    size_t terms, nodes, term_capacity, node_capacity;
};

/* The displacement at a place. */
typedef void held_displacement(void *context, const double x[3], double u[3]);

void held_open(struct held *held, size_t nodes);
void held_close(struct held *held);

/* Nodes on the sides that `sides` names (low and high of each axis): sum of Psi_J(x_k) d_J. */
void held_add_nodes(struct held *held, const struct node_box *box, const bool sides[6], double *const *x, const struct rkpm_shape *shape);

/* Hats between the nodes of the box's lattice on its faces: sum over points of w H_k Psi_J d_J. */
void held_add_hats(struct held *held, const struct node_box *box, const struct points *faces, const bool *is_held);

/* What the rows have to be, D numbers each. */
void held_give_nodes(const struct held *held, double *const *x, int dimension, held_displacement *displacement, void *context, double *given);
void held_give_hats(const struct held *held, const struct node_box *box, const struct points *faces, const bool *is_held, held_displacement *displacement,
                    void *context, double *given);

#endif
