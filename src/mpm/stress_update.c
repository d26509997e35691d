/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stress update of a portion of particles: volume, rotation, law, energy (spec 6.2 to 6.6). */
#include "base/threads.h"
#include "mpm/chunk.h"

/* Columns that the update reads and writes back, and where their copies go in the workspace. */
enum { COPY_STRESS = 3, COPY_VOLUME = 9, COPY_ENERGY, COPY_VISCOUS, COPY_PLASTIC, COPY_YIELD, COPY_MASS };

/* The batch of the whole portion. */
static struct law_batch open_batch(const struct mpm *mpm, const struct chunk *chunk, double *volume)
{
    struct store *store = mpm->store;
    struct workspace *w = chunk->workspace;
    struct law_batch batch = {
        .count = chunk->count,
        .time_step = mpm->time_step,
        .cell_size = mpm->cells->frame.size,
        .bulk_quadratic = mpm->scene->bulk[0],
        .bulk_linear = mpm->scene->bulk[1],
        .trace = w->trace,
        .volume_before = w->volume_before,
        .volume = volume,
        .mass = chunk_read(chunk, store->real[COLUMN_MASS][0], w->copy[COPY_MASS]),
        .work = w->work,
        .energy = chunk_read(chunk, store->real[COLUMN_ENERGY][0], w->copy[COPY_ENERGY]),
        .viscous_pressure = chunk_read(chunk, store->real[COLUMN_VISCOUS_PRESSURE][0], w->copy[COPY_VISCOUS]),
    };
    for (int a = 0; a < 6; a++) {
        batch.strain[a] = w->strain[a];
        batch.stress[a] = chunk_read(chunk, store->real[COLUMN_STRESS][a], w->copy[COPY_STRESS + a]);
    }
    for (int a = 0; a < 3; a++)
        batch.spin[a] = w->spin[a];
    if (store_has(store, COLUMN_PLASTIC_STRAIN))
        batch.plastic_strain = chunk_read(chunk, store->real[COLUMN_PLASTIC_STRAIN][0], w->copy[COPY_PLASTIC]);
    if (store_has(store, COLUMN_YIELD_STRESS))
        batch.yield_stress = chunk_read(chunk, store->real[COLUMN_YIELD_STRESS][0], w->copy[COPY_YIELD]);
    return batch;
}

static void close_batch(const struct mpm *mpm, const struct chunk *chunk, const struct law_batch *batch)
{
    struct store *store = mpm->store;
    if (chunk->is_one_piece)
        return;
    for (int a = 0; a < 6; a++)
        chunk_write(chunk, store->real[COLUMN_STRESS][a], batch->stress[a]);
    chunk_write(chunk, store->real[COLUMN_VOLUME][0], batch->volume);
    chunk_write(chunk, store->real[COLUMN_ENERGY][0], batch->energy);
    chunk_write(chunk, store->real[COLUMN_VISCOUS_PRESSURE][0], batch->viscous_pressure);
    if (batch->plastic_strain)
        chunk_write(chunk, store->real[COLUMN_PLASTIC_STRAIN][0], batch->plastic_strain);
    if (batch->yield_stress)
        chunk_write(chunk, store->real[COLUMN_YIELD_STRESS][0], batch->yield_stress);
}

static void advance(const struct mpm *mpm, const struct law_batch *batch)
{
    const struct law *law = batch->material->law;
    if (mpm->rotate && law->rotates)
        mpm->rotate(batch);
    law_energy_before(batch);
    law->update(batch);
    law_energy_after(batch);
}

static inline double *offset(double *array, int32_t from)
{
    return array ? array + from : NULL;
}

/* The points from ... to - 1 of a batch, of one material. */
static struct law_batch part_of(const struct law_batch *whole, int32_t from, int32_t to, const struct material *material)
{
    struct law_batch part = *whole;
    part.count = to - from;
    part.material = material;
    for (int a = 0; a < 6; a++) {
        part.strain[a] += from;
        part.stress[a] += from;
    }
    for (int a = 0; a < 3; a++)
        part.spin[a] += from;
    part.trace += from;
    part.volume_before += from;
    part.volume += from;
    part.mass += from;
    part.work += from;
    part.energy += from;
    part.viscous_pressure += from;
    part.plastic_strain = offset(whole->plastic_strain, from);
    part.yield_stress = offset(whole->yield_stress, from);
    return part;
}

/* Advances runs of particles of one material. */
static void advance_runs(const struct mpm *mpm, const struct chunk *chunk, struct law_batch *batch)
{
    const int32_t *body = mpm->store->integer[COLUMN_BODY];
    for (int32_t from = 0, to; from < chunk->count; from = to) {
        const struct material *material = mpm->material_of_body[body[chunk->order[from]]];
        for (to = from + 1; to < chunk->count; to++)
            if (!mpm->has_one_law && mpm->material_of_body[body[chunk->order[to]]] != material)
                break;
        if (mpm->has_one_law)
            to = chunk->count;
        struct law_batch part = part_of(batch, from, to, material);
        advance(mpm, &part);
    }
}

THREADS_VECTORISED
static void change_volume(struct workspace *w, double *restrict volume, int32_t count)
{
    for (int32_t j = 0; j < count; j++) {
        w->volume_before[j] = volume[j];
        volume[j] *= 1 + w->trace[j];
    }
}

void stress_update(struct mpm *mpm, const struct chunk *chunk)
{
    struct workspace *w = chunk->workspace;
    struct sums *sums = &mpm->block_sums[chunk->block_index];
    double *volume = chunk_read(chunk, mpm->store->real[COLUMN_VOLUME][0], w->copy[COPY_VOLUME]);
    change_volume(w, volume, chunk->count);
    struct law_batch batch = open_batch(mpm, chunk, volume);
    advance_runs(mpm, chunk, &batch);
    double energy = 0, least = sums->least_volume;
    for (int32_t j = 0; j < chunk->count; j++) {
        energy += batch.energy[j];
        least = volume[j] < least ? volume[j] : least;
    }
    sums->internal += energy;
    sums->least_volume = least;
    close_batch(mpm, chunk, &batch);
}
