/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rkpm/basis.h"

/* Appends the monomials of one degree, x before y before z, whose exponents are at most `largest`. */
static void append(struct basis *basis, int degree, int largest)
{
    const int last_y = basis->dimension > 1 ? degree : 0, last_z = basis->dimension > 2 ? degree : 0;
    for (int k = 0; k <= last_z; k++)
        for (int j = 0; j <= last_y; j++) {
            const int i = degree - j - k;
            if (i < 0 || i > largest || j > largest || k > largest)
                continue;
            int *exponent = basis->exponent[basis->count++];
            exponent[0] = i;
            exponent[1] = j;
            exponent[2] = k;
        }
}

struct basis basis_complete(int dimension, int order)
{
    struct basis basis = {.dimension = dimension};
    for (int degree = 0; degree <= order; degree++)
        append(&basis, degree, degree);
    return basis;
}

struct basis basis_tensor(int dimension)
{
    struct basis basis = {.dimension = dimension};
    for (int degree = 0; degree <= dimension; degree++)
        append(&basis, degree, 1);
    return basis;
}

static double power(double x, int exponent)
{
    return exponent == 0 ? 1 : exponent == 1 ? x : x * x;
}

void basis_value(const struct basis *basis, const double xi[3], double *value)
{
    for (int m = 0; m < basis->count; m++) {
        value[m] = 1;
        for (int a = 0; a < basis->dimension; a++)
            value[m] *= power(xi[a], basis->exponent[m][a]);
    }
}

void basis_slope(const struct basis *basis, const double xi[3], int axis, double *slope)
{
    for (int m = 0; m < basis->count; m++) {
        const int own = basis->exponent[m][axis];
        slope[m] = own == 0 ? 0 : own * power(xi[axis], own - 1);
        for (int a = 0; a < basis->dimension; a++)
            if (a != axis)
                slope[m] *= power(xi[a], basis->exponent[m][a]);
    }
}
