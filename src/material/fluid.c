/* SPDX-License-Identifier: GPL-3.0-or-later */
/* null: viscous fluid with equation of state (spec 8.2). Its "deviator" keeps the volumetric part
 * of the strain rate, as in the reference; pressure and mean stress are therefore not the same. */
#include "material/eos.h"

#include <math.h>

enum { DENSITY, BULK, VISCOSITY };

static const char *prepare(struct material *material)
{
    material->density = material->parameter[DENSITY];
    material->wave_speed = material->viscous_speed = sqrt(material->parameter[BULK] / material->density);
    material->viscosity = material->parameter[VISCOSITY];
    return NULL;
}

THREADS_VECTORISED
static void update(const struct law_batch *batch)
{
    const double rate = batch->material->viscosity / batch->time_step;
#pragma omp simd
    for (int j = 0; j < batch->count; j++) {
        double deviator[6], work = batch->work[j];
        for (int a = 0; a < 3; a++) {
            deviator[a] = 2 * rate * batch->strain[a][j];
            deviator[a + 3] = rate * batch->strain[a + 3][j];
        }
        for (int a = 0; a < 6; a++)
            work += deviator[a] * batch->strain[a][j];
        eos_advance(batch, j, work, false, 1);
        for (int a = 0; a < 3; a++) {
            batch->stress[a][j] = deviator[a] + batch->mean_stress[j];
            batch->stress[a + 3][j] = deviator[a + 3];
        }
    }
}

const struct law law_null = {
    .name = "null",
    .methods = METHODS_MPM,
    .doc = "viscous fluid; needs an equation of state (4)",
    .parameters = (const struct argument[]){{"density", "mass/length^3", ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"bulk", "stress", ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"viscosity", "stress time", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE}, {0}},
    .columns = {COLUMN_MEAN_STRESS, COLUMN_EQUIVALENT_STRESS, COLUMN_NONE},
    .needs_eos = true,
    .keeps_equivalent = true, /* the reference never computes it: 0 */
    .prepare = prepare,
    .update = update,
};
