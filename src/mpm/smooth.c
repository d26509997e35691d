/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shape functions that reach over three nodes along each axis: generalised interpolation (spec 7.2)
 * and quadratic B-splines (spec 7.3). One particle after the other: to the grid over rows of nodes along
 * x, each with a fourth node of weight 0; from the grid over the vectors of the nodes. */
#include "base/threads.h"
#include "mpm/chunk.h"
#include "mpm/hat.h"

#include <string.h>

enum { EDGE = 7, ROW = 8, SUPPORT = 3, PATCH_NODES = LARGEST_PATCH };

/* --- weights --- */

/* Weights and slopes of a chunk along one axis; returns in `low` how many nodes (0 or 1) the lowest one is
 * below the cell. `local` is the position in the cell. */
typedef void axis_weights(const struct mpm *mpm, const struct chunk *chunk, int a, const double *local, double *low);

/* `half_width` of each particle, or NULL for the fixed one. */
THREADS_INLINE void hat_weights(const struct chunk *chunk, int a, const double *local, const double *half_width, double *low)
{
    struct workspace *w = chunk->workspace;
    for (int32_t j = 0; j < chunk->count; j++)
        low[j] = local[j] < 0.5 ? 1 : 0;
    for (int n = 0; n < SUPPORT; n++) {
        double *restrict weight = w->weight[a][n], *restrict slope = w->slope[a][n];
        for (int32_t j = 0; j < chunk->count; j++)
            hat_averaged(local[j] + (low[j] - n), half_width ? half_width[j] : HAT_FIXED_HALF_WIDTH, &weight[j], &slope[j]);
    }
}

THREADS_VECTORISED
static void fixed_hat_weights(const struct mpm *mpm, const struct chunk *chunk, int a, const double *local, double *low)
{
    (void)mpm;
    hat_weights(chunk, a, local, NULL, low);
}

THREADS_VECTORISED
static void own_hat_weights(const struct mpm *mpm, const struct chunk *chunk, int a, const double *local, double *low)
{
    double half_width[CHUNK_PARTICLES];
    for (int32_t j = 0; j < chunk->count; j++)
        half_width[j] = mpm->bodies[mpm->store->integer[COLUMN_BODY][chunk->order[j]]].half_width;
    hat_weights(chunk, a, local, half_width, low);
}

THREADS_VECTORISED
static void spline_weights(const struct mpm *mpm, const struct chunk *chunk, int a, const double *local, double *low)
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
    double low[CHUNK_PARTICLES];
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
            w->base[j] -= (int32_t)low[j] * stride[a];
    }
}

/* The weights of particle j along x as a row of nodes. */
#define ROW_OF(value, j) ((lanes){(value)[0][j], (value)[1][j], (value)[2][j], 0})

/* --- particles to grid --- */

/* What a particle gives to rows of nodes along x. Row i along y and k along z, whose weights and slopes
 * there are wy, sy, wz, sz, gets plain * wy wz, and x * wy wz + y * sy wz + z * wy sz: the products along x
 * are formed once a particle, those along y three times. */
enum { PLAIN = 4, GRADED = 6 };
struct gift {
    lanes plain[PLAIN];
    lanes x[GRADED], y[GRADED], z[GRADED];
};

/* Adds it to fields of a patch: `plain` ones and the `graded` ones that follow. */
THREADS_INLINE void give_rows(const struct workspace *w, int32_t j, double *patch, const struct gift *gift, int plain,
                              int graded)
{
    double *corner = patch + w->base[j];
    for (int i = 0; i < SUPPORT; i++) {
        const double weight = w->weight[1][i][j], slope = w->slope[1][i][j];
        lanes flat[PLAIN], across[GRADED], along_z[GRADED];
        for (int f = 0; f < plain; f++)
            flat[f] = gift->plain[f] * weight;
        for (int f = 0; f < graded; f++) {
            across[f] = gift->x[f] * weight + gift->y[f] * slope;
            along_z[f] = gift->z[f] * weight;
        }
        for (int k = 0; k < SUPPORT; k++) {
            const double weight_z = w->weight[2][k][j], slope_z = w->slope[2][k][j];
            double *row = corner + ROW * (i + EDGE * k);
            for (int f = 0; f < plain; f++)
                *(lanes *)(row + f * PATCH_NODES) += flat[f] * weight_z;
            for (int f = 0; f < graded; f++)
                *(lanes *)(row + (plain + f) * PATCH_NODES) += across[f] * weight_z + along_z[f] * slope_z;
        }
    }
}

/* Adds value * weight of particle j to one field of a patch, and to those that follow. */
THREADS_INLINE void scatter_values(const struct workspace *w, int32_t j, double *patch, const double *values, int fields)
{
    lanes along = ROW_OF(w->weight[0], j);
    struct gift gift;
    for (int f = 0; f < fields; f++)
        gift.plain[f] = along * values[f];
    give_rows(w, j, patch, &gift, fields, 0);
}

/* Mass and momentum; force: minus volume times stress times gradient, and external force times weight;
 * normals: mass times gradient. */
THREADS_INLINE void scatter_particle(const struct mpm *mpm, const struct workspace *w, int32_t j, size_t p, double *patch,
                                     bool momentum, bool force, bool normals)
{
    const struct store *store = mpm->store;
    lanes along = ROW_OF(w->weight[0], j), slope = ROW_OF(w->slope[0], j);
    const double mass = store->real[COLUMN_MASS][0][p];
    struct gift gift;
    if (momentum) {
        gift.plain[0] = along * mass;
        for (int a = 0; a < 3; a++)
            gift.plain[1 + a] = along * (mass * store->real[COLUMN_VELOCITY][a][p]);
    }
    if (force) {
        double stress[3][3], external[3];
        mpm_force_stress(mpm, p, FORCE_ANY, stress);
        for (int a = 0; a < 3; a++) {
            gift.x[a] = slope * stress[a][0];
            gift.y[a] = along * stress[a][1];
            gift.z[a] = along * stress[a][2];
        }
        if (mpm->has_external_force) {
            mpm_external_force(mpm, p, external);
            for (int a = 0; a < 3; a++)
                gift.x[a] += along * external[a];
        }
    }
    if (normals) {
        const double scaled = mass / mpm->cells->frame.size;
        for (int a = 0; a < 3; a++) {
            gift.x[3 + a] = slope * (a == 0 ? scaled : 0);
            gift.y[3 + a] = along * (a == 1 ? scaled : 0);
            gift.z[3 + a] = along * (a == 2 ? scaled : 0);
        }
    }
    give_rows(w, j, patch, &gift, momentum ? 4 : 0, normals ? 6 : force ? 3 : 0);
}

THREADS_INLINE void scatter_block(struct mpm *mpm, int32_t b, bool momentum, bool force, bool normals, axis_weights *weights)
{
    struct workspace *w = &mpm->workspaces[threads_self()];
    struct chunk chunk = {.block = &mpm->cells->blocks[b], .block_index = b, .workspace = w};
    double *patch = grid_patch(mpm->grid, b, 0);
    memset(patch, 0, (size_t)(4 * momentum + 3 * force + 3 * normals) * PATCH_NODES * sizeof *patch);
    while (chunk_next(mpm, &chunk)) {
        double *position[3];
        for (int a = 0; a < 3; a++)
            position[a] = chunk_read(&chunk, mpm->store->real[COLUMN_POSITION][a], w->copy[a]);
        find_weights(mpm, &chunk, position, weights);
        for (int32_t j = 0; j < chunk.count; j++)
            scatter_particle(mpm, w, j, (size_t)chunk.order[j], patch, momentum, force, normals);
    }
}

/* One loop for each set of fields. */
THREADS_INLINE void scatter_fields(struct mpm *mpm, int32_t b, bool momentum, bool force, axis_weights *weights)
{
    if (!force)
        scatter_block(mpm, b, true, false, false, weights);
    else if (mpm->contact && momentum)
        scatter_block(mpm, b, true, true, true, weights);
    else if (mpm->contact)
        scatter_block(mpm, b, false, true, true, weights);
    else if (momentum)
        scatter_block(mpm, b, true, true, false, weights);
    else
        scatter_block(mpm, b, false, true, false, weights);
}

/* --- grid to particles --- */

/* The x, y and z of a vector lie side by side at a node, with one number more. */
enum { VECTOR = LANES };

/* Reads three fields of the patch of block b as the vectors of its nodes. */
THREADS_INLINE void read_vectors(const struct mpm *mpm, int32_t b, int field, struct workspace *w, double *vectors)
{
    grid_read_patch(mpm->grid, b, field, 3, w->patch);
    for (int n = 0; n < PATCH_NODES; n++)
        for (int a = 0; a < VECTOR; a++)
            vectors[VECTOR * n + a] = a < 3 ? w->patch[a * PATCH_NODES + n] : 0;
}

/* Sum of the vectors of a row of three nodes times three numbers. */
#define SUM_ROW(row, first, second, third)                                                                             \
    (*(const lanes *)(row) * (first) + *(const lanes *)((row) + VECTOR) * (second)                                     \
     + *(const lanes *)((row) + 2 * VECTOR) * (third))

/* A vector field at the chunk's particles, into workspace.gathered. */
THREADS_INLINE void gather_values(const struct chunk *chunk, const double *vectors)
{
    struct workspace *w = chunk->workspace;
    for (int32_t j = 0; j < chunk->count; j++) {
        const double *corner = vectors + VECTOR * w->base[j];
        const double x0 = w->weight[0][0][j], x1 = w->weight[0][1][j], x2 = w->weight[0][2][j];
        lanes sum = {0};
        for (int k = 0; k < SUPPORT; k++) {
            lanes plane = {0};
            for (int i = 0; i < SUPPORT; i++)
                plane += SUM_ROW(corner + VECTOR * ROW * (i + EDGE * k), x0, x1, x2) * w->weight[1][i][j];
            sum += plane * w->weight[2][k][j];
        }
        for (int a = 0; a < 3; a++)
            w->gathered[a][j] = sum[a];
    }
}

/* Strain and spin increments and their trace from a velocity field. */
THREADS_INLINE void gather_gradient(const struct chunk *chunk, const double *vectors, double scale)
{
    struct workspace *w = chunk->workspace;
    for (int32_t j = 0; j < chunk->count; j++) {
        const double *corner = vectors + VECTOR * w->base[j];
        const double x0 = w->weight[0][0][j], x1 = w->weight[0][1][j], x2 = w->weight[0][2][j];
        const double s0 = w->slope[0][0][j], s1 = w->slope[0][1][j], s2 = w->slope[0][2][j];
        lanes along[3] = {{0}, {0}, {0}}; /* derivatives along x, y and z */
        for (int k = 0; k < SUPPORT; k++) {
            lanes flat = {0}, flat_x = {0}, flat_y = {0};
            for (int i = 0; i < SUPPORT; i++) {
                const double *row = corner + VECTOR * ROW * (i + EDGE * k);
                lanes value = SUM_ROW(row, x0, x1, x2);
                flat_x += SUM_ROW(row, s0, s1, s2) * w->weight[1][i][j];
                flat += value * w->weight[1][i][j];
                flat_y += value * w->slope[1][i][j];
            }
            along[0] += flat_x * w->weight[2][k][j];
            along[1] += flat_y * w->weight[2][k][j];
            along[2] += flat * w->slope[2][k][j];
        }
        double g[3][3];
        for (int a = 0; a < 9; a++)
            g[a / 3][a % 3] = along[a % 3][a / 3] * scale;
        chunk_set_gradient(w, j, g);
    }
}

THREADS_INLINE void velocity_block(struct mpm *mpm, int32_t b, axis_weights *weights)
{
    struct workspace *w = &mpm->workspaces[threads_self()];
    struct chunk chunk = {.block = &mpm->cells->blocks[b], .block_index = b, .workspace = w};
    const bool remaps = mpm->scene->scheme == SCHEME_MUSL, moves = mpm->scene->scheme == SCHEME_USF;
    double *patch = grid_patch(mpm->grid, b, 0);
    double *velocities = w->vectors[0], *accelerations = w->vectors[1];
    if (moves || mpm->has_external_force || mpm->scene->transfer != TRANSFER_FLIP)
        read_vectors(mpm, b, NODE_MOMENTUM, w, velocities);
    read_vectors(mpm, b, NODE_FORCE, w, accelerations);
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
    double *velocities = w->vectors[0], *straining = w->vectors[1];
    if (moves)
        read_vectors(mpm, b, NODE_MOMENTUM, w, velocities);
    read_vectors(mpm, b, mpm->straining_field, w, straining);
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
        read_vectors(mpm, b, NODE_STRAINING, w, w->vectors[0]);
    while (chunk_next(mpm, &chunk)) {
        double *position[3];
        for (int a = 0; a < 3; a++)
            position[a] = chunk_read(&chunk, mpm->store->real[COLUMN_POSITION][a], w->copy[a]);
        find_weights(mpm, &chunk, position, weights);
        if (!gives)
            gather_values(&chunk, w->vectors[0]);
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
        scatter_fields(mpm, b, momentum, force, weights);                                                              \
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
