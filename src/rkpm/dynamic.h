/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A body of reproducing kernel particles that moves in time (spec rkpm 7): finite strain, integration at the nodes, lumped
 * mass, central differences. What moves freely are the coefficients of the shape functions; the places of nodes follow
 * from them, x = sum Psi_J x_J. With the semi-Lagrangian kernel shape functions are those of the nodes' places of now, and
 * nodes themselves move by sum Psi_J dx_J. A step:
 *     1. velocities of coefficients to the middle of the step, and places by them; shape functions there, where they
 *        follow the nodes                                                     (rkpm_dynamic_move, rkpm_dynamic_follow)
 *     2. strain, volume and stress of nodes, and what of them goes into forces           (rkpm_dynamic_strain)
 *     3. forces on coefficients, of the inside and of the wall; accelerations            (rkpm_dynamic_forces)
 *     4. velocities to the end of the step; sums
 * Before it nodes may open                                                                (rkpm_dynamic_layers)
 * Vectors of nodes are stored node by node where many nodes read them. Sums over neighbours go in the order of nodes, so
 * that they don't depend on the number of threads. */
#ifndef RKPM_DYNAMIC_H
#define RKPM_DYNAMIC_H

#include "base/instability.h"
#include "base/timers.h"
#include "deck/scene.h"
#include "rkpm/nodal.h"

struct checkpoint;
struct schedule;

enum { DYNAMIC_FEW_NODES = 1000, DYNAMIC_MOST_LANES = 4 }; /* below these nodes one thread is faster */

/* Sums and extremes after a step. */
struct dynamic_sums {
    double kinetic, internal, wall_energy;
    double momentum[3], centre[3];
    double low[3], high[3];      /* of nodes' places, where curves show them */
    double angular, turn;        /* likewise */
    double least_ratio, most_ratio; /* J */
    double wall_force;
    long few_neighbours;         /* points with too few neighbours, those of a wall that carries nothing left out */
    long least_node;             /* that of least_ratio */
    long bad_node;               /* the first one with a value that is not finite; else least_node */
    bool is_finite;
};

/* Nodes of a wall that take part in the approximation (spec 8). They stand behind those of the body: in the store all of
 * them, in the rows those near the body, whose places in the store `slot` has. */
struct dynamic_fixed {
    size_t count;
    double low[3], high[3]; /* of their places */
    unsigned char *is_active; /* per place in the store: 1 for a node that carries stress */
    int is_released;        /* 1: the body has been let go */
    int is_left_out;        /* the same when the rows were made */
    int32_t shown;          /* nodes that output shows: those of the body */
};

/* Where each pair of a node's rows stands: those that belong to a coefficient, by nodes. */
struct dynamic_pairs {
    int32_t *first; /* per coefficient, one more at the end */
    int32_t *node;  /* whose row it is */
    int32_t *place; /* its place in the row */
    double *gradients; /* a copy of those in the rows, by pairs, rows, axes, where rows stay as they are; else NULL */
    double *force;     /* where rows change: what each node gives to each of its neighbours, in the order of the rows, `lanes` each */
    size_t capacity[3];
};

struct dynamic {
    const struct scene *scene;
    const struct scene_rkpm *words;
    const struct material *material;
    struct timers *timers;
    struct store *store;       /* places, velocities, stresses of nodes as output sees them */
    int dimension;
    bool is_semi;
    size_t count;              /* of the body, as far as they are open */
    struct schedule *schedule; /* of nodes that open, or NULL: all are */
    size_t open_at_start;
    bool follows_nodes, follows_extent, follows_turning; /* what curves show of each step: values of nodes, width and ends, turning */
    size_t nodes;              /* that have rows: those of the body, and of a wall near it */
    int32_t *slot;             /* per node with rows: its place in the store */
    struct dynamic_fixed fixed;
    double spacing, volume, mass; /* of a node, at the start */
    double *rest[3];           /* places at the start, in the order of the store */
    double *volumes;           /* of the rows */
    struct nodal nodal;
    struct dynamic_pairs pairs;

    double *coefficient[3];    /* places of coefficients; with the semi-Lagrangian kernel of nodes */
    double *velocity[3], *acceleration[3]; /* of them */
    double *increment;         /* of their places in the step, node by node, `lanes` each */
    double *load;              /* by nodes, rows, axes of the gradient: weight times stress, `lanes` each; its work is the internal energy */
    double *gradient_stress;   /* nsni, in the order of the store, by axes: `gradient_terms` each */
    int gradient_terms;
    double stabilisation;
    double *strain[6], *spin[3], *trace, *volume_before, *terms[2]; /* of the law's batch, in the order of the store */
    double *wall_force;        /* per node, along the wall's axis */

    long step;
    double time, time_step, first_time_step;
    double updates;
    double start_energy, start_centre[3]; /* what the check of energies starts from */
    struct dynamic_sums sums;
    struct instability instability;
};

/* Vectors that many nodes read are as long as registers are: of three dimensions the fourth number is 0. */
static inline int dynamic_lanes(int dimension)
{
    return dimension == 2 ? 2 : DYNAMIC_MOST_LANES;
}

/* Numbers of a node's loads. */
static inline size_t dynamic_load_terms(const struct dynamic *dynamic)
{
    return (size_t)(dynamic->nodal.rows * dynamic->dimension * dynamic_lanes(dynamic->dimension));
}

static inline double *dynamic_load(const struct dynamic *dynamic, size_t node, int row, const int dimension)
{
    return dynamic->load + (node * (size_t)dynamic->nodal.rows + (size_t)row) * (size_t)(dimension * dynamic_lanes(dimension));
}

struct dynamic *rkpm_dynamic_open(const struct scene *scene, struct timers *timers);
void rkpm_dynamic_close(struct dynamic *dynamic);
struct instability rkpm_dynamic_advance(struct dynamic *dynamic);

/* The state between two steps, to or from a checkpoint. */
void rkpm_dynamic_exchange(struct dynamic *dynamic, struct checkpoint *checkpoint);

/* --- parts --- */

/* Nodes that open: their order, those of the next step, their number in a checkpoint, how many are still closed. */
void rkpm_dynamic_layers_open(struct dynamic *dynamic);
void rkpm_dynamic_layers_close(struct dynamic *dynamic);
void rkpm_dynamic_layers(struct dynamic *dynamic);
void rkpm_dynamic_layers_exchange(struct dynamic *dynamic, struct checkpoint *checkpoint);
size_t rkpm_dynamic_closed(const struct dynamic *dynamic);

/* Lists of pairs by coefficient, from the rows as they are; with a copy of the gradients where these stay. */
void rkpm_dynamic_pairs(struct dynamic *dynamic);

void rkpm_dynamic_move(struct dynamic *dynamic);

/* Semi-Lagrangian kernel: moves nodes, and makes the rows anew. What is between two steps does so after a restart, but for
 * the motion. */
void rkpm_dynamic_follow(struct dynamic *dynamic);
void rkpm_dynamic_renew(struct dynamic *dynamic);

/* Whether the body is let go by a wall that pulls at it, or met again. */
void rkpm_dynamic_release(struct dynamic *dynamic);
void rkpm_dynamic_strain(struct dynamic *dynamic);
void rkpm_dynamic_forces(struct dynamic *dynamic);

/* Places of nodes from those of coefficients; with their velocities, for output: a step needs neither. */
void rkpm_dynamic_places(struct dynamic *dynamic);
void rkpm_dynamic_show(struct dynamic *dynamic);

/* Force over depth of a node in the wall's springs: pressure over depth times the face of a node. */
double rkpm_dynamic_stiffness(const struct dynamic *dynamic);

/* Force of the wall's springs per node, from places. */
void rkpm_dynamic_wall(struct dynamic *dynamic);

void rkpm_dynamic_sum(struct dynamic *dynamic);

/* Keeps the energy and the centre of the start. */
void rkpm_dynamic_start(struct dynamic *dynamic);

/* What energy motion at the start and gravity have given up to now. */
double rkpm_dynamic_given(const struct dynamic *dynamic);

/* What the next step is, by dtfx or by the wave that crosses the spacing of the most compressed node (spec 7), or less where nodes
 * meet a wall fast, or strain fast. */
double rkpm_dynamic_limit(const struct dynamic *dynamic);

#endif
