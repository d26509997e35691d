/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How large a time step may be (spec am-sph 12). */
#include "sph/sph.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

/* --- what a particle asks for; 0: nothing --- */

static double acceleration_of(const struct sph *sph, size_t p)
{
    double square = 0;
    for (int a = 0; a < 3 && sph->columns.state[p] == SPH_FLUID; a++)
        square += sph->columns.a[a][p] * sph->columns.a[a][p];
    return square;
}

static double kinematic_viscosity(const struct sph *sph, size_t p)
{
    return sph->columns.state[p] == SPH_FLUID ? sph->columns.viscosity[p] / sph->columns.density[p] : 0;
}

/* Of the free surface; before the first step no one knows where it is. */
static double surface_tension(const struct sph *sph, size_t p)
{
    const struct sph_columns *c = &sph->columns;
    const bool is_inside = sph->step > 0 && !(c->shepard[p] < 1 - 1e-3);
    if (sph->words->surface == SURFACE_OFF || c->state[p] != SPH_FLUID || is_inside)
        return 0;
    return properties_surface_tension(sph->bodies[c->body[p]].properties, c->temperature[p]);
}

/* With the heat capacity outside the mush. */
static double diffusivity(const struct sph *sph, size_t p)
{
    const struct sph_columns *c = &sph->columns;
    if (!c->conductivity || c->state[p] == SPH_REMOVED)
        return 0;
    return c->conductivity[p] / (c->density[p] * properties_least_capacity(sph->bodies[c->body[p]].properties));
}

static double loss_rate(const struct sph *sph, size_t p)
{
    return sph->words->radiates || sph->words->evaporates ? heat_loss_rate(sph, p) : 0;
}

/* --- the limits --- */

static const struct sph_limit THE_END = {"the end", NULL}, SOUND = {"sound", sph_square_of_speed},
                              VISCOSITY = {"viscosity", kinematic_viscosity}, TENSION = {"surface tension", surface_tension},
                              ACCELERATION = {"acceleration", acceleration_of}, DIFFUSION = {"diffusion of density", NULL},
                              HEAT = {"heat", diffusivity}, LOSS = {"radiation and evaporation", loss_rate};

/* Extremes over the particles that the limits hang on. */
struct extremes {
    double kinematic, tension, diffusivity, loss;
    double lightest; /* least density of fluid */
};

static struct extremes find_extremes(const struct sph *sph)
{
    const size_t count = sph->store->count;
    double kinematic = 0, lightest = INFINITY, tension = 0, diffusion = 0, loss = 0;
#pragma omp parallel for schedule(static) reduction(max : kinematic, tension, diffusion, loss) reduction(min : lightest) if (sph->is_shared)
    for (size_t p = 0; p < count; p++) {
        diffusion = fmax(diffusion, diffusivity(sph, p));
        kinematic = fmax(kinematic, kinematic_viscosity(sph, p));
        tension = fmax(tension, surface_tension(sph, p));
        loss = fmax(loss, loss_rate(sph, p));
        if (sph->columns.state[p] == SPH_FLUID)
            lightest = fmin(lightest, sph->columns.density[p]);
    }
    return (struct extremes){kinematic, tension, diffusion, loss, lightest};
}

/* The least limit so far. */
struct least {
    const struct sph_limit *limit;
    double step;
};

static void take(struct least *least, const struct sph_limit *limit, double step)
{
    if (step < least->step)
        *least = (struct least){limit, step};
}

double limits_time_step(struct sph *sph)
{
    const struct scene_sph *words = sph->words;
    const struct extremes extremes = find_extremes(sph);
    const double h = sph->smoothing;
    struct least least = {&THE_END, INFINITY};
    if (!words->freezes_flow) {
        take(&least, &SOUND, sph->courant * h / (sph->sound_speed + sph->budget.fastest));
        if (extremes.kinematic > 0)
            take(&least, &VISCOSITY, (words->viscosity == VISCOSITY_MONAGHAN ? 0.05 : 0.125) * h * h / extremes.kinematic);
        if (extremes.tension > 0)
            take(&least, &TENSION, 0.25 * sqrt(extremes.lightest * h * h * h / (2 * PI * extremes.tension)));
        if (sph->budget.largest_acceleration > 0)
            take(&least, &ACCELERATION, 0.25 * sqrt(h / sph->budget.largest_acceleration));
        if (words->density_diffusion > 0)
            take(&least, &DIFFUSION, 0.15 * h / (words->density_diffusion * sph->sound_speed));
    }
    if (extremes.diffusivity > 0)
        take(&least, &HEAT, 0.125 * h * h / extremes.diffusivity);
    if (extremes.loss > 0)
        take(&least, &LOSS, 0.25 / extremes.loss);
    if (least.step > sph->scene->end_time)
        least.step = sph->scene->end_time;
    sph->limiting = least.limit;
    sph->stable_step = least.step;
    return sph->scene->fixed_step > 0 ? sph->scene->fixed_step : least.step;
}
