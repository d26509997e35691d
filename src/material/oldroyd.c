/* SPDX-License-Identifier: GPL-3.0-or-later */
/* oldr: Oldroyd-B fluid, upper-convected Maxwell without solvent, with equation of state (spec rkpm 6.2):
 *     sigma = -p + sum mu_i (c_i - 1) + 2 eta_s dev D,  mu_i = eta_i/lambda_i,  p = rho_0 c^2/7 ((rho/rho_0)^7 - 1)
 *     upper-convected rate of c = -(c - 1)/lambda
 * A step of c, with A = exp(-x), B = (1 - A)/x, x = dt/lambda, and the relative gradient f:
 *     Strang       half of the relaxation, f c f^T, the other half; of second order
 *     Lie          f c f^T, then relaxation; of first order
 *     exponential  c - 1 := A f (c - 1) f^T + B (f f^T - 1): of second order, and right also where the step is long against
 *                  the relaxation time, where the others lose the stress
 * Each is a sum of tensors that are not negative, so that c stays positive for any step. */
#include "material/finite.h"
#include "material/maxwell.h"

#include <math.h>

/* As in the list of words of the row; columns of history: J less 1. */
enum { WORD_STRANG = 1, WORD_LIE = 2, WORD_EXPONENTIAL = 4 };
enum { HISTORY_ELEMENTS = 1 };
enum { DENSITY, SOUND_SPEED, SOLVENT };

/* c - 1 := after (before f (c - 1) f^T + share (f f^T - 1)) */
struct split {
    double before, share, after;
};

static const char *prepare(struct material *material)
{
    double shear = 0;
    const unsigned words = material->words;
    if (words & (words - 1))
        return "there is one rule for the step; expected strang, lie or exponential";
    for (int i = 0; i < material->n_elements; i++) {
        material->elements[i].shear = material->elements[i].strength / material->elements[i].time;
        shear += material->elements[i].shear;
    }
    material->density = material->parameter[DENSITY];
    material->bulk_modulus = material->density * material->parameter[SOUND_SPEED] * material->parameter[SOUND_SPEED];
    material->shear_modulus = shear;
    material->viscosity = material->parameter[SOLVENT];
    material->wave_speed = material->viscous_speed = sqrt((material->bulk_modulus + 4 * shear / 3) / material->density);
    return NULL;
}

static struct split split_of(const struct material *material, double time_step, double time)
{
    const struct maxwell_factors factors = maxwell_factors(MAXWELL_EXPONENTIAL, time_step, time);
    if (material->words & WORD_EXPONENTIAL)
        return (struct split){factors.decay, factors.share, 1};
    if (material->words & WORD_LIE)
        return (struct split){1, 1, factors.decay};
    return (struct split){exp(-0.5 * time_step / time), 1, exp(-0.5 * time_step / time)};
}

THREADS_INLINE void element_point(const struct law_batch *batch, int j, double *const *history, double shear, struct split split)
{
    double g[3][3], c[6], unit[6];
    finite_gradient(batch, j, g);
    finite_carry_unit(g, unit);
    for (int a = 0; a < 6; a++)
        c[a] = split.before * history[a][batch->history_from + j];
    finite_carry(g, c);
    for (int a = 0; a < 6; a++) {
        c[a] = split.after * (c[a] + split.share * unit[a]);
        history[a][batch->history_from + j] = c[a];
        batch->stress[a][j] += shear * c[a];
    }
}

THREADS_VECTORISED
static void update_element(const struct law_batch *batch, int i, struct split split)
{
    const double shear = batch->material->elements[i].shear;
    double *const *history = batch->history + HISTORY_ELEMENTS + 6 * i;
#pragma omp simd
    for (int j = 0; j < batch->count; j++)
        element_point(batch, j, history, shear, split);
}

/* J, pressure and solvent: what the elements' stresses are added to. */
THREADS_INLINE void solvent_point(const struct law_batch *batch, int j, double density, double sound_speed, double viscosity)
{
    double g[3][3], rate[6];
    finite_gradient(batch, j, g);
    const double swelling = finite_swelling(g), pressure = finite_pressure(density, sound_speed, finite_volume(batch, j, swelling));
    finite_rate(g, swelling, batch->time_step, rate);
    const double mean = tensor_mean(rate);
    for (int a = 0; a < 6; a++)
        batch->stress[a][j] = 2 * viscosity * (rate[a] - (a < 3 ? mean : 0)) - (a < 3 ? pressure : 0);
}

THREADS_VECTORISED
static void update_solvent(const struct law_batch *batch)
{
    const double *parameter = batch->material->parameter;
#pragma omp simd
    for (int j = 0; j < batch->count; j++)
        solvent_point(batch, j, parameter[DENSITY], parameter[SOUND_SPEED], parameter[SOLVENT]);
}

static void update(const struct law_batch *batch)
{
    const struct material *material = batch->material;
    update_solvent(batch);
    for (int i = 0; i < material->n_elements; i++)
        update_element(batch, i, split_of(material, batch->time_step, material->elements[i].time));
}

const struct law law_oldr = {
    .name = "oldr",
    .methods = METHODS_MPM | METHODS_DYNAMIC,
    .doc = "Oldroyd-B fluid with equation of state p = density sound^2/7 ((rho/density)^7 - 1): a solvent of a viscosity, 0 for an "
           "upper-convected Maxwell fluid, and n polymers of a viscosity and a relaxation time. Behind them a rule of the step: strang "
           "(default), lie, or exponential, which is right also where steps are long against the relaxation time. `meth mpm` does not limit "
           "the time step by the solvent: keep dtfx below about cell^2 density/(8 solvent)",
    .parameters = (const struct argument[]){{"density", "mass/length^3", ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"sound", "length/time", ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"solvent", "stress time", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE},
                                            {0}},
    .element = (const struct argument[]){{"viscosity", "stress time", ARGUMENT_REAL, LIMIT_POSITIVE},
                                         {"time", "time", ARGUMENT_REAL, LIMIT_POSITIVE},
                                         {0}},
    .words = (const char *const[]){"strang", "lie", "exponential", NULL},
    .history = HISTORY_ELEMENTS,
    .columns = {COLUMN_NONE},
    .follows_time = true,
    .stabilisation = 0.1,
    .viscous_work = 1,
    .prepare = prepare,
    .update = update,
};
