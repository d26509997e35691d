/* SPDX-License-Identifier: GPL-3.0-or-later */
/* john: Johnson-Cook plasticity with temperature, elastic pressure (spec 8.1). */
#include "material/johnson_cook.h"

enum { A = LAW_POISSON + 1, B, N, C, M, ROOM, MELT, HEAT, RATE };

static const char *prepare(struct material *material)
{
    law_prepare_elastic(material, false);
    material->yield_stress = material->parameter[A];
    return material->parameter[MELT] > material->parameter[ROOM] ? NULL : "Tmelt has to be above Troom";
}

static void update(const struct law_batch *batch)
{
    const double *k = batch->material->parameter;
    const double shear = batch->material->shear_modulus, bulk = batch->material->bulk_modulus;
    const struct johnson_cook constants = {k[A], k[B], k[N], k[C], k[RATE], k[M], k[ROOM], k[MELT], true};
    for (int j = 0; j < batch->count; j++) {
        double trial[6];
        law_elastic_trial(batch, j, shear, bulk, trial);
        double homologous = johnson_cook_homologous(&constants, batch, j);
        double thermal = homologous > 0 ? 1 - pow(homologous, k[M]) : 1;
        struct johnson_cook_return result =
            johnson_cook_update(&constants, batch, j, plastic_von_mises(trial), shear, thermal);
        plastic_store(batch, j, trial, result.scale);
        double density = batch->mass[j] / batch->volume[j];
        batch->temperature[j] += result.equivalent * result.increment / (density * k[HEAT]);
    }
}

const struct law law_john = {
    .name = "john",
    .methods = METHODS_MPM,
    .doc = "Johnson-Cook plasticity with temperature",
    .parameters = (const struct argument[]){JOHNSON_COOK_ELASTIC, JOHNSON_COOK_YIELD, JOHNSON_COOK_THERMAL,
                                            JOHNSON_COOK_RATE, {0}},
    .columns = {COLUMN_PLASTIC_STRAIN, COLUMN_YIELD_STRESS, COLUMN_TEMPERATURE, COLUMN_NONE},
    .rotates = true,
    .viscous_work = 2, /* the reference counts the viscous term twice here (spec 8.1, Q) */
    .prepare = prepare,
    .update = update,
};
