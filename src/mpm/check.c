/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Notices a run that can't be trusted any more. Only sums of the step are looked at; particles
 * are searched when one of them is wrong. */
#include "mpm/mpm.h"

#include <math.h>
#include <stdio.h>

/* A step below this fraction of the first one is a slow blow-up. */
static const double LEAST_STEP_FRACTION = 1e-6;

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

struct instability mpm_check(const struct mpm *mpm)
{
    struct instability result = {.particle = -1};
    const struct sums *sums = &mpm->sums;
    const char *smaller = "try a smaller dtsc";
    if (!are_finite(sums)) {
        result.particle = first_not_finite(mpm);
        snprintf(result.cause, sizeof result.cause, "a value is not finite");
    } else if (sums->least_volume <= 0) {
        result.particle = least_volume_particle(mpm);
        snprintf(result.cause, sizeof result.cause, "a particle's volume is %.3g", sums->least_volume);
        smaller = "try a smaller dtsc; a body crushed beyond its law's reach also does this";
    } else if (sums->fastest * mpm->time_step > mpm->scene->cell_size) {
        result.particle = fastest_particle(mpm);
        snprintf(result.cause, sizeof result.cause, "a particle moves %.3g cells a step",
                 sums->fastest * mpm->time_step / mpm->scene->cell_size);
    } else if (mpm->time_step < LEAST_STEP_FRACTION * mpm->first_time_step) {
        result.particle = fastest_particle(mpm);
        snprintf(result.cause, sizeof result.cause,
                 "the time step fell to %.3g of the first one, as a particle has speed %.3g",
                 mpm->time_step / mpm->first_time_step, sums->fastest);
        smaller = mpm->scene->scheme == SCHEME_USL ? "try musl; usl is unstable at nodes of small mass" : smaller;
    } else if (mpm->scene->lost == LOST_STOP && mpm->cells->in_cells < mpm->cells->count) {
        result.particle = mpm->store->integer[COLUMN_ID][mpm->cells->order[mpm->cells->in_cells]];
        snprintf(result.cause, sizeof result.cause, "%d particles left the grid", mpm->cells->count - mpm->cells->in_cells);
        smaller = "take a larger grid, or lost keep or lost drop";
    } else {
        return result;
    }
    result.is_stopped = true;
    snprintf(result.advice, sizeof result.advice, "%s", smaller);
    return result;
}

double mpm_energy_error(const struct mpm *mpm)
{
    double energy = mpm->sums.kinetic + mpm->sums.internal + mpm->removed_energy;
    double largest = fmax(fmax(fabs(energy), fabs(mpm->start_energy)), fabs(mpm->external_work));
    return largest > 0 ? mpm->unbalanced / largest : 0;
}
