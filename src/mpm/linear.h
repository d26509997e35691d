/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Trilinear shape functions (spec 7.1): the loops between particles and nodes of a cell, to be
 * compiled into the passes of linear.c.
 * Scatter runs over the nodes of a cell at once, one particle after the other, so that the order of
 * the sums is the order of the particles. Gather runs over particles of a cell at once, with the
 * cell's field as a polynomial whose eight coefficients are formed once a cell. */
#ifndef MPM_LINEAR_H
#define MPM_LINEAR_H

#include "base/threads.h"
#include "mpm/chunk.h"

#include <string.h>

/* Four nodes of a cell's lower or upper face, in the order (0,0) (1,0) (0,1) (1,1) of x and y; a
 * cell's eight nodes are a pair of them. */
enum { FACE_NODES = 4, LOWER = 0, UPPER = 1, FACES = 2, PATCH_EDGE = BLOCK_EDGE + 1, PATCH_NODES = 128 };

typedef lanes face;

static const int corner_offset[FACES][FACE_NODES] = {
    {0, 1, PATCH_EDGE, PATCH_EDGE + 1},
    {PATCH_EDGE * PATCH_EDGE, PATCH_EDGE * PATCH_EDGE + 1, PATCH_EDGE * PATCH_EDGE + PATCH_EDGE,
     PATCH_EDGE * PATCH_EDGE + PATCH_EDGE + 1}};

/* Along x and y a node's weight is low + sign * local coordinate. */
static const face sign_x = {-1, 1, -1, 1}, sign_y = {-1, -1, 1, 1}, low_x = {1, 0, 1, 0}, low_y = {1, 1, 0, 0};

/* Where the block's particles put what they give to nodes. */
THREADS_INLINE double (*patch_of(const struct mpm *mpm, int32_t b))[PATCH_NODES]
{
    return (double(*)[PATCH_NODES])grid_patch(mpm->grid, b, 0);
}

/* The node values that a pass over a block reads. */
THREADS_INLINE double (*values_of(const struct workspace *workspace, int field))[PATCH_NODES]
{
    return (double(*)[PATCH_NODES])(workspace->patch + field * PATCH_NODES);
}

/* --- particles to grid (thesis steps 1 and 4) --- */

/* Adds what a cell's nodes got to the patch. */
THREADS_INLINE void add_corners(double (*patch)[PATCH_NODES], int base, face sum[][FACES], int count)
{
    for (int f = 0; f < count; f++)
        for (int half = 0; half < FACES; half++)
            for (int i = 0; i < FACE_NODES; i++)
                patch[f][base + corner_offset[half][i]] += sum[f][half][i];
}

/* Mean stress of a cell's particles, averaged by volume: with bbar it takes the place of their own, as
 * the volume change does (in the manner of Hughes, Int. J. Numer. Meth. Engng 15, 1980). */
static inline double mean_stress_of(const struct mpm *mpm, const int32_t *order, int32_t count)
{
    const struct store *store = mpm->store;
    double sum = 0, volume = 0;
    for (int32_t k = 0; k < count; k++) {
        const int32_t p = order[k];
        double mean = (store->real[COLUMN_STRESS][0][p] + store->real[COLUMN_STRESS][1][p] + store->real[COLUMN_STRESS][2][p]) / 3;
        if (store->real[COLUMN_RESIDUAL][0])
            mean -= (store->real[COLUMN_RESIDUAL][0][p] + store->real[COLUMN_RESIDUAL][1][p] + store->real[COLUMN_RESIDUAL][2][p]) / 3;
        sum += store->real[COLUMN_VOLUME][0][p] * (mean - mpm_viscous_pressure(store, (size_t)p));
        volume += store->real[COLUMN_VOLUME][0][p];
    }
    return sum / volume;
}

/* Mass, momentum and force of one cell's particles, and the normals that contact needs. `sum` holds
 * them in this order. `special`: xfer apic or bbar. */
THREADS_INLINE void scatter_cell(const struct mpm *mpm, const int32_t *order, int32_t count, const double cell_low[3],
                                 face sum[10][FACES], bool momentum, bool force, bool external, bool normals, bool special,
                                 enum force_parts parts)
{
    const struct store *store = mpm->store;
    const double inverse = 1 / mpm->cells->frame.size;
    const double cell_mean = special && force && mpm->scene->averages_volume ? mean_stress_of(mpm, order, count) : 0;
    for (int32_t k = 0; k < count; k++) {
        size_t p = (size_t)order[k];
        double x = (store->real[mpm->place][0][p] - cell_low[0]) * inverse;
        double y = (store->real[mpm->place][1][p] - cell_low[1]) * inverse;
        double upper = (store->real[mpm->place][2][p] - cell_low[2]) * inverse, lower = 1 - upper;
        face weight_x = low_x + sign_x * x, weight_y = low_y + sign_y * y;
        face flat = weight_x * weight_y;
        face n_lower = flat * lower, n_upper = flat * upper;
        if (momentum) {
            double mass = store->real[COLUMN_MASS][0][p];
            double px = mass * store->real[COLUMN_VELOCITY][0][p], py = mass * store->real[COLUMN_VELOCITY][1][p],
                   pz = mass * store->real[COLUMN_VELOCITY][2][p];
            sum[0][LOWER] += n_lower * mass;
            sum[0][UPPER] += n_upper * mass;
            sum[1][LOWER] += n_lower * px;
            sum[1][UPPER] += n_upper * px;
            sum[2][LOWER] += n_lower * py;
            sum[2][UPPER] += n_upper * py;
            sum[3][LOWER] += n_lower * pz;
            sum[3][UPPER] += n_upper * pz;
        }
        if (momentum && special && store->real[COLUMN_AFFINE][0]) {
            const double size = mpm->cells->frame.size, mass = store->real[COLUMN_MASS][0][p] * size;
            face way_x = low_x * -x + (1 - low_x) * (1 - x), way_y = low_y * -y + (1 - low_y) * (1 - y);
            for (int a = 0; a < 3; a++) {
                face flat_part = way_x * store->real[COLUMN_AFFINE][3 * a][p] + way_y * store->real[COLUMN_AFFINE][3 * a + 1][p];
                double along_z = store->real[COLUMN_AFFINE][3 * a + 2][p];
                sum[1 + a][LOWER] += n_lower * (mass * (flat_part - along_z * upper));
                sum[1 + a][UPPER] += n_upper * (mass * (flat_part + along_z * lower));
            }
        }
        if (force) {
            double t[3][3];
            mpm_force_stress(mpm, p, parts, t);
            if (special && mpm->scene->averages_volume) {
                double change = cell_mean * -store->real[COLUMN_VOLUME][0][p] * inverse - (t[0][0] + t[1][1] + t[2][2]) / 3;
                for (int a = 0; a < 3; a++)
                    t[a][a] += change;
            }
            face slope_x = sign_x * weight_y, slope_y = sign_y * weight_x;
            face along_x = slope_x * t[0][0] + slope_y * t[0][1], across_x = flat * t[0][2];
            face along_y = slope_x * t[1][0] + slope_y * t[1][1], across_y = flat * t[1][2];
            face along_z = slope_x * t[2][0] + slope_y * t[2][1], across_z = flat * t[2][2];
            sum[4][LOWER] += along_x * lower - across_x;
            sum[4][UPPER] += along_x * upper + across_x;
            sum[5][LOWER] += along_y * lower - across_y;
            sum[5][UPPER] += along_y * upper + across_y;
            sum[6][LOWER] += along_z * lower - across_z;
            sum[6][UPPER] += along_z * upper + across_z;
            if (normals) {
                double scaled = store->real[COLUMN_MASS][0][p] * inverse;
                sum[7][LOWER] += slope_x * (scaled * lower);
                sum[7][UPPER] += slope_x * (scaled * upper);
                sum[8][LOWER] += slope_y * (scaled * lower);
                sum[8][UPPER] += slope_y * (scaled * upper);
                sum[9][LOWER] -= flat * scaled;
                sum[9][UPPER] += flat * scaled;
            }
            if (external) {
                double f[3];
                mpm_external_force(mpm, p, f);
                for (int a = 0; a < 3; a++) {
                    sum[4 + a][LOWER] += n_lower * f[a];
                    sum[4 + a][UPPER] += n_upper * f[a];
                }
            }
        }
    }
}

/* Asks for the particles that follow in memory: a cell's pass is too short for the processor to
 * see that the columns are read in order. */
THREADS_INLINE void prefetch_particles(const struct mpm *mpm, int32_t p, bool momentum, bool force)
{
    const struct store *store = mpm->store;
    enum { AHEAD = 24 };
    for (int a = 0; a < 3; a++) {
        __builtin_prefetch(store->real[mpm->place][a] + p + AHEAD);
        if (momentum)
            __builtin_prefetch(store->real[COLUMN_VELOCITY][a] + p + AHEAD);
    }
    __builtin_prefetch(store->real[COLUMN_MASS][0] + p + AHEAD);
    for (int a = 0; a < 6 && force; a++)
        __builtin_prefetch(store->real[COLUMN_STRESS][a] + p + AHEAD);
    if (force) {
        __builtin_prefetch(store->real[COLUMN_VOLUME][0] + p + AHEAD);
        if (store->real[COLUMN_VISCOUS_PRESSURE][0])
            __builtin_prefetch(store->real[COLUMN_VISCOUS_PRESSURE][0] + p + AHEAD);
    }
}

THREADS_INLINE void scatter_block(struct mpm *mpm, int32_t b, bool momentum, bool force, bool external, bool normals,
                                  bool special, enum force_parts parts)
{
    const struct cell_block *block = &mpm->cells->blocks[b];
    double(*patch)[PATCH_NODES] = patch_of(mpm, b);
    const int fields = 4 * momentum + 3 * force + 3 * normals;
    struct chunk chunk = {.block = block};
    memset(patch, 0, (size_t)fields * sizeof *patch);
    for (int c = 0; c < BLOCK_CELLS; c++) {
        int32_t from = block->cell_first[c], count = block->cell_first[c + 1] - from;
        if (count == 0)
            continue;
        face sum[10][FACES];
        double cell_low[3];
        for (int f = 0; f < 7 + 3 * normals; f++)
            sum[f][LOWER] = sum[f][UPPER] = (face){0};
        for (int a = 0; a < 3; a++)
            cell_low[a] = chunk_cell_low(mpm, &chunk, c, a);
        prefetch_particles(mpm, mpm->cells->order[block->first + from], momentum, force);
        scatter_cell(mpm, mpm->cells->order + block->first + from, count, cell_low, sum, momentum, force, external,
                     normals, special, parts);
        add_corners(patch, grid_patch_corner(c, PATCH_EDGE, PATCH_EDGE, 0), momentum ? sum : sum + 4, fields);
    }
}

/* --- grid to particles --- */

/* The trilinear field of a cell as a polynomial 1 x y z xy xz yz xyz of local coordinates. */
struct polynomial {
    double one, x, y, z, xy, xz, yz, xyz;
};

THREADS_INLINE struct polynomial polynomial_of(const double *field, int base)
{
    const double *v = field + base, *w = v + PATCH_EDGE * PATCH_EDGE;
    double v0 = v[0], v1 = v[1], v2 = v[PATCH_EDGE], v3 = v[PATCH_EDGE + 1];
    double v4 = w[0], v5 = w[1], v6 = w[PATCH_EDGE], v7 = w[PATCH_EDGE + 1];
    struct polynomial c = {.one = v0, .x = v1 - v0, .y = v2 - v0, .z = v4 - v0};
    double upper_x = v5 - v4;
    c.xy = (v3 - v2) - c.x;
    c.xz = upper_x - c.x;
    c.yz = (v6 - v4) - c.y;
    c.xyz = ((v7 - v6) - upper_x) - c.xy;
    return c;
}

/* Positions of the chunk's particles in their cells, 0 ... 1, into workspace.local. */
THREADS_INLINE void find_local(const struct mpm *mpm, const struct chunk *chunk, double *const position[3])
{
    const double inverse = 1 / mpm->cells->frame.size;
    for (struct cell_walk walk = {0}; walk_next(chunk, &walk);)
        for (int a = 0; a < 3; a++) {
            double cell_low = chunk_cell_low(mpm, chunk, walk.cell, a);
            double *local = chunk->workspace->local[a];
            for (int32_t j = walk.from; j < walk.to; j++)
                local[j] = (position[a][j] - cell_low) * inverse;
        }
}

/* Evaluates three fields of the patch at the chunk's particles, into workspace.gathered. */
THREADS_INLINE void gather_values(const struct chunk *chunk, double (*patch)[PATCH_NODES])
{
    struct workspace *w = chunk->workspace;
    for (struct cell_walk walk = {0}; walk_next(chunk, &walk);)
        for (int a = 0; a < 3; a++) {
            struct polynomial c = polynomial_of(patch[a], grid_patch_corner(walk.cell, PATCH_EDGE, PATCH_EDGE, 0));
            for (int32_t j = walk.from; j < walk.to; j += LANES) {
                lanes x = *(lanes *)&w->local[0][j], y = *(lanes *)&w->local[1][j], z = *(lanes *)&w->local[2][j];
                *(lanes *)&w->gathered[a][j] = (c.one + c.x * x) + y * (c.y + c.xy * x)
                                             + z * ((c.z + c.xz * x) + y * (c.yz + c.xyz * x));
            }
        }
}

/* Strain and spin increments and their trace (spec 6.2) from the straining velocities of the patch. */
THREADS_INLINE void gather_gradient(const struct chunk *chunk, double (*patch)[PATCH_NODES], double scale)
{
    struct workspace *w = chunk->workspace;
    for (struct cell_walk walk = {0}; walk_next(chunk, &walk);) {
        int base = grid_patch_corner(walk.cell, PATCH_EDGE, PATCH_EDGE, 0);
        struct polynomial u = polynomial_of(patch[0], base), v = polynomial_of(patch[1], base),
                          t = polynomial_of(patch[2], base);
        for (int32_t j = walk.from; j < walk.to; j += LANES) {
            lanes x = *(lanes *)&w->local[0][j], y = *(lanes *)&w->local[1][j], z = *(lanes *)&w->local[2][j];
            lanes ux = ((u.x + u.xy * y) + z * (u.xz + u.xyz * y)) * scale;
            lanes uy = ((u.y + u.xy * x) + z * (u.yz + u.xyz * x)) * scale;
            lanes uz = ((u.z + u.xz * x) + y * (u.yz + u.xyz * x)) * scale;
            lanes vx = ((v.x + v.xy * y) + z * (v.xz + v.xyz * y)) * scale;
            lanes vy = ((v.y + v.xy * x) + z * (v.yz + v.xyz * x)) * scale;
            lanes vz = ((v.z + v.xz * x) + y * (v.yz + v.xyz * x)) * scale;
            lanes tx = ((t.x + t.xy * y) + z * (t.xz + t.xyz * y)) * scale;
            lanes ty = ((t.y + t.xy * x) + z * (t.yz + t.xyz * x)) * scale;
            lanes tz = ((t.z + t.xz * x) + y * (t.yz + t.xyz * x)) * scale;
            *(lanes *)&w->strain[0][j] = ux;
            *(lanes *)&w->strain[1][j] = vy;
            *(lanes *)&w->strain[2][j] = tz;
            *(lanes *)&w->strain[3][j] = ty + vz;
            *(lanes *)&w->strain[4][j] = uz + tx;
            *(lanes *)&w->strain[5][j] = vx + uy;
            *(lanes *)&w->spin[0][j] = 0.5 * (ty - vz);
            *(lanes *)&w->spin[1][j] = 0.5 * (uz - tx);
            *(lanes *)&w->spin[2][j] = 0.5 * (vx - uy);
            *(lanes *)&w->trace[j] = ux + vy + tz;
        }
    }
}

/* --- particle velocity (thesis steps 6 and 7) --- */

/* Adds momentum of the new velocities of the chunk to the straining field. */
THREADS_INLINE void scatter_new_momentum(const struct chunk *chunk, double *const velocity[3],
                                                                       const double *mass, double (*patch)[PATCH_NODES])
{
    const struct workspace *w = chunk->workspace;
    for (struct cell_walk walk = {0}; walk_next(chunk, &walk);) {
        face sum[3][FACES];
        for (int f = 0; f < 3; f++)
            sum[f][LOWER] = sum[f][UPPER] = (face){0};
        for (int32_t j = walk.from; j < walk.to; j++) {
            double upper = w->local[2][j], lower = 1 - upper;
            face flat = (low_x + sign_x * w->local[0][j]) * (low_y + sign_y * w->local[1][j]);
            face n_lower = flat * lower, n_upper = flat * upper;
            double px = mass[j] * velocity[0][j], py = mass[j] * velocity[1][j], pz = mass[j] * velocity[2][j];
            sum[0][LOWER] += n_lower * px;
            sum[0][UPPER] += n_upper * px;
            sum[1][LOWER] += n_lower * py;
            sum[1][UPPER] += n_upper * py;
            sum[2][LOWER] += n_lower * pz;
            sum[2][UPPER] += n_upper * pz;
        }
        add_corners(patch, grid_patch_corner(walk.cell, PATCH_EDGE, PATCH_EDGE, 0), sum, 3);
    }
}

/* Velocity gradient of the chunk's particles into their column and the workspace (xfer apic; for linear
 * shapes this is the affine part of Jiang et al., ACM Trans. Graph. 34, 2015). A point near a face of its
 * cell has next to no inertia, xi (1 - xi) cell^2, against a gradient along that axis, and the light
 * node that it gives to accelerates without bound: there the gradient follows the acceleration as if
 * the inertia were that of a point a quarter cell from the face. */
THREADS_INLINE void gather_affine(const struct mpm *mpm, const struct chunk *chunk, double (*velocity)[PATCH_NODES],
                                  double (*acceleration)[PATCH_NODES])
{
    static const double LEAST_INERTIA = 3.0 / 16;
    struct workspace *w = chunk->workspace;
    const double inverse = 1 / mpm->cells->frame.size, step = mpm->time_step * mpm->momentum_factor;
    gather_gradient(chunk, velocity, inverse);
    for (int32_t j = 0; j < chunk->count; j++) {
        double g[3][3];
        chunk_get_gradient(w, j, g);
        for (int f = 0; f < 9; f++)
            w->affine[f][j] = g[f / 3][f % 3];
    }
    gather_gradient(chunk, acceleration, inverse * step);
    for (int32_t j = 0; j < chunk->count; j++) {
        double g[3][3];
        chunk_get_gradient(w, j, g);
        for (int f = 0; f < 9; f++) {
            double local = w->local[f % 3][j], inertia = local * (1 - local);
            if (inertia < LEAST_INERTIA)
                w->affine[f][j] -= (1 - inertia / LEAST_INERTIA) * g[f / 3][f % 3];
            mpm->store->real[COLUMN_AFFINE][f][chunk->order[j]] = w->affine[f][j];
        }
    }
}

/* As scatter_new_momentum, each node with the velocity that the particle's gradient has there. */
THREADS_INLINE void scatter_affine_momentum(const struct mpm *mpm, const struct chunk *chunk, double *const velocity[3],
                                            const double *mass, double (*patch)[PATCH_NODES])
{
    const struct workspace *w = chunk->workspace;
    for (struct cell_walk walk = {0}; walk_next(chunk, &walk);)
        for (int32_t j = walk.from; j < walk.to; j++)
            for (int i = 0; i < 8; i++) {
                double weight = mass[j], way[3];
                for (int a = 0; a < 3; a++) {
                    way[a] = ((i >> a & 1) - w->local[a][j]) * mpm->cells->frame.size;
                    weight *= i >> a & 1 ? w->local[a][j] : 1 - w->local[a][j];
                }
                int node = grid_patch_corner(walk.cell, PATCH_EDGE, PATCH_EDGE, 0) + corner_offset[i >> 2][i & 3];
                for (int a = 0; a < 3; a++)
                    patch[a][node] += weight * (velocity[a][j] + w->affine[3 * a][j] * way[0]
                                                + w->affine[3 * a + 1][j] * way[1] + w->affine[3 * a + 2][j] * way[2]);
            }
}

/* Node values that the passes read. */
enum { PATCH_VELOCITY = 0, PATCH_ACCELERATION = 3, PATCH_STRAINING = 3 };

THREADS_INLINE void velocity_chunk(struct mpm *mpm, struct chunk *chunk, bool moves, bool remaps, bool external,
                                   bool blends)
{
    struct store *store = mpm->store;
    struct workspace *w = chunk->workspace;
    double *position[3], *velocity[3];
    for (int a = 0; a < 3; a++) {
        position[a] = chunk_read(chunk, store->real[mpm->place][a], w->copy[a]);
        velocity[a] = chunk_read(chunk, store->real[COLUMN_VELOCITY][a], w->copy[3 + a]);
    }
    const double *mass = chunk_read(chunk, store->real[COLUMN_MASS][0], w->copy[6]);
    find_local(mpm, chunk, position);
    if (external) {
        gather_values(chunk, values_of(w, PATCH_VELOCITY));
        motion_work(mpm, chunk);
    }
    if (blends) {
        gather_values(chunk, values_of(w, PATCH_VELOCITY));
        motion_blend(mpm, chunk, velocity);
    }
    gather_values(chunk, values_of(w, PATCH_ACCELERATION));
    motion_accelerate(mpm, chunk, velocity, mass);
    if (blends && mpm->scene->transfer == TRANSFER_AFFINE)
        gather_affine(mpm, chunk, values_of(w, PATCH_VELOCITY), values_of(w, PATCH_ACCELERATION));
    if (remaps && blends && mpm->scene->transfer == TRANSFER_AFFINE)
        scatter_affine_momentum(mpm, chunk, velocity, mass, patch_of(mpm, chunk->block_index));
    else if (remaps)
        scatter_new_momentum(chunk, velocity, mass, patch_of(mpm, chunk->block_index));
    if (moves) {
        gather_values(chunk, values_of(w, PATCH_VELOCITY));
        motion_move(mpm, chunk);
    }
}

THREADS_INLINE void velocity_block(struct mpm *mpm, int32_t b, bool moves, bool remaps, bool external, bool blends)
{
    struct workspace *w = &mpm->workspaces[threads_self()];
    struct chunk chunk = {.block = &mpm->cells->blocks[b], .block_index = b, .workspace = w};
    grid_read_patch(mpm->grid, b, NODE_MOMENTUM, 6, w->patch);
    if (remaps)
        memset(patch_of(mpm, b), 0, 3 * PATCH_NODES * sizeof(double));
    while (chunk_next(mpm, &chunk))
        velocity_chunk(mpm, &chunk, moves, remaps, external, blends);
}

/* --- strain and stress (thesis steps 3, 8 and 9) --- */

/* With bbar: the volume strain increments of a block's particles, averaged over each cell by volume,
 * into workspace.cell_mean. */
THREADS_INLINE void average_volume_change(const struct mpm *mpm, struct chunk chunk, double (*patch)[PATCH_NODES])
{
    struct workspace *w = chunk.workspace;
    double volume[BLOCK_CELLS] = {0};
    memset(w->cell_mean, 0, sizeof w->cell_mean);
    while (chunk_next(mpm, &chunk)) {
        double *position[3];
        for (int a = 0; a < 3; a++)
            position[a] = chunk_read(&chunk, mpm->store->real[mpm->place][a], w->copy[a]);
        find_local(mpm, &chunk, position);
        gather_gradient(&chunk, patch, mpm->time_step / mpm->cells->frame.size);
        for (struct cell_walk walk = {0}; walk_next(&chunk, &walk);)
            for (int32_t j = walk.from; j < walk.to; j++) {
                double own = mpm->store->real[COLUMN_VOLUME][0][chunk.order[j]];
                w->cell_mean[walk.cell] += own * w->trace[j];
                volume[walk.cell] += own;
            }
    }
    for (int c = 0; c < BLOCK_CELLS; c++)
        w->cell_mean[c] = volume[c] > 0 ? w->cell_mean[c] / volume[c] : 0;
}

/* Gives the particles of a chunk the averaged volume change. */
THREADS_INLINE void use_average(const struct chunk *chunk)
{
    struct workspace *w = chunk->workspace;
    for (struct cell_walk walk = {0}; walk_next(chunk, &walk);)
        for (int32_t j = walk.from; j < walk.to; j++) {
            double change = (w->cell_mean[walk.cell] - w->trace[j]) / 3;
            for (int a = 0; a < 3; a++)
                w->strain[a][j] += change;
            w->trace[j] = w->cell_mean[walk.cell];
        }
}

THREADS_INLINE void strain_block(struct mpm *mpm, int32_t b, bool moves)
{
    struct workspace *w = &mpm->workspaces[threads_self()];
    struct chunk chunk = {.block = &mpm->cells->blocks[b], .block_index = b, .workspace = w};
    grid_read_patch(mpm->grid, b, mpm->straining_field, 3, values_of(w, PATCH_STRAINING)[0]);
    if (moves)
        grid_read_patch(mpm->grid, b, NODE_MOMENTUM, 3, values_of(w, PATCH_VELOCITY)[0]);
    if (mpm->scene->averages_volume)
        average_volume_change(mpm, chunk, values_of(w, PATCH_STRAINING));
    while (chunk_next(mpm, &chunk)) {
        double *position[3];
        for (int a = 0; a < 3; a++)
            position[a] = chunk_read(&chunk, mpm->store->real[mpm->place][a], w->copy[a]);
        find_local(mpm, &chunk, position);
        gather_gradient(&chunk, values_of(w, PATCH_STRAINING), mpm->time_step / mpm->cells->frame.size);
        if (mpm->scene->averages_volume)
            use_average(&chunk);
        stress_update(mpm, &chunk);
        if (moves) {
            gather_values(&chunk, values_of(w, PATCH_VELOCITY));
            motion_move(mpm, &chunk);
        }
    }
}

/* USL has velocity and acceleration of the nodes when it updates velocities, and needs no more for the
 * rest of the step: all in one pass. */
THREADS_INLINE void usl_block(struct mpm *mpm, int32_t b, bool external)
{
    struct workspace *w = &mpm->workspaces[threads_self()];
    struct chunk chunk = {.block = &mpm->cells->blocks[b], .block_index = b, .workspace = w};
    grid_read_patch(mpm->grid, b, NODE_MOMENTUM, 6, w->patch);
    if (mpm->scene->averages_volume)
        average_volume_change(mpm, chunk, values_of(w, PATCH_VELOCITY));
    while (chunk_next(mpm, &chunk)) {
        velocity_chunk(mpm, &chunk, false, false, external, false);
        gather_gradient(&chunk, values_of(w, PATCH_VELOCITY), mpm->time_step / mpm->cells->frame.size);
        if (mpm->scene->averages_volume)
            use_average(&chunk);
        stress_update(mpm, &chunk);
        gather_values(&chunk, values_of(w, PATCH_VELOCITY));
        motion_move(mpm, &chunk);
    }
}

#endif
