/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The step of one element, a spring and a dashpot in a row, of the generalised Maxwell model (spec rkpm 5.2):
 * what it needs is its stress and the stress that the strain increment would give in its spring alone. */
#ifndef MATERIAL_MAXWELL_H
#define MATERIAL_MAXWELL_H

#include "base/threads.h"

struct material;

enum maxwell_rule {
    MAXWELL_EXPONENTIAL, /* exact where the strain grows linearly within the step */
    MAXWELL_MIDPOINT     /* the thesis's (4.9c): of second order, fails where the step is long against the relaxation time */
};

/* h := decay h + share dS */
struct maxwell_factors {
    double decay, share;
};

/* With x = time_step / relaxation_time: decay exp(-x), share (1 - exp(-x))/x, or exp(-x/2) by the midpoint rule. Both are 1
 * in a step of no length, which is how a jump of the strain is taken. */
struct maxwell_factors maxwell_factors(enum maxwell_rule rule, double time_step, double relaxation_time);

/* Words behind the elements of a Maxwell law, as they stand first in its row; then the one that lets pressure relax. */
#define MAXWELL_RULES "exponential", "midpoint"
enum { MAXWELL_WORD_EXPONENTIAL = 1, MAXWELL_WORD_MIDPOINT = 2, MAXWELL_WORD_VOLUME = 4 };

/* The rule that the words of a material say. */
enum maxwell_rule maxwell_rule_of(const struct material *material);

/* Moduli of the elements, which all have one Poisson's ratio; those at once, mu_0 and K, limit the time step. Returns NULL, or
 * what is wrong with the words. */
const char *maxwell_prepare(struct material *material);

THREADS_INLINE double maxwell_step(struct maxwell_factors factors, double stress, double increment)
{
    return factors.decay * stress + factors.share * increment;
}

#endif
