/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nodes that open in time, as filaments are laid one on another: the schedule is that of particles (process/schedule). Nodes stand in
 * the order of their opening, so that those that take part are the first ones. New nodes are at their places of the deck, with
 * the velocity of the start and without stress; from then on shape functions are those of old and new nodes together. */
#include "base/checkpoint.h"
#include "base/memory.h"
#include "process/schedule.h"
#include "rkpm/dynamic.h"

#include <math.h>

void rkpm_dynamic_layers_open(struct dynamic *dynamic)
{
    const struct store *store = dynamic->store;
    if (!dynamic->scene->building.has_ghosts)
        return;
    dynamic->schedule = schedule_open(dynamic->scene, dynamic->store, &dynamic->open_at_start);
    for (int a = 0; a < 3; a++)
        for (size_t n = 0; n < store->count; n++)
            dynamic->rest[a][n] = store->real[COLUMN_INITIAL_POSITION][a][n];
    dynamic->count = dynamic->nodes = dynamic->open_at_start;
    dynamic->fixed.shown = (int32_t)dynamic->count;
}

void rkpm_dynamic_layers_close(struct dynamic *dynamic)
{
    schedule_close(dynamic->schedule);
}

/* The next nodes take part. What they bring along is no growth of energy. */
static void admit(struct dynamic *dynamic, size_t n)
{
    const double given = rkpm_dynamic_given(dynamic), before = dynamic->sums.kinetic;
    dynamic->count += n;
    dynamic->fixed.shown = (int32_t)dynamic->count;
    rkpm_dynamic_renew(dynamic);
    rkpm_dynamic_forces(dynamic);
    rkpm_dynamic_sum(dynamic);
    dynamic->start_energy = given + dynamic->sums.kinetic - before;
    for (int a = 0; a < 3; a++)
        dynamic->start_centre[a] = dynamic->sums.centre[a];
}

void rkpm_dynamic_layers(struct dynamic *dynamic)
{
    const size_t due = dynamic->schedule ? schedule_due(dynamic->schedule, dynamic->step + 1) : 0;
    if (due > 0)
        admit(dynamic, due);
}

size_t rkpm_dynamic_closed(const struct dynamic *dynamic)
{
    return dynamic->schedule ? schedule_left(dynamic->schedule) : 0;
}

void rkpm_dynamic_layers_exchange(struct dynamic *dynamic, struct checkpoint *checkpoint)
{
    size_t count = dynamic->count;
    if (!dynamic->schedule)
        return;
    checkpoint_item(checkpoint, "open nodes", &count, sizeof count, 1);
    if (!checkpoint_is_reading(checkpoint) || !checkpoint_is_good(checkpoint))
        return;
    if (count < dynamic->open_at_start || !schedule_skip(dynamic->schedule, count - dynamic->open_at_start)) {
        checkpoint_reject(checkpoint, "open nodes");
        return;
    }
    dynamic->count = dynamic->nodes = count;
    dynamic->fixed.shown = (int32_t)count;
}
