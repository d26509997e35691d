/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eigenvalues of symmetric matrices of any size, for tests: slow and simple (base/symmetric is for 6 x 6 at most). */
#ifndef UNIT_DIAGONALISE_H
#define UNIT_DIAGONALISE_H

#include <math.h>

/* Plane rotations (Jacobi) of the upper left n x n part of a matrix whose rows are `stride` numbers apart; its diagonal becomes the
 * eigenvalues. */
static inline void diagonalise(int n, int stride, double *matrix)
{
    double apart = 1, all = 1;
    for (int sweep = 0; sweep < 30 && apart > 1e-26 * all; sweep++) {
        apart = all = 0;
        for (int p = 0; p < n; p++)
            for (int q = p + 1; q < n; q++) {
                double *mp = matrix + (long)p * stride, *mq = matrix + (long)q * stride;
                apart += mp[q] * mp[q];
                all += mp[p] * mp[p];
                if (mp[q] == 0)
                    continue;
                const double angle = 0.5 * atan2(2 * mp[q], mq[q] - mp[p]), c = cos(angle), s = sin(angle);
                for (int k = 0; k < n; k++) {
                    const double x = mp[k], y = mq[k];
                    mp[k] = c * x - s * y;
                    mq[k] = s * x + c * y;
                }
                for (int k = 0; k < n; k++) {
                    double *row = matrix + (long)k * stride;
                    const double x = row[p], y = row[q];
                    row[p] = c * x - s * y;
                    row[q] = s * x + c * y;
                }
            }
    }
}

#endif
