/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How large a time step may be (spec am-sph 12). */
#include "sph/sph.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

/* Extremes over the particles that the limits hang on. */
struct extremes {
    double kinematic;   /* largest viscosity over density of fluid */
    double lightest;    /* least density of fluid */
    double tension;     /* largest surface tension of fluid */
    double diffusivity; /* largest conductivity over density and heat capacity outside the mush */
};

static double least_capacity(const struct properties *properties)
{
    const struct property_table *table = &properties->tables[PROPERTY_CAPACITY];
    double least = INFINITY;
    for (size_t i = 0; i < table->count; i++)
        least = fmin(least, table->values[i]);
    return least;
}

static struct extremes find_extremes(const struct sph *sph)
{
    const struct sph_columns *c = &sph->columns;
    const bool has_surface = sph->words->surface != SURFACE_OFF;
    const size_t count = sph->store->count;
    double kinematic = 0, lightest = INFINITY, tension = 0, diffusivity = 0;
#pragma omp parallel for schedule(static) reduction(max : kinematic, tension, diffusivity) reduction(min : lightest) if (sph->is_shared)
    for (size_t p = 0; p < count; p++) {
        const struct properties *properties = sph->bodies[c->body[p]].properties;
        if (c->conductivity && c->state[p] != SPH_REMOVED)
            diffusivity = fmax(diffusivity, c->conductivity[p] / (c->density[p] * least_capacity(properties)));
        if (c->state[p] != SPH_FLUID)
            continue;
        kinematic = fmax(kinematic, c->viscosity[p] / c->density[p]);
        lightest = fmin(lightest, c->density[p]);
        if (has_surface && c->shepard[p] < 1 - 1e-3)
            tension = fmax(tension, properties_surface_tension(properties, c->temperature[p]));
    }
    return (struct extremes){kinematic, lightest, tension, diffusivity};
}

struct limit {
    const char *name;
    double step;
};

static void take(struct limit *least, const char *name, double step)
{
    if (step < least->step)
        *least = (struct limit){name, step};
}

double limits_time_step(struct sph *sph)
{
    const struct scene_sph *words = sph->words;
    const struct extremes extremes = find_extremes(sph);
    const double h = sph->smoothing;
    struct limit least = {"the end", INFINITY};
    if (!words->freezes_flow) {
        take(&least, "sound", sph->courant * h / (sph->sound_speed + sph->budget.fastest));
        if (extremes.kinematic > 0)
            take(&least, "viscosity", (words->viscosity == VISCOSITY_MONAGHAN ? 0.05 : 0.125) * h * h / extremes.kinematic);
        if (extremes.tension > 0)
            take(&least, "surface tension", 0.25 * sqrt(extremes.lightest * h * h * h / (2 * PI * extremes.tension)));
        if (sph->budget.largest_acceleration > 0)
            take(&least, "acceleration", 0.25 * sqrt(h / sph->budget.largest_acceleration));
        if (words->density_diffusion > 0)
            take(&least, "diffusion of density", 0.15 * h / (words->density_diffusion * sph->sound_speed));
    }
    if (extremes.diffusivity > 0)
        take(&least, "heat", 0.125 * h * h / extremes.diffusivity);
    if (least.step > sph->scene->end_time)
        least.step = sph->scene->end_time;
    sph->limiting = least.name;
    sph->stable_step = least.step;
    return sph->scene->fixed_step > 0 ? sph->scene->fixed_step : least.step;
}
