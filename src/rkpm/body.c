/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rkpm/body.h"
#include "base/memory.h"
#include "base/threads.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FEW_NODES = 200 }; /* below these one thread is faster */

struct moduli body_moduli(int dimension, enum plane_mode mode, double young, double poisson)
{
    const double mu = young / (2 * (1 + poisson)), lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
    if (dimension == 1)
        return (struct moduli){young - 2 * mu, mu};
    return (struct moduli){dimension == 2 && mode == PLANE_STRESS ? 2 * lambda * mu / (lambda + 2 * mu) : lambda, mu};
}

/* --- numbering --- */

static void number_lattice(struct body *body)
{
    int order[3];
    box_order_axes(body->box->numbers, order);
    for (size_t n = 0; n < body->nodes; n++) {
        const size_t node = box_node(body->box, order, n);
        body->number[node] = (int32_t)n;
        body->node[n] = (int32_t)node;
    }
}

/* A node by its coordinates, the one along the axis with most nodes first. */
struct placed {
    double x[3];
    int32_t node;
};

static int compare_placed(const void *a, const void *b)
{
    const struct placed *p = a, *q = b;
    for (int i = 0; i < 3; i++)
        if (p->x[i] != q->x[i])
            return p->x[i] < q->x[i] ? -1 : 1;
    return (p->node > q->node) - (p->node < q->node);
}

static void number_scattered(struct body *body)
{
    struct placed *placed = memory_array(body->nodes, sizeof *placed, "the linear system");
    int order[3];
    box_order_axes(body->box->numbers, order);
    for (size_t n = 0; n < body->nodes; n++) {
        placed[n].node = (int32_t)n;
        for (int i = 0; i < 3; i++)
            placed[n].x[i] = body->x[order[2 - i]][n];
    }
    qsort(placed, body->nodes, sizeof *placed, compare_placed);
    for (size_t n = 0; n < body->nodes; n++) {
        body->node[n] = placed[n].node;
        body->number[placed[n].node] = (int32_t)n;
    }
    memory_free(placed);
}

/* --- structure of the matrix --- */

/* Notes which rows are coupled with that of a node by points, once each; how many there are from `n` on. */
static int32_t couple(const struct body *body, const struct points *points, int32_t node, int32_t *mark, int32_t *list, int32_t n)
{
    for (size_t u = points->first_use[node]; u < points->first_use[node + 1]; u++) {
        const size_t point = points->use[u] / (size_t)points->stride, from = point * (size_t)points->stride;
        for (int k = 0; k < points->neighbours[point]; k++) {
            const int32_t other = body->number[points->neighbour[from + (size_t)k]];
            if (mark[other] == node + 1)
                continue;
            mark[other] = node + 1;
            if (list)
                list[n] = other;
            n++;
        }
    }
    return n;
}

static int compare(const void *a, const void *b)
{
    const int32_t x = *(const int32_t *)a, y = *(const int32_t *)b;
    return (x > y) - (x < y);
}

/* Faces couple nodes that the inside need not: their points lie elsewhere. */
static int32_t couple_all(const struct body *body, int32_t node, int32_t *mark, int32_t *list)
{
    const int32_t n = couple(body, &body->inside, node, mark, list, 0);
    const bool has_faces = body->constraint == CONSTRAINT_PENALTY || body->constraint == CONSTRAINT_NITSCHE;
    return has_faces ? couple(body, &body->faces, node, mark, list, n) : n;
}

static void clear_marks(const struct body *body)
{
    for (int t = 0; t < body->n_marks; t++)
        memset(body->mark[t], 0, body->nodes * sizeof **body->mark);
}

static void open_matrix(struct body *body)
{
    const int32_t rows = (int32_t)body->nodes;
    int32_t *blocks = memory_array(body->nodes, sizeof *blocks, "the linear system");
    clear_marks(body);
#pragma omp parallel for schedule(dynamic, 64) if (rows >= FEW_NODES)
    for (int32_t row = 0; row < rows; row++)
        blocks[row] = couple_all(body, body->node[row], body->mark[threads_self()], NULL);
    sparse_open(&body->matrix, rows, body->dimension, blocks);
    clear_marks(body);
#pragma omp parallel for schedule(dynamic, 64) if (rows >= FEW_NODES)
    for (int32_t row = 0; row < rows; row++) {
        int32_t *columns = body->matrix.column + body->matrix.first[row];
        couple_all(body, body->node[row], body->mark[threads_self()], columns);
        qsort(columns, (size_t)blocks[row], sizeof *columns, compare);
    }
    memory_free(blocks);
}

/* --- test functions that are variationally consistent (spec 3.7) --- */

/* Whether a point is in a node's support. */
static bool is_near(const struct body *body, const struct points *points, size_t point, int32_t node)
{
    bool near = true;
    for (int a = 0; a < body->dimension; a++)
        near = near && fabs(points->x[a][point] - body->x[a][node]) < body->support.radius[a];
    return near;
}

/* xi = [sum_b w Psi n - sum_q w grad Psi]/sum_q w 1 */
static void open_correction(struct body *body)
{
    const int d = body->dimension;
    body->correction = memory_array(body->nodes * (size_t)d, sizeof(double), "the linear system");
    for (int32_t node = 0; node < (int32_t)body->nodes; node++) {
        const struct points *inside = &body->inside, *faces = &body->faces;
        double *xi = body->correction + (size_t)node * (size_t)d, volume = 0;
        for (size_t u = faces->first_use[node]; u < faces->first_use[node + 1]; u++) {
            const size_t point = faces->use[u] / (size_t)faces->stride;
            xi[faces->axis[point]] += points_weight(faces, point, 0) * faces->value[faces->use[u]] * faces->side[point];
        }
        for (size_t u = inside->first_use[node]; u < inside->first_use[node + 1]; u++) {
            const size_t point = inside->use[u] / (size_t)inside->stride, k = inside->use[u] % (size_t)inside->stride;
            for (int a = 0; a < d; a++)
                xi[a] -= points_weight(inside, point, 0) * points_gradient(inside, point, 0, a)[k];
            volume += is_near(body, inside, point, node) ? points_weight(inside, point, 0) : 0;
        }
        for (int a = 0; a < d; a++)
            xi[a] /= volume;
    }
}

/* The gradient of a test function. */
static void test_gradient(const struct body *body, int32_t node, size_t point, int row, size_t k, double gradient[3])
{
    const int d = body->dimension;
    for (int a = 0; a < d; a++)
        gradient[a] = points_gradient(&body->inside, point, row, a)[k];
    if (row == 0 && body->correction && is_near(body, &body->inside, point, node))
        for (int a = 0; a < d; a++)
            gradient[a] += body->correction[(size_t)node * (size_t)d + (size_t)a];
}

/* --- the matrix --- */

/* w T^T D B: the force along a at the test function's node for a displacement along b. */
static void add_inside(const struct body *body, struct moduli moduli, int32_t node, const int32_t *place, double *blocks)
{
    const struct points *points = &body->inside;
    const int d = body->dimension;
    for (size_t u = points->first_use[node]; u < points->first_use[node + 1]; u++) {
        const size_t point = points->use[u] / (size_t)points->stride, from = point * (size_t)points->stride;
        for (int row = 0; row < points->rows; row++) {
            const double weight = points_weight(points, point, row), lambda = weight * moduli.lambda, mu = weight * moduli.mu;
            double test[3], along[3], far[3];
            test_gradient(body, node, point, row, points->use[u] - from, test);
            for (int a = 0; a < d; a++) {
                along[a] = lambda * test[a];
                far[a] = mu * test[a];
            }
            for (int k = 0; k < points->neighbours[point] && weight > 0; k++) {
                double *block = blocks + (size_t)place[body->number[points->neighbour[from + (size_t)k]]] * (size_t)(d * d), trial[3], both = 0;
                for (int a = 0; a < d; a++) {
                    trial[a] = points_gradient(points, point, row, a)[k];
                    both += far[a] * trial[a];
                }
                for (int a = 0; a < d; a++) {
                    for (int b = 0; b < d; b++)
                        block[a * d + b] += along[a] * trial[b] + far[b] * trial[a];
                    block[a * d + a] += both;
                }
            }
        }
    }
}

/* Traction along a for a displacement along b of a node's shape function: n lambda B + mu (B n + (B . n) I). */
static void traction_of(const struct points *points, struct moduli moduli, size_t point, size_t k, double traction[9])
{
    const int d = points->dimension, axis = points->axis[point];
    const double side = points->side[point];
    for (int a = 0; a < d; a++)
        for (int b = 0; b < d; b++) {
            const double along_a = points_gradient(points, point, 0, a)[k], along_b = points_gradient(points, point, 0, b)[k];
            traction[a * d + b] = side * ((a == axis ? moduli.lambda * along_b : 0) + (b == axis ? moduli.mu * along_a : 0) +
                                          (a == b ? moduli.mu * points_gradient(points, point, 0, axis)[k] : 0));
        }
}

/* beta N N - N t(N) - t(N) N; the penalty has the first only. */
static void add_faces(const struct body *body, struct moduli moduli, int32_t node, const int32_t *place, double *blocks)
{
    const struct points *points = &body->faces;
    const int d = body->dimension;
    for (size_t u = points->first_use[node]; u < points->first_use[node + 1]; u++) {
        const size_t point = points->use[u] / (size_t)points->stride, from = point * (size_t)points->stride;
        const double weight = points_weight(points, point, 0), own = points->value[points->use[u]];
        double test[9] = {0}, trial[9] = {0};
        if (!body->is_held[point])
            continue;
        if (body->constraint == CONSTRAINT_NITSCHE)
            traction_of(points, moduli, point, points->use[u] - from, test);
        for (size_t k = 0; k < (size_t)points->neighbours[point]; k++) {
            double *block = blocks + (size_t)place[body->number[points->neighbour[from + k]]] * (size_t)(d * d);
            const double other = points->value[from + k];
            if (body->constraint == CONSTRAINT_NITSCHE)
                traction_of(points, moduli, point, k, trial);
            for (int a = 0; a < d; a++)
                for (int b = 0; b < d; b++)
                    block[a * d + b] += weight * ((a == b ? body->beta * own * other : 0) - own * trial[a * d + b] - test[b * d + a] * other);
        }
    }
}

void body_assemble(struct body *body, struct moduli moduli)
{
    const struct sparse *matrix = &body->matrix;
    const size_t size = (size_t)(body->dimension * body->dimension);
    const bool has_faces = body->constraint == CONSTRAINT_PENALTY || body->constraint == CONSTRAINT_NITSCHE;
#pragma omp parallel for schedule(dynamic, 64) if (matrix->count >= FEW_NODES)
    for (int32_t row = 0; row < matrix->count; row++) {
        const size_t first = matrix->first[row];
        const int32_t blocks = (int32_t)(matrix->first[row + 1] - first);
        int32_t *place = body->mark[threads_self()];
        for (int32_t k = 0; k < blocks; k++)
            place[matrix->column[first + (size_t)k]] = k;
        memset(matrix->value + first * size, 0, (size_t)blocks * size * sizeof(double));
        add_inside(body, moduli, body->node[row], place, matrix->value + first * size);
        if (has_faces)
            add_faces(body, moduli, body->node[row], place, matrix->value + first * size);
    }
}

/* --- right sides --- */

void body_load(const struct body *body, struct moduli moduli, double *right)
{
    const struct points *points = &body->faces;
    const int d = body->dimension;
    const bool has_faces = body->constraint == CONSTRAINT_PENALTY || body->constraint == CONSTRAINT_NITSCHE;
    for (int32_t row = 0; row < (int32_t)body->nodes; row++) {
        const int32_t node = body->node[row];
        double *own = right + (size_t)row * (size_t)d;
        memset(own, 0, (size_t)d * sizeof *own);
        for (size_t u = points->first_use[node]; u < points->first_use[node + 1]; u++) {
            const size_t point = points->use[u] / (size_t)points->stride;
            const double weight = points_weight(points, point, 0), value = points->value[points->use[u]];
            const double *given = body->given + point * (size_t)d;
            double test[9] = {0};
            if (body->is_held[point] && !has_faces)
                continue;
            if (body->is_held[point] && body->constraint == CONSTRAINT_NITSCHE)
                traction_of(points, moduli, point, points->use[u] % (size_t)points->stride, test);
            for (int a = 0; a < d; a++)
                for (int b = 0; b < d; b++) {
                    const double share = body->is_held[point] ? (a == b ? body->beta * value : 0) - test[b * d + a] : a == b ? value : 0;
                    own[a] += weight * share * given[b];
                }
        }
    }
}

void body_add_weight(const struct body *body, const double weight[3], double *right)
{
    const struct points *points = &body->inside;
    const size_t d = (size_t)body->dimension;
    for (size_t row = 0; row < body->nodes; row++) {
        const size_t node = (size_t)body->node[row];
        double volume = 0;
        for (size_t u = points->first_use[node]; u < points->first_use[node + 1]; u++)
            volume += points_weight(points, points->use[u] / (size_t)points->stride, 0) * points->value[points->use[u]];
        for (size_t a = 0; a < d; a++)
            right[row * d + a] += volume * weight[a];
    }
}

void body_subtract_forces(const struct body *body, const double *stress, double *right)
{
    const struct points *points = &body->inside;
    const int d = body->dimension;
#pragma omp parallel for schedule(static) if (body->nodes >= FEW_NODES)
    for (int32_t matrix_row = 0; matrix_row < (int32_t)body->nodes; matrix_row++) {
        const int32_t node = body->node[matrix_row];
        for (size_t u = points->first_use[node]; u < points->first_use[node + 1]; u++) {
            const size_t point = points->use[u] / (size_t)points->stride;
            for (int row = 0; row < points->rows; row++) {
                const double *own = stress + (point * (size_t)points->rows + (size_t)row) * (size_t)(d * d), weight = points_weight(points, point, row);
                double test[3];
                test_gradient(body, node, point, row, points->use[u] % (size_t)points->stride, test);
                for (int a = 0; a < d; a++)
                    for (int b = 0; b < d; b++)
                        right[(size_t)matrix_row * (size_t)d + (size_t)a] -= weight * own[a * d + b] * test[b];
            }
        }
    }
}

void body_by_nodes(const struct body *body, const double *by_rows, double *by_nodes)
{
    const size_t d = (size_t)body->dimension;
    for (size_t row = 0; row < body->nodes; row++)
        memcpy(by_nodes + (size_t)body->node[row] * d, by_rows + row * d, d * sizeof(double));
}

/* --- opening and closing --- */

static bool needs_cells(enum integration_form rule)
{
    return rule != INTEGRATION_GAUSS;
}

/* Points of the rule: Gauss points, or nodes and the middles of their cells' faces on the boundary. */
static void open_points(struct body *body, const struct scene_rkpm *words, const struct rkpm_shape *shape, int gauss, int boundary_gauss)
{
    const enum integration_form rule = words->integration;
    if (!needs_cells(rule)) {
        points_open_gauss(&body->inside, shape, body->box, body->nodes, gauss, false, words->gradient);
        points_open_gauss(&body->faces, shape, body->box, body->nodes, boundary_gauss, true, words->gradient);
        return;
    }
    body->has_cells = body->has_nodal = true;
    cells_open(&body->cells, body->box, body->nodes, body->x);
    if (rule == INTEGRATION_DNI || rule == INTEGRATION_SNNI || rule == INTEGRATION_NSNI) {
        const double *const moment[] = {body->cells.moment[0], body->cells.moment[1], body->cells.moment[2]};
        rkpm_nodal_open(&body->nodal, body->dimension, rule, words->gradient, body->nodes, body->x, body->cells.volume, moment, &shape->support, true);
    } else {
        rkpm_nodal_open_cells(&body->nodal, rule, &body->cells, body->x, &shape->support);
    }
    points_open_nodes(&body->inside, &body->nodal);
    points_open_cell_faces(&body->faces, shape, &body->cells, words->gradient);
}

/* With transformation nodes on held sides, with multipliers those that share in them. */
static void open_held(struct body *body, const struct scene_rkpm *words, const struct rkpm_shape *shape)
{
    held_open(&body->held, body->nodes);
    if (body->constraint == CONSTRAINT_TRANSFORMATION)
        held_add_nodes(&body->held, body->box, words->held, body->x, shape);
    else if (body->constraint == CONSTRAINT_LAGRANGE)
        held_add_hats(&body->held, body->box, &body->faces, body->is_held);
}

void body_open(struct body *body, const struct scene_rkpm *words, const struct node_box *box, size_t nodes, double *const *x,
                const struct rkpm_shape *shape, int gauss, int boundary_gauss, double beta)
{
    *body = (struct body){.dimension = box->dimension, .nodes = nodes, .box = box, .x = x, .constraint = words->constraint, .beta = beta,
                            .is_symmetric = !words->is_consistent, .n_marks = threads_available()};
    open_points(body, words, shape, gauss, boundary_gauss);
    body->support = shape->support;
    body->is_held = memory_array(body->faces.count, sizeof *body->is_held, "points");
    body->given = memory_array(body->faces.count * (size_t)body->dimension, sizeof(double), "points");
    for (size_t i = 0; i < body->faces.count; i++)
        body->is_held[i] = words->held[2 * body->faces.axis[i] + (body->faces.side[i] > 0)];
    body->number = memory_array(nodes, sizeof *body->number, "the linear system");
    body->node = memory_array(nodes, sizeof *body->node, "the linear system");
    body->mark = memory_array((size_t)body->n_marks, sizeof *body->mark, "the linear system");
    for (int t = 0; t < body->n_marks; t++)
        body->mark[t] = memory_array(nodes, sizeof **body->mark, "the linear system");
    words->file ? number_scattered(body) : number_lattice(body);
    if (words->is_consistent)
        open_correction(body);
    open_matrix(body);
    open_held(body, words, shape);
}

void body_close(struct body *body)
{
    points_close(&body->inside);
    points_close(&body->faces);
    if (body->has_nodal)
        rkpm_nodal_close(&body->nodal);
    if (body->has_cells)
        cells_close(&body->cells);
    memory_free(body->is_held);
    memory_free(body->given);
    memory_free(body->correction);
    memory_free(body->number);
    memory_free(body->node);
    sparse_close(&body->matrix);
    for (int t = 0; t < body->n_marks; t++)
        memory_free(body->mark[t]);
    memory_free(body->mark);
    held_close(&body->held);
}
