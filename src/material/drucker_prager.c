/* SPDX-License-Identifier: GPL-3.0-or-later */
/* dpm: Drucker-Prager with tension cut-off (spec 8.1). */
#include "material/plastic.h"

enum { FRICTION = LAW_POISSON + 1, COHESION, DILATANCY, TENSION };

static const char *prepare(struct material *material)
{
    law_prepare_elastic(material, false);
    return NULL;
}

/* One point: returns the trial stress, on the cone or to the tension cut-off, and adds to the plastic
 * strain. Without branches, so that several points are worked on at a time. */
THREADS_INLINE void update_point(const struct law_batch *batch, int j, double shear, double bulk)
{
    const double *k = batch->material->parameter;
    const double friction = k[FRICTION], dilatancy = k[DILATANCY], cohesion = k[COHESION];
    const double limit = cohesion / friction, tension = k[TENSION];
    const double cutoff = friction == 0 ? 0 : tension < limit ? tension : limit;
    const double slope = sqrt(1 + friction * friction) - friction;
    double stress[6];
    law_elastic_trial(batch, j, shear, bulk, stress);
    double mean = tensor_mean(stress), tau = plastic_von_mises(stress) / sqrt(3.0);
    double excess = tau + friction * mean - cohesion, excess_tension = mean - cutoff;
    bool is_tensile = mean >= cutoff;
    bool shears = (is_tensile ? tau - (cohesion - friction * cutoff) - slope * excess_tension : excess) > 0;
    bool tears = is_tensile && !shears;
    double multiplier = excess / (shear + bulk * friction * dilatancy);
    double sheared_mean = mean - bulk * dilatancy * multiplier;
    double new_mean = shears ? sheared_mean : tears ? cutoff : mean;
    double scale = shears ? (cohesion - friction * sheared_mean) / tau : 1;
    batch->plastic_strain[j] += shears ? multiplier * sqrt(1.0 / 3 + 2.0 / 9 * dilatancy * dilatancy)
                              : tears  ? excess_tension / bulk * sqrt(2.0) / 3
                                       : 0;
    batch->equivalent_stress[j] = sqrt(3.0) * tau * scale; /* negative where the return passes the apex */
    for (int a = 0; a < 3; a++) {
        batch->stress[a][j] = new_mean + scale * (stress[a] - mean);
        batch->stress[a + 3][j] = scale * stress[a + 3];
    }
}

THREADS_VECTORISED
static void update(const struct law_batch *batch)
{
    const double shear = batch->material->shear_modulus, bulk = batch->material->bulk_modulus;
#pragma omp simd
    for (int j = 0; j < batch->count; j++)
        update_point(batch, j, shear, bulk);
}

const struct law law_dpm = {
    .name = "dpm",
    .methods = METHODS_MPM,
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
