/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Static equilibria one after the other in a run, as a schedule of openings or loads calls for them. */
#include "check.h"
#include "mpm/equilibrium.h"
#include "scene_text.h"

enum { NX = 16, NY = 6 };

/* A clamped bar, its last layer of points loaded across; points are two a cell, near faces of cells. */
static void open_bar(struct test_run *run, const char *words, const char *law)
{
    struct deck_builder deck = {0};
    deck_add(&deck, "mpm3d\nnbco 1\nnbbo 1\nnbmp %d\nnmat 1\nspx 0 10\nspy 0 5\nspz 0 5\ndcel 1\nfixe 1 0 0 0 0 0\n%s\n", NX * NY * NY, words);
    deck_add(&deck, "quas 1e-10\nmate\n1 %s\npart bloc 1\n1 1e-3 0.5 0 0.8 0.8 %d %d %d\nload\n", law, NX, NY, NY);
    for (int i = NX; i <= NX * NY * NY; i += NX)
        deck_add(&deck, "part %d 0 0.001 0\n", i);
    deck_add(&deck, "endl\nendi\n");
    test_run_open(run, &deck);
}

/* Multiplies all loads. */
static void scale_loads(struct mpm *mpm, double factor)
{
    for (size_t p = 0; p < mpm->store->count; p++)
        mpm->store->real[COLUMN_LOAD][1][p] *= factor;
}

/* Displacement of a point along y. */
static double way_of(const struct mpm *mpm, int32_t id, double start)
{
    return mpm->store->real[COLUMN_POSITION][1][mpm->store->index_of_id[id]] - start;
}

/* Loads doubled double the way, loads gone leave the bar where it was: rate laws come back but for squares. */
static void test_sequence(void)
{
    struct test_run run;
    open_bar(&run, "", "elas 1e-3 1000 0.3");
    struct mpm *mpm = run.mpm;
    const double start = way_of(mpm, NX - 1, 0);
    check_true("first equilibrium", mpm_equilibrate(mpm) == EQUILIBRIUM_FOUND);
    const double once = way_of(mpm, NX - 1, start);
    const double reference = equilibrium_report(mpm)->reference;
    check_true("in two or three Newton steps", equilibrium_report(mpm)->newton_steps <= 3);
    check_true("balanced to the tolerance", equilibrium_report(mpm)->residual <= 1e-10);
    check_true("energy is that of the work", fabs(mpm_energy_error(mpm)) < 1e-4 && mpm->external_work > 0);
    check_near("half of the work is kept, half lost", mpm->sums.internal / mpm->external_work, 0.5, 1e-4);
    check_true("again: nothing to do", mpm_equilibrate(mpm) == EQUILIBRIUM_FOUND && equilibrium_report(mpm)->newton_steps == 0);
    check_near("and nothing moved", way_of(mpm, NX - 1, start), once, 0);
    scale_loads(mpm, 2);
    check_true("second load", mpm_equilibrate(mpm) == EQUILIBRIUM_FOUND);
    check_near("twice the load, twice the way", way_of(mpm, NX - 1, start) / once, 2, 1e-3);
    check_near("the reference is the largest load step", equilibrium_report(mpm)->reference / reference, 1, 1e-6);
    scale_loads(mpm, 0);
    check_true("no load", mpm_equilibrate(mpm) == EQUILIBRIUM_FOUND);
    check_near("back at the start", way_of(mpm, NX - 1, start) / once, 0, 1e-3);
    double fastest = 0;
    for (size_t p = 0; p < mpm->store->count; p++)
        for (int a = 0; a < 3; a++)
            fastest = fmax(fastest, fabs(mpm->store->real[COLUMN_VELOCITY][a][p]));
    check_near("nothing has a velocity", fastest, 0, 0);
    check_near("each counts one step", (double)mpm->step, 4, 0);
    test_run_close(&run);
}

/* The schemes of time stepping make no difference. */
static void test_schemes(void)
{
    static const char *const schemes[] = {"musl on", "usl on", "usf on", "xfer apic"};
    double way[4];
    for (int i = 0; i < 4; i++) {
        struct test_run run;
        open_bar(&run, schemes[i], "elas 1e-3 1000 0.3");
        mpm_equilibrate(run.mpm);
        way[i] = way_of(run.mpm, NX - 1, 0);
        test_run_close(&run);
    }
    check_true("all schemes: the same bits", way[0] == way[1] && way[0] == way[2] && way[0] == way[3]);
}

/* Large rotations: the bar is bent by a quarter of its length, in steps; then the fixed end carries the force.
 * A hyperelastic law, so the way there does not matter, at once or in four loads, but for the cells that points
 * cross in between: in a bar of three to four cells its place on the grid alone makes 5 %. */
static void test_large(void)
{
    double way[2];
    for (int i = 0; i < 2; i++) {
        struct test_run run;
        bool is_found = true;
        open_bar(&run, "jaum exact", "neoh 1e-3 20 0.3");
        const double start = way_of(run.mpm, NX - 1, 0);
        scale_loads(run.mpm, i == 0 ? 40 : 10);
        for (int load = 1; load <= (i == 0 ? 1 : 4); load++) {
            is_found = is_found && mpm_equilibrate(run.mpm) == EQUILIBRIUM_FOUND;
            scale_loads(run.mpm, (load + 1.0) / load);
        }
        check_true(i == 0 ? "bent at once" : "bent in four loads", is_found);
        way[i] = way_of(run.mpm, NX - 1, start);
        test_run_close(&run);
    }
    check_near("the same way", way[0] / way[1], 1, 5e-2);
}

/* A block that touches a held one along an edge only: it swings about that, so a force on it finds no stiffness. */
static void test_hinge(void)
{
    struct test_run run;
    struct deck_builder deck = {0};
    deck_add(&deck, "mpm3d\nnbco 1\nnbbo 2\nnbmp 128\nnmat 1\nspx 0 9\nspy 0 9\nspz 0 9\ndcel 1\nfixe 1 0 0 0 0 0\nquas 1e-6\n");
    deck_add(&deck, "mate\n1 elas 1e-3 1000 0.3\npart bloc 1\n1 1e-3 0.5 0 2 2 4 4 4\npart bloc 1\n1 1e-3 0.5 2 4 2 4 4 4\n");
    deck_add(&deck, "load\npart 128 -0.01 0 0\nendl\nendi\n");
    test_run_open(&run, &deck);
    check_true("a hinge has no equilibrium", mpm_equilibrate(run.mpm) == EQUILIBRIUM_MISSED);
    check_true("and it is told why", strstr(equilibrium_report(run.mpm)->cause, "no stiffness") != NULL);
    check_true("as an end of the run", equilibrium_check(run.mpm).is_stopped && equilibrium_check(run.mpm).particle >= 0);
    test_run_close(&run);
}

int main(void)
{
    test_sequence();
    test_schemes();
    test_large();
    test_hinge();
    return check_result();
}
