/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "material/johnson_cook.h"

/* The rate factor is cut here, as ln r goes to minus infinity (spec 8.1). */
static const double LEAST_RATE_RATIO = 0.001;

struct johnson_cook_return johnson_cook_update(const struct johnson_cook *k, const struct law_batch *batch, int j,
                                               double equivalent, double shear, double thermal)
{
    struct johnson_cook_return result = {.scale = 1, .equivalent = equivalent};
    double yield = batch->yield_stress[j];
    if (!(equivalent > yield))
        return result;
    double strain = batch->plastic_strain[j];
    double hardening = k->b * k->n * pow(strain + 1e-4, k->n - 1);
    double increment = (equivalent - yield) / (3 * shear + hardening);
    double rate = increment / (k->reference_rate * batch->time_step);
    rate = rate > LEAST_RATE_RATIO ? rate : LEAST_RATE_RATIO;
    yield = (k->a + k->b * pow(strain + increment, k->n)) * (1 + k->c * log(rate)) * thermal;
    batch->yield_stress[j] = yield;
    if (yield > equivalent)
        return result;
    batch->plastic_strain[j] = strain + increment;
    result.scale = yield / equivalent;
    result.equivalent = yield;
    result.increment = increment;
    return result;
}
