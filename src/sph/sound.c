/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sound speed: ten times the fastest flow or more, so that densities stay within a hundredth of their reference (spec
 * am-sph 12). */
#include "sph/sph.h"

#include <float.h>
#include <math.h>

/* The change of density that is wanted. */
static const double COMPRESSION = 0.01;
/* An adaptive sound speed changes once in so many steps, by this part at most; it does not fall below this part of that at
 * the start. */
enum { ADAPT_STEPS = 50 };
static const double LARGEST_CHANGE = 0.05, LEAST_PART = 0.1;

/* Where a body would be melt. */
static double temperature_of_melt(const struct sph_body *body)
{
    return body->properties->melts ? body->properties->liquidus : column_row(COLUMN_TEMPERATURE)->initial;
}

static double density_of_melt(const struct sph_body *body)
{
    return property_value(&body->properties->tables[PROPERTY_DENSITY], temperature_of_melt(body));
}

static double heaviest_melt(const struct sph *sph)
{
    double most = 0;
    for (size_t b = 0; b < sph->scene->n_bodies; b++)
        if (!sph->bodies[b].wall)
            most = fmax(most, density_of_melt(&sph->bodies[b]));
    return most;
}

/* What makes pressure: speeds, hydrostatic columns of the heaviest on each, surface tension of drops of a few
 * spacings (spec 12). */
double sound_of_scene(const struct sph *sph)
{
    double most = 0, low[3], high[3];
    const struct sph_columns *c = &sph->columns;
    const double heaviest = heaviest_melt(sph);
    for (int a = 0; a < 3; a++)
        low[a] = DBL_MAX, high[a] = -DBL_MAX;
    for (size_t p = 0; p < sph->store->count; p++) {
        double speed = 0;
        for (int a = 0; a < sph->dimension; a++) {
            low[a] = fmin(low[a], c->x[a][p]);
            high[a] = fmax(high[a], c->x[a][p]);
            speed += c->v[a][p] * c->v[a][p];
        }
        most = fmax(most, speed);
    }
    for (size_t b = 0; b < sph->scene->n_bodies; b++) {
        const struct sph_body *body = &sph->bodies[b];
        const double density = density_of_melt(body);
        double fall = 0;
        for (int a = 0; a < sph->dimension; a++)
            fall += fabs(body->gravity[a]) * (high[a] - low[a]);
        const double tension =
            sph->words->surface == SURFACE_OFF ? 0 : properties_surface_tension(body->properties, temperature_of_melt(body));
        most = fmax(most, fmax(2 * fall * heaviest / density, tension / (2 * sph->smoothing * density)));
    }
    return sqrt(most / COMPRESSION);
}

/* Changes the sound speed; densities go along, so that pressures stay. */
static void change(struct sph *sph, double speed)
{
    const struct sph_columns *c = &sph->columns;
    const double ratio = sph->sound_speed / speed, scale = ratio * ratio;
    const size_t count = sph->store->count;
    sph->sound_speed = speed;
#pragma omp parallel for schedule(static) if (sph->is_shared)
    for (size_t p = 0; p < count; p++) {
        if (c->state[p] != SPH_FLUID)
            continue;
        const double rest = sph_rest_density(c, p);
        c->density[p] = rest + scale * (c->density[p] - rest);
        c->volume[p] = c->mass[p] / c->density[p];
    }
}

void sound_adapt(struct sph *sph)
{
    const struct sph_budget *budget = &sph->budget;
    if (!sph->words->adapts_sound)
        return;
    if (isfinite(budget->least_density_ratio)) { /* there is fluid */
        const double deviation = fmax(budget->most_density_ratio - 1, 1 - budget->least_density_ratio);
        sph->wanted_sound = fmax(sph->wanted_sound, fmax(budget->fastest / sqrt(COMPRESSION),
                                                         sph->sound_speed * sqrt(fmax(deviation, 0) / COMPRESSION)));
    }
    if (sph->step % ADAPT_STEPS != 0)
        return;
    const double wanted = fmax(sph->wanted_sound, LEAST_PART * sph->first_sound);
    sph->wanted_sound = 0;
    change(sph, fmin(fmax(wanted, sph->sound_speed * (1 - LARGEST_CHANGE)), sph->sound_speed * (1 + LARGEST_CHANGE)));
}
