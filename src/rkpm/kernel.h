/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kernels along one axis, phi(z) of z = |x - x_I|/R: they end at the support radius. All branches are evaluated, so that loops
 * over nodes are vectorised where the form is a constant of the function that calls them. Their heights cancel out of shape
 * functions. */
#ifndef RKPM_KERNEL_H
#define RKPM_KERNEL_H

#include "base/threads.h"
#include "deck/scene_rkpm.h"

#include <math.h>

/* A kernel and how far it reaches along each axis. */
struct rkpm_support {
    enum kernel_form kernel;
    double radius[3];
};

/* --- cubic B-spline; its second branch is (3.7) in the form that keeps its digits near the end --- */

THREADS_INLINE double kernel_cubic(double z)
{
    const double rest = z < 1 ? 1 - z : 0, inner = 2.0 / 3.0 - 4 * z * z * rest, outer = 4.0 / 3.0 * rest * rest * rest;
    return z <= 0.5 ? inner : outer;
}

THREADS_INLINE double kernel_cubic_slope(double z)
{
    const double rest = z < 1 ? 1 - z : 0, inner = z * (12 * z - 8), outer = -4 * rest * rest;
    return z <= 0.5 ? inner : outer;
}

/* --- quintic B-spline: truncated powers of 3 - 3 z, 2 - 3 z and 1 - 3 z, 1 at the node --- */

THREADS_INLINE double kernel_truncated(double t)
{
    return t > 0 ? t * t * t * t : 0;
}

THREADS_INLINE double kernel_quintic(double z)
{
    const double t = 3 - 3 * z;
    return (t * kernel_truncated(t) - 6 * (t - 1) * kernel_truncated(t - 1) + 15 * (t - 2) * kernel_truncated(t - 2)) / 66;
}

THREADS_INLINE double kernel_quintic_slope(double z)
{
    const double t = 3 - 3 * z;
    return -15.0 / 66.0 * (kernel_truncated(t) - 6 * kernel_truncated(t - 1) + 15 * kernel_truncated(t - 2));
}

/* --- exponential: exp(-(z/c)^2) less what it is at the end, 1 at the node; its slope there is not zero --- */

#define KERNEL_WIDTH 0.4 /* c: at the end the slope is 1.4 % of the steepest one */

THREADS_INLINE double kernel_exponential(double z)
{
    const double sharp = 1 / (KERNEL_WIDTH * KERNEL_WIDTH), end = exp(-sharp);
    return z < 1 ? end * expm1((1 - z) * (1 + z) * sharp) / (1 - end) : 0;
}

THREADS_INLINE double kernel_exponential_slope(double z)
{
    const double sharp = 1 / (KERNEL_WIDTH * KERNEL_WIDTH);
    return z < 1 ? -2 * z * sharp * exp(-z * z * sharp) / (1 - exp(-sharp)) : 0;
}

/* --- any of them --- */

THREADS_INLINE double rkpm_kernel(enum kernel_form form, double z)
{
    return form == KERNEL_CUBIC ? kernel_cubic(z) : form == KERNEL_QUINTIC ? kernel_quintic(z) : kernel_exponential(z);
}

/* d phi/dz */
THREADS_INLINE double rkpm_kernel_slope(enum kernel_form form, double z)
{
    return form == KERNEL_CUBIC ? kernel_cubic_slope(z) : form == KERNEL_QUINTIC ? kernel_quintic_slope(z) : kernel_exponential_slope(z);
}

#endif
