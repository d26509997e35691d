/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elastic problems: the displacements that a level finds, and their error against exact ones. */
#include "base/memory.h"
#include "rkpm/rkpm.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* --- opening --- */

static void displacement(void *context, const double x[3], double u[3])
{
    deformation_value(context, x, u);
}

/* Displacements at held points of faces, exact tractions at the others. */
static void give_faces(struct rkpm *rkpm, struct body *body)
{
    const struct points *faces = &body->faces;
    const int d = body->dimension;
    for (size_t i = 0; i < faces->count; i++) {
        const double x[3] = {faces->x[0][i], faces->x[1][i], faces->x[2][i]};
        double u[3], traction[3];
        deformation_value(&rkpm->deformation, x, u);
        deformation_traction(&rkpm->deformation, x, faces->axis[i], faces->side[i], traction);
        for (int a = 0; a < d; a++)
            body->given[i * (size_t)d + (size_t)a] = body->is_held[i] ? u[a] : traction[a];
    }
}

void rkpm_elastic_open(struct rkpm *rkpm, struct rkpm_level *level)
{
    const struct scene_rkpm *words = rkpm->words;
    struct body *body = &level->body;
    body_open(body, words, &level->box, level->count, level->x, &level->shape, rkpm->gauss, rkpm->boundary_gauss, level->beta * words->young);
    if (words->problem == PROBLEM_ELASTIC)
        solver_open(&level->solver, body, SOLVER_MOST_WORK);
    level->shape.enlarged += body->inside.enlarged + body->faces.enlarged;
    level->shape.lowered += body->inside.lowered + body->faces.lowered;
    give_faces(rkpm, body);
    if (words->problem == PROBLEM_CREEP)
        creep_open(&rkpm->creep, words, body);
}

void rkpm_elastic_close(struct rkpm_level *level)
{
    solver_close(&level->solver);
    body_close(&level->body);
}

/* --- the solution --- */

/* Whether linear functions could be kept everywhere; else the problem ends. */
static bool has_neighbours(struct rkpm *rkpm, const struct body *body)
{
    if (body->inside.lowered == 0 && body->faces.lowered == 0)
        return true;
    rkpm_stop_at(rkpm, body->inside.lowered > 0 ? body->inside.bad : body->faces.bad);
    return false;
}

static void stop_unsolved(struct rkpm *rkpm, const struct solver *solver)
{
    static const char *const causes[] = {[SOLVER_ENVELOPE] = "not positive: the boundary is held too weakly, or to rounding error",
                                         [SOLVER_BANDED] = "singular",
                                         [SOLVER_CONJUGATE] = "not solved by conjugate gradients: it is not positive, or nearly singular"};
    struct instability *instability = &rkpm->instability;
    *instability = (struct instability){.is_stopped = true, .particle = -1};
    snprintf(instability->cause, sizeof instability->cause, "the linear system is %s", causes[solver->kind]);
    snprintf(instability->advice, sizeof instability->advice, "%s",
             solver->kind == SOLVER_BANDED ? "take cons nits, or a larger supp" : "take a larger beta, or more held sides");
}

void rkpm_elastic_solve(struct rkpm *rkpm, struct rkpm_level *level)
{
    struct body *body = &level->body;
    const size_t d = (size_t)body->dimension;
    if (!has_neighbours(rkpm, body))
        return;
    double *right = memory_array(body->nodes * d, sizeof(double), "the linear system");
    double *given = memory_array((size_t)body->held.rows * d, sizeof(double), "the linear system");
    body_assemble(body, rkpm->deformation.moduli);
    body_load(body, rkpm->deformation.moduli, right);
    if (body->constraint == CONSTRAINT_TRANSFORMATION)
        held_give_nodes(&body->held, body->x, body->dimension, displacement, &rkpm->deformation, given);
    else if (body->constraint == CONSTRAINT_LAGRANGE)
        held_give_hats(&body->held, body->box, &body->faces, body->is_held, displacement, &rkpm->deformation, given);
    if (solver_factor(&level->solver) && solver_solve(&level->solver, right, given, right))
        body_by_nodes(body, right, level->coefficient);
    else
        stop_unsolved(rkpm, &level->solver);
    memory_free(right);
    memory_free(given);
}

/* --- its error --- */

/* Sums of squares. */
struct errors {
    struct rkpm *rkpm;
    struct rkpm_level *level;
    double value[3], exact, gradient, energy, whole;
};

/* u^h, and where `gradient` is not NULL its gradient, at a point. */
static void find_displacement(struct rkpm *rkpm, struct rkpm_level *level, const double x[3], double u[3], double gradient[3][3])
{
    const struct shape_row *row = rkpm_row(rkpm, level, x, gradient ? rkpm->words->gradient : GRADIENT_NONE);
    const size_t d = (size_t)level->box.dimension;
    memset(u, 0, 3 * sizeof *u);
    if (gradient)
        memset(gradient, 0, 9 * sizeof **gradient);
    for (int k = 0; k < row->count; k++)
        for (size_t a = 0; a < d; a++) {
            const double coefficient = level->coefficient[(size_t)row->node[k] * d + a];
            u[a] += row->value[k] * coefficient;
            for (size_t b = 0; b < d && gradient; b++)
                gradient[a][b] += row->gradient[b][k] * coefficient;
        }
}

static double work(int dimension, double stress[3][3], double gradient[3][3])
{
    double sum = 0;
    for (int a = 0; a < dimension; a++)
        for (int b = 0; b < dimension; b++)
            sum += stress[a][b] * gradient[a][b];
    return sum;
}

static void add_errors(void *context, const struct quadrature_point *point)
{
    struct errors *errors = context;
    const struct deformation *deformation = &errors->rkpm->deformation;
    const int d = deformation->dimension;
    double u[3], exact[3], gradient[3][3], slope[3][3], stress[3][3];
    find_displacement(errors->rkpm, errors->level, point->x, u, gradient);
    deformation_value(deformation, point->x, exact);
    deformation_gradient(deformation, point->x, slope);
    deformation_stress(d, deformation->moduli, slope, stress);
    errors->whole += point->weight * work(d, stress, slope);
    for (int a = 0; a < d; a++) {
        errors->value[a] += point->weight * (u[a] - exact[a]) * (u[a] - exact[a]);
        errors->exact += point->weight * exact[a] * exact[a];
        for (int b = 0; b < d; b++) {
            gradient[a][b] -= slope[a][b];
            errors->gradient += point->weight * gradient[a][b] * gradient[a][b];
        }
    }
    deformation_stress(d, deformation->moduli, gradient, stress);
    errors->energy += point->weight * work(d, stress, gradient);
}

/* The last component of the displacement in the middle of the high face along x; over the exact one, where there is one. */
static double tip_of(struct rkpm *rkpm, struct rkpm_level *level)
{
    const struct deformation *deformation = &rkpm->deformation;
    const int last = deformation->dimension - 1;
    double x[3] = {deformation->high[0]}, u[3], exact[3];
    for (int a = 1; a < deformation->dimension; a++)
        x[a] = 0.5 * (deformation->low[a] + deformation->high[a]);
    find_displacement(rkpm, level, x, u, NULL);
    deformation_value(deformation, x, exact);
    if (rkpm->words->problem == PROBLEM_CREEP)
        return u[last];
    return exact[last] != 0 ? u[last] / exact[last] : 0;
}

void rkpm_elastic_measure(struct rkpm *rkpm, struct rkpm_level *level)
{
    struct errors errors = {.rkpm = rkpm, .level = level};
    struct rkpm_result *result = &level->result;
    double value = 0;
    quadrature_inside(&level->box, rkpm->norm_gauss, add_errors, &errors);
    for (int a = 0; a < 3; a++) {
        result->l2_along[a] = sqrt(errors.value[a]);
        value += errors.value[a];
    }
    result->l2 = sqrt(value);
    result->l2_relative = errors.exact > 0 ? sqrt(value / errors.exact) : 0;
    result->h1 = sqrt(value + errors.gradient);
    result->energy = errors.whole > 0 ? sqrt(errors.energy / errors.whole) : 0;
    result->tip = tip_of(rkpm, level);
}

void rkpm_elastic_show(struct rkpm *rkpm, struct rkpm_level *level)
{
    struct store *store = rkpm->store;
    const size_t d = (size_t)level->box.dimension;
    for (size_t n = 0; n < level->count; n++) {
        double u[3], exact[3];
        const double x[3] = {level->x[0][n], level->x[1][n], level->x[2][n]};
        find_displacement(rkpm, level, x, u, NULL);
        deformation_value(&rkpm->deformation, x, exact);
        for (size_t a = 0; a < 3; a++)
            store->real[COLUMN_POSITION][a][n] = x[a] + u[a];
        store->real[COLUMN_FIELD][0][n] = u[d - 1];
        store->real[COLUMN_EXACT][0][n] = exact[d - 1];
        store->real[COLUMN_COEFFICIENT][0][n] = level->coefficient[n * d + d - 1];
    }
}

void rkpm_elastic_step(struct rkpm *rkpm, struct rkpm_level *level)
{
    struct creep *creep = &rkpm->creep;
    const struct creep_step *step = &creep->steps[creep->next];
    if (!has_neighbours(rkpm, &level->body))
        return;
    if (!creep_advance(creep)) {
        stop_unsolved(rkpm, &creep->solver[step->length == 0]);
        return;
    }
    body_by_nodes(&level->body, creep->coefficient, level->coefficient);
    rkpm->time = step->time;
    rkpm->load = step->load;
    rkpm->tip = tip_of(rkpm, level);
    if (!rkpm_goes_on(rkpm))
        rkpm_elastic_show(rkpm, level);
}
