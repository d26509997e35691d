/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rkpm/solver.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

/* --- unknowns: those of a row of the matrix, behind them the multipliers of its node --- */

static void number_unknowns(struct solver *solver)
{
    const struct body *body = solver->body;
    const struct held *held = &body->held;
    const int32_t d = body->dimension;
    for (size_t row = 0; row < body->nodes; row++) {
        const int32_t own = held->of_node[body->node[row]];
        solver->of_row[row] = solver->count;
        solver->count += d;
        if (own < 0)
            continue;
        solver->of_held[own] = solver->count;
        solver->count += d;
    }
}

/* Per unknown the first one that it is coupled with, also by the matrix's upper half. */
static void find_first(const struct solver *solver, int32_t *first)
{
    const struct body *body = solver->body;
    const struct sparse *matrix = &body->matrix;
    for (int32_t i = 0; i < solver->count; i++)
        first[i] = i;
    for (int32_t row = 0; row < matrix->count; row++)
        for (int a = 0; a < matrix->size; a++)
            first[solver->of_row[row] + a] = solver->of_row[matrix->column[matrix->first[row]]];
    for (size_t t = 0; t < body->held.terms; t++) {
        const struct held_term *term = &body->held.term[t];
        for (int a = 0; a < matrix->size; a++) {
            const int32_t multiplier = solver->of_held[term->row] + a, unknown = solver->of_row[body->number[term->node]] + a;
            const int32_t low = multiplier < unknown ? multiplier : unknown, high = multiplier < unknown ? unknown : multiplier;
            first[high] = low < first[high] ? low : first[high];
        }
    }
}

/* Elimination with row exchanges takes four times as much as that of half of the matrix. */
static enum solver_kind choose_kind(const struct solver *solver, double most_work)
{
    const struct body *body = solver->body;
    const double work = (double)solver->count * solver->width * solver->width;
    const bool is_half = body->is_symmetric && body->held.rows == 0;
    if (body->constraint != CONSTRAINT_LAGRANGE && work * (is_half ? 1 : 4) > most_work)
        return body->is_symmetric ? SOLVER_CONJUGATE : SOLVER_BICGSTAB;
    return is_half ? SOLVER_ENVELOPE : SOLVER_BANDED;
}

void solver_open(struct solver *solver, const struct body *body, double most_work)
{
    *solver = (struct solver){.body = body};
    solver->of_row = memory_array(body->nodes, sizeof *solver->of_row, "the linear system");
    solver->of_held = memory_array((size_t)body->held.rows, sizeof *solver->of_held, "the linear system");
    number_unknowns(solver);
    solver->first = memory_array((size_t)solver->count, sizeof *solver->first, "the linear system");
    find_first(solver, solver->first);
    for (int32_t i = 0; i < solver->count; i++)
        solver->width = i - solver->first[i] > solver->width ? i - solver->first[i] : solver->width;
    solver->kind = choose_kind(solver, most_work);
    solver->unknown = memory_array((size_t)solver->count, sizeof(double), "the linear system");
    solver->bytes = (double)solver->count * sizeof(double) * (solver->kind == SOLVER_ENVELOPE ? solver->width + 1.0 : 3.0 * solver->width + 1);
    if (!solver_iterates(solver))
        return;
    solver->bytes = (double)body->matrix.first[body->nodes] * body->dimension * body->dimension * sizeof(double);
    iteration_open(&solver->iteration, body);
}

/* Where an iteration does not get there elimination does, in its time. */
static bool eliminate_instead(struct solver *solver)
{
    iteration_close(&solver->iteration);
    solver->iteration = (struct iteration){0};
    solver->has_given_up = true;
    solver->kind = SOLVER_BANDED;
    return solver_factor(solver);
}

void solver_close(struct solver *solver)
{
    memory_free(solver->of_row);
    memory_free(solver->of_held);
    memory_free(solver->first);
    memory_free(solver->unknown);
    envelope_close(&solver->envelope);
    banded_close(&solver->banded);
    iteration_close(&solver->iteration);
}

/* --- the matrix --- */

static void fill_envelope(struct solver *solver)
{
    const struct sparse *matrix = &solver->body->matrix;
    const int d = matrix->size;
    envelope_open(&solver->envelope, solver->count, solver->first);
    for (int32_t row = 0; row < matrix->count; row++)
        for (size_t k = matrix->first[row]; k < matrix->first[row + 1] && matrix->column[k] <= row; k++)
            for (int a = 0; a < d; a++)
                for (int b = 0; b < d && (matrix->column[k] < row || b <= a); b++)
                    *envelope_at(&solver->envelope, solver->of_row[row] + a, solver->of_row[matrix->column[k]] + b) = matrix->value[k * (size_t)(d * d) + (size_t)(a * d + b)];
}

static void fill_banded(struct solver *solver)
{
    const struct body *body = solver->body;
    const struct sparse *matrix = &body->matrix;
    const int d = matrix->size;
    banded_close(&solver->banded);
    banded_open(&solver->banded, (size_t)solver->count, (size_t)solver->width);
    for (int32_t row = 0; row < matrix->count; row++)
        for (size_t k = matrix->first[row]; k < matrix->first[row + 1]; k++)
            for (int a = 0; a < d; a++)
                for (int b = 0; b < d; b++)
                    *banded_at(&solver->banded, (size_t)(solver->of_row[row] + a), (size_t)(solver->of_row[matrix->column[k]] + b)) =
                        matrix->value[k * (size_t)(d * d) + (size_t)(a * d + b)];
    for (size_t t = 0; t < body->held.terms; t++) {
        const struct held_term *term = &body->held.term[t];
        for (int a = 0; a < d; a++) {
            const size_t multiplier = (size_t)(solver->of_held[term->row] + a), unknown = (size_t)(solver->of_row[body->number[term->node]] + a);
            const double value = term->value * solver->scale;
            *banded_at(&solver->banded, multiplier, unknown) += value;
            *banded_at(&solver->banded, unknown, multiplier) += value;
        }
    }
}

/* Rows that are held are of the matrix's size, so that small pivots are those of singular systems. */
static double largest_of(const struct sparse *matrix)
{
    double largest = 0;
    for (size_t k = 0; k < matrix->first[matrix->count] * (size_t)(matrix->size * matrix->size); k++)
        largest = fmax(largest, fabs(matrix->value[k]));
    return largest > 0 ? largest : 1;
}

bool solver_factor(struct solver *solver)
{
    if (solver_iterates(solver) && iteration_factor(&solver->iteration))
        return true;
    if (solver->kind == SOLVER_CONJUGATE)
        return false;
    if (solver->kind == SOLVER_BICGSTAB)
        return eliminate_instead(solver);
    if (solver->kind == SOLVER_BANDED) {
        solver->scale = largest_of(&solver->body->matrix);
        fill_banded(solver);
        return banded_factor(&solver->banded);
    }
    fill_envelope(solver);
    envelope_factor(&solver->envelope);
    for (int32_t i = 0; i < solver->count; i++)
        if (!(solver->envelope.diagonal[i] > 0))
            return false;
    return true;
}

/* --- solutions --- */

bool solver_solve(struct solver *solver, const double *right, const double *given, double *coefficients)
{
    const struct body *body = solver->body;
    const int d = body->dimension;
    if (solver_iterates(solver) && iteration_solve(&solver->iteration, right, given, coefficients))
        return true;
    if (solver->kind == SOLVER_CONJUGATE || (solver->kind == SOLVER_BICGSTAB && !eliminate_instead(solver)))
        return false;
    for (size_t row = 0; row < body->nodes; row++)
        memcpy(solver->unknown + solver->of_row[row], right + row * (size_t)d, (size_t)d * sizeof(double));
    for (int32_t row = 0; row < body->held.rows; row++)
        for (int a = 0; a < d; a++)
            solver->unknown[solver->of_held[row] + a] = solver->scale * given[row * d + a];
    if (solver->kind == SOLVER_ENVELOPE)
        envelope_solve(&solver->envelope, solver->unknown);
    else
        banded_solve(&solver->banded, solver->unknown);
    for (size_t row = 0; row < body->nodes; row++)
        memcpy(coefficients + row * (size_t)d, solver->unknown + solver->of_row[row], (size_t)d * sizeof(double));
    return true;
}
