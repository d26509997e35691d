/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Helpers get the dimension as a constant of the function that calls them, so that their short loops are unrolled. */
#include "rkpm/nodal.h"
#include "base/memory.h"
#include "base/threads.h"
#include "rkpm/kernel.h"
#include "rkpm/moments.h"

#include <math.h>
#include <string.h>

enum { AXES = 3, TERMS = 1 + AXES, FEW_NODES = 200, LANES = 4 }; /* below these nodes one thread is faster */

/* Numbers per neighbour: its place; at the point that is looked at its scaled offset, its kernel and the kernel's slopes; the
 * shape functions at two points. */
struct nodal_scratch {
    double *room;
    double *place[AXES], *xi[AXES], *kernel, *slope[AXES], *value[2];
    size_t capacity;
    int most; /* neighbours of a node that had no room */
};

enum { SCRATCH_ARRAYS = 3 * AXES + 3 };

/* The polynomials of a point. */
struct polynomials {
    struct moments moments;          /* factored */
    double first[TERMS];             /* first column of M */
    double slope[AXES][TERMS][TERMS]; /* sum H H^T Phi_,j, the lower half */
};

/* --- neighbours --- */

/* Nodes whose support reaches a node, or, farther along one axis, the box around it; only as many as there is room for. */
THREADS_INLINE int find_neighbours(struct nodal *nodal, size_t node, double slack, const int d)
{
    const struct search *search = &nodal->search;
    int32_t *list = nodal->neighbour + node * (size_t)nodal->stride;
    double middle[AXES] = {0}, inner[AXES], outer[AXES], far = 0;
    int from[3], to[3], cell[3], n = 0;
    for (int a = 0; a < d; a++) {
        middle[a] = nodal->x[a][node];
        inner[a] = nodal->radius[a] * nodal->reach[node];
        outer[a] = inner[a] + slack;
        far = fmax(far, outer[a] / search->size[a]);
    }
    search_range(search, middle, far, from, to);
    for (cell[2] = from[2]; cell[2] <= to[2]; cell[2]++)
        for (cell[1] = from[1]; cell[1] <= to[1]; cell[1]++)
            for (cell[0] = from[0]; cell[0] <= to[0]; cell[0]++) {
                const size_t c = search_cell(search, cell);
                for (int32_t k = search->first[c]; k < search->first[c + 1]; k++) {
                    int outside = 0;
                    for (int a = 0; a < d; a++) {
                        const double distance = fabs(nodal->x[a][search->node[k]] - middle[a]);
                        outside += distance >= outer[a] ? 2 : distance >= inner[a];
                    }
                    if (outside > 1 || (outside == 1 && slack == 0))
                        continue;
                    if (n < nodal->stride)
                        list[n] = search->node[k];
                    n++;
                }
            }
    return n;
}

THREADS_INLINE void gather_places(const struct nodal *nodal, size_t node, struct nodal_scratch *scratch, const int d)
{
    const int32_t *list = rkpm_nodal_neighbour(nodal, node);
    for (int a = 0; a < d; a++)
        for (int k = 0; k < nodal->neighbours[node]; k++)
            scratch->place[a][k] = nodal->x[a][list[k]];
}

/* --- shape functions at a point --- */

/* Offsets, kernels and, where they are wanted, slopes; zeros behind them, up to a whole number of lanes. */
THREADS_INLINE void set_kernels(const struct nodal *nodal, const double point[AXES], double reach, int n, bool wants_slopes,
                                struct nodal_scratch *scratch, const int d)
{
    double *restrict kernel = scratch->kernel;
    for (int k = 0; k < n; k++)
        kernel[k] = 1;
    for (int a = 0; a < d; a++) {
        const double *restrict place = scratch->place[a];
        double *restrict xi = scratch->xi[a];
        const double radius = nodal->radius[a] * reach, scale = nodal->radius[a];
        for (int k = 0; k < n; k++) {
            xi[k] = (point[a] - place[k]) / scale;
            kernel[k] *= rkpm_kernel(fabs(point[a] - place[k]) / radius);
        }
    }
    for (int k = 0; k < n; k++)
        kernel[k] = kernel[k] > MOMENTS_LEAST_KERNEL ? kernel[k] : 0;
    for (int k = n; k % LANES != 0; k++) {
        kernel[k] = 0;
        for (int a = 0; a < d; a++)
            scratch->xi[a][k] = scratch->slope[a][k] = 0;
    }
    for (int a = 0; a < d && wants_slopes; a++) {
        const double *restrict place = scratch->place[a];
        double *restrict slope = scratch->slope[a];
        const double radius = nodal->radius[a] * reach;
        for (int k = 0; k < n; k++) {
            const double offset = point[a] - place[k], z = fabs(offset) / radius, along = rkpm_kernel_slope(z) / radius;
            const double others = kernel[k] > 0 ? kernel[k] / rkpm_kernel(z) : 0;
            slope[k] = (offset < 0 ? -along : along) * others;
        }
    }
}

/* sum a b w in LANES partial sums, the same for every processor. */
THREADS_INLINE double sum_product(const double *restrict a, const double *restrict b, const double *restrict w, int n)
{
    double sum[LANES] = {0};
    for (int k = 0; k < n; k += LANES)
        for (int i = 0; i < LANES; i++)
            sum[i] += a[k + i] * b[k + i] * w[k + i];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

THREADS_INLINE double sum_weight(const double *restrict a, const double *restrict w, int n)
{
    double sum[LANES] = {0};
    for (int k = 0; k < n; k += LANES)
        for (int i = 0; i < LANES; i++)
            sum[i] += a[k + i] * w[k + i];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

THREADS_INLINE double sum_all(const double *restrict w, int n)
{
    double sum[LANES] = {0};
    for (int k = 0; k < n; k += LANES)
        for (int i = 0; i < LANES; i++)
            sum[i] += w[k + i];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/* sum H H^T w, the lower half. */
THREADS_INLINE void sum_moments(const struct nodal_scratch *scratch, const double *weight, int n, double *matrix, int row, const int d)
{
    matrix[0] = sum_all(weight, n);
    for (int i = 0; i < d; i++) {
        matrix[(1 + i) * row] = sum_weight(scratch->xi[i], weight, n);
        for (int j = 0; j <= i; j++)
            matrix[(1 + i) * row + 1 + j] = sum_product(scratch->xi[i], scratch->xi[j], weight, n);
    }
}

/* M of the kernels, factored; false where nodes are too few. */
THREADS_INLINE bool factor_moments(const struct nodal_scratch *scratch, int n, struct polynomials *polynomials, const int d)
{
    struct moments *moments = &polynomials->moments;
    int near = 0;
    moments->count = d + 1;
    sum_moments(scratch, scratch->kernel, n, &moments->a[0][0], BASIS_LARGEST, d);
    for (int i = 0; i <= d; i++)
        polynomials->first[i] = moments->a[i][0];
    for (int k = 0; k < n; k++)
        near += scratch->kernel[k] > 0;
    return near > d && moments_factor(moments);
}

/* (b . H) Phi of all neighbours, b = M^-1 right. */
THREADS_INLINE void apply_polynomial(const struct nodal_scratch *scratch, int n, const double b[TERMS], double *restrict result, const int d)
{
    const double *restrict kernel = scratch->kernel;
    for (int k = 0; k < n; k++) {
        double sum = b[0];
        for (int a = 0; a < d; a++)
            sum += b[1 + a] * scratch->xi[a][k];
        result[k] = sum * kernel[k];
    }
}

/* b = M^-1 H(0) of the values (3.5); with an axis M^-1 H^(i), H^(i) = -e_i/s, of the implicit gradient. */
THREADS_INLINE void solve_polynomial(const struct nodal *nodal, const struct polynomials *polynomials, int axis, double b[TERMS])
{
    for (int i = 0; i < TERMS; i++)
        b[i] = 0;
    b[axis < 0 ? 0 : 1 + axis] = axis < 0 ? 1 : -1 / nodal->radius[axis];
    moments_solve(&polynomials->moments, b);
}

/* The derivative along an axis of (b . H) Phi, b' = -M^-1 M' b; H' = e/s, so M' = sum H H^T Phi' + (e M_0^T + M_0 e^T)/s. */
THREADS_INLINE void apply_derivative(const struct nodal *nodal, const struct nodal_scratch *scratch, int n, const struct polynomials *polynomials,
                                     const double b[TERMS], int axis, double *restrict result, const int d)
{
    const double scale = nodal->radius[axis];
    double change[TERMS] = {0}, along = 0;
    for (int i = 0; i <= d; i++) {
        for (int j = 0; j <= d; j++)
            change[i] -= polynomials->slope[axis][i > j ? i : j][i > j ? j : i] * b[j];
        change[i] -= polynomials->first[i] * b[1 + axis] / scale;
        along += polynomials->first[i] * b[i];
    }
    change[1 + axis] -= along / scale;
    moments_solve(&polynomials->moments, change);
    change[0] += b[1 + axis] / scale;
    const double *restrict kernel = scratch->kernel, *restrict slope = scratch->slope[axis];
    for (int k = 0; k < n; k++) {
        double own = b[0], changed = change[0];
        for (int a = 0; a < d; a++) {
            own += b[1 + a] * scratch->xi[a][k];
            changed += change[1 + a] * scratch->xi[a][k];
        }
        result[k] = changed * kernel[k] + own * slope[k];
    }
}

/* Values at a point; Shepard's, and false, where nodes are too few. */
THREADS_INLINE bool find_values(const struct nodal *nodal, const struct nodal_scratch *scratch, int n, struct polynomials *polynomials,
                                double *result, const int d)
{
    double b[TERMS], sum = 0;
    if (factor_moments(scratch, n, polynomials, d)) {
        solve_polynomial(nodal, polynomials, -1, b);
        apply_polynomial(scratch, n, b, result, d);
        return true;
    }
    for (int k = 0; k < n; k++)
        sum += scratch->kernel[k];
    for (int k = 0; k < n; k++)
        result[k] = sum > 0 ? scratch->kernel[k] / sum : 0;
    return false;
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
    for (int row = 1; row < nodal->rows; row++)
        weight[row] = nodal->moment[row - 1] ? nodal->moment[row - 1][node] : volume * half * half / 3;
}

/* dni and nsni: gradients at the node itself, and of nsni their derivatives. */
THREADS_INLINE bool set_rows_at_node(const struct nodal *nodal, size_t node, int n, struct nodal_scratch *scratch, const int d)
{
    const bool is_direct = nodal->rule == INTEGRATION_DNI && nodal->gradient == GRADIENT_DIRECT;
    const bool wants_slopes = is_direct || nodal->rule == INTEGRATION_NSNI;
    struct polynomials polynomials;
    double middle[AXES] = {0}, b[TERMS];
    for (int a = 0; a < d; a++)
        middle[a] = nodal->x[a][node];
    set_kernels(nodal, middle, nodal->reach[node], n, wants_slopes, scratch, d);
    if (!find_values(nodal, scratch, n, &polynomials, nodal->value + node * (size_t)nodal->stride, d))
        return false;
    for (int a = 0; a < d && wants_slopes; a++)
        sum_moments(scratch, scratch->slope[a], n, &polynomials.slope[a][0][0], TERMS, d);
    for (int a = 0; a < d; a++) {
        solve_polynomial(nodal, &polynomials, is_direct ? -1 : a, b);
        if (is_direct)
            apply_derivative(nodal, scratch, n, &polynomials, b, a, row_of(nodal, node, 0, a), d);
        else
            apply_polynomial(scratch, n, b, row_of(nodal, node, 0, a), d);
        for (int row = 1; row < nodal->rows; row++)
            apply_derivative(nodal, scratch, n, &polynomials, b, row - 1, row_of(nodal, node, row, a), d);
    }
    return true;
}

/* snni: differences between the middles of opposite faces of a square or cube around the node, which is not cut at the boundary. */
THREADS_INLINE bool set_rows_of_box(const struct nodal *nodal, size_t node, int n, struct nodal_scratch *scratch, const int d)
{
    const double half = half_side(nodal->volume[node], d), reach = nodal->reach[node];
    struct polynomials polynomials;
    double point[AXES] = {0};
    for (int a = 0; a < d; a++)
        point[a] = nodal->x[a][node];
    set_kernels(nodal, point, reach, n, false, scratch, d);
    bool good = find_values(nodal, scratch, n, &polynomials, nodal->value + node * (size_t)nodal->stride, d);
    for (int a = 0; a < d; a++) {
        for (int side = 0; side < 2; side++) {
            point[a] = nodal->x[a][node] + (side == 0 ? -half : half);
            set_kernels(nodal, point, reach, n, false, scratch, d);
            good = find_values(nodal, scratch, n, &polynomials, scratch->value[side], d) && good;
        }
        point[a] = nodal->x[a][node];
        double *restrict gradient = row_of(nodal, node, 0, a);
        for (int k = 0; k < n; k++)
            gradient[k] = (scratch->value[1][k] - scratch->value[0][k]) / (2 * half);
    }
    return good;
}

THREADS_INLINE void set_node(struct nodal *nodal, size_t node, struct nodal_scratch *scratch, const int d)
{
    const bool is_box = nodal->rule == INTEGRATION_SNNI;
    const int n = find_neighbours(nodal, node, is_box ? half_side(nodal->volume[node], d) : 0, d);
    nodal->neighbours[node] = n;
    if (n > nodal->stride) {
        scratch->most = n > scratch->most ? n : scratch->most;
        return;
    }
    gather_places(nodal, node, scratch, d);
    set_weights(nodal, node, d);
    nodal->is_lowered[node] = !(is_box ? set_rows_of_box(nodal, node, n, scratch, d) : set_rows_at_node(nodal, node, n, scratch, d));
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
    const size_t size = (size_t)stride;
    scratch->most = 0;
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

/* Makes room for so many neighbours of each node. */
static void make_room(struct nodal *nodal, int stride)
{
    const size_t pairs = nodal->count * (size_t)stride;
    nodal->stride = stride;
    nodal->neighbour = memory_grow(nodal->neighbour, &nodal->neighbour_capacity, pairs, sizeof *nodal->neighbour, "rows of nodes");
    nodal->value = memory_grow(nodal->value, &nodal->value_capacity, pairs, sizeof(double), "rows of nodes");
    nodal->gradients = memory_grow(nodal->gradients, &nodal->gradient_capacity, pairs * (size_t)(nodal->rows * nodal->dimension), sizeof(double),
                                   "rows of nodes");
    for (int i = 0; i < nodal->n_scratch; i++)
        open_scratch(&nodal->scratch[i], stride);
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
    search_renew(&nodal->search, nodal->count, nodal->x, nodal->radius);
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

void rkpm_nodal_open(struct nodal *nodal, int dimension, enum integration_form rule, enum gradient_form gradient, size_t count,
                     double *const *x, const double *volume, const double *const *moment, const double radius[3], bool grows)
{
    *nodal = (struct nodal){.dimension = dimension, .rule = rule, .gradient = gradient, .count = count, .x = x, .volume = volume, .grows = grows};
    nodal->rows = rule == INTEGRATION_NSNI ? 1 + dimension : 1;
    for (int a = 0; a < 3; a++) {
        nodal->moment[a] = moment ? moment[a] : NULL;
        nodal->radius[a] = radius[a];
    }
    nodal->neighbours = memory_array(count, sizeof *nodal->neighbours, "rows of nodes");
    nodal->weights = memory_array(count * (size_t)nodal->rows, sizeof(double), "rows of nodes");
    nodal->reach = memory_array(count, sizeof(double), "rows of nodes");
    nodal->is_lowered = memory_array(count, sizeof *nodal->is_lowered, "rows of nodes");
    nodal->n_scratch = threads_available();
    nodal->scratch = memory_array((size_t)nodal->n_scratch, sizeof *nodal->scratch, "rows of nodes");
    search_open(&nodal->search, dimension, count, x, radius);
    make_room(nodal, 8);
    rkpm_nodal_renew(nodal);
}

void rkpm_nodal_close(struct nodal *nodal)
{
    search_close(&nodal->search);
    for (int i = 0; i < nodal->n_scratch; i++)
        memory_free(nodal->scratch[i].room);
    memory_free(nodal->scratch);
    memory_free(nodal->neighbours);
    memory_free(nodal->neighbour);
    memory_free(nodal->value);
    memory_free(nodal->gradients);
    memory_free(nodal->weights);
    memory_free(nodal->reach);
    memory_free(nodal->is_lowered);
}
