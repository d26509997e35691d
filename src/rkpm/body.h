/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elastic bodies of small strains on reproducing kernel particles: D unknowns per node, the matrix
 *     K = sum over points and rows of w T^T D B,   T = B + correction (spec rkpm 3.7) where there is one, else B,
 * and how displacements are held at sides of the box (spec 4). Rows of the matrix follow the box's axis with most nodes last,
 * so that its band is narrow. */
#ifndef RKPM_BODY_H
#define RKPM_BODY_H

#include "base/sparse.h"
#include "deck/scene_rkpm.h"
#include "rkpm/held.h"
#include "rkpm/points.h"

/* Stress lambda tr(eps) I + 2 mu eps of a plane or body; of plane stress with its lambda. */
struct moduli {
    double lambda, mu;
};

/* Of Young's modulus E and Poisson's ratio nu; in one dimension the stress is uniaxial. */
struct moduli body_moduli(int dimension, enum plane_mode mode, double young, double poisson);

struct body {
    int dimension;
    size_t nodes;
    const struct node_box *box;
    double *const *x;
    enum constraint_form constraint;
    double beta;          /* of penalty and Nitsche's method */
    struct rkpm_support support;
    bool has_cells, has_nodal, is_symmetric;
    struct cells cells;
    struct nodal nodal;
    struct points inside, faces;
    bool *is_held;        /* per point on a face: displacements are given, else tractions */
    double *given;        /* per point on a face D numbers */
    double *correction;   /* of test functions' gradients, per node D numbers; or NULL */
    int32_t *number;      /* per node: its row of the matrix */
    int32_t *node;        /* per row */
    struct sparse matrix;
    struct held held;
    int32_t **mark;       /* per thread room for a number per node */
    int n_marks;
};

/* Points, numbering and the matrix's structure of nodes x[axis][node], on the box's lattice in its order or anywhere; nothing is
 * given at the faces yet. */
void body_open(struct body *body, const struct scene_rkpm *words, const struct node_box *box, size_t nodes, double *const *x,
                const struct rkpm_shape *shape, int gauss, int boundary_gauss, double beta);
void body_close(struct body *body);

/* Sums up the matrix: points inside, and with penalty and Nitsche's method what is held. */
void body_assemble(struct body *body, struct moduli moduli);

/* Right side, D numbers per row: tractions that are given, what Nitsche's method or the penalty adds for displacements. */
void body_load(const struct body *body, struct moduli moduli, double *right);

/* right += sum of w N weight: a force per volume, the same everywhere. */
void body_add_weight(const struct body *body, const double weight[3], double *right);

/* right -= sum of w T^T stress; stress: per point and row of `inside` D x D numbers. */
void body_subtract_forces(const struct body *body, const double *stress, double *right);

/* D numbers per node from those per row of the matrix. */
void body_by_nodes(const struct body *body, const double *by_rows, double *by_nodes);

#endif
