/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rkpm/nodal.h"
#include "base/memory.h"
#include "base/threads.h"
#include "rkpm/cells.h"
#include "rkpm/linear.h"

#include <math.h>
#include <string.h>

enum { FEW_NODES = 200, SCRATCH_ARRAYS = 3 * AXES + 3 }; /* below these nodes one thread is faster */

/* --- neighbours --- */

/* How near nodes have to be to count as neighbours: within the outer box, and outside of the inner one along so many axes at most. */
struct nearness {
    double middle[AXES], inner[AXES], outer[AXES];
    int most_outside;
};

/* Takes the near ones of sorted nodes from `first` to before `end`, behind the n that there are. Those beyond the room are only counted. */
THREADS_INLINE int take_near(const struct nodal *nodal, const struct nearness *near, int32_t first, int32_t end, int n, struct nodal_scratch *scratch,
                             const int d)
{
    for (int32_t k = first; k < end; k++) {
        const int to = n < nodal->stride ? n : nodal->stride;
        int outside = 0;
        for (int a = 0; a < d; a++) {
            const double place = nodal->search.place[a][k], distance = fabs(place - near->middle[a]);
            outside += (distance >= near->inner[a]) + (AXES + 1) * (distance >= near->outer[a]);
            scratch->place[a][to] = place;
        }
        scratch->list[to] = nodal->search.node[k];
        n += outside <= near->most_outside;
    }
    return n;
}

/* Nodes whose support reaches a node, or, farther along one axis, the box around it, or, along any, its cell, with their places; returns
 * how many there are. */
THREADS_INLINE int find_neighbours(const struct nodal *nodal, size_t node, double slack, struct nodal_scratch *scratch, const int d)
{
    const struct search *search = &nodal->search;
    struct nearness near = {.most_outside = slack == 0 ? 0 : nodal->cells ? d : 1};
    double far = 0;
    int from[3], to[3], cell[3], n = 0;
    int32_t first, end;
    for (int a = 0; a < d; a++) {
        near.middle[a] = nodal->x[a][node];
        near.inner[a] = nodal->support.radius[a] * nodal->reach[node];
        near.outer[a] = near.inner[a] + slack;
        far = near.outer[a] > far * search->size[a] ? near.outer[a] / search->size[a] : far;
    }
    search_range(search, near.middle, far, from, to);
    cell[0] = from[0];
    for (cell[2] = from[2]; cell[2] <= to[2]; cell[2]++)
        for (cell[1] = from[1]; cell[1] <= to[1]; cell[1]++) {
            search_span(search, cell, to[0], &first, &end);
            n = take_near(nodal, &near, first, end, n, scratch, d);
        }
    return n;
}

/* --- rows of a node --- */

static double *row_of(const struct nodal *nodal, size_t node, int row, int axis)
{
    return nodal->gradients + (size_t)(rkpm_nodal_gradient(nodal, node, row, axis) - nodal->gradients);
}

/* Half the side of a square or cube of a cell's volume. */
THREADS_INLINE double half_side(double volume, const int d)
{
    return 0.5 * (d == 1 ? volume : d == 2 ? sqrt(volume) : cbrt(volume));
}

THREADS_INLINE void set_weights(const struct nodal *nodal, size_t node, const int d)
{
    double *weight = nodal->weights + node * (size_t)nodal->rows;
    const double volume = nodal->volume[node], half = half_side(volume, d);
    weight[0] = volume;
    for (int row = 1; row < nodal->rows && nodal->rule != INTEGRATION_MSCNI; row++)
        weight[row] = nodal->moment[row - 1] ? nodal->moment[row - 1][node] : volume * half * half / 3;
}

/* The derivatives of implicit gradients at the node, whose kernels the scratch has. */
THREADS_INLINE void set_second_rows(const struct nodal *nodal, size_t node, int n, const struct nodal_scratch *scratch,
                                    const struct polynomials *polynomials, const int d)
{
    double b[TERMS];
    for (int a = 0; a < d; a++) {
        solve_polynomial(nodal, polynomials, a, b, d);
        for (int row = 1; row < nodal->rows; row++)
            apply_derivative(nodal, scratch, n, polynomials, b, row - 1, row_of(nodal, node, row, a), d);
    }
}

/* Shape functions at a point near a node, with the least support that has enough neighbours, up to the node's: they follow from the
 * point alone, so that cells on both sides of a face have the same. False where there are too few. */
THREADS_INLINE bool find_at(const struct nodal *nodal, size_t node, const double point[AXES], int n, bool has_slopes, struct nodal_scratch *scratch,
                            struct polynomials *polynomials, double *values, const int d)
{
    for (double reach = 1;; reach *= MOMENTS_ENLARGEMENT) {
        set_kernels(nodal, point, reach, n, has_slopes, scratch, d);
        if (find_values(nodal, scratch, n, polynomials, values, d))
            return true;
        if (!(reach < nodal->reach[node]))
            return false;
    }
}

/* dni and nsni: gradients at the node itself; of nsni their derivatives too, and of nsni with scni only those. */
THREADS_INLINE bool set_rows_at_node(const struct nodal *nodal, size_t node, int n, struct nodal_scratch *scratch, const int d)
{
    const bool is_direct = nodal->rule == INTEGRATION_DNI && nodal->gradient == GRADIENT_DIRECT;
    const bool has_second = nodal->rule == INTEGRATION_NSNI || nodal->rule == INTEGRATION_NSNI_SCNI;
    struct polynomials polynomials;
    double middle[AXES] = {0}, b[TERMS];
    for (int a = 0; a < d; a++)
        middle[a] = nodal->x[a][node];
    if (!find_at(nodal, node, middle, n, is_direct || has_second, scratch, &polynomials, nodal->value + node * (size_t)nodal->stride, d))
        return false;
    for (int a = 0; a < d && (is_direct || has_second); a++)
        sum_moments(scratch, scratch->slope[a], n, &polynomials.slope[a][0][0], TERMS, d);
    for (int a = 0; a < d && !nodal->cells; a++) {
        solve_polynomial(nodal, &polynomials, is_direct ? -1 : a, b, d);
        if (is_direct)
            apply_derivative(nodal, scratch, n, &polynomials, b, a, row_of(nodal, node, 0, a), d);
        else
            apply_polynomial(scratch, n, b, row_of(nodal, node, 0, a), d);
    }
    if (has_second)
        set_second_rows(nodal, node, n, scratch, &polynomials, d);
    return true;
}

/* snni: differences between the middles of opposite faces of a square or cube around the node, which is not cut at the boundary. */
THREADS_INLINE bool set_rows_of_box(const struct nodal *nodal, size_t node, int n, struct nodal_scratch *scratch, const int d)
{
    const double half = half_side(nodal->volume[node], d);
    struct polynomials polynomials;
    double point[AXES] = {0};
    for (int a = 0; a < d; a++)
        point[a] = nodal->x[a][node];
    bool good = find_at(nodal, node, point, n, false, scratch, &polynomials, nodal->value + node * (size_t)nodal->stride, d);
    for (int a = 0; a < d; a++) {
        for (int side = 0; side < 2; side++) {
            point[a] = nodal->x[a][node] + (side == 0 ? -half : half);
            good = find_at(nodal, node, point, n, false, scratch, &polynomials, scratch->value[side], d) && good;
        }
        point[a] = nodal->x[a][node];
        double *restrict gradient = row_of(nodal, node, 0, a);
        for (int k = 0; k < n; k++)
            gradient[k] = (scratch->value[1][k] - scratch->value[0][k]) / (2 * half);
    }
    return good;
}

/* row += factor area Psi(point) of all axes. */
THREADS_INLINE bool add_values(const struct nodal *nodal, size_t node, int n, int row, const double point[AXES], const double area[AXES],
                               double factor, struct nodal_scratch *scratch, const int d)
{
    struct polynomials polynomials;
    const bool good = find_at(nodal, node, point, n, false, scratch, &polynomials, scratch->value[0], d);
    for (int a = 0; a < d; a++) {
        double *restrict gradient = row_of(nodal, node, row, a);
        for (int k = 0; k < n; k++)
            gradient[k] += factor * area[a] * scratch->value[0][k];
    }
    return good;
}

/* mscni: the gradient in the triangle between the node and an edge, less that of the cell. */
THREADS_INLINE bool set_row_of_triangle(const struct nodal *nodal, size_t node, int n, int row, const double from[2], const double to[2],
                                        struct nodal_scratch *scratch)
{
    const double middle[2] = {nodal->x[0][node], nodal->x[1][node]};
    const double *const corner[] = {middle, from, to};
    const double area = 0.5 * ((from[0] - middle[0]) * (to[1] - middle[1]) - (from[1] - middle[1]) * (to[0] - middle[0]));
    bool good = true;
    nodal->weights[node * (size_t)nodal->rows + (size_t)row] = area;
    for (int a = 0; a < 2; a++)
        for (int k = 0; k < n; k++)
            row_of(nodal, node, row, a)[k] = -rkpm_nodal_gradient(nodal, node, 0, a)[k];
    for (int i = 0; i < 3 && area > 0; i++) {
        const double *p = corner[i], *q = corner[(i + 1) % 3];
        const double point[AXES] = {0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])}, normal[AXES] = {q[1] - p[1], p[0] - q[0]};
        good = add_values(nodal, node, n, row, point, normal, 1 / area, scratch, 2) && good;
    }
    return good;
}

/* scni: integrals over the faces of the cell, and what stabilises them. */
THREADS_INLINE bool set_rows_of_cell(const struct nodal *nodal, size_t node, int n, struct nodal_scratch *scratch, const int d)
{
    const struct cells *cells = nodal->cells;
    const size_t first = cells->first[node], faces = cells->first[node + 1] - first;
    bool good = set_rows_at_node(nodal, node, n, scratch, d);
    for (int a = 0; a < d; a++)
        memset(row_of(nodal, node, 0, a), 0, (size_t)n * sizeof(double));
    for (size_t f = 0; f < faces; f++) {
        const struct cell_face *face = &cells->face[first + f];
        good = add_values(nodal, node, n, 0, face->middle, face->area, 1 / nodal->volume[node], scratch, d) && good;
    }
    for (int row = 1; row < nodal->rows && nodal->rule == INTEGRATION_MSCNI; row++) {
        const size_t f = (size_t)row - 1;
        if (f < faces)
            good = set_row_of_triangle(nodal, node, n, row, cells->face[first + f].corner, cells->face[first + (f + 1) % faces].corner, scratch) && good;
    }
    return good;
}

/* How far the points that a node's rows are made from are away from it. */
THREADS_INLINE double reach_of_rows(const struct nodal *nodal, size_t node, const int d)
{
    double slack = 0;
    if (nodal->rule == INTEGRATION_SNNI)
        return half_side(nodal->volume[node], d);
    for (size_t f = nodal->cells ? nodal->cells->first[node] : 0; nodal->cells && f < nodal->cells->first[node + 1]; f++)
        for (int a = 0; a < d; a++)
            slack = fmax(slack, fabs(nodal->cells->face[f].middle[a] - nodal->x[a][node]));
    return slack;
}

THREADS_INLINE bool set_rows(const struct nodal *nodal, size_t node, int n, struct nodal_scratch *scratch, const int d)
{
    if (nodal->cells)
        return set_rows_of_cell(nodal, node, n, scratch, d);
    return nodal->rule == INTEGRATION_SNNI ? set_rows_of_box(nodal, node, n, scratch, d) : set_rows_at_node(nodal, node, n, scratch, d);
}

THREADS_INLINE void set_node(struct nodal *nodal, size_t node, struct nodal_scratch *scratch, const int d)
{
    const int n = find_neighbours(nodal, node, reach_of_rows(nodal, node, d), scratch, d);
    nodal->neighbours[node] = n;
    if (n > nodal->stride) {
        scratch->most = n > scratch->most ? n : scratch->most;
        return;
    }
    memcpy(nodal->neighbour + node * (size_t)nodal->stride, scratch->list, (size_t)n * sizeof *scratch->list);
    set_weights(nodal, node, d);
    nodal->is_lowered[node] = !set_rows(nodal, node, n, scratch, d);
    for (int row = 0; row < nodal->rows && nodal->is_lowered[node]; row++)
        for (int a = 0; a < d; a++)
            memset(row_of(nodal, node, row, a), 0, (size_t)n * sizeof(double));
}

THREADS_VECTORISED
static void set_node_1(struct nodal *nodal, size_t node, struct nodal_scratch *scratch)
{
    set_node(nodal, node, scratch, 1);
}

THREADS_VECTORISED
static void set_node_2(struct nodal *nodal, size_t node, struct nodal_scratch *scratch)
{
    set_node(nodal, node, scratch, 2);
}

THREADS_VECTORISED
static void set_node_3(struct nodal *nodal, size_t node, struct nodal_scratch *scratch)
{
    set_node(nodal, node, scratch, 3);
}

/* --- room --- */

static void open_scratch(struct nodal_scratch *scratch, int stride)
{
    const size_t size = (size_t)stride + LANES;
    scratch->most = 0;
    scratch->list = memory_grow(scratch->list, &scratch->list_capacity, size, sizeof *scratch->list, "rows of nodes");
    scratch->room = memory_grow(scratch->room, &scratch->capacity, SCRATCH_ARRAYS * size, sizeof(double), "rows of nodes");
    double *next = scratch->room;
    for (int a = 0; a < AXES; a++, next += 3 * size) {
        scratch->place[a] = next;
        scratch->xi[a] = next + size;
        scratch->slope[a] = next + 2 * size;
    }
    scratch->kernel = next;
    scratch->value[0] = next + size;
    scratch->value[1] = next + 2 * size;
}

static void make_node_room(struct nodal *nodal)
{
    const size_t count = nodal->count;
    size_t *capacity = nodal->node_capacity;
    nodal->neighbours = memory_grow(nodal->neighbours, &capacity[0], count, sizeof *nodal->neighbours, "rows of nodes");
    nodal->weights = memory_grow(nodal->weights, &capacity[1], count * (size_t)nodal->rows, sizeof(double), "rows of nodes");
    nodal->reach = memory_grow(nodal->reach, &capacity[2], count, sizeof(double), "rows of nodes");
    nodal->is_lowered = memory_grow(nodal->is_lowered, &capacity[3], count, sizeof *nodal->is_lowered, "rows of nodes");
}

/* Makes room for so many neighbours of each node. */
static void make_room(struct nodal *nodal, int stride)
{
    nodal->room = nodal->count > nodal->room ? nodal->count : nodal->room;
    const size_t pairs = nodal->room * (size_t)stride;
    nodal->stride = stride;
    nodal->neighbour = memory_grow(nodal->neighbour, &nodal->neighbour_capacity, pairs, sizeof *nodal->neighbour, "rows of nodes");
    nodal->value = memory_grow(nodal->value, &nodal->value_capacity, pairs, sizeof(double), "rows of nodes");
    nodal->gradients = memory_grow(nodal->gradients, &nodal->gradient_capacity, pairs * (size_t)(nodal->rows * nodal->dimension), sizeof(double),
                                   "rows of nodes");
    for (int i = 0; i < nodal->n_scratch; i++)
        open_scratch(&nodal->scratch[i], stride);
}

/* Cells of half a support: those around a node have few nodes that are no neighbours. */
static void sort_nodes(struct nodal *nodal)
{
    double size[3];
    for (int a = 0; a < 3; a++)
        size[a] = 0.5 * nodal->support.radius[a];
    search_renew(&nodal->search, nodal->count, nodal->x, size);
}

/* --- all nodes --- */

/* The most neighbours of a node; rows are only there where all had room. */
static int set_all(struct nodal *nodal)
{
    static void (*const set[])(struct nodal *, size_t, struct nodal_scratch *) = {NULL, set_node_1, set_node_2, set_node_3};
    int most = 0;
    for (int i = 0; i < nodal->n_scratch; i++)
        nodal->scratch[i].most = 0;
#pragma omp parallel for schedule(dynamic, 16) if (nodal->count >= FEW_NODES)
    for (size_t node = 0; node < nodal->count; node++)
        set[nodal->dimension](nodal, node, &nodal->scratch[threads_self()]);
    for (int i = 0; i < nodal->n_scratch; i++)
        most = nodal->scratch[i].most > most ? nodal->scratch[i].most : most;
    return most;
}

/* Larger supports at nodes that have too few neighbours; whether there are any. */
static bool enlarge(struct nodal *nodal)
{
    bool changed = false;
    for (size_t node = 0; node < nodal->count; node++)
        if (nodal->is_lowered[node]) {
            nodal->reach[node] *= MOMENTS_ENLARGEMENT;
            changed = true;
        }
    return changed;
}

void rkpm_nodal_renew(struct nodal *nodal)
{
    sort_nodes(nodal);
    for (size_t node = 0; node < nodal->count; node++)
        nodal->reach[node] = 1;
    for (int i = 0;; i++) {
        for (int most = set_all(nodal); most > 0; most = set_all(nodal))
            make_room(nodal, (most + most / 4 + 3) / 4 * 4);
        if (!nodal->grows || i == MOMENTS_ENLARGEMENTS || !enlarge(nodal))
            break;
    }
    nodal->enlarged = nodal->lowered = 0;
    for (size_t node = 0; node < nodal->count; node++) {
        nodal->lowered += nodal->is_lowered[node];
        nodal->enlarged += !nodal->is_lowered[node] && nodal->reach[node] > 1;
    }
}

/* With what the caller has said. */
static void open_rows(struct nodal *nodal)
{
    make_node_room(nodal);
    nodal->n_scratch = threads_available();
    nodal->scratch = memory_array((size_t)nodal->n_scratch, sizeof *nodal->scratch, "rows of nodes");
    nodal->search.dimension = nodal->dimension;
    make_room(nodal, 8);
    rkpm_nodal_renew(nodal);
}

void rkpm_nodal_open(struct nodal *nodal, int dimension, enum integration_form rule, enum gradient_form gradient, size_t count,
                     double *const *x, const double *volume, const double *const *moment, const struct rkpm_support *support, bool grows)
{
    *nodal = (struct nodal){.dimension = dimension, .rule = rule, .gradient = gradient, .count = count, .x = x, .volume = volume,
                            .support = *support, .grows = grows};
    nodal->rows = rule == INTEGRATION_NSNI ? 1 + dimension : 1;
    for (int a = 0; a < 3; a++)
        nodal->moment[a] = moment ? moment[a] : NULL;
    open_rows(nodal);
}

void rkpm_nodal_resize(struct nodal *nodal, size_t count)
{
    nodal->count = count;
    make_node_room(nodal);
    if (count > nodal->room)
        make_room(nodal, nodal->stride);
}

void rkpm_nodal_open_cells(struct nodal *nodal, enum integration_form rule, const struct cells *cells, double *const *x,
                           const struct rkpm_support *support)
{
    *nodal = (struct nodal){.dimension = cells->dimension, .rule = rule, .gradient = GRADIENT_IMPLICIT, .count = cells->count, .x = x,
                            .volume = cells->volume, .cells = cells, .support = *support, .grows = true};
    nodal->rows = 1 + (rule == INTEGRATION_NSNI_SCNI ? cells->dimension : rule == INTEGRATION_MSCNI ? cells->most : 0);
    for (int a = 0; a < 3; a++)
        nodal->moment[a] = cells->moment[a];
    open_rows(nodal);
}

void rkpm_nodal_close(struct nodal *nodal)
{
    search_close(&nodal->search);
    for (int i = 0; i < nodal->n_scratch; i++) {
        memory_free(nodal->scratch[i].room);
        memory_free(nodal->scratch[i].list);
    }
    memory_free(nodal->scratch);
    memory_free(nodal->neighbours);
    memory_free(nodal->neighbour);
    memory_free(nodal->value);
    memory_free(nodal->gradients);
    memory_free(nodal->weights);
    memory_free(nodal->reach);
    memory_free(nodal->is_lowered);
}
