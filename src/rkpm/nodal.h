/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integration at the nodes (spec rkpm 3): each node stands for its cell, with rows of gradients of the shape functions near
 * it and their weights. With rows B_r and weights w_r of all nodes, and S the stress that a row's strain gives,
 *     K = sum_r w_r B_r^T D B_r,   f = sum_r w_r B_r^T S_r.
 * The first row of a node is the gradient in its cell; those behind it, where the rule has them, stabilise. The basis is
 * linear: every rule is exact for linear fields. */
#ifndef RKPM_NODAL_H
#define RKPM_NODAL_H

#include "base/threads.h"
#include "deck/scene_rkpm.h"
#include "rkpm/kernel.h"
#include "rkpm/search.h"

#include <stdbool.h>

struct cells;
struct nodal_scratch; /* of a thread */

struct nodal {
    int dimension;
    enum integration_form rule;
    enum gradient_form gradient; /* of dni: direct or implicit; nsni has implicit ones, snni none */
    size_t count;
    double *const *x;        /* the caller's: nodes' places, by axis */
    const double *volume;    /* the caller's: of the nodes' cells */
    const struct cells *cells; /* the caller's, of scni, nsni with scni, mscni; else NULL */
    const double *moment[3]; /* the caller's, of nsni: integral of (x_a - x_Ia)^2 over the cell; NULL: cells are squares or cubes */
    struct rkpm_support support;
    bool grows;              /* supports grow by 1.2 up to three times where nodes are too few; else the order is lowered at once */

    int rows;            /* per node: 1; with nsni 1 + dimension; with mscni 1 + triangles of a cell, those that it lacks of weight 0 */
    int stride;          /* neighbours that a node has room for */
    int32_t *neighbours; /* per node: how many it has, itself among them */
    int32_t *neighbour;  /* by nodes, stride each */
    double *value;       /* Psi_J(x_I), in the same way */
    double *gradients;   /* by nodes, rows, axes, stride each */
    double *weights;     /* by nodes, rows */
    double *reach;       /* per node: factor of the supports at it, 1 or more */
    bool *is_lowered;    /* per node: even with it nodes are too few; the row is Shepard's, its gradients zero */
    long enlarged, lowered;
    size_t room;         /* nodes that pairs have room for */
    struct search search;
    struct nodal_scratch *scratch;
    int n_scratch;
    size_t neighbour_capacity, value_capacity, gradient_capacity, node_capacity[4];
};

/* Makes rows of nodes x[axis][node], whose arrays stay where they are; `moment` may be NULL. */
void rkpm_nodal_open(struct nodal *nodal, int dimension, enum integration_form rule, enum gradient_form gradient, size_t count,
                     double *const *x, const double *volume, const double *const *moment, const struct rkpm_support *support, bool grows);
/* The same over cells that fit together, with rules that need them, mscni in two dimensions only; the nodes stay where they are. */
void rkpm_nodal_open_cells(struct nodal *nodal, enum integration_form rule, const struct cells *cells, double *const *x,
                           const struct rkpm_support *support);
void rkpm_nodal_close(struct nodal *nodal);

/* Makes the rows anew after places, volumes or moments have changed. Nodes are shared among the threads; the rows don't
 * depend on how many there are. Room only grows when a node gets more neighbours than any had before. */
void rkpm_nodal_renew(struct nodal *nodal);

/* Changes the number of nodes; then the rows are to be made anew. Room is kept, and grows where there are more nodes than before. */
void rkpm_nodal_resize(struct nodal *nodal, size_t count);

/* What row `row` of a node says along an axis, one number per neighbour; its weight; the neighbours; Psi_J at the node. */
static inline const double *rkpm_nodal_gradient(const struct nodal *nodal, size_t node, int row, int axis)
{
    return nodal->gradients + ((node * (size_t)nodal->rows + (size_t)row) * (size_t)nodal->dimension + (size_t)axis) * (size_t)nodal->stride;
}

static inline double rkpm_nodal_weight(const struct nodal *nodal, size_t node, int row)
{
    return nodal->weights[node * (size_t)nodal->rows + (size_t)row];
}

static inline const int32_t *rkpm_nodal_neighbour(const struct nodal *nodal, size_t node)
{
    return nodal->neighbour + node * (size_t)nodal->stride;
}

static inline const double *rkpm_nodal_value(const struct nodal *nodal, size_t node)
{
    return nodal->value + node * (size_t)nodal->stride;
}

/* sum Psi_J(x_I) f_J at a node, of a vector whose numbers along an axis are `stride` apart. */
THREADS_INLINE void rkpm_nodal_interpolate(const struct nodal *nodal, size_t node, const double *const of[3], size_t stride, double sum[3], const int d)
{
    const int32_t *neighbour = rkpm_nodal_neighbour(nodal, node);
    const double *value = rkpm_nodal_value(nodal, node);
    for (int a = 0; a < d; a++)
        sum[a] = 0;
    for (int k = 0; k < nodal->neighbours[node]; k++)
        for (int a = 0; a < d; a++)
            sum[a] += value[k] * of[a][(size_t)neighbour[k] * stride];
}

#endif
