/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What loops over pairs of particles share. */
#ifndef SPH_PAIR_H
#define SPH_PAIR_H

#include "sph/sph.h"

#include <math.h>

/* The way from b to a, the square of its length, and the kernel there. */
struct pair {
    double d[3], square, value, slope;
};

/* r^2 in the viscous force of Monaghan and Gingold is at least this times h^2. */
#define PAIR_LEAST_SQUARE 1e-6

/* A way along x, in a scene with a period across its ends where that is shorter. */
THREADS_INLINE double pair_shorter(double d, double period)
{
    return period == 0 ? d : d > 0.5 * period ? d - period : d < -0.5 * period ? d + period : d;
}

/* The way from b to a and its square; across the ends of a periodic scene the shorter one. */
THREADS_INLINE void pair_way(const struct sph *sph, size_t a, size_t b, int dimension, struct pair *pair)
{
    double *const *x = sph->columns.x;
    pair->d[0] = pair_shorter(x[0][a] - x[0][b], sph->period);
    pair->d[1] = x[1][a] - x[1][b];
    pair->d[2] = dimension == 3 ? x[2][a] - x[2][b] : 0;
    pair->square = pair->d[0] * pair->d[0] + pair->d[1] * pair->d[1] + pair->d[2] * pair->d[2];
}

/* False where the kernel ends. */
THREADS_INLINE bool pair_with(const struct sph *sph, const struct kernel *kernel, size_t a, size_t b, int dimension,
                              struct pair *pair)
{
    pair_way(sph, a, b, dimension, pair);
    if (pair->square >= kernel->reach2)
        return false;
    const double r = sqrt(pair->square);
    pair->value = kernel_value(kernel, r);
    pair->slope = kernel_slope(kernel, r);
    return true;
}

/* The same with the kernel of the forces; with `varies` h is the mean of both. */
THREADS_INLINE bool pair_of(const struct sph *sph, size_t a, size_t b, int dimension, bool varies, struct pair *pair)
{
    const struct kernel kernel = varies ? kernel_of(0.5 * (sph->columns.smoothing[a] + sph->columns.smoothing[b]), dimension)
                                        : sph->kernel;
    return pair_with(sph, &kernel, a, b, dimension, pair);
}

THREADS_INLINE double pair_dot(const double a[3], const double b[3], int dimension)
{
    return a[0] * b[0] + a[1] * b[1] + (dimension == 3 ? a[2] * b[2] : 0);
}

/* Runs one of the four forms of a loop over particles: flat or not, h the same for all or not. */
#define RUN_FORM(loop, sph)                                                                                             \
    do {                                                                                                                \
        if ((sph)->dimension == 2 && (sph)->words->varies_smoothing)                                                    \
            loop(sph, 2, true);                                                                                         \
        else if ((sph)->dimension == 2)                                                                                 \
            loop(sph, 2, false);                                                                                        \
        else if ((sph)->words->varies_smoothing)                                                                        \
            loop(sph, 3, true);                                                                                         \
        else                                                                                                            \
            loop(sph, 3, false);                                                                                        \
    } while (0)

#endif
