/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/incomplete.h"
#include "base/memory.h"

#include <string.h>

void incomplete_open(struct incomplete *incomplete, const struct sparse *matrix)
{
    const size_t rows = (size_t)matrix->count, size = (size_t)(matrix->size * matrix->size);
    const char *purpose = "factors of a sparse matrix";
    incomplete->matrix = matrix;
    incomplete->value = memory_array(matrix->first[rows] * size, sizeof(double), purpose);
    incomplete->diagonal = memory_array(rows, sizeof *incomplete->diagonal, purpose);
    incomplete->place = memory_array(rows, sizeof *incomplete->place, purpose);
    for (int32_t row = 0; row < matrix->count; row++)
        incomplete->diagonal[row] = (size_t)(sparse_block(matrix, row, row) - matrix->value) / size;
}

void incomplete_close(struct incomplete *incomplete)
{
    memory_free(incomplete->value);
    memory_free(incomplete->diagonal);
    memory_free(incomplete->place);
}

/* --- blocks --- */

/* c -= a b */
static void subtract_product(int d, const double *a, const double *b, double *c)
{
    for (int i = 0; i < d; i++)
        for (int k = 0; k < d; k++)
            for (int j = 0; j < d; j++)
                c[i * d + j] -= a[i * d + k] * b[k * d + j];
}

/* y -= a x */
static void subtract_image(int d, const double *a, const double *x, double *y)
{
    for (int i = 0; i < d; i++)
        for (int j = 0; j < d; j++)
            y[i] -= a[i * d + j] * x[j];
}

/* a becomes a b. */
static void multiply_by(int d, double *a, const double *b)
{
    double product[9] = {0};
    for (int i = 0; i < d; i++)
        for (int k = 0; k < d; k++)
            for (int j = 0; j < d; j++)
                product[i * d + j] += a[i * d + k] * b[k * d + j];
    memcpy(a, product, (size_t)(d * d) * sizeof *a);
}

/* --- factors --- */

static double *block_of(const struct incomplete *incomplete, size_t k)
{
    return incomplete->value + k * (size_t)(incomplete->matrix->size * incomplete->matrix->size);
}

/* A row's blocks as the matrix has them; those that are left out become zero, on the diagonal 1. */
static void take_row(struct incomplete *incomplete, int32_t row, const bool *is_left_out)
{
    const struct sparse *matrix = incomplete->matrix;
    const int d = matrix->size;
    for (size_t k = matrix->first[row]; k < matrix->first[row + 1]; k++) {
        double *block = block_of(incomplete, k);
        if (!is_left_out || !(is_left_out[row] || is_left_out[matrix->column[k]])) {
            memcpy(block, matrix->value + k * (size_t)(d * d), (size_t)(d * d) * sizeof *block);
            continue;
        }
        for (int i = 0; i < d; i++)
            for (int j = 0; j < d; j++)
                block[i * d + j] = i == j && matrix->column[k] == row;
    }
}

/* Takes the row of a column before the diagonal, U_c, out of the row that is worked on: L_rc = A_rc U_cc^-1, A_r -= L_rc U_c. */
static void eliminate(struct incomplete *incomplete, size_t k)
{
    const struct sparse *matrix = incomplete->matrix;
    const int32_t column = matrix->column[k];
    double *lower = block_of(incomplete, k);
    multiply_by(matrix->size, lower, block_of(incomplete, incomplete->diagonal[column]));
    for (size_t m = incomplete->diagonal[column] + 1; m < matrix->first[column + 1]; m++) {
        const size_t place = incomplete->place[matrix->column[m]];
        if (place > 0)
            subtract_product(matrix->size, lower, block_of(incomplete, m), block_of(incomplete, place - 1));
    }
}

bool incomplete_factor(struct incomplete *incomplete, const bool *is_left_out)
{
    const struct sparse *matrix = incomplete->matrix;
    bool good = true;
    for (int32_t row = 0; row < matrix->count && good; row++) {
        double *diagonal = block_of(incomplete, incomplete->diagonal[row]), inverse[9];
        take_row(incomplete, row, is_left_out);
        for (size_t k = matrix->first[row]; k < matrix->first[row + 1]; k++)
            incomplete->place[matrix->column[k]] = k + 1;
        for (size_t k = matrix->first[row]; k < incomplete->diagonal[row]; k++)
            eliminate(incomplete, k);
        for (size_t k = matrix->first[row]; k < matrix->first[row + 1]; k++)
            incomplete->place[matrix->column[k]] = 0;
        good = sparse_invert(matrix->size, diagonal, inverse);
        memcpy(diagonal, inverse, (size_t)(matrix->size * matrix->size) * sizeof *diagonal);
    }
    return good;
}

void incomplete_solve(const struct incomplete *incomplete, const double *r, double *z)
{
    const struct sparse *matrix = incomplete->matrix;
    const int d = matrix->size;
    const size_t size = (size_t)d;
    for (int32_t row = 0; row < matrix->count; row++) {
        double sum[3];
        memcpy(sum, r + (size_t)row * size, size * sizeof *sum);
        for (size_t k = matrix->first[row]; k < incomplete->diagonal[row]; k++)
            subtract_image(d, block_of(incomplete, k), z + (size_t)matrix->column[k] * size, sum);
        memcpy(z + (size_t)row * size, sum, size * sizeof *sum);
    }
    for (int32_t row = matrix->count - 1; row >= 0; row--) {
        double *own = z + (size_t)row * size, sum[3];
        memcpy(sum, own, size * sizeof *sum);
        for (size_t k = incomplete->diagonal[row] + 1; k < matrix->first[row + 1]; k++)
            subtract_image(d, block_of(incomplete, k), z + (size_t)matrix->column[k] * size, sum);
        memset(own, 0, size * sizeof *own);
        const double *inverse = block_of(incomplete, incomplete->diagonal[row]);
        for (int i = 0; i < d; i++)
            for (int j = 0; j < d; j++)
                own[i] += inverse[i * d + j] * sum[j];
    }
}
