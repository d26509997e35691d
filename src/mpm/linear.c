/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Trilinear shape functions: the passes over blocks, one for each set of features that a scene may
 * have, so that a scene pays only for its own. */
#include "mpm/linear.h"

THREADS_VECTORISED
static void scatter_stress(struct mpm *mpm, int32_t b)
{
    scatter_block(mpm, b, true, true, false, false, false, FORCE_STRESS);
}

THREADS_VECTORISED
static void scatter_viscous(struct mpm *mpm, int32_t b)
{
    scatter_block(mpm, b, true, true, false, false, false, FORCE_VISCOUS);
}

THREADS_VECTORISED
static void scatter_any(struct mpm *mpm, int32_t b)
{
    scatter_block(mpm, b, true, true, false, false, false, FORCE_ANY);
}

THREADS_VECTORISED
static void scatter_all_external(struct mpm *mpm, int32_t b)
{
    scatter_block(mpm, b, true, true, true, false, false, FORCE_ANY);
}

THREADS_VECTORISED
static void scatter_momentum(struct mpm *mpm, int32_t b)
{
    scatter_block(mpm, b, true, false, false, false, false, FORCE_ANY);
}

THREADS_VECTORISED
static void scatter_force(struct mpm *mpm, int32_t b)
{
    scatter_block(mpm, b, false, true, true, false, false, FORCE_ANY);
}

THREADS_VECTORISED
static void scatter_contact(struct mpm *mpm, int32_t b, bool momentum)
{
    scatter_block(mpm, b, momentum, true, true, true, true, FORCE_ANY);
}

THREADS_VECTORISED
static void scatter_special(struct mpm *mpm, int32_t b, bool momentum, bool force)
{
    scatter_block(mpm, b, momentum, force, true, false, true, FORCE_ANY);
}

/* Momentum and force, and nothing else. */
static void scatter_all(struct mpm *mpm, int32_t b)
{
    static void (*const passes[])(struct mpm *, int32_t) = {
        [FORCE_STRESS] = scatter_stress, [FORCE_VISCOUS] = scatter_viscous, [FORCE_ANY] = scatter_any};
    passes[mpm_force_parts(mpm)](mpm, b);
}

static void scatter(struct mpm *mpm, int32_t b, bool momentum, bool force)
{
    bool is_special = mpm->scene->transfer == TRANSFER_AFFINE || mpm->scene->averages_volume;
    if (is_special && !mpm->contact)
        scatter_special(mpm, b, momentum, force);
    else if (is_special && !force)
        scatter_special(mpm, b, true, false);
    else if (!force)
        scatter_momentum(mpm, b);
    else if (mpm->contact)
        scatter_contact(mpm, b, momentum);
    else if (!momentum)
        scatter_force(mpm, b);
    else if (mpm->has_external_force)
        scatter_all_external(mpm, b);
    else
        scatter_all(mpm, b);
}

THREADS_VECTORISED
static void velocity_usf(struct mpm *mpm, int32_t b)
{
    velocity_block(mpm, b, true, false, true, false);
}

THREADS_VECTORISED
static void all_usl(struct mpm *mpm, int32_t b)
{
    usl_block(mpm, b, false);
}

THREADS_VECTORISED
static void all_usl_external(struct mpm *mpm, int32_t b)
{
    usl_block(mpm, b, true);
}

THREADS_VECTORISED
static void velocity_musl(struct mpm *mpm, int32_t b)
{
    velocity_block(mpm, b, false, true, false, false);
}

THREADS_VECTORISED
static void velocity_musl_external(struct mpm *mpm, int32_t b)
{
    velocity_block(mpm, b, false, true, true, false);
}

THREADS_VECTORISED
static void velocity_blend(struct mpm *mpm, int32_t b)
{
    velocity_block(mpm, b, mpm->scene->scheme == SCHEME_USF, mpm->scene->scheme == SCHEME_MUSL, true, true);
}

static void gather_velocity(struct mpm *mpm, int32_t b)
{
    if (mpm->scene->transfer != TRANSFER_FLIP)
        velocity_blend(mpm, b);
    else if (mpm->scene->scheme == SCHEME_USF)
        velocity_usf(mpm, b);
    else if (mpm->strains_at_once && mpm->has_external_force)
        all_usl_external(mpm, b);
    else if (mpm->strains_at_once)
        all_usl(mpm, b);
    else if (mpm->has_external_force)
        velocity_musl_external(mpm, b);
    else
        velocity_musl(mpm, b);
}

THREADS_VECTORISED
static void strain_only(struct mpm *mpm, int32_t b)
{
    strain_block(mpm, b, false);
}

THREADS_VECTORISED
static void strain_and_move(struct mpm *mpm, int32_t b)
{
    strain_block(mpm, b, true);
}

static void gather_strain(struct mpm *mpm, int32_t b)
{
    if (mpm->moves_last)
        strain_and_move(mpm, b);
    else
        strain_only(mpm, b);
}

/* --- smoothed pressure --- */

static void smooth_give(struct mpm *mpm, int32_t b)
{
    struct workspace *w = &mpm->workspaces[threads_self()];
    struct chunk chunk = {.block = &mpm->cells->blocks[b], .block_index = b, .workspace = w};
    double(*patch)[PATCH_NODES] = patch_of(mpm, b);
    memset(patch, 0, 2 * sizeof *patch);
    while (chunk_next(mpm, &chunk)) {
        double *position[3];
        for (int a = 0; a < 3; a++)
            position[a] = chunk_read(&chunk, mpm->store->real[mpm->place][a], w->copy[a]);
        find_local(mpm, &chunk, position);
        for (struct cell_walk walk = {0}; walk_next(&chunk, &walk);)
            for (int32_t j = walk.from; j < walk.to; j++)
                for (int i = 0; i < 8; i++) {
                    double volume = smoothing_volume(mpm, (size_t)chunk.order[j]);
                    double weight = (i & 1 ? w->local[0][j] : 1 - w->local[0][j])
                                  * (i & 2 ? w->local[1][j] : 1 - w->local[1][j])
                                  * (i & 4 ? w->local[2][j] : 1 - w->local[2][j]);
                    int node = grid_patch_corner(walk.cell, PATCH_EDGE, PATCH_EDGE, 0) + corner_offset[i >> 2][i & 3];
                    patch[0][node] += weight * volume * store_pressure(mpm->store, (size_t)chunk.order[j]);
                    patch[1][node] += weight * volume;
                }
    }
}

static void smooth_take(struct mpm *mpm, int32_t b)
{
    struct workspace *w = &mpm->workspaces[threads_self()];
    struct chunk chunk = {.block = &mpm->cells->blocks[b], .block_index = b, .workspace = w};
    grid_read_patch(mpm->grid, b, NODE_STRAINING, 3, values_of(w, 0)[0]);
    while (chunk_next(mpm, &chunk)) {
        double *position[3];
        for (int a = 0; a < 3; a++)
            position[a] = chunk_read(&chunk, mpm->store->real[mpm->place][a], w->copy[a]);
        find_local(mpm, &chunk, position);
        gather_values(&chunk, values_of(w, 0));
        for (int32_t j = 0; j < chunk.count; j++)
            mpm->store->real[COLUMN_SMOOTHED_PRESSURE][0][chunk.order[j]] = w->gathered[0][j];
    }
}

const struct shape shape_linear = {
    .name = "linear",
    .scatter = scatter,
    .gather_velocity = gather_velocity,
    .gather_strain = gather_strain,
    .smooth_give = smooth_give,
    .smooth_take = smooth_take,
    .smooths_at_start = true,
};
