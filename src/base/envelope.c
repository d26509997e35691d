/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/envelope.h"
#include "base/memory.h"
#include "base/threads.h"

#include <string.h>

/* A pivot below this part of the diagonal is round-off. */
static const double LEAST_PIVOT = 1e-11;

void envelope_open(struct envelope *envelope, int32_t count, const int32_t *first)
{
    const size_t rows = (size_t)count;
    const char *purpose = "a small system";
    envelope->count = count;
    envelope->first = memory_grow(envelope->first, &envelope->first_capacity, rows, sizeof *envelope->first, purpose);
    envelope->start = memory_grow(envelope->start, &envelope->start_capacity, rows, sizeof *envelope->start, purpose);
    envelope->diagonal = memory_grow(envelope->diagonal, &envelope->diagonal_capacity, rows, sizeof(double), purpose);
    size_t length = 0;
    for (size_t i = 0; i < rows; i++) {
        envelope->first[i] = first[i];
        envelope->start[i] = length;
        length += i - (size_t)first[i] + 1;
    }
    envelope->value = memory_grow(envelope->value, &envelope->value_capacity, length, sizeof(double), purpose);
    if (length > 0)
        memset(envelope->value, 0, length * sizeof(double));
}

void envelope_close(struct envelope *envelope)
{
    memory_free(envelope->first);
    memory_free(envelope->start);
    memory_free(envelope->value);
    memory_free(envelope->diagonal);
}

/* Four partial sums, the same for every processor. */
THREADS_VECTORISED
static double product(const double *restrict a, const double *restrict b, int32_t count)
{
    double sum[4] = {0};
    int32_t k = 0;
    for (; k + 4 <= count; k += 4)
        for (int i = 0; i < 4; i++)
            sum[i] += a[k + i] * b[k + i];
    for (; k < count; k++)
        sum[0] += a[k] * b[k];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/* Row i becomes that of L times D, then of L; the diagonal follows. */
void envelope_factor(struct envelope *envelope)
{
    for (int32_t i = 0; i < envelope->count; i++) {
        const int32_t low = envelope->first[i];
        double *row = envelope_at(envelope, i, low), *own = envelope_at(envelope, i, i);
        const double before = *own;
        for (int32_t j = low; j < i; j++) {
            int32_t from = envelope->first[j] > low ? envelope->first[j] : low;
            row[j - low] -= product(row + (from - low), envelope_at(envelope, j, from), j - from);
        }
        for (int32_t j = low; j < i; j++) {
            double scaled = row[j - low] * envelope->diagonal[j];
            *own -= scaled * row[j - low];
            row[j - low] = scaled;
        }
        envelope->diagonal[i] = *own > LEAST_PIVOT * before && before > 0 ? 1 / *own : 0;
    }
}

void envelope_solve(const struct envelope *envelope, double *x)
{
    for (int32_t i = 0; i < envelope->count; i++) {
        int32_t low = envelope->first[i];
        x[i] -= product(envelope_at(envelope, i, low), x + low, i - low);
    }
    for (int32_t i = 0; i < envelope->count; i++)
        x[i] *= envelope->diagonal[i];
    for (int32_t i = envelope->count - 1; i >= 0; i--) {
        const double *row = envelope_at(envelope, i, envelope->first[i]);
        for (int32_t j = envelope->first[i]; j < i; j++)
            x[j] -= row[j - envelope->first[i]] * x[i];
    }
}
