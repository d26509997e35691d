/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rigid motions that nothing holds: of each connected set of grid nodes, those of the six translations
 * and rotations that are zero in all held directions. Under them no stress changes, so static equilibrium
 * does not tell how far they go; they are taken out, weighted by the nodes' mass: the centre and the
 * orientation of what floats stay. */
#ifndef MPM_RIGID_H
#define MPM_RIGID_H

#include "mpm/mpm.h"

struct rigid_part;

struct rigid {
    int32_t *part_of_node; /* [block][64], -1 where no cell around has particles */
    struct rigid_part *parts;
    const uint8_t *leaves_out; /* per node, the caller's, or NULL */
    int32_t n_parts, n_floating; /* connected sets, and those of them with free motions */
    int motions;                 /* free motions of the first that floats */
    int32_t body;                /* body of a particle of it */
    size_t nodes_capacity, parts_capacity;
};

void rigid_close(struct rigid *rigid);

/* Finds the connected parts. */
void rigid_connect(struct rigid *rigid, const struct mpm *mpm);

/* Finds their free motions then. The grid holds the nodes' masses; nodes for which `leaves_out` is not 0 don't
 * count (NULL: all do). */
void rigid_find(struct rigid *rigid, const struct mpm *mpm, const uint8_t *leaves_out);

/* Takes the resultants along free motions out of nodal forces ([block][3][64]), as forces that grow with
 * mass; returns the length of what was taken. */
double rigid_remove_force(const struct rigid *rigid, const struct mpm *mpm, double *force);

/* Takes free motions out of nodal displacements. */
void rigid_remove_motion(const struct rigid *rigid, const struct mpm *mpm, double *displacement);

#endif
