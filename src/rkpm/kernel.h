/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kernel along one axis: a cubic B-spline that ends at the support radius. */
#ifndef RKPM_KERNEL_H
#define RKPM_KERNEL_H

#include <math.h>

/* phi(z) of z = |x - x_I|/R; its second branch is (3.7) in the form that keeps its digits near the end. */
static inline double rkpm_kernel(double z)
{
    const double rest = 1 - z;
    if (z <= 0.5)
        return 2.0 / 3.0 - 4 * z * z * rest;
    return z < 1 ? 4.0 / 3.0 * rest * rest * rest : 0;
}

/* d phi/dz */
static inline double rkpm_kernel_slope(double z)
{
    const double rest = 1 - z;
    if (z <= 0.5)
        return z * (12 * z - 8);
    return z < 1 ? -4 * rest * rest : 0;
}

#endif
