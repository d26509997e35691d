/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Notices a run of smoothed particles that can't be trusted any more. */
#include "sph/sph.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

/* A step below this fraction of the first one is a slow blow-up. */
static const double LEAST_STEP_FRACTION = 1e-6;
/* Densities outside this range of their reference are no liquid any more. */
static const double THINNEST = 0.3, DENSEST = 2;

/* The particle for which `measure` is largest; NaN counts as largest. */
static long worst_particle(const struct sph *sph, double (*measure)(const struct sph *sph, size_t p))
{
    long found = -1;
    double most = -INFINITY;
    for (size_t id = 0; id < sph->store->count; id++) {
        const size_t p = (size_t)sph->store->index_of_id[id];
        if (sph->columns.state[p] == SPH_REMOVED)
            continue;
        const double value = measure(sph, p);
        if (isnan(value))
            return (long)id;
        if (value > most) {
            most = value;
            found = (long)id;
        }
    }
    return found;
}

static double not_finite(const struct sph *sph, size_t p)
{
    const struct sph_columns *c = &sph->columns;
    double sum = c->temperature[p] + c->density[p];
    for (int a = 0; a < 3; a++)
        sum += c->x[a][p] + c->v[a][p] + c->a[a][p];
    return isfinite(sum) ? 0 : NAN;
}

static double compression(const struct sph *sph, size_t p)
{
    return sph->columns.state[p] == SPH_FLUID ? sph->columns.density[p] / sph_rest_density(&sph->columns, p) : 1;
}

static double expansion(const struct sph *sph, size_t p)
{
    const bool is_told = sph->columns.state[p] == SPH_FLUID && compression(sph, p) >= sph->budget.least_density_ratio;
    return is_told ? -compression(sph, p) : -INFINITY;
}

static bool find_not_finite(const struct sph *sph, struct instability *result)
{
    if (sph->budget.is_finite)
        return false;
    result->particle = worst_particle(sph, not_finite);
    snprintf(result->cause, sizeof result->cause, "a value is not finite");
    return true;
}

static double thinness(const struct sph *sph, size_t p)
{
    return sph->columns.state[p] == SPH_FLUID ? -sph->columns.reference[p] : -INFINITY;
}

/* A table of densities that goes on along its last line may come to nothing. */
static bool find_no_reference(const struct sph *sph, struct instability *result)
{
    if (sph->budget.least_reference > 0)
        return false;
    result->particle = worst_particle(sph, thinness);
    snprintf(result->cause, sizeof result->cause, "the density without pressure of a particle is %.3g at its temperature",
             sph->budget.least_reference);
    snprintf(result->advice, sizeof result->advice, "give 'prop dens' rows for all temperatures, or leave its 'extr' out; look at swel");
    return true;
}

static bool find_leap(const struct sph *sph, struct instability *result)
{
    const double way = sph->budget.fastest * sph->taken_step / sph->smoothing;
    if (way <= 1)
        return false;
    result->particle = worst_particle(sph, sph_square_of_speed);
    snprintf(result->cause, sizeof result->cause, "a particle moves %.3g smoothing lengths a step", way);
    return true;
}

static bool find_density(const struct sph *sph, struct instability *result)
{
    const double least = sph->budget.least_density_ratio, most = sph->budget.most_density_ratio;
    if (!(least < THINNEST) && !(most > DENSEST))
        return false;
    result->particle = worst_particle(sph, most > DENSEST ? compression : expansion);
    snprintf(result->cause, sizeof result->cause, "the density of a particle is %.3g times that without pressure",
             most > DENSEST ? most : least);
    snprintf(result->advice, sizeof result->advice, "try a larger sound speed c0, or a smaller cfl");
    return true;
}

static double coldness(const struct sph *sph, size_t p)
{
    return -sph->columns.temperature[p];
}

/* Where the deck says that temperatures are in kelvin. */
static bool find_cold(const struct sph *sph, struct instability *result)
{
    if (!(sph->words->radiates || sph->words->evaporates) || !(sph->budget.coldest < 0))
        return false;
    result->particle = worst_particle(sph, coldness);
    snprintf(result->cause, sizeof result->cause, "the temperature of a particle is %.3g, below zero kelvin", sph->budget.coldest);
    snprintf(result->advice, sizeof result->advice, "more heat is taken from it than it has: look at powe, or try a smaller step by dtfx");
    return true;
}

/* The particle that the limit of the time step hangs on. */
static long limiting_particle(const struct sph *sph)
{
    return sph->limiting->measure ? worst_particle(sph, sph->limiting->measure) : -1;
}

/* One with which the time stands still before the end. */
static bool find_vain_step(const struct sph *sph, struct instability *result)
{
    if (sph->time_step > 0.5 * DBL_EPSILON * sph->scene->end_time || sph->time > sph->scene->end_time)
        return false;
    result->particle = limiting_particle(sph);
    snprintf(result->cause, sizeof result->cause, "the time step %.3g is too small to come to the end, %.3g; it is limited by %s",
             sph->time_step, sph->scene->end_time, sph->limiting->name);
    snprintf(result->advice, sizeof result->advice, "look at the numbers of the material, in the units of the deck");
    return true;
}

static bool find_small_step(const struct sph *sph, struct instability *result)
{
    const double floor = sph->scene->least_step > 0 ? sph->scene->least_step : LEAST_STEP_FRACTION * sph->first_time_step;
    if (sph->time_step >= floor || sph->time + sph->time_step > sph->scene->end_time)
        return false;
    result->particle = limiting_particle(sph);
    snprintf(result->cause, sizeof result->cause, "the time step fell to %.3g, %.3g of the first one; it is limited by %s",
             sph->time_step, sph->time_step / sph->first_time_step, sph->limiting->name);
    return true;
}

static bool find_fixed_step(const struct sph *sph, struct instability *result)
{
    if (sph->scene->fixed_step == 0 || sph->scene->fixed_step <= sph->stable_step)
        return false;
    result->particle = limiting_particle(sph);
    snprintf(result->cause, sizeof result->cause, "the fixed time step %.3g is above the stable one, %.3g, limited by %s",
             sph->scene->fixed_step, sph->stable_step, sph->limiting->name);
    snprintf(result->advice, sizeof result->advice, "try dtfx %.2g or less, or leave it out", 0.95 * sph->stable_step);
    return true;
}

static bool find_lost(const struct sph *sph, struct instability *result)
{
    if (sph->scene->lost != LOST_STOP || sph->budget.removed == 0)
        return false;
    for (size_t id = 0; id < sph->store->count && result->particle < 0; id++)
        if (sph->columns.state[sph->store->index_of_id[id]] == SPH_REMOVED)
            result->particle = (long)id;
    snprintf(result->cause, sizeof result->cause, "%ld particles left the grid", sph->budget.removed);
    snprintf(result->advice, sizeof result->advice, "take a larger grid, or leave 'lost stop' out");
    return true;
}

struct instability sph_check(const struct sph *sph)
{
    static bool (*const finders[])(const struct sph *, struct instability *) = {find_fixed_step, find_not_finite, find_no_reference,
                                                                                 find_leap, find_density, find_cold,
                                                                                 find_vain_step, find_small_step, find_lost};
    struct instability result;
    result.is_stopped = false;
    result.particle = -1;
    result.advice[0] = 0;
    for (size_t i = 0; i < sizeof finders / sizeof finders[0] && !result.is_stopped; i++)
        result.is_stopped = finders[i](sph, &result);
    if (result.is_stopped && !result.advice[0])
        snprintf(result.advice, sizeof result.advice, "try a smaller cfl, or a larger sound speed c0");
    return result;
}
