/* SPDX-License-Identifier: GPL-3.0-or-later */
/* neoh: compressible neo-Hookean hyperelasticity (spec 8.1). */
#include "base/tensor.h"
#include "base/threads.h"
#include "material/law.h"

#include <math.h>

static const char *prepare(struct material *material)
{
    law_prepare_elastic(material, true);
    return NULL;
}

/* Deformation gradient of point j. */
THREADS_INLINE void gradient_of(const struct law_batch *batch, int j, double f[3][3])
{
    for (int a = 0; a < 9; a++)
        f[a / 3][a % 3] = batch->deformation[a][j] + (a % 4 == 0);
}

THREADS_INLINE double ratio_of(const struct law_batch *batch, int j)
{
    double f[3][3];
    gradient_of(batch, j, f);
    return tensor_determinant(f);
}

THREADS_INLINE void update_point(const struct law_batch *batch, int j, double shear, double pressure, double ratio)
{
    static const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
    double f[3][3];
    gradient_of(batch, j, f);
    for (int a = 0; a < 6; a++) {
        const double *left = f[row[a]], *right = f[column[a]];
        double b = left[0] * right[0] + left[1] * right[1] + left[2] * right[2];
        batch->stress[a][j] = (shear * b + (a < 3 ? pressure : 0)) / ratio;
    }
}

/* The logarithm keeps a loop from being worked on several points at a time: it has its own. */
THREADS_VECTORISED
static void update(const struct law_batch *batch)
{
    const double shear = batch->material->shear_modulus;
    const double lame = batch->material->bulk_modulus - 2 * shear / 3;
    double *restrict ratio = batch->terms[0], *restrict pressure = batch->terms[1];
#pragma omp simd
    for (int j = 0; j < batch->count; j++)
        ratio[j] = ratio_of(batch, j);
    for (int j = 0; j < batch->count; j++)
        pressure[j] = lame * log(ratio[j]) - shear;
#pragma omp simd
    for (int j = 0; j < batch->count; j++)
        update_point(batch, j, shear, pressure[j], ratio[j]);
}

const struct law law_neoh = {
    .name = "neoh",
    .methods = METHODS_MPM | METHODS_DYNAMIC,
    .doc = "neo-Hookean hyperelasticity; switches UVFp on",
    .parameters = (const struct argument[]){{"density", "mass/length^3", ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"young", "stress", ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"poisson", NULL, ARGUMENT_REAL, LIMIT_POISSON}, {0}},
    .columns = {COLUMN_DEFORMATION, COLUMN_NONE},
    .stabilisation = 1,
    .viscous_work = 1,
    .prepare = prepare,
    .update = update,
};
