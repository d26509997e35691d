/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kernel along one axis: a cubic B-spline that ends at the support radius. Both branches are evaluated, so that loops over
 * nodes are vectorised. */
#ifndef RKPM_KERNEL_H
#define RKPM_KERNEL_H

#include <math.h>

/* phi(z) of z = |x - x_I|/R; its second branch is (3.7) in the form that keeps its digits near the end. */
static inline double rkpm_kernel(double z)
{
    const double rest = z < 1 ? 1 - z : 0, inner = 2.0 / 3.0 - 4 * z * z * rest, outer = 4.0 / 3.0 * rest * rest * rest;
    return z <= 0.5 ? inner : outer;
}

/* d phi/dz */
static inline double rkpm_kernel_slope(double z)
{
    const double rest = z < 1 ? 1 - z : 0, inner = z * (12 * z - 8), outer = -4 * rest * rest;
    return z <= 0.5 ? inner : outer;
}

#endif
