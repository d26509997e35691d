/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mpm/grid.h"
#include "base/memory.h"
#include "base/threads.h"
#include "deck/scene.h"

#include <math.h>
#include <string.h>

/* Fewer blocks than this are not worth a second thread. */
enum { SHARED_BLOCKS = 64 };

/* Part of a patch along an axis: `count` nodes from `node` of the neighbour `offset` blocks further,
 * at `place` in the patch. */
struct span {
    int offset, node, count, place;
};

/* Adds the rows of `length` nodes: all triples of spans, their nodes along x side by side. */
static void add_rows(struct patch_layout *layout, const struct span *spans, int n, int length)
{
    for (int triple = 0; triple < n * n * n; triple++) {
        const struct span *x = &spans[triple % n], *y = &spans[triple / n % n], *z = &spans[triple / (n * n)];
        for (int jk = 0; jk < y->count * z->count && x->count == length; jk++) {
            int j = jk % y->count, k = jk / y->count;
            layout->rows[layout->end++] = (struct patch_row){
                (1 + x->offset) + 3 * (1 + y->offset) + 9 * (1 + z->offset),
                (1 - x->offset) + 3 * (1 - y->offset) + 9 * (1 - z->offset),
                x->node + BLOCK_EDGE * (y->node + j + BLOCK_EDGE * (z->node + k)),
                x->place + layout->row * (y->place + j + layout->edge * (z->place + k))};
        }
    }
}

static struct patch_layout lay_out(int low, int high)
{
    const struct span all[] = {{-1, BLOCK_EDGE - 1, 1, 0}, {0, 0, BLOCK_EDGE, low}, {1, 0, high, low + BLOCK_EDGE}};
    const struct span *spans = low > 0 ? all : all + 1;
    const int n = low > 0 ? 3 : 2, edge = low + BLOCK_EDGE + high;
    const int row = low + high > 2 ? 8 : edge;
    struct patch_layout layout = {.edge = edge, .row = row, .nodes = (row * edge * edge + 7) / 8 * 8, .origin = low};
    add_rows(&layout, spans, n, BLOCK_EDGE);
    layout.end_of_four = layout.end;
    add_rows(&layout, spans, n, 2);
    layout.end_of_two = layout.end;
    add_rows(&layout, spans, n, 1);
    return layout;
}

struct grid *grid_open(const struct cell_list *cells, struct grid_form form, const long boundary[6], double mass_cutoff)
{
    struct grid *grid = memory_array(1, sizeof *grid, "the grid");
    grid->cells = cells;
    for (int a = 0; a < 3; a++)
        grid->nodes[a] = cells->frame.cells[a] + 1;
    memcpy(grid->boundary, boundary, sizeof grid->boundary);
    grid->boundary_layers = form.boundary_layers;
    grid->mass_cutoff = mass_cutoff;
    grid->layout = lay_out(form.low, form.high);
    grid->fields = form.fields;
    grid->patch_fields = form.patch_fields;
    grid->version = -1;
    grid->shared_blocks = SHARED_BLOCKS;
    grid->nothing = memory_array((size_t)grid->fields * BLOCK_CELLS, sizeof *grid->nothing, "the grid");
    return grid;
}

void grid_close(struct grid *grid)
{
    if (!grid)
        return;
    memory_free(grid->node);
    memory_free(grid->patch);
    memory_free(grid->fixed);
    memory_free(grid->nothing);
    memory_free(grid->damped);
    memory_free(grid);
}

void grid_hold(struct grid *grid, const struct scene_hold *holds, size_t n_holds)
{
    grid->holds = holds;
    grid->n_holds = n_holds;
}

/* Whether a place belongs to what is held; its limits do, give or take the round-off of a lattice. */
static bool is_held(const struct scene_hold *hold, const double place[3], double tolerance)
{
    if (hold->is_annulus) {
        const int first = hold->axis == 0 ? 1 : 0, second = hold->axis == 2 ? 1 : 2;
        const double r = hypot(place[first] - hold->centre[0], place[second] - hold->centre[1]);
        return r >= hold->radius[0] - tolerance && r <= hold->radius[1] + tolerance;
    }
    for (int a = 0; a < 3; a++)
        if (place[a] < hold->box[2 * a] - tolerance || place[a] > hold->box[2 * a + 1] + tolerance)
            return false;
    return true;
}

/* Directions in which the deck holds a node. */
static uint8_t held_directions(const struct grid *grid, const int32_t node[3])
{
    const struct cell_frame *frame = &grid->cells->frame;
    double place[3];
    uint8_t held = 0;
    for (int a = 0; a < 3; a++)
        place[a] = frame->low[a] + node[a] * frame->size;
    for (size_t i = 0; i < grid->n_holds; i++)
        if (is_held(&grid->holds[i], place, 1e-6 * frame->size))
            for (int a = 0; a < 3; a++)
                held |= (uint8_t)(grid->holds[i].holds[a] << a);
    return held;
}

/* Fixed directions of a node by the codes of the faces that it lies on (spec 4.3). */
static uint8_t fixed_directions(const struct grid *grid, const int32_t node[3])
{
    uint8_t fixed = 0;
    for (int face = 0; face < 6; face++) {
        int axis = face / 2;
        int32_t from_face = face % 2 ? grid->nodes[axis] - 1 - node[axis] : node[axis];
        if (from_face < 0)
            return 7; /* no node of the grid: what wide supports give to it is dropped (spec 7.2) */
        if (from_face >= grid->boundary_layers)
            continue;
        if (grid->boundary[face] == 1)
            fixed = 7;
        else if (grid->boundary[face] == 2)
            fixed |= (uint8_t)(1 << axis);
    }
    return grid->n_holds > 0 ? fixed | held_directions(grid, node) : fixed;
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
    grid->node = replace(grid->node, &grid->node_capacity, blocks * (size_t)grid->fields * BLOCK_CELLS);
    grid->patch = replace(grid->patch, &grid->patch_capacity, (size_t)cells->active * (size_t)grid->patch_fields * (size_t)grid->layout.nodes);
    if (grid->may_damp)
        grid->damped = memory_grow(grid->damped, &grid->damped_capacity, blocks, sizeof *grid->damped, "grid nodes");
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

THREADS_VECTORISED
void grid_read_patch(const struct grid *grid, int32_t block, int first, int count, double *patch)
{
    const int32_t *neighbour = grid->cells->blocks[block].neighbour;
    const double *source[BLOCK_NEIGHBOURS];
    for (int i = 0; i < BLOCK_NEIGHBOURS; i++)
        source[i] = neighbour[i] < 0 ? grid->nothing : grid_field(grid, neighbour[i], first);
    patch_read(&grid->layout, source, count, patch);
}

THREADS_VECTORISED
void grid_collect(struct grid *grid, int32_t b, int first, int count, int from_field)
{
    const int32_t *neighbour = grid->cells->blocks[b].neighbour;
    const double *source[BLOCK_NEIGHBOURS];
    double *sum = grid_field(grid, b, first);
    for (int i = 0; i < BLOCK_NEIGHBOURS; i++)
        source[i] = neighbour[i] < 0 || neighbour[i] >= grid->cells->active ? NULL
                                                                            : grid_patch(grid, neighbour[i], from_field);
    memset(sum, 0, (size_t)count * BLOCK_CELLS * sizeof *sum);
    patch_sum(&grid->layout, source, count, sum);
}

/* P += F step; both zero in fixed directions. */
static void advance_block(struct grid *grid, int32_t b, double step)
{
    const uint8_t *fixed = grid->fixed + (size_t)b * BLOCK_CELLS;
    for (int a = 0; a < 3; a++) {
        double *momentum = grid_field(grid, b, NODE_MOMENTUM + a), *force = grid_field(grid, b, NODE_FORCE + a);
        for (int n = 0; n < BLOCK_CELLS; n++) {
            bool is_fixed = fixed[n] >> a & 1;
            momentum[n] = is_fixed ? 0 : momentum[n] + force[n] * step;
            force[n] = is_fixed ? 0 : force[n];
        }
    }
}

void grid_integrate_momentum(struct grid *grid, int first, int count, double step)
{
    const int32_t blocks = grid->cells->n_blocks;
#pragma omp parallel for schedule(static) if (blocks >= grid->shared_blocks)
    for (int32_t b = 0; b < blocks; b++) {
        grid_collect(grid, b, first, count - 3, 0);
        grid_collect(grid, b, NODE_NORMAL, 3, count - 3);
        advance_block(grid, b, step);
    }
}

/* Damping force -c v on each node (thesis 4.21), v that after the step: velocity and acceleration, which
 * are those without it, change. */
THREADS_VECTORISED
static void damp_block(struct grid *grid, int32_t b, double step)
{
    const double *restrict mass = grid_field(grid, b, NODE_MASS);
    const double impulse = grid->damping * step;
    double left[BLOCK_CELLS], work[BLOCK_CELLS] = {0}, energy = 0;
    for (int n = 0; n < BLOCK_CELLS; n++)
        left[n] = mass[n] / (mass[n] + impulse);
    for (int a = 0; a < 3; a++) {
        double *restrict velocity = grid_field(grid, b, NODE_MOMENTUM + a);
        double *restrict acceleration = grid_field(grid, b, NODE_FORCE + a);
        for (int n = 0; n < BLOCK_CELLS; n++) {
            double before = velocity[n] - acceleration[n] * step, after = velocity[n] * left[n];
            work[n] += impulse * after * (before + after) + mass[n] * (after - before) * (after - before);
            acceleration[n] += (after - velocity[n]) / step;
            velocity[n] = after;
        }
    }
    for (int n = 0; n < BLOCK_CELLS; n++)
        energy += work[n];
    grid->damped[b] = 0.5 * energy;
}

double grid_damped_energy(const struct grid *grid)
{
    double energy = 0;
    for (int32_t b = 0; b < grid->cells->n_blocks && grid->damping > 0; b++)
        energy += grid->damped[b];
    return energy;
}

/* Light nodes strain and move particles with m / light_mass of their acceleration: the forces on them do
 * not go to zero with their mass. Particles still take all of the acceleration, so momentum stays. */
static void calm_block(struct grid *grid, int32_t b, double step)
{
    const double *restrict mass = grid_field(grid, b, NODE_MASS);
    for (int a = 0; a < 3; a++) {
        double *restrict velocity = grid_field(grid, b, NODE_MOMENTUM + a);
        const double *restrict acceleration = grid_field(grid, b, NODE_FORCE + a);
        for (int n = 0; n < BLOCK_CELLS; n++)
            velocity[n] -= mass[n] < grid->light_mass ? (1 - mass[n] / grid->light_mass) * acceleration[n] * step : 0;
    }
}

THREADS_VECTORISED
static void divide_block(struct grid *grid, int32_t b)
{
    const double *restrict mass = grid_field(grid, b, NODE_MASS);
    const double cutoff = grid->mass_cutoff;
    for (int f = NODE_MOMENTUM; f < NODE_STRAINING; f++) {
        double *restrict value = grid_field(grid, b, f);
        for (int n = 0; n < BLOCK_CELLS; n++)
            value[n] = mass[n] > cutoff ? value[n] / (mass[n] > cutoff ? mass[n] : 1) : 0;
    }
}

void grid_divide(struct grid *grid, double step)
{
    const int32_t blocks = grid->cells->n_blocks;
#pragma omp parallel for schedule(static) if (blocks >= grid->shared_blocks)
    for (int32_t b = 0; b < blocks; b++) {
        divide_block(grid, b);
        if (grid->damping > 0)
            damp_block(grid, b, step);
        if (grid->light_mass > 0)
            calm_block(grid, b, step);
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

void grid_integrate_block(struct grid *grid, int32_t b, double step)
{
    integrate_block(grid, b, step);
    if (grid->damping > 0)
        damp_block(grid, b, step);
    if (grid->light_mass > 0)
        calm_block(grid, b, step);
}

void grid_integrate(struct grid *grid, int first, int count, double step)
{
    const int32_t blocks = grid->cells->n_blocks;
#pragma omp parallel for schedule(static) if (blocks >= grid->shared_blocks)
    for (int32_t b = 0; b < blocks; b++) {
        grid_collect(grid, b, first, count, 0);
        grid_integrate_block(grid, b, step);
    }
}

THREADS_VECTORISED
void grid_straining_block(struct grid *grid, int32_t b, int source)
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
#pragma omp parallel for schedule(static) if (blocks >= grid->shared_blocks)
    for (int32_t b = 0; b < blocks; b++) {
        grid_collect(grid, b, first, count, 0);
        grid_straining_block(grid, b, source);
    }
}

/* Whether place n of block b is a node of the grid: wide supports reach beyond it. */
static bool is_node(const struct grid *grid, int32_t b, int n)
{
    for (int a = 0; a < 3; a++) {
        int32_t at = grid->cells->blocks[b].at[a] * BLOCK_EDGE + (n >> (2 * a) & 3);
        if (at < 0 || at >= grid->nodes[a])
            return false;
    }
    return true;
}

void grid_quotient(struct grid *grid, int first)
{
    const int32_t blocks = grid->cells->n_blocks;
#pragma omp parallel for schedule(static) if (blocks >= grid->shared_blocks)
    for (int32_t b = 0; b < blocks; b++) {
        grid_collect(grid, b, first, 2, 0);
        double *above = grid_field(grid, b, first), *below = grid_field(grid, b, first + 1);
        for (int n = 0; n < BLOCK_CELLS; n++)
            above[n] = below[n] != 0 && is_node(grid, b, n) ? above[n] / below[n] : 0;
    }
}

size_t grid_bytes(const struct grid *grid)
{
    return (grid->node_capacity + grid->patch_capacity) * sizeof *grid->node + grid->fixed_capacity;
}
