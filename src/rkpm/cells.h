/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells around nodes that fit together and fill a box: what is nearer to a node than to any other (Voronoi). */
#ifndef RKPM_CELLS_H
#define RKPM_CELLS_H

#include "rkpm/quadrature.h"
#include "rkpm/search.h"

#include <stdbool.h>

/* One face of a cell; in two dimensions an edge, and all of a cell's edges run counterclockwise. */
struct cell_face {
    double middle[3];
    double area[3];   /* times the outer normal */
    double corner[2]; /* where the edge begins */
    int axis, side;   /* of the box's face that it lies on, -1 low or +1 high; inside side is 0 */
};

struct cells {
    int dimension;
    size_t count;
    double *volume;
    double *moment[3];   /* second moments about the node, integral of (x_a - x_Ia)^2 */
    size_t *first;       /* per node: its first face; one more at the end */
    struct cell_face *face;
    size_t face_capacity;
    int most;            /* faces of a cell */
};

/* In two dimensions of any nodes x[axis][node] in the box that leave no gap wider than three spacings; in one and three of
 * the nodes of the box's lattice. */
void cells_open(struct cells *cells, const struct node_box *box, size_t count, double *const x[3]);
void cells_close(struct cells *cells);

#endif
