/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/vector.h"
#include "base/threads.h"

#include <math.h>

/* Numbers in a portion, at least; portions of a vector, at most; lanes of partial sums, the same
 * for every processor. */
enum { PORTION = 4096, PORTIONS = 512, LANES = 4 };

typedef double lanes __attribute__((vector_size(LANES * sizeof(double)), aligned(sizeof(double)), may_alias));

static size_t portion_of(size_t count)
{
    size_t portion = (count + PORTIONS - 1) / PORTIONS;
    return portion < PORTION ? PORTION : portion;
}

THREADS_VECTORISED
static double dot_portion(const double *a, const double *b, size_t count)
{
    lanes even = {0}, odd = {0};
    size_t i = 0;
    double rest = 0;
    for (; i + 2 * LANES <= count; i += 2 * LANES) {
        even += *(const lanes *)&a[i] * *(const lanes *)&b[i];
        odd += *(const lanes *)&a[i + LANES] * *(const lanes *)&b[i + LANES];
    }
    for (; i < count; i++)
        rest += a[i] * b[i];
    even += odd;
    return ((even[0] + even[1]) + (even[2] + even[3])) + rest;
}

double vector_dot(const double *a, const double *b, size_t count)
{
    const size_t portion = portion_of(count), portions = (count + portion - 1) / portion;
    double part[PORTIONS], sum = 0;
#pragma omp parallel for schedule(static) if (portions > 4)
    for (size_t k = 0; k < portions; k++) {
        size_t from = k * portion;
        part[k] = dot_portion(a + from, b + from, count - from < portion ? count - from : portion);
    }
    for (size_t k = 0; k < portions; k++)
        sum += part[k];
    return sum;
}

double vector_length(const double *a, size_t count)
{
    return sqrt(vector_dot(a, a, count));
}

THREADS_VECTORISED
static void add_portion(double *restrict y, double factor, const double *restrict x, size_t count)
{
    for (size_t i = 0; i < count; i++)
        y[i] += factor * x[i];
}

void vector_add(double *y, double factor, const double *x, size_t count)
{
    const size_t portion = portion_of(count), portions = (count + portion - 1) / portion;
#pragma omp parallel for schedule(static) if (portions > 4)
    for (size_t k = 0; k < portions; k++) {
        size_t from = k * portion;
        add_portion(y + from, factor, x + from, count - from < portion ? count - from : portion);
    }
}

THREADS_VECTORISED
static void renew_portion(double *restrict y, const double *restrict x, double factor, size_t count)
{
    for (size_t i = 0; i < count; i++)
        y[i] = x[i] + factor * y[i];
}

void vector_renew(double *y, const double *x, double factor, size_t count)
{
    const size_t portion = portion_of(count), portions = (count + portion - 1) / portion;
#pragma omp parallel for schedule(static) if (portions > 4)
    for (size_t k = 0; k < portions; k++) {
        size_t from = k * portion;
        renew_portion(y + from, x + from, factor, count - from < portion ? count - from : portion);
    }
}
