/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stress update of a portion of particles: volume, rotation, law, energy (spec 6.2 to 6.7). */
#include "base/tensor.h"
#include "base/threads.h"
#include "material/eos.h"
#include "mpm/chunk.h"

#include <string.h>

#include <math.h>

/* The columns that an update may change, each with its pointers in the batch. A scene has those of
 * its laws; the workspace keeps copies in this order, behind the positions. */
static const struct {
    enum column column;
    size_t pointer;
} changed[] = {
    {COLUMN_STRESS, offsetof(struct law_batch, stress)},
    {COLUMN_VOLUME, offsetof(struct law_batch, volume)},
    {COLUMN_ENERGY, offsetof(struct law_batch, energy)},
    {COLUMN_VISCOUS_PRESSURE, offsetof(struct law_batch, viscous_pressure)},
    {COLUMN_PLASTIC_STRAIN, offsetof(struct law_batch, plastic_strain)},
    {COLUMN_YIELD_STRESS, offsetof(struct law_batch, yield_stress)},
    {COLUMN_MEAN_STRESS, offsetof(struct law_batch, mean_stress)},
    {COLUMN_EQUIVALENT_STRESS, offsetof(struct law_batch, equivalent_stress)},
    {COLUMN_TEMPERATURE, offsetof(struct law_batch, temperature)},
    {COLUMN_DAMAGE, offsetof(struct law_batch, damage)},
    {COLUMN_FAILED, offsetof(struct law_batch, failed)},
    {COLUMN_LIGHTING_TIME, offsetof(struct law_batch, lighting_time)},
    {COLUMN_DEFORMATION, offsetof(struct law_batch, deformation)},
    {COLUMN_FIRST_STRESS, offsetof(struct law_batch, first_stress)},
};

enum { CHANGED = sizeof changed / sizeof changed[0], COPY_MASS = 3, COPY_CHANGED };

/* The pointers of entry i in a batch. */
static inline double **pointers_of(struct law_batch *batch, int i)
{
    return (double **)(void *)((char *)batch + changed[i].pointer);
}

/* The batch of the whole portion. */
static struct law_batch open_batch(const struct mpm *mpm, const struct chunk *chunk)
{
    struct store *store = mpm->store;
    struct workspace *w = chunk->workspace;
    struct law_batch batch = {
        .count = chunk->count,
        .time_step = mpm->time_step,
        .time = mpm->time,
        .cell_size = mpm->cells->frame.size,
        .bulk_quadratic = mpm->scene->bulk[0],
        .bulk_linear = mpm->scene->bulk[1],
        .trace = w->trace,
        .volume_before = w->volume_before,
        .mass = chunk_read(chunk, store->real[COLUMN_MASS][0], w->copy[COPY_MASS]),
        .work = w->work,
        .terms = {w->terms[0], w->terms[1]},
    };
    for (int a = 0; a < 6; a++)
        batch.strain[a] = w->strain[a];
    for (int a = 0; a < 3; a++)
        batch.spin[a] = w->spin[a];
    for (int i = 0, copy = COPY_CHANGED; i < CHANGED; i++)
        for (int a = 0; a < column_row(changed[i].column)->components && store->real[changed[i].column][a]; a++)
            pointers_of(&batch, i)[a] = chunk_read(chunk, store->real[changed[i].column][a], w->copy[copy++]);
    for (int k = 0; k < store->n_history; k++)
        w->history[k] = chunk_read(chunk, store->history[k], w->history_copy + (size_t)k * CHUNK_ROOM);
    batch.history = w->history;
    return batch;
}

static void close_batch(const struct mpm *mpm, const struct chunk *chunk, struct law_batch *batch)
{
    struct store *store = mpm->store;
    for (int i = 0; i < CHANGED && !chunk->is_one_piece; i++)
        for (int a = 0; a < column_row(changed[i].column)->components && store->real[changed[i].column][a]; a++)
            chunk_write(chunk, store->real[changed[i].column][a], pointers_of(batch, i)[a]);
    for (int k = 0; k < store->n_history && !chunk->is_one_piece; k++)
        chunk_write(chunk, store->history[k], batch->history[k]);
}

/* The points from ... to - 1 of a batch, of one material. */
static struct law_batch part_of(const struct law_batch *whole, int32_t from, int32_t to, const struct material *material)
{
    struct law_batch part = *whole;
    part.count = to - from;
    part.material = material;
    for (int a = 0; a < 6; a++)
        part.strain[a] += from;
    for (int a = 0; a < 3; a++)
        part.spin[a] += from;
    part.trace += from;
    part.volume_before += from;
    part.mass += from;
    part.work += from;
    part.terms[0] += from;
    part.terms[1] += from;
    part.history_from += from;
    for (int i = 0; i < CHANGED; i++)
        for (int a = 0; a < column_row(changed[i].column)->components && pointers_of(&part, i)[a]; a++)
            pointers_of(&part, i)[a] += from;
    return part;
}

/* The law leaves stress only: the columns of pressure and von Mises stress that other laws of the
 * scene brought along follow it. */
static void follow_stress(const struct law_batch *batch)
{
    for (int j = 0; j < batch->count; j++) {
        double s[6];
        for (int a = 0; a < 6; a++)
            s[a] = batch->stress[a][j];
        if (batch->mean_stress && !batch->material->law->needs_eos)
            batch->mean_stress[j] = tensor_mean(s);
        if (batch->equivalent_stress && !batch->material->law->keeps_equivalent)
            batch->equivalent_stress[j] = tensor_von_mises(s[0], s[1], s[2], s[3], s[4], s[5]);
    }
}

static void advance(const struct mpm *mpm, const struct law_batch *batch)
{
    const struct law *law = batch->material->law;
    if (law->needs_eos) {
        law_eos_work_before(batch);
        batch->material->eos->pressure(batch);
    }
    if (mpm->rotate && law->rotates) {
        mpm->rotate(batch);
        law_rotate_history(batch, mpm->rotate);
    }
    if (!law->needs_eos)
        law_energy_before(batch);
    law->update(batch);
    if (!law->needs_eos)
        law_energy_after(batch);
    if (batch->mean_stress || batch->equivalent_stress)
        follow_stress(batch);
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

/* Volume and deformation gradient by the velocity gradient times the step, G: F := (1 + G) F,
 * V := V det(1 + G) (spec 6.4). */
THREADS_INLINE void change_point(struct workspace *w, const struct law_batch *batch, int32_t j)
{
    double g[3][3], h[3][3];
    chunk_get_gradient(w, j, g);
    for (int a = 0; a < 9; a++)
        h[a / 3][a % 3] = batch->deformation[a][j];
    for (int a = 0; a < 9; a++) {
        int r = a / 3, c = a % 3;
        batch->deformation[a][j] = h[r][c] + g[r][c] + g[r][0] * h[0][c] + g[r][1] * h[1][c] + g[r][2] * h[2][c];
    }
    for (int a = 0; a < 3; a++)
        g[a][a] += 1;
    w->volume_before[j] = batch->volume[j];
    batch->volume[j] *= tensor_determinant(g);
}

THREADS_VECTORISED
static void change_deformation(struct workspace *w, const struct law_batch *batch)
{
#pragma omp simd
    for (int32_t j = 0; j < batch->count; j++)
        change_point(w, batch, j);
}

/* Total Lagrangian neo-Hookean update (spec 9.2): the gradient is that of the initial shape, so
 * F := F + G; first Piola-Kirchhoff stress, and from it Cauchy stress, volume and energy. */
static void update_total(const struct mpm *mpm, const struct chunk *chunk, const struct law_batch *batch)
{
    static const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
    for (int32_t j = 0; j < chunk->count; j++) {
        const struct material *material = mpm->material_of_body[mpm->store->integer[COLUMN_BODY][chunk->order[j]]];
        const double shear = material->shear_modulus, lame = material->bulk_modulus - 2 * shear / 3;
        double g[3][3], f[3][3], inverse[3][3], work = 0, before = batch->volume[j];
        chunk_get_gradient(chunk->workspace, j, g);
        for (int a = 0; a < 9; a++)
            f[a / 3][a % 3] = (batch->deformation[a][j] += g[a / 3][a % 3]) + (a % 4 == 0);
        double ratio = tensor_determinant(f), pressure = lame * log(ratio) - shear;
        tensor_inverse(f, ratio, inverse);
        batch->volume[j] = ratio * batch->mass[j] / material->density;
        for (int a = 0; a < 9; a++) {
            double stress = shear * f[a / 3][a % 3] + pressure * inverse[a % 3][a / 3];
            work += 0.5 * (batch->first_stress[a][j] + stress) * g[a / 3][a % 3];
            batch->first_stress[a][j] = stress;
        }
        for (int a = 0; a < 6; a++) {
            double sum = 0;
            for (int k = 0; k < 3; k++)
                sum += batch->first_stress[3 * row[a] + k][j] * f[column[a]][k];
            batch->stress[a][j] = sum / ratio;
        }
        batch->energy[j] += work * 0.5 * (before + batch->volume[j]); /* present volumes, as the reference (Q) */
    }
}

/* Work of the residual stress, which internal forces leave out. */
THREADS_VECTORISED
static double residual_work(const struct mpm *mpm, const struct chunk *chunk, const struct law_batch *batch)
{
    struct workspace *w = chunk->workspace;
    double total = 0;
    for (int a = 0; a < 6; a++) {
        const double *restrict residual = chunk_read(chunk, mpm->store->real[COLUMN_RESIDUAL][a], w->copy[0]);
        const double *restrict strain = batch->strain[a];
        for (int32_t j = 0; j < chunk->count; j++)
            w->work[j] = (a == 0 ? 0 : w->work[j]) + residual[j] * strain[j];
    }
    for (int32_t j = 0; j < chunk->count; j++)
        total += 0.5 * (batch->volume[j] + w->volume_before[j]) * w->work[j];
    return total;
}

void stress_update(struct mpm *mpm, const struct chunk *chunk)
{
    struct sums *sums = &mpm->block_sums[chunk->block_index];
    struct law_batch batch = open_batch(mpm, chunk);
    if (mpm->is_total) {
        update_total(mpm, chunk, &batch);
    } else {
        if (batch.deformation[0])
            change_deformation(chunk->workspace, &batch);
        else if (mpm->scene->is_small)
            memcpy(chunk->workspace->volume_before, batch.volume, (size_t)chunk->count * sizeof *batch.volume);
        else
            change_volume(chunk->workspace, batch.volume, chunk->count);
        advance_runs(mpm, chunk, &batch);
    }
    double energy = 0, least = sums->least_volume;
    for (int32_t j = 0; j < chunk->count; j++) {
        energy += batch.energy[j];
        least = batch.volume[j] < least ? batch.volume[j] : least;
    }
    sums->internal += energy;
    sums->least_volume = least;
    if (mpm->store->real[COLUMN_RESIDUAL][0])
        sums->work += residual_work(mpm, chunk, &batch);
    close_batch(mpm, chunk, &batch);
}
