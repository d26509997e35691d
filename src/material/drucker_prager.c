/* SPDX-License-Identifier: GPL-3.0-or-later */
/* dpm: Drucker-Prager with tension cut-off (spec 8.1). */
#include "base/tensor.h"
#include "material/law.h"

#include <math.h>

enum { FRICTION = LAW_POISSON + 1, COHESION, DILATANCY, TENSION };

static const char *prepare(struct material *material)
{
    law_prepare_elastic(material, false);
    return NULL;
}

/* One point: trial stress in, returned stress out; adds to the plastic strain. */
static void return_stress(const struct law_batch *batch, int j, double stress[6])
{
    const double *k = batch->material->parameter;
    const double shear = batch->material->shear_modulus, bulk = batch->material->bulk_modulus;
    const double friction = k[FRICTION], dilatancy = k[DILATANCY], cohesion = k[COHESION];
    const double cutoff = friction == 0 ? 0 : fmin(k[TENSION], cohesion / friction);
    double mean = tensor_mean(stress), scale = 1, new_mean = mean;
    double tau = tensor_von_mises(stress[0], stress[1], stress[2], stress[3], stress[4], stress[5]) / sqrt(3.0);
    double excess = tau + friction * mean - cohesion;
    bool returns_shear = mean < cutoff && excess > 0;
    if (mean >= cutoff) {
        double slope = sqrt(1 + friction * friction) - friction;
        returns_shear = tau - (cohesion - friction * cutoff) - slope * (mean - cutoff) > 0;
        if (!returns_shear) {
            new_mean = cutoff;
            batch->plastic_strain[j] += (mean - cutoff) / bulk * sqrt(2.0) / 3;
        }
    }
    if (returns_shear) {
        double multiplier = excess / (shear + bulk * friction * dilatancy);
        new_mean = mean - bulk * dilatancy * multiplier;
        scale = (cohesion - friction * new_mean) / tau;
        batch->plastic_strain[j] += multiplier * sqrt(1.0 / 3 + 2.0 / 9 * dilatancy * dilatancy);
    }
    batch->equivalent_stress[j] = sqrt(3.0) * tau * scale; /* negative where the return passes the apex */
    for (int a = 0; a < 3; a++) {
        batch->stress[a][j] = new_mean + scale * (stress[a] - mean);
        batch->stress[a + 3][j] = scale * stress[a + 3];
    }
}

static void update(const struct law_batch *batch)
{
    for (int j = 0; j < batch->count; j++) {
        double trial[6];
        law_elastic_trial(batch, j, batch->material->shear_modulus, batch->material->bulk_modulus, trial);
        return_stress(batch, j, trial);
    }
}

const struct law law_dpm = {
    .name = "dpm",
    .doc = "Drucker-Prager plasticity with tension cut-off",
    .parameters = (const struct argument[]){{"density", "mass/length^3", ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"young", "stress", ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"poisson", NULL, ARGUMENT_REAL, LIMIT_POISSON},
                                            {"q_phi", NULL, ARGUMENT_REAL, LIMIT_NOT_NEGATIVE},
                                            {"k_phi", "stress", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE},
                                            {"q_psi", NULL, ARGUMENT_REAL, LIMIT_NONE},
                                            {"tension", "stress", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE}, {0}},
    .columns = {COLUMN_PLASTIC_STRAIN, COLUMN_EQUIVALENT_STRESS, COLUMN_NONE},
    .keeps_equivalent = true, /* with the sign of the return, as the reference prints it */
    .rotates = true,
    .viscous_work = 1,
    .prepare = prepare,
    .update = update,
};
