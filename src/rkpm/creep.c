/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rkpm/creep.h"
#include "base/checkpoint.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

enum { FEW_POINTS = 500 };

/* --- steps --- */

static void add_step(struct creep *creep, double time, double length, double load)
{
    creep->steps = memory_grow(creep->steps, &creep->step_capacity, creep->n_steps + 1, sizeof *creep->steps, "steps");
    creep->steps[creep->n_steps++] = (struct creep_step){time, length, load};
}

/* Equal steps from one moment to another. */
static void add_span(struct creep *creep, double from, double to, double longest, double load)
{
    const double count = ceil((to - from) / longest * (1 - 1e-12));
    for (double i = 1; i <= count; i++)
        add_step(creep, from + (to - from) * i / count, (to - from) / count, load);
}

static void make_steps(struct creep *creep, const struct scene_rkpm *words)
{
    double time = 0, load = 0;
    for (int i = 0; i < words->n_loads; i++) {
        add_span(creep, time, words->loads[i][0], words->time_step, load);
        time = words->loads[i][0];
        load = words->loads[i][1];
        add_step(creep, time, 0, load);
    }
    add_span(creep, time, words->end_time, words->time_step, load);
}

/* --- opening and closing --- */

void creep_open(struct creep *creep, const struct scene_rkpm *words, struct body *body)
{
    const size_t d = (size_t)body->dimension, count = body->nodes * d, points = body->inside.count * (size_t)body->inside.rows;
    *creep = (struct creep){.body = body, .solved_length = {-1, -1}, .latest = -1};
    make_steps(creep, words);
    relaxation_open(&creep->relaxation, words, points);
    for (int i = 0; i < 2; i++)
        solver_open(&creep->solver[i], body, SOLVER_MOST_WORK);
    creep->force = memory_array(count, sizeof(double), "the linear system");
    creep->right = memory_array(count, sizeof(double), "the linear system");
    creep->coefficient = memory_array(count, sizeof(double), "the linear system");
    creep->given = memory_array((size_t)body->held.rows * d, sizeof(double), "the linear system");
    creep->strain = memory_array(points * d * d, sizeof(double), "stresses");
    creep->stress = memory_array(points * d * d, sizeof(double), "stresses");
    body_load(body, (struct moduli){0}, creep->force);
    body_add_weight(body, words->weight, creep->force);
}

void creep_close(struct creep *creep)
{
    if (!creep->body)
        return;
    relaxation_close(&creep->relaxation);
    for (int i = 0; i < 2; i++)
        solver_close(&creep->solver[i]);
    memory_free(creep->steps);
    memory_free(creep->force);
    memory_free(creep->right);
    memory_free(creep->coefficient);
    memory_free(creep->given);
    memory_free(creep->strain);
    memory_free(creep->stress);
}

/* --- a step --- */

/* The solver of a step's length, with its factors; NULL where there are none. An iteration also works with the body's matrix. */
static struct solver *solver_for(struct creep *creep, double length)
{
    const int which = length == 0;
    struct solver *solver = &creep->solver[which];
    const bool is_current = creep->solved_length[which] == length && (!solver_iterates(solver) || creep->latest == which);
    if (is_current)
        return solver;
    body_assemble(creep->body, relaxation_moduli(&creep->relaxation, length));
    creep->latest = which;
    creep->solved_length[which] = solver_factor(solver) ? length : -1;
    return creep->solved_length[which] < 0 ? NULL : solver;
}

/* Symmetric gradients of the displacements. */
static void find_strains(struct creep *creep)
{
    const struct body *body = creep->body;
    const struct points *points = &body->inside;
    const int d = body->dimension;
#pragma omp parallel for schedule(static) if (points->count >= FEW_POINTS)
    for (size_t point = 0; point < points->count; point++)
        for (int row = 0; row < points->rows; row++) {
            double *strain = creep->strain + (point * (size_t)points->rows + (size_t)row) * (size_t)(d * d), slope[3][3] = {{0}};
            for (int k = 0; k < points->neighbours[point]; k++) {
                const int32_t node = points->neighbour[point * (size_t)points->stride + (size_t)k];
                const double *u = creep->coefficient + (size_t)body->number[node] * (size_t)d;
                for (int a = 0; a < d; a++)
                    for (int b = 0; b < d; b++)
                        slope[a][b] += u[a] * points_gradient(points, point, row, b)[k];
            }
            for (int a = 0; a < d; a++)
                for (int b = 0; b < d; b++)
                    strain[a * d + b] = 0.5 * (slope[a][b] + slope[b][a]);
        }
}

bool creep_advance(struct creep *creep)
{
    const struct creep_step *step = &creep->steps[creep->next];
    const size_t count = creep->body->nodes * (size_t)creep->body->dimension;
    struct solver *solver = solver_for(creep, step->length);
    if (!solver)
        return false;
    relaxation_step(&creep->relaxation, step->length, NULL, creep->stress, false);
    for (size_t i = 0; i < count; i++)
        creep->right[i] = step->load * creep->force[i];
    body_subtract_forces(creep->body, creep->stress, creep->right);
    if (!solver_solve(solver, creep->right, creep->given, creep->right))
        return false;
    for (size_t i = 0; i < count; i++)
        creep->coefficient[i] += creep->right[i];
    find_strains(creep);
    relaxation_step(&creep->relaxation, step->length, creep->strain, creep->stress, true);
    creep->next++;
    return true;
}

/* Factors are made anew. */
void creep_exchange(struct creep *creep, struct checkpoint *checkpoint)
{
    struct relaxation *relaxation = &creep->relaxation;
    long next = (long)creep->next;
    checkpoint_item(checkpoint, "creep step", &next, sizeof next, 1);
    if (checkpoint_is_reading(checkpoint) && checkpoint_is_good(checkpoint) && (next < 0 || (size_t)next > creep->n_steps))
        checkpoint_reject(checkpoint, "creep step");
    else
        creep->next = (size_t)next;
    checkpoint_item(checkpoint, "coefficients", creep->coefficient, sizeof(double), creep->body->nodes * (size_t)creep->body->dimension);
    checkpoint_item(checkpoint, "strains", relaxation->strain, sizeof(double), relaxation->points * RELAXATION_TENSOR);
    checkpoint_item(checkpoint, "elements", relaxation->element, sizeof(double),
                    relaxation->points * (size_t)relaxation->elements * (RELAXATION_TENSOR + 1));
}
