/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Points where a domain or its boundary is integrated, with the shape functions there: kept, as they are needed again for
 * stresses and from step to step. */
#ifndef RKPM_POINTS_H
#define RKPM_POINTS_H

#include "rkpm/cells.h"
#include "rkpm/nodal.h"
#include "rkpm/shape.h"

struct points {
    int dimension;
    size_t count;
    int rows;                  /* of gradients per point: 1, more with nodes that stabilise */
    int stride;                /* neighbours that a point has room for */
    int32_t *neighbours;       /* per point: how many nodes it has */
    int32_t *neighbour;        /* by points, stride each */
    double *value;             /* in the same way */
    double *gradients;         /* by points, rows, axes, stride each */
    double *weights;           /* by points, rows */
    double *x[3];
    int8_t *axis, *side;       /* of the outer normal, of points on faces */
    bool *is_lowered;          /* linear functions could not be kept */
    /* per node: which places of `neighbour` are it, in their order */
    size_t *first_use;
    size_t *use;
    bool is_owner;             /* of the arrays above; else they are those of nodes */
    long enlarged, lowered;
    double bad[3];             /* the first point where the order was lowered */
};

/* Gauss points of a box's cells, n per axis, or on its faces. */
void points_open_gauss(struct points *points, const struct rkpm_shape *shape, const struct node_box *box, size_t nodes, int n, bool on_faces,
                       enum gradient_form gradient);

/* Middles of cells' faces that lie on those of the box. */
void points_open_cell_faces(struct points *points, const struct rkpm_shape *shape, const struct cells *cells, enum gradient_form gradient);

/* The nodes themselves; `nodal` has to stay open and as it is. */
void points_open_nodes(struct points *points, const struct nodal *nodal);

void points_close(struct points *points);

static inline const double *points_gradient(const struct points *points, size_t point, int row, int axis)
{
    return points->gradients + ((point * (size_t)points->rows + (size_t)row) * (size_t)points->dimension + (size_t)axis) * (size_t)points->stride;
}

static inline double points_weight(const struct points *points, size_t point, int row)
{
    return points->weights[point * (size_t)points->rows + (size_t)row];
}

#endif
