/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/sparse.h"
#include "base/memory.h"
#include "base/threads.h"

enum { FEW_ROWS = 2000 }; /* below these one thread is faster */

void sparse_open(struct sparse *sparse, int32_t count, int size, const int32_t *blocks)
{
    *sparse = (struct sparse){.count = count, .size = size};
    sparse->first = memory_array((size_t)count + 1, sizeof *sparse->first, "a sparse matrix");
    for (int32_t i = 0; i < count; i++)
        sparse->first[i + 1] = sparse->first[i] + (size_t)blocks[i];
    sparse->column = memory_array(sparse->first[count], sizeof *sparse->column, "a sparse matrix");
    sparse->value = memory_array(sparse->first[count] * (size_t)(size * size), sizeof(double), "a sparse matrix");
}

void sparse_close(struct sparse *sparse)
{
    memory_free(sparse->first);
    memory_free(sparse->column);
    memory_free(sparse->value);
}

double *sparse_block(const struct sparse *sparse, int32_t row, int32_t column)
{
    size_t low = sparse->first[row], high = sparse->first[row + 1] - 1;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (sparse->column[middle] < column)
            low = middle + 1;
        else
            high = middle;
    }
    return sparse->value + low * (size_t)(sparse->size * sparse->size);
}

bool sparse_invert(int size, const double *block, double *inverse)
{
    double a[3][6] = {{0}};
    for (int i = 0; i < size; i++)
        for (int j = 0; j < size; j++) {
            a[i][j] = block[i * size + j];
            a[i][size + j] = i == j;
        }
    for (int i = 0; i < size; i++) {
        const double pivot = a[i][i];
        if (!(pivot > 0))
            return false;
        for (int j = 0; j < 2 * size; j++)
            a[i][j] /= pivot;
        for (int k = 0; k < size; k++) {
            const double factor = k == i ? 0 : a[k][i];
            for (int j = 0; j < 2 * size; j++)
                a[k][j] -= factor * a[i][j];
        }
    }
    for (int i = 0; i < size; i++)
        for (int j = 0; j < size; j++)
            inverse[i * size + j] = a[i][size + j];
    return true;
}

/* Rows of blocks of a size that the caller knows. */
THREADS_INLINE void multiply_row(const struct sparse *sparse, int32_t row, const double *restrict x, double *restrict y, const int size)
{
    double sum[3] = {0};
    for (size_t k = sparse->first[row]; k < sparse->first[row + 1]; k++) {
        const double *block = sparse->value + k * (size_t)(size * size), *from = x + (size_t)sparse->column[k] * (size_t)size;
        for (int a = 0; a < size; a++)
            for (int b = 0; b < size; b++)
                sum[a] += block[a * size + b] * from[b];
    }
    for (int a = 0; a < size; a++)
        y[(size_t)row * (size_t)size + (size_t)a] = sum[a];
}

static void multiply_1(const struct sparse *sparse, int32_t row, const double *x, double *y)
{
    multiply_row(sparse, row, x, y, 1);
}

static void multiply_2(const struct sparse *sparse, int32_t row, const double *x, double *y)
{
    multiply_row(sparse, row, x, y, 2);
}

static void multiply_3(const struct sparse *sparse, int32_t row, const double *x, double *y)
{
    multiply_row(sparse, row, x, y, 3);
}

void sparse_multiply(const struct sparse *sparse, const double *x, double *y)
{
    static void (*const multiply[])(const struct sparse *, int32_t, const double *, double *) = {NULL, multiply_1, multiply_2, multiply_3};
#pragma omp parallel for schedule(static) if (sparse->count >= FEW_ROWS)
    for (int32_t row = 0; row < sparse->count; row++)
        multiply[sparse->size](sparse, row, x, y);
}
