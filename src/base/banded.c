/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/banded.h"
#include "base/memory.h"

#include <math.h>

/* A pivot below this part of the largest number of the matrix is round-off. */
static const double LEAST_PIVOT = 1e-15;

void banded_open(struct banded *banded, size_t count, size_t width)
{
    banded->count = count;
    banded->width = width < count ? width : count > 0 ? count - 1 : 0;
    banded->value = memory_array(count * (3 * banded->width + 1), sizeof(double), "a banded system");
    banded->exchange = memory_array(count, sizeof *banded->exchange, "a banded system");
}

void banded_close(struct banded *banded)
{
    memory_free(banded->value);
    memory_free(banded->exchange);
}

static size_t smaller(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* The row at or below k with the largest number in column k. */
static size_t find_pivot(const struct banded *banded, size_t k)
{
    size_t best = k;
    const size_t last = smaller(k + banded->width, banded->count - 1);
    for (size_t i = k + 1; i <= last; i++)
        if (fabs(*banded_at(banded, i, k)) > fabs(*banded_at(banded, best, k)))
            best = i;
    return best;
}

static void exchange_rows(struct banded *banded, size_t k, size_t other)
{
    const size_t last = smaller(k + 2 * banded->width, banded->count - 1);
    for (size_t j = k; j <= last && other != k; j++) {
        double *a = banded_at(banded, k, j), *b = banded_at(banded, other, j), kept = *a;
        *a = *b;
        *b = kept;
    }
}

/* Takes multiples of row k from those below it, and keeps the multiples where the zeros come. */
static void eliminate(struct banded *banded, size_t k)
{
    const size_t last_row = smaller(k + banded->width, banded->count - 1), last = smaller(k + 2 * banded->width, banded->count - 1);
    const double *pivot = banded_at(banded, k, k);
    for (size_t i = k + 1; i <= last_row; i++) {
        double *row = banded_at(banded, i, k);
        const double factor = row[0] /= pivot[0];
        for (size_t j = 1; j <= last - k && factor != 0; j++)
            row[j] -= factor * pivot[j];
    }
}

bool banded_factor(struct banded *banded)
{
    double largest = 0;
    for (size_t i = 0; i < banded->count * (3 * banded->width + 1); i++)
        largest = fmax(largest, fabs(banded->value[i]));
    for (size_t k = 0; k < banded->count; k++) {
        banded->exchange[k] = find_pivot(banded, k);
        exchange_rows(banded, k, banded->exchange[k]);
        if (!(fabs(*banded_at(banded, k, k)) > LEAST_PIVOT * largest))
            return false;
        eliminate(banded, k);
    }
    return true;
}

void banded_solve(const struct banded *banded, double *x)
{
    const size_t count = banded->count;
    for (size_t k = 0; k < count; k++) {
        const double value = x[banded->exchange[k]];
        x[banded->exchange[k]] = x[k];
        x[k] = value;
        for (size_t i = k + 1; i <= smaller(k + banded->width, count - 1); i++)
            x[i] -= *banded_at(banded, i, k) * value;
    }
    for (size_t k = count; k-- > 0;) {
        for (size_t j = k + 1; j <= smaller(k + 2 * banded->width, count - 1); j++)
            x[k] -= *banded_at(banded, k, j) * x[j];
        x[k] /= *banded_at(banded, k, k);
    }
}
