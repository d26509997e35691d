/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "particles/columns.h"
#include "base/checkpoint.h"
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
    [COLUMN_DENSITY] = {"density", 1, false, 0, "mass/length^3", "density"},
    [COLUMN_REFERENCE_DENSITY] = {"reference_density", 1, false, 0, "mass/length^3", "density without pressure at the present temperature"},
    [COLUMN_PRESSURE] = {"pressure", 1, false, 0, "stress", "pressure"},
    [COLUMN_EXCESS_OFFSET] = {"excess_offset", 1, false, 0, "mass/length^3", "part of the density above the reference that gives no pressure"},
    [COLUMN_OPENED] = {"opened", 1, false, 0, "mass/length^3", "part of the reference density that went by expansion into the open"},
    [COLUMN_EXCESS_GRADIENT] = {"excess_gradient", 3, false, 0, "mass/length^4", "gradient of the density above the reference"},
    [COLUMN_SMOOTHING_LENGTH] = {"smoothing_length", 1, false, 0, "length", "h of the kernel"},
    [COLUMN_VISCOSITY] = {"viscosity", 1, false, 0, "stress*time", "dynamic viscosity"},
    [COLUMN_SHEPARD] = {"shepard", 1, false, 0, NULL, "sum of volumes times the kernel"},
    [COLUMN_NORMAL] = {"normal", 3, false, 0, "1/length", "twice the gradient of the filled space, with the kernel of the forces"},
    [COLUMN_WIDE_NORMAL] = {"wide_normal", 3, false, 0, "1/length", "the same with the wide kernel"},
    [COLUMN_WIDE_SHEPARD] = {"wide_shepard", 1, false, 0, NULL, "sum of volumes times the wide kernel"},
    [COLUMN_CURVATURE] = {"curvature", 1, false, 0, "1/length", "curvature of the surface, positive on a drop"},
    [COLUMN_ACCELERATION] = {"acceleration", 3, false, 0, "length/time^2", "acceleration"},
    [COLUMN_LISTED_POSITION] = {"listed_position", 3, false, 0, "length", "position when neighbours were listed last"},
    [COLUMN_ENTHALPY] = {"enthalpy", 1, false, 0, "energy/mass", "specific enthalpy, 0 at 293"},
    [COLUMN_LIQUID] = {"liquid", 1, false, 1, NULL, "liquid fraction"},
    [COLUMN_CONDUCTIVITY] = {"conductivity", 1, false, 0, "power/(length*temperature)", "heat conductivity"},
    [COLUMN_HEAT_RATE] = {"heat_rate", 1, false, 0, "power", "heat that flows in"},
    [COLUMN_LASER_POWER] = {"laser_power", 1, false, 0, "power", "power taken from the beam"},
    [COLUMN_COEFFICIENT] = {"coefficient", 1, false, 0, NULL, "coefficient of a node's shape function"},
    [COLUMN_FIELD] = {"field", 1, false, 0, NULL, "solution at a node"},
    [COLUMN_EXACT] = {"exact", 1, false, 0, NULL, "exact solution at a node"},
    [COLUMN_ID] = {"id", 1, true, 0, NULL, "number of the particle"},
    [COLUMN_BODY] = {"body", 1, true, 0, NULL, "body of the particle"},
    [COLUMN_LAYER] = {"layer", 1, true, 0, NULL, "layer of the build, from 0"},
    [COLUMN_STATE] = {"state", 1, true, 0, NULL, "0 fluid, 1 solid, 2 wall, 3 removed"},
    [COLUMN_FUSED] = {"fused", 1, true, 0, NULL, "1 where it has been melt, at least half liquid, since the start"},
    [COLUMN_PARTED] = {"parted", 1, true, 0, NULL, "1 where it came off the metal, 2 in a thread of single particles"},
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

void store_open_history(struct store *store, int components)
{
    store->history = memory_array((size_t)components, sizeof *store->history, "history");
    for (store->n_history = 0; store->n_history < components; store->n_history++)
        store->history[store->n_history] = memory_array(store->count, sizeof(double), "history");
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
    for (int k = 0; k < store->n_history; k++)
        memory_free(store->history[k]);
    memory_free(store->history);
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
    for (int k = 0; k < store->n_history; k++)
        reorder_real(store, &store->history[k], order, count);
    const int32_t *id = store->integer[COLUMN_ID];
#pragma omp parallel for schedule(static) if (count >= SHARED_PARTICLES)
    for (size_t k = 0; k < count; k++)
        store->index_of_id[id[k]] = (int32_t)k;
}

size_t store_bytes_per_particle(const struct store *store)
{
    size_t bytes = sizeof *store->index_of_id + sizeof *store->scratch + (size_t)store->n_history * sizeof(double);
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
    if (store_has(store, COLUMN_PRESSURE))
        return store->real[COLUMN_PRESSURE][0][p];
    if (store_has(store, COLUMN_MEAN_STRESS))
        return -store->real[COLUMN_MEAN_STRESS][0][p];
    return -(store->real[COLUMN_STRESS][0][p] + store->real[COLUMN_STRESS][1][p] + store->real[COLUMN_STRESS][2][p]) / 3;
}

/* Ids give the places; false when one is there twice, or a body that does not exist. */
static bool index_particles(struct store *store, size_t bodies)
{
    for (size_t p = 0; p < store->count; p++)
        store->index_of_id[p] = -1;
    for (size_t p = 0; p < store->count; p++) {
        const int32_t id = store->integer[COLUMN_ID][p], body = store->integer[COLUMN_BODY][p];
        if (id < 0 || (size_t)id >= store->count || store->index_of_id[id] >= 0)
            return false;
        if (body < 0 || (size_t)body >= bodies)
            return false;
        store->index_of_id[id] = (int32_t)p;
    }
    return true;
}

void store_exchange(struct store *store, struct checkpoint *checkpoint, size_t bodies)
{
    for (int c = COLUMN_NONE + 1; c < COLUMN_COUNT; c++) {
        const struct column_row *row = column_row((enum column)c);
        if (store->integer[c])
            checkpoint_item(checkpoint, row->name, store->integer[c], sizeof(int32_t), store->count);
        for (int a = 0; a < row->components && store->real[c][a]; a++)
            checkpoint_item(checkpoint, row->name, store->real[c][a], sizeof(double), store->count);
    }
    for (int k = 0; k < store->n_history; k++)
        checkpoint_item(checkpoint, "history", store->history[k], sizeof(double), store->count);
    if (checkpoint_is_reading(checkpoint) && checkpoint_is_good(checkpoint) && !index_particles(store, bodies))
        checkpoint_reject(checkpoint, "ids and bodies");
}
