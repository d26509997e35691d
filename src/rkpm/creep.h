/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies whose stresses relax under loads that change by steps in time: a step solves one linear system, with the stresses that
 * the strains of the step before have relaxed to (spec rkpm 5.4); a change of the load is a step of no length. */
#ifndef RKPM_CREEP_H
#define RKPM_CREEP_H

#include "rkpm/relaxation.h"
#include "rkpm/solver.h"

struct checkpoint;

/* Moments between which the load stays as it is. */
struct creep_step {
    double time, length, load; /* at its end; the load as a factor */
};

struct creep {
    struct body *body;
    struct relaxation relaxation;
    struct creep_step *steps;
    size_t n_steps, next, step_capacity;
    struct solver solver[2];    /* of steps with a length and without */
    double solved_length[2];    /* of the step that its factors are for; below 0: none */
    int latest;                 /* whose matrix the body has */
    double *force;              /* of the whole load, by rows */
    double *right, *given;
    double *coefficient;        /* by rows */
    double *strain, *stress;    /* per point D x D numbers */
};

/* Steps of the words' length or a little less up to each change of the load and the end. */
void creep_open(struct creep *creep, const struct scene_rkpm *words, struct body *body);
void creep_close(struct creep *creep);

/* Takes the next step; false where its system can't be solved. */
bool creep_advance(struct creep *creep);

void creep_exchange(struct creep *creep, struct checkpoint *checkpoint);

#endif
