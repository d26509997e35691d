/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Who is near whom: lists of the particles within a distance, found through a grid of cells over the box of all
 * particles. Lists reach a skin farther than pairs act, and hold until particles have moved half of it.
 *
 * When lists are made anew particles are sorted by cell in memory. The order inside a list is that of memory, so
 * all follows from the places of the particles when the lists were made (COLUMN_LISTED_POSITION). */
#ifndef SPH_NEIGHBOURS_H
#define SPH_NEIGHBOURS_H

#include "particles/columns.h"

/* Particle i has the neighbours list[first[i]] ... list[first[i + 1] - 1], itself not among them. */
struct neighbour_lists {
    double reach; /* pairs nearer than this are in, with some more */
    int64_t *first;
    int32_t *list;
    size_t list_capacity;
};

struct neighbours {
    struct store *store;
    int dimension;
    double skin;
    double period_low, period; /* along x; 0: none */
    struct neighbour_lists near, wide; /* wide.reach 0: there is none */
    int32_t *cell_first, *cell_of, *order;
    double *sorted[3]; /* where particles were when they were listed, in this order */
    size_t cells_capacity;
    int cells[3];
    double low[3], cell_size[3];
    long builds;
    bool is_shared; /* threads share the work */
};

/* For the particles of `store`, which has COLUMN_LISTED_POSITION. Lists are not made yet. */
struct neighbours *neighbours_open(struct store *store, int dimension, double reach, double wide_reach, double skin);

/* Makes the scene repeat along x, from `low` on after `period`, which has to be longer than twice the reach of pairs.
 * Particles that leave at one end come in at the other when lists are made. Before the lists are made first. */
void neighbours_repeat(struct neighbours *neighbours, double low, double period);
void neighbours_close(struct neighbours *neighbours);

/* Makes the lists anew where particles have moved too far since the last time; returns whether it did: then
 * particles are at other places in memory. */
bool neighbours_follow(struct neighbours *neighbours);

/* Makes the lists from the places where particles were when they were made last, without sorting: after a
 * restart. */
void neighbours_restore(struct neighbours *neighbours);

/* Bytes that are held. */
size_t neighbours_bytes(const struct neighbours *neighbours);

#endif
