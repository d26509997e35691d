/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Long vectors, shared among the threads. Sums are taken in portions whose size follows from the
 * length alone, and the portions in their order: results do not depend on the number of threads. */
#ifndef BASE_VECTOR_H
#define BASE_VECTOR_H

#include <stddef.h>

/* Sum of a[i] b[i]. */
double vector_dot(const double *a, const double *b, size_t count);

/* y += factor x. */
void vector_add(double *y, double factor, const double *x, size_t count);

/* y = x + factor y. */
void vector_renew(double *y, const double *x, double factor, size_t count);

/* Euclidean length. */
double vector_length(const double *a, size_t count);

#endif
