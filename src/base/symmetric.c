/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/symmetric.h"

#include <math.h>

enum { N = SYMMETRIC_LARGEST, MOST_SWEEPS = 50 };

/* Turns columns and rows p and q so that their common entry vanishes. */
static void rotate(int n, double m[N][N], double vectors[N][N], int p, int q)
{
    double angle = 0.5 * atan2(2 * m[p][q], m[q][q] - m[p][p]), c = cos(angle), s = sin(angle);
    for (int k = 0; k < n; k++) {
        double x = m[k][p], y = m[k][q];
        m[k][p] = c * x - s * y;
        m[k][q] = s * x + c * y;
        x = vectors[k][p], y = vectors[k][q];
        vectors[k][p] = c * x - s * y;
        vectors[k][q] = s * x + c * y;
    }
    for (int k = 0; k < n; k++) {
        double x = m[p][k], y = m[q][k];
        m[p][k] = c * x - s * y;
        m[q][k] = s * x + c * y;
    }
    m[p][q] = m[q][p] = 0;
}

void symmetric_eigen(int n, double matrix[N][N], double values[N], double vectors[N][N])
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            vectors[i][j] = i == j;
    for (int sweep = 0; sweep < MOST_SWEEPS; sweep++) {
        double apart = 0, all = 0;
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) {
                all += matrix[i][j] * matrix[i][j];
                apart += i != j ? matrix[i][j] * matrix[i][j] : 0;
            }
        if (!(apart > 1e-32 * all))
            break;
        for (int p = 0; p < n; p++)
            for (int q = p + 1; q < n; q++)
                rotate(n, matrix, vectors, p, q);
    }
    for (int i = 0; i < n; i++)
        values[i] = matrix[i][i];
}
