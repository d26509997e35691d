/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a deck says of reproducing kernel particles: the block rkpm. */
#ifndef DECK_SCENE_RKPM_H
#define DECK_SCENE_RKPM_H

#include "deck/scene_dynamic.h"
#include "deck/text.h"
#include "material/maxwell.h"

#include <stdbool.h>
#include <stddef.h>

enum basis_form { BASIS_LINEAR, BASIS_BILINEAR, BASIS_QUADRATIC };
/* Of shape functions along an axis (spec rkpm 2.1). */
enum kernel_form { KERNEL_CUBIC, KERNEL_QUINTIC, KERNEL_EXPONENTIAL };
enum gradient_form { GRADIENT_DIRECT, GRADIENT_IMPLICIT, GRADIENT_NONE };
/* Where the domain is integrated: Gauss points of cells, or the nodes (spec rkpm 3): directly (dni), with gradients smoothed
 * over boxes that don't fit together (snni) or over cells that do (scni); with gradients' gradients behind those of dni
 * (nsni) or of scni (nsci), with those of a cell's triangles behind those of scni (mscni). */
enum integration_form {
    INTEGRATION_GAUSS,
    INTEGRATION_DNI,
    INTEGRATION_SNNI,
    INTEGRATION_NSNI,
    INTEGRATION_SCNI,
    INTEGRATION_NSNI_SCNI,
    INTEGRATION_MSCNI
};
enum rkpm_problem { PROBLEM_APPROXIMATION, PROBLEM_HELMHOLTZ, PROBLEM_POISSON, PROBLEM_ELASTIC, PROBLEM_CREEP, PROBLEM_DYNAMIC };
enum plane_mode { PLANE_STRESS, PLANE_STRAIN };

/* Exact solutions: product of sines, exponential of the product of coordinates, sine wave that is 1 at the low end and 0 at
 * the high one, linear function; displacements that are linear, and those of Timoshenko's cantilever; no solution, but a load on
 * the high side along x. */
enum rkpm_function { FUNCTION_SINE, FUNCTION_EXPONENTIAL, FUNCTION_WAVE, FUNCTION_LINEAR, FUNCTION_PATCH, FUNCTION_BEAM, FUNCTION_LOAD };

/* How values at the boundary are prescribed. */
enum constraint_form { CONSTRAINT_TRANSFORMATION, CONSTRAINT_LAGRANGE, CONSTRAINT_PENALTY, CONSTRAINT_NITSCHE };

enum { RKPM_BOX = 9, RKPM_ELEMENTS = 8, RKPM_LOADS = 32 }; /* numbers of `node box` in three dimensions; most elements, load steps */

struct scene_rkpm {
    long dimension;
    enum basis_form basis;
    enum kernel_form kernel;
    enum gradient_form gradient;
    enum integration_form integration;
    double support[3];    /* a: support radius over the spacing, by axis */
    int n_support;        /* numbers given: 0, 1 (of all axes) or as many as axes */
    double box[6];        /* x0 x1 y0 y1 z0 z1 */
    long numbers[3];      /* of nodes along the axes, those on the boundary included */
    int n_box;            /* numbers given */
    double box_read[RKPM_BOX]; /* as they stand */
    struct deck_place box_places[RKPM_BOX], support_places[3];
    long *refinements;    /* numbers of nodes along x, from problem to problem */
    struct deck_place *refinement_places;
    size_t n_refinements, refinements_capacity, refinement_places_capacity;
    long (*levels)[3];    /* numbers of nodes of one problem after another: of `node`, or of each refinement */
    size_t n_levels;
    enum rkpm_problem problem;
    enum rkpm_function function;
    double wave_number;
    bool wave_over_spacing; /* it is divided by the spacing along x */
    long gauss, boundary_gauss, norm_gauss; /* points per cell and axis, per boundary segment, of norms; 0: the default */
    enum constraint_form constraint;
    double beta;          /* of penalty and Nitsche's method */
    bool beta_over_spacing;
    struct scene_dynamic dynamic;
    bool is_consistent;   /* test functions' gradients are corrected (vci) */
    double young, poisson; /* consecutive: read as one list */
    enum plane_mode plane;
    double beam_load;     /* of func beam, along y at its free end */
    double weight[3];     /* force per volume of creep */
    bool held[6];         /* sides where displacements are given: low and high of each axis */
    double elements[RKPM_ELEMENTS][2]; /* of creep: Young's modulus and relaxation time */
    int n_elements;
    enum maxwell_rule rule;
    bool relaxes_volume;
    double end_time, time_step; /* consecutive */
    double loads[RKPM_LOADS][2]; /* from when on the load is multiplied by how much */
    struct deck_place load_places[RKPM_LOADS];
    int n_loads;
    char *file;           /* nodes of a file, or NULL */
    double (*places)[3];  /* of those nodes */
    size_t n_places, place_capacity;
    double jitter[2];     /* random moves of inner nodes, in spacings; the seed */
    struct deck_place place; /* of the word rkpm */
};

/* Whether displacements of a body at rest are looked for. */
static inline bool scene_rkpm_has_body(const struct scene_rkpm *rkpm)
{
    return rkpm->problem == PROBLEM_ELASTIC || rkpm->problem == PROBLEM_CREEP;
}

/* Gauss points of a cell along an axis. */
static inline int scene_rkpm_gauss(const struct scene_rkpm *rkpm)
{
    return rkpm->gauss > 0 ? (int)rkpm->gauss : rkpm->basis == BASIS_QUADRATIC ? 5 : 2;
}

#endif
