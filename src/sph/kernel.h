/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wendland's C2 kernel, of support 2h (spec am-sph 2). */
#ifndef SPH_KERNEL_H
#define SPH_KERNEL_H

#include "base/threads.h"

/* What of the kernel does not depend on the pair. */
struct kernel {
    double inverse;  /* 1/h */
    double value;    /* alpha: 7/(4 pi h^2) or 21/(16 pi h^3) */
    double slope;    /* -5 alpha/h^2 */
    double reach2;   /* (2h)^2 */
};

/* The kernel of smoothing length h in 2 or 3 dimensions. */
static inline struct kernel kernel_of(double h, int dimension)
{
    const double pi = 3.14159265358979323846;
    const double alpha = dimension == 2 ? 7 / (4 * pi * h * h) : 21 / (16 * pi * h * h * h);
    return (struct kernel){1 / h, alpha, -5 * alpha / (h * h), 4 * h * h};
}

/* W at distance r, which must not be beyond 2h. */
THREADS_INLINE double kernel_value(const struct kernel *kernel, double r)
{
    const double q = r * kernel->inverse, a = 1 - 0.5 * q, a2 = a * a;
    return kernel->value * a2 * a2 * (2 * q + 1);
}

/* F = (1/r) dW/dr <= 0, finite at r = 0, so that grad_a W = F (x_a - x_b). */
THREADS_INLINE double kernel_slope(const struct kernel *kernel, double r)
{
    const double a = 1 - 0.5 * r * kernel->inverse;
    return kernel->slope * a * a * a;
}

#endif
