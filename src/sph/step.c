/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One step of smoothed particles, as the list of sph.h. */
#include "sph/sph.h"

/* Velocities belong to the middle of steps: from one middle to the next it is half of both (spec 11). */
static double between_middles(const struct sph *sph)
{
    return sph->words->integrator == INTEGRATOR_PREDICTED && sph->step > 0 ? sph->time_step
                                                                            : 0.5 * (sph->taken_step + sph->time_step);
}

static void move_neighbours(struct sph *sph)
{
    timers_enter(sph->timers, PHASE_CELLS);
    if (neighbours_follow(sph->neighbours))
        sph_bind(sph);
}

/* Without heat and swelling they stay as they are since the start. */
static void find_properties(struct sph *sph)
{
    timers_enter(sph->timers, PHASE_HEAT);
    if (sph->words->heat != HEAT_OFF || sph->words->n_swellings > 0)
        heat_properties(sph);
}

/* Density and pressure at the places of now, from the velocities since the step before; walls follow. */
static void find_pressure(struct sph *sph)
{
    timers_enter(sph->timers, PHASE_DENSITY);
    flow_prepare(sph);
    flow_surroundings(sph);
    flow_gradients(sph);
    flow_density(sph, sph->words->freezes_flow ? 0 : sph->taken_step);
    flow_walls(sph);
}

static void find_forces(struct sph *sph)
{
    const struct scene_sph *words = sph->words;
    if (sph->band) {
        timers_enter(sph->timers, PHASE_SURFACE);
        surface_find(sph);
    }
    if (words->freezes_flow)
        return;
    timers_enter(sph->timers, PHASE_FORCES);
    flow_forces(sph);
    if (sph->band) {
        timers_enter(sph->timers, PHASE_SURFACE);
        surface_forces(sph);
    }
}

static void find_heat(struct sph *sph)
{
    if (sph->words->heat == HEAT_OFF)
        return;
    timers_enter(sph->timers, PHASE_HEAT);
    if (sph->words->beam.is_on)
        laser_deposit(sph);
    heat_flow(sph);
}

void sph_step(struct sph *sph)
{
    move_neighbours(sph);
    find_properties(sph);
    find_pressure(sph);
    find_forces(sph);
    find_heat(sph);

    timers_enter(sph->timers, PHASE_MOVE);
    flow_advance(sph, between_middles(sph), sph->time_step);
    if (sph->words->heat != HEAT_OFF)
        heat_advance(sph, sph->time_step);
    remove_outsiders(sph);
    remove_ejected(sph);
    sph->time += sph->time_step;
    sph->step++;
    sph->taken_step = sph->time_step;
    sph->updates += (double)sph->store->count;

    timers_enter(sph->timers, PHASE_SUMS);
    budget_update(sph);
    sound_adapt(sph);
    sph->time_step = limits_time_step(sph);
    timers_enter(sph->timers, PHASE_OTHER);
}
