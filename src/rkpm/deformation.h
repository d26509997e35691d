/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exact displacements of elastic bodies without body forces. */
#ifndef RKPM_DEFORMATION_H
#define RKPM_DEFORMATION_H

#include "deck/scene_rkpm.h"
#include "rkpm/body.h"

struct deformation {
    enum rkpm_function function;
    int dimension;
    double low[3], high[3];  /* of the body */
    double young, poisson;   /* of plane stress, also where the mode is plane strain: E/(1 - nu^2), nu/(1 - nu) */
    double load;             /* of the beam: along y at its end, per thickness; else along the last axis on the high side along x */
    struct moduli moduli;
};

struct deformation deformation_of(const struct scene_rkpm *words);

/* The displacement at x, its gradient u_a,b as gradient[a][b], the stress of a strain that has such a gradient; axes beyond the
 * dimension are zero. */
void deformation_value(const struct deformation *deformation, const double x[3], double u[3]);
void deformation_gradient(const struct deformation *deformation, const double x[3], double gradient[3][3]);
/* The traction at a point of a face of the box, whose outer normal is that side of an axis. */
void deformation_traction(const struct deformation *deformation, const double x[3], int axis, int side, double traction[3]);

void deformation_stress(int dimension, struct moduli moduli, double gradient[3][3], double stress[3][3]);

#endif
