/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Preconditioned conjugate gradients (Hestenes and Stiefel, J. Res. NBS 49, 1952) for symmetric systems
 * that are given by what they do to a vector. */
#ifndef BASE_CONJUGATE_H
#define BASE_CONJUGATE_H

#include <stddef.h>

/* A x = b: A positive, or semidefinite with a right side that it can reach. */
struct conjugate_problem {
    void *context;
    void (*apply)(void *context, const double *x, double *y);        /* y = A x */
    void (*precondition)(void *context, const double *r, double *z); /* z = B r, B positive, near the inverse of A */
    size_t count;
};

enum conjugate_ending {
    CONJUGATE_FOUND,
    CONJUGATE_LIMIT,   /* as many iterations as allowed */
    CONJUGATE_SINGULAR /* the right side acts on something that has no stiffness */
};

struct conjugate_result {
    enum conjugate_ending ending;
    long iterations;
    double residual; /* length of b - A x, as the iteration carries it along */
};

/* Room for the iteration; grows with the problems. Start with zeros. */
struct conjugate_room {
    double *direction, *image, *preconditioned;
    size_t direction_capacity, image_capacity, preconditioned_capacity;
};

void conjugate_close(struct conjugate_room *room);

/* Finds x from x = 0 on until the residual is at most `target`. `residual` holds b before and b - A x
 * after. */
struct conjugate_result conjugate_solve(const struct conjugate_problem *problem, struct conjugate_room *room, double *x,
                                        double *residual, double target, long limit);

#endif
