/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rkpm/iteration.h"
#include "base/memory.h"
#include "base/vector.h"

#include <math.h>
#include <string.h>

static const double TARGET = 1e-10; /* of the residual, over the right side */
enum { MOST_ITERATIONS = 20000, FEW_ROWS = 2000 };

/* --- held rows --- */

/* They follow the matrix's rows, so that those of neighbours are near each other. */
static void order_held(struct iteration *iteration)
{
    const struct body *body = iteration->body;
    int32_t next = 0;
    for (size_t row = 0; row < body->nodes; row++) {
        const int32_t held = body->held.of_node[body->node[row]];
        iteration->is_held[row] = held >= 0;
        if (held >= 0)
            iteration->place[held] = next++;
    }
}

static void open_held(struct iteration *iteration)
{
    const struct held *held = &iteration->body->held;
    int32_t width = 0;
    for (size_t t = 0; t < held->terms; t++) {
        const int32_t other = held->of_node[held->term[t].node];
        if (other < 0)
            continue;
        const int32_t apart = iteration->place[other] - iteration->place[held->term[t].row];
        width = apart > width ? apart : -apart > width ? -apart : width;
    }
    banded_open(&iteration->rows, (size_t)held->rows, (size_t)width);
    banded_open(&iteration->columns, (size_t)held->rows, (size_t)width);
    for (size_t t = 0; t < held->terms; t++) {
        const int32_t other = held->of_node[held->term[t].node];
        if (other < 0)
            continue;
        const size_t i = (size_t)iteration->place[held->term[t].row], j = (size_t)iteration->place[other];
        *banded_at(&iteration->rows, i, j) += held->term[t].value;
        *banded_at(&iteration->columns, j, i) += held->term[t].value;
    }
}

/* Coefficients of held nodes from the others and what is given (NULL: zeros). */
static void complete(struct iteration *iteration, const double *given, double *whole)
{
    const struct body *body = iteration->body;
    const struct held *held = &body->held;
    const int d = body->dimension;
    for (int a = 0; a < d; a++) {
        for (int32_t row = 0; row < held->rows; row++)
            iteration->held[iteration->place[row]] = given ? given[row * d + a] : 0;
        for (size_t t = 0; t < held->terms; t++)
            if (held->of_node[held->term[t].node] < 0)
                iteration->held[iteration->place[held->term[t].row]] -= held->term[t].value * whole[body->number[held->term[t].node] * d + a];
        banded_solve(&iteration->rows, iteration->held);
        for (int32_t row = 0; row < held->rows; row++)
            whole[body->number[held->node[row]] * d + a] = iteration->held[iteration->place[row]];
    }
}

/* What acts on held nodes goes to the others; theirs become zero. */
static void condense(struct iteration *iteration, double *force)
{
    const struct body *body = iteration->body;
    const struct held *held = &body->held;
    const int d = body->dimension;
    for (int a = 0; a < d; a++) {
        for (int32_t row = 0; row < held->rows; row++) {
            double *own = &force[body->number[held->node[row]] * d + a];
            iteration->held[iteration->place[row]] = *own;
            *own = 0;
        }
        banded_solve(&iteration->columns, iteration->held);
        for (size_t t = 0; t < held->terms; t++)
            if (held->of_node[held->term[t].node] < 0)
                force[body->number[held->term[t].node] * d + a] -= held->term[t].value * iteration->held[iteration->place[held->term[t].row]];
    }
}

/* --- what the iteration asks for --- */

static void apply(void *context, const double *x, double *y)
{
    struct iteration *iteration = context;
    const struct body *body = iteration->body;
    if (body->held.rows == 0) {
        sparse_multiply(&body->matrix, x, y);
        return;
    }
    memcpy(iteration->whole, x, body->nodes * (size_t)body->dimension * sizeof *x);
    complete(iteration, NULL, iteration->whole);
    sparse_multiply(&body->matrix, iteration->whole, y);
    condense(iteration, y);
}

static void precondition(void *context, const double *r, double *z)
{
    struct iteration *iteration = context;
    const size_t d = (size_t)iteration->body->dimension, rows = iteration->body->nodes;
#pragma omp parallel for schedule(static) if (rows >= FEW_ROWS)
    for (size_t row = 0; row < rows; row++) {
        const double *inverse = iteration->inverse + row * d * d;
        for (size_t a = 0; a < d; a++) {
            double sum = 0;
            for (size_t b = 0; b < d && !iteration->is_held[row]; b++)
                sum += inverse[a * d + b] * r[row * d + b];
            z[row * d + a] = sum;
        }
    }
    coarse_add(&iteration->coarse, iteration->is_held, r, z);
}

static void precondition_unsymmetric(void *context, const double *r, double *z)
{
    const struct iteration *iteration = context;
    incomplete_solve(&iteration->incomplete, r, z);
}

/* --- the whole --- */

void iteration_open(struct iteration *iteration, const struct body *body)
{
    const size_t d = (size_t)body->dimension, count = body->nodes * d;
    *iteration = (struct iteration){.body = body};
    iteration->is_held = memory_array(body->nodes, sizeof *iteration->is_held, "the linear system");
    iteration->place = memory_array((size_t)body->held.rows, sizeof *iteration->place, "the linear system");
    iteration->held = memory_array((size_t)body->held.rows, sizeof(double), "the linear system");
    iteration->whole = memory_array(count, sizeof(double), "the linear system");
    iteration->image = memory_array(count, sizeof(double), "the linear system");
    iteration->residual = memory_array(count, sizeof(double), "the linear system");
    iteration->solution = memory_array(count, sizeof(double), "the linear system");
    order_held(iteration);
    if (!body->is_symmetric) {
        incomplete_open(&iteration->incomplete, &body->matrix);
        return;
    }
    iteration->inverse = memory_array(count * d, sizeof(double), "the linear system");
    coarse_open(&iteration->coarse, body);
}

void iteration_close(struct iteration *iteration)
{
    if (!iteration->body)
        return;
    memory_free(iteration->is_held);
    memory_free(iteration->place);
    memory_free(iteration->held);
    memory_free(iteration->inverse);
    memory_free(iteration->whole);
    memory_free(iteration->image);
    memory_free(iteration->residual);
    memory_free(iteration->solution);
    banded_close(&iteration->rows);
    banded_close(&iteration->columns);
    coarse_close(&iteration->coarse);
    incomplete_close(&iteration->incomplete);
    conjugate_close(&iteration->conjugate);
    bicgstab_close(&iteration->bicgstab);
}

/* What symmetric matrices are preconditioned by; false where a node has no stiffness. */
static bool invert_diagonal(struct iteration *iteration)
{
    const struct body *body = iteration->body;
    const int d = body->dimension;
    bool good = true;
    for (int32_t row = 0; row < (int32_t)body->nodes; row++)
        good = sparse_invert(d, sparse_block(&body->matrix, row, row), iteration->inverse + (size_t)row * (size_t)(d * d)) && good;
    if (good)
        coarse_factor(&iteration->coarse, iteration->is_held);
    return good;
}

bool iteration_factor(struct iteration *iteration)
{
    const struct body *body = iteration->body;
    bool good = true;
    if (body->held.rows > 0) {
        banded_close(&iteration->rows);
        banded_close(&iteration->columns);
        open_held(iteration);
        good = banded_factor(&iteration->rows) && banded_factor(&iteration->columns);
    }
    if (!good)
        return false;
    return body->is_symmetric ? invert_diagonal(iteration) : incomplete_factor(&iteration->incomplete, iteration->is_held);
}

/* The solution to a right side, which becomes what is left of it; false where that is not small. */
static bool iterate(struct iteration *iteration, double *residual)
{
    const size_t count = iteration->body->nodes * (size_t)iteration->body->dimension;
    const double target = TARGET * vector_length(residual, count);
    if (iteration->body->is_symmetric) {
        const struct conjugate_problem problem = {iteration, apply, precondition, count};
        const struct conjugate_result result = conjugate_solve(&problem, &iteration->conjugate, iteration->solution, residual, target, MOST_ITERATIONS);
        iteration->iterations = result.iterations;
        return result.ending == CONJUGATE_FOUND;
    }
    const struct bicgstab_problem problem = {iteration, apply, precondition_unsymmetric, count};
    const struct bicgstab_result result = bicgstab_solve(&problem, &iteration->bicgstab, iteration->solution, residual, MOST_ITERATIONS);
    iteration->iterations = result.iterations;
    return result.residual <= target;
}

bool iteration_solve(struct iteration *iteration, const double *right, const double *given, double *coefficients)
{
    const struct body *body = iteration->body;
    const size_t count = body->nodes * (size_t)body->dimension;
    double *residual = iteration->residual, *particular = iteration->image;
    memcpy(residual, right, count * sizeof *residual);
    if (body->held.rows > 0) {
        memset(particular, 0, count * sizeof *particular);
        complete(iteration, given, particular);
        sparse_multiply(&body->matrix, particular, iteration->whole);
        vector_add(residual, -1, iteration->whole, count);
        condense(iteration, residual);
    }
    if (!iterate(iteration, residual))
        return false;
    memcpy(coefficients, iteration->solution, count * sizeof *coefficients);
    if (body->held.rows > 0)
        complete(iteration, given, coefficients);
    return true;
}
