/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces at the surface, on the fluid alone: surface tension (spec am-sph 6.3 H), its change along the surface
 * (Marangoni, 7), recoil of evaporation (19.2). All are forces per volume. */
#include "sph/surface.h"

#include <math.h>

/* |n| h_s above which there is a direction for the force along the surface. */
static const double LEAST_NORMAL = 0.02;
/* Recoil pressure over vapour pressure. */
static const double RECOIL = 0.54;

static const struct properties *properties_of(const struct sph *sph, size_t a)
{
    return sph->bodies[sph->columns.body[a]].properties;
}

/* That of the start where nothing is heated. */
static double temperature_of(const struct sph *sph, size_t a)
{
    const double *temperature = sph->store->real[COLUMN_TEMPERATURE][0];
    return temperature ? temperature[a] : column_row(COLUMN_TEMPERATURE)->initial;
}

/* Force along the normals: tension with the normal of the pressure force (of the thesis: the wide one), and recoil. */
static void add_normal_force(const struct sph *sph, size_t a, double force[3])
{
    const struct sph_columns *c = &sph->columns;
    const double temperature = temperature_of(sph, a);
    const struct properties *properties = properties_of(sph, a);
    double *const *normal = sph->words->surface == SURFACE_THESIS ? c->wide_normal : c->normal;
    double tension = 0, recoil = 0;
    if (c->curvature[a] != 0)
        tension = properties_surface_tension(properties, temperature) * c->curvature[a];
    if (sph->words->evaporates && properties->boils)
        recoil = RECOIL * properties_vapour_pressure(properties, temperature, sph->words->ambient_pressure);
    for (int i = 0; i < sph->dimension; i++)
        force[i] += tension * normal[i][a] + recoil * c->normal[i][a];
}

/* An adiabatic wall has no temperature of its own. */
static bool has_temperature(const struct sph *sph, size_t b)
{
    const struct scene_wall *wall = sph->bodies[sph->columns.body[b]].wall;
    return !wall || wall->heat == WALL_TEMPERATURE;
}

/* Gradient of the temperature (spec 7, with differences), over the Shepard sum of those that have one. */
THREADS_INLINE void temperature_gradient(const struct sph *sph, size_t a, int dimension, bool varies, double gradient[3])
{
    const struct neighbour_lists *wide = &sph->neighbours->wide;
    const double *volume = sph->columns.volume, own = temperature_of(sph, a);
    double filled = volume[a] * surface_kernel(sph, a, a, dimension, varies).value;
    for (int64_t n = wide->first[a]; n < wide->first[a + 1]; n++) {
        const size_t b = (size_t)wide->list[n];
        struct pair pair;
        if (!has_temperature(sph, b) || !surface_pair(sph, a, b, dimension, varies, &pair))
            continue;
        filled += volume[b] * pair.value;
        const double change = volume[b] * (temperature_of(sph, b) - own) * pair.slope;
        for (int i = 0; i < dimension; i++)
            gradient[i] += change * pair.d[i];
    }
    for (int i = 0; i < dimension; i++)
        gradient[i] /= filled;
}

/* (dsigma/dT) |n| times the part of grad T along the surface. */
THREADS_INLINE void add_tangential_force(const struct sph *sph, size_t a, int dimension, bool varies, double force[3])
{
    const double length = surface_normal_length(sph, a);
    const double slope = properties_surface_slope(properties_of(sph, a), temperature_of(sph, a));
    double gradient[3] = {0}, normal[3];
    if (slope == 0 || !(length * surface_length(sph, a) > LEAST_NORMAL))
        return;
    temperature_gradient(sph, a, dimension, varies, gradient);
    for (int i = 0; i < 3; i++)
        normal[i] = sph->columns.wide_normal[i][a] / length;
    const double across = pair_dot(gradient, normal, dimension);
    for (int i = 0; i < dimension; i++)
        force[i] += slope * length * (gradient[i] - across * normal[i]);
}

THREADS_INLINE void band_forces(struct sph *sph, int dimension, bool varies)
{
    const struct sph_columns *c = &sph->columns;
#pragma omp parallel for schedule(static) if (sph->is_shared)
    for (size_t k = 0; k < sph->n_band; k++) {
        const size_t a = (size_t)sph->band[k];
        double force[3] = {0};
        if (c->state[a] != SPH_FLUID)
            continue;
        if (sph->is_kept[a])
            add_normal_force(sph, a, force);
        if (sph->words->has_marangoni)
            add_tangential_force(sph, a, dimension, varies, force);
        for (int i = 0; i < dimension; i++)
            c->a[i][a] += force[i] / c->density[a];
    }
}

void surface_forces(struct sph *sph)
{
    const struct scene_sph *words = sph->words;
    if (words->surface != SURFACE_OFF || words->has_marangoni || words->evaporates)
        RUN_FORM(band_forces, sph);
}
