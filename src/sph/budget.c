/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums and extremes over all particles, by portions of fixed size in the order of memory. */
#include "base/memory.h"
#include "sph/sph.h"

#include <math.h>

enum { PORTION = 1024 };

/* What one portion gives. */
struct sph_portion {
    double kinetic, internal, momentum[3], heat;
    double fastest, hottest, coldest, acceleration, least_ratio, most_ratio, least_reference;
    bool is_finite;
};

/* Elastic energy of compression per mass, from p = c^2 (rho - rho0): the integral of p/rho^2. */
static double compression_energy(double square, double density, double reference)
{
    return square * (log(density / reference) + reference / density - 1);
}

/* The density of what flies alone or with one or two others says nothing: it is what was left when it parted from the rest. */
static bool is_loose(const struct sph *sph, size_t p)
{
    static const double LOOSE = 1.5; /* of a particle's own part of the kernel's sum; in a row alone 1.6, at a surface 2.1 */
    return sph->columns.shepard[p] < LOOSE * sph_own_part(sph, p);
}

static void add_particle(const struct sph *sph, size_t p, struct sph_portion *sums)
{
    const struct sph_columns *c = &sph->columns;
    const double mass = c->mass[p];
    if (c->enthalpy && c->state[p] != SPH_WALL)
        sums->heat += mass * c->enthalpy[p];
    sums->hottest = fmax(sums->hottest, c->temperature[p]);
    sums->coldest = fmin(sums->coldest, c->temperature[p]);
    sums->is_finite = sums->is_finite && isfinite(c->temperature[p]);
    if (c->state[p] != SPH_FLUID)
        return;
    const double speed = sph_square_of_speed(sph, p);
    double acceleration = 0;
    for (int a = 0; a < 3; a++) {
        acceleration += c->a[a][p] * c->a[a][p];
        sums->momentum[a] += mass * c->v[a][p];
    }
    const double reference = sph_rest_density(c, p), ratio = c->density[p] / reference;
    sums->kinetic += 0.5 * mass * speed;
    if (ratio > 0)
        sums->internal += mass * compression_energy(sph->sound_speed * sph->sound_speed, c->density[p], reference);
    sums->fastest = fmax(sums->fastest, speed);
    sums->acceleration = fmax(sums->acceleration, acceleration);
    if (!is_loose(sph, p))
        sums->least_ratio = fmin(sums->least_ratio, ratio);
    sums->most_ratio = fmax(sums->most_ratio, ratio);
    sums->least_reference = fmin(sums->least_reference, c->reference[p]);
    sums->is_finite = sums->is_finite && isfinite(speed + acceleration + ratio);
}

static void add_portion(const struct sph_portion *sums, struct sph_budget *budget)
{
    budget->kinetic += sums->kinetic;
    budget->internal += sums->internal;
    budget->heat += sums->heat;
    for (int a = 0; a < 3; a++)
        budget->momentum[a] += sums->momentum[a];
    budget->fastest = fmax(budget->fastest, sums->fastest);
    budget->hottest = fmax(budget->hottest, sums->hottest);
    budget->coldest = fmin(budget->coldest, sums->coldest);
    budget->largest_acceleration = fmax(budget->largest_acceleration, sums->acceleration);
    budget->least_density_ratio = fmin(budget->least_density_ratio, sums->least_ratio);
    budget->most_density_ratio = fmax(budget->most_density_ratio, sums->most_ratio);
    budget->least_reference = fmin(budget->least_reference, sums->least_reference);
    budget->is_finite = budget->is_finite && sums->is_finite;
}

void budget_update(struct sph *sph)
{
    struct sph_budget *budget = &sph->budget;
    const size_t count = sph->store->count, portions = (count + PORTION - 1) / PORTION;
    if (!sph->portions)
        sph->portions = memory_array(portions, sizeof *sph->portions, "sums");
#pragma omp parallel for schedule(static) if (sph->is_shared)
    for (size_t k = 0; k < portions; k++) {
        struct sph_portion sums = {.least_ratio = INFINITY, .least_reference = INFINITY, .coldest = INFINITY, .is_finite = true};
        const size_t end = (k + 1) * PORTION < count ? (k + 1) * PORTION : count;
        for (size_t p = k * PORTION; p < end; p++)
            if (sph->columns.state[p] != SPH_REMOVED)
                add_particle(sph, p, &sums);
        sph->portions[k] = sums;
    }
    budget->kinetic = budget->internal = budget->heat = 0;
    budget->fastest = budget->hottest = budget->largest_acceleration = budget->most_density_ratio = 0;
    budget->least_density_ratio = budget->least_reference = budget->coldest = INFINITY;
    budget->is_finite = true;
    for (int a = 0; a < 3; a++)
        budget->momentum[a] = 0;
    for (size_t k = 0; k < portions; k++)
        add_portion(&sph->portions[k], budget);
    budget->fastest = sqrt(budget->fastest);
    budget->largest_acceleration = sqrt(budget->largest_acceleration);
}

double sph_heat_error(const struct sph *sph)
{
    const struct sph_budget *budget = &sph->budget;
    const double in = budget->absorbed + budget->viscous_heat + budget->volume_heat + budget->through_walls;
    const double out = budget->radiated + budget->evaporated + budget->removed_heat;
    const double turned_over = fabs(budget->absorbed) + fabs(budget->viscous_heat) + fabs(budget->volume_heat)
                               + fabs(budget->through_walls) + fabs(out);
    const double most = fmax(turned_over, fabs(budget->heat - sph->start_heat));
    return most > 0 ? (budget->heat - sph->start_heat - in + out) / most : 0;
}
