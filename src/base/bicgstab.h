/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stabilised biconjugate gradients (van der Vorst, SIAM J. Sci. Stat. Comput. 13, 1992) for systems that are not symmetric and
 * are given by what they do to a vector. */
#ifndef BASE_BICGSTAB_H
#define BASE_BICGSTAB_H

#include <stddef.h>

/* A x = b. */
struct bicgstab_problem {
    void *context;
    void (*apply)(void *context, const double *x, double *y);        /* y = A x */
    void (*precondition)(void *context, const double *r, double *z); /* z = B r, B near the inverse of A */
    size_t count;
};

struct bicgstab_result {
    long iterations; /* two products with A each */
    double residual; /* length of what is left of b */
};

enum { BICGSTAB_VECTORS = 8 };

/* Room for the iteration; grows with the problems. Start with zeros. */
struct bicgstab_room {
    double *vector[BICGSTAB_VECTORS];
    size_t capacity[BICGSTAB_VECTORS];
};

void bicgstab_close(struct bicgstab_room *room);

/* Finds x from x = 0 on, until the residual is round-off, stagnates, or the limit of iterations is reached; whether it is small
 * enough is the caller's to say. The iteration starts anew from the residual of what is found so far each time that this has
 * become much smaller, and where it stagnates. `residual` holds b before and b - A x after. */
struct bicgstab_result bicgstab_solve(const struct bicgstab_problem *problem, struct bicgstab_room *room, double *x, double *residual, long limit);

#endif
