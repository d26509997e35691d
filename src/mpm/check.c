/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Notices a run that can't be trusted any more. Only sums of the step are looked at; particles
 * are searched when one of them is wrong. */
#include "mpm/mpm.h"

#include <math.h>
#include <stdio.h>

/* A step below this fraction of the first one is a slow blow-up. */
static const double LEAST_STEP_FRACTION = 1e-6;

/* Energy beyond this many times all that was given, for so many steps in a row, came from nowhere. Sound
 * runs stay below 0.4, also where two bodies that overlap begin to part. */
static const double ENERGY_FACTOR = 4;
enum { GROWING_STEPS = 20 };

static bool is_finite_particle(const struct store *store, size_t p)
{
    double sum = store->real[COLUMN_VOLUME][0][p] + store->real[COLUMN_ENERGY][0][p];
    for (int a = 0; a < 3; a++)
        sum += store->real[COLUMN_POSITION][a][p] + store->real[COLUMN_VELOCITY][a][p];
    for (int a = 0; a < 6; a++)
        sum += store->real[COLUMN_STRESS][a][p];
    return isfinite(sum);
}

static bool is_closed(const struct mpm *mpm, size_t id)
{
    return mpm->store->index_of_id[id] >= mpm->cells->count;
}

static long first_not_finite(const struct mpm *mpm)
{
    const struct store *store = mpm->store;
    for (size_t id = 0; id < store->count; id++)
        if (!is_closed(mpm, id) && !is_finite_particle(store, (size_t)store->index_of_id[id]))
            return (long)id;
    return -1;
}

static long fastest_particle(const struct mpm *mpm)
{
    const struct store *store = mpm->store;
    double fastest = -1;
    long found = -1;
    for (size_t id = 0; id < store->count; id++)
        for (int a = 0; a < 3 && !is_closed(mpm, id); a++) {
            double speed = fabs(store->real[COLUMN_VELOCITY][a][store->index_of_id[id]]);
            if (speed > fastest) {
                fastest = speed;
                found = (long)id;
            }
        }
    return found;
}

static long least_volume_particle(const struct mpm *mpm)
{
    const struct store *store = mpm->store;
    double least = INFINITY;
    long found = -1;
    for (size_t id = 0; id < store->count; id++) {
        double volume = store->real[COLUMN_VOLUME][0][store->index_of_id[id]];
        if (is_closed(mpm, id) || !(volume < least))
            continue;
        least = volume;
        found = (long)id;
    }
    return found;
}

static bool are_finite(const struct sums *sums)
{
    return isfinite(sums->kinetic + sums->internal + sums->momentum[0] + sums->momentum[1] + sums->momentum[2]
                    + sums->fastest);
}

/* Stress changes that are no strain do work that nobody counts. */
static bool has_uncounted_work(const struct mpm *mpm)
{
    for (size_t i = 0; i < mpm->scene->n_materials; i++) {
        const struct scene_transformation *transformation = &mpm->scene->materials[i].transformation;
        if (transformation->has_residual || transformation->has_phase || transformation->has_heat)
            return true;
    }
    return false;
}

void mpm_watch_energy(struct mpm *mpm)
{
    mpm->energy_supply = fmax(mpm->energy_supply, fabs(mpm->start_energy) + fabs(mpm->external_work));
    const bool is_beyond = mpm->energy_supply > 0 && mpm->unbalanced > ENERGY_FACTOR * mpm->energy_supply;
    mpm->growing_steps = is_beyond && !has_uncounted_work(mpm) ? mpm->growing_steps + 1 : 0;
}

/* The messages: each fills the instability when its trouble is there. */

static bool find_not_finite(const struct mpm *mpm, struct instability *result)
{
    if (are_finite(&mpm->sums))
        return false;
    result->particle = first_not_finite(mpm);
    snprintf(result->cause, sizeof result->cause, "a value is not finite");
    return true;
}

static bool find_leap(const struct mpm *mpm, struct instability *result)
{
    const double cells = mpm->sums.fastest * fmax(mpm->taken_step, mpm->time_step) / mpm->scene->cell_size;
    if (cells <= 1)
        return false;
    result->particle = fastest_particle(mpm);
    snprintf(result->cause, sizeof result->cause, "a particle moves %.3g cells a step", cells);
    if (mpm->step == 1)
        snprintf(result->advice, sizeof result->advice,
                 "the first step does not know the speed of particles: try dtsc %.2g", 0.2 * mpm->scene->step_scale / cells);
    return true;
}

static bool find_used_up(const struct mpm *mpm, struct instability *result)
{
    if (mpm->sums.least_volume > 0)
        return false;
    result->particle = least_volume_particle(mpm);
    snprintf(result->cause, sizeof result->cause, "a particle's volume is %.3g", mpm->sums.least_volume);
    if (mpm->scene->scheme != SCHEME_USL)
        snprintf(result->advice, sizeof result->advice, "try a smaller dtsc; a body crushed beyond its law's reach also does this");
    return true;
}

static bool find_small_step(const struct mpm *mpm, struct instability *result)
{
    const double floor = mpm->scene->least_step;
    if (mpm->time_step >= (floor > 0 ? floor : LEAST_STEP_FRACTION * mpm->first_time_step))
        return false;
    result->particle = fastest_particle(mpm);
    snprintf(result->cause, sizeof result->cause,
             "the time step fell to %.3g, %.3g of the first one, as a particle has speed %.3g", mpm->time_step,
             mpm->time_step / mpm->first_time_step, mpm->sums.fastest);
    if (floor > 0)
        snprintf(result->advice, sizeof result->advice, "a smaller dtmi lets it go on");
    return true;
}

static bool find_growth(const struct mpm *mpm, struct instability *result)
{
    if (mpm->growing_steps < GROWING_STEPS)
        return false;
    result->particle = fastest_particle(mpm);
    snprintf(result->cause, sizeof result->cause,
             "energy grows by itself: %.3g more than the start and external forces gave, %.3g", mpm->unbalanced,
             mpm->energy_supply);
    snprintf(result->advice, sizeof result->advice, "%s",
             mpm->scene->interpolation == INTERPOLATION_LINEAR ? "try a smaller dtsc, or gimp or bimp where particles cross cells"
                                                               : "try a smaller dtsc");
    return true;
}

static bool find_lost(const struct mpm *mpm, struct instability *result)
{
    const int32_t lost = mpm->cells->count - mpm->cells->in_cells;
    if (mpm->scene->lost != LOST_STOP || lost == 0)
        return false;
    result->particle = mpm->store->integer[COLUMN_ID][mpm->cells->order[mpm->cells->in_cells]];
    snprintf(result->cause, sizeof result->cause, "%d particles left the grid", lost);
    snprintf(result->advice, sizeof result->advice, "take a larger grid, or lost keep or lost drop");
    return true;
}

struct instability mpm_check(const struct mpm *mpm)
{
    static bool (*const finders[])(const struct mpm *, struct instability *) = {
        find_not_finite, find_leap, find_used_up, find_small_step, find_growth, find_lost};
    struct instability result;
    result.is_stopped = false;
    result.particle = -1;
    result.advice[0] = 0;
    for (size_t i = 0; i < sizeof finders / sizeof finders[0] && !result.is_stopped; i++)
        result.is_stopped = finders[i](mpm, &result);
    if (result.is_stopped && !result.advice[0])
        snprintf(result.advice, sizeof result.advice, "%s",
                 mpm->scene->scheme == SCHEME_USL ? "try a smaller dtsc, musl, or lite with usl, which is unstable at nodes of small mass"
                                                  : "try a smaller dtsc");
    return result;
}

/* More than this share of the energy from nowhere, and numbers that depend on it are wrong. */
static const double DOUBTFUL_GAIN = 0.1;

bool mpm_has_gained_energy(const struct mpm *mpm)
{
    return mpm_energy_error(mpm) > DOUBTFUL_GAIN && !has_uncounted_work(mpm);
}

double mpm_energy_error(const struct mpm *mpm)
{
    double energy = mpm->sums.kinetic + mpm->sums.internal + mpm->removed_energy;
    double largest = fmax(fmax(fabs(energy), fabs(mpm->start_energy)), fabs(mpm->external_work));
    return largest > 0 ? mpm->unbalanced / largest : 0;
}
