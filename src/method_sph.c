/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Smoothed particles as a run sees them. */
#include "run.h"
#include "sph/sph.h"
#include "summary.h"

static void open_solver(struct run *run)
{
    struct sph *sph = run->sph = sph_open(run->scene, &run->timers, run->diagnostics);
    if (run->options.has_threads)
        sph_share_always(sph);
    run->store = sph->store;
    run->source = (struct result_source){.store = sph->store, .body_material = sph->material_of_body,
                                         .body_material_number = sph->material_number_of_body,
                                         .body_heat = sph->body_heat};
}

static void close_solver(struct run *run)
{
    sph_close(run->sph);
}

static struct instability advance(struct run *run)
{
    sph_step(run->sph);
    return sph_check(run->sph);
}

static void put_totals(const struct sph_budget *budget, double *value)
{
    value[TOTAL_KINETIC] = budget->kinetic;
    value[TOTAL_INTERNAL] = budget->internal;
    for (int a = 0; a < 3; a++)
        value[TOTAL_MOMENTUM_X + a] = budget->momentum[a];
    value[TOTAL_HEAT] = budget->heat;
    value[TOTAL_LASER_IN] = budget->laser_in;
    value[TOTAL_ABSORBED] = budget->absorbed;
    value[TOTAL_REFLECTED] = budget->reflected;
    value[TOTAL_TRANSMITTED] = budget->transmitted;
    value[TOTAL_RADIATED] = budget->radiated;
    value[TOTAL_EVAPORATED] = budget->evaporated;
    value[TOTAL_THROUGH_WALLS] = budget->through_walls;
    value[TOTAL_VISCOUS_HEAT] = budget->viscous_heat;
    value[TOTAL_VOLUME_HEAT] = budget->volume_heat;
    value[TOTAL_HOTTEST] = budget->hottest;
    value[TOTAL_FASTEST] = budget->fastest;
    value[TOTAL_REMOVED] = (double)budget->removed;
}

/* Whether a curve shows one of the totals from one to another. */
static bool shows_any(const struct scene *scene, enum total first, enum total last)
{
    for (size_t i = 0; i < scene->n_curves; i++)
        if (scene->curves[i].result->total >= first && scene->curves[i].result->total <= last)
            return true;
    return false;
}

/* In two dimensions the beam comes down along y, and the pool has no width. */
static void put_pool(const struct sph *sph, double *value)
{
    double extents[3];
    sph_pool(sph, extents);
    value[TOTAL_POOL_LENGTH] = extents[0];
    value[TOTAL_POOL_WIDTH] = sph->dimension == 3 ? extents[1] : 0;
    value[TOTAL_POOL_DEPTH] = extents[sph->dimension - 1];
}

static void put_track(const struct sph *sph, double *value)
{
    const struct sph_track track = sph_track(sph);
    value[TOTAL_FUSED_LENGTH] = track.zone[0];
    value[TOTAL_FUSED_WIDTH] = sph->dimension == 3 ? track.zone[1] : 0;
    value[TOTAL_PENETRATION] = track.penetration;
    value[TOTAL_ROUGHNESS] = track.roughness;
}

static void look(struct run *run)
{
    struct sph *sph = run->sph;
    run->course = (struct run_course){sph->step, sph->time, sph->time_step, sph->budget.removed};
    run->totals.time = sph->time;
    put_totals(&sph->budget, run->totals.value);
    if (shows_any(run->scene, TOTAL_DETACHED, TOTAL_DETACHED))
        run->totals.value[TOTAL_DETACHED] = (double)sph_detached(sph);
    if (shows_any(run->scene, TOTAL_POOL_LENGTH, TOTAL_POOL_DEPTH))
        put_pool(sph, run->totals.value);
    if (shows_any(run->scene, TOTAL_FUSED_LENGTH, TOTAL_ROUGHNESS))
        put_track(sph, run->totals.value);
}

static bool goes_on(const struct run *run)
{
    return run->sph->step == 0 || run->sph->time <= run->scene->end_time;
}

static int32_t lost_particle(const struct run *run, int32_t n)
{
    return run->store->index_of_id[run->sph->removed[n]];
}

static void exchange(struct run *run, struct checkpoint *checkpoint)
{
    sph_exchange(run->sph, checkpoint);
}

static double updates(const struct run *run)
{
    return run->sph->updates;
}

const struct method method_sph = {
    .name = "sph",
    .open = open_solver,
    .close = close_solver,
    .advance = advance,
    .look = look,
    .goes_on = goes_on,
    .lost_particle = lost_particle,
    .exchange = exchange,
    .print_scene = summary_sph_check,
    .print_start = summary_sph_start,
    .print_instability = summary_sph_instability,
    .print_end = summary_sph_end,
    .updates = updates,
};
