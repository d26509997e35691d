/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One step of a moving body, as the list of dynamic.h, whether it can be trusted, and its state between steps. */
#include "rkpm/dynamic.h"
#include "base/checkpoint.h"

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>

/* A body squeezed to less than this part of its volume is no body any more (spec 7). */
static const double LEAST_RATIO = 0.05;
/* Energy that nothing gave. */
static const double MOST_ENERGY = 2;
/* A step below this fraction of the first one is a slow blow-up. */
static const double LEAST_STEP_FRACTION = 1e-6;

/* --- whether it can be trusted --- */

static void stop(struct dynamic *dynamic, const char *advice)
{
    dynamic->instability.is_stopped = true;
    dynamic->instability.particle = dynamic->sums.bad_node;
    snprintf(dynamic->instability.advice, sizeof dynamic->instability.advice, "%s", advice);
}

static double energy_of(const struct dynamic_sums *sums)
{
    return sums->kinetic + sums->internal + sums->wall_energy;
}

double rkpm_dynamic_given(const struct dynamic *dynamic)
{
    const double *gravity = dynamic->words->dynamic.gravity;
    double work = 0;
    for (int a = 0; a < dynamic->dimension; a++)
        work += dynamic->mass * (double)dynamic->count * gravity[a] * (dynamic->sums.centre[a] - dynamic->start_centre[a]);
    return dynamic->start_energy + fmax(work, 0);
}

/* Energy over what was given; 1 without any. */
static double energy_ratio(const struct dynamic *dynamic)
{
    const double given = rkpm_dynamic_given(dynamic);
    return given > 0 ? energy_of(&dynamic->sums) / given : 1;
}

static long fastest_node(const struct dynamic *dynamic)
{
    double most = -1;
    long fastest = -1;
    for (size_t n = 0; n < dynamic->count; n++) {
        double square = 0;
        for (int a = 0; a < dynamic->dimension; a++)
            square += dynamic->velocity[a][n] * dynamic->velocity[a][n];
        if (square > most) {
            most = square;
            fastest = (long)n;
        }
    }
    return fastest;
}

void rkpm_dynamic_start(struct dynamic *dynamic)
{
    dynamic->start_energy = energy_of(&dynamic->sums);
    for (int a = 0; a < 3; a++)
        dynamic->start_centre[a] = dynamic->sums.centre[a];
}

static void check(struct dynamic *dynamic)
{
    const struct scene *scene = dynamic->scene;
    const double least = scene->least_step > 0 ? scene->least_step : LEAST_STEP_FRACTION * dynamic->first_time_step;
    char *cause = dynamic->instability.cause;
    const size_t size = sizeof dynamic->instability.cause;
    dynamic->instability = (struct instability){.particle = -1};
    if (dynamic->sums.least_ratio < LEAST_RATIO) {
        dynamic->sums.bad_node = dynamic->sums.least_node;
        snprintf(cause, size, "the volume of a node is %.3g of that at the start", dynamic->sums.least_ratio);
        stop(dynamic, dynamic->words->integration == INTEGRATION_NSNI ? "try a softer wall, a stiffer material, or a smaller dtfx"
                      : scene->fixed_step > 0                         ? "try a smaller dtfx, a softer wall, or inte nsni"
                                                                      : "try a softer wall, or inte nsni");
    } else if (!dynamic->sums.is_finite) {
        snprintf(cause, size, "a value is not finite");
        stop(dynamic, scene->fixed_step > 0 ? "try a smaller dtfx, or leave it out" : "look at jmin and fewn, and at the numbers of the material");
    } else if (energy_ratio(dynamic) > MOST_ENERGY) {
        dynamic->sums.bad_node = fastest_node(dynamic);
        snprintf(cause, size, "energy grows: %.3g times what motion and gravity gave", energy_ratio(dynamic));
        stop(dynamic, scene->fixed_step > 0 ? "try a smaller dtfx, or leave it out" : "look at fewn, and at the numbers of the material");
    } else if (dynamic->time_step < least && dynamic->time + dynamic->time_step <= scene->end_time) {
        snprintf(cause, size, "the time step fell to %.3g, %.3g of the first one", dynamic->time_step, dynamic->time_step / dynamic->first_time_step);
        stop(dynamic, "look at jmin, and at the numbers of the material");
    } else if (dynamic->time_step <= 0.5 * DBL_EPSILON * scene->end_time) {
        snprintf(cause, size, "the time step %.3g is too small to come to the end, %.3g", dynamic->time_step, scene->end_time);
        stop(dynamic, "look at the numbers of the material, in the units of the deck");
    }
}

/* --- the step --- */

/* Velocities to the middle of the step, without those along a wall of nodes that stick to it; what they add to places. */
static void move_along(struct dynamic *dynamic, int axis)
{
    const struct scene_dynamic *words = &dynamic->words->dynamic;
    const bool sticks = words->wall_sticks && axis != words->wall_axis;
    const size_t lanes = (size_t)dynamic_lanes(dynamic->dimension);
    const double dt = dynamic->time_step, *restrict acceleration = dynamic->acceleration[axis], *restrict force = dynamic->wall_force;
    double *restrict x = dynamic->coefficient[axis], *restrict v = dynamic->velocity[axis], *restrict increment = dynamic->increment + axis;
#pragma omp for schedule(static) nowait
    for (size_t n = 0; n < dynamic->count; n++) {
        v[n] = sticks && force[n] > 0 ? 0 : v[n] + 0.5 * dt * acceleration[n];
        increment[n * lanes] = dt * v[n];
        x[n] += dynamic->is_semi ? 0 : dt * v[n];
    }
}

void rkpm_dynamic_move(struct dynamic *dynamic)
{
#pragma omp parallel if (dynamic->count >= DYNAMIC_FEW_NODES)
    for (int a = 0; a < dynamic->dimension; a++)
        move_along(dynamic, a);
}

static void finish_velocities(struct dynamic *dynamic)
{
#pragma omp parallel if (dynamic->count >= DYNAMIC_FEW_NODES)
    for (int a = 0; a < dynamic->dimension; a++) {
        double *restrict v = dynamic->velocity[a];
        const double *restrict acceleration = dynamic->acceleration[a];
#pragma omp for schedule(static) nowait
        for (size_t n = 0; n < dynamic->count; n++)
            v[n] += 0.5 * dynamic->time_step * acceleration[n];
    }
}

struct instability rkpm_dynamic_advance(struct dynamic *dynamic)
{
    timers_enter(dynamic->timers, PHASE_MOVE);
    rkpm_dynamic_layers(dynamic);
    rkpm_dynamic_move(dynamic);
    if (dynamic->is_semi)
        rkpm_dynamic_follow(dynamic);
    timers_enter(dynamic->timers, PHASE_STRESS);
    rkpm_dynamic_strain(dynamic);
    timers_enter(dynamic->timers, PHASE_FORCES);
    rkpm_dynamic_forces(dynamic);
    timers_enter(dynamic->timers, PHASE_MOVE);
    finish_velocities(dynamic);
    if (dynamic->follows_nodes)
        rkpm_dynamic_show(dynamic);
    else if (dynamic->follows_extent)
        rkpm_dynamic_places(dynamic);
    dynamic->step++;
    dynamic->time += dynamic->time_step;
    dynamic->updates += (double)dynamic->count;
    timers_enter(dynamic->timers, PHASE_SUMS);
    rkpm_dynamic_sum(dynamic);
    rkpm_dynamic_release(dynamic);
    dynamic->time_step = rkpm_dynamic_limit(dynamic);
    if (!dynamic->instability.is_stopped)
        check(dynamic);
    timers_enter(dynamic->timers, PHASE_OTHER);
    return dynamic->instability;
}

/* --- the state --- */

#define FIELD(name) {#name, offsetof(struct dynamic, name), sizeof(((struct dynamic *)NULL)->name)}

static const struct {
    const char *name;
    size_t offset, size;
} fields[] = {
    FIELD(step), FIELD(time), FIELD(time_step), FIELD(first_time_step), FIELD(updates), FIELD(sums), FIELD(fixed.is_released), FIELD(fixed.is_left_out),
    FIELD(start_energy), FIELD(start_centre),
};

/* Whether nodes that were read can be: numbers, and volumes that are more than nothing. */
static bool are_sound(const struct dynamic *dynamic)
{
    const double *volume = dynamic->store->real[COLUMN_VOLUME][0];
    for (size_t n = 0; n < dynamic->store->count; n++)
        if (!(isfinite(volume[n]) && volume[n] > 0 && isfinite(dynamic->volumes[n]) && dynamic->volumes[n] > 0))
            return false;
    for (int a = 0; a < dynamic->dimension; a++)
        for (size_t n = 0; n < dynamic->count; n++)
            if (!isfinite(dynamic->coefficient[a][n]) || !isfinite(dynamic->velocity[a][n]) || !isfinite(dynamic->acceleration[a][n]))
                return false;
    return isfinite(dynamic->time_step) && dynamic->time_step > 0;
}

void rkpm_dynamic_exchange(struct dynamic *dynamic, struct checkpoint *checkpoint)
{
    const size_t all = dynamic->store->count, terms = all * (size_t)(dynamic->dimension * dynamic->gradient_terms);
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++)
        checkpoint_item(checkpoint, fields[i].name, (char *)dynamic + fields[i].offset, fields[i].size, 1);
    rkpm_dynamic_layers_exchange(dynamic, checkpoint);
    store_exchange(dynamic->store, checkpoint, 1);
    for (int a = 0; a < dynamic->dimension; a++) {
        checkpoint_item(checkpoint, "coefficient", dynamic->coefficient[a], sizeof(double), dynamic->count);
        checkpoint_item(checkpoint, "rate", dynamic->velocity[a], sizeof(double), dynamic->count);
        checkpoint_item(checkpoint, "acceleration", dynamic->acceleration[a], sizeof(double), dynamic->count);
    }
    checkpoint_item(checkpoint, "wall_force", dynamic->wall_force, sizeof(double), dynamic->count);
    checkpoint_item(checkpoint, "load", dynamic->load, sizeof(double),
                    dynamic->count * dynamic_load_terms(dynamic));
    if (terms > 0)
        checkpoint_item(checkpoint, "gradient_stress", dynamic->gradient_stress, sizeof(double), terms);
    checkpoint_item(checkpoint, "volumes", dynamic->volumes, sizeof(double), all);
    checkpoint_item(checkpoint, "is_active", dynamic->fixed.is_active, sizeof *dynamic->fixed.is_active, all);
    if (!checkpoint_is_reading(checkpoint) || !checkpoint_is_good(checkpoint))
        return;
    if (!are_sound(dynamic))
        checkpoint_reject(checkpoint, "nodes");
    else if (dynamic->is_semi)
        rkpm_dynamic_renew(dynamic);
}
