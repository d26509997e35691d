/* SPDX-License-Identifier: GPL-3.0-or-later */
/* elas: linear elasticity in rate form (spec 8.1). */
#include "base/threads.h"
#include "material/law.h"

#include <math.h>

void law_set_elastic(struct material *material, double young, double poisson, bool has_viscous_speed)
{
    material->density = material->parameter[LAW_DENSITY];
    material->shear_modulus = young / (2 * (1 + poisson));
    material->bulk_modulus = young / (3 * (1 - 2 * poisson));
    material->wave_speed = sqrt(young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson) * material->density));
    material->viscous_speed = has_viscous_speed ? material->wave_speed : 0;
}

void law_prepare_elastic(struct material *material, bool has_viscous_speed)
{
    law_set_elastic(material, material->parameter[LAW_YOUNG], material->parameter[LAW_POISSON], has_viscous_speed);
}

static const char *prepare(struct material *material)
{
    law_prepare_elastic(material, true);
    return NULL;
}

THREADS_VECTORISED
static void update(const struct law_batch *batch)
{
    const double shear = batch->material->shear_modulus;
    const double bulk = batch->material->bulk_modulus;
    const int count = batch->count;
    for (int a = 0; a < 3; a++) {
        double *restrict normal = batch->stress[a];
        double *restrict tangent = batch->stress[a + 3];
        const double *restrict normal_strain = batch->strain[a];
        const double *restrict shear_strain = batch->strain[a + 3];
        const double *restrict trace = batch->trace;
#pragma omp simd
        for (int j = 0; j < count; j++) {
            normal[j] += 2 * shear * (normal_strain[j] - trace[j] / 3) + bulk * trace[j];
            tangent[j] += shear * shear_strain[j];
        }
    }
}

const struct law law_elas = {
    .name = "elas",
    .methods = METHODS_MPM,
    .doc = "linear elastic",
    .parameters = (const struct argument[]){{"density", "mass/length^3", ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"young", "stress", ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"poisson", NULL, ARGUMENT_REAL, LIMIT_POISSON},
                                            {0}},
    .columns = {COLUMN_NONE},
    .rotates = true,
    .viscous_work = 1,
    .prepare = prepare,
    .update = update,
};
