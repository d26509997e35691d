/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gauss points in the cells between the nodes of a box, and on its faces. */
#ifndef RKPM_QUADRATURE_H
#define RKPM_QUADRATURE_H

#include "rkpm/box.h"

enum { QUADRATURE_MOST = 10 }; /* points per cell and axis */

/* A point: where it is, its weight, and on a face which way it looks. */
struct quadrature_point {
    double x[3], weight;
    int axis, side; /* of the outer normal: 0 1 2, -1 or +1; inside side is 0 */
    long cell[3];   /* that it is in or beside */
};

/* What is done at each point. */
typedef void quadrature_visit(void *context, const struct quadrature_point *point);

/* Places and weights of n points on -1 ... 1 (Legendre's). */
void quadrature_rule(int n, double place[QUADRATURE_MOST], double weight[QUADRATURE_MOST]);

/* All points with n per axis of all cells; those of all faces. In one dimension the faces are the ends, with one point of
 * weight 1 each. */
void quadrature_inside(const struct node_box *box, int n, quadrature_visit *visit, void *context);
void quadrature_faces(const struct node_box *box, int n, quadrature_visit *visit, void *context);

#endif
