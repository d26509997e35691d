/* SPDX-License-Identifier: GPL-3.0-or-later */
/* When closed particles open: layers of the build, their order inside a layer, and the steps. */
#ifndef PROCESS_SCHEDULE_H
#define PROCESS_SCHEDULE_H

#include "deck/scene.h"
#include "particles/columns.h"

struct schedule;

/* Finds the layer of every particle (COLUMN_LAYER, where the scene has it), and puts the particles in
 * memory into the order of their opening: those that are open at the start first, in the order of
 * their ids. Their number goes to *n_open. Particles that never open come last. */
struct schedule *schedule_open(const struct scene *scene, struct store *store, size_t *n_open);
void schedule_close(struct schedule *schedule);

/* Scan angle of a layer (from 0) in degrees; 0 where the deck gives none. */
double schedule_angle(const struct scene *scene, int32_t layer);

/* How many particles open at the start of a step (from 1): 0 between openings. Each number of a
 * step is to be asked for once, in order. */
size_t schedule_due(struct schedule *schedule, long step);

/* The step of the next opening, or 0 when none comes. */
long schedule_next_step(const struct schedule *schedule);

/* The step of the last opening; 0 without a schedule. */
long schedule_last_step(const struct schedule *schedule);

/* Goes to where `opened` particles have opened since the start; false when that is between two openings. */
bool schedule_skip(struct schedule *schedule, size_t opened);

/* Particles that are still to open. */
size_t schedule_left(const struct schedule *schedule);

#endif
