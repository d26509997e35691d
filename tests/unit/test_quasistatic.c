/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What brings a scene to rest: nodal damping against its closed form, mass scaling, the fixed step, and held
 * nodes, which are compared node by node with the boxes and annuli of the deck. */
#include "check.h"
#include "scene_text.h"

static const double DENSITY = 4.5e-3, YOUNG = 115000, POISSON = 0.34;

/* --- nodal damping --- */

/* A particle in the middle of a cell: each of eight nodes has an eighth of its mass, so that
 * v := v (m/8)/(m/8 + c dt), with half the step at the start. */
static void test_decay(const char *scheme, const char *shape, double factor)
{
    const double step = 1e-5, mass = DENSITY * 0.1 * 0.1 * 0.1, node = mass / 8;
    struct deck_builder deck = {0};
    struct test_run run;
    char name[100];
    double expected = 3e-6, worst = 0;
    bool shrinks = true;
    deck_add(&deck, "mpm3d decay\nnbco 1\nnbbo 1\nnbmp 1\nnmat 1\ngrid 0 2 0 2 0 2\ndcel 0.2\nendt 1\n%s on %s\n", scheme, shape);
    deck_add(&deck, "mate\n1 elas %.17g 1e-60 0\npart bloc 1\n1 %.17g 0.1 1.05 1.05 1.05 1 1 1\n", DENSITY, DENSITY);
    deck_add(&deck, "dtfx %.17g\nndam %.17g\nvelo\nnode 1 3e-6 -1.5e-6 0.75e-6\nendv\nendi\n", step, factor);
    test_run_open(&run, &deck);
    for (int n = 0; n < 20; n++) {
        const double before = run.mpm->sums.kinetic;
        expected *= node / (node + factor * (n == 0 ? 0.5 : 1) * step);
        mpm_step(run.mpm);
        for (int a = 0; a < 3; a++)
            worst = fmax(worst, fabs(run.mpm->store->real[COLUMN_VELOCITY][a][0] / ((double[]){1, -0.5, 0.25})[a] - expected));
        shrinks = shrinks && run.mpm->sums.kinetic <= before + 1e-28 * run.mpm->start_energy;
    }
    snprintf(name, sizeof name, "decay of a particle, %s %s, factor %g", scheme, shape, factor);
    check_near(name, worst, 0, 3e-18);
    snprintf(name, sizeof name, "kinetic energy only shrinks, %s %s, factor %g", scheme, shape, factor);
    check_true(name, shrinks && !mpm_check(run.mpm).is_stopped);
    check_near("what went is what damping took", run.mpm->removed_energy + run.mpm->sums.kinetic, run.mpm->start_energy,
               1e-9 * run.mpm->start_energy);
    test_run_close(&run);
}

/* A block that stays in one piece whatever the factor: the same cells, finite, slower with more damping. */
static void test_any_factor(const char *shape)
{
    double speed[4];
    for (int i = 0; i < 4; i++) {
        struct deck_builder deck = {0};
        struct test_run run;
        deck_add(&deck, "mpm3d factor\nnbco 1\nnbbo 1\nnbmp 64\nnmat 1\ngrid -0.6 1.2 -0.6 1.2 -0.6 1.2\ndcel 0.2\nendt 1\nmusl on %s\n", shape);
        deck_add(&deck, "mate\n1 elas %.17g %.17g %.17g\npart bloc 1\n1 %.17g 0.1 0.03 0.02 0.01 4 4 4\nresi 1 -500 -200 0\n", DENSITY, YOUNG, POISSON,
                 DENSITY);
        deck_add(&deck, "dtsc 0.5\nndam %.17g\nendi\n", pow(10, 3 * i));
        test_run_open(&run, &deck);
        for (int n = 0; n < 300; n++)
            mpm_step(run.mpm);
        speed[i] = run.mpm->sums.fastest;
        check_true("the run is sound", !mpm_check(run.mpm).is_stopped);
        test_run_close(&run);
    }
    printf("   largest speed after 300 steps with factors 1, 1e3, 1e6, 1e9 (%s): %.2g %.2g %.2g %.2g\n", shape, speed[0], speed[1], speed[2], speed[3]);
    check_true("stable with any factor", speed[2] < speed[1] && speed[3] < 1e-2 * speed[2] && isfinite(speed[0]) && speed[0] < 100);
}

/* --- mass scaling and weight --- */

/* The weight is that of the true mass: momentum grows by m g dt; free fall is slower by the factor. */
static void test_weight(double scale)
{
    const double mass = 27 * DENSITY * 0.1 * 0.1 * 0.1, gravity = -9.8;
    struct deck_builder deck = {0};
    struct test_run run;
    double time = 0;
    deck_add(&deck, "mpm3d weight\nnbco 1\nnbbo 1\nnbmp 27\nnmat 1\ngrid -0.4 1 -0.4 1 -0.4 1\ndcel 0.2\nendt 1\ndtsc 0.5\n");
    deck_add(&deck, "mate\n1 elas %.17g %.17g %.17g\npart bloc 1\n1 %.17g 0.1 0 0 0 3 3 3\n", DENSITY, YOUNG, POISSON, DENSITY);
    deck_add(&deck, "mscl %.17g\nload\ngrav 1 0 0 %.17g\nendl\nendi\n", scale, gravity);
    test_run_open(&run, &deck);
    const double wave = sqrt(YOUNG * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON)) / DENSITY);
    check_near("the step grows by the root of the scale", run.mpm->first_time_step, 0.5 * 0.2 / wave * sqrt(scale), 1e-15);
    for (int n = 0; n < 50; n++) {
        const double before = run.mpm->time;
        mpm_step(run.mpm);
        time += (run.mpm->time - before) * (n == 0 ? 0.5 : 1);
    }
    check_near("momentum of the weight", run.mpm->sums.momentum[2], mass * gravity * time, 1e-12 * fabs(mass * gravity * time));
    check_near("speed of the fall", run.mpm->store->real[COLUMN_VELOCITY][2][13], gravity / scale * time, 1e-10 * fabs(gravity / scale * time));
    test_run_close(&run);
}

/* --- held nodes --- */

static bool expects_hold(int axis, int which, const double place[3])
{
    const double e = 1e-9;
    if (which == 0) /* fixn 0.3 0.6 -9 9 0.3 0.3: on the lattice, whose 0.3 is 3 * 0.1 */
        return axis != 1 && place[0] > 0.3 - e && place[0] < 0.6 + e && fabs(place[2] - 0.3) < e;
    if (which == 1) { /* fixn cyli y 0.5 0.4 0.2 0.3 0 1 0: x and z */
        const double r = hypot(place[0] - 0.5, place[2] - 0.4);
        return axis == 1 && r > 0.2 - e && r < 0.3 + e;
    }
    return axis == 0 && hypot(place[1] - 0.5, place[2] - 0.5) < e; /* fixn cyli x 0.5 0.5 0 0 1 0 0 */
}

/* Every node of every block, and the motion of the nodes in a step. */
static void test_held(const char *shape)
{
    struct deck_builder deck = {0};
    struct test_run run;
    int wrong = 0, held = 0, moving = 0;
    char name[80];
    deck_add(&deck, "mpm3d held\nnbco 1\nnbbo 1\nnbmp 1000\nnmat 1\ngrid -0.2 1.2 -0.1 1.3 0 1.4\ndcel 0.1\nendt 1\nmusl on %s\n", shape);
    deck_add(&deck, "mate\n1 elas %.17g %.17g 0\npart bloc 1\n1 %.17g 0.1 0 0 0 10 10 10\nvelo\nbody 1 1 2 3\nendv\n", DENSITY, YOUNG, DENSITY);
    deck_add(&deck, "fixn 0.3 0.6 -9 9 0.3 0.3 1 0 1\nfixn cyli y 0.5 0.4 0.2 0.3 0 1 0\nfixn cyli x 0.5 0.5 0 0 1 0 0\nendi\n");
    test_run_open(&run, &deck);
    mpm_step(run.mpm);
    const struct cell_list *cells = run.mpm->cells;
    for (int32_t b = 0; b < cells->n_blocks; b++)
        for (int n = 0; n < BLOCK_CELLS; n++) {
            const int32_t node[3] = {cells->blocks[b].at[0] * BLOCK_EDGE + n % BLOCK_EDGE, cells->blocks[b].at[1] * BLOCK_EDGE + n / BLOCK_EDGE % BLOCK_EDGE,
                                     cells->blocks[b].at[2] * BLOCK_EDGE + n / (BLOCK_EDGE * BLOCK_EDGE)};
            if (node[0] > 14 || node[1] > 14 || node[2] > 14)
                continue; /* beyond the grid */
            const double place[3] = {-0.2 + 0.1 * node[0], -0.1 + 0.1 * node[1], 0.1 * node[2]};
            for (int a = 0; a < 3; a++) {
                const bool expected = expects_hold(a, 0, place) || expects_hold(a, 1, place) || expects_hold(a, 2, place);
                wrong += expected != (run.mpm->grid->fixed[(size_t)b * BLOCK_CELLS + (size_t)n] >> a & 1);
                held += expected;
                moving += expected && grid_field(run.mpm->grid, b, NODE_MOMENTUM + a)[n] != 0;
            }
        }
    printf("   %s: %d directions held, %d wrong, %d moving\n", *shape ? shape : "linear", held, wrong, moving);
    snprintf(name, sizeof name, "held nodes, %s", *shape ? shape : "linear");
    check_true(name, wrong == 0 && moving == 0 && held > 200);
    test_run_close(&run);
}

int main(void)
{
    static const char *const shapes[] = {"", "gimp", "gimp cp", "bimp", "sgmp"};
    static const char *const schemes[] = {"usl", "musl", "usf"};
    for (int s = 0; s < 3; s++)
        for (int factor = 0; factor < 3; factor++)
            test_decay(schemes[s], "", ((double[]){1e-3, 10, 1e9})[factor]);
    for (int i = 0; i < 5; i++) {
        test_any_factor(shapes[i]);
        test_held(shapes[i]);
    }
    test_weight(1);
    test_weight(25);
    test_weight(0.25);
    return check_result();
}
