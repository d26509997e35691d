/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What laws of finite strain share. They know the step by its relative gradient f, F := f F, and keep what they need of
 * earlier ones in tensors less 1 that f carries along, so that neither F nor its inverse is needed (spec rkpm 6).
 * Symmetric tensors list their components xx, yy, zz, yz, xz, xy. */
#ifndef MATERIAL_FINITE_H
#define MATERIAL_FINITE_H

#include "base/tensor.h"
#include "material/law.h"

/* f less 1 of a point, from strain and spin increments. */
THREADS_INLINE void finite_gradient(const struct law_batch *batch, int j, double g[3][3])
{
    const double yz = 0.5 * batch->strain[3][j], xz = 0.5 * batch->strain[4][j], xy = 0.5 * batch->strain[5][j];
    for (int a = 0; a < 3; a++)
        g[a][a] = batch->strain[a][j];
    g[2][1] = yz + batch->spin[0][j], g[1][2] = yz - batch->spin[0][j];
    g[0][2] = xz + batch->spin[1][j], g[2][0] = xz - batch->spin[1][j];
    g[1][0] = xy + batch->spin[2][j], g[0][1] = xy - batch->spin[2][j];
}

/* det f less 1. */
THREADS_INLINE double finite_swelling(double g[3][3])
{
    return g[0][0] + g[1][1] + g[2][2] + g[0][0] * g[1][1] - g[0][1] * g[1][0] + g[1][1] * g[2][2] - g[1][2] * g[2][1] + g[0][0] * g[2][2]
         - g[0][2] * g[2][0] + tensor_determinant(g);
}

/* s := f s f^T */
THREADS_INLINE void finite_carry(double g[3][3], double s[6])
{
    static const int place[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}}, row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
    double half[3][3];
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            half[r][c] = s[place[r][c]] + g[r][0] * s[place[0][c]] + g[r][1] * s[place[1][c]] + g[r][2] * s[place[2][c]];
    for (int a = 0; a < 6; a++) {
        const double *left = half[row[a]], *right = g[column[a]];
        s[a] = left[column[a]] + left[0] * right[0] + left[1] * right[1] + left[2] * right[2];
    }
}

/* f f^T less 1: what 1 itself becomes. */
THREADS_INLINE void finite_carry_unit(double g[3][3], double s[6])
{
    static const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
    for (int a = 0; a < 6; a++) {
        const int r = row[a], c = column[a];
        s[a] = g[r][c] + g[c][r] + g[r][0] * g[c][0] + g[r][1] * g[c][1] + g[r][2] * g[c][2];
    }
}

/* The rate of deformation within the step, sym(1 - f^-1)/dt; its shears are not doubled. 0 in a step of no length. */
THREADS_INLINE void finite_rate(double g[3][3], double swelling, double time_step, double rate[6])
{
    static const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
    const double each = time_step > 0 ? 0.5 / time_step : 0;
    double f[3][3], inverse[3][3];
    for (int a = 0; a < 9; a++)
        f[a / 3][a % 3] = g[a / 3][a % 3] + (a % 4 == 0);
    tensor_inverse(f, 1 + swelling, inverse);
    for (int a = 0; a < 6; a++) { /* 1 - f^-1 = g f^-1, which keeps the digits of small g */
        double sum = 0;
        for (int k = 0; k < 3; k++)
            sum += g[row[a]][k] * inverse[k][column[a]] + g[column[a]][k] * inverse[k][row[a]];
        rate[a] = each * sum;
    }
}

/* Carries the volume along, and J less 1, the first column of the history of laws that use this; returns J less 1. */
THREADS_INLINE double finite_volume(const struct law_batch *batch, int j, double swelling)
{
    double *ratio = batch->history[0] + batch->history_from + j;
    batch->volume[j] = batch->volume_before[j] * (1 + swelling);
    return *ratio += swelling * (1 + *ratio);
}

/* p = rho_0 c^2/7 ((rho/rho_0)^7 - 1) of J less 1 (spec rkpm 6.2). */
THREADS_INLINE double finite_pressure(double density, double sound_speed, double ratio)
{
    const double r = 1 / (1 + ratio), r2 = r * r, power = r2 * r2 * r2 * r;
    return density * sound_speed * sound_speed / 7 * (power - 1);
}

#endif
