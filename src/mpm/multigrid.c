/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mpm/multigrid.h"
#include "base/memory.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Unknowns that are solved for directly; steps of a smoothing; the part of the spectrum that it takes
 * out, from the bound of the eigenvalues down; iterations for that bound, and what is put on top. */
enum { COARSEST_UNKNOWNS = 500, SMOOTHING_STEPS = 2, BOUND_ITERATIONS = 12 };
static const double SMOOTHED_PART = 16, BOUND_MARGIN = 1.1;

enum { VECTOR = STIFFNESS_VECTOR, PATCH = STIFFNESS_PATCH, EDGE = BLOCK_EDGE + 1 };

void multigrid_close(struct multigrid *multigrid)
{
    for (int l = 0; l < MULTIGRID_LEVELS; l++) {
        struct multigrid_level *level = &multigrid->level[l];
        stiffness_close(&level->stiffness);
        memory_free(level->child);
        memory_free(level->parent);
        memory_free(level->residual);
        memory_free(level->step);
        memory_free(level->image);
        memory_free(level->source);
        memory_free(level->solution);
    }
    envelope_close(&multigrid->coarsest);
    memory_free(multigrid->unknown);
}

static size_t length_of(const struct multigrid_level *level)
{
    return (size_t)level->stiffness.n_blocks * VECTOR;
}

size_t multigrid_count(const struct multigrid *multigrid)
{
    return length_of(&multigrid->level[0]);
}

static void make_vectors(struct multigrid_level *level, bool is_coarse)
{
    const size_t length = length_of(level), real = sizeof(double);
    const char *purpose = "levels of the stiffness";
    level->residual = memory_grow(level->residual, &level->residual_capacity, length, real, purpose);
    level->step = memory_grow(level->step, &level->step_capacity, length, real, purpose);
    level->image = memory_grow(level->image, &level->image_capacity, length, real, purpose);
    if (!is_coarse)
        return;
    level->source = memory_grow(level->source, &level->source_capacity, length, real, purpose);
    level->solution = memory_grow(level->solution, &level->solution_capacity, length, real, purpose);
}

/* --- blocks of a coarser level --- */

static int by_place(const void *left, const void *right)
{
    const struct stiffness_block *a = left, *b = right;
    for (int axis = 2; axis >= 0; axis--)
        if (a->at[axis] != b->at[axis])
            return a->at[axis] < b->at[axis] ? -1 : 1;
    return 0;
}

/* The block at a place among the sorted `blocks`, or -1. */
static int32_t find_block(const struct stiffness_block *blocks, int32_t count, const int32_t at[3])
{
    struct stiffness_block wanted = {.at = {at[0], at[1], at[2]}};
    const struct stiffness_block *found = bsearch(&wanted, blocks, (size_t)count, sizeof *blocks, by_place);
    return found ? (int32_t)(found - blocks) : -1;
}

/* Sorts and leaves out what is there twice. */
static int32_t sort_blocks(struct stiffness_block *blocks, int32_t count)
{
    int32_t kept = 0;
    qsort(blocks, (size_t)count, sizeof *blocks, by_place);
    for (int32_t b = 0; b < count; b++)
        if (kept == 0 || by_place(&blocks[kept - 1], &blocks[b]) != 0)
            blocks[kept++] = blocks[b];
    return kept;
}

/* Blocks whose cells hold those of the finer level, and the ones above them that share their nodes. All count
 * as blocks with cells, as all take part when values of the finer level are summed. */
static void list_blocks(struct stiffness *coarse, const struct stiffness *fine)
{
    coarse->layout = fine->layout;
    coarse->size = 2 * fine->size;
    coarse->sets = fine->averages_volume ? 3 : fine->sets;
    coarse->lame = coarse->sets == 1 ? fine->lame : 1;
    coarse->shear = coarse->sets == 1 ? fine->shear : 1;
    const char *purpose = "levels of the stiffness";
    const size_t size = sizeof *coarse->blocks;
    coarse->blocks = memory_grow(coarse->blocks, &coarse->blocks_capacity, (size_t)fine->active, size, purpose);
    int32_t parents = 0;
    for (int32_t b = 0; b < fine->active; b++) {
        const int32_t *at = fine->blocks[b].at;
        if (fine->blocks[b].rows)
            coarse->blocks[parents++] = (struct stiffness_block){.at = {at[0] / 2, at[1] / 2, at[2] / 2}};
    }
    parents = sort_blocks(coarse->blocks, parents);
    coarse->blocks = memory_grow(coarse->blocks, &coarse->blocks_capacity, 8 * (size_t)parents, size, purpose);
    int32_t count = parents;
    for (int32_t b = 0; b < parents; b++)
        for (int i = 1; i < 8; i++) {
            const int32_t *at = coarse->blocks[b].at;
            coarse->blocks[count++] =
                (struct stiffness_block){.at = {at[0] + (i & 1), at[1] + (i >> 1 & 1), at[2] + (i >> 2)}};
        }
    count = sort_blocks(coarse->blocks, count);
    stiffness_open(coarse, count, count);
    for (int32_t b = 0; b < count; b++)
        for (int i = 0; i < BLOCK_NEIGHBOURS; i++) {
            const int32_t *at = coarse->blocks[b].at;
            int32_t place[3] = {at[0] + i % 3 - 1, at[1] + i / 3 % 3 - 1, at[2] + i / 9 - 1};
            coarse->blocks[b].neighbour[i] = find_block(coarse->blocks, count, place);
        }
}

/* Who lies in whom. */
static void link_levels(struct multigrid_level *coarse, struct multigrid_level *fine)
{
    const size_t coarse_blocks = (size_t)coarse->stiffness.n_blocks, fine_blocks = (size_t)fine->stiffness.n_blocks;
    const char *purpose = "levels of the stiffness";
    coarse->child = memory_grow(coarse->child, &coarse->child_capacity, coarse_blocks, sizeof *coarse->child, purpose);
    fine->parent = memory_grow(fine->parent, &fine->parent_capacity, fine_blocks, sizeof *fine->parent, purpose);
    for (size_t b = 0; b < coarse_blocks; b++)
        for (int i = 0; i < 8; i++)
            coarse->child[b][i] = -1;
    for (size_t b = 0; b < fine_blocks; b++) {
        const int32_t *at = fine->stiffness.blocks[b].at;
        const int32_t place[3] = {at[0] / 2, at[1] / 2, at[2] / 2};
        int32_t parent = find_block(coarse->stiffness.blocks, coarse->stiffness.n_blocks, place);
        fine->parent[b] = parent;
        if (parent >= 0)
            coarse->child[parent][at[0] % 2 + 2 * (at[1] % 2) + 4 * (at[2] % 2)] = (int32_t)b;
    }
}

/* --- moments of a coarser level --- */

/* Adds `factor` times the moments of a cell, m(a, b, c) = from[(a + 3 b + 9 c) * 4], to those of a cell twice as
 * large that it is the part `side` of: coordinates there are x / 2 -+ 1/4. */
static void add_moments(const double *from, double factor, const int side[3], double *to)
{
    double m[STIFFNESS_MOMENTS];
    for (int i = 0; i < STIFFNESS_MOMENTS; i++)
        m[i] = 0.25 * factor * from[i * BLOCK_EDGE];
    for (int axis = 0, stride = 1; axis < 3; axis++, stride *= 3) {
        const double middle = side[axis] ? 0.25 : -0.25;
        for (int i = 0; i < STIFFNESS_MOMENTS; i++)
            if (i / stride % 3 == 0) {
                double one = m[i], x = m[i + stride], square = m[i + 2 * stride];
                m[i + stride] = middle * one + 0.5 * x;
                m[i + 2 * stride] = middle * middle * one + middle * x + 0.25 * square;
            }
    }
    for (int i = 0; i < STIFFNESS_MOMENTS; i++)
        to[i * BLOCK_EDGE] += m[i];
}

/* With bbar the bulk modulus of a cell acts on the mean volume change of its particles: on a coarser level, where
 * gradients vary from cell to cell, on that at their centre. Adds such a point to the moments. */
static void add_centre(const double *volume, double bulk, const int side[3], double *to)
{
    double powers[3][3] = {{0}};
    for (int axis = 0, stride = 1; axis < 3; axis++, stride *= 3) {
        double middle = volume[stride * BLOCK_EDGE] / volume[0], x = 0.5 * middle + (side[axis] ? 0.25 : -0.25);
        powers[axis][0] = 1, powers[axis][1] = x, powers[axis][2] = x * x;
    }
    for (int i = 0; i < STIFFNESS_MOMENTS; i++)
        to[i * BLOCK_EDGE] += 0.25 * volume[0] * bulk * powers[0][i % 3] * powers[1][i / 3 % 3] * powers[2][i / 9];
}

/* Adds what cell c of a child has to the moments of its parent's cell: to the same sets, or to more of them where
 * the finer level has one material and the coarser one needs the bulk modulus apart. */
static void add_cell(const struct stiffness *fine, int32_t child, int c, const int side[3], int sets, double *to)
{
    const double *from = fine->moments + (size_t)child * (size_t)fine->sets * STIFFNESS_SET + stiffness_cell(c);
    if (!(from[0] > 0))
        return;
    for (int s = 0; s < sets; s++) {
        const double *set = from + (fine->sets > 1 ? s * STIFFNESS_SET : 0);
        const double factor = s == 0 || fine->sets > 1 ? 1 : s == 1 ? fine->lame : fine->shear;
        add_moments(set, factor, side, to + s * STIFFNESS_SET);
    }
    if (fine->averages_volume)
        add_centre(from, fine->cell_bulk ? fine->cell_bulk[(size_t)child * BLOCK_CELLS + (size_t)c] : fine->bulk, side,
                   to + STIFFNESS_SET);
}

/* Moments of coarse block b from its children. */
static void coarsen_block(struct multigrid_level *coarse, const struct multigrid_level *fine, int32_t b)
{
    const int sets = coarse->stiffness.sets;
    double *to = coarse->stiffness.moments + (size_t)b * (size_t)sets * STIFFNESS_SET;
    memset(to, 0, (size_t)sets * STIFFNESS_SET * sizeof *to);
    for (int i = 0; i < 8; i++) {
        const int32_t child = coarse->child[b][i];
        for (int c = 0; c < BLOCK_CELLS && child >= 0 && child < fine->stiffness.active; c++) {
            const int at[3] = {c % 4 + 4 * (i & 1), c / 4 % 4 + 4 * (i >> 1 & 1), c / 16 + 4 * (i >> 2)};
            const int side[3] = {at[0] % 2, at[1] % 2, at[2] % 2}, cell = at[0] / 2 + 4 * (at[1] / 2) + 16 * (at[2] / 2);
            add_cell(&fine->stiffness, child, c, side, sets, to + stiffness_cell(cell));
        }
    }
}

/* --- between levels --- */

/* Adds the share of each coarse node in the values of fine block's nodes: to the 5 x 5 x 5 nodes of its parent. */
static void restrict_block(const double *fine, const int32_t at[3], double *patch)
{
    const int low[3] = {2 * (at[0] % 2), 2 * (at[1] % 2), 2 * (at[2] % 2)};
    for (int n = 0; n < BLOCK_CELLS; n++) {
        const int i = n % 4, j = n / 4 % 4, k = n / 16;
        for (int corner = 0; corner < 8; corner++) {
            const int x = i & corner & 1, y = j & corner >> 1 & 1, z = k & corner >> 2 & 1;
            if ((corner & 1 && !x) || (corner >> 1 & 1 && !y) || (corner >> 2 && !z))
                continue; /* even nodes lie on coarse ones */
            const double weight = (i & 1 ? 0.5 : 1) * (j & 1 ? 0.5 : 1) * (k & 1 ? 0.5 : 1);
            const int node = low[0] + i / 2 + x + EDGE * (low[1] + j / 2 + y) + EDGE * EDGE * (low[2] + k / 2 + z);
            for (int a = 0; a < 3; a++)
                patch[a * PATCH + node] += weight * fine[a * BLOCK_CELLS + n];
        }
    }
}

/* y = P^T x, the forces of the finer level on the coarser one's nodes; `masked`: on its free ones only. */
static void restrict_vector(const struct multigrid_level *coarse, const struct multigrid_level *fine, const double *x,
                            bool masked, double *y)
{
    const struct stiffness *stiffness = &coarse->stiffness;
#pragma omp parallel for schedule(dynamic, 4) if (stiffness->active >= STIFFNESS_SHARED)
    for (int32_t b = 0; b < stiffness->active; b++) {
        double *patch = stiffness->patch + (size_t)b * 6 * PATCH;
        memset(patch, 0, 3 * PATCH * sizeof *patch);
        for (int i = 0; i < 8; i++) {
            const int32_t child = coarse->child[b][i];
            if (child >= 0)
                restrict_block(x + (size_t)child * VECTOR, fine->stiffness.blocks[child].at, patch);
        }
    }
#pragma omp parallel for schedule(static) if (stiffness->active >= STIFFNESS_SHARED)
    for (int32_t b = 0; b < stiffness->n_blocks; b++)
        stiffness_collect(stiffness, b, y + (size_t)b * VECTOR, masked);
}

/* x += P y on the free nodes of the finer level. */
THREADS_VECTORISED
static void prolong_block(const struct multigrid_level *coarse, const struct multigrid_level *fine, const double *y,
                          int32_t b, double *x)
{
    const struct stiffness_block *block = &fine->stiffness.blocks[b];
    double patch[3 * PATCH];
    stiffness_read(&coarse->stiffness, y, fine->parent[b], patch);
    for (int a = 0; a < 3; a++)
        for (int n = 0; n < BLOCK_CELLS; n++) {
            const int i = n % 4 + 4 * (block->at[0] % 2), j = n / 4 % 4 + 4 * (block->at[1] % 2),
                      k = n / 16 + 4 * (block->at[2] % 2);
            const double *v = patch + a * PATCH + i / 2 + EDGE * (j / 2) + EDGE * EDGE * (k / 2);
            const int dx = i & 1, dy = j & 1 ? EDGE : 0, dz = k & 1 ? EDGE * EDGE : 0;
            double sum = (v[0] + v[dx]) + (v[dy] + v[dx + dy]) + ((v[dz] + v[dx + dz]) + (v[dy + dz] + v[dx + dy + dz]));
            x[a * BLOCK_CELLS + n] += block->free[n] >> a & 1 ? 0.125 * sum : 0;
        }
}

static void prolong_vector(const struct multigrid_level *coarse, const struct multigrid_level *fine, const double *y, double *x)
{
#pragma omp parallel for schedule(static) if (fine->stiffness.active >= STIFFNESS_SHARED)
    for (int32_t b = 0; b < fine->stiffness.n_blocks; b++)
        if (fine->parent[b] >= 0)
            prolong_block(coarse, fine, y, b, x + (size_t)b * VECTOR);
}

/* A coarse node is held where a held node of the finer level takes part of its value: then the coarse
 * fields keep to the boundary conditions, and the coarse stiffness is the restriction of the finer one. */
static void coarsen_boundary(struct multigrid_level *coarse, struct multigrid_level *fine)
{
    double *held = fine->residual, *sum = coarse->residual;
    for (int32_t b = 0; b < fine->stiffness.n_blocks; b++)
        for (int i = 0; i < VECTOR; i++)
            held[(size_t)b * VECTOR + (size_t)i] = fine->stiffness.blocks[b].fixed[i % BLOCK_CELLS] >> i / BLOCK_CELLS & 1;
    restrict_vector(coarse, fine, held, false, sum);
    for (int32_t b = 0; b < coarse->stiffness.n_blocks; b++)
        for (int n = 0; n < BLOCK_CELLS; n++) {
            struct stiffness_block *block = &coarse->stiffness.blocks[b];
            block->fixed[n] = 0;
            for (int a = 0; a < 3; a++)
                block->fixed[n] |= (uint8_t)((sum[(size_t)b * VECTOR + (size_t)(a * BLOCK_CELLS + n)] > 0) << a);
            block->free[n] = 7 & (uint8_t)~block->fixed[n];
        }
}

/* --- smoothing --- */

/* y = K x, on the finest level with the light nodes following: x, which has zeros for them, is changed meanwhile. */
static void apply(const struct multigrid *multigrid, const struct multigrid_level *level, double *x, double *y)
{
    const bool has_light = level == multigrid->level && multigrid->light->count > 0;
    if (has_light)
        light_nodes_follow(multigrid->light, multigrid->fixed, x);
    stiffness_apply(&level->stiffness, x, y);
    if (has_light) {
        light_nodes_clear(multigrid->light, x);
        light_nodes_lead(multigrid->light, multigrid->fixed, y);
    }
}

/* Largest eigenvalue of inverse diagonal times K, by iteration from a vector without pattern. */
static double largest_eigenvalue(const struct multigrid *multigrid, struct multigrid_level *level)
{
    const struct stiffness *stiffness = &level->stiffness;
    const size_t length = length_of(level);
    double *x = level->step, *y = level->image, largest = 0;
    uint32_t random = 12345;
    for (size_t i = 0; i < length; i++) {
        random = random * UINT32_C(1664525) + UINT32_C(1013904223);
        const struct stiffness_block *block = &stiffness->blocks[i / VECTOR];
        bool is_free = block->free[i % BLOCK_CELLS] >> i % VECTOR / BLOCK_CELLS & 1;
        x[i] = is_free ? (double)(random >> 8) / (1 << 24) - 0.5 : 0;
    }
    if (level == multigrid->level)
        light_nodes_clear(multigrid->light, x);
    for (int k = 0; k < BOUND_ITERATIONS; k++) {
        double size = vector_length(x, length);
        if (!(size > 0))
            return 1;
        apply(multigrid, level, x, y);
#pragma omp parallel for schedule(static) if (stiffness->active >= STIFFNESS_SHARED)
        for (int32_t b = 0; b < stiffness->n_blocks; b++)
            stiffness_jacobi(stiffness, b, y + (size_t)b * VECTOR, 1 / size, 0, x + (size_t)b * VECTOR);
        largest = vector_length(x, length);
    }
    return largest;
}

/* Adds to z a polynomial of the Jacobi iteration for K z = residual; with `starts` z is zero before.
 * The residual follows; without `follows` it lacks the last step's. */
static void smooth(const struct multigrid *multigrid, struct multigrid_level *level, double *z, bool starts, bool follows)
{
    const struct stiffness *stiffness = &level->stiffness;
    const double high = level->largest, low = high / SMOOTHED_PART, middle = (high + low) / 2, half = (high - low) / 2;
    double rate = half / middle, factor = 1 / middle, share = 0;
    for (int k = 0; k < SMOOTHING_STEPS + follows; k++) {
        if (k > 0) {
            double next = 1 / (2 * middle / half - rate);
            share = next * rate, factor = 2 * next / half, rate = next;
            apply(multigrid, level, level->step, level->image);
        }
#pragma omp parallel for schedule(static) if (stiffness->active >= STIFFNESS_SHARED)
        for (int32_t b = 0; b < stiffness->n_blocks; b++) {
            const size_t first = (size_t)b * VECTOR;
            double *r = level->residual + first, *step = level->step + first, *to = z + first;
            if (k == 0)
                memset(step, 0, VECTOR * sizeof *step);
            for (int i = 0; i < VECTOR && k > 0; i++)
                r[i] -= level->image[first + (size_t)i];
            if (k == SMOOTHING_STEPS)
                continue;
            stiffness_jacobi(stiffness, b, r, factor, share, step);
            for (int i = 0; i < VECTOR; i++)
                to[i] = k == 0 && starts ? step[i] : to[i] + step[i];
        }
    }
}

/* --- the coarsest level --- */

/* Node of unknown u: its place in the lattice. */
static void place_of(const struct stiffness *stiffness, int32_t place, int32_t node[3])
{
    const int n = place % BLOCK_CELLS;
    const int32_t *at = stiffness->blocks[place / VECTOR].at;
    node[0] = at[0] * BLOCK_EDGE + n % 4;
    node[1] = at[1] * BLOCK_EDGE + n / 4 % 4;
    node[2] = at[2] * BLOCK_EDGE + n / 16;
}

static int32_t count_unknowns(const struct stiffness *stiffness)
{
    int32_t count = 0;
    for (int32_t b = 0; b < stiffness->n_blocks; b++)
        for (int n = 0; n < BLOCK_CELLS; n++)
            count += __builtin_popcount(stiffness->blocks[b].free[n]);
    return count;
}

/* Unknowns are sorted by place, z slowest, the three of a node side by side. */
struct placed {
    int64_t key;
    int32_t place;
};

static int by_key(const void *left, const void *right)
{
    const struct placed *a = left, *b = right;
    return (a->key > b->key) - (a->key < b->key);
}

static int32_t number_unknowns(struct multigrid *multigrid, const struct stiffness *stiffness)
{
    const int32_t length = stiffness->n_blocks * VECTOR;
    struct placed placed[COARSEST_UNKNOWNS];
    int32_t count = 0;
    multigrid->unknown = memory_grow(multigrid->unknown, &multigrid->unknown_capacity, COARSEST_UNKNOWNS, sizeof(int32_t), "levels");
    for (int32_t i = 0; i < length; i++) {
        int32_t node[3], axis = i % VECTOR / BLOCK_CELLS;
        if (!(stiffness->blocks[i / VECTOR].free[i % BLOCK_CELLS] >> axis & 1))
            continue;
        place_of(stiffness, i, node);
        placed[count++] = (struct placed){((((int64_t)node[2] << 20) + node[1]) * (1 << 20) + node[0]) * 3 + axis, i};
    }
    qsort(placed, (size_t)count, sizeof *placed, by_key);
    for (int32_t u = 0; u < count; u++)
        multigrid->unknown[u] = placed[u].place;
    return count;
}

static bool are_near(const struct stiffness *stiffness, int32_t left, int32_t right)
{
    int32_t a[3], b[3];
    place_of(stiffness, left, a);
    place_of(stiffness, right, b);
    return abs(a[0] - b[0]) <= 1 && abs(a[1] - b[1]) <= 1 && abs(a[2] - b[2]) <= 1;
}

/* The matrix of the coarsest level, from what it does to vectors with ones at every third node along each
 * axis: no node feels two of them. */
static void factor_coarsest(struct multigrid *multigrid, struct multigrid_level *level)
{
    const struct stiffness *stiffness = &level->stiffness;
    const int32_t count = number_unknowns(multigrid, stiffness);
    int32_t first[COARSEST_UNKNOWNS], node[3];
    for (int32_t u = 0; u < count; u++)
        for (first[u] = 0; first[u] < u && !are_near(stiffness, multigrid->unknown[first[u]], multigrid->unknown[u]);)
            first[u]++;
    envelope_open(&multigrid->coarsest, count, first);
    for (int colour = 0; colour < 81; colour++) {
        memset(level->step, 0, length_of(level) * sizeof(double));
        int32_t ones[COARSEST_UNKNOWNS], n_ones = 0;
        for (int32_t u = 0; u < count; u++) {
            place_of(stiffness, multigrid->unknown[u], node);
            if (node[0] % 3 + 3 * (node[1] % 3) + 9 * (node[2] % 3) + 27 * (multigrid->unknown[u] % VECTOR / BLOCK_CELLS) == colour) {
                level->step[multigrid->unknown[u]] = 1;
                ones[n_ones++] = u;
            }
        }
        if (n_ones == 0)
            continue;
        stiffness_apply(stiffness, level->step, level->image);
        for (int32_t k = 0; k < n_ones; k++)
            for (int32_t u = ones[k]; u < count; u++)
                if (first[u] <= ones[k] && are_near(stiffness, multigrid->unknown[u], multigrid->unknown[ones[k]]))
                    *envelope_at(&multigrid->coarsest, u, ones[k]) = level->image[multigrid->unknown[u]];
    }
    envelope_factor(&multigrid->coarsest);
}

static void solve_coarsest(struct multigrid *multigrid, const struct multigrid_level *level, const double *r, double *z)
{
    double x[COARSEST_UNKNOWNS];
    const int32_t count = multigrid->coarsest.count;
    for (int32_t u = 0; u < count; u++)
        x[u] = r[multigrid->unknown[u]];
    envelope_solve(&multigrid->coarsest, x);
    memset(z, 0, length_of(level) * sizeof *z);
    for (int32_t u = 0; u < count; u++)
        z[multigrid->unknown[u]] = x[u];
}

/* --- all levels --- */

/* Free and held nodes of the finest level. */
static void find_free(struct stiffness *stiffness, const struct grid *grid)
{
    for (int32_t b = 0; b < stiffness->n_blocks; b++)
        for (int n = 0; n < BLOCK_CELLS; n++) {
            uint8_t fixed = grid->fixed[(size_t)b * BLOCK_CELLS + (size_t)n] & 7;
            stiffness->blocks[b].fixed[n] = fixed;
            stiffness->blocks[b].free[n] = 7 & (uint8_t)~fixed;
        }
}

/* Whether a level needs a coarser one; the finest does too where light nodes follow others, whose stiffness reaches
 * further than the coarsest level's matrix has room for. */
static bool is_too_large(const struct multigrid *multigrid, int l)
{
    return count_unknowns(&multigrid->level[l].stiffness) > COARSEST_UNKNOWNS || (l == 0 && multigrid->light->count > 0);
}

void multigrid_open(struct multigrid *multigrid, const struct mpm *mpm, const struct light_nodes *light,
                    const double *softening, bool keeps_bounds)
{
    struct multigrid_level *level = multigrid->level;
    int l = 0;
    multigrid->light = light;
    multigrid->fixed = mpm->grid->fixed;
    stiffness_of_particles(&level[0].stiffness, mpm, softening);
    make_vectors(&level[0], false);
    find_free(&level[0].stiffness, mpm->grid);
    stiffness_diagonal(&level[0].stiffness);
    for (; is_too_large(multigrid, l) && l + 1 < MULTIGRID_LEVELS; l++) {
        struct stiffness *coarse = &level[l + 1].stiffness;
        if (!keeps_bounds || l + 1 >= multigrid->n_levels)
            level[l].largest = BOUND_MARGIN * largest_eigenvalue(multigrid, &level[l]);
        list_blocks(coarse, &level[l].stiffness);
        link_levels(&level[l + 1], &level[l]);
        make_vectors(&level[l + 1], true);
#pragma omp parallel for schedule(dynamic, 1) if (coarse->active >= STIFFNESS_SHARED)
        for (int32_t b = 0; b < coarse->active; b++)
            coarsen_block(&level[l + 1], &level[l], b);
        stiffness_find_rows(coarse);
        coarsen_boundary(&level[l + 1], &level[l]);
        stiffness_diagonal(coarse);
    }
    multigrid->n_levels = l + 1;
    factor_coarsest(multigrid, &level[l]);
}

void multigrid_apply(void *context, const double *x, double *y)
{
    struct multigrid *multigrid = context;
    struct multigrid_level *level = multigrid->level;
    multigrid->applications++;
    if (multigrid->light->count > 0) {
        memcpy(level->step, x, length_of(level) * sizeof *x);
        apply(multigrid, level, level->step, y);
    } else {
        stiffness_apply(&level->stiffness, x, y);
    }
}

/* From the finest level down and up again. */
void multigrid_precondition(void *context, const double *r, double *z)
{
    struct multigrid *multigrid = context;
    struct multigrid_level *level = multigrid->level;
    const int coarsest = multigrid->n_levels - 1;
    const double *source = r;
    multigrid->applications += coarsest > 0 ? 2 * SMOOTHING_STEPS : 0;
    for (int l = 0; l < coarsest; l++) {
        double *solution = l == 0 ? z : level[l].solution;
        memcpy(level[l].residual, source, length_of(&level[l]) * sizeof *source);
        smooth(multigrid, &level[l], solution, true, true);
        restrict_vector(&level[l + 1], &level[l], level[l].residual, true, level[l + 1].source);
        source = level[l + 1].source;
    }
    solve_coarsest(multigrid, &level[coarsest], source, coarsest == 0 ? z : level[coarsest].solution);
    for (int l = coarsest - 1; l >= 0; l--) {
        double *solution = l == 0 ? z : level[l].solution;
        memset(level[l].step, 0, length_of(&level[l]) * sizeof(double));
        prolong_vector(&level[l + 1], &level[l], level[l + 1].solution, level[l].step);
        if (l == 0)
            light_nodes_clear(multigrid->light, level[l].step);
        vector_add(solution, 1, level[l].step, length_of(&level[l]));
        apply(multigrid, &level[l], level[l].step, level[l].image);
        vector_add(level[l].residual, -1, level[l].image, length_of(&level[l]));
        smooth(multigrid, &level[l], solution, false, false);
    }
}
