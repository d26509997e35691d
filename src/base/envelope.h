/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small symmetric systems, solved directly: each row is kept from its first nonzero to the diagonal
 * (George and Liu, Computer Solution of Large Sparse Positive Definite Systems, 1981). */
#ifndef BASE_ENVELOPE_H
#define BASE_ENVELOPE_H

#include <stddef.h>
#include <stdint.h>

struct envelope {
    int32_t count;
    int32_t *first; /* per row: column of its first number */
    size_t *start;  /* per row: where it begins in `value` */
    double *value;
    double *diagonal; /* of the factors L D L^T, inverted; 0 where there was no stiffness */
    size_t first_capacity, start_capacity, value_capacity, diagonal_capacity;
};

/* A matrix of zeros whose row i begins at column first[i] <= i. Room is kept from call to call. */
void envelope_open(struct envelope *envelope, int32_t count, const int32_t *first);
void envelope_close(struct envelope *envelope);

/* The number in row i, column j, first[i] <= j <= i. */
static inline double *envelope_at(const struct envelope *envelope, int32_t i, int32_t j)
{
    return envelope->value + envelope->start[i] + (j - envelope->first[i]);
}

/* Factors a positive semidefinite matrix. Where elimination leaves nothing on the diagonal (round-off
 * beside what was there) the unknown is held at zero, so that singular systems have a solution too. */
void envelope_factor(struct envelope *envelope);

/* Replaces a right side by the solution. */
void envelope_solve(const struct envelope *envelope, double *x);

#endif
