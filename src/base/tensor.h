/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small tensors. Symmetric ones list their components xx, yy, zz, yz, xz, xy; strain-like ones
 * hold engineering shears. */
#ifndef BASE_TENSOR_H
#define BASE_TENSOR_H

#include "base/threads.h"
#include <math.h>

/* Mean of the normal components. */
THREADS_INLINE double tensor_mean(const double s[6])
{
    return (s[0] + s[1] + s[2]) / 3;
}

/* Von Mises equivalent sqrt(3 J2) from the six stress components. */
THREADS_INLINE double tensor_von_mises(double xx, double yy, double zz, double yz, double xz, double xy)
{
    double a = xx - yy, b = yy - zz, c = zz - xx;
    return sqrt(0.5 * (a * a + b * b + c * c) + 3 * (yz * yz + xz * xz + xy * xy));
}

/* Determinant of the 3x3 matrix m[row][column]. */
THREADS_INLINE double tensor_determinant(double m[3][3])
{
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
         - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
         + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* Inverse of m[row][column], whose determinant is given. */
THREADS_INLINE void tensor_inverse(double m[3][3], double determinant, double inverse[3][3])
{
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) {
            int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
            inverse[c][r] = (m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1]) / determinant;
        }
}

#endif
