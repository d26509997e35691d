/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rkpm/relaxation.h"
#include "base/memory.h"

#include <string.h>

enum { TENSOR = RELAXATION_TENSOR, HISTORY = TENSOR + 1, FEW_POINTS = 500 };

/* Where a component of a tensor is. */
static const int place_of[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

void relaxation_open(struct relaxation *relaxation, const struct scene_rkpm *words, size_t points)
{
    const double to_shear = 1 / (2 * (1 + words->poisson)), to_bulk = 1 / (3 * (1 - 2 * words->poisson));
    *relaxation = (struct relaxation){.dimension = (int)words->dimension, .is_plane_stress = words->dimension == 2 && words->plane == PLANE_STRESS,
                                      .rule = words->rule, .elements = words->n_elements, .points = points,
                                      .spring_shear = words->young * to_shear, .spring_bulk = words->young * to_bulk};
    for (int i = 0; i < words->n_elements; i++) {
        relaxation->shear[i] = words->elements[i][0] * to_shear;
        relaxation->bulk[i] = words->relaxes_volume ? words->elements[i][0] * to_bulk : 0;
        relaxation->time[i] = words->elements[i][1];
        relaxation->spring_bulk += words->elements[i][0] * to_bulk - relaxation->bulk[i];
    }
    relaxation->strain = memory_array(points * TENSOR, sizeof(double), "stresses");
    relaxation->element = memory_array(points * (size_t)words->n_elements * HISTORY, sizeof(double), "stresses");
}

void relaxation_close(struct relaxation *relaxation)
{
    memory_free(relaxation->strain);
    memory_free(relaxation->element);
}

/* What a step of a length is the same for at all points: mu* and K* of increments, elements' factors. */
struct step {
    double shear, bulk;
    struct maxwell_factors factors[RKPM_ELEMENTS];
};

static struct step step_of(const struct relaxation *relaxation, double time_step)
{
    struct step step = {.shear = relaxation->spring_shear, .bulk = relaxation->spring_bulk};
    for (int i = 0; i < relaxation->elements; i++) {
        step.factors[i] = maxwell_factors(relaxation->rule, time_step, relaxation->time[i]);
        step.shear += step.factors[i].share * relaxation->shear[i];
        step.bulk += step.factors[i].share * relaxation->bulk[i];
    }
    return step;
}

struct moduli relaxation_moduli(const struct relaxation *relaxation, double time_step)
{
    const struct step step = step_of(relaxation, time_step);
    const double lambda = step.bulk - 2 * step.shear / 3;
    return (struct moduli){relaxation->is_plane_stress ? 2 * lambda * step.shear / (lambda + 2 * step.shear) : lambda, step.shear};
}

static double trace_of(const double strain[TENSOR])
{
    return strain[0] + strain[1] + strain[2];
}

static double deviator(const double strain[TENSOR], int c)
{
    return strain[c] - (c < 3 ? trace_of(strain) / 3 : 0);
}

/* The strain across the plane that leaves no stress there (4.17), (4.38): what elements keep of theirs, and what their increments
 * would have been without one. */
static double strain_across(const struct relaxation *relaxation, const struct step *step, const double *history, const double before[TENSOR],
                            double in_plane)
{
    double kept = 0;
    for (int i = 0; i < relaxation->elements; i++) {
        const double *own = history + i * HISTORY;
        kept += maxwell_step(step->factors[i], own[2], -2 * relaxation->shear[i] * deviator(before, 2));
        kept += maxwell_step(step->factors[i], own[TENSOR], -relaxation->bulk[i] * trace_of(before));
    }
    return -((step->bulk - 2 * step->shear / 3) * in_plane + kept) / (step->bulk + 4 * step->shear / 3);
}

/* The stress at a point after a step to `strain`; elements go to `next`. */
static void step_point(const struct relaxation *relaxation, const struct step *step, const double *history, const double before[TENSOR],
                       const double strain[TENSOR], double *next, double stress[TENSOR])
{
    double mean = relaxation->spring_bulk * trace_of(strain);
    for (int c = 0; c < TENSOR; c++)
        stress[c] = 2 * relaxation->spring_shear * deviator(strain, c);
    for (int i = 0; i < relaxation->elements; i++) {
        const double *own = history + i * HISTORY;
        for (int c = 0; c < TENSOR; c++) {
            next[i * HISTORY + c] = maxwell_step(step->factors[i], own[c], 2 * relaxation->shear[i] * (deviator(strain, c) - deviator(before, c)));
            stress[c] += next[i * HISTORY + c];
        }
        next[i * HISTORY + TENSOR] = maxwell_step(step->factors[i], own[TENSOR], relaxation->bulk[i] * (trace_of(strain) - trace_of(before)));
        mean += next[i * HISTORY + TENSOR];
    }
    for (int c = 0; c < 3; c++)
        stress[c] += mean;
}

void relaxation_step(struct relaxation *relaxation, double time_step, const double *strain, double *stress, bool is_last)
{
    const struct step step = step_of(relaxation, time_step);
    const int d = relaxation->dimension;
    const size_t size = (size_t)relaxation->elements * HISTORY;
#pragma omp parallel for schedule(static) if (relaxation->points >= FEW_POINTS)
    for (size_t p = 0; p < relaxation->points; p++) {
        double *before = relaxation->strain + p * TENSOR, *history = relaxation->element + p * size;
        double now[TENSOR] = {0}, next[RKPM_ELEMENTS * HISTORY], found[TENSOR];
        for (int a = 0; a < d; a++)
            for (int b = a; b < d; b++)
                now[place_of[a][b]] = strain ? strain[(p * (size_t)d + (size_t)a) * (size_t)d + (size_t)b] : before[place_of[a][b]];
        if (relaxation->is_plane_stress)
            now[2] = strain_across(relaxation, &step, history, before, now[0] + now[1]);
        step_point(relaxation, &step, history, before, now, next, found);
        for (int a = 0; a < d; a++)
            for (int b = 0; b < d; b++)
                stress[(p * (size_t)d + (size_t)a) * (size_t)d + (size_t)b] = found[place_of[a][b]];
        if (is_last) {
            memcpy(before, now, sizeof now);
            memcpy(history, next, size * sizeof *next);
        }
    }
}
