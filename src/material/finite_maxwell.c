/* SPDX-License-Identifier: GPL-3.0-or-later */
/* fmax: generalised Maxwell viscoelasticity of finite strains (spec rkpm 6.1): neo-Hookean at once, and a convolution
 * over the strain's history. With J = det F, b = J^(-2/3) F F^T and the shear moduli mu_i of elements, mu at long times,
 *     q_i := f' (A_i q_i - B_i mu_i dev b) f'^T + B_i mu_i dev b,  f' = det(f)^(-1/3) f
 *     J sigma = K/2 (J^2 - 1) + mu dev b + sum dev q_i
 * where the first b is that of before the step. Not a fluid where mu is 0: in steady shear the stress grows with the strain. */
#include "material/finite.h"
#include "material/maxwell.h"

#include <math.h>

/* Columns of history: J less 1, b less 1, elements. */
enum { HISTORY_SHAPE = 1, HISTORY_ELEMENTS = 7 };
enum { PASS = 8 }; /* elements whose factors are kept at a time */

THREADS_INLINE void deviate(double s[6])
{
    const double mean = tensor_mean(s);
    for (int a = 0; a < 3; a++)
        s[a] -= mean;
}

/* det(f)^(-2/3) less 1 of each point goes to terms[0]: its logarithm would keep the loop over points from being worked on
 * several at a time. */
static void find_scales(const struct law_batch *batch)
{
    for (int j = 0; j < batch->count; j++) {
        double g[3][3];
        finite_gradient(batch, j, g);
        batch->terms[0][j] = expm1(-2.0 / 3 * log1p(finite_swelling(g)));
    }
}

/* dev b of before and after the step; b itself, less 1, of after it. */
struct shape {
    double before[6], after[6], whole[6];
};

THREADS_INLINE struct shape shape_of(const struct law_batch *batch, int j, double g[3][3])
{
    const double less = batch->terms[0][j];
    struct shape shape;
    double unit[6];
    finite_carry_unit(g, unit);
    for (int a = 0; a < 6; a++)
        shape.before[a] = shape.whole[a] = batch->history[HISTORY_SHAPE + a][batch->history_from + j];
    finite_carry(g, shape.whole);
    for (int a = 0; a < 6; a++)
        shape.after[a] = shape.whole[a] = (1 + less) * (shape.whole[a] + unit[a]) + (a < 3 ? less : 0);
    deviate(shape.before);
    deviate(shape.after);
    return shape;
}

/* Elements of a pass over the points: those from `from` to `to` - 1 with their factors; after the last of them the rest. */
struct pass {
    int from, to;
    bool is_first, is_last;
    double spring;
    struct maxwell_factors factors[PASS];
};

/* q of the elements of a pass, and their part of J sigma. */
THREADS_INLINE void element_point(const struct law_batch *batch, int j, double g[3][3], const struct shape *shape, const struct pass *pass, double sum[6])
{
    const double scale = 1 + batch->terms[0][j];
    for (int i = pass->from; i < pass->to; i++) {
        const struct maxwell_factors factors = pass->factors[i - pass->from];
        const double share = factors.share * batch->material->elements[i].shear;
        double *const *history = batch->history + HISTORY_ELEMENTS + 6 * i, q[6];
        for (int a = 0; a < 6; a++)
            q[a] = factors.decay * history[a][batch->history_from + j] - share * shape->before[a];
        finite_carry(g, q);
        for (int a = 0; a < 6; a++) {
            q[a] = scale * q[a] + share * shape->after[a];
            history[a][batch->history_from + j] = q[a];
        }
        deviate(q);
        for (int a = 0; a < 6; a++)
            sum[a] += q[a];
    }
}

/* The last pass adds what the spring and the volume have of J sigma, and keeps J and b. */
THREADS_INLINE void update_point(const struct law_batch *batch, int j, const struct pass *pass)
{
    double g[3][3], sum[6];
    finite_gradient(batch, j, g);
    const struct shape shape = shape_of(batch, j, g);
    for (int a = 0; a < 6; a++)
        sum[a] = pass->is_first ? 0 : batch->stress[a][j];
    element_point(batch, j, g, &shape, pass, sum);
    if (pass->is_last) {
        const double ratio = finite_volume(batch, j, finite_swelling(g));
        const double swelling = 0.5 * batch->material->bulk_modulus * ratio * (2 + ratio);
        for (int a = 0; a < 6; a++) {
            batch->history[HISTORY_SHAPE + a][batch->history_from + j] = shape.whole[a];
            sum[a] = (sum[a] + pass->spring * shape.after[a] + (a < 3 ? swelling : 0)) / (1 + ratio);
        }
    }
    for (int a = 0; a < 6; a++)
        batch->stress[a][j] = sum[a];
}

THREADS_VECTORISED
static void update_points(const struct law_batch *batch, const struct pass *pass)
{
#pragma omp simd
    for (int j = 0; j < batch->count; j++)
        update_point(batch, j, pass);
}

static void update(const struct law_batch *batch)
{
    const struct material *material = batch->material;
    const enum maxwell_rule rule = maxwell_rule_of(material);
    struct pass pass = {.is_first = true, .spring = material->shear_modulus};
    find_scales(batch);
    do {
        pass.to = material->n_elements - pass.from > PASS ? pass.from + PASS : material->n_elements;
        pass.is_last = pass.to == material->n_elements;
        for (int i = pass.from; i < pass.to; i++) {
            pass.factors[i - pass.from] = maxwell_factors(rule, batch->time_step, material->elements[i].time);
            pass.spring -= material->elements[i].shear;
        }
        update_points(batch, &pass);
        pass.from = pass.to;
        pass.is_first = false;
    } while (!pass.is_last);
}

const struct law law_fmax = {
    .name = "fmax",
    .methods = METHODS_MPM | METHODS_DYNAMIC,
    .doc = "generalised Maxwell viscoelasticity of finite strains, neo-Hookean at once: a spring, young at long times, and n elements of a "
           "modulus and a relaxation time, all with one Poisson's ratio. Without a spring it is good for moderate strains, and no fluid: "
           "in steady shear its stress grows with the strain. Behind them: midpoint, a rule of the step in place of the exponential one",
    .parameters = (const struct argument[]){{"density", "mass/length^3", ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"young", "stress", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE},
                                            {"poisson", NULL, ARGUMENT_REAL, LIMIT_POISSON},
                                            {0}},
    .element = (const struct argument[]){{"modulus", "stress", ARGUMENT_REAL, LIMIT_POSITIVE},
                                         {"time", "time", ARGUMENT_REAL, LIMIT_POSITIVE},
                                         {0}},
    .words = (const char *const[]){MAXWELL_RULES, NULL},
    .history = HISTORY_ELEMENTS,
    .columns = {COLUMN_NONE},
    .follows_time = true,
    .stabilisation = 1,
    .viscous_work = 1,
    .prepare = maxwell_prepare,
    .update = update,
};
