/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Boxes of nodes on a lattice, and the order in which their nodes stand in matrices. */
#ifndef RKPM_BOX_H
#define RKPM_BOX_H

#include <stdbool.h>
#include <stddef.h>

/* Nodes in a box, x fastest; axes beyond the dimension have one node at 0. */
struct node_box {
    int dimension;
    long numbers[3];
    double low[3], spacing[3];
};

/* Whether a node lies on the boundary of the box. */
bool box_is_boundary(const struct node_box *box, size_t node);

/* Axes in the order of these numbers, smallest first; of equal ones in their own. */
void box_order_axes(const long numbers[3], int order[3]);

/* The n-th node, from 0, where those along the axis order[0] follow each other: with the axes' order by numbers of nodes the
 * rows of a matrix reach least far. */
size_t box_node(const struct node_box *box, const int order[3], size_t n);

#endif
