/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A problem from one level to the next, and its state between them. */
#include "base/checkpoint.h"
#include "rkpm/rkpm.h"

#include <math.h>
#include <stdio.h>

void rkpm_stop_at(struct rkpm *rkpm, const double x[3])
{
    struct instability *instability = &rkpm->instability;
    *instability = (struct instability){.is_stopped = true, .particle = -1};
    snprintf(instability->cause, sizeof instability->cause, "too few nodes are near the point (%.6g, %.6g, %.6g) for linear functions", x[0], x[1], x[2]);
    snprintf(instability->advice, sizeof instability->advice, "take a larger supp");
}

const struct shape_row *rkpm_row(struct rkpm *rkpm, struct rkpm_level *level, const double x[3], enum gradient_form gradient)
{
    const struct shape_row *row = rkpm_shape_at(&level->shape, x, gradient);
    if (row->order < 1 && !rkpm->instability.is_stopped)
        rkpm_stop_at(rkpm, x);
    return row;
}

void rkpm_set_field(struct rkpm *rkpm, const struct rkpm_level *level)
{
    rkpm->field.wave_number = rkpm->words->wave_number / (rkpm->words->wave_over_spacing ? level->box.spacing[0] : 1);
}

/* Coefficients are the values at the nodes. */
static void approximate(struct rkpm *rkpm, struct rkpm_level *level)
{
    for (size_t i = 0; i < level->count; i++)
        level->coefficient[i] = field_value(&rkpm->field, (const double[3]){level->x[0][i], level->x[1][i], level->x[2][i]});
}

/* u^h and its coefficients at the nodes, for output. */
static void show(struct rkpm *rkpm, struct rkpm_level *level)
{
    for (size_t n = 0; n < level->count; n++) {
        const double x[3] = {level->x[0][n], level->x[1][n], level->x[2][n]};
        const struct shape_row *row = rkpm_row(rkpm, level, x, GRADIENT_NONE);
        double value = 0;
        for (int i = 0; i < row->count; i++)
            value += row->value[i] * level->coefficient[row->node[i]];
        rkpm->store->real[COLUMN_COEFFICIENT][0][n] = level->coefficient[n];
        rkpm->store->real[COLUMN_FIELD][0][n] = value;
    }
}

bool rkpm_goes_on(const struct rkpm *rkpm)
{
    return rkpm->words->problem == PROBLEM_CREEP ? rkpm->creep.next < rkpm->creep.n_steps : (size_t)rkpm->step < rkpm->n_levels;
}

/* A step in time. */
static struct instability advance_time(struct rkpm *rkpm)
{
    timers_enter(rkpm->timers, PHASE_SYSTEM);
    rkpm_elastic_step(rkpm, rkpm->levels);
    rkpm->step++;
    rkpm->updates += (double)rkpm->levels->count;
    timers_enter(rkpm->timers, PHASE_OTHER);
    return rkpm->instability;
}

struct instability rkpm_advance(struct rkpm *rkpm)
{
    if (rkpm->words->problem == PROBLEM_CREEP)
        return advance_time(rkpm);
    struct rkpm_level *level = &rkpm->levels[rkpm->step++];
    rkpm->time = (double)rkpm->step;
    rkpm_set_field(rkpm, level);
    timers_enter(rkpm->timers, PHASE_SYSTEM);
    if (rkpm->words->problem == PROBLEM_APPROXIMATION)
        approximate(rkpm, level);
    else if (scene_rkpm_has_body(rkpm->words))
        rkpm_elastic_solve(rkpm, level);
    else
        rkpm_system_solve(rkpm, level);
    timers_enter(rkpm->timers, PHASE_SUMS);
    rkpm_measure(rkpm, level);
    if ((size_t)rkpm->step == rkpm->n_levels)
        scene_rkpm_has_body(rkpm->words) ? rkpm_elastic_show(rkpm, level) : show(rkpm, level);
    rkpm->updates += (double)level->count;
    if (!rkpm->instability.is_stopped && !isfinite(level->result.h1)) {
        rkpm->instability = (struct instability){.is_stopped = true, .particle = -1, .cause = "the solution is not finite",
                                                 .advice = "take a larger supp"};
    }
    timers_enter(rkpm->timers, PHASE_OTHER);
    return rkpm->instability;
}

void rkpm_exchange(struct rkpm *rkpm, struct checkpoint *checkpoint)
{
    checkpoint_item(checkpoint, "step", &rkpm->step, sizeof rkpm->step, 1);
    checkpoint_item(checkpoint, "updates", &rkpm->updates, sizeof rkpm->updates, 1);
    if (checkpoint_is_reading(checkpoint) && checkpoint_is_good(checkpoint) && (rkpm->step < 0 || rkpm->step > (long)(rkpm->n_levels + rkpm->creep.n_steps)))
        checkpoint_reject(checkpoint, "step");
    for (size_t i = 0; i < rkpm->n_levels; i++)
        checkpoint_item(checkpoint, "result", &rkpm->levels[i].result, sizeof rkpm->levels[i].result, 1);
    if (rkpm->creep.body)
        creep_exchange(&rkpm->creep, checkpoint);
    checkpoint_item(checkpoint, "time", &rkpm->time, sizeof rkpm->time, 1);
    store_exchange(rkpm->store, checkpoint, 1);
}
