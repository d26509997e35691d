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

/* mu = rho / rho0 - 1 of point j. */
THREADS_INLINE double compression(const struct law_batch *batch, int j)
{
    return batch->mass[j] / batch->volume[j] / batch->material->density - 1;
}

THREADS_VECTORISED
static void polynomial(const struct law_batch *batch)
{
    const double *c = batch->material->eos_constant;
#pragma omp simd
    for (int j = 0; j < batch->count; j++) {
        double mu = compression(batch, j);
        batch->terms[0][j] = c[0] + mu * (c[1] + mu * (c[2] + mu * c[3]));
        batch->terms[1][j] = c[4] + mu * (c[5] + mu * c[6]);
    }
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

THREADS_VECTORISED
static void grueneisen(const struct law_batch *batch)
{
    const double *c = batch->material->eos_constant;
#pragma omp simd
    for (int j = 0; j < batch->count; j++) {
        double mu = compression(batch, j), density = batch->mass[j] / batch->volume[j];
        double compressed = mu * (c[0] + mu * (c[1] + mu * c[2])) * (1 - c[3] * mu / (2 * density));
        batch->terms[0][j] = mu <= 0 ? c[0] * mu : compressed;
        batch->terms[1][j] = mu <= 0 ? 0 : c[4];
    }
}

/* --- 3: Jones-Wilkins-Lee --- */

static void jones_wilkins_lee(const struct law_batch *batch)
{
    const double *c = batch->material->eos_constant;
    for (int j = 0; j < batch->count; j++) {
        double volume = batch->material->density / (batch->mass[j] / batch->volume[j]);
        batch->terms[0][j] = c[0] * (1 - c[4] / (c[2] * volume)) * exp(-c[2] * volume)
                           + c[1] * (1 - c[4] / (c[3] * volume)) * exp(-c[3] * volume);
        batch->terms[1][j] = c[4] / volume;
    }
}

/* --- 4: weakly compressible --- */

THREADS_VECTORISED
static void weakly_compressible(const struct law_batch *batch)
{
    const double *c = batch->material->eos_constant;
#pragma omp simd
    for (int j = 0; j < batch->count; j++) {
        batch->terms[0][j] = c[0] * c[0] * (batch->mass[j] / batch->volume[j] - batch->material->density);
        batch->terms[1][j] = 0;
    }
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
