/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stresses of a generalised Maxwell body at points of integration, for small strains (spec rkpm 5): a spring and elements,
 * whose step is that of the law maxw. In plane stress the strain across the plane follows from the stress there, 0. */
#ifndef RKPM_RELAXATION_H
#define RKPM_RELAXATION_H

#include "material/maxwell.h"
#include "rkpm/body.h"

enum { RELAXATION_TENSOR = 6 }; /* xx yy zz xy yz zx */

struct relaxation {
    int dimension;
    bool is_plane_stress;
    enum maxwell_rule rule;
    int elements;
    double spring_shear, spring_bulk; /* without elements; all of the bulk modulus where pressure does not relax */
    double shear[RKPM_ELEMENTS], bulk[RKPM_ELEMENTS], time[RKPM_ELEMENTS];
    size_t points;
    double *strain;  /* at the last step: per point RELAXATION_TENSOR numbers */
    double *element; /* stresses of elements: per point and element RELAXATION_TENSOR deviators, then the mean */
};

/* At rest, without strain. `young` is that at long times, elements' moduli come on top; all have one Poisson's ratio. */
void relaxation_open(struct relaxation *relaxation, const struct scene_rkpm *words, size_t points);
void relaxation_close(struct relaxation *relaxation);

/* What a strain increment gives in a step of a length, of plane stress condensed. */
struct moduli relaxation_moduli(const struct relaxation *relaxation, double time_step);

/* Stresses (D x D numbers per point) after a step to new strains (the same; NULL: those of the last step stay, as far as they lie in
 * the plane). `is_last`: they become those of the last step. */
void relaxation_step(struct relaxation *relaxation, double time_step, const double *strain, double *stress, bool is_last);

#endif
