/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rotation of the old stress by the spin of the step. */
#include "base/threads.h"
#include "material/law.h"

THREADS_VECTORISED
void law_rotate_explicit(const struct law_batch *batch)
{
    double *restrict s1 = batch->stress[0], *restrict s2 = batch->stress[1], *restrict s3 = batch->stress[2];
    double *restrict s4 = batch->stress[3], *restrict s5 = batch->stress[4], *restrict s6 = batch->stress[5];
    const double *restrict spin1 = batch->spin[0], *restrict spin2 = batch->spin[1], *restrict spin3 = batch->spin[2];
    const int count = batch->count;
#pragma omp simd
    for (int j = 0; j < count; j++) {
        double w1 = spin1[j], w2 = spin2[j], w3 = spin3[j];
        double xx = s1[j], yy = s2[j], zz = s3[j], yz = s4[j], xz = s5[j], xy = s6[j];
        double q1 = 2 * xy * w3, q2 = 2 * xz * w2, q3 = 2 * yz * w1;
        s1[j] = xx - q1 + q2;
        s2[j] = yy + q1 - q3;
        s3[j] = zz - q2 + q3;
        s4[j] = yz + w1 * (yy - zz) + w3 * xz - w2 * xy;
        s5[j] = xz + w2 * (zz - xx) + w1 * xy - w3 * yz;
        s6[j] = xy + w3 * (xx - yy) + w2 * yz - w1 * xz;
    }
}

/* R = 1 + (W + W W / 2) / (1 + w.w / 4), the closed form of (1 - W/2)^-1 (1 + W/2) for the
 * skew W with axial vector w. */
THREADS_INLINE void hughes_winget(double w1, double w2, double w3, double r[3][3])
{
    double scale = 1 / (1 + 0.25 * (w1 * w1 + w2 * w2 + w3 * w3));
    double half = 0.5 * scale;
    r[0][0] = 1 - half * (w2 * w2 + w3 * w3);
    r[1][1] = 1 - half * (w1 * w1 + w3 * w3);
    r[2][2] = 1 - half * (w1 * w1 + w2 * w2);
    r[0][1] = half * w1 * w2 - scale * w3;
    r[1][0] = half * w1 * w2 + scale * w3;
    r[0][2] = half * w1 * w3 + scale * w2;
    r[2][0] = half * w1 * w3 - scale * w2;
    r[1][2] = half * w2 * w3 - scale * w1;
    r[2][1] = half * w2 * w3 + scale * w1;
}

THREADS_INLINE void rotate_point(const struct law_batch *batch, int j)
{
    double r[3][3], left[3][3];
    hughes_winget(batch->spin[0][j], batch->spin[1][j], batch->spin[2][j], r);
    double xx = batch->stress[0][j], yy = batch->stress[1][j], zz = batch->stress[2][j];
    double yz = batch->stress[3][j], xz = batch->stress[4][j], xy = batch->stress[5][j];
    for (int a = 0; a < 3; a++) {
        left[a][0] = r[a][0] * xx + r[a][1] * xy + r[a][2] * xz;
        left[a][1] = r[a][0] * xy + r[a][1] * yy + r[a][2] * yz;
        left[a][2] = r[a][0] * xz + r[a][1] * yz + r[a][2] * zz;
    }
    batch->stress[0][j] = left[0][0] * r[0][0] + left[0][1] * r[0][1] + left[0][2] * r[0][2];
    batch->stress[1][j] = left[1][0] * r[1][0] + left[1][1] * r[1][1] + left[1][2] * r[1][2];
    batch->stress[2][j] = left[2][0] * r[2][0] + left[2][1] * r[2][1] + left[2][2] * r[2][2];
    batch->stress[3][j] = left[1][0] * r[2][0] + left[1][1] * r[2][1] + left[1][2] * r[2][2];
    batch->stress[4][j] = left[0][0] * r[2][0] + left[0][1] * r[2][1] + left[0][2] * r[2][2];
    batch->stress[5][j] = left[0][0] * r[1][0] + left[0][1] * r[1][1] + left[0][2] * r[1][2];
}

THREADS_VECTORISED
void law_rotate_exact(const struct law_batch *batch)
{
    const int count = batch->count;
#pragma omp simd
    for (int j = 0; j < count; j++)
        rotate_point(batch, j);
}

void law_rotate_history(const struct law_batch *batch, void (*rotate)(const struct law_batch *batch))
{
    struct law_batch element = *batch;
    for (int i = 0; i < batch->material->n_elements; i++) {
        for (int a = 0; a < 6; a++)
            element.stress[a] = batch->history[6 * i + a] + batch->history_from;
        rotate(&element);
    }
}
