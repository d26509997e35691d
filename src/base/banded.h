/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Systems with a banded matrix of any sign, not symmetric or indefinite, solved directly by elimination with row exchanges
 * (Golub and Van Loan, Matrix Computations, 4.3). */
#ifndef BASE_BANDED_H
#define BASE_BANDED_H

#include <stdbool.h>
#include <stddef.h>

struct banded {
    size_t count, width; /* a number in row i, column j is zero where they are farther apart than the width */
    double *value;       /* by rows of 3 width + 1, from column i - width on; the last `width` come up by exchanges */
    size_t *exchange;    /* per column: row that it was exchanged with */
};

/* A matrix of zeros. */
void banded_open(struct banded *banded, size_t count, size_t width);
void banded_close(struct banded *banded);

/* The number in row i, column j, |i - j| <= width. */
static inline double *banded_at(const struct banded *banded, size_t i, size_t j)
{
    return banded->value + i * (3 * banded->width + 1) + (j + banded->width - i);
}

/* Replaces the matrix by its factors; false where it is singular. */
bool banded_factor(struct banded *banded);

/* Replaces a right side by the solution. */
void banded_solve(const struct banded *banded, double *x);

#endif
