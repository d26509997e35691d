/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Grid nodes that particles barely reach, for static equilibrium. Such a node has next to no weight in the forces
 * and next to no stiffness along the surface, so its own equation would ask for displacements without bound; and
 * where a particle comes to its cell, forces would jump. Instead it follows the nodes beside it linearly, and its
 * force acts on them (as in aggregated and extended spaces on cut cells; Badia, Verdugo, Martin, Comput.
 * Methods Appl. Mech. Engrg 336, 2018). Linear fields, rigid motions among them, stay what they are. */
#ifndef MPM_LIGHT_NODES_H
#define MPM_LIGHT_NODES_H

#include "mpm/mpm.h"

/* u = sum of weight times u of the leading nodes; nodes are numbered block * 64 + place in the block. */
struct light_node {
    int32_t node;
    int32_t leader[3];
    double weight[3];
};

struct light_nodes {
    struct light_node *nodes; /* leaders of a node are heavy or come before it */
    int32_t count;
    uint8_t *is_light; /* per node of the grid */
    size_t nodes_capacity, light_capacity;
};

void light_nodes_close(struct light_nodes *light);

/* Finds them by the masses on the grid; part_of_node (rigid.h) tells which nodes have particles around. */
void light_nodes_find(struct light_nodes *light, const struct mpm *mpm, const int32_t *part_of_node);

/* Gives the light nodes of a vector ([block][3][64]) the displacements that follow from the others; a direction that
 * is held (bits in `fixed`, per node) stays zero. */
void light_nodes_follow(const struct light_nodes *light, const uint8_t *fixed, double *displacement);

/* The transpose: moves their forces to the leading nodes. */
void light_nodes_lead(const struct light_nodes *light, const uint8_t *fixed, double *force);

/* Zeros in their place. */
void light_nodes_clear(const struct light_nodes *light, double *vector);

#endif
