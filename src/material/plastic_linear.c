/* SPDX-License-Identifier: GPL-3.0-or-later */
/* pla2: elastic-plastic after von Mises with linear isotropic hardening (spec 8.1). */
#include "base/threads.h"
#include "material/plastic.h"

enum { YIELD_STRESS = LAW_POISSON + 1, TANGENT_MODULUS };

static const char *prepare(struct material *material)
{
    law_prepare_elastic(material, false);
    material->yield_stress = material->parameter[YIELD_STRESS];
    if (material->parameter[TANGENT_MODULUS] >= material->parameter[LAW_YOUNG])
        return "the tangent modulus has to be smaller than Young's modulus";
    return NULL;
}

THREADS_INLINE void update_point(const struct law_batch *batch, int j, double shear, double bulk, double hardening)
{
    double trial[6];
    law_elastic_trial(batch, j, shear, bulk, trial);
    double equivalent = plastic_von_mises(trial);
    double yield = batch->yield_stress[j];
    bool yields = equivalent > yield;
    double increment = yields ? (equivalent - yield) / (3 * shear + hardening) : 0;
    yield += hardening * increment;
    batch->plastic_strain[j] += increment;
    batch->yield_stress[j] = yield;
    plastic_store(batch, j, trial, yields ? yield / equivalent : 1);
}

THREADS_VECTORISED
static void update(const struct law_batch *batch)
{
    const double *parameter = batch->material->parameter;
    const double shear = batch->material->shear_modulus;
    const double bulk = batch->material->bulk_modulus;
    const double hardening =
        parameter[LAW_YOUNG] * parameter[TANGENT_MODULUS] / (parameter[LAW_YOUNG] - parameter[TANGENT_MODULUS]);
#pragma omp simd
    for (int j = 0; j < batch->count; j++)
        update_point(batch, j, shear, bulk, hardening);
}

const struct law law_pla2 = {
    .name = "pla2",
    .methods = METHODS_MPM,
    .doc = "elastic-plastic with linear isotropic hardening (von Mises)",
    .parameters = (const struct argument[]){{"density", "mass/length^3", ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"young", "stress", ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"poisson", NULL, ARGUMENT_REAL, LIMIT_POISSON},
                                            {"yield", "stress", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE},
                                            {"tangent", "stress", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE},
                                            {0}},
    .columns = {COLUMN_PLASTIC_STRAIN, COLUMN_YIELD_STRESS, COLUMN_NONE},
    .rotates = true,
    .viscous_work = 1,
    .prepare = prepare,
    .update = update,
};
