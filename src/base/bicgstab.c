/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/bicgstab.h"
#include "base/memory.h"
#include "base/vector.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* A cycle of iterations ends where its residual is this part of what it began with: the one that it carries along is not
 * b - A x to much more than that. */
static const double REDUCTION = 1e-8;

/* A cycle that reduces the residual by less than this stagnates. */
static const double LEAST_GAIN = 0.5;

/* What is left of the right side at round-off: what cycles reduce further is no more than corrections to x that it rounds off. */
static const double ROUND_OFF = 1e-16;

/* A product of two vectors below this part of their lengths is round-off. */
static const double LEAST_PRODUCT = 1e-14;

enum { STAGNANT = 200 }; /* iterations of a cycle without a smaller residual */

enum vector { SHADOW, DIRECTION, IMAGE, PRECONDITIONED, STABILISER, CORRECTION, BEST, CARRIED };
_Static_assert(CARRIED + 1 == BICGSTAB_VECTORS, "as many as there is room for");

void bicgstab_close(struct bicgstab_room *room)
{
    for (int i = 0; i < BICGSTAB_VECTORS; i++)
        memory_free(room->vector[i]);
}

/* What a cycle carries along from one iteration to the next. */
struct cycle {
    const struct bicgstab_problem *problem;
    double *const *vector;
    double product, step, damping; /* shadow . residual, alpha, omega */
    double shadow, carried;        /* lengths */
};

static bool is_small(double product, double a, double b)
{
    return !(fabs(product) > LEAST_PRODUCT * a * b);
}

/* Half an iteration, along the direction that biconjugate gradients take; false where it breaks down. */
static bool step_along(struct cycle *cycle)
{
    const struct bicgstab_problem *problem = cycle->problem;
    const size_t count = problem->count;
    double *const *v = cycle->vector;
    const double product = vector_dot(v[SHADOW], v[CARRIED], count);
    if (is_small(product, cycle->shadow, cycle->carried))
        return false;
    vector_add(v[DIRECTION], -cycle->damping, v[IMAGE], count);
    vector_renew(v[DIRECTION], v[CARRIED], product / cycle->product * cycle->step / cycle->damping, count);
    problem->precondition(problem->context, v[DIRECTION], v[PRECONDITIONED]);
    problem->apply(problem->context, v[PRECONDITIONED], v[IMAGE]);
    const double along = vector_dot(v[SHADOW], v[IMAGE], count);
    if (is_small(along, cycle->shadow, vector_length(v[IMAGE], count)))
        return false;
    cycle->product = product;
    cycle->step = product / along;
    vector_add(v[CORRECTION], cycle->step, v[PRECONDITIONED], count);
    vector_add(v[CARRIED], -cycle->step, v[IMAGE], count);
    return true;
}

/* The other half: the residual's own direction, as far as makes it smallest; false where that is nowhere. */
static bool stabilise(struct cycle *cycle)
{
    const struct bicgstab_problem *problem = cycle->problem;
    const size_t count = problem->count;
    double *const *v = cycle->vector;
    problem->precondition(problem->context, v[CARRIED], v[PRECONDITIONED]);
    problem->apply(problem->context, v[PRECONDITIONED], v[STABILISER]);
    const double along = vector_dot(v[STABILISER], v[CARRIED], count), square = vector_dot(v[STABILISER], v[STABILISER], count);
    if (is_small(along, sqrt(square), vector_length(v[CARRIED], count)))
        return false;
    cycle->damping = along / square;
    vector_add(v[CORRECTION], cycle->damping, v[PRECONDITIONED], count);
    vector_add(v[CARRIED], -cycle->damping, v[STABILISER], count);
    return true;
}

/* The best correction to what is found so far, whose residual is given; returns iterations, at most so many. */
static long run_cycle(const struct bicgstab_problem *problem, double *const *v, const double *residual, double length, long most)
{
    const size_t bytes = problem->count * sizeof(double);
    struct cycle cycle = {problem, v, 1, 1, 1, length, length};
    double lowest = length;
    long iterations = 0, since = 0;
    memcpy(v[SHADOW], residual, bytes);
    memcpy(v[CARRIED], residual, bytes);
    memset(v[DIRECTION], 0, bytes);
    memset(v[IMAGE], 0, bytes);
    memset(v[CORRECTION], 0, bytes);
    memset(v[BEST], 0, bytes);
    bool goes_on = true;
    while (goes_on && lowest > REDUCTION * length && since < STAGNANT && iterations < most) {
        goes_on = step_along(&cycle) && stabilise(&cycle);
        cycle.carried = vector_length(v[CARRIED], problem->count);
        iterations++;
        since++;
        if (cycle.carried < lowest) {
            lowest = cycle.carried;
            since = 0;
            memcpy(v[BEST], v[CORRECTION], bytes);
        }
    }
    return iterations;
}

struct bicgstab_result bicgstab_solve(const struct bicgstab_problem *problem, struct bicgstab_room *room, double *x, double *residual, long limit)
{
    const size_t count = problem->count;
    double *const *v = room->vector;
    struct bicgstab_result result = {.residual = vector_length(residual, count)};
    for (int i = 0; i < BICGSTAB_VECTORS; i++)
        room->vector[i] = memory_grow(room->vector[i], &room->capacity[i], count, sizeof(double), "an iteration");
    memset(x, 0, count * sizeof *x);
    const double least = ROUND_OFF * result.residual;
    for (bool gains = true; gains && result.residual > least && result.iterations < limit;) {
        result.iterations += run_cycle(problem, v, residual, result.residual, limit - result.iterations);
        problem->apply(problem->context, v[BEST], v[IMAGE]);
        vector_add(residual, -1, v[IMAGE], count);
        vector_add(x, 1, v[BEST], count);
        const double now = vector_length(residual, count);
        gains = now < LEAST_GAIN * result.residual;
        result.residual = now;
    }
    return result;
}
