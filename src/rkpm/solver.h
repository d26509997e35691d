/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solves the linear systems of bodies: directly, by an envelope or a band, or by an iteration where that takes less. */
#ifndef RKPM_SOLVER_H
#define RKPM_SOLVER_H

#include "base/banded.h"
#include "base/envelope.h"
#include "rkpm/iteration.h"

enum solver_kind { SOLVER_ENVELOPE, SOLVER_BANDED, SOLVER_CONJUGATE, SOLVER_BICGSTAB };

struct solver {
    enum solver_kind kind;
    const struct body *body;
    int32_t *of_row;     /* per row of the body's matrix: its first unknown */
    int32_t *of_held;    /* per held row: its first multiplier */
    int32_t *first;      /* per unknown: the first one that it is coupled with */
    int32_t count, width;
    double scale;        /* of held rows */
    struct envelope envelope;
    struct banded banded;
    struct iteration iteration;
    double *unknown;
    bool has_given_up;   /* an iteration did not get there: eliminated since */
    double bytes;
};

/* Multiplications that a direct solution may take; above iterations take over, which need a matrix without multipliers of hats:
 * conjugate gradients, or stabilised biconjugate ones where it is not symmetric. Where those fail it is eliminated all the same. */
static const double SOLVER_MOST_WORK = 2e9;

static inline bool solver_iterates(const struct solver *solver)
{
    return solver->kind == SOLVER_CONJUGATE || solver->kind == SOLVER_BICGSTAB;
}

/* An iteration has none for multipliers. */
static inline int32_t solver_unknowns(const struct solver *solver)
{
    return solver_iterates(solver) ? (int32_t)solver->body->nodes * solver->body->dimension : solver->count;
}

/* Makes room for systems of a body. */
void solver_open(struct solver *solver, const struct body *body, double most_work);
void solver_close(struct solver *solver);

/* Takes the body's matrix; false where it is singular, or not positive where it should be. */
bool solver_factor(struct solver *solver);

/* Coefficients by rows of the matrix from a right side; `given` are the held rows, D numbers each. False where an iteration
 * does not end; `right` and `coefficients` may be the same. */
bool solver_solve(struct solver *solver, const double *right, const double *given, double *coefficients);

#endif
