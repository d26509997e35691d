/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Staggered grid (spec 9.3): particles exchange with auxiliary points at the cell centres, and these
 * with the nodes around them. Centres are numbered like cells and kept in blocks like nodes.
 *
 * Along an axis a particle lies between two neighbouring centres, at eta = -1 ... 1. Near a wall (its
 * nearest node is in one of the two layers that a boundary code marks) it goes to one of them whole;
 * what it gathers there is interpolated between the wall and the centre. */
#include "base/threads.h"
#include "mpm/chunk.h"

#include <math.h>
#include <string.h>

/* What a centre holds. */
enum centre_field {
    CENTRE_MASS,
    CENTRE_MOMENTUM,
    CENTRE_LOAD = CENTRE_MOMENTUM + 3,
    CENTRE_STRESS = CENTRE_LOAD + 3, /* volume times stress over cell size, negative; by rows */
    CENTRE_SUMMED = CENTRE_STRESS + 9,
    CENTRE_VELOCITY = CENTRE_SUMMED,
    CENTRE_ACCELERATION = CENTRE_VELOCITY + 3,
    CENTRE_GRADIENT = CENTRE_ACCELERATION + 3, /* of the straining velocity, times cell size; by rows */
    CENTRE_FIELDS = CENTRE_GRADIENT + 9
};

enum { EDGE = BLOCK_EDGE + 2, PATCH_NODES = 216, PAIR = 2, MOMENTUM_FIELDS = 4, FORCE_FIELDS = 12 };

static struct grid *open_centres(const struct mpm *mpm)
{
    const struct grid_form form = {.low = 1, .high = 1, .fields = CENTRE_FIELDS, .patch_fields = CENTRE_SUMMED};
    return grid_open(mpm->cells, form, mpm->scene->boundary, mpm->scene->mass_cutoff);
}

/* --- weights --- */

/* Whether a boundary code marks node layer i along an axis. */
static bool is_marked(const struct mpm *mpm, int a, int32_t i)
{
    const int32_t last = mpm->grid->nodes[a] - 1;
    return (mpm->scene->boundary[2 * a] != 0 && i <= 1) || (mpm->scene->boundary[2 * a + 1] != 0 && i >= last - 1);
}

/* Where a coordinate lies among the centres of an axis. */
struct staggered_place {
    int32_t cell; /* lower one of the two centres */
    double give;  /* -1 ... 1: coordinate with which the particle gives to them */
    double take;  /* and with which it takes from them */
};

static struct staggered_place find_place(const struct mpm *mpm, int a, double x)
{
    const struct cell_frame *frame = &mpm->cells->frame;
    const double way = (x - frame->low[a]) / frame->size;
    if (frame->cells[a] == 1) /* one layer carries all (spec 9.3) */
        return (struct staggered_place){0, -1, -1};
    const int32_t nearest = (int32_t)(way + 0.5), cell = (int32_t)(way - 0.5);
    struct staggered_place place = {cell, 2 * (way - nearest), 0};
    place.take = place.give;
    if (is_marked(mpm, a, nearest)) {
        double natural = 2 * (way - floor(fmin(way, frame->cells[a] - 1))) - 1;
        place.take = natural < 0 ? 1 + 2 * natural : 2 * natural - 1;
        place.give = place.give > 0 ? 1 : place.give < 0 ? -1 : 0;
    }
    return place;
}

double staggered_shift(const struct mpm *mpm, int a, double x)
{
    const struct staggered_place place = find_place(mpm, a, x);
    return place.cell + 1 + 0.5 * place.give - (x - mpm->cells->frame.low[a]) / mpm->cells->frame.size;
}

/* Base centre and pairs of weights of the chunk's particles: to give in `weight`, to take in `slope`. */
static void find_weights(const struct mpm *mpm, const struct chunk *chunk)
{
    static const int stride[3] = {1, EDGE, EDGE * EDGE};
    struct workspace *w = chunk->workspace;
    for (int32_t j = 0; j < chunk->count; j++) {
        w->base[j] = 1 + EDGE + EDGE * EDGE;
        for (int a = 0; a < 3; a++) {
            struct staggered_place place = find_place(mpm, a, mpm->store->real[mpm->place][a][chunk->order[j]]);
            bool ends = place.cell + 1 >= mpm->cells->frame.cells[a]; /* the upper centre does not exist */
            w->base[j] += (place.cell - chunk->block->at[a] * BLOCK_EDGE) * stride[a];
            w->weight[a][0][j] = 0.5 * (1 - place.give);
            w->weight[a][1][j] = ends ? 0 : 0.5 * (1 + place.give);
            w->slope[a][0][j] = 0.5 * (1 - place.take);
            w->slope[a][1][j] = ends ? 0 : 0.5 * (1 + place.take);
        }
    }
}

/* Weight and place of centre i (of 8) of particle j. */
static inline double corner_weight(double weight[3][3][CHUNK_ROOM], int32_t j, int i)
{
    return weight[0][i & 1][j] * weight[1][i >> 1 & 1][j] * weight[2][i >> 2][j];
}

static inline int corner_place(const struct workspace *w, int32_t j, int i)
{
    return w->base[j] + (i & 1) + EDGE * ((i >> 1 & 1) + EDGE * (i >> 2));
}

/* --- particles to centres --- */

static void give(struct workspace *w, int32_t j, double *patch, const double *values, int fields)
{
    for (int i = 0; i < 8; i++) {
        double weight = corner_weight(w->weight, j, i);
        double *place = patch + corner_place(w, j, i);
        for (int f = 0; f < fields && weight != 0; f++)
            place[f * PATCH_NODES] += weight * values[f];
    }
}

static void give_particle(const struct mpm *mpm, struct workspace *w, int32_t j, size_t p, double *patch, bool momentum,
                          bool force)
{
    const struct store *store = mpm->store;
    double values[MOMENTUM_FIELDS + FORCE_FIELDS], *next = values;
    if (momentum) {
        double mass = *next++ = store->real[COLUMN_MASS][0][p];
        for (int a = 0; a < 3; a++)
            *next++ = mass * store->real[COLUMN_VELOCITY][a][p];
    }
    if (force) {
        double load[3] = {0}, stress[3][3];
        if (mpm->has_external_force)
            mpm_external_force(mpm, p, load);
        mpm_force_stress(mpm, p, FORCE_ANY, stress);
        for (int a = 0; a < 3; a++)
            *next++ = load[a];
        for (int a = 0; a < 9; a++)
            *next++ = stress[a / 3][a % 3];
    }
    give(w, j, patch, values, (int)(next - values));
}

static void scatter(struct mpm *mpm, int32_t b, bool momentum, bool force)
{
    struct workspace *w = &mpm->workspaces[threads_self()];
    struct chunk chunk = {.block = &mpm->cells->blocks[b], .block_index = b, .workspace = w};
    double *patch = grid_patch(mpm->centres, b, 0);
    int fields = MOMENTUM_FIELDS * momentum + FORCE_FIELDS * force;
    memset(patch, 0, (size_t)fields * PATCH_NODES * sizeof *patch);
    while (chunk_next(mpm, &chunk)) {
        find_weights(mpm, &chunk);
        for (int32_t j = 0; j < chunk.count; j++)
            give_particle(mpm, w, j, (size_t)chunk.order[j], patch, momentum, force);
    }
}

/* --- centres to nodes and back --- */

/* The block and the place in it that lie d (-1, 0 or 1 along each axis) from place n of block b;
 * -1 where there is none. */
static int32_t beside(const struct grid *grid, int32_t b, int n, const int d[3], int *place)
{
    int neighbour = 0, index = 0;
    for (int a = 2; a >= 0; a--) {
        int i = (n >> (2 * a) & 3) + d[a], offset = i < 0 ? -1 : i >= BLOCK_EDGE ? 1 : 0;
        neighbour = 3 * neighbour + offset + 1;
        index = BLOCK_EDGE * index + i - BLOCK_EDGE * offset;
    }
    *place = index;
    return grid->cells->blocks[b].neighbour[neighbour];
}

/* Cell or node coordinates of place n of block b. */
static void coordinates(const struct grid *grid, int32_t b, int n, int32_t at[3])
{
    for (int a = 0; a < 3; a++)
        at[a] = grid->cells->blocks[b].at[a] * BLOCK_EDGE + (n >> (2 * a) & 3);
}

static bool is_cell(const struct mpm *mpm, const int32_t at[3])
{
    for (int a = 0; a < 3; a++)
        if (at[a] < 0 || at[a] >= mpm->cells->frame.cells[a])
            return false;
    return true;
}

/* Mass and momentum of a node from the eight centres around it, the light ones left out; or, for
 * the remapped momentum, from all of them into the straining field. */
static void node_momentum(const struct mpm *mpm, int32_t b, int n, bool remaps)
{
    double sum[4] = {0};
    for (int i = 0; i < 8; i++) {
        int place, d[3] = {(i & 1) - 1, (i >> 1 & 1) - 1, (i >> 2) - 1};
        int32_t source = beside(mpm->grid, b, n, d, &place);
        if (source < 0 || (!remaps && !(grid_field(mpm->centres, source, CENTRE_MASS)[place] > mpm->grid->mass_cutoff)))
            continue;
        for (int f = remaps; f < 4; f++)
            sum[f] += 0.125 * grid_field(mpm->centres, source, CENTRE_MASS + f)[place];
    }
    if (!remaps)
        grid_field(mpm->grid, b, NODE_MASS)[n] = sum[0];
    for (int a = 0; a < 3; a++)
        grid_field(mpm->grid, b, (remaps ? NODE_STRAINING : NODE_MOMENTUM) + a)[n] = sum[1 + a];
}

/* Force of a node: its tractions, an eighth of the loads, and the stress times the node's gradient at each centre. */
static void node_force(const struct mpm *mpm, int32_t b, int n)
{
    double sum[3] = {0};
    for (int a = 0; a < 3 && mpm->n_faces > 0; a++)
        sum[a] = grid_field(mpm->grid, b, NODE_STRAINING + a)[n];
    for (int i = 0; i < 8; i++) {
        int place, d[3] = {(i & 1) - 1, (i >> 1 & 1) - 1, (i >> 2) - 1};
        int32_t source = beside(mpm->grid, b, n, d, &place);
        if (source < 0)
            continue;
        for (int a = 0; a < 3; a++) {
            sum[a] += 0.125 * grid_field(mpm->centres, source, CENTRE_LOAD + a)[place];
            for (int k = 0; k < 3; k++) /* the node is on the upper side of a centre below it */
                sum[a] += (d[k] < 0 ? 0.25 : -0.25) * grid_field(mpm->centres, source, CENTRE_STRESS + 3 * a + k)[place];
        }
    }
    for (int a = 0; a < 3; a++)
        grid_field(mpm->grid, b, NODE_FORCE + a)[n] = sum[a];
}

/* A node value evaluated by trilinear functions at a point of a cell, -1 ... 1 along each axis. */
static double value_in_cell(const struct mpm *mpm, int32_t b, int n, int field, const double local[3])
{
    double sum = 0;
    for (int i = 0; i < 8; i++) {
        int place, d[3] = {i & 1, i >> 1 & 1, i >> 2};
        int32_t source = beside(mpm->grid, b, n, d, &place);
        double weight = 0.125 * (1 + (2 * d[0] - 1) * local[0]) * (1 + (2 * d[1] - 1) * local[1])
                      * (1 + (2 * d[2] - 1) * local[2]);
        if (source >= 0 && weight != 0)
            sum += weight * grid_field(mpm->grid, source, field)[place];
    }
    return sum;
}

/* The point of a cell where a centre takes its values: the middle, or in the outermost layer at a
 * wall its inner face (spec 9.3, boundary). */
static void centre_point(const struct mpm *mpm, const int32_t cell[3], double point[3])
{
    bool is_wall = false;
    const int32_t *cells = mpm->cells->frame.cells;
    for (int a = 0; a < 3; a++)
        point[a] = 0;
    for (int a = 0; a < 3; a++) {
        bool low = mpm->scene->boundary[2 * a] != 0 && cell[a] == 0;
        bool high = mpm->scene->boundary[2 * a + 1] != 0 && cell[a] == cells[a] - 1;
        if (cells[a] > 1 && (low || high)) {
            is_wall = true;
            point[a] = low ? 1 : -1;
        }
    }
    for (int a = 0; a < 3 && is_wall; a++)
        if (cells[a] > 1 && point[a] == 0)
            point[a] = cell[a] == 0 ? 1 : cell[a] == cells[a] - 1 ? -1 : 0;
}

/* Velocity and acceleration at the centres of a block. */
static void centre_motion(const struct mpm *mpm, int32_t b)
{
    for (int n = 0; n < BLOCK_CELLS; n++) {
        int32_t cell[3];
        double point[3];
        coordinates(mpm->centres, b, n, cell);
        if (!is_cell(mpm, cell))
            continue;
        centre_point(mpm, cell, point);
        for (int f = 0; f < 6; f++)
            grid_field(mpm->centres, b, CENTRE_VELOCITY + f)[n] = value_in_cell(mpm, b, n, NODE_MOMENTUM + f, point);
    }
}

/* Gradient of the straining velocity at the centres of a block. */
static void centre_gradient(const struct mpm *mpm, int32_t b)
{
    for (int n = 0; n < BLOCK_CELLS; n++) {
        double sum[9] = {0};
        for (int i = 0; i < 8; i++) {
            int place, d[3] = {i & 1, i >> 1 & 1, i >> 2};
            int32_t source = beside(mpm->grid, b, n, d, &place);
            for (int f = 0; f < 9 && source >= 0; f++)
                sum[f] += (d[f % 3] ? 0.25 : -0.25) * grid_field(mpm->grid, source, mpm->straining_field + f / 3)[place];
        }
        for (int f = 0; f < 9; f++)
            grid_field(mpm->centres, b, CENTRE_GRADIENT + f)[n] = sum[f];
    }
}

/* Runs `pass` on the blocks of nodes and centres. */
static void each_block(const struct mpm *mpm, void (*pass)(const struct mpm *mpm, int32_t b))
{
    const int32_t blocks = mpm->cells->n_blocks;
#pragma omp parallel for schedule(static) if (blocks >= mpm->grid->shared_blocks)
    for (int32_t b = 0; b < blocks; b++)
        pass(mpm, b);
}

static void all_momentum(const struct mpm *mpm, int32_t b)
{
    for (int n = 0; n < BLOCK_CELLS; n++)
        node_momentum(mpm, b, n, false);
}

static void all_remapped(const struct mpm *mpm, int32_t b)
{
    for (int n = 0; n < BLOCK_CELLS; n++)
        node_momentum(mpm, b, n, true);
    grid_straining_block(mpm->grid, b, NODE_STRAINING);
}

static void all_integrated(const struct mpm *mpm, int32_t b)
{
    for (int n = 0; n < BLOCK_CELLS; n++)
        node_force(mpm, b, n);
    grid_integrate_block(mpm->grid, b, mpm->time_step * mpm->momentum_factor);
}

static void all_straining(const struct mpm *mpm, int32_t b)
{
    grid_straining_block(mpm->grid, b, NODE_MOMENTUM);
}

static void collect_momentum(const struct mpm *mpm, int32_t b)
{
    grid_collect(mpm->centres, b, CENTRE_MASS, MOMENTUM_FIELDS, 0);
}

static void collect_force(const struct mpm *mpm, int32_t b)
{
    grid_collect(mpm->centres, b, CENTRE_LOAD, FORCE_FIELDS, 0);
}

static void collect_all(const struct mpm *mpm, int32_t b)
{
    grid_collect(mpm->centres, b, CENTRE_MASS, MOMENTUM_FIELDS + FORCE_FIELDS, 0);
}

/* Tractions of faces, for node_force. */
static void collect_tractions(const struct mpm *mpm, int32_t b)
{
    grid_collect(mpm->grid, b, NODE_STRAINING, 3, 0);
}

static void collect_all_tractions(const struct mpm *mpm, int32_t b)
{
    grid_collect(mpm->grid, b, NODE_STRAINING, 3, NODE_FORCE - NODE_MASS);
}

static void collect_remapped(const struct mpm *mpm, int32_t b)
{
    grid_collect(mpm->centres, b, CENTRE_MOMENTUM, 3, 0);
}

/* Spec 6 B: node velocities before the update strain the particles. */
static void strain_first(struct mpm *mpm)
{
    each_block(mpm, collect_momentum);
    each_block(mpm, all_momentum);
    each_block(mpm, all_straining);
    each_block(mpm, centre_gradient);
}

static void integrate(struct mpm *mpm, bool with_momentum)
{
    each_block(mpm, with_momentum ? collect_all : collect_force);
    if (mpm->n_faces > 0)
        each_block(mpm, with_momentum ? collect_all_tractions : collect_tractions);
    if (with_momentum)
        each_block(mpm, all_momentum);
    each_block(mpm, all_integrated);
    each_block(mpm, centre_motion);
}

static void strain_last(struct mpm *mpm)
{
    if (mpm->scene->scheme == SCHEME_MUSL) {
        each_block(mpm, collect_remapped);
        each_block(mpm, all_remapped);
    }
    each_block(mpm, centre_gradient);
}

/* --- centres to particles --- */

/* Evaluates three fields at the chunk's particles, into workspace.gathered. */
static void take(const struct chunk *chunk, const double *fields)
{
    struct workspace *w = chunk->workspace;
    for (int32_t j = 0; j < chunk->count; j++) {
        double sum[3] = {0};
        for (int i = 0; i < 8; i++) {
            double weight = corner_weight(w->slope, j, i);
            for (int a = 0; a < 3 && weight != 0; a++)
                sum[a] += weight * fields[a * PATCH_NODES + corner_place(w, j, i)];
        }
        for (int a = 0; a < 3; a++)
            w->gathered[a][j] = sum[a];
    }
}

static void take_gradient(const struct chunk *chunk, const double *fields, double scale)
{
    struct workspace *w = chunk->workspace;
    for (int32_t j = 0; j < chunk->count; j++) {
        double g[3][3] = {{0}};
        for (int i = 0; i < 8; i++) {
            double weight = scale * corner_weight(w->weight, j, i);
            for (int f = 0; f < 9 && weight != 0; f++)
                g[f / 3][f % 3] += weight * fields[f * PATCH_NODES + corner_place(w, j, i)];
        }
        chunk_set_gradient(w, j, g);
    }
}

static void gather_velocity(struct mpm *mpm, int32_t b)
{
    struct workspace *w = &mpm->workspaces[threads_self()];
    struct chunk chunk = {.block = &mpm->cells->blocks[b], .block_index = b, .workspace = w};
    const bool remaps = mpm->scene->scheme == SCHEME_MUSL, moves = mpm->scene->scheme == SCHEME_USF;
    double *patch = grid_patch(mpm->centres, b, 0);
    const double *velocities = w->patch, *accelerations = w->patch + 3 * PATCH_NODES;
    grid_read_patch(mpm->centres, b, CENTRE_VELOCITY, 6, w->patch);
    if (remaps)
        memset(patch, 0, 3 * PATCH_NODES * sizeof *patch);
    while (chunk_next(mpm, &chunk)) {
        double *velocity[3];
        for (int a = 0; a < 3; a++)
            velocity[a] = chunk_read(&chunk, mpm->store->real[COLUMN_VELOCITY][a], w->copy[3 + a]);
        const double *mass = chunk_read(&chunk, mpm->store->real[COLUMN_MASS][0], w->copy[6]);
        find_weights(mpm, &chunk);
        if (mpm->has_external_force) {
            take(&chunk, velocities);
            motion_work(mpm, &chunk);
        }
        if (mpm->scene->transfer != TRANSFER_FLIP) {
            take(&chunk, velocities);
            motion_blend(mpm, &chunk, velocity);
        }
        take(&chunk, accelerations);
        motion_accelerate(mpm, &chunk, velocity, mass);
        for (int32_t j = 0; j < chunk.count && remaps; j++) {
            double momentum[3] = {mass[j] * velocity[0][j], mass[j] * velocity[1][j], mass[j] * velocity[2][j]};
            give(w, j, patch, momentum, 3);
        }
        if (moves) {
            take(&chunk, velocities);
            motion_move(mpm, &chunk);
        }
    }
}

static void gather_strain(struct mpm *mpm, int32_t b)
{
    struct workspace *w = &mpm->workspaces[threads_self()];
    struct chunk chunk = {.block = &mpm->cells->blocks[b], .block_index = b, .workspace = w};
    const bool moves = mpm->scene->scheme != SCHEME_USF;
    if (moves)
        grid_read_patch(mpm->centres, b, CENTRE_VELOCITY, 3, w->patch);
    grid_read_patch(mpm->centres, b, CENTRE_GRADIENT, 9, w->patch + 3 * PATCH_NODES);
    while (chunk_next(mpm, &chunk)) {
        find_weights(mpm, &chunk);
        take_gradient(&chunk, w->patch + 3 * PATCH_NODES, mpm->time_step / mpm->cells->frame.size);
        stress_update(mpm, &chunk);
        if (moves) {
            take(&chunk, w->patch);
            motion_move(mpm, &chunk);
        }
    }
}

/* --- smoothed pressure --- */

static void smooth_give(struct mpm *mpm, int32_t b)
{
    struct workspace *w = &mpm->workspaces[threads_self()];
    struct chunk chunk = {.block = &mpm->cells->blocks[b], .block_index = b, .workspace = w};
    double *patch = grid_patch(mpm->centres, b, 0);
    memset(patch, 0, 2 * PATCH_NODES * sizeof *patch);
    while (chunk_next(mpm, &chunk)) {
        find_weights(mpm, &chunk);
        for (int32_t j = 0; j < chunk.count; j++) {
            double volume = smoothing_volume(mpm, (size_t)chunk.order[j]);
            double values[2] = {volume * store_pressure(mpm->store, (size_t)chunk.order[j]), volume};
            give(w, j, patch, values, 2);
        }
    }
}

static void collect_pressure(const struct mpm *mpm, int32_t b)
{
    grid_collect(mpm->centres, b, CENTRE_MOMENTUM, 2, 0);
}

/* Sums of a node from the centres around it, divided. */
static void node_pressure(const struct mpm *mpm, int32_t b)
{
    for (int n = 0; n < BLOCK_CELLS; n++) {
        double sum[2] = {0};
        for (int i = 0; i < 8; i++) {
            int place, d[3] = {(i & 1) - 1, (i >> 1 & 1) - 1, (i >> 2) - 1};
            int32_t source = beside(mpm->grid, b, n, d, &place);
            for (int f = 0; f < 2 && source >= 0; f++)
                sum[f] += 0.125 * grid_field(mpm->centres, source, CENTRE_MOMENTUM + f)[place];
        }
        bool counts = sum[1] > 0 && grid_field(mpm->grid, b, NODE_MASS)[n] > mpm->grid->mass_cutoff;
        grid_field(mpm->grid, b, NODE_STRAINING)[n] = counts ? sum[0] / sum[1] : 0;
    }
}

static void centre_pressure(const struct mpm *mpm, int32_t b)
{
    static const double middle[3] = {0, 0, 0};
    for (int n = 0; n < BLOCK_CELLS; n++)
        grid_field(mpm->centres, b, CENTRE_VELOCITY)[n] = value_in_cell(mpm, b, n, NODE_STRAINING, middle);
}

static void smooth_nodes(struct mpm *mpm)
{
    each_block(mpm, collect_pressure);
    each_block(mpm, node_pressure);
    each_block(mpm, centre_pressure);
}

static void smooth_take(struct mpm *mpm, int32_t b)
{
    struct workspace *w = &mpm->workspaces[threads_self()];
    struct chunk chunk = {.block = &mpm->cells->blocks[b], .block_index = b, .workspace = w};
    grid_read_patch(mpm->centres, b, CENTRE_VELOCITY, 1, w->patch);
    while (chunk_next(mpm, &chunk)) {
        find_weights(mpm, &chunk);
        for (int32_t j = 0; j < chunk.count; j++) {
            double sum = 0;
            for (int i = 0; i < 8; i++)
                sum += corner_weight(w->weight, j, i) * w->patch[corner_place(w, j, i)];
            mpm->store->real[COLUMN_SMOOTHED_PRESSURE][0][chunk.order[j]] = sum;
        }
    }
}

const struct shape shape_staggered = {
    .name = "sgmp",
    .reach = 1,
    .scatter = scatter,
    .gather_velocity = gather_velocity,
    .gather_strain = gather_strain,
    .open_centres = open_centres,
    .strain_first = strain_first,
    .integrate = integrate,
    .strain_last = strain_last,
    .smooth_give = smooth_give,
    .smooth_nodes = smooth_nodes,
    .smooth_take = smooth_take,
    .smooths_at_start = true,
};
