/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hiex: high explosive, lit at programmed times (spec 8.2, 9.7). */
#include "material/eos.h"

enum { DENSITY, DETONATION_SPEED };

static const char *prepare(struct material *material)
{
    material->density = material->parameter[DENSITY];
    material->wave_speed = material->detonation_speed = material->parameter[DETONATION_SPEED];
    return NULL;
}

THREADS_VECTORISED
static void update(const struct law_batch *batch)
{
#pragma omp simd
    for (int j = 0; j < batch->count; j++) {
        double burnt = batch->time > batch->lighting_time[j] ? 1 : 0;
        eos_advance(batch, j, 0, false, burnt);
        batch->viscous_pressure[j] = 0;
        for (int a = 0; a < 3; a++) {
            batch->stress[a][j] = batch->mean_stress[j];
            batch->stress[a + 3][j] = 0;
        }
    }
}

const struct law law_hiex = {
    .name = "hiex",
    .methods = METHODS_MPM,
    .doc = "high explosive; needs an equation of state (3) and detonation points",
    .parameters = (const struct argument[]){{"density", "mass/length^3", ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"D", "length/time", ARGUMENT_REAL, LIMIT_POSITIVE}, {0}},
    .columns = {COLUMN_MEAN_STRESS, COLUMN_LIGHTING_TIME, COLUMN_NONE},
    .needs_eos = true,
    .prepare = prepare,
    .update = update,
};
