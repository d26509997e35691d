/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a run of smoothed particles is between two steps: particles in the order of memory, and numbers that go on.
 * Neighbours' lists follow from where particles were when they were listed. */
#include "base/checkpoint.h"
#include "sph/sph.h"

#include <stddef.h>

#define FIELD(name) {#name, offsetof(struct sph, name), sizeof(((struct sph *)NULL)->name)}

static const struct {
    const char *name;
    size_t offset, size;
} fields[] = {
    FIELD(step),       FIELD(time),         FIELD(time_step),    FIELD(taken_step), FIELD(first_time_step),
    FIELD(stable_step), FIELD(sound_speed), FIELD(updates),     FIELD(budget),     FIELD(start_heat),
    FIELD(wanted_sound),
};

/* Whether particles of a body can be in a state. */
static bool can_be(const struct sph_body *body, int32_t state)
{
    if (body->wall)
        return state == SPH_WALL;
    return state == SPH_FLUID || state == SPH_REMOVED || (state == SPH_SOLID && body->properties->melts);
}

/* Whether states that were read can be, and as many are removed as the budget says. */
static bool are_sound(const struct sph *sph)
{
    const int32_t *state = sph->store->integer[COLUMN_STATE], *body = sph->store->integer[COLUMN_BODY];
    long removed = 0;
    for (size_t p = 0; p < sph->store->count; p++) {
        if (!can_be(&sph->bodies[body[p]], state[p]))
            return false;
        removed += state[p] == SPH_REMOVED;
    }
    return removed == sph->budget.removed;
}

void sph_exchange(struct sph *sph, struct checkpoint *checkpoint)
{
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++)
        checkpoint_item(checkpoint, fields[i].name, (char *)sph + fields[i].offset, fields[i].size, 1);
    checkpoint_item(checkpoint, "body_heat", sph->body_heat, sizeof *sph->body_heat, sph->scene->n_bodies);
    store_exchange(sph->store, checkpoint, sph->scene->n_bodies);
    if (checkpoint_is_reading(checkpoint) && checkpoint_is_good(checkpoint) && !are_sound(sph))
        checkpoint_reject(checkpoint, "states");
    long builds = sph->neighbours->builds;
    checkpoint_item(checkpoint, "builds", &builds, sizeof builds, 1);
    if (!checkpoint_is_reading(checkpoint) || !checkpoint_is_good(checkpoint))
        return;
    sph_bind(sph);
    if (builds > 0)
        neighbours_restore(sph->neighbours);
    sph->neighbours->builds = builds;
}
