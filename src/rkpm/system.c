/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The linear system of div grad u + k^2 u = f with u = g at the boundary (3.18 to 3.22, 3.43 to 3.58; k = 0: Poisson):
 *     K = int (grad N . grad N - k^2 N N),  b = -int N f,
 * and for the boundary one of
 *     penalty       K + beta int N N,  b + beta int N g
 *     Nitsche       K - Kt - Kt^T + beta int N N,  Kt = int N dN/dn,  b + int (beta N - dN/dn) g
 *     multipliers   [K A^T; A 0] [d; lambda] = [b; q],  A = int H N,  q = int H g,  H: hats on boundary nodes
 *     transformation  the same with A = N(x_k), q = g(x_k), k: boundary nodes. That is T^T K T d_F = T^T (b - K c) of
 *                   the boundary nodes' rows, d = T d_F + c (spec 4), without the full matrix T.
 * Unknowns run along the axis with most nodes last, so that the band is narrow. */
#include "base/memory.h"
#include "rkpm/rkpm.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* What a visit to points works on. */
struct assembly {
    struct rkpm *rkpm;
    struct rkpm_level *level;
    int32_t *first; /* while the structure is looked for: per unknown, the first one that it is coupled with; then NULL */
};

static bool has_multipliers(const struct scene_rkpm *words)
{
    return words->constraint == CONSTRAINT_LAGRANGE || words->constraint == CONSTRAINT_TRANSFORMATION;
}

/* k^2 of the equation. */
static double wave_square(const struct rkpm *rkpm)
{
    const double k = rkpm->field.wave_number;
    return rkpm->words->problem == PROBLEM_HELMHOLTZ ? k * k : 0;
}

/* --- unknowns --- */

static void number_unknowns(const struct rkpm *rkpm, struct rkpm_level *level)
{
    struct rkpm_system *system = &level->system;
    const struct node_box *box = &level->box;
    int order[3];
    box_order_axes(box->numbers, order);
    system->of_node = memory_array(level->count, sizeof *system->of_node, "unknowns");
    system->of_multiplier = memory_array(level->count, sizeof *system->of_multiplier, "unknowns");
    for (size_t n = 0; n < level->count; n++) {
        const size_t node = box_node(box, order, n);
        system->of_node[node] = system->count++;
        system->of_multiplier[node] = has_multipliers(rkpm->words) && box_is_boundary(box, node) ? system->count++ : -1;
    }
}

/* --- numbers of the matrix --- */

/* Notes that the unknowns of a row, and one more where it is not negative, are coupled with each other. */
static void couple(struct assembly *assembly, const struct shape_row *row, int32_t other)
{
    const int32_t *unknown = assembly->level->system.of_node;
    int32_t low = other < 0 ? INT32_MAX : other;
    for (int i = 0; i < row->count; i++)
        low = unknown[row->node[i]] < low ? unknown[row->node[i]] : low;
    for (int i = 0; i < row->count; i++) {
        int32_t *first = &assembly->first[unknown[row->node[i]]];
        *first = low < *first ? low : *first;
    }
    if (other >= 0 && low < assembly->first[other])
        assembly->first[other] = low;
}

/* A number in a row and column, and in the column and row. */
static void add(struct rkpm_system *system, int32_t row, int32_t column, double value)
{
    if (system->is_definite) {
        *(row > column ? envelope_at(&system->envelope, row, column) : envelope_at(&system->envelope, column, row)) += value;
        return;
    }
    *banded_at(&system->banded, (size_t)row, (size_t)column) += value;
    if (row != column)
        *banded_at(&system->banded, (size_t)column, (size_t)row) += value;
}

static void add_inside(void *context, const struct quadrature_point *point)
{
    struct assembly *assembly = context;
    struct rkpm *rkpm = assembly->rkpm;
    struct rkpm_system *system = &assembly->level->system;
    const struct shape_row *row = rkpm_row(rkpm, assembly->level, point->x, assembly->first ? GRADIENT_NONE : rkpm->words->gradient);
    if (assembly->first) {
        couple(assembly, row, -1);
        return;
    }
    const double k2 = wave_square(rkpm), w = point->weight;
    const double source = field_laplacian(&rkpm->field, point->x) + k2 * field_value(&rkpm->field, point->x);
    for (int i = 0; i < row->count; i++) {
        const int32_t unknown = system->of_node[row->node[i]];
        system->right[unknown] -= w * row->value[i] * source;
        for (int j = 0; j <= i; j++) {
            double stiffness = -k2 * row->value[i] * row->value[j];
            for (int a = 0; a < assembly->level->box.dimension; a++)
                stiffness += row->gradient[a][i] * row->gradient[a][j];
            add(system, unknown, system->of_node[row->node[j]], w * stiffness);
        }
    }
}

/* --- the boundary --- */

/* Penalty, and with the derivative along the normal Nitsche's method. */
static void add_face(void *context, const struct quadrature_point *point)
{
    struct assembly *assembly = context;
    struct rkpm *rkpm = assembly->rkpm;
    struct rkpm_system *system = &assembly->level->system;
    const bool is_nitsche = rkpm->words->constraint == CONSTRAINT_NITSCHE;
    const struct shape_row *row = rkpm_row(rkpm, assembly->level, point->x, assembly->first ? GRADIENT_NONE : rkpm->words->gradient);
    if (assembly->first) {
        couple(assembly, row, -1);
        return;
    }
    const double *slope = row->gradient[point->axis], sign = is_nitsche ? point->side : 0;
    const double beta = assembly->level->beta, w = point->weight, given = field_value(&rkpm->field, point->x);
    for (int i = 0; i < row->count; i++) {
        const int32_t unknown = system->of_node[row->node[i]];
        system->right[unknown] += w * (beta * row->value[i] - sign * slope[i]) * given;
        for (int j = 0; j <= i; j++)
            add(system, unknown, system->of_node[row->node[j]],
                w * (beta * row->value[i] * row->value[j] - sign * (row->value[i] * slope[j] + slope[i] * row->value[j])));
    }
}

/* A row of A and q: the multiplier of a node, times the shape functions of a point. */
static void add_constraint(struct assembly *assembly, size_t node, double factor, const struct shape_row *row, double given)
{
    struct rkpm_system *system = &assembly->level->system;
    const int32_t multiplier = system->of_multiplier[node];
    if (assembly->first) {
        couple(assembly, row, multiplier);
        return;
    }
    system->right[multiplier] += factor * given;
    for (int i = 0; i < row->count; i++)
        add(system, multiplier, system->of_node[row->node[i]], factor * row->value[i]);
}

/* The hats of the corners of the segment that a point lies on. */
static void add_hats(void *context, const struct quadrature_point *point)
{
    struct assembly *assembly = context;
    const struct node_box *box = &assembly->level->box;
    const struct shape_row *row = rkpm_row(assembly->rkpm, assembly->level, point->x, GRADIENT_NONE);
    const double given = field_value(&assembly->rkpm->field, point->x);
    for (int corner = 0; corner < 1 << box->dimension; corner++) {
        size_t node = 0, stride = 1;
        double hat = point->weight;
        for (int a = 0; a < box->dimension; a++) {
            const int up = corner >> a & 1;
            const double along = (point->x[a] - box->low[a]) / box->spacing[a] - (double)point->cell[a];
            hat *= a == point->axis ? up == (point->side > 0) : up ? along : 1 - along;
            node += stride * (size_t)(point->cell[a] + up);
            stride *= (size_t)box->numbers[a];
        }
        if (hat != 0)
            add_constraint(assembly, node, hat, row, given);
    }
}

static void add_transformation(struct assembly *assembly)
{
    const struct rkpm_level *level = assembly->level;
    for (size_t node = 0; node < level->count; node++) {
        if (level->system.of_multiplier[node] < 0)
            continue;
        const double x[3] = {level->x[0][node], level->x[1][node], level->x[2][node]};
        const struct shape_row *row = rkpm_row(assembly->rkpm, assembly->level, x, GRADIENT_NONE);
        add_constraint(assembly, node, 1, row, field_value(&assembly->rkpm->field, x));
    }
}

static void add_all(struct assembly *assembly)
{
    const struct node_box *box = &assembly->level->box;
    const struct rkpm *rkpm = assembly->rkpm;
    quadrature_inside(box, rkpm->gauss, add_inside, assembly);
    if (rkpm->words->constraint == CONSTRAINT_TRANSFORMATION)
        add_transformation(assembly);
    else if (rkpm->words->constraint == CONSTRAINT_LAGRANGE)
        quadrature_faces(box, rkpm->boundary_gauss, add_hats, assembly);
    else
        quadrature_faces(box, rkpm->boundary_gauss, add_face, assembly);
}

/* --- the whole --- */

void rkpm_system_open(struct rkpm *rkpm, struct rkpm_level *level)
{
    struct rkpm_system *system = &level->system;
    int32_t width = 0;
    number_unknowns(rkpm, level);
    system->is_definite = !has_multipliers(rkpm->words) && wave_square(rkpm) == 0;
    system->right = memory_array((size_t)system->count, sizeof(double), "the linear system");
    int32_t *first = memory_array((size_t)system->count, sizeof *first, "the linear system");
    for (int32_t i = 0; i < system->count; i++)
        first[i] = i;
    add_all(&(struct assembly){rkpm, level, first});
    for (int32_t i = 0; i < system->count; i++)
        width = i - first[i] > width ? i - first[i] : width;
    if (system->is_definite)
        envelope_open(&system->envelope, system->count, first);
    else
        banded_open(&system->banded, (size_t)system->count, (size_t)width);
    memory_free(first);
    const double row = system->is_definite ? width + 1.0 : 3.0 * width + 1;
    system->bytes = (double)system->count * row * sizeof(double);
}

void rkpm_system_close(struct rkpm_system *system)
{
    memory_free(system->of_node);
    memory_free(system->of_multiplier);
    memory_free(system->right);
    envelope_close(&system->envelope);
    banded_close(&system->banded);
}

/* Factors the matrix; false where that is not possible. */
static bool factor(struct rkpm_system *system)
{
    if (!system->is_definite)
        return banded_factor(&system->banded);
    envelope_factor(&system->envelope);
    for (int32_t i = 0; i < system->count; i++)
        if (!(system->envelope.diagonal[i] > 0))
            return false;
    return true;
}

static void stop(struct rkpm *rkpm, const struct rkpm_system *system)
{
    struct instability *instability = &rkpm->instability;
    *instability = (struct instability){.is_stopped = true, .particle = -1};
    snprintf(instability->cause, sizeof instability->cause, "the linear system is %s",
             system->is_definite ? "not positive: the boundary is held too weakly, or to rounding error" : "singular");
    snprintf(instability->advice, sizeof instability->advice, "%s",
             system->is_definite ? "take another beta, as 100 /h" : "take another wave number, a larger supp, or cons nits");
}

void rkpm_system_solve(struct rkpm *rkpm, struct rkpm_level *level)
{
    struct rkpm_system *system = &level->system;
    add_all(&(struct assembly){rkpm, level, NULL});
    if (rkpm->instability.is_stopped)
        return;
    if (!factor(system)) {
        stop(rkpm, system);
        return;
    }
    if (system->is_definite)
        envelope_solve(&system->envelope, system->right);
    else
        banded_solve(&system->banded, system->right);
    for (size_t i = 0; i < level->count; i++)
        level->coefficient[i] = system->right[system->of_node[i]];
}
