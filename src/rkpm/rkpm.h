/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Problems on reproducing kernel particles: nodes, shape functions, integration over cells, constraints, one linear
 * system; the same problem on one set of nodes after another. */
#ifndef RKPM_RKPM_H
#define RKPM_RKPM_H

#include "base/banded.h"
#include "base/envelope.h"
#include "base/instability.h"
#include "base/timers.h"
#include "deck/scene.h"
#include "rkpm/creep.h"
#include "rkpm/deformation.h"
#include "rkpm/field.h"
#include "rkpm/quadrature.h"
#include "rkpm/shape.h"
#include "rkpm/solver.h"

struct checkpoint;

/* The linear system of a level: a number for each node, and one for each multiplier behind that of its node. */
struct rkpm_system {
    int32_t count;
    int32_t *of_node;       /* per node: its unknown */
    int32_t *of_multiplier; /* per node: the unknown of its multiplier; -1: it has none */
    bool is_definite;       /* symmetric and positive: by the envelope, else the band */
    struct envelope envelope;
    struct banded banded;
    double *right;
    double bytes;
};

/* What came out of a level. */
struct rkpm_result {
    double l2, h1;           /* norms of the error; H1: of the error and its gradient */
    double l2_relative;      /* over that of the exact solution */
    double l2_along[3], energy; /* of displacements by axis; of strains, over the energy of the exact ones */
    double tip;              /* displacement over the exact one, along the last axis, in the middle of the high face along x */
    double l2_rate, h1_rate; /* orders between the level before and this one; 0 for the first */
    long enlarged, lowered;  /* points with larger supports, or a lower order */
};

/* A problem on one set of nodes. */
struct rkpm_level {
    struct node_box box;
    size_t count;
    double *x[3];
    struct rkpm_shape shape;
    double beta;             /* of penalty and Nitsche's method */
    double *coefficient;     /* d; of elastic problems as many per node as there are axes */
    struct rkpm_system system;
    struct body body;      /* of elastic problems, with the solver of its system */
    struct solver solver;
    struct rkpm_result result;
};

struct rkpm {
    const struct scene *scene;
    const struct scene_rkpm *words;
    struct timers *timers;
    struct store *store;     /* the nodes of the last level */
    struct field field;
    struct deformation deformation; /* of elastic problems */
    int gauss, boundary_gauss, norm_gauss; /* points per axis */
    struct rkpm_level *levels;
    size_t n_levels;
    struct creep creep;      /* of problems in time, on one level */
    double load, tip;        /* of their last step: the load's factor, the displacement along the last axis, as rkpm_result.tip */
    double time;             /* each level counts 1 */
    long step;               /* levels or steps that are done */
    double updates;          /* nodes of them */
    struct instability instability;
};

struct rkpm *rkpm_open(const struct scene *scene, struct timers *timers);
void rkpm_close(struct rkpm *rkpm);

/* Solves the problem on the next level, and measures its error. */
struct instability rkpm_advance(struct rkpm *rkpm);

/* The state between two levels, to or from a checkpoint. */
void rkpm_exchange(struct rkpm *rkpm, struct checkpoint *checkpoint);

/* --- parts --- */

/* Ends the problem, as even linear functions can't be kept at a point; the message says where. */
void rkpm_stop_at(struct rkpm *rkpm, const double x[3]);

/* Shape functions at a point; where even linear functions can't be kept the problem ends. */
const struct shape_row *rkpm_row(struct rkpm *rkpm, struct rkpm_level *level, const double x[3], enum gradient_form gradient);

/* Makes room for the system of a level, sums it up, solves it. */
void rkpm_system_open(struct rkpm *rkpm, struct rkpm_level *level);
void rkpm_system_close(struct rkpm_system *system);
void rkpm_system_solve(struct rkpm *rkpm, struct rkpm_level *level);

/* The same of elastic problems; their norms; displacements for output. */
void rkpm_elastic_open(struct rkpm *rkpm, struct rkpm_level *level);
void rkpm_elastic_close(struct rkpm_level *level);
void rkpm_elastic_solve(struct rkpm *rkpm, struct rkpm_level *level);
void rkpm_elastic_measure(struct rkpm *rkpm, struct rkpm_level *level);
void rkpm_elastic_show(struct rkpm *rkpm, struct rkpm_level *level);

/* The next step of a problem in time. */
void rkpm_elastic_step(struct rkpm *rkpm, struct rkpm_level *level);

/* Whether there is a level or step to come. */
bool rkpm_goes_on(const struct rkpm *rkpm);

/* Takes the wave number of a level into the exact solution. */
void rkpm_set_field(struct rkpm *rkpm, const struct rkpm_level *level);

/* Norms of the error of a level. */
void rkpm_measure(struct rkpm *rkpm, struct rkpm_level *level);

#endif
