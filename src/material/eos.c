/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "material/eos.h"

#include <math.h>
#include <string.h>

#define REAL(name, unit) {name, unit, ARGUMENT_REAL, LIMIT_NONE}

/* --- 1: linear polynomial --- */

static void keep_constants(struct material *material, const double *values)
{
    for (int i = 0; i < argument_count(material->eos->arguments); i++)
        material->eos_constant[i] = values[i];
}

static struct eos_pressure polynomial(const double *c, double density, double initial_density)
{
    double mu = density / initial_density - 1;
    return (struct eos_pressure){c[0] + mu * (c[1] + mu * (c[2] + mu * c[3])), c[4] + mu * (c[5] + mu * c[6])};
}

/* --- 2: Mie-Grueneisen --- */

static void prepare_grueneisen(struct material *material, const double *values)
{
    double speed = values[0], slope = values[1], gamma = values[2], *c = material->eos_constant;
    c[0] = material->density * speed * speed;
    c[1] = c[0] * (2 * slope - 1);
    c[2] = c[0] * (slope - 1) * (3 * slope - 1);
    c[3] = material->density * gamma;
    c[4] = gamma;
}

static struct eos_pressure grueneisen(const double *c, double density, double initial_density)
{
    double mu = density / initial_density - 1;
    if (mu <= 0)
        return (struct eos_pressure){c[0] * mu, 0};
    return (struct eos_pressure){mu * (c[0] + mu * (c[1] + mu * c[2])) * (1 - c[3] * mu / (2 * density)), c[4]};
}

/* --- 3: Jones-Wilkins-Lee --- */

static struct eos_pressure jones_wilkins_lee(const double *c, double density, double initial_density)
{
    double volume = initial_density / density;
    double a = c[0] * (1 - c[4] / (c[2] * volume)) * exp(-c[2] * volume)
             + c[1] * (1 - c[4] / (c[3] * volume)) * exp(-c[3] * volume);
    return (struct eos_pressure){a, c[4] / volume};
}

/* --- 4: weakly compressible --- */

static struct eos_pressure weakly_compressible(const double *c, double density, double initial_density)
{
    return (struct eos_pressure){c[0] * c[0] * (density - initial_density), 0};
}

static const struct eos rows[] = {
    {1, "linear polynomial", "p = c0 + c1 mu + c2 mu^2 + c3 mu^3 + (c4 + c5 mu + c6 mu^2) e",
     (const struct argument[]){REAL("c0", "stress"), REAL("c1", "stress"), REAL("c2", "stress"), REAL("c3", "stress"),
                               REAL("c4", NULL), REAL("c5", NULL), REAL("c6", NULL), REAL("E0", "energy/volume"), {0}},
     7, false, true, keep_constants, polynomial},
    {2, "Mie-Grueneisen", "shock speed c + lambda v, Grueneisen coefficient gamma",
     (const struct argument[]){{"c", "length/time", ARGUMENT_REAL, LIMIT_POSITIVE}, REAL("lambda", NULL),
                               REAL("gamma", NULL), REAL("E0", "energy/volume"), {0}},
     3, true, true, prepare_grueneisen, grueneisen},
    {3, "JWL", "Jones-Wilkins-Lee gas of an explosive",
     (const struct argument[]){REAL("A", "stress"), REAL("B", "stress"),
                               {"R1", NULL, ARGUMENT_REAL, LIMIT_POSITIVE}, {"R2", NULL, ARGUMENT_REAL, LIMIT_POSITIVE},
                               REAL("omega", NULL), REAL("E0", "energy/volume"), {0}},
     5, false, false, keep_constants, jones_wilkins_lee},
    {4, "weakly compressible", "p = c^2 (rho - rho0); for null, c is the wave speed of the law",
     (const struct argument[]){{"c", "length/time", ARGUMENT_REAL, LIMIT_POSITIVE}, {0}},
     -1, true, false, keep_constants, weakly_compressible},
    {0}};

const struct eos *eos_find(long type)
{
    for (const struct eos *row = rows; row->type; row++)
        if (row->type == type)
            return row;
    return NULL;
}

const struct eos *eos_rows(void)
{
    return rows;
}

/* Artificial viscosity pressure (spec 6.5). */
static double viscous_pressure(const struct law_batch *batch, int j)
{
    double rate = batch->trace[j] < 0 ? batch->trace[j] / batch->time_step : 0;
    double density = batch->mass[j] / batch->volume[j], size = batch->cell_size;
    return density * size * rate
         * (batch->bulk_quadratic * size * rate - batch->bulk_linear * batch->material->viscous_speed);
}

struct eos_update eos_advance(const struct law_batch *batch, int j, double deviator_work, bool is_failed, double factor)
{
    const struct material *material = batch->material;
    const struct eos *eos = material->eos;
    struct eos_update update = {.mean_before = batch->mean_stress[j],
                                .half_volume = 0.5 * (batch->volume[j] - batch->volume_before[j])};
    double initial_volume = batch->mass[j] / material->density;
    double viscous = eos->computes_viscosity && update.mean_before < 0 ? viscous_pressure(batch, j) : 0;
    update.work = 0.25 * (batch->volume_before[j] + batch->volume[j]) * deviator_work
                + update.half_volume * (update.mean_before - 2 * viscous);
    struct eos_pressure terms = eos->pressure(material->eos_constant, batch->mass[j] / batch->volume[j], material->density);
    double a = terms.a * factor, b = terms.b * factor;
    batch->energy[j] += update.work;
    double pressure = (a + b * batch->energy[j] / initial_volume) / (1 + b * update.half_volume / initial_volume);
    if (is_failed && pressure < 0)
        pressure = 0;
    batch->energy[j] -= update.half_volume * pressure;
    if (eos->reduces_work)
        update.work -= update.half_volume * pressure;
    batch->mean_stress[j] = -pressure;
    batch->viscous_pressure[j] = viscous;
    return update;
}
