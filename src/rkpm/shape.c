/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rkpm/shape.h"
#include "base/memory.h"
#include "rkpm/moments.h"

#include <math.h>
#include <string.h>

int rkpm_shape_order(enum basis_form form)
{
    return form == BASIS_QUADRATIC ? 2 : 1;
}

/* Room for the row of a point. */
static void open_row(struct rkpm_shape *shape)
{
    const size_t most = shape->most;
    shape->row = (struct shape_row){.node = memory_array(most, sizeof *shape->row.node, "shape functions"),
                                    .value = memory_array(most, sizeof(double), "shape functions")};
    shape->monomials = memory_array(most * BASIS_LARGEST, sizeof(double), "shape functions");
    shape->kernel = memory_array(most, sizeof(double), "shape functions");
    for (int a = 0; a < shape->dimension; a++) {
        shape->row.gradient[a] = memory_array(most, sizeof(double), "shape functions");
        shape->kernel_slope[a] = memory_array(most, sizeof(double), "shape functions");
    }
}

void rkpm_shape_open(struct rkpm_shape *shape, int dimension, enum basis_form form, size_t count, double *const *x,
                     const struct rkpm_support *support)
{
    *shape = (struct rkpm_shape){.dimension = dimension, .x = x, .support = *support, .form = form, .top = form == BASIS_LINEAR ? 1 : 2};
    shape->basis[0] = basis_complete(dimension, 0);
    shape->basis[1] = basis_complete(dimension, 1);
    shape->basis[2] = form == BASIS_BILINEAR ? basis_tensor(dimension) : basis_complete(dimension, 2);
    search_open(&shape->search, dimension, count, x, support->radius);
    shape->most = search_most(&shape->search, pow(MOMENTS_ENLARGEMENT, MOMENTS_ENLARGEMENTS));
    open_row(shape);
}

void rkpm_shape_open_copy(struct rkpm_shape *copy, const struct rkpm_shape *shape)
{
    *copy = *shape;
    copy->enlarged = copy->lowered = 0;
    open_row(copy);
}

void rkpm_shape_close_copy(struct rkpm_shape *copy)
{
    memory_free(copy->row.node);
    memory_free(copy->row.value);
    memory_free(copy->monomials);
    memory_free(copy->kernel);
    for (int a = 0; a < 3; a++) {
        memory_free(copy->row.gradient[a]);
        memory_free(copy->kernel_slope[a]);
    }
}

void rkpm_shape_close(struct rkpm_shape *shape)
{
    search_close(&shape->search);
    rkpm_shape_close_copy(shape);
}

/* --- nodes and kernels --- */

/* Takes a node in where its kernel reaches the point: the product of those along the axes, and its slopes. */
static void take_node(struct rkpm_shape *shape, int32_t node, const double point[3])
{
    const enum kernel_form kernel = shape->support.kernel;
    const int n = shape->row.count;
    double phi[3], slope[3], product = 1;
    for (int a = 0; a < shape->dimension; a++) {
        const double radius = shape->support.radius[a] * shape->row.reach, offset = point[a] - shape->x[a][node], z = fabs(offset) / radius;
        if (z >= 1)
            return;
        const double along = rkpm_kernel_slope(kernel, z);
        phi[a] = rkpm_kernel(kernel, z);
        slope[a] = copysign(along / radius, offset * along);
        product *= phi[a];
    }
    if (product <= MOMENTS_LEAST_KERNEL)
        return;
    shape->row.node[n] = node;
    shape->kernel[n] = product;
    for (int a = 0; a < shape->dimension; a++)
        shape->kernel_slope[a][n] = product / phi[a] * slope[a];
    shape->row.count++;
}

static void find_nodes(struct rkpm_shape *shape, const double point[3])
{
    const struct search *search = &shape->search;
    int from[3], to[3], cell[3];
    int32_t first, end;
    search_range(search, point, shape->row.reach, from, to);
    shape->row.count = 0;
    cell[0] = from[0];
    for (cell[2] = from[2]; cell[2] <= to[2]; cell[2]++)
        for (cell[1] = from[1]; cell[1] <= to[1]; cell[1]++) {
            search_span(search, cell, to[0], &first, &end);
            for (int32_t k = first; k < end; k++)
                take_node(shape, search->node[k], point);
        }
}

/* --- the moment matrix --- */

static void scaled_offset(const struct rkpm_shape *shape, const double point[3], int n, double xi[3])
{
    for (int a = 0; a < shape->dimension; a++)
        xi[a] = (point[a] - shape->x[a][shape->row.node[n]]) / shape->support.radius[a];
}

/* M = sum H H^T Phi (3.6), its lower half; keeps H of each node. */
static void sum_moments(struct rkpm_shape *shape, const struct basis *basis, const double point[3], struct moments *moments)
{
    *moments = (struct moments){.count = basis->count};
    for (int n = 0; n < shape->row.count; n++) {
        double *h = shape->monomials + (size_t)n * BASIS_LARGEST, xi[3];
        scaled_offset(shape, point, n, xi);
        basis_value(basis, xi, h);
        for (int i = 0; i < basis->count; i++)
            for (int j = 0; j <= i; j++)
                moments->a[i][j] += h[i] * h[j] * shape->kernel[n];
    }
}

static double product(int count, const double *a, const double *b)
{
    double sum = 0;
    for (int i = 0; i < count; i++)
        sum += a[i] * b[i];
    return sum;
}

/* --- values and gradients --- */

/* b = M^-1 H(0), Psi = b.H Phi (3.5). */
static void set_values(struct rkpm_shape *shape, const struct moments *moments, double *b)
{
    memset(b, 0, BASIS_LARGEST * sizeof *b);
    b[0] = 1;
    moments_solve(moments, b, moments->count);
    for (int n = 0; n < shape->row.count; n++)
        shape->row.value[n] = product(moments->count, b, shape->monomials + (size_t)n * BASIS_LARGEST) * shape->kernel[n];
}

/* b_,i = -M^-1 M_,i b, without M_,i: node by node M_,i b = sum H_,i (H.b) Phi + H (H_,i.b) Phi + H (H.b) Phi_,i. */
static void direct_gradient(struct rkpm_shape *shape, const struct basis *basis, const struct moments *moments, const double point[3],
                            const double *b, int axis)
{
    double change[BASIS_LARGEST] = {0}, slope[BASIS_LARGEST], xi[3];
    for (int n = 0; n < shape->row.count; n++) {
        const double *h = shape->monomials + (size_t)n * BASIS_LARGEST;
        scaled_offset(shape, point, n, xi);
        basis_slope(basis, xi, axis, slope);
        const double own = product(moments->count, b, h);
        const double along_slope = own * shape->kernel[n] / shape->support.radius[axis];
        const double along_value = product(moments->count, b, slope) / shape->support.radius[axis] * shape->kernel[n] + own * shape->kernel_slope[axis][n];
        for (int m = 0; m < moments->count; m++)
            change[m] -= slope[m] * along_slope + h[m] * along_value;
        shape->row.gradient[axis][n] = along_value;
    }
    moments_solve(moments, change, moments->count);
    for (int n = 0; n < shape->row.count; n++)
        shape->row.gradient[axis][n] += product(moments->count, change, shape->monomials + (size_t)n * BASIS_LARGEST) * shape->kernel[n];
}

/* b^(i) = M^-1 H^(i), H^(i) = -e_i/s; Psi^(i) = b^(i).H Phi. */
static void implicit_gradient(struct rkpm_shape *shape, const struct moments *moments, int axis)
{
    double b[BASIS_LARGEST] = {0};
    b[1 + axis] = -1 / shape->support.radius[axis];
    moments_solve(moments, b, moments->count);
    for (int n = 0; n < shape->row.count; n++)
        shape->row.gradient[axis][n] = product(moments->count, b, shape->monomials + (size_t)n * BASIS_LARGEST) * shape->kernel[n];
}

/* Finds the nodes near a point and factors their moment matrix, with larger supports or a lower order where it must be. */
static const struct basis *find_basis(struct rkpm_shape *shape, const double point[3], struct moments *moments)
{
    for (int level = shape->top; level >= 0; level--) {
        shape->row.reach = 1;
        for (int i = 0; i <= MOMENTS_ENLARGEMENTS; i++, shape->row.reach *= MOMENTS_ENLARGEMENT) {
            find_nodes(shape, point);
            sum_moments(shape, &shape->basis[level], point, moments);
            if (shape->row.count >= moments->count && moments_factor(moments, moments->count)) {
                shape->row.order = level == shape->top ? rkpm_shape_order(shape->form) : level;
                shape->enlarged += i > 0;
                shape->lowered += level < shape->top;
                return &shape->basis[level];
            }
        }
    }
    shape->row.order = -1;
    shape->row.count = 0;
    shape->lowered++;
    return NULL;
}

const struct shape_row *rkpm_shape_at(struct rkpm_shape *shape, const double point[3], enum gradient_form gradient)
{
    struct moments moments;
    double b[BASIS_LARGEST];
    const struct basis *basis = find_basis(shape, point, &moments);
    if (!basis)
        return &shape->row;
    set_values(shape, &moments, b);
    for (int a = 0; a < shape->dimension && gradient != GRADIENT_NONE; a++) {
        if (shape->row.order == 0)
            memset(shape->row.gradient[a], 0, (size_t)shape->row.count * sizeof(double));
        else if (gradient == GRADIENT_DIRECT)
            direct_gradient(shape, basis, &moments, point, b, a);
        else
            implicit_gradient(shape, &moments, a);
    }
    return &shape->row;
}
