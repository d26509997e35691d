/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Residual stress, phase change and hot zones: tensors against rotation matrices, particles in a zone against
 * a count on the lattice, and blocks at rest against exact solutions. */
#include "base/tensor.h"
#include "check.h"
#include "process/transformation.h"
#include "scene_text.h"

static const double PI = 3.14159265358979323846, YOUNG = 115000, POISSON = 0.34, DENSITY = 4.5e-3;
static const double ALONG = -500, ACROSS = -200;

/* A block of n[0] x n[1] x n[2] points, 0.1 apart, two a cell, from the origin, and the words that follow. */
static void block_deck(struct deck_builder *deck, const int n[3], const char *scheme, const char *words)
{
    deck_add(deck, "mpm3d block\nnbco 1\nnbbo 1\nnbmp %d\nnmat 1\n", n[0] * n[1] * n[2]);
    deck_add(deck, "grid -0.6 %.17g -0.6 %.17g -0.6 %.17g\ndcel 0.2\nendt 1\njaum off\n%s on\n", 0.1 * n[0] + 0.7, 0.1 * n[1] + 0.7,
             0.1 * n[2] + 0.7, scheme);
    deck_add(deck, "mate\n1 elas %.17g %.17g %.17g\npart bloc 1\n1 %.17g 0.1 0 0 0 %d %d %d\n%s\nendi\n", DENSITY, YOUNG, POISSON,
             DENSITY, n[0], n[1], n[2], words);
}

static double stress_of(const struct test_run *run, int a, size_t p)
{
    return run->mpm->store->real[COLUMN_STRESS][a][p];
}

/* --- the tensor --- */

/* R diag(along, across) R^T with the rotation about the build direction, as matrices. */
static void expected_residual(int axis, double degrees, const double local[3], double stress[3][3])
{
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double angle = degrees * PI / 180;
    double r[3][3] = {{0}}, s[3][3] = {{0}}, t[3][3] = {{0}};
    r[axis][axis] = 1;
    r[u][u] = r[v][v] = cos(angle);
    r[v][u] = sin(angle);
    r[u][v] = -sin(angle);
    s[u][u] = local[0];
    s[v][v] = local[1];
    s[u][v] = s[v][u] = local[2];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++)
                t[i][j] += r[i][k] * s[k][j];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            stress[i][j] = 0;
            for (int k = 0; k < 3; k++)
                stress[i][j] += t[i][k] * r[j][k];
        }
}

static void test_tensor(int axis, double angle, double shear)
{
    static const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
    const double local[3] = {ALONG, ACROSS, shear};
    struct deck_builder deck = {0};
    struct test_run run;
    double expected[3][3], worst = 0;
    char words[120], name[80];
    snprintf(words, sizeof words, "buil %c\nscan 10 %.17g\nresi 1 %.17g %.17g %.17g", "xyz"[axis], angle, ALONG, ACROSS, shear);
    block_deck(&deck, (int[3]){2, 2, 2}, "musl", words);
    test_run_open(&run, &deck);
    for (size_t p = 0; p < 8; p++) {
        bool is_second = run.mpm->store->real[COLUMN_POSITION][axis][p] > 0.1;
        expected_residual(axis, is_second ? angle : 10, local, expected);
        for (int a = 0; a < 6; a++)
            worst = fmax(worst, fabs(run.mpm->store->real[COLUMN_RESIDUAL][a][p] - expected[row[a]][column[a]]));
    }
    snprintf(name, sizeof name, "residual stress at %g degrees, shear %g, built along %c", angle, shear, "xyz"[axis]);
    check_near(name, worst, 0, 1e-11);
    if (axis == 2 && angle == 45 && shear == 0) {
        const size_t p = (size_t)run.mpm->store->index_of_id[7];
        check_near("at 45 degrees: -350", run.mpm->store->real[COLUMN_RESIDUAL][0][p], -350, 1e-11);
        check_near("at 45 degrees: a shear of -150", run.mpm->store->real[COLUMN_RESIDUAL][5][p], -150, 1e-11);
    }
    test_run_close(&run);
}

/* --- blocks at rest --- */

struct extent {
    double mean[6], deviation[6]; /* of the stress over particles, by volume */
    double low[3], high[3];
    double moved;
};

static struct extent measure(const struct test_run *run)
{
    const struct store *store = run->mpm->store;
    struct extent e = {{0}, {0}, {INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, 0};
    double volume = 0;
    for (size_t p = 0; p < store->count; p++) {
        volume += store->real[COLUMN_VOLUME][0][p];
        for (int a = 0; a < 6; a++)
            e.mean[a] += stress_of(run, a, p) * store->real[COLUMN_VOLUME][0][p];
        for (int a = 0; a < 3; a++) {
            e.low[a] = fmin(e.low[a], store->real[COLUMN_POSITION][a][p]);
            e.high[a] = fmax(e.high[a], store->real[COLUMN_POSITION][a][p]);
        }
    }
    for (int a = 0; a < 6; a++)
        e.mean[a] /= volume;
    for (size_t p = 0; p < store->count; p++)
        for (int a = 0; a < 6; a++)
            e.deviation[a] = fmax(e.deviation[a], fabs(stress_of(run, a, p) - e.mean[a]));
    return e;
}

static const char *const RELAXING = "mscl 25\ndtfx 5e-5\nndam 5\n";

/* Free: stress is that of the deck, everywhere, and the strains follow from it (log strains, sum of increments). */
static void test_free(const char *scheme, double angle)
{
    struct deck_builder deck = {0};
    struct test_run run;
    double expected[3][3], worst = 0, spread = 0;
    char words[200], name[80];
    snprintf(words, sizeof words, "%sGhost endG\nopen all\nscan %.17g\nresi 1 %.17g %.17g 0", RELAXING, angle, ALONG, ACROSS);
    block_deck(&deck, (int[3]){6, 6, 4}, scheme, words);
    test_run_open(&run, &deck);
    for (int step = 0; step < 3000; step++)
        mpm_step(run.mpm);
    const struct extent e = measure(&run);
    expected_residual(2, angle, (double[3]){ALONG, ACROSS, 0}, expected);
    const double six[6] = {expected[0][0], expected[1][1], 0, 0, 0, expected[0][1]};
    for (int a = 0; a < 6; a++) {
        worst = fmax(worst, fabs(e.mean[a] - six[a]));
        spread = fmax(spread, e.deviation[a]);
    }
    printf("   free at %g degrees, %s: mean off by %.2g, particles by %.2g from it\n", angle, scheme, worst, spread);
    snprintf(name, sizeof name, "free at %g degrees, %s: mean stress", angle, scheme);
    check_near(name, worst, 0, 0.002 * 500);
    snprintf(name, sizeof name, "free at %g degrees, %s: uniform", angle, scheme);
    check_near(name, spread, 0, 0.01 * 500);
    const double strain[2] = {(six[0] - POISSON * six[1]) / YOUNG, (six[1] - POISSON * six[0]) / YOUNG};
    if (angle == 0 || angle == 90)
        for (int a = 0; a < 2; a++) {
            snprintf(name, sizeof name, "free at %g degrees, %s: strain along %c", angle, scheme, "xy"[a]);
            check_near(name, log((e.high[a] - e.low[a]) / 0.5), strain[a], 0.005 * 500 / YOUNG);
        }
    check_near("it gets thicker", log((e.high[2] - e.low[2]) / 0.3), POISSON * 700 / YOUNG, 0.005 * 500 / YOUNG);
    test_run_close(&run);
}

/* Four lateral planes held, top and bottom free: nothing moves, stress stays 0, the total is what the deck says. */
static void test_held_around(const char *scan)
{
    struct deck_builder deck = {0};
    struct test_run run;
    char words[300], name[80];
    double worst = 0, moved = 0;
    snprintf(words, sizeof words, "%sGhost endG\nopen layer every 20\nscan %s\nresi 1 %.17g %.17g 0\n"
             "fixn 0 0 -9 9 -9 9 1 1 1\nfixn 0.8 0.8 -9 9 -9 9 1 1 1\nfixn -9 9 0 0 -9 9 1 1 1\nfixn -9 9 0.8 0.8 -9 9 1 1 1",
             RELAXING, scan, ALONG, ACROSS);
    block_deck(&deck, (int[3]){8, 8, 4}, "musl", words);
    test_run_open(&run, &deck);
    for (int step = 0; step < 500; step++)
        mpm_step(run.mpm);
    for (size_t p = 0; p < run.mpm->store->count; p++) {
        const int id = run.mpm->store->integer[COLUMN_ID][p];
        const double start[3] = {0.05 + 0.1 * (id % 8), 0.05 + 0.1 * (id / 8 % 8), 0.05 + 0.1 * (id / 64)};
        for (int a = 0; a < 3; a++)
            moved = fmax(moved, fabs(run.mpm->store->real[COLUMN_POSITION][a][p] - start[a]));
        for (int a = 0; a < 6; a++)
            worst = fmax(worst, fabs(stress_of(&run, a, p)));
    }
    printf("   held around, scan %s: moved %.2g, stress %.2g\n", scan, moved, worst);
    snprintf(name, sizeof name, "held around, scan %s: no motion", scan);
    check_near(name, moved, 0, 1e-6);
    snprintf(name, sizeof name, "held around, scan %s: no stress", scan);
    check_near(name, worst, 0, 1);
    test_run_close(&run);
}

/* Bottom held: no force on any cut parallel to it, so the volume means of the total zz, xz, yz vanish. */
static void test_held_bottom(void)
{
    struct deck_builder deck = {0};
    struct test_run run;
    char words[300];
    snprintf(words, sizeof words, "%sGhost endG\nopen layer every 20\nscan 0 45 90\nresi 1 %.17g %.17g 0\nfixn -9 9 -9 9 0 0 1 1 1",
             RELAXING, ALONG, ACROSS);
    block_deck(&deck, (int[3]){6, 6, 6}, "musl", words);
    test_run_open(&run, &deck);
    for (int step = 0; step < 4000; step++)
        mpm_step(run.mpm);
    const struct extent e = measure(&run);
    printf("   bottom held: means xx %.1f yy %.1f, zz %.2g yz %.2g xz %.2g\n", e.mean[0], e.mean[1], e.mean[2], e.mean[3], e.mean[4]);
    check_near("bottom held: mean zz", e.mean[2], 0, 0.5);
    check_near("bottom held: mean yz", e.mean[3], 0, 0.5);
    check_near("bottom held: mean xz", e.mean[4], 0, 0.5);
    check_true("bottom held: part of the stress is kept", e.mean[0] < -100 && e.mean[0] > -400);
    test_run_close(&run);
}

/* --- phase change --- */

/* Free: every length changes by a third of the volume strain (log strains), without stress. */
static void test_phase(const char *scheme)
{
    const double before = 4.35, after = 4.494, strain = (before - after) / after / 3;
    struct deck_builder deck = {0};
    struct test_run run;
    char words[200], name[80];
    snprintf(words, sizeof words, "%sphas 1 %.17g %.17g\nGhost endG\nopen all", RELAXING, before, after);
    block_deck(&deck, (int[3]){6, 4, 4}, scheme, words);
    test_run_open(&run, &deck);
    const double virtual_stress = stress_of(&run, 0, 0); /* before anything moves: E eps_V/(3 (1 - 2 nu)), contraction pulls */
    check_near("stress of a phase change that is held", virtual_stress, -YOUNG * 3 * strain / (3 * (1 - 2 * POISSON)), 1e-9);
    for (int step = 0; step < 4000; step++)
        mpm_step(run.mpm);
    const struct extent e = measure(&run);
    for (int a = 0; a < 3; a++) {
        snprintf(name, sizeof name, "phase change, %s: strain along %c", scheme, "xyz"[a]);
        check_near(name, log((e.high[a] - e.low[a]) / (a == 0 ? 0.5 : 0.3)), strain, 0.006 * fabs(strain)); /* edges of the block lie inside cells */
        snprintf(name, sizeof name, "phase change, %s: no stress %c", scheme, "xyz"[a]);
        check_near(name, fabs(e.mean[a]) + e.deviation[a], 0, 0.002 * fabs(virtual_stress));
    }
    test_run_close(&run);
}

/* --- hot zone --- */

enum { LATTICE = 13, MIDDLE = (LATTICE * LATTICE * LATTICE + 1) / 2 };

/* Lattice points nearer than `radius` spacings, or as near, to a point of it. */
static int count_within(double radius, bool with_surface)
{
    int count = 0;
    for (int i = -9; i <= 9; i++)
        for (int j = -9; j <= 9; j++)
            for (int k = -9; k <= 9; k++)
                count += i * i + j * j + k * k < radius * radius || (with_surface && i * i + j * j + k * k == radius * radius);
    return count;
}

/* The point in the middle opens in step 1 and heats those around it. */
static void test_zone(double radius, int expected)
{
    const double change = 3 * YOUNG / (3 * (1 - 2 * POISSON)) * 0.012; /* 3 K times the strain */
    static const char *const signs[] = {"heat", "cool", ""};
    for (int sign = 0; sign < 3; sign++) {
        struct deck_builder deck = {0};
        struct test_run run;
        char words[200], name[80];
        /* a step too short for any motion: all there is comes from the zone */
        snprintf(words, sizeof words, "dtfx 1e-13\nGhost GPD 1 %d 1 GPD %d 0 endG\nopen point every 3\nther 1 1e-5 1200 %.17g %s",
                 LATTICE * LATTICE * LATTICE, MIDDLE, 0.1 * radius, signs[sign]);
        block_deck(&deck, (int[3]){LATTICE, LATTICE, LATTICE}, "usl", words);
        test_run_open(&run, &deck);
        mpm_step(run.mpm);
        int hot = 0;
        double worst = 0;
        for (size_t p = 0; p < run.mpm->store->count; p++) {
            bool is_hot = fabs(stress_of(&run, 0, p)) > 0.5 * change;
            hot += is_hot;
            for (int a = 0; a < 3 && is_hot; a++)
                worst = fmax(worst, fabs(stress_of(&run, a, p) - (sign == 1 ? change : -change)));
        }
        snprintf(name, sizeof name, "radius %g %s: particles in the zone", radius, signs[sign]);
        check_near(name, hot, expected, 0);
        snprintf(name, sizeof name, "radius %g %s: the list agrees", radius, signs[sign]);
        check_near(name, (double)heat_count(run.mpm->heat), expected, 0);
        snprintf(name, sizeof name, "radius %g %s: their stress", radius, signs[sign]);
        check_near(name, worst, 0, 1e-6 * change);
        for (int step = 1; step < 4; step++)
            mpm_step(run.mpm);
        worst = 0;
        for (size_t p = 0; p < run.mpm->store->count; p++)
            for (int a = 0; a < 6; a++)
                worst = fmax(worst, fabs(stress_of(&run, a, p)));
        snprintf(name, sizeof name, "radius %g %s: off again", radius, signs[sign]);
        check_near(name, worst, 0, 1e-6 * change);
        check_near("no particle is left in the zone", (double)heat_count(run.mpm->heat), 0, 0);
        check_near("no energy either", run.mpm->sums.internal, 0, 1e-6 * change * 0.012 * expected * 1e-3);
        test_run_close(&run);
    }
}

/* The radius is that of the particle that opens, the strain that of each particle. */
static void test_two_materials(void)
{
    struct deck_builder deck = {0};
    struct test_run run;
    int hot[2] = {0, 0};
    deck_add(&deck, "mpm3d two\nnbco 1\nnbbo 2\nnbmp 54\nnmat 2\ngrid -0.6 1.2 -0.6 1.2 -0.6 1.2\ndcel 0.2\nendt 1\ndtfx 1e-13\nmate\n");
    deck_add(&deck, "1 elas 4.5e-3 1000 0\n2 elas 4.5e-3 3000 0\npart bloc 1\n1 4.5e-3 0.1 0 0 0 3 3 3\n");
    deck_add(&deck, "part bloc 1\n2 4.5e-3 0.1 0.3 0 0 3 3 3\nGhost GPD 1 54 1 GPD 15 0 GPD 40 0 endG\nopen point every 2\n");
    deck_add(&deck, "ther 1 1e-5 1000 0.11\nther 2 2e-5 1000 0.15 cool\nendi\n"); /* 1: 6 neighbours; 2: 18 */
    test_run_open(&run, &deck);
    for (int opening = 0; opening < 2; opening++) {
        /* 15 is the middle of the side at material 2, 40 next to it: the zone of 15 has itself, five
         * neighbours and 40, which is still closed; that of 40 has 18 neighbours, five of them in material 1 */
        hot[0] = hot[1] = 0;
        mpm_step(run.mpm);
        bool good = true;
        for (size_t p = 0; p < 54; p++) {
            const int body = run.mpm->store->integer[COLUMN_BODY][p];
            const double stress = stress_of(&run, 0, p), expected = body == 0 ? -1000 * 0.01 : 3000 * 0.02;
            if (fabs(stress) < 1e-3)
                continue;
            hot[body]++;
            good = good && fabs(stress - expected) < 1e-4;
        }
        check_true("each particle has its own strain", good);
        check_near("zone in material 1", hot[0], opening == 0 ? 6 : 5, 0);
        check_near("zone in material 2", hot[1], opening == 0 ? 0 : 14, 0);
        mpm_step(run.mpm);
    }
    test_run_close(&run);
}

/* --- energy --- */

/* Energy that is not accounted for after a history at a step and at a quarter of it: first order. */
static double energy_error(const char *scheme, const char *words, double damping, int divisor)
{
    struct deck_builder deck = {0};
    struct test_run run;
    char all[400];
    snprintf(all, sizeof all, "mscl 25\ndtfx %.17g\nndam %.17g\n%s\nGhost GPD 1 9 1 endG\nopen group 4 every %d", 5e-5 / divisor, damping,
             words, 20 * divisor);
    block_deck(&deck, (int[3]){3, 3, 3}, scheme, all);
    test_run_open(&run, &deck);
    for (int step = 0; step < 200 * divisor; step++)
        mpm_step(run.mpm);
    double error = fabs(mpm_energy_error(run.mpm));
    test_run_close(&run);
    return error;
}

static void test_energy(void)
{
    static const struct {
        const char *name, *words;
        double damping;
    } cases[] = {{"resi", "resi 1 -500 -200 0\nscan 0 45", 0},
                 {"phas", "phas 1 0.99 1", 0},
                 {"ther", "ther 1 1e-5 500 0.15", 0},
                 {"resi and ndam", "resi 1 -500 -200 0\nscan 0 45", 5},
                 {"phas and ndam", "phas 1 0.99 1", 5},
                 {"ther and ndam", "ther 1 1e-5 500 0.15", 5},
                 {"fixn and ndam", "resi 1 -500 -200 0\nfixn -9 9 -9 9 0 0 1 1 1", 5}};
    static const char *const schemes[] = {"usl", "musl", "usf"};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        for (int s = cases[i].damping > 0 ? 0 : 1; s < 3; s++) { /* usl alone loses energy at nodes of small mass */
            char name[100];
            const double coarse = energy_error(schemes[s], cases[i].words, cases[i].damping, 4);
            const double fine = energy_error(schemes[s], cases[i].words, cases[i].damping, 16);
            printf("   energy balance with %s, %s: %.2e, %.2e at a quarter of the step\n", cases[i].name, schemes[s], coarse, fine);
            snprintf(name, sizeof name, "energy balance with %s, %s", cases[i].name, schemes[s]);
            check_true(name, fine < 0.4 * coarse || fine < 1e-4);
        }
}

int main(void)
{
    const double angles[] = {0, 30, 45, 90, 135, -20};
    for (int axis = 0; axis < 3; axis++)
        for (size_t i = 0; i < sizeof angles / sizeof angles[0]; i++) {
            test_tensor(axis, angles[i], 0);
            test_tensor(axis, angles[i], 70);
        }
    test_free("musl", 0);
    test_free("usl", 90);
    test_free("musl", 45);
    test_free("musl", 30);
    test_held_around("0");
    test_held_around("0 45 90");
    test_held_bottom();
    test_phase("musl");
    test_phase("usl");
    check_near("lattice points nearer than 5 spacings", count_within(5, false), 485, 0);
    check_near("with those on the surface", count_within(5, true), 515, 0);
    test_zone(5, 485);
    test_zone(4.3, count_within(4.3, false));
    test_zone(0.4, 1);
    test_two_materials();
    test_energy();
    return check_result();
}
