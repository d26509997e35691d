/* SPDX-License-Identifier: GPL-3.0-or-later */
/* maxw: generalised Maxwell viscoelasticity of small strains (spec rkpm 5.1, 5.2). A spring and any number of elements
 * carry the same strain; the stress is the sum of theirs. */
#include "material/maxwell.h"
#include "material/law.h"

#include <math.h>

struct maxwell_factors maxwell_factors(enum maxwell_rule rule, double time_step, double relaxation_time)
{
    const double x = time_step / relaxation_time;
    const double mean_decay = x > 0 ? -expm1(-x) / x : 1;
    return (struct maxwell_factors){exp(-x), rule == MAXWELL_MIDPOINT ? exp(-0.5 * x) : mean_decay};
}

enum maxwell_rule maxwell_rule_of(const struct material *material)
{
    return material->words & MAXWELL_WORD_MIDPOINT ? MAXWELL_MIDPOINT : MAXWELL_EXPONENTIAL;
}

const char *maxwell_prepare(struct material *material)
{
    const double poisson = material->parameter[LAW_POISSON];
    double young = material->parameter[LAW_YOUNG];
    if ((material->words & MAXWELL_WORD_EXPONENTIAL) && (material->words & MAXWELL_WORD_MIDPOINT))
        return "there is one rule for the step; expected exponential or midpoint";
    for (int i = 0; i < material->n_elements; i++) {
        struct law_element *element = &material->elements[i];
        element->shear = element->strength / (2 * (1 + poisson));
        element->bulk = material->words & MAXWELL_WORD_VOLUME ? element->strength / (3 * (1 - 2 * poisson)) : 0;
        young += element->strength;
    }
    law_set_elastic(material, young, poisson, true);
    return NULL;
}

/* The stress that an increment of the strain gives at once, along an axis and in a plane. */
THREADS_INLINE double normal_increment(const struct law_batch *batch, int a, int j, double shear, double bulk)
{
    return 2 * shear * (batch->strain[a][j] - batch->trace[j] / 3) + bulk * batch->trace[j];
}

THREADS_INLINE double shear_increment(const struct law_batch *batch, int a, int j, double shear)
{
    return shear * batch->strain[a][j];
}

/* The spring beside the elements: mu_inf, and what no element has of K. */
THREADS_VECTORISED
static void update_spring(const struct law_batch *batch, double shear, double bulk)
{
    for (int a = 0; a < 6; a++) {
        double *restrict stress = batch->stress[a];
#pragma omp simd
        for (int j = 0; j < batch->count; j++)
            stress[j] += a < 3 ? normal_increment(batch, a, j, shear, bulk) : shear_increment(batch, a, j, shear);
    }
}

/* Element i: its stress goes on, and what it changed by goes into the sum, which holds its old one. */
THREADS_VECTORISED
static void update_element(const struct law_batch *batch, int i, struct maxwell_factors factors)
{
    const struct law_element *element = &batch->material->elements[i];
    const double shear = element->shear, bulk = element->bulk;
    for (int a = 0; a < 6; a++) {
        double *restrict stress = batch->stress[a];
        double *restrict history = batch->history[6 * i + a] + batch->history_from;
#pragma omp simd
        for (int j = 0; j < batch->count; j++) {
            const double increment = a < 3 ? normal_increment(batch, a, j, shear, bulk) : shear_increment(batch, a, j, shear);
            const double next = maxwell_step(factors, history[j], increment);
            stress[j] += next - history[j];
            history[j] = next;
        }
    }
}

static void update(const struct law_batch *batch)
{
    const struct material *material = batch->material;
    const enum maxwell_rule rule = maxwell_rule_of(material);
    double shear = material->shear_modulus, bulk = material->bulk_modulus;
    for (int i = 0; i < material->n_elements; i++) {
        const struct law_element *element = &material->elements[i];
        update_element(batch, i, maxwell_factors(rule, batch->time_step, element->time));
        shear -= element->shear;
        bulk -= element->bulk;
    }
    update_spring(batch, shear, bulk);
}

const struct law law_maxw = {
    .name = "maxw",
    .methods = METHODS_MPM,
    .doc = "generalised Maxwell viscoelasticity of small strains: a spring, young at long times, and n elements of a modulus and a "
           "relaxation time, all with one Poisson's ratio. Behind them: midpoint, a rule of the step in place of the exponential "
           "one; volume, so that pressure relaxes as well and is not that of the sum of all moduli for ever",
    .parameters = (const struct argument[]){{"density", "mass/length^3", ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"young", "stress", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE},
                                            {"poisson", NULL, ARGUMENT_REAL, LIMIT_POISSON},
                                            {0}},
    .element = (const struct argument[]){{"modulus", "stress", ARGUMENT_REAL, LIMIT_POSITIVE},
                                         {"time", "time", ARGUMENT_REAL, LIMIT_POSITIVE},
                                         {0}},
    .words = (const char *const[]){MAXWELL_RULES, "volume", NULL},
    .columns = {COLUMN_NONE},
    .rotates = true,
    .follows_time = true,
    .viscous_work = 1,
    .prepare = maxwell_prepare,
    .update = update,
};
