/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mpm/grid.h"
#include "base/memory.h"
#include "base/threads.h"

#include <string.h>

struct grid *grid_open(const struct cell_list *cells, const long boundary[6], int boundary_layers, double mass_cutoff)
{
    struct grid *grid = memory_array(1, sizeof *grid, "the grid");
    grid->cells = cells;
    for (int a = 0; a < 3; a++)
        grid->nodes[a] = cells->frame.cells[a] + 1;
    memcpy(grid->boundary, boundary, sizeof grid->boundary);
    grid->boundary_layers = boundary_layers;
    grid->mass_cutoff = mass_cutoff;
    grid->version = -1;
    return grid;
}

void grid_close(struct grid *grid)
{
    if (!grid)
        return;
    memory_free(grid->node);
    memory_free(grid->patch);
    memory_free(grid->fixed);
    memory_free(grid);
}

/* Fixed directions of a node by the codes of the faces that it lies on (spec 4.3). */
static uint8_t fixed_directions(const struct grid *grid, const int32_t node[3])
{
    uint8_t fixed = 0;
    for (int face = 0; face < 6; face++) {
        int axis = face / 2;
        int32_t from_face = face % 2 ? grid->nodes[axis] - 1 - node[axis] : node[axis];
        if (from_face < 0 || from_face >= grid->boundary_layers)
            continue;
        if (grid->boundary[face] == 1)
            fixed = 7;
        else if (grid->boundary[face] == 2)
            fixed |= (uint8_t)(1 << axis);
    }
    return fixed;
}

/* An array with room for `needed` numbers; there is nothing to keep between steps. */
static double *replace(double *array, size_t *capacity, size_t needed)
{
    if (needed <= *capacity)
        return array;
    memory_free(array);
    *capacity = 0;
    return memory_grow(NULL, capacity, needed + needed / 8, sizeof *array, "grid nodes");
}

void grid_follow(struct grid *grid)
{
    const struct cell_list *cells = grid->cells;
    if (grid->version == cells->version)
        return;
    grid->version = cells->version;
    size_t blocks = (size_t)cells->n_blocks;
    grid->node = replace(grid->node, &grid->node_capacity, blocks * NODE_FIELDS * BLOCK_CELLS);
    grid->patch = replace(grid->patch, &grid->patch_capacity, (size_t)cells->active * PATCH_FIELDS * PATCH_NODES);
    grid->fixed = memory_grow(grid->fixed, &grid->fixed_capacity, blocks * BLOCK_CELLS, 1, "grid nodes");
#pragma omp parallel for schedule(static)
    for (size_t b = 0; b < blocks; b++)
        for (int32_t n = 0; n < BLOCK_CELLS; n++) {
            const int32_t *at = cells->blocks[b].at;
            int32_t node[3] = {at[0] * BLOCK_EDGE + n % BLOCK_EDGE, at[1] * BLOCK_EDGE + n / BLOCK_EDGE % BLOCK_EDGE,
                               at[2] * BLOCK_EDGE + n / (BLOCK_EDGE * BLOCK_EDGE)};
            grid->fixed[b * BLOCK_CELLS + (size_t)n] = fixed_directions(grid, node);
        }
}

/* Index of the neighbour dx, dy, dz blocks further up. */
static inline int upper_neighbour(int dx, int dy, int dz)
{
    return (dx + 1) + 3 * (dy + 1) + 9 * (dz + 1);
}

/* The nodes of a row in one block. */
typedef double four __attribute__((vector_size(BLOCK_EDGE * sizeof(double)), aligned(sizeof(double)), may_alias));

/* A row of five patch nodes: four in one block, the fifth in the block above it in x. */
struct patch_row {
    size_t near, far; /* of field 0, in grid.node */
    int place;        /* in the patch */
};

/* The rows of a block's patch, without those in blocks that are missing: these lie beyond the
 * grid's end, and no particle reaches them. Returns the number of rows. */
static int find_rows(const struct grid *grid, int32_t block, struct patch_row rows[PATCH_EDGE * PATCH_EDGE])
{
    const int32_t *neighbour = grid->cells->blocks[block].neighbour;
    int count = 0;
    for (int k = 0; k < PATCH_EDGE; k++)
        for (int j = 0; j < PATCH_EDGE; j++) {
            int dy = j == BLOCK_EDGE, dz = k == BLOCK_EDGE;
            size_t row = (size_t)(BLOCK_EDGE * ((j - BLOCK_EDGE * dy) + BLOCK_EDGE * (k - BLOCK_EDGE * dz)));
            int32_t near = neighbour[upper_neighbour(0, dy, dz)], far = neighbour[upper_neighbour(1, dy, dz)];
            if (near < 0)
                continue;
            size_t stride = (size_t)NODE_FIELDS * BLOCK_CELLS;
            rows[count++] = (struct patch_row){(size_t)near * stride + row,
                                               far < 0 ? SIZE_MAX : (size_t)far * stride + row,
                                               PATCH_EDGE * (j + PATCH_EDGE * k)};
        }
    return count;
}

THREADS_VECTORISED
void grid_read_patch(const struct grid *grid, int32_t block, int first, int count, double patch[][PATCH_NODES])
{
    struct patch_row rows[PATCH_EDGE * PATCH_EDGE];
    int n_rows = find_rows(grid, block, rows);
    for (int f = 0; f < count; f++) {
        const double *node = grid->node + (size_t)(first + f) * BLOCK_CELLS;
        for (int r = 0; r < n_rows; r++) {
            double *target = patch[f] + rows[r].place;
            *(four *)target = *(const four *)(node + rows[r].near);
            target[BLOCK_EDGE] = rows[r].far == SIZE_MAX ? 0 : node[rows[r].far];
        }
    }
}

/* Adds to a block's nodes what one of the blocks below it (or itself) has for them. Along an axis
 * the block itself has nodes 0 ... 3, the one below it its last patch node for node 0. */
static inline void add_neighbour(double *restrict node, const double *restrict patch, int dx, int dy, int dz)
{
    int nj = dy ? 1 : BLOCK_EDGE, nk = dz ? 1 : BLOCK_EDGE;
    const double *corner = patch + BLOCK_EDGE * (dx + PATCH_EDGE * (dy + PATCH_EDGE * dz));
    for (int k = 0; k < nk; k++)
        for (int j = 0; j < nj; j++) {
            double *target = node + BLOCK_EDGE * (j + BLOCK_EDGE * k);
            const double *source = corner + PATCH_EDGE * (j + PATCH_EDGE * k);
            if (dx)
                target[0] += source[0];
            else
                *(four *)target += *(const four *)source;
        }
}

/* Sums the patches' fields 0 ... count-1 into the node fields from `first` of a block. */
THREADS_VECTORISED
static void collect(struct grid *grid, int32_t b, int first, int count)
{
    memset(grid_field(grid, b, first), 0, (size_t)count * BLOCK_CELLS * sizeof(double));
    for (int i = 0; i < 8; i++) {
        int dx = i & 1, dy = i >> 1 & 1, dz = i >> 2;
        int32_t source = grid->cells->blocks[b].neighbour[(1 - dx) + 3 * (1 - dy) + 9 * (1 - dz)];
        for (int f = 0; f < count && source >= 0 && source < grid->cells->active; f++)
            add_neighbour(grid_field(grid, b, first + f), grid_patch(grid, source)[f], dx, dy, dz);
    }
}

THREADS_VECTORISED
static void integrate_block(struct grid *grid, int32_t b, double step)
{
    const double *restrict mass = grid_field(grid, b, NODE_MASS);
    const uint8_t *restrict fixed = grid->fixed + (size_t)b * BLOCK_CELLS;
    const double cutoff = grid->mass_cutoff;
    for (int a = 0; a < 3; a++) {
        double *restrict momentum = grid_field(grid, b, NODE_MOMENTUM + a);
        double *restrict force = grid_field(grid, b, NODE_FORCE + a);
#pragma omp simd
        for (int n = 0; n < BLOCK_CELLS; n++) {
            bool moves = mass[n] > cutoff && !(fixed[n] >> a & 1);
            double divisor = moves ? mass[n] : 1;
            double p = momentum[n] + force[n] * step;
            momentum[n] = moves ? p / divisor : 0;
            force[n] = moves ? force[n] / divisor : 0;
        }
    }
}

/* Fewer blocks than this are not worth a second thread. */
enum { SHARED_BLOCKS = 32 };

void grid_integrate(struct grid *grid, int first, int count, double step)
{
    const int32_t blocks = grid->cells->n_blocks;
#pragma omp parallel for schedule(static) if (blocks >= SHARED_BLOCKS)
    for (int32_t b = 0; b < blocks; b++) {
        collect(grid, b, first, count);
        integrate_block(grid, b, step);
    }
}

THREADS_VECTORISED
static void straining_block(struct grid *grid, int32_t b, int source)
{
    const double *restrict mass = grid_field(grid, b, NODE_MASS);
    const uint8_t *restrict fixed = grid->fixed + (size_t)b * BLOCK_CELLS;
    const double cutoff = grid->mass_cutoff;
    for (int a = 0; a < 3; a++) {
        const double *momentum = grid_field(grid, b, source + a);
        double *velocity = grid_field(grid, b, NODE_STRAINING + a);
        for (int n = 0; n < BLOCK_CELLS; n++) {
            bool moves = mass[n] > cutoff && !(fixed[n] >> a & 1);
            velocity[n] = moves ? momentum[n] / (moves ? mass[n] : 1) : 0;
        }
    }
}

void grid_straining_velocity(struct grid *grid, int first, int count)
{
    const int32_t blocks = grid->cells->n_blocks;
    const int source = first == NODE_MASS ? NODE_MOMENTUM : first;
#pragma omp parallel for schedule(static) if (blocks >= SHARED_BLOCKS)
    for (int32_t b = 0; b < blocks; b++) {
        collect(grid, b, first, count);
        straining_block(grid, b, source);
    }
}

size_t grid_bytes(const struct grid *grid)
{
    return (grid->node_capacity + grid->patch_capacity) * sizeof *grid->node + grid->fixed_capacity;
}
