/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Static equilibrium, found directly (quas): Newton's method for the forces on the grid's nodes. Each step
 * solves K du = r with the elastic stiffness of the particles (multigrid) and conjugate gradients, and
 * lets the program's own passes strain and move the particles by du: laws, rotation, volumes and energies
 * are those of a time step. Where that does not lead there (plastic flow), motion with kinetic damping does. */
#ifndef MPM_EQUILIBRIUM_H
#define MPM_EQUILIBRIUM_H

#include "mpm/mpm.h"

enum equilibrium_state {
    EQUILIBRIUM_FOUND,
    EQUILIBRIUM_LOADED, /* loads act along a free motion of a body: there is none */
    EQUILIBRIUM_MISSED
};

/* How the last search went. */
struct equilibrium_report {
    enum equilibrium_state state;
    double residual;      /* length of the unbalanced nodal forces over the reference */
    double reference;     /* largest length of unbalanced forces at the start of a search so far */
    long newton_steps;
    long iterations;      /* of conjugate gradients */
    long damped_steps;    /* time steps with kinetic damping */
    long kept_particles;  /* that were kept in cells which they had left, as forces jump there, */
    double kept_distance; /* and how far they were out at most, in cells */
    long floating;        /* connected parts that float freely, */
    int floating_motions; /* free motions of the first of them, */
    int32_t floating_body; /* and a body of it */
    double worst[3];      /* place of the node with the largest unbalanced force */
    long particle;        /* id of the one nearest to it */
    char cause[200], advice[200];
};

struct equilibrium;

/* For scenes with quas; NULL for others. */
struct equilibrium *equilibrium_open(const struct mpm *mpm);
void equilibrium_close(struct equilibrium *equilibrium);

/* Moves the particles to the static equilibrium of the present loads, as one step of the run: step is
 * counted, sums are renewed, velocities are zero; the time is the caller's. */
enum equilibrium_state mpm_equilibrate(struct mpm *mpm);

/* How the last one went; also what mpm_check would say of it. */
const struct equilibrium_report *equilibrium_report(const struct mpm *mpm);
struct instability equilibrium_check(const struct mpm *mpm);

/* What the next search takes from those before it. */
void equilibrium_exchange(struct mpm *mpm, struct checkpoint *checkpoint);

/* Applications of the stiffness to vectors since the start, and the seconds that the linear systems took. */
void equilibrium_cost(const struct mpm *mpm, long *applications, double *seconds);

#endif
