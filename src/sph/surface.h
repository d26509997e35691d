/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What finding the surface and its forces share: pairs of the wide kernel. */
#ifndef SPH_SURFACE_H
#define SPH_SURFACE_H

#include "sph/pair.h"

#include <math.h>

/* The wide kernel between a and b; with `varies` h_s is the mean of both. */
THREADS_INLINE struct kernel surface_kernel(const struct sph *sph, size_t a, size_t b, int dimension, bool varies)
{
    if (!varies)
        return sph->wide;
    const double ratio = sph->words->wide_smoothing / sph->words->smoothing;
    return kernel_of(0.5 * ratio * (sph->columns.smoothing[a] + sph->columns.smoothing[b]), dimension);
}

/* False where the wide kernel ends. */
THREADS_INLINE bool surface_pair(const struct sph *sph, size_t a, size_t b, int dimension, bool varies, struct pair *pair)
{
    const struct kernel kernel = surface_kernel(sph, a, b, dimension, varies);
    return pair_with(sph, &kernel, a, b, dimension, pair);
}

/* h_s of particle a. */
static inline double surface_length(const struct sph *sph, size_t a)
{
    return sph->columns.smoothing[a] * (sph->words->wide_smoothing / sph->words->smoothing);
}

/* |n| of the wide normal. */
static inline double surface_normal_length(const struct sph *sph, size_t a)
{
    double *const *n = sph->columns.wide_normal;
    return sqrt(n[0][a] * n[0][a] + n[1][a] * n[1][a] + n[2][a] * n[2][a]);
}

#endif
