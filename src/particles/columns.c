/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "particles/columns.h"
#include "base/memory.h"

#include <string.h>

/* Fewer particles than this are not worth a second thread. */
enum { SHARED_PARTICLES = 50000 };

static const struct column_row rows[COLUMN_COUNT] = {
    [COLUMN_NONE] = {"none", 0, false, 0, NULL, ""},
    [COLUMN_POSITION] = {"position", 3, false, 0, "length", "present position"},
    [COLUMN_VELOCITY] = {"velocity", 3, false, 0, "length/time", "velocity"},
    [COLUMN_STRESS] = {"stress", 6, false, 0, "stress", "Cauchy stress xx yy zz yz xz xy"},
    [COLUMN_VOLUME] = {"volume", 1, false, 0, "length^3", "present volume"},
    [COLUMN_MASS] = {"mass", 1, false, 0, "mass", "mass"},
    [COLUMN_ENERGY] = {"energy", 1, false, 0, "energy", "internal energy"},
    [COLUMN_VISCOUS_PRESSURE] = {"viscous_pressure", 1, false, 0, "stress", "artificial viscosity pressure"},
    [COLUMN_PLASTIC_STRAIN] = {"plastic_strain", 1, false, 0, NULL, "effective plastic strain"},
    [COLUMN_YIELD_STRESS] = {"yield_stress", 1, false, 0, "stress", "present yield stress"},
    [COLUMN_MEAN_STRESS] = {"mean_stress", 1, false, 0, "stress", "minus the pressure of the equation of state"},
    [COLUMN_EQUIVALENT_STRESS] = {"equivalent_stress", 1, false, 0, "stress", "von Mises stress of the last update"},
    [COLUMN_TEMPERATURE] = {"temperature", 1, false, 293, "temperature", "temperature"},
    [COLUMN_DAMAGE] = {"damage", 1, false, 0, NULL, "damage"},
    [COLUMN_FAILED] = {"failed", 1, false, 0, NULL, "1 where the material failed"},
    [COLUMN_LIGHTING_TIME] = {"lighting_time", 1, false, 1e7, "time", "when the explosive is lit"},
    [COLUMN_DEFORMATION] = {"deformation", 9, false, 0, NULL, "deformation gradient less 1, by rows"},
    [COLUMN_FIRST_STRESS] = {"first_stress", 9, false, 0, "stress", "first Piola-Kirchhoff stress, by rows"},
    [COLUMN_SMOOTHED_PRESSURE] = {"smoothed_pressure", 1, false, 0, "stress", "pressure averaged over nodes"},
    [COLUMN_START_POSITION] = {"start_position", 3, false, 0, "length", "position at the start of the step"},
    [COLUMN_AFFINE] = {"affine", 9, false, 0, "1/time", "velocity gradient that goes along with the velocity, by rows"},
    [COLUMN_LOAD] = {"load", 3, false, 0, "force", "force from the load block"},
    [COLUMN_RESIDUAL] = {"residual", 6, false, 0, "stress", "residual stress xx yy zz yz xz xy, taken off in internal forces"},
    [COLUMN_INITIAL_POSITION] = {"initial_position", 3, false, 0, "length", "position at the start"},
    [COLUMN_ID] = {"id", 1, true, 0, NULL, "number of the particle"},
    [COLUMN_BODY] = {"body", 1, true, 0, NULL, "body of the particle"},
    [COLUMN_LAYER] = {"layer", 1, true, 0, NULL, "layer of the build, from 0"},
};

const struct column_row *column_row(enum column column)
{
    return &rows[column];
}

struct store *store_open(size_t count, uint64_t wanted)
{
    struct store *store = memory_array(1, sizeof *store, "particles");
    store->count = count;
    for (int c = COLUMN_NONE + 1; c < COLUMN_COUNT; c++) {
        if (!(wanted & column_bit((enum column)c)))
            continue;
        if (rows[c].is_integer)
            store->integer[c] = memory_array(count, sizeof(int32_t), rows[c].name);
        else
            for (int a = 0; a < rows[c].components; a++) {
                store->real[c][a] = memory_array(count, sizeof(double), rows[c].name);
                for (size_t p = 0; p < count && rows[c].initial != 0; p++)
                    store->real[c][a][p] = rows[c].initial;
            }
    }
    store->index_of_id = memory_array(count, sizeof(int32_t), "particle index");
    store->scratch = memory_array(count, sizeof(double), "sorting");
    return store;
}

void store_close(struct store *store)
{
    if (!store)
        return;
    for (int c = 0; c < COLUMN_COUNT; c++) {
        memory_free(store->integer[c]);
        for (int a = 0; a < COLUMN_COMPONENTS; a++)
            memory_free(store->real[c][a]);
    }
    memory_free(store->index_of_id);
    memory_free(store->scratch);
    memory_free(store);
}

bool store_has(const struct store *store, enum column column)
{
    return store->integer[column] || store->real[column][0];
}

static void reorder_real(struct store *store, double **values, const int32_t *order, size_t count)
{
    double *target = store->scratch;
    const double *source = *values;
#pragma omp parallel for schedule(static) if (count >= SHARED_PARTICLES)
    for (size_t k = 0; k < count; k++)
        target[k] = source[order[k]];
    memcpy(target + count, source + count, (store->count - count) * sizeof *target);
    store->scratch = *values;
    *values = target;
}

static void reorder_integer(struct store *store, int32_t *values, const int32_t *order, size_t count)
{
    int32_t *target = (int32_t *)(void *)store->scratch;
#pragma omp parallel for schedule(static) if (count >= SHARED_PARTICLES)
    for (size_t k = 0; k < count; k++)
        target[k] = values[order[k]];
    memcpy(values, target, count * sizeof *values);
}

void store_reorder(struct store *store, const int32_t *order, size_t count)
{
    for (int c = COLUMN_NONE + 1; c < COLUMN_COUNT; c++) {
        if (store->integer[c])
            reorder_integer(store, store->integer[c], order, count);
        for (int a = 0; a < COLUMN_COMPONENTS && store->real[c][a]; a++)
            reorder_real(store, &store->real[c][a], order, count);
    }
    const int32_t *id = store->integer[COLUMN_ID];
#pragma omp parallel for schedule(static) if (count >= SHARED_PARTICLES)
    for (size_t k = 0; k < count; k++)
        store->index_of_id[id[k]] = (int32_t)k;
}

size_t store_bytes_per_particle(const struct store *store)
{
    size_t bytes = sizeof *store->index_of_id + sizeof *store->scratch;
    for (int c = COLUMN_NONE + 1; c < COLUMN_COUNT; c++) {
        if (store->integer[c])
            bytes += sizeof(int32_t);
        for (int a = 0; a < COLUMN_COMPONENTS && store->real[c][a]; a++)
            bytes += sizeof(double);
    }
    return bytes;
}

double store_pressure(const struct store *store, size_t p)
{
    if (store_has(store, COLUMN_MEAN_STRESS))
        return -store->real[COLUMN_MEAN_STRESS][0][p];
    return -(store->real[COLUMN_STRESS][0][p] + store->real[COLUMN_STRESS][1][p] + store->real[COLUMN_STRESS][2][p]) / 3;
}
