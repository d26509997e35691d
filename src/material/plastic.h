/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Radial return of the von Mises laws, shared by their files. Their loops call a function for one point:
 * arrays that live in a function are kept in registers, those of a simd loop are not. */
#ifndef MATERIAL_PLASTIC_H
#define MATERIAL_PLASTIC_H

#include "base/threads.h"
#include "base/tensor.h"
#include "material/law.h"

/* Writes trial stress with the deviator scaled by `scale` about the mean (1 leaves it). */
THREADS_INLINE void plastic_store(const struct law_batch *batch, int j, const double trial[6], double scale)
{
    double mean = tensor_mean(trial);
    for (int a = 0; a < 3; a++) {
        batch->stress[a][j] = mean + scale * (trial[a] - mean);
        batch->stress[a + 3][j] = scale * trial[a + 3];
    }
}

THREADS_INLINE double plastic_von_mises(const double s[6])
{
    return tensor_von_mises(s[0], s[1], s[2], s[3], s[4], s[5]);
}

#endif
