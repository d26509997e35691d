/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Large matrices of small square blocks, of which each row keeps those that are not zero. */
#ifndef BASE_SPARSE_H
#define BASE_SPARSE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct sparse {
    int32_t count;   /* rows of blocks */
    int size;        /* of a block, 1 to 3 */
    size_t *first;   /* per row: its first block; one more at the end */
    int32_t *column; /* per block, rising within a row */
    double *value;   /* per block size * size numbers, by rows */
};

/* Room for rows with so many blocks each; their columns are the caller's to set. */
void sparse_open(struct sparse *sparse, int32_t count, int size, const int32_t *blocks);
void sparse_close(struct sparse *sparse);

/* The inverse of a block of a size by elimination; false where a pivot is not positive. */
bool sparse_invert(int size, const double *block, double *inverse);

/* The block in a row and column that has one. */
double *sparse_block(const struct sparse *sparse, int32_t row, int32_t column);

/* y = A x; rows are shared among the threads. */
void sparse_multiply(const struct sparse *sparse, const double *x, double *y);

#endif
