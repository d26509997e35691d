/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Internal energy and artificial bulk viscosity of the laws without equation of state. */
#include "base/threads.h"
#include "material/law.h"

/* Six-term product of stress and strain increment. */
THREADS_INLINE double stress_work(const struct law_batch *batch, int j)
{
    return batch->stress[0][j] * batch->strain[0][j] + batch->stress[1][j] * batch->strain[1][j]
         + batch->stress[2][j] * batch->strain[2][j] + batch->stress[3][j] * batch->strain[3][j]
         + batch->stress[4][j] * batch->strain[4][j] + batch->stress[5][j] * batch->strain[5][j];
}

THREADS_VECTORISED
void law_energy_before(const struct law_batch *batch)
{
#pragma omp simd
    for (int j = 0; j < batch->count; j++)
        batch->work[j] = stress_work(batch, j);
}

THREADS_INLINE void energy_after(const struct law_batch *batch, bool is_viscous)
{
    const double size = batch->cell_size;
    const double quadratic = batch->bulk_quadratic * size * size / (batch->time_step * batch->time_step);
    const double counted = 2 * batch->material->law->viscous_work;
    const double linear = batch->bulk_linear * size * batch->material->viscous_speed / batch->time_step;
#pragma omp simd
    for (int j = 0; j < batch->count; j++) {
        double work = batch->work[j] + stress_work(batch, j);
        if (is_viscous) {
            double trace = batch->trace[j];
            double compression = trace < 0 ? trace : 0;
            double mean = batch->stress[0][j] + batch->stress[1][j] + batch->stress[2][j];
            double density = batch->mass[j] / batch->volume[j];
            double pressure = density * compression * (quadratic * compression - linear);
            double viscous = mean < 0 ? pressure : 0;
            work -= counted * viscous * trace;
            batch->viscous_pressure[j] = viscous;
        }
        batch->energy[j] += 0.25 * (batch->volume_before[j] + batch->volume[j]) * work;
    }
}

THREADS_VECTORISED
void law_energy_after(const struct law_batch *batch)
{
    if (batch->viscous_pressure)
        energy_after(batch, true);
    else
        energy_after(batch, false);
}

THREADS_VECTORISED
void law_eos_work_before(const struct law_batch *batch)
{
#pragma omp simd
    for (int j = 0; j < batch->count; j++)
        batch->work[j] = stress_work(batch, j) - batch->mean_stress[j] * batch->trace[j];
}
