/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shape functions of a linear basis at a point, from given neighbours (spec rkpm 2): for the rows of nodes, which are made
 * anew in every step. The functions get the dimension as a constant of the function that calls them, so that their short
 * loops are unrolled. */
#ifndef RKPM_LINEAR_H
#define RKPM_LINEAR_H

#include "base/threads.h"
#include "rkpm/moments.h"
#include "rkpm/nodal.h"

#include <math.h>

enum { AXES = 3, TERMS = 1 + AXES, LANES = 4 };

/* Numbers per neighbour: its place; at the point that is looked at its scaled offset, its kernel and the kernel's slopes; the
 * shape functions at two points. */
struct nodal_scratch {
    double *room;
    int32_t *list;     /* of neighbours; it and their places have room for one more */
    double *place[AXES], *xi[AXES], *kernel, *slope[AXES], *value[2];
    size_t capacity, list_capacity;
    int most; /* neighbours of a node that had no room */
};

/* The polynomials of a point. */
struct polynomials {
    struct moments moments;          /* factored */
    double first[TERMS];             /* first column of M */
    double slope[AXES][TERMS][TERMS]; /* sum H H^T Phi_,j, the lower half */
};

/* Offsets, kernels and, where they are wanted, slopes. */
THREADS_INLINE void set_kernels_of(const enum kernel_form form, const struct nodal *nodal, const double point[AXES], double reach, int n,
                                   bool wants_slopes, struct nodal_scratch *scratch, const int d)
{
    double over_scale[AXES], over_radius[AXES];
    for (int a = 0; a < d; a++) {
        over_scale[a] = 1 / nodal->support.radius[a];
        over_radius[a] = 1 / (nodal->support.radius[a] * reach);
    }
#pragma omp simd
    for (int k = 0; k < n; k++) {
        double phi[AXES], slope[AXES], kernel = 1;
        for (int a = 0; a < d; a++) {
            const double offset = point[a] - scratch->place[a][k], z = fabs(offset) * over_radius[a];
            scratch->xi[a][k] = offset * over_scale[a];
            phi[a] = rkpm_kernel(form, z);
            slope[a] = wants_slopes ? rkpm_kernel_slope(form, z) * (offset < 0 ? -over_radius[a] : over_radius[a]) : 0;
            kernel *= phi[a];
        }
        const bool is_in = kernel > MOMENTS_LEAST_KERNEL;
        scratch->kernel[k] = is_in ? kernel : 0;
        for (int a = 0; a < d && wants_slopes; a++) {
            for (int b = 0; b < d; b++)
                slope[a] *= b == a ? 1 : phi[b];
            scratch->slope[a][k] = is_in ? slope[a] : 0;
        }
    }
}

/* The same, with zeros behind them up to a whole number of lanes. The form is a constant of each loop. */
THREADS_INLINE void set_kernels(const struct nodal *nodal, const double point[AXES], double reach, int n, bool wants_slopes,
                                struct nodal_scratch *scratch, const int d)
{
    const enum kernel_form form = nodal->support.kernel;
    for (int k = n; k % LANES != 0; k++) {
        scratch->kernel[k] = 0;
        for (int a = 0; a < d; a++)
            scratch->xi[a][k] = scratch->slope[a][k] = 0;
    }
    if (form == KERNEL_CUBIC)
        set_kernels_of(KERNEL_CUBIC, nodal, point, reach, n, wants_slopes, scratch, d);
    else if (form == KERNEL_QUINTIC)
        set_kernels_of(KERNEL_QUINTIC, nodal, point, reach, n, wants_slopes, scratch, d);
    else
        set_kernels_of(KERNEL_EXPONENTIAL, nodal, point, reach, n, wants_slopes, scratch, d);
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
    sum_moments(scratch, scratch->kernel, n, &moments->a[0][0], BASIS_LARGEST, d);
    for (int i = 0; i <= d; i++)
        polynomials->first[i] = moments->a[i][0];
    for (int k = 0; k < n; k++)
        near += scratch->kernel[k] > 0;
    return near > d && moments_factor(moments, d + 1);
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
THREADS_INLINE void solve_polynomial(const struct nodal *nodal, const struct polynomials *polynomials, int axis, double b[TERMS], const int d)
{
    for (int i = 0; i < TERMS; i++)
        b[i] = 0;
    b[axis < 0 ? 0 : 1 + axis] = axis < 0 ? 1 : -1 / nodal->support.radius[axis];
    moments_solve(&polynomials->moments, b, d + 1);
}

/* The derivative along an axis of (b . H) Phi, b' = -M^-1 M' b; H' = e/s, so M' = sum H H^T Phi' + (e M_0^T + M_0 e^T)/s. */
THREADS_INLINE void apply_derivative(const struct nodal *nodal, const struct nodal_scratch *scratch, int n, const struct polynomials *polynomials,
                                     const double b[TERMS], int axis, double *restrict result, const int d)
{
    const double scale = nodal->support.radius[axis];
    double change[TERMS] = {0}, along = 0;
    for (int i = 0; i <= d; i++) {
        for (int j = 0; j <= d; j++)
            change[i] -= polynomials->slope[axis][i > j ? i : j][i > j ? j : i] * b[j];
        change[i] -= polynomials->first[i] * b[1 + axis] / scale;
        along += polynomials->first[i] * b[i];
    }
    change[1 + axis] -= along / scale;
    moments_solve(&polynomials->moments, change, d + 1);
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
        solve_polynomial(nodal, polynomials, -1, b, d);
        apply_polynomial(scratch, n, b, result, d);
        return true;
    }
    for (int k = 0; k < n; k++)
        sum += scratch->kernel[k];
    for (int k = 0; k < n; k++)
        result[k] = sum > 0 ? scratch->kernel[k] / sum : 0;
    return false;
}

#endif
