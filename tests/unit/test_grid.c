/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The grid: patches against single nodes, boundary codes, what a scatter conserves, uniform stress,
 * tractions on faces. Node values are gathered here node by node from the blocks and patches. */
#include "base/threads.h"
#include "check.h"
#include "random.h"
#include "scene_text.h"

/* --- blocks around random particles --- */

/* A run of so many particles anywhere in n cells, with linear shape functions or, for wider
 * patches, gimp. */
struct frame {
    const char *name;
    int n[3], count;
    bool is_wide;
};

static void open_frame(struct test_run *run, const struct frame *frame, const long boundary[6])
{
    struct random random = {(uint64_t)(frame->n[0] + 100 * frame->n[1] + 10000 * frame->n[2])};
    struct deck_builder deck = {0};
    deck_add(&deck, "nbbo 1\nnbmp %d\nnmat 1\ndcell 0.25\ngrid 0 %g 0 %g 0 %g\n%s\nfixed", frame->count,
             0.25 * frame->n[0], 0.25 * frame->n[1], 0.25 * frame->n[2], frame->is_wide ? "gimp" : "");
    for (int face = 0; face < 6; face++)
        deck_add(&deck, " %ld", boundary[face]);
    deck_add(&deck, "\nmate\n1 elas 1 1 0.3\npart poin 1 %d\n", frame->count);
    for (int p = 0; p < frame->count; p++) {
        double x[3];
        for (int a = 0; a < 3; a++)
            x[a] = 0.25 * random_between(&random, 0, frame->n[a]);
        deck_add(&deck, "%d 1 1 %.17g %.17g %.17g\n", p + 1, x[0], x[1], x[2]);
    }
    deck_add(&deck, "endi\n");
    test_run_open(run, &deck);
}

/* Coordinates of node n of a block. */
static void node_place(const struct cell_block *block, int n, int32_t at[3])
{
    at[0] = block->at[0] * BLOCK_EDGE + n % BLOCK_EDGE;
    at[1] = block->at[1] * BLOCK_EDGE + n / BLOCK_EDGE % BLOCK_EDGE;
    at[2] = block->at[2] * BLOCK_EDGE + n / (BLOCK_EDGE * BLOCK_EDGE);
}

/* Nodes of a patch along an axis, and in all. */
static int patch_edge(const struct grid *grid)
{
    return grid->layout.edge;
}

static int patch_size(const struct grid *grid)
{
    return grid->layout.row * patch_edge(grid) * patch_edge(grid);
}

/* Place in a patch of the block's own node 0, along an axis. */
static int patch_origin(const struct grid *grid)
{
    return grid->layout.origin;
}

/* Coordinates of node n of a block's patch; -1 for what only fills up a row. */
static void patch_place(const struct grid *grid, int32_t block, int n, int32_t at[3])
{
    const int edge = patch_edge(grid), row = grid->layout.row;
    const int place[3] = {n % row, n / row % edge, n / (row * edge)};
    for (int a = 0; a < 3; a++)
        at[a] = place[0] >= edge ? -1 : grid->cells->blocks[block].at[a] * BLOCK_EDGE + place[a] - patch_origin(grid);
}

static bool is_in_grid(const struct grid *grid, const int32_t at[3])
{
    for (int a = 0; a < 3; a++)
        if (at[a] < 0 || at[a] >= grid->nodes[a])
            return false;
    return true;
}

/* A whole number that tells node and field apart. */
static double node_mark(const int32_t at[3], int field)
{
    return 1 + field + 16 * (at[0] + 64 * (at[1] + 64.0 * at[2]));
}

enum { FIELDS = NODE_STRAINING + 3 };

static const long free_boundary[6] = {0};

/* Marks on all nodes of all fields. */
static void mark_nodes(struct grid *grid)
{
    int32_t at[3];
    for (int32_t b = 0; b < grid->cells->n_blocks; b++)
        for (int field = 0; field < FIELDS; field++)
            for (int node = 0; node < BLOCK_CELLS; node++) {
                node_place(&grid->cells->blocks[b], node, at);
                grid_field(grid, b, field)[node] = node_mark(at, field);
            }
}

/* Whether the patch of a block holds the marks of its nodes. */
static bool reads_marks(const struct grid *grid, int32_t block, int first, int fields)
{
    static double patch[FIELDS * LARGEST_PATCH];
    const ptrdiff_t stride = grid_patch(grid, 0, 1) - grid_patch(grid, 0, 0);
    bool good = true;
    int32_t at[3];
    grid_read_patch(grid, block, first, fields, patch);
    for (int node = 0; node < patch_size(grid); node++) {
        patch_place(grid, block, node, at);
        for (int f = 0; f < fields && is_in_grid(grid, at); f++)
            good = good && patch[f * stride + node] == node_mark(at, first + f);
    }
    return good;
}

/* A patch holds the values of its nodes, whichever blocks they are in. */
static void test_read_patch(const char *name, const struct frame *frame)
{
    struct test_run run;
    bool good = true;
    open_frame(&run, frame, free_boundary);
    const struct grid *grid = run.mpm->grid;
    mark_nodes(run.mpm->grid);
    for (int32_t b = 0; b < grid->cells->active; b++)
        good = good && reads_marks(grid, b, 0, 6) && reads_marks(grid, b, 4, 6) && reads_marks(grid, b, 8, 2);
    check_true(name, good && grid->cells->active > 0);
    test_run_close(&run);
}

/* Blocks with particles whose patch holds a node. */
static int blocks_that_reach(const struct grid *grid, const int32_t at[3])
{
    int count = 0;
    for (int32_t b = 0; b < grid->cells->active; b++) {
        bool reaches = true;
        for (int a = 0; a < 3; a++) {
            int32_t place = at[a] - grid->cells->blocks[b].at[a] * BLOCK_EDGE + patch_origin(grid);
            reaches = reaches && place >= 0 && place < patch_edge(grid);
        }
        count += reaches;
    }
    return count;
}

static void mark_patches(struct grid *grid, int fields)
{
    int32_t at[3];
    for (int32_t b = 0; b < grid->cells->active; b++)
        for (int node = 0; node < patch_size(grid); node++) {
            patch_place(grid, b, node, at);
            for (int f = 0; f < fields; f++)
                grid_patch(grid, b, f)[node] = node_mark(at, f);
        }
}

/* Patches add up at the nodes of the grid: the mark of each node times the blocks that reach it.
 * Mass 1 is put on every node, so that velocities are momenta. */
static void test_add_patches(const char *name, const struct frame *frame)
{
    struct test_run run;
    bool good = true;
    int32_t at[3];
    int most = 0;
    open_frame(&run, frame, free_boundary);
    struct grid *grid = run.mpm->grid;
    mark_patches(grid, 3);
    for (int32_t b = 0; b < grid->cells->n_blocks; b++)
        for (int node = 0; node < BLOCK_CELLS; node++)
            grid_field(grid, b, NODE_MASS)[node] = 1;
    grid_straining_velocity(grid, NODE_STRAINING, 3);
    for (int32_t b = 0; b < grid->cells->n_blocks; b++)
        for (int node = 0; node < BLOCK_CELLS; node++) {
            node_place(&grid->cells->blocks[b], node, at);
            int reached = blocks_that_reach(grid, at);
            most = reached > most ? reached : most;
            for (int f = 0; f < 3 && is_in_grid(grid, at); f++)
                good = good && grid_field(grid, b, NODE_STRAINING + f)[node] == reached * node_mark(at, f);
        }
    printf("   nodes get something from up to %d blocks\n", most);
    check_true(name, good);
    test_run_close(&run);
}

/* Largest deviation of velocity and acceleration of one node after grid_integrate from what its
 * marks give: v = (P + F step) / m and a = F / m, zero in fixed directions and up to the cutoff. */
static double integrate_deviation(const struct grid *grid, int32_t b, int node, double step, bool *is_above)
{
    int32_t at[3];
    double deviation = 0;
    node_place(&grid->cells->blocks[b], node, at);
    double reached = blocks_that_reach(grid, at), mass = reached * node_mark(at, 0);
    *is_above = mass > grid->mass_cutoff;
    for (int a = 0; a < 3 && is_in_grid(grid, at); a++) {
        bool moves = *is_above && !(grid->fixed[b * BLOCK_CELLS + node] >> a & 1);
        double p = reached * node_mark(at, 1 + a), f = reached * node_mark(at, 4 + a);
        double v = grid_field(grid, b, NODE_MOMENTUM + a)[node] - (moves ? (p + f * step) / mass : 0);
        double acceleration = grid_field(grid, b, NODE_FORCE + a)[node] - (moves ? f / mass : 0);
        deviation = fmax(deviation, fmax(fabs(v), fabs(acceleration)));
    }
    return deviation;
}

/* Spec 6 D with a cutoff in the middle of the masses. */
static void test_integrate(const char *name, const struct frame *frame, const long boundary[6])
{
    struct test_run run;
    const int32_t middle[3] = {frame->n[0] / 2, frame->n[1] / 2, frame->n[2] / 2};
    double step = 0.5, deviation = 0;
    int kinds[2] = {0};
    open_frame(&run, frame, boundary);
    struct grid *grid = run.mpm->grid;
    grid->mass_cutoff = node_mark(middle, 0);
    mark_patches(grid, 7);
    grid_integrate(grid, NODE_MASS, 7, step);
    for (int32_t b = 0; b < grid->cells->n_blocks; b++)
        for (int node = 0; node < BLOCK_CELLS; node++) {
            bool is_above;
            deviation = fmax(deviation, integrate_deviation(grid, b, node, step, &is_above));
            kinds[is_above]++;
        }
    check_near(name, deviation, 0, 1e-14);
    check_true("integrate: nodes above and below the cutoff", kinds[0] > 0 && kinds[1] > 0);
    test_run_close(&run);
}

/* --- boundary codes --- */

/* Bits of the fixed directions by spec 4.3: union over the faces whose outer layers hold the node. */
static int expected_fixed(const struct grid *grid, const int32_t at[3])
{
    const long *boundary = grid->boundary;
    const int layers = grid->boundary_layers;
    int fixed = 0;
    for (int a = 0; a < 3; a++) {
        bool low = at[a] < layers, high = at[a] >= grid->nodes[a] - layers;
        if ((low && boundary[2 * a] == 1) || (high && boundary[2 * a + 1] == 1))
            fixed |= 7;
        if ((low && boundary[2 * a] == 2) || (high && boundary[2 * a + 1] == 2))
            fixed |= 1 << a;
    }
    return fixed;
}

/* Whether all nodes are fixed as the codes of the grid say. */
static bool is_fixed_right(const struct grid *grid)
{
    bool good = true;
    for (int32_t b = 0; b < grid->cells->n_blocks; b++)
        for (int node = 0; node < BLOCK_CELLS; node++) {
            int32_t at[3];
            node_place(&grid->cells->blocks[b], node, at);
            good = good && (!is_in_grid(grid, at) || grid->fixed[b * BLOCK_CELLS + node] == expected_fixed(grid, at));
        }
    return good;
}

/* All combinations of codes, on faces, edges and corners; on one node layer, with wide patches on
 * two. */
static void test_boundary(const char *name, const struct frame *frame)
{
    struct test_run run;
    bool good = true;
    open_frame(&run, frame, free_boundary);
    struct grid *grid = run.mpm->grid;
    for (int code = 0; code < 729; code++) {
        for (int face = 0, left = code; face < 6; face++, left /= 3)
            grid->boundary[face] = left % 3;
        grid->version = -1;
        grid_follow(grid);
        good = good && is_fixed_right(grid);
    }
    check_true(name, good && grid->boundary_layers == (frame->is_wide ? 2 : 1));
    test_run_close(&run);
}

/* --- runs --- */

/* Opens a run with its loads at full size, as a step makes them. */
static void open_loaded(struct test_run *run, struct deck_builder *deck)
{
    test_run_open(run, deck);
    run->mpm->load_factor = 1;
}

static void scatter_all(struct mpm *mpm, int32_t b)
{
    mpm->shape->scatter(mpm, b, true, true);
}

static void scatter_momentum(struct mpm *mpm, int32_t b)
{
    mpm->shape->scatter(mpm, b, true, false);
}

static void scatter_force(struct mpm *mpm, int32_t b)
{
    mpm->shape->scatter(mpm, b, false, true);
}

enum { CLOUD = 400 };

static const int CLOUD_CELLS[3] = {7, 6, 5};

static double column_of(const struct mpm *mpm, enum column column, int a, size_t p)
{
    return mpm->store->real[column][a][p];
}

/* Random particles with random masses, velocities, volumes, stresses and loads; some on faces of
 * the grid. No mass cutoff. */
static void open_cloud(struct test_run *run, bool has_load)
{
    struct random random = {5};
    struct deck_builder deck = {0};
    deck_add(&deck, "nbbo 1\nnbmp %d\nnmat 1\ngrid 0 3.5 0 3 0 2.5\nmate\n1 elas 1 1 0.3\ndcell 0.5\n", CLOUD);
    deck_add(&deck, "part poin 1 %d\n", CLOUD);
    for (int i = 0; i < CLOUD; i++) {
        double x[3];
        for (int a = 0; a < 3; a++) {
            double high = 0.5 * CLOUD_CELLS[a];
            x[a] = random_below(&random, 12) ? random_between(&random, 0, high) : random_below(&random, 2) * high;
        }
        deck_add(&deck, "%d 1 %.17g %.17g %.17g %.17g\n", i + 1, random_between(&random, 0.1, 1), x[0], x[1], x[2]);
    }
    deck_add(&deck, "load\n");
    for (int i = 0; i < CLOUD && has_load; i++)
        deck_add(&deck, "part %d %.17g %.17g %.17g\n", i + 1, random_between(&random, -1, 1),
                 random_between(&random, -1, 1), random_between(&random, -1, 1));
    deck_add(&deck, "endl\nendi\n");
    open_loaded(run, &deck);
    for (size_t p = 0; p < CLOUD; p++) {
        for (int a = 0; a < 3; a++)
            run->mpm->store->real[COLUMN_VELOCITY][a][p] = random_between(&random, -1, 1);
        for (int a = 0; a < 6; a++)
            run->mpm->store->real[COLUMN_STRESS][a][p] = random_between(&random, -1, 1);
        run->mpm->store->real[COLUMN_VOLUME][0][p] = random_between(&random, 0.01, 0.1);
        run->mpm->store->real[COLUMN_VISCOUS_PRESSURE][0][p] = random_between(&random, 0, 1);
    }
}

/* Sums over all nodes of mass, mass times field, and their absolute values. */
static void sum_nodes(const struct mpm *mpm, int field, double *sum, double *size)
{
    *sum = *size = 0;
    for (int32_t b = 0; b < mpm->cells->n_blocks; b++)
        for (int n = 0; n < BLOCK_CELLS; n++) {
            double mass = grid_field(mpm->grid, b, NODE_MASS)[n];
            double value = field == NODE_MASS ? mass : mass * grid_field(mpm->grid, b, field)[n];
            *sum += value;
            *size += fabs(value);
        }
}

/* Scatters as the schemes do: all at once (USL, MUSL), or the force in a pass of its own (USF). */
static void scatter(struct mpm *mpm, bool at_once)
{
    if (at_once) {
        mpm_each_block(mpm, scatter_all);
        grid_integrate(mpm->grid, NODE_MASS, 7, 0);
    } else {
        mpm_each_block(mpm, scatter_momentum);
        grid_straining_velocity(mpm->grid, NODE_MASS, 4);
        mpm_each_block(mpm, scatter_force);
        grid_integrate(mpm->grid, NODE_FORCE, 3, 0);
    }
}

/* The shape functions sum to 1 and their gradients to 0: mass and momentum of the nodes are those of
 * the particles, the internal forces cancel, the external ones add up. */
static void test_conservation(bool at_once, bool has_load)
{
    struct test_run run;
    double sum, size, mass = 0, momentum[3] = {0}, load[3] = {0}, deviation = 0, force_deviation = 0;
    char name[80];
    open_cloud(&run, has_load);
    for (size_t p = 0; p < CLOUD; p++) {
        mass += column_of(run.mpm, COLUMN_MASS, 0, p);
        for (int a = 0; a < 3; a++) {
            momentum[a] += column_of(run.mpm, COLUMN_MASS, 0, p) * column_of(run.mpm, COLUMN_VELOCITY, a, p);
            load[a] += has_load ? column_of(run.mpm, COLUMN_LOAD, a, p) : 0;
        }
    }
    scatter(run.mpm, at_once);
    sum_nodes(run.mpm, NODE_MASS, &sum, &size);
    const char *passes = at_once ? "at once" : "in two passes", *loads = has_load ? " with loads" : "";
    snprintf(name, sizeof name, "scatter %s%s: mass", passes, loads);
    check_near(name, sum / mass, 1, 1e-14);
    for (int a = 0; a < 3; a++) {
        sum_nodes(run.mpm, NODE_MOMENTUM + a, &sum, &size);
        deviation = fmax(deviation, fabs(sum - momentum[a]) / size);
        sum_nodes(run.mpm, NODE_FORCE + a, &sum, &size);
        force_deviation = fmax(force_deviation, fabs(sum - load[a]) / size);
    }
    snprintf(name, sizeof name, "scatter %s%s: momentum", passes, loads);
    check_near(name, deviation, 0, 1e-14);
    snprintf(name, sizeof name, "scatter %s%s: force", passes, loads);
    check_near(name, force_deviation, 0, 1e-14);
    printf("   deviations: momentum %.2g, force %.2g\n", deviation, force_deviation);
    test_run_close(&run);
}

/* --- uniform stress and tractions --- */

/* A block of particles, `n` to a cell edge, `shift` cells off the node (3, 3, 3) of a grid of cells of
 * size 1/2, under a stress; traction on the faces of `faces` (bits 1 2 4 8 16 32 for x- x+ ...). */
struct block_test {
    int n, numbers[3];
    double shift[3], stress[6];
    int faces;
    const char *shape; /* the deck's word, or NULL: linear */
    double spacing;    /* in cells, or 0: 1 / n */
};

enum { BLOCK_GRID = 16 };

static const double CELL = 0.5;
static const int component_of[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};

static double spacing_of(const struct block_test *test)
{
    return CELL * (test->spacing > 0 ? test->spacing : 1.0 / test->n);
}

static void open_block(struct test_run *run, const struct block_test *test)
{
    static const char *const faces[] = {"x-", "x+", "y-", "y+", "z-", "z+"};
    struct deck_builder deck = {0};
    double high = BLOCK_GRID * CELL, origin[3];
    for (int a = 0; a < 3; a++)
        origin[a] = (3 + test->shift[a]) * CELL;
    deck_add(&deck, "nbbo 1\nnbmp 20000\nnmat 1\ngrid 0 %.17g 0 %.17g 0 %.17g\n", high, high, high);
    deck_add(&deck, "dcell %.17g\n%s\n", CELL, test->shape ? test->shape : "");
    deck_add(&deck, "mate\n1 elas 1 1 0.3\npart bloc 1\n1 1 %.17g %.17g %.17g %.17g %d %d %d\nload\n", spacing_of(test),
             origin[0], origin[1], origin[2], test->numbers[0], test->numbers[1], test->numbers[2]);
    for (int face = 0; face < 6; face++) {
        double sign = face % 2 ? 1 : -1;
        const double *s = test->stress;
        const int *c = component_of[face / 2];
        if (test->faces >> face & 1)
            deck_add(&deck, "face %s 1 %.17g %.17g %.17g\n", faces[face], sign * s[c[0]], sign * s[c[1]],
                     sign * s[c[2]]);
    }
    deck_add(&deck, "endl\nendi\n");
    open_loaded(run, &deck);
}

static void set_stress(struct mpm *mpm, const double stress[6])
{
    for (size_t p = 0; p < mpm->store->count; p++)
        for (int a = 0; a < 6; a++)
            mpm->store->real[COLUMN_STRESS][a][p] = stress[a];
}

/* Forces of all nodes, stress and tractions together. */
static double node_force[BLOCK_GRID + 1][BLOCK_GRID + 1][BLOCK_GRID + 1][3];

static void find_node_forces(struct mpm *mpm)
{
    int32_t at[3];
    memset(node_force, 0, sizeof node_force);
    mpm_each_block(mpm, scatter_all);
    faces_scatter(mpm, NODE_FORCE - NODE_MASS);
    for (int32_t b = 0; b < mpm->cells->active; b++)
        for (int n = 0; n < patch_size(mpm->grid); n++) {
            patch_place(mpm->grid, b, n, at);
            for (int a = 0; a < 3 && is_in_grid(mpm->grid, at); a++)
                node_force[at[2]][at[1]][at[0]][a] += grid_patch(mpm->grid, b, NODE_FORCE - NODE_MASS + a)[n];
        }
}

/* Largest node force in units of stress times face of a cell. Only nodes between `low` and `high`. */
static double largest_force(int low, int high)
{
    double largest = 0;
    for (int k = low; k <= high; k++)
        for (int j = low; j <= high; j++)
            for (int i = low; i <= high; i++)
                for (int a = 0; a < 3; a++)
                    largest = fmax(largest, fabs(node_force[k][j][i][a]) / (CELL * CELL));
    return largest;
}

/* Inner nodes of a block under uniform stress: 5 and 6 have full cells on all sides, for all shifts. */
static void test_inner_nodes(const struct block_test *test, const char *name)
{
    struct test_run run;
    struct block_test unloaded = *test;
    unloaded.faces = 0;
    open_block(&run, &unloaded);
    set_stress(run.mpm, test->stress);
    find_node_forces(run.mpm);
    check_near(name, largest_force(5, 6), 0, 1e-13);
    check_true("block: the outer nodes have forces", largest_force(0, BLOCK_GRID) > 0.1);
    test_run_close(&run);
}

/* Largest node force of a block, and mass times acceleration after the grid's pass, in the same unit. */
static double force_left(const struct block_test *test)
{
    struct test_run run;
    open_block(&run, test);
    set_stress(run.mpm, test->stress);
    find_node_forces(run.mpm);
    double force = run.mpm->centres ? 0 : largest_force(0, BLOCK_GRID), acceleration = 0;
    if (run.mpm->centres) /* nodes have their forces only now */
        run.mpm->shape->integrate(run.mpm, true);
    else
        grid_integrate(run.mpm->grid, NODE_MASS, 7, 0);
    for (int32_t b = 0; b < run.mpm->cells->n_blocks; b++)
        for (int a = 0; a < 3; a++)
            for (int n = 0; n < BLOCK_CELLS; n++) {
                double mass = grid_field(run.mpm->grid, b, NODE_MASS)[n];
                acceleration = fmax(acceleration, fabs(mass * grid_field(run.mpm->grid, b, NODE_FORCE + a)[n]));
            }
    test_run_close(&run);
    return fmax(force, acceleration / (CELL * CELL));
}

/* With tractions on all faces every node is in equilibrium, so no acceleration is left. */
static void test_equilibrium(const struct block_test *test, const char *name)
{
    const double force = force_left(test);
    printf("   largest force %.2g\n", force);
    check_near(name, force, 0, 1e-13);
}

/* One traction and no stress: the node forces add up to traction times area. */
static void test_traction_sum(const struct block_test *test, int face)
{
    struct test_run run;
    struct block_test one = *test;
    char name[80];
    double sum[3] = {0}, deviation = 0, spacing = spacing_of(test);
    double area = spacing * spacing * test->numbers[(face / 2 + 1) % 3] * test->numbers[(face / 2 + 2) % 3];
    one.faces = 1 << face;
    open_block(&run, &one);
    find_node_forces(run.mpm);
    for (int n = 0; n < (BLOCK_GRID + 1) * (BLOCK_GRID + 1) * (BLOCK_GRID + 1); n++)
        for (int a = 0; a < 3; a++)
            sum[a] += (&node_force[0][0][0][0])[3 * n + a];
    for (int a = 0; a < 3; a++) {
        double traction = (face % 2 ? 1 : -1) * test->stress[component_of[face / 2][a]];
        deviation = fmax(deviation, fabs(sum[a] - traction * area) / area);
    }
    snprintf(name, sizeof name, "face %c%c: sum of node forces", "xyz"[face / 2], face % 2 ? '+' : '-');
    check_near(name, deviation, 0, 1e-13);
    test_run_close(&run);
}

static void rebuild(struct mpm *mpm)
{
    cell_list_build(mpm->cells, mpm->store);
    grid_follow(mpm->grid);
}

/* Moving particles along x inside their cells changes nothing when only xx is stressed. */
static void test_moved_inside(const struct block_test *test, double amplitude)
{
    struct test_run run;
    struct random random = {6};
    const double stress[6] = {1.3};
    struct block_test axial = *test;
    memcpy(axial.stress, stress, sizeof stress);
    axial.faces = 3;
    open_block(&run, &axial);
    set_stress(run.mpm, stress);
    for (size_t p = 0; p < run.mpm->store->count; p++)
        run.mpm->store->real[COLUMN_POSITION][0][p] += random_between(&random, -amplitude, amplitude);
    rebuild(run.mpm);
    find_node_forces(run.mpm);
    check_near("face: equilibrium with particles moved inside their cells", largest_force(0, BLOCK_GRID), 0, 1e-13);
    test_run_close(&run);
}

/* Stretching by e, without a particle changing its cell, moves a full cell's volume away from the
 * cell's own by that fraction, and areas too; forces of that order, no more, are left. */
static void test_stretched(const struct block_test *test, double e)
{
    struct test_run run;
    double size = 0;
    open_block(&run, test);
    set_stress(run.mpm, test->stress);
    for (size_t p = 0; p < run.mpm->store->count; p++) {
        for (int a = 0; a < 3; a++) {
            double *x = &run.mpm->store->real[COLUMN_POSITION][a][p];
            *x += e * (a + 1) / 3 * (*x - BLOCK_GRID * CELL / 2);
        }
        run.mpm->store->real[COLUMN_VOLUME][0][p] *= (1 + e / 3) * (1 + 2 * e / 3) * (1 + e);
    }
    for (int a = 0; a < 6; a++)
        size = fmax(size, fabs(test->stress[a]));
    rebuild(run.mpm);
    find_node_forces(run.mpm);
    double force = largest_force(0, BLOCK_GRID) / size;
    printf("   stretched by %g: largest force %.3g of stress times cell face\n", e, force);
    check_near("face: nearly in equilibrium when stretched", force, 0, 3 * fabs(e));
    test_run_close(&run);
}

/* --- all --- */

static void test_frames(void)
{
    static const struct frame frames[] = {
        {"9 x 6 x 5", {9, 6, 5}, 60, false},  {"1 x 1 x 9", {1, 1, 9}, 12, false},
        {"4 x 4 x 4", {4, 4, 4}, 20, false},  {"8 x 8 x 8", {8, 8, 8}, 200, false},
        {"1 x 1 x 1", {1, 1, 1}, 2, false},   {"3 x 17 x 2", {3, 17, 2}, 40, false},
        {"40 x 30 x 20", {40, 30, 20}, 25, false}};
    const long boundary[6] = {2, 0, 1, 0, 0, 2};
    char name[80];
    for (size_t i = 0; i < sizeof frames / sizeof frames[0]; i++)
        for (int wide = 0; wide < 2; wide++) {
            struct frame frame = frames[i];
            const char *shape = wide ? "gimp" : "linear";
            frame.is_wide = wide;
            snprintf(name, sizeof name, "patches read: %s, %s", frame.name, shape);
            test_read_patch(name, &frame);
            snprintf(name, sizeof name, "patches added: %s, %s", frame.name, shape);
            test_add_patches(name, &frame);
            snprintf(name, sizeof name, "integrate: %s, %s", frame.name, shape);
            test_integrate(name, &frame, boundary);
            snprintf(name, sizeof name, "boundary: %s, %s", frame.name, shape);
            if (frame.n[0] < 40)
                test_boundary(name, &frame);
        }
}

static const double oblique[6] = {1.3, -0.7, 0.4, 0.25, -0.6, 0.9};

static void test_blocks(void)
{
    static const double shifts[][3] = {
        {0, 0, 0}, {0.25, 0.25, 0.25}, {0.1, 0.45, 0.8}, {-0.3, 0.05, 0.49}, {0.6, 0.7, 0.3}};
    char name[80];
    for (int n = 1; n <= 3; n++)
        for (size_t s = 0; s < sizeof shifts / sizeof shifts[0]; s++) {
            struct block_test test = {.n = n, .numbers = {6 * n, 6 * n, 6 * n}, .faces = 63};
            memcpy(test.shift, shifts[s], sizeof test.shift);
            memcpy(test.stress, oblique, sizeof test.stress);
            snprintf(name, sizeof name, "block: inner nodes, %d a cell edge, shift %zu", n, s);
            test_inner_nodes(&test, name);
            snprintf(name, sizeof name, "face: equilibrium, %d a cell edge, shift %zu", n, s);
            test_equilibrium(&test, name);
            test.numbers[0] += 1; /* the last cell is not full */
            test.numbers[2] += n + 1;
            snprintf(name, sizeof name, "face: equilibrium, %d a cell edge, shift %zu, odd numbers", n, s);
            test_equilibrium(&test, name);
        }
}

/* Wide shapes: equilibrium under all tractions wherever the faces are, for spacings of one n-th of a cell;
 * with windows as wide as the points (gimp cp) for any. */
static void test_wide_blocks(void)
{
    static const double shifts[][3] = {
        {0, 0, 0}, {0.25, 0.25, 0.25}, {0.1, 0.45, 0.8}, {-0.3, 0.05, 0.49}, {0.6, 0.7, 0.3}};
    static const char *const shapes[] = {"gimp", "gimp cp", "bimp", "sgmp"};
    char name[100];
    for (int n = 1; n <= 4; n++)
        for (size_t s = 0; s < sizeof shifts / sizeof shifts[0]; s++)
            for (int i = 0; i < 4; i++) {
                struct block_test test = {.n = n, .numbers = {4 * n + 1, 4 * n, 3 * n + 1}, .faces = 63, .shape = shapes[i]};
                memcpy(test.shift, shifts[s], sizeof test.shift);
                memcpy(test.stress, oblique, sizeof test.stress);
                snprintf(name, sizeof name, "face: equilibrium, %s, %d a cell edge, shift %zu", shapes[i], n, s);
                test_equilibrium(&test, name);
            }
    struct block_test unloaded = {.n = 2, .numbers = {8, 8, 8}, .shape = "sgmp", .stress = {1}};
    check_true("face: no equilibrium without tractions, sgmp", force_left(&unloaded) > 0.1);
    struct block_test odd = {.n = 1, .numbers = {11, 10, 9}, .faces = 63, .shape = "gimp cp", .spacing = 0.43};
    memcpy(odd.stress, oblique, sizeof odd.stress);
    test_equilibrium(&odd, "face: equilibrium, gimp cp, spacing 0.43");
    for (int i = 0; i < 3; i++) {
        odd.shape = shapes[i];
        for (int face = 0; face < 6; face++)
            test_traction_sum(&odd, face);
        struct block_test stretched = {.n = 2, .numbers = {12, 12, 12}, .faces = 63, .stress = {1, 0.5, -0.3}, .shape = shapes[i]};
        for (double e = 1e-2; e > 1e-5; e *= 0.1)
            test_stretched(&stretched, e);
    }
}

int main(void)
{
    threads_set(1); /* waiting for other threads takes longer than all the work here */
    test_frames();
    for (int at_once = 0; at_once < 2; at_once++)
        for (int has_load = 0; has_load < 2; has_load++)
            test_conservation(at_once, has_load);
    test_blocks();
    test_wide_blocks();
    struct block_test test = {.n = 2, .numbers = {12, 10, 9}, .shift = {0.3, 0.1, 0.2}, .faces = 63};
    memcpy(test.stress, oblique, sizeof test.stress);
    for (int face = 0; face < 6; face++)
        test_traction_sum(&test, face);
    test_moved_inside(&(struct block_test){.n = 2, .numbers = {12, 10, 9}, .shift = {0, 0.1, 0.2}}, 0.24 * CELL);
    struct block_test stretched = {.n = 2, .numbers = {12, 12, 12}, .faces = 63, .stress = {1, 0.5, -0.3}};
    for (double e = 1e-2; e > 1e-5; e *= 0.1)
        test_stretched(&stretched, e);
    return check_result();
}
