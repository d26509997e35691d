/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Properties that follow the temperature, and the density without pressure: swelling, and how free surfaces expand (spec
 * am-sph 3, 10). */
#include "sph/sph.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

static double swelling_at(const struct scene_swelling *swelling, double time)
{
    if (!swelling)
        return 1;
    if (swelling->form == SWELLING_STEADY)
        return 1 + swelling->amplitude * fmin(time, swelling->end);
    const double wave = sin(2 * PI * swelling->frequency * time);
    return 1 + swelling->amplitude * (swelling->form == SWELLING_GROWING ? time * wave : wave);
}

static double temperature_of(const struct sph *sph, size_t p)
{
    return sph->columns.temperature ? sph->columns.temperature[p] : PROPERTIES_ZERO;
}

double heat_reference_density(const struct sph *sph, size_t p, double time)
{
    const struct sph_body *body = &sph->bodies[sph->columns.body[p]];
    return property_value(&body->properties->tables[PROPERTY_DENSITY], temperature_of(sph, p)) * swelling_at(body->swelling, time);
}

/* How far a particle lies at a free surface, from 0 to 1, by the sums of the last step: its normal is long, or little of
 * its support is filled. On a lattice the first row has 1, the second, whose normal is at most 0.3, has 0. */
static double openness_of(const struct sph *sph, size_t p)
{
    static const double LEAST_NORMAL = 0.3, LEAST_FILLED = 0.7;
    const struct sph_columns *c = &sph->columns;
    const double n0 = c->normal[0][p], n1 = c->normal[1][p], n2 = c->normal[2][p], filled = c->shepard[p];
    if (filled <= 0) /* it was solid */
        return 0;
    const double length = sqrt(n0 * n0 + n1 * n1 + n2 * n2) * c->smoothing[p] / (2 * filled);
    return fmax(0, fmin(1, fmax((length - LEAST_NORMAL) / LEAST_NORMAL, (LEAST_FILLED + 0.2 - filled) / 0.2)));
}

/* Continuity sees but one side of a particle at a free surface. To let an expansion by heat come about it would have to
 * move away twice as fast, and ever faster while it loses sight of the others: hot layers would fly off. There the
 * pressure is none whatever the expansion, so that it goes into an offset; what comes back takes from the offset first. */
static void expand_openly(const struct sph *sph, size_t p, double change)
{
    double *opened = &sph->columns.opened[p];
    if (*opened * change > 0) {
        const double back = copysign(fmin(fabs(*opened), fabs(change)), change);
        *opened -= back;
        change -= back;
    }
    *opened -= openness_of(sph, p) * change;
}

void heat_properties(struct sph *sph)
{
    const struct sph_columns *c = &sph->columns;
    const size_t count = sph->store->count;
#pragma omp parallel for schedule(static) if (sph->is_shared)
    for (size_t p = 0; p < count; p++) {
        const struct property_table *tables = sph->bodies[c->body[p]].properties->tables;
        const double temperature = temperature_of(sph, p);
        const bool takes_part = c->state[p] == SPH_FLUID || c->state[p] == SPH_SOLID;
        const double before = c->reference[p];
        c->reference[p] = heat_reference_density(sph, p, sph->time);
        if (c->opened && c->state[p] == SPH_FLUID)
            expand_openly(sph, p, c->reference[p] - before);
        c->viscosity[p] = property_value(&tables[PROPERTY_VISCOSITY], temperature);
        if (c->conductivity) /* 0 where pairs shall not conduct: walls have a way of their own */
            c->conductivity[p] = takes_part ? property_value(&tables[PROPERTY_CONDUCTIVITY], temperature) : 0;
    }
}
