/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equations of state (spec 3.2, 8.3): one const row each in eos.c. */
#ifndef MATERIAL_EOS_H
#define MATERIAL_EOS_H

#include "base/argument.h"
#include "material/law.h"

struct eos {
    int type; /* number in the deck */
    const char *name;
    const char *doc;
    const struct argument *arguments;
    int energy_argument;    /* index of E0, or -1 */
    bool computes_viscosity; /* artificial viscosity where the old mean stress is negative */
    bool reduces_work;      /* the work kept for the failure correction is without the pressure's part */
    /* Fills material.eos_constant from the deck's numbers. */
    void (*prepare)(struct material *material, const double *values);
    /* Pressure p = a + b e with e the internal energy per initial volume: a and b of all points of a
     * batch, into its terms. */
    void (*pressure)(const struct law_batch *batch);
};

/* Row of a type, or NULL. Rows are ended by one of type 0. */
const struct eos *eos_find(long type);
const struct eos *eos_rows(void);

/* What the pressure update of one point leaves for the failure correction. */
struct eos_update {
    double mean_before, work, half_volume;
};

/* Artificial viscosity pressure (spec 6.5). */
THREADS_INLINE double eos_viscous_pressure(const struct law_batch *batch, int j)
{
    double rate = batch->trace[j] < 0 ? batch->trace[j] / batch->time_step : 0;
    double density = batch->mass[j] / batch->volume[j], size = batch->cell_size;
    return density * size * rate
         * (batch->bulk_quadratic * size * rate - batch->bulk_linear * batch->material->viscous_speed);
}

/* Spec 6.7: energy, pressure and artificial viscosity of point j, whose terms are there. `deviator_work`
 * is the sum of strain increments times old and new deviator, 0 for failed points; `factor` scales the
 * pressure (burn fraction). Sets energy, mean stress and viscous pressure. */
THREADS_INLINE struct eos_update eos_advance(const struct law_batch *batch, int j, double deviator_work, bool is_failed,
                                             double factor)
{
    const struct material *material = batch->material;
    struct eos_update update = {.mean_before = batch->mean_stress[j],
                                .half_volume = 0.5 * (batch->volume[j] - batch->volume_before[j])};
    double initial_volume = batch->mass[j] / material->density, resistance = eos_viscous_pressure(batch, j);
    double viscous = material->eos->computes_viscosity && update.mean_before < 0 ? resistance : 0;
    update.work = 0.25 * (batch->volume_before[j] + batch->volume[j]) * deviator_work
                + update.half_volume * (update.mean_before - 2 * viscous);
    double a = batch->terms[0][j] * factor, b = batch->terms[1][j] * factor, energy = batch->energy[j] + update.work;
    double pressure = (a + b * energy / initial_volume) / (1 + b * update.half_volume / initial_volume);
    pressure = is_failed && pressure < 0 ? 0 : pressure;
    batch->energy[j] = energy - update.half_volume * pressure;
    update.work -= material->eos->reduces_work ? update.half_volume * pressure : 0;
    batch->mean_stress[j] = -pressure;
    batch->viscous_pressure[j] = viscous;
    return update;
}

#endif
