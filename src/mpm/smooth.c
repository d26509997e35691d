/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shape functions that reach over three nodes along each axis: generalised interpolation (spec 7.2)
 * and quadratic B-splines (spec 7.3). One particle after the other, over rows of nodes along x; a
 * row has a fourth node of weight 0. */
#include "base/threads.h"
#include "mpm/chunk.h"
#include "mpm/hat.h"

#include <string.h>

enum { EDGE = 7, ROW = 8, SUPPORT = 3, PATCH_NODES = LARGEST_PATCH };

/* --- weights --- */

/* Weights and slopes of a chunk along one axis; returns in `low` whether the lowest node is one
 * below the cell. `local` is the position in the cell. */
typedef void axis_weights(const struct mpm *mpm, const struct chunk *chunk, int a, const double *local, int32_t *low);

/* `half_width` of each particle, or NULL for the fixed one. */
THREADS_INLINE void hat_weights(const struct chunk *chunk, int a, const double *local, const double *half_width, int32_t *low)
{
    struct workspace *w = chunk->workspace;
    for (int32_t j = 0; j < chunk->count; j++)
        low[j] = local[j] < 0.5;
    for (int n = 0; n < SUPPORT; n++) {
        double *restrict weight = w->weight[a][n], *restrict slope = w->slope[a][n];
        for (int32_t j = 0; j < chunk->count; j++)
            hat_averaged(local[j] + (local[j] < 0.5 ? 1 - n : -n), half_width ? half_width[j] : HAT_FIXED_HALF_WIDTH, &weight[j],
                         &slope[j]);
    }
}

THREADS_VECTORISED
static void fixed_hat_weights(const struct mpm *mpm, const struct chunk *chunk, int a, const double *local, int32_t *low)
{
    (void)mpm;
    hat_weights(chunk, a, local, NULL, low);
}

THREADS_VECTORISED
static void own_hat_weights(const struct mpm *mpm, const struct chunk *chunk, int a, const double *local, int32_t *low)
{
    double half_width[CHUNK_PARTICLES];
    for (int32_t j = 0; j < chunk->count; j++)
        half_width[j] = mpm->bodies[mpm->store->integer[COLUMN_BODY][chunk->order[j]]].half_width;
    hat_weights(chunk, a, local, half_width, low);
}

THREADS_VECTORISED
static void spline_weights(const struct mpm *mpm, const struct chunk *chunk, int a, const double *local, int32_t *low)
{
    struct workspace *w = chunk->workspace;
    (void)mpm;
    for (int32_t j = 0; j < chunk->count; j++) {
        double x = local[j];
        low[j] = 1;
        w->weight[a][0][j] = 0.5 * (1 - x) * (1 - x);
        w->weight[a][1][j] = -x * x + x + 0.5;
        w->weight[a][2][j] = 0.5 * x * x;
        w->slope[a][0][j] = x - 1;
        w->slope[a][1][j] = 1 - 2 * x;
        w->slope[a][2][j] = x;
    }
}

/* Finds base node, weights and slopes (per cell size) of the chunk's particles. */
THREADS_INLINE void find_weights(const struct mpm *mpm, const struct chunk *chunk, double *const position[3],
                                 axis_weights *weights)
{
    static const int stride[3] = {1, ROW, ROW * EDGE};
    const double inverse = 1 / mpm->cells->frame.size;
    struct workspace *w = chunk->workspace;
    int32_t low[CHUNK_PARTICLES];
    for (struct cell_walk walk = {0}; walk_next(chunk, &walk);)
        for (int32_t j = walk.from; j < walk.to; j++)
            w->base[j] = grid_patch_corner(walk.cell, ROW, EDGE, 1);
    for (int a = 0; a < 3; a++) {
        for (struct cell_walk walk = {0}; walk_next(chunk, &walk);) {
            double cell_low = chunk_cell_low(mpm, chunk, walk.cell, a);
            for (int32_t j = walk.from; j < walk.to; j++)
                w->local[a][j] = (position[a][j] - cell_low) * inverse;
        }
        weights(mpm, chunk, a, w->local[a], low);
        for (int32_t j = 0; j < chunk->count; j++)
            w->base[j] -= low[j] * stride[a];
    }
}

/* The weights of particle j along x as a row of nodes. */
#define ROW_OF(value, j) ((lanes){(value)[0][j], (value)[1][j], (value)[2][j], 0})

/* --- particles to grid --- */

/* Adds value * weight of particle j to one field of a patch, and to those that follow. */
THREADS_INLINE void scatter_values(struct workspace *w, int32_t j, double *patch, const double *values, int fields)
{
    lanes along = ROW_OF(w->weight[0], j);
    for (int k = 0; k < SUPPORT; k++)
        for (int i = 0; i < SUPPORT; i++) {
            double across = w->weight[1][i][j] * w->weight[2][k][j];
            double *row = patch + w->base[j] + ROW * (i + EDGE * k);
            for (int f = 0; f < fields; f++)
                *(lanes *)(row + f * PATCH_NODES) += along * (across * values[f]);
        }
}

/* Adds the force of particle j: minus volume times stress times gradient, plus `external` (or NULL)
 * times weight. `stress` is volume times stress over cell size. */
THREADS_INLINE void scatter_stress(struct workspace *w, int32_t j, double *patch, double stress[3][3], const double *external)
{
    lanes along = ROW_OF(w->weight[0], j), slope = ROW_OF(w->slope[0], j);
    for (int k = 0; k < SUPPORT; k++)
        for (int i = 0; i < SUPPORT; i++) {
            double across = w->weight[1][i][j] * w->weight[2][k][j];
            double across_y = w->slope[1][i][j] * w->weight[2][k][j];
            double across_z = w->weight[1][i][j] * w->slope[2][k][j];
            double *row = patch + w->base[j] + ROW * (i + EDGE * k);
            for (int a = 0; a < 3; a++) {
                double flat = stress[a][1] * across_y + stress[a][2] * across_z;
                if (external)
                    flat += external[a] * across;
                *(lanes *)(row + a * PATCH_NODES) += slope * (stress[a][0] * across) + along * flat;
            }
        }
}

/* Adds mass times gradient of particle j to three fields. */
THREADS_INLINE void scatter_normal(struct workspace *w, int32_t j, double *patch, double scaled_mass)
{
    double diagonal[3][3] = {{scaled_mass, 0, 0}, {0, scaled_mass, 0}, {0, 0, scaled_mass}};
    scatter_stress(w, j, patch, diagonal, NULL);
}

THREADS_INLINE void scatter_particle(const struct mpm *mpm, struct workspace *w, int32_t j, size_t p, double *patch,
                                     bool momentum, bool force)
{
    const struct store *store = mpm->store;
    double external[3];
    if (momentum) {
        double mass = store->real[COLUMN_MASS][0][p];
        double values[4] = {mass};
        for (int a = 0; a < 3; a++)
            values[1 + a] = mass * store->real[COLUMN_VELOCITY][a][p];
        scatter_values(w, j, patch, values, 4);
    }
    if (force) {
        double stress[3][3];
        mpm_force_stress(mpm, p, stress);
        if (mpm->has_external_force)
            mpm_external_force(mpm, p, external);
        patch += momentum ? 4 * PATCH_NODES : 0;
        scatter_stress(w, j, patch, stress, mpm->has_external_force ? external : NULL);
        if (mpm->contact)
            scatter_normal(w, j, patch + 3 * PATCH_NODES, store->real[COLUMN_MASS][0][p] / mpm->cells->frame.size);
    }
}

THREADS_INLINE void scatter_block(struct mpm *mpm, int32_t b, bool momentum, bool force, axis_weights *weights)
{
    struct workspace *w = &mpm->workspaces[threads_self()];
    struct chunk chunk = {.block = &mpm->cells->blocks[b], .block_index = b, .workspace = w};
    double *patch = grid_patch(mpm->grid, b, 0);
    memset(patch, 0, (size_t)(4 * momentum + 3 * force + (force && mpm->contact ? 3 : 0)) * PATCH_NODES * sizeof *patch);
    while (chunk_next(mpm, &chunk)) {
        double *position[3];
        for (int a = 0; a < 3; a++)
            position[a] = chunk_read(&chunk, mpm->store->real[COLUMN_POSITION][a], w->copy[a]);
        find_weights(mpm, &chunk, position, weights);
        for (int32_t j = 0; j < chunk.count; j++)
            scatter_particle(mpm, w, j, (size_t)chunk.order[j], patch, momentum, force);
    }
}

/* --- grid to particles --- */

/* Three fields at the chunk's particles, into workspace.gathered. */
THREADS_INLINE void gather_values(const struct chunk *chunk, const double *fields)
{
    struct workspace *w = chunk->workspace;
    for (int32_t j = 0; j < chunk->count; j++) {
        lanes sum[3] = {{0}, {0}, {0}}, along = ROW_OF(w->weight[0], j);
        for (int k = 0; k < SUPPORT; k++)
            for (int i = 0; i < SUPPORT; i++) {
                double across = w->weight[1][i][j] * w->weight[2][k][j];
                const double *row = fields + w->base[j] + ROW * (i + EDGE * k);
                for (int a = 0; a < 3; a++)
                    sum[a] += *(const lanes *)(row + a * PATCH_NODES) * across;
            }
        for (int a = 0; a < 3; a++) {
            lanes product = sum[a] * along;
            w->gathered[a][j] = product[0] + product[1] + product[2];
        }
    }
}

/* Strain and spin increments and their trace from three velocity fields. */
THREADS_INLINE void gather_gradient(const struct chunk *chunk, const double *fields, double scale)
{
    struct workspace *w = chunk->workspace;
    for (int32_t j = 0; j < chunk->count; j++) {
        lanes flat[3] = {{0}, {0}, {0}}, flat_y[3] = {{0}, {0}, {0}}, flat_z[3] = {{0}, {0}, {0}};
        for (int k = 0; k < SUPPORT; k++)
            for (int i = 0; i < SUPPORT; i++) {
                double across = w->weight[1][i][j] * w->weight[2][k][j];
                double across_y = w->slope[1][i][j] * w->weight[2][k][j];
                double across_z = w->weight[1][i][j] * w->slope[2][k][j];
                const double *row = fields + w->base[j] + ROW * (i + EDGE * k);
                for (int a = 0; a < 3; a++) {
                    lanes value = *(const lanes *)(row + a * PATCH_NODES);
                    flat[a] += value * across;
                    flat_y[a] += value * across_y;
                    flat_z[a] += value * across_z;
                }
            }
        lanes along = ROW_OF(w->weight[0], j) * scale, slope = ROW_OF(w->slope[0], j) * scale;
        double g[3][3];
        for (int a = 0; a < 3; a++) {
            lanes x = flat[a] * slope, y = flat_y[a] * along, z = flat_z[a] * along;
            g[a][0] = x[0] + x[1] + x[2];
            g[a][1] = y[0] + y[1] + y[2];
            g[a][2] = z[0] + z[1] + z[2];
        }
        chunk_set_gradient(w, j, g);
    }
}

THREADS_INLINE void velocity_block(struct mpm *mpm, int32_t b, axis_weights *weights)
{
    struct workspace *w = &mpm->workspaces[threads_self()];
    struct chunk chunk = {.block = &mpm->cells->blocks[b], .block_index = b, .workspace = w};
    const bool remaps = mpm->scene->scheme == SCHEME_MUSL, moves = mpm->scene->scheme == SCHEME_USF;
    double *patch = grid_patch(mpm->grid, b, 0);
    const double *velocities = w->patch, *accelerations = w->patch + 3 * PATCH_NODES;
    grid_read_patch(mpm->grid, b, NODE_MOMENTUM, 6, w->patch);
    if (remaps)
        memset(patch, 0, 3 * PATCH_NODES * sizeof *patch);
    while (chunk_next(mpm, &chunk)) {
        double *position[3], *velocity[3];
        for (int a = 0; a < 3; a++) {
            position[a] = chunk_read(&chunk, mpm->store->real[COLUMN_POSITION][a], w->copy[a]);
            velocity[a] = chunk_read(&chunk, mpm->store->real[COLUMN_VELOCITY][a], w->copy[3 + a]);
        }
        const double *mass = chunk_read(&chunk, mpm->store->real[COLUMN_MASS][0], w->copy[6]);
        find_weights(mpm, &chunk, position, weights);
        if (mpm->has_external_force) {
            gather_values(&chunk, velocities);
            motion_work(mpm, &chunk);
        }
        if (mpm->scene->transfer != TRANSFER_FLIP) {
            gather_values(&chunk, velocities);
            motion_blend(mpm, &chunk, velocity);
        }
        gather_values(&chunk, accelerations);
        motion_accelerate(mpm, &chunk, velocity, mass);
        for (int32_t j = 0; j < chunk.count && remaps; j++) {
            double momentum[3] = {mass[j] * velocity[0][j], mass[j] * velocity[1][j], mass[j] * velocity[2][j]};
            scatter_values(w, j, patch, momentum, 3);
        }
        if (moves) {
            gather_values(&chunk, velocities);
            motion_move(mpm, &chunk);
        }
    }
}

THREADS_INLINE void strain_block(struct mpm *mpm, int32_t b, axis_weights *weights)
{
    struct workspace *w = &mpm->workspaces[threads_self()];
    struct chunk chunk = {.block = &mpm->cells->blocks[b], .block_index = b, .workspace = w};
    const bool moves = mpm->scene->scheme != SCHEME_USF;
    const double *velocities = w->patch, *straining = w->patch + 3 * PATCH_NODES;
    if (moves)
        grid_read_patch(mpm->grid, b, NODE_MOMENTUM, 3, w->patch);
    grid_read_patch(mpm->grid, b, mpm->straining_field, 3, w->patch + 3 * PATCH_NODES);
    while (chunk_next(mpm, &chunk)) {
        double *position[3];
        for (int a = 0; a < 3; a++)
            position[a] = chunk_read(&chunk, mpm->store->real[COLUMN_POSITION][a], w->copy[a]);
        find_weights(mpm, &chunk, position, weights);
        gather_gradient(&chunk, straining, mpm->time_step / mpm->cells->frame.size);
        stress_update(mpm, &chunk);
        if (moves) {
            gather_values(&chunk, velocities);
            motion_move(mpm, &chunk);
        }
    }
}

/* Smoothed pressure: weights at the new position, counted from the old cell (spec 9.6, Q). */
THREADS_INLINE void smooth_block(struct mpm *mpm, int32_t b, axis_weights *weights, bool gives)
{
    struct workspace *w = &mpm->workspaces[threads_self()];
    struct chunk chunk = {.block = &mpm->cells->blocks[b], .block_index = b, .workspace = w};
    double *patch = grid_patch(mpm->grid, b, 0);
    if (gives)
        memset(patch, 0, 2 * PATCH_NODES * sizeof *patch);
    else
        grid_read_patch(mpm->grid, b, NODE_STRAINING, 3, w->patch);
    while (chunk_next(mpm, &chunk)) {
        double *position[3];
        for (int a = 0; a < 3; a++)
            position[a] = chunk_read(&chunk, mpm->store->real[COLUMN_POSITION][a], w->copy[a]);
        find_weights(mpm, &chunk, position, weights);
        if (!gives)
            gather_values(&chunk, w->patch);
        for (int32_t j = 0; j < chunk.count; j++) {
            double volume = smoothing_volume(mpm, (size_t)chunk.order[j]);
            double values[2] = {volume * store_pressure(mpm->store, (size_t)chunk.order[j]), volume};
            if (gives)
                scatter_values(w, j, patch, values, 2);
            else
                mpm->store->real[COLUMN_SMOOTHED_PRESSURE][0][chunk.order[j]] = w->gathered[0][j];
        }
    }
}

/* The passes of each kind of weights. */
#define SMOOTH_SHAPE(kind, word, weights)                                                                              \
    THREADS_VECTORISED                                                                                                 \
    static void kind##_scatter(struct mpm *mpm, int32_t b, bool momentum, bool force)                                  \
    {                                                                                                                  \
        scatter_block(mpm, b, momentum, force, weights);                                                               \
    }                                                                                                                  \
    THREADS_VECTORISED                                                                                                 \
    static void kind##_velocity(struct mpm *mpm, int32_t b)                                                            \
    {                                                                                                                  \
        velocity_block(mpm, b, weights);                                                                               \
    }                                                                                                                  \
    THREADS_VECTORISED                                                                                                 \
    static void kind##_strain(struct mpm *mpm, int32_t b)                                                              \
    {                                                                                                                  \
        strain_block(mpm, b, weights);                                                                                 \
    }                                                                                                                  \
    static void kind##_give(struct mpm *mpm, int32_t b)                                                                \
    {                                                                                                                  \
        smooth_block(mpm, b, weights, true);                                                                           \
    }                                                                                                                  \
    static void kind##_take(struct mpm *mpm, int32_t b)                                                                \
    {                                                                                                                  \
        smooth_block(mpm, b, weights, false);                                                                          \
    }                                                                                                                  \
    const struct shape shape_##kind = {.name = word, .reach = 1, .scatter = kind##_scatter,                            \
                                       .gather_velocity = kind##_velocity, .gather_strain = kind##_strain,             \
                                       .smooth_give = kind##_give, .smooth_take = kind##_take};

SMOOTH_SHAPE(gimp, "gimp", fixed_hat_weights)
SMOOTH_SHAPE(gimp_own, "gimp cp", own_hat_weights)
SMOOTH_SHAPE(bimp, "bimp", spline_weights)
