/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The moment matrix of shape functions, M = sum H H^T Phi (3.6), factored as L D L^T. */
#ifndef RKPM_MOMENTS_H
#define RKPM_MOMENTS_H

#include "base/threads.h"
#include "rkpm/basis.h"

#include <stdbool.h>

/* Its lower half; factored: L below the diagonal, D on it. */
struct moments {
    int count;
    double a[BASIS_LARGEST][BASIS_LARGEST];
};

/* Nodes with a smaller kernel have no part; a pivot below this part of the largest diagonal means a condition beyond 1e7. */
static const double MOMENTS_LEAST_KERNEL = 1e-14, MOMENTS_LEAST_PIVOT = 1e-7;
/* Where nodes are too few the supports grow by this factor, at most so often (spec 2.4). */
static const double MOMENTS_ENLARGEMENT = 1.2;
enum { MOMENTS_ENLARGEMENTS = 3 };

/* Factors that of n monomials in place; false where a pivot is too small. Where n is a constant loops are unrolled. */
THREADS_INLINE bool moments_factor(struct moments *moments, const int n)
{
    double largest = 0;
    for (int i = 0; i < n; i++)
        largest = moments->a[i][i] > largest ? moments->a[i][i] : largest;
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < i; j++)
            for (int k = 0; k < j; k++)
                moments->a[i][j] -= moments->a[i][k] * moments->a[j][k];
        for (int j = 0; j < i; j++) {
            const double scaled = moments->a[i][j] / moments->a[j][j];
            moments->a[i][i] -= scaled * moments->a[i][j];
            moments->a[i][j] = scaled;
        }
        if (!(moments->a[i][i] > MOMENTS_LEAST_PIVOT * largest))
            return false;
    }
    return true;
}

/* Replaces a right side by the solution. */
THREADS_INLINE void moments_solve(const struct moments *moments, double *x, const int n)
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++)
            x[i] -= moments->a[i][j] * x[j];
    for (int i = 0; i < n; i++)
        x[i] /= moments->a[i][i];
    for (int i = n - 1; i >= 0; i--)
        for (int j = i + 1; j < n; j++)
            x[i] -= moments->a[j][i] * x[j];
}

#endif
