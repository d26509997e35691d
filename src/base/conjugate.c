/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/conjugate.h"
#include "base/memory.h"
#include "base/vector.h"

#include <string.h>

/* Energy of a direction, in that of the preconditioner, below which it is taken for no energy: the
 * round-off of the sums behind it. */
static const double LEAST_ENERGY = 1e-13;

void conjugate_close(struct conjugate_room *room)
{
    memory_free(room->direction);
    memory_free(room->image);
    memory_free(room->preconditioned);
}

static void make_room(struct conjugate_room *room, size_t count)
{
    const char *purpose = "conjugate gradients";
    room->direction = memory_grow(room->direction, &room->direction_capacity, count, sizeof(double), purpose);
    room->image = memory_grow(room->image, &room->image_capacity, count, sizeof(double), purpose);
    room->preconditioned =
        memory_grow(room->preconditioned, &room->preconditioned_capacity, count, sizeof(double), purpose);
}

struct conjugate_result conjugate_solve(const struct conjugate_problem *problem, struct conjugate_room *room, double *x,
                                        double *residual, double target, long limit)
{
    const size_t count = problem->count;
    struct conjugate_result result = {.ending = CONJUGATE_FOUND, .residual = vector_length(residual, count)};
    double before = 0, size = 0; /* r B r of the iteration before; p B^-1 p of the direction */
    make_room(room, count);
    double *p = room->direction, *q = room->image, *z = room->preconditioned;
    memset(x, 0, count * sizeof *x);
    memset(p, 0, count * sizeof *p);
    while (result.residual > target) {
        if (result.iterations == limit) {
            result.ending = CONJUGATE_LIMIT;
            break;
        }
        problem->precondition(problem->context, residual, z);
        double now = vector_dot(residual, z, count), share = before > 0 ? now / before : 0;
        vector_renew(p, z, share, count);
        size = now + share * share * size;
        problem->apply(problem->context, p, q);
        double energy = vector_dot(p, q, count);
        if (!(energy > LEAST_ENERGY * size)) {
            result.ending = CONJUGATE_SINGULAR;
            break;
        }
        vector_add(x, now / energy, p, count);
        vector_add(residual, -now / energy, q, count);
        result.residual = vector_length(residual, count);
        result.iterations++;
        before = now;
    }
    return result;
}
