/* SPDX-License-Identifier: GPL-3.0-or-later */
/* pla1: elastic, perfectly plastic after von Mises (spec 8.1). */
#include "base/threads.h"
#include "material/plastic.h"

enum { YIELD_STRESS = LAW_POISSON + 1 };

static const char *prepare(struct material *material)
{
    law_prepare_elastic(material, false);
    material->yield_stress = material->parameter[YIELD_STRESS];
    return NULL;
}

THREADS_INLINE void update_point(const struct law_batch *batch, int j, double shear, double bulk, double yield)
{
    double trial[6];
    law_elastic_trial(batch, j, shear, bulk, trial);
    double equivalent = plastic_von_mises(trial);
    bool yields = equivalent > yield;
    batch->plastic_strain[j] += yields ? (equivalent - yield) / (3 * shear) : 0;
    plastic_store(batch, j, trial, yields ? yield / equivalent : 1);
}

THREADS_VECTORISED
static void update(const struct law_batch *batch)
{
    const double shear = batch->material->shear_modulus;
    const double bulk = batch->material->bulk_modulus;
    const double yield = batch->material->yield_stress;
#pragma omp simd
    for (int j = 0; j < batch->count; j++)
        update_point(batch, j, shear, bulk, yield);
}

const struct law law_pla1 = {
    .name = "pla1",
    .methods = METHODS_MPM,
    .doc = "elastic, perfectly plastic (von Mises)",
    .parameters = (const struct argument[]){{"density", "mass/length^3", ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"young", "stress", ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"poisson", NULL, ARGUMENT_REAL, LIMIT_POISSON},
                                            {"yield", "stress", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE},
                                            {0}},
    .columns = {COLUMN_PLASTIC_STRAIN, COLUMN_NONE},
    .rotates = true,
    .viscous_work = 1,
    .prepare = prepare,
    .update = update,
};
