/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Monomials that shape functions reproduce, of the scaled offset xi = (x - x_I)/s. */
#ifndef RKPM_BASIS_H
#define RKPM_BASIS_H

#include <stdbool.h>

enum { BASIS_LARGEST = 10 }; /* 1, x, y, z and their products of two */

struct basis {
    int dimension;
    int count;
    int exponent[BASIS_LARGEST][3]; /* 1 first, then the `dimension` linear ones, then those of higher degree */
};

/* All monomials of degree `order` (0, 1 or 2) or less; a tensor basis has all products of linear ones instead. */
struct basis basis_complete(int dimension, int order);
struct basis basis_tensor(int dimension);

/* H(xi). */
void basis_value(const struct basis *basis, const double xi[3], double *value);

/* dH/dxi along an axis. */
void basis_slope(const struct basis *basis, const double xi[3], int axis, double *slope);

#endif
