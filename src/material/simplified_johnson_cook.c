/* SPDX-License-Identifier: GPL-3.0-or-later */
/* sjc, sjcf, jcf: Johnson-Cook plasticity with an equation of state; sjcf and jcf fail, jcf with
 * temperature and damage (spec 8.2). */
#include "material/eos.h"
#include "material/johnson_cook.h"

enum { A = LAW_POISSON + 1, B, N, C };
enum { SJC_RATE = C + 1, SJCF_FAILURE };
enum { M = C + 1, ROOM, MELT, HEAT, JCF_RATE, JCF_FAILURE };

/* What the three laws differ in. */
struct kind {
    bool fails, has_temperature;
};

static const char *prepare(struct material *material)
{
    law_prepare_elastic(material, false);
    material->yield_stress = material->parameter[A];
    return NULL;
}

static const char *prepare_thermal(struct material *material)
{
    prepare(material);
    return material->parameter[MELT] > material->parameter[ROOM] ? NULL : "Tmelt has to be above Troom";
}

/* Trial deviator of a point. */
static void trial_deviator(const struct law_batch *batch, int j, double shear, double deviator[6])
{
    double third = batch->trace[j] / 3, mean = batch->mean_stress[j];
    for (int a = 0; a < 3; a++) {
        deviator[a] = batch->stress[a][j] - mean + 2 * shear * (batch->strain[a][j] - third);
        deviator[a + 3] = batch->stress[a + 3][j] + shear * batch->strain[a + 3][j];
    }
}

static double deviator_work(const struct law_batch *batch, int j, const double deviator[6])
{
    double work = batch->work[j];
    for (int a = 0; a < 6; a++)
        work += deviator[a] * batch->strain[a][j];
    return work;
}

static void store_stress(const struct law_batch *batch, int j, const double deviator[6])
{
    for (int a = 0; a < 3; a++) {
        batch->stress[a][j] = deviator[a] + batch->mean_stress[j];
        batch->stress[a + 3][j] = deviator[a + 3];
    }
}

/* A point that failed before: no deviator, no tension. */
static void update_failed(const struct law_batch *batch, int j)
{
    static const double nothing[6] = {0};
    eos_advance(batch, j, 0, true, 1);
    store_stress(batch, j, nothing);
}

/* The point fails in this step: it keeps no deviator and no pressure (spec 8.2: compression, Q). */
static void fail(const struct law_batch *batch, int j, const struct eos_update *update, double deviator[6])
{
    batch->failed[j] = 1;
    if (batch->mean_stress[j] < 0) {
        batch->mean_stress[j] = 0;
        batch->viscous_pressure[j] = 0;
        batch->volume[j] = batch->volume_before[j];
    }
    for (int a = 0; a < 6; a++)
        deviator[a] = 0;
    batch->energy[j] += update->half_volume * (update->mean_before + batch->mean_stress[j] - 2 * batch->viscous_pressure[j])
                      - update->work;
}

/* Damage growth of jcf; returns whether the point fails. */
static bool grow_damage(const struct law_batch *batch, int j, double increment, double failure_strain, double deviator[6])
{
    if (batch->plastic_strain[j] > failure_strain) {
        batch->plastic_strain[j] = failure_strain + 1e-7;
        batch->damage[j] = 1;
        return true;
    }
    double old = batch->damage[j], damage = fmin(1, old + increment / failure_strain);
    for (int a = 0; a < 6; a++)
        deviator[a] *= (1 - damage) / (1 - old);
    batch->damage[j] = damage;
    return fabs(damage - 1) < 1e-5;
}

THREADS_INLINE void update_point(const struct law_batch *batch, int j, const struct johnson_cook *constants, struct kind kind,
                                 double failure_strain, double heat)
{
    double deviator[6], shear = batch->material->shear_modulus, thermal = 1;
    bool is_molten = false;
    if (kind.has_temperature) {
        shear *= 1 - batch->damage[j] + 2.2e-16;
        double homologous = johnson_cook_homologous(constants, batch, j);
        is_molten = homologous > 1;
        thermal = homologous > 0 ? 1 - pow(fmin(homologous, 1), constants->m) : 1;
    }
    trial_deviator(batch, j, shear, deviator);
    double equivalent = plastic_von_mises(deviator);
    is_molten = is_molten && equivalent > batch->yield_stress[j];
    struct johnson_cook_return result = johnson_cook_update(constants, batch, j, equivalent, shear, thermal);
    for (int a = 0; a < 6; a++)
        deviator[a] *= result.scale;
    if (batch->equivalent_stress)
        batch->equivalent_stress[j] = result.equivalent;
    struct eos_update update = eos_advance(batch, j, is_molten ? 0 : deviator_work(batch, j, deviator), is_molten, 1);
    bool fails = is_molten;
    if (kind.has_temperature) {
        fails = grow_damage(batch, j, result.increment, failure_strain, deviator) || fails;
    } else if (kind.fails && batch->plastic_strain[j] > failure_strain) {
        batch->plastic_strain[j] = failure_strain + 1e-7;
        fails = true;
    }
    if (fails)
        fail(batch, j, &update, deviator);
    store_stress(batch, j, deviator);
    if (kind.has_temperature)
        batch->temperature[j] += result.equivalent * result.increment / (batch->mass[j] / batch->volume[j] * heat);
}

static void update_sjc(const struct law_batch *batch)
{
    const double *k = batch->material->parameter;
    const struct johnson_cook constants = {.a = k[A], .b = k[B], .n = k[N], .c = k[C], .reference_rate = k[SJC_RATE]};
    for (int j = 0; j < batch->count; j++)
        update_point(batch, j, &constants, (struct kind){false, false}, 0, 0);
}

static void update_sjcf(const struct law_batch *batch)
{
    const double *k = batch->material->parameter;
    const struct johnson_cook constants = {.a = k[A], .b = k[B], .n = k[N], .c = k[C], .reference_rate = k[SJC_RATE]};
    for (int j = 0; j < batch->count; j++) {
        if (batch->failed[j] != 0)
            update_failed(batch, j);
        else
            update_point(batch, j, &constants, (struct kind){true, false}, k[SJCF_FAILURE], 0);
    }
}

static void update_jcf(const struct law_batch *batch)
{
    const double *k = batch->material->parameter;
    const struct johnson_cook constants = {k[A], k[B], k[N], k[C], k[JCF_RATE], k[M], k[ROOM], k[MELT], true};
    for (int j = 0; j < batch->count; j++) {
        if (batch->failed[j] != 0)
            update_failed(batch, j);
        else
            update_point(batch, j, &constants, (struct kind){true, true}, k[JCF_FAILURE], k[HEAT]);
    }
}

const struct law law_sjc = {
    .name = "sjc",
    .methods = METHODS_MPM,
    .doc = "Johnson-Cook plasticity without temperature, with equation of state",
    .parameters = (const struct argument[]){JOHNSON_COOK_ELASTIC, JOHNSON_COOK_YIELD, JOHNSON_COOK_RATE, {0}},
    .columns = {COLUMN_PLASTIC_STRAIN, COLUMN_YIELD_STRESS, COLUMN_MEAN_STRESS, COLUMN_NONE},
    .rotates = true,
    .needs_eos = true,
    .prepare = prepare,
    .update = update_sjc,
};

const struct law law_sjcf = {
    .name = "sjcf",
    .methods = METHODS_MPM,
    .doc = "as sjc; fails at the plastic strain epf",
    .parameters = (const struct argument[]){JOHNSON_COOK_ELASTIC, JOHNSON_COOK_YIELD, JOHNSON_COOK_RATE,
                                            JOHNSON_COOK_FAILURE, {0}},
    .columns = {COLUMN_PLASTIC_STRAIN, COLUMN_YIELD_STRESS, COLUMN_MEAN_STRESS, COLUMN_EQUIVALENT_STRESS, COLUMN_FAILED,
                COLUMN_NONE},
    .rotates = true,
    .needs_eos = true,
    .keeps_equivalent = true,
    .prepare = prepare,
    .update = update_sjcf,
};

const struct law law_jcf = {
    .name = "jcf",
    .methods = METHODS_MPM,
    .doc = "Johnson-Cook plasticity with temperature, damage and failure, with equation of state",
    .parameters = (const struct argument[]){JOHNSON_COOK_ELASTIC, JOHNSON_COOK_YIELD, JOHNSON_COOK_THERMAL,
                                            JOHNSON_COOK_RATE, JOHNSON_COOK_FAILURE, {0}},
    .columns = {COLUMN_PLASTIC_STRAIN, COLUMN_YIELD_STRESS, COLUMN_MEAN_STRESS, COLUMN_EQUIVALENT_STRESS, COLUMN_FAILED,
                COLUMN_DAMAGE, COLUMN_TEMPERATURE, COLUMN_NONE},
    .rotates = true,
    .needs_eos = true,
    .keeps_equivalent = true,
    .prepare = prepare_thermal,
    .update = update_jcf,
};
