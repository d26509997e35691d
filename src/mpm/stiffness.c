/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mpm/stiffness.h"
#include "base/memory.h"
#include "base/tensor.h"
#include "mpm/chunk.h"

#include <math.h>
#include <string.h>

enum { EDGE = BLOCK_EDGE + 1, PLANE = EDGE * EDGE, ROWS = BLOCK_EDGE * BLOCK_EDGE };

/* Moment `i` of the four cells of a row. */
#define MOMENT(m, i) (*(const lanes *)((m) + (i) * BLOCK_EDGE))

/* --- the lattice --- */

void stiffness_close(struct stiffness *stiffness)
{
    memory_free(stiffness->blocks);
    memory_free(stiffness->moments);
    memory_free(stiffness->cell_bulk);
    memory_free(stiffness->patch);
    memory_free(stiffness->inverse);
}

void stiffness_open(struct stiffness *stiffness, int32_t n_blocks, int32_t active)
{
    const char *purpose = "the stiffness";
    const size_t all = (size_t)n_blocks, some = (size_t)active, real = sizeof(double);
    stiffness->n_blocks = n_blocks;
    stiffness->active = active;
    stiffness->blocks = memory_grow(stiffness->blocks, &stiffness->blocks_capacity, all, sizeof *stiffness->blocks, purpose);
    stiffness->moments = memory_grow(stiffness->moments, &stiffness->moments_capacity,
                                     some * (size_t)stiffness->sets * STIFFNESS_SET, real, purpose);
    if (stiffness->averages_volume && stiffness->sets > 1)
        stiffness->cell_bulk = memory_grow(stiffness->cell_bulk, &stiffness->bulk_capacity, some * BLOCK_CELLS, real, purpose);
    stiffness->patch = memory_grow(stiffness->patch, &stiffness->patch_capacity, some * 6 * STIFFNESS_PATCH, real, purpose);
    stiffness->inverse = memory_grow(stiffness->inverse, &stiffness->inverse_capacity, all * 6 * BLOCK_CELLS, real, purpose);
}

static double *moments_of(const struct stiffness *stiffness, int32_t b, int set)
{
    return stiffness->moments + ((size_t)b * (size_t)stiffness->sets + (size_t)set) * STIFFNESS_SET;
}

void stiffness_find_rows(struct stiffness *stiffness)
{
    for (int32_t b = 0; b < stiffness->active; b++) {
        const double *volume = moments_of(stiffness, b, 0);
        stiffness->blocks[b].rows = 0;
        for (int c = 0; c < BLOCK_CELLS; c++)
            if (volume[stiffness_cell(c)] > 0)
                stiffness->blocks[b].rows |= (uint16_t)(1u << (c / BLOCK_EDGE));
    }
}

/* --- moments of the particles --- */

/* Adds `weight` times the powers of local coordinates from the middle of the cell. */
THREADS_INLINE void add_powers(lanes sum[9], const double local[3], double weight)
{
    lanes along = {1, local[0], local[0] * local[0], 0};
    double y[3] = {1, local[1], local[1] * local[1]}, z[3] = {weight, weight * local[2], weight * local[2] * local[2]};
    for (int i = 0; i < 9; i++)
        sum[i] += along * (y[i % 3] * z[i / 3]);
}

static void put_moments(const lanes sum[9], double *moments)
{
    for (int i = 0; i < STIFFNESS_MOMENTS; i++)
        moments[i * BLOCK_EDGE] = sum[i / 3][i % 3];
}

/* Lame's first parameter that acts point by point; with bbar without the bulk modulus. */
static double lame_of(const struct stiffness *stiffness, double bulk, double shear)
{
    return (stiffness->averages_volume ? 0 : bulk) - 2 * shear / 3;
}

THREADS_VECTORISED
static void block_moments(struct stiffness *stiffness, const struct mpm *mpm, const double *softening, int32_t b)
{
    const struct cell_block *block = &mpm->cells->blocks[b];
    const struct store *store = mpm->store;
    const struct chunk chunk = {.block = block};
    const double inverse = 1 / stiffness->size, square = inverse * inverse;
    for (int c = 0; c < BLOCK_CELLS; c++) {
        lanes sum[3][9];
        double bulk = 0, low[3];
        memset(sum, 0, sizeof sum);
        for (int a = 0; a < 3; a++)
            low[a] = chunk_cell_low(mpm, &chunk, c, a);
        for (int32_t k = block->cell_first[c]; k < block->cell_first[c + 1]; k++) {
            const int32_t p = mpm->cells->order[block->first + k];
            double local[3], weight = store->real[COLUMN_VOLUME][0][p] * square;
            for (int a = 0; a < 3; a++)
                local[a] = (store->real[mpm->place][a][p] - low[a]) * inverse - 0.5;
            add_powers(sum[0], local, weight);
            if (stiffness->sets == 1)
                continue;
            const struct material *material = mpm->material_of_body[store->integer[COLUMN_BODY][p]];
            const double shear = material->shear_modulus * (softening ? softening[p] : 1);
            add_powers(sum[1], local, weight * lame_of(stiffness, material->bulk_modulus, shear));
            add_powers(sum[2], local, weight * shear);
            bulk += weight * material->bulk_modulus;
        }
        for (int set = 0; set < stiffness->sets; set++)
            put_moments(sum[set], moments_of(stiffness, b, set) + stiffness_cell(c));
        if (stiffness->cell_bulk)
            stiffness->cell_bulk[(size_t)b * BLOCK_CELLS + (size_t)c] = sum[0][0][0] > 0 ? bulk / sum[0][0][0] : 0;
    }
}

void stiffness_of_particles(struct stiffness *stiffness, const struct mpm *mpm, const double *softening)
{
    const struct cell_list *cells = mpm->cells;
    const struct material *material = mpm->material_of_body[0];
    stiffness->layout = &mpm->grid->layout;
    stiffness->size = cells->frame.size;
    stiffness->averages_volume = mpm->scene->averages_volume;
    stiffness->sets = mpm->has_one_law && !softening ? 1 : 3;
    stiffness->lame = stiffness->sets == 1 ? lame_of(stiffness, material->bulk_modulus, material->shear_modulus) : 1;
    stiffness->shear = stiffness->sets == 1 ? material->shear_modulus : 1;
    stiffness->bulk = material->bulk_modulus;
    stiffness_open(stiffness, cells->n_blocks, cells->active);
    for (int32_t b = 0; b < cells->n_blocks; b++) {
        memcpy(stiffness->blocks[b].at, cells->blocks[b].at, sizeof cells->blocks[b].at);
        memcpy(stiffness->blocks[b].neighbour, cells->blocks[b].neighbour, sizeof cells->blocks[b].neighbour);
    }
#pragma omp parallel for schedule(dynamic, 1) if (cells->active >= STIFFNESS_SHARED)
    for (int32_t b = 0; b < cells->active; b++)
        block_moments(stiffness, mpm, softening, b);
    stiffness_find_rows(stiffness);
}

/* --- a row of four cells --- */

/* Terms of a trilinear field, 1 x y xy z xz yz xyz, are numbered by the bits of the axes in them; so are
 * the nodes of a cell. The gradient along axis d has terms 1, p, q, pq of the two other axes. */
THREADS_INLINE int first_other(int d)
{
    return d == 0 ? 1 : 0;
}

THREADS_INLINE int second_other(int d)
{
    return d == 2 ? 1 : 2;
}

/* The field's term whose derivative along d is term k. */
THREADS_INLINE int term_of(int d, int k)
{
    return 1 << d | (k & 1) << first_other(d) | (k >> 1) << second_other(d);
}

/* Number of the moment of term k of the gradient along d. */
THREADS_INLINE int moment_of(int d, int k)
{
    static const int stride[3] = {1, 3, 9};
    return (k & 1) * stride[first_other(d)] + (k >> 1) * stride[second_other(d)];
}

/* Sums and differences of the eight along each axis: nodes to terms and, with the lower node first
 * subtracted and then added, terms to nodes; scaled apart. */
THREADS_INLINE void transform(lanes v[8], bool to_nodes)
{
#pragma GCC unroll 3
    for (int axis = 0; axis < 3; axis++)
#pragma GCC unroll 8
        for (int i = 0; i < 8; i++)
            if (!(i >> axis & 1)) {
                lanes low = v[i], high = v[i | 1 << axis];
                v[i] = to_nodes ? low - high : low + high;
                v[i | 1 << axis] = to_nodes ? low + high : high - low;
            }
}

/* What a sum of signed node values has to be multiplied with to give a term. */
THREADS_INLINE double scale_of(int term)
{
    int axes = (term & 1) + (term >> 1 & 1) + (term >> 2);
    return axes == 3 ? 1 : axes == 2 ? 0.5 : axes == 1 ? 0.25 : 0.125;
}

/* sum[k] += factor * sum over l of the moment of (term k along d) (term l along e), times g[l]. */
THREADS_INLINE void add_product(const double *m, int d, int e, double factor, const lanes g[4], lanes sum[4])
{
#pragma GCC unroll 4
    for (int k = 0; k < 4; k++) {
        lanes part = MOMENT(m, moment_of(d, k) + moment_of(e, 0)) * g[0];
#pragma GCC unroll 3
        for (int l = 1; l < 4; l++)
            part += MOMENT(m, moment_of(d, k) + moment_of(e, l)) * g[l];
        sum[k] += part * factor;
    }
}

/* Where a row's moments are. */
struct row_moments {
    const double *volume, *lame, *shear;
    lanes bulk; /* bbar: bulk modulus of the cells over their volume, 0 where they are empty */
};

THREADS_INLINE struct row_moments row_moments_of(const struct stiffness *stiffness, int32_t b, int row)
{
    const double *m = moments_of(stiffness, b, 0) + stiffness_cell(row * BLOCK_EDGE);
    const int set = STIFFNESS_SET;
    struct row_moments moments = {m, stiffness->sets > 1 ? m + set : m, stiffness->sets > 1 ? m + 2 * set : m, {0}};
    for (int i = 0; i < BLOCK_EDGE && stiffness->averages_volume; i++) {
        double bulk = stiffness->cell_bulk ? stiffness->cell_bulk[(size_t)b * BLOCK_CELLS + (size_t)(row * BLOCK_EDGE + i)]
                                           : stiffness->bulk;
        moments.bulk[i] = m[i] > 0 ? bulk / m[i] : 0;
    }
    return moments;
}

/* Forces, as terms f[component][term], from the terms u of a displacement field. */
THREADS_INLINE void row_forces(const struct stiffness *stiffness, const struct row_moments *m, lanes u[3][8], lanes f[3][8])
{
    const double lame = stiffness->lame, shear = stiffness->shear;
    lanes g[3][3][4], s[3][3][4];
    for (int a = 0; a < 3; a++)
        for (int d = 0; d < 3; d++)
            for (int k = 0; k < 4; k++) {
                g[a][d][k] = u[a][term_of(d, k)];
                s[a][d][k] = (lanes){0};
            }
#pragma GCC unroll 3
    for (int a = 0; a < 3; a++)
#pragma GCC unroll 3
        for (int d = 0; d < 3; d++) {
            add_product(m->lame, a, d, lame, g[d][d], s[a][a]);
            add_product(m->shear, d, d, a == d ? 2 * shear : shear, g[a][d], s[a][d]);
            if (a != d)
                add_product(m->shear, d, a, shear, g[d][a], s[a][d]);
        }
    if (stiffness->averages_volume) {
        lanes mean = {0};
        for (int d = 0; d < 3; d++)
            for (int k = 0; k < 4; k++)
                mean += MOMENT(m->volume, moment_of(d, k)) * g[d][d][k];
        mean *= m->bulk;
        for (int d = 0; d < 3; d++)
            for (int k = 0; k < 4; k++)
                s[d][d][k] += MOMENT(m->volume, moment_of(d, k)) * mean;
    }
    for (int a = 0; a < 3; a++) {
        f[a][0] = (lanes){0};
        f[a][1] = s[a][0][0];
        f[a][2] = s[a][1][0];
        f[a][4] = s[a][2][0];
        f[a][3] = s[a][0][1] + s[a][1][1];
        f[a][5] = s[a][0][2] + s[a][2][1];
        f[a][6] = s[a][1][2] + s[a][2][2];
        f[a][7] = s[a][0][3] + s[a][1][3] + s[a][2][3];
    }
}

/* Terms of the field in the four cells of the row at `base` of a patch. */
THREADS_INLINE void read_terms(const double *patch, int base, lanes u[8])
{
    for (int i = 0; i < 8; i++)
        u[i] = *(const lanes *)(patch + base + (i & 1) + EDGE * (i >> 1 & 1) + PLANE * (i >> 2));
    transform(u, false);
    for (int i = 0; i < 8; i++)
        u[i] *= scale_of(i);
}

/* --- vectors and patches --- */

THREADS_INLINE void read_patch(const struct stiffness *stiffness, const double *x, int32_t b, double *patch)
{
    const int32_t *neighbour = stiffness->blocks[b].neighbour;
    static const double nothing[STIFFNESS_VECTOR];
    const double *source[BLOCK_NEIGHBOURS];
    for (int i = 0; i < BLOCK_NEIGHBOURS; i++)
        source[i] = neighbour[i] < 0 ? nothing : x + (size_t)neighbour[i] * STIFFNESS_VECTOR;
    patch_read(stiffness->layout, source, 3, patch);
}

THREADS_VECTORISED
void stiffness_read(const struct stiffness *stiffness, const double *x, int32_t b, double *patch)
{
    read_patch(stiffness, x, b, patch);
}

/* Sums of fields from ... from + count - 1 of the patches around block b. */
THREADS_INLINE void collect(const struct stiffness *stiffness, int32_t b, int count, double *sum)
{
    const int32_t *neighbour = stiffness->blocks[b].neighbour;
    const double *source[BLOCK_NEIGHBOURS];
    for (int i = 0; i < BLOCK_NEIGHBOURS; i++)
        source[i] = neighbour[i] < 0 || neighbour[i] >= stiffness->active
                      ? NULL
                      : stiffness->patch + (size_t)neighbour[i] * 6 * STIFFNESS_PATCH;
    memset(sum, 0, (size_t)count * BLOCK_CELLS * sizeof *sum);
    patch_sum(stiffness->layout, source, count, sum);
}

THREADS_VECTORISED
void stiffness_collect(const struct stiffness *stiffness, int32_t b, double sum[STIFFNESS_VECTOR], bool masked)
{
    const uint8_t *restrict free = stiffness->blocks[b].free;
    collect(stiffness, b, 3, sum);
    for (int a = 0; a < 3 && masked; a++)
        for (int n = 0; n < BLOCK_CELLS; n++)
            sum[a * BLOCK_CELLS + n] = free[n] >> a & 1 ? sum[a * BLOCK_CELLS + n] : 0;
}

/* What a block's rows of cells give to the nodes, with the lower and the upper nodes of each row apart: so
 * rows add to places that the row before wrote as a whole. */
struct row_sums {
    lanes low[PLANE], high[PLANE];
};

THREADS_INLINE void add_row(struct row_sums *sums, int row, const lanes nodes[8])
{
    const int base = row % BLOCK_EDGE + EDGE * (row / BLOCK_EDGE);
    for (int i = 0; i < 8; i++) {
        lanes *to = (i & 1 ? sums->high : sums->low) + base + (i >> 1 & 1) + EDGE * (i >> 2);
        *to += nodes[i];
    }
}

THREADS_INLINE void put_rows(const struct row_sums *sums, double *patch)
{
    for (int r = 0; r < PLANE; r++) {
        double *to = patch + EDGE * r;
        to[0] = sums->low[r][0];
        for (int i = 1; i < BLOCK_EDGE; i++)
            to[i] = sums->low[r][i] + sums->high[r][i - 1];
        to[BLOCK_EDGE] = sums->high[r][BLOCK_EDGE - 1];
    }
}

THREADS_VECTORISED
void stiffness_give(const struct stiffness *stiffness, const double *x, int32_t b)
{
    double patch[3 * STIFFNESS_PATCH];
    struct row_sums sums[3];
    read_patch(stiffness, x, b, patch);
    memset(sums, 0, sizeof sums);
    for (int row = 0; row < ROWS; row++) {
        if (!(stiffness->blocks[b].rows >> row & 1))
            continue;
        lanes u[3][8], f[3][8];
        struct row_moments moments = row_moments_of(stiffness, b, row);
        for (int a = 0; a < 3; a++)
            read_terms(patch + a * STIFFNESS_PATCH, EDGE * (row % BLOCK_EDGE) + PLANE * (row / BLOCK_EDGE), u[a]);
        row_forces(stiffness, &moments, u, f);
        for (int a = 0; a < 3; a++) {
            for (int i = 0; i < 8; i++)
                f[a][i] *= scale_of(i);
            transform(f[a], true);
            add_row(&sums[a], row, f[a]);
        }
    }
    for (int a = 0; a < 3; a++)
        put_rows(&sums[a], stiffness->patch + ((size_t)b * 6 + (size_t)a) * STIFFNESS_PATCH);
}

void stiffness_apply(const struct stiffness *stiffness, const double *x, double *y)
{
#pragma omp parallel for schedule(dynamic, 4) if (stiffness->active >= STIFFNESS_SHARED)
    for (int32_t b = 0; b < stiffness->active; b++)
        stiffness_give(stiffness, x, b);
#pragma omp parallel for schedule(static) if (stiffness->active >= STIFFNESS_SHARED)
    for (int32_t b = 0; b < stiffness->n_blocks; b++)
        stiffness_collect(stiffness, b, y + (size_t)b * STIFFNESS_VECTOR, true);
}

/* --- the diagonal --- */

/* Components of symmetric 3 x 3 matrices: xx yy zz yz xz xy. */
static const int part_row[6] = {0, 1, 2, 1, 0, 0}, part_column[6] = {0, 1, 2, 2, 2, 1};

/* Gradients of a corner's shape function by terms, g[axis][term]. */
THREADS_INLINE void corner_gradient(int corner, double g[3][4])
{
    for (int d = 0; d < 3; d++)
        for (int t = 0; t < 4; t++) {
            int term = term_of(d, t), minus = __builtin_popcount((unsigned)(term & ~corner));
            g[d][t] = (minus & 1 ? -1 : 1) * scale_of(term);
        }
}

/* Sums of products of two gradients: components xx yy zz yz xz xy. */
THREADS_INLINE void corner_products(const double *m, double g[3][4], lanes sum[6])
{
#pragma GCC unroll 6
    for (int i = 0; i < 6; i++) {
        const int a = part_row[i], d = part_column[i];
        sum[i] = (lanes){0};
#pragma GCC unroll 16
        for (int t = 0; t < 16; t++)
            sum[i] += MOMENT(m, moment_of(a, t / 4) + moment_of(d, t % 4)) * (g[a][t / 4] * g[d][t % 4]);
    }
}

/* The diagonal block of one corner of the row's cells. */
THREADS_INLINE void corner_diagonal(const struct stiffness *stiffness, const struct row_moments *m, int corner, lanes k[6])
{
    double g[3][4];
    lanes lame[6], shear[6], mean[3];
    corner_gradient(corner, g);
    corner_products(m->shear, g, shear);
    if (m->lame == m->shear)
        memcpy(lame, shear, sizeof lame);
    else
        corner_products(m->lame, g, lame);
    const lanes trace = shear[0] + shear[1] + shear[2];
    for (int i = 0; i < 6; i++) {
        k[i] = lame[i] * stiffness->lame + shear[i] * stiffness->shear;
        if (i < 3)
            k[i] += trace * stiffness->shear;
    }
    for (int a = 0; a < 3 && stiffness->averages_volume; a++) {
        mean[a] = (lanes){0};
        for (int t = 0; t < 4; t++)
            mean[a] += MOMENT(m->volume, moment_of(a, t)) * g[a][t];
    }
    for (int i = 0; i < 6 && stiffness->averages_volume; i++)
        k[i] += mean[part_row[i]] * mean[part_column[i]] * m->bulk;
}

THREADS_VECTORISED
static void give_diagonal(const struct stiffness *stiffness, int32_t b)
{
    struct row_sums sums[6];
    memset(sums, 0, sizeof sums);
    for (int row = 0; row < ROWS; row++) {
        if (!(stiffness->blocks[b].rows >> row & 1))
            continue;
        lanes k[6], nodes[6][8];
        struct row_moments moments = row_moments_of(stiffness, b, row);
        for (int corner = 0; corner < 8; corner++) {
            corner_diagonal(stiffness, &moments, corner, k);
            for (int i = 0; i < 6; i++)
                nodes[i][corner] = k[i];
        }
        for (int i = 0; i < 6; i++)
            add_row(&sums[i], row, nodes[i]);
    }
    for (int i = 0; i < 6; i++)
        put_rows(&sums[i], stiffness->patch + ((size_t)b * 6 + (size_t)i) * STIFFNESS_PATCH);
}

/* Inverts the part of a node's block that belongs to its free directions; directions without stiffness of
 * their own are not free. */
static void invert_node(const double k[6], uint8_t *free, double inverse[6])
{
    double matrix[3][3], inverted[3][3] = {{0}}, largest = fmax(k[0], fmax(k[1], k[2]));
    for (int a = 0; a < 3; a++)
        if (!(k[a] > 1e-14 * largest))
            *free &= (uint8_t)~(1 << a);
    for (int i = 0; i < 6; i++) {
        int a = part_row[i], d = part_column[i];
        bool is_free = *free >> a & *free >> d & 1;
        matrix[a][d] = matrix[d][a] = is_free ? k[i] / largest : a == d;
    }
    double determinant = tensor_determinant(matrix);
    bool is_regular = determinant > 1e-13 * matrix[0][0] * matrix[1][1] * matrix[2][2];
    if (is_regular)
        tensor_inverse(matrix, determinant, inverted);
    for (int i = 0; i < 6; i++) {
        int a = part_row[i], d = part_column[i];
        bool is_free = *free >> a & *free >> d & 1;
        double value = is_regular ? inverted[a][d] : a == d ? 1 / matrix[a][a] : 0;
        inverse[i] = is_free ? value / largest : 0;
    }
}

static void invert_block(struct stiffness *stiffness, int32_t b)
{
    struct stiffness_block *block = &stiffness->blocks[b];
    double sum[6 * BLOCK_CELLS], *inverse = stiffness->inverse + (size_t)b * 6 * BLOCK_CELLS;
    collect(stiffness, b, 6, sum);
    for (int n = 0; n < BLOCK_CELLS; n++) {
        double k[6], result[6] = {0};
        for (int i = 0; i < 6; i++)
            k[i] = sum[i * BLOCK_CELLS + n];
        if (!(k[0] + k[1] + k[2] > 0))
            block->free[n] = block->fixed[n] = 0;
        if (block->free[n])
            invert_node(k, &block->free[n], result);
        for (int i = 0; i < 6; i++)
            inverse[i * BLOCK_CELLS + n] = result[i];
    }
}

void stiffness_diagonal(struct stiffness *stiffness)
{
#pragma omp parallel for schedule(dynamic, 4) if (stiffness->active >= STIFFNESS_SHARED)
    for (int32_t b = 0; b < stiffness->active; b++)
        give_diagonal(stiffness, b);
#pragma omp parallel for schedule(static) if (stiffness->active >= STIFFNESS_SHARED)
    for (int32_t b = 0; b < stiffness->n_blocks; b++)
        invert_block(stiffness, b);
}

THREADS_VECTORISED
void stiffness_jacobi(const struct stiffness *stiffness, int32_t b, const double *restrict r, double factor, double share,
                      double *restrict z)
{
    enum { N = BLOCK_CELLS };
    const double *restrict k = stiffness->inverse + (size_t)b * 6 * N;
    for (int n = 0; n < N; n++) {
        double x = r[n], y = r[N + n], t = r[2 * N + n];
        z[n] = share * z[n] + factor * (k[n] * x + k[5 * N + n] * y + k[4 * N + n] * t);
        z[N + n] = share * z[N + n] + factor * (k[5 * N + n] * x + k[N + n] * y + k[3 * N + n] * t);
        z[2 * N + n] = share * z[2 * N + n] + factor * (k[4 * N + n] * x + k[3 * N + n] * y + k[2 * N + n] * t);
    }
}

/* --- gradients at the particles --- */

/* Gradient g[component][axis] at a place of the cell in `lane` of a row. */
THREADS_INLINE void gradient_at(lanes u[3][8], int lane, const double local[3], double scale, double g[3][3])
{
    for (int i = 0; i < 9; i++) {
        const int a = i / 3, d = i % 3;
        double first = local[first_other(d)], second = local[second_other(d)];
        g[a][d] = scale * (u[a][term_of(d, 0)][lane] + u[a][term_of(d, 1)][lane] * first
                           + (u[a][term_of(d, 2)][lane] + u[a][term_of(d, 3)][lane] * first) * second);
    }
}

double stiffness_strains(const struct mpm *mpm, const struct stiffness *stiffness, const double *x, int32_t b,
                         double *const deviator[6])
{
    const struct cell_block *block = &mpm->cells->blocks[b];
    const struct chunk chunk = {.block = block};
    const double inverse = 1 / stiffness->size;
    double patch[3 * STIFFNESS_PATCH], largest = 0;
    stiffness_read(stiffness, x, b, patch);
    for (int c = 0; c < BLOCK_CELLS; c++) {
        lanes u[3][8];
        if (block->cell_first[c] == block->cell_first[c + 1])
            continue;
        for (int a = 0; a < 3; a++)
            read_terms(patch + a * STIFFNESS_PATCH, EDGE * (c / BLOCK_EDGE % BLOCK_EDGE) + PLANE * (c / ROWS), u[a]);
        for (int32_t k = block->cell_first[c]; k < block->cell_first[c + 1]; k++) {
            const int32_t p = mpm->cells->order[block->first + k];
            double local[3], g[3][3];
            for (int a = 0; a < 3; a++)
                local[a] = (mpm->store->real[mpm->place][a][p] - chunk_cell_low(mpm, &chunk, c, a)) * inverse - 0.5;
            gradient_at(u, c % BLOCK_EDGE, local, inverse, g);
            for (int i = 0; i < 9; i++)
                largest = fmax(largest, fabs(g[i / 3][i % 3]));
            const double mean = (g[0][0] + g[1][1] + g[2][2]) / 3;
            for (int i = 0; i < 6 && deviator; i++) {
                const int a = part_row[i], d = part_column[i];
                deviator[i][p] = 0.5 * (g[a][d] + g[d][a]) - (a == d ? mean : 0);
            }
        }
    }
    return largest;
}
