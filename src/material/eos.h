/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equations of state (spec 3.2, 8.3): one const row each in eos.c. */
#ifndef MATERIAL_EOS_H
#define MATERIAL_EOS_H

#include "base/argument.h"
#include "material/law.h"

/* Pressure p = (a + b e) with e the internal energy per initial volume. */
struct eos_pressure {
    double a, b;
};

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
    struct eos_pressure (*pressure)(const double *constant, double density, double initial_density);
};

/* Row of a type, or NULL. Rows are ended by one of type 0. */
const struct eos *eos_find(long type);
const struct eos *eos_rows(void);

/* What the pressure update of one point leaves for the failure correction. */
struct eos_update {
    double mean_before, work, half_volume;
};

/* Spec 6.7: energy, pressure and artificial viscosity of point j. `deviator_work` is the sum of
 * strain increments times old and new deviator, 0 for failed points; `factor` scales the pressure
 * (burn fraction). Sets energy, mean stress and viscous pressure. */
struct eos_update eos_advance(const struct law_batch *batch, int j, double deviator_work, bool is_failed, double factor);

#endif
