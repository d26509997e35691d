/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reproducing kernel particles in motion: points of discs and balls, free flight with all rules and kernels (row G0 of the spec's
 * 11.4), bodies that are strained uniformly, energy, momentum of what stops a body, the time step, what stops a run. */
#include "check.h"
#include "rkpm/dynamic.h"
#include "scene_text.h"

/* --- lattices --- */

static void test_lattice(void)
{
    static const struct {
        int dimension;
        double spacing;
        size_t count;
    } rows[] = {{2, 0.002, 80}, {2, 0.001, 316}, {2, 0.0005, 1264}, {3, 0.002, 552}, {3, 0.001, 4224}}; /* spec 11.4 and 12 */
    char name[60];
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const struct ball_lattice lattice = {.dimension = rows[i].dimension, .centre = {1, 2, 3}, .radius = 0.01, .spacing = rows[i].spacing};
        snprintf(name, sizeof name, "lattice: %zu points", rows[i].count);
        check_true(name, lattice_count(&lattice, 1000000) == rows[i].count);
    }
    const struct ball_lattice lattice = {.dimension = 3, .centre = {1, 2, 3}, .radius = 0.01, .spacing = 0.002};
    double x[3][552], *places[3] = {x[0], x[1], x[2]}, sum[3] = {0}, farthest = 0, nearest = 1;
    lattice_points(&lattice, places);
    for (int p = 0; p < 552; p++) {
        double square = 0;
        for (int a = 0; a < 3; a++) {
            const double arm = x[a][p] - lattice.centre[a];
            sum[a] += arm;
            square += arm * arm;
        }
        farthest = fmax(farthest, sqrt(square));
        nearest = fmin(nearest, sqrt(square));
    }
    check_near("lattice: its centre", fabs(sum[0]) + fabs(sum[1]) + fabs(sum[2]), 0, 1e-13);
    check_true("lattice: inside the ball", farthest <= 0.01 && farthest > 0.0085);
    check_near("lattice: half a spacing off the centre along each axis", nearest, 0.001 * sqrt(3), 1e-14);
    check_near("lattice: volume of a ball", lattice_volume(&lattice), 4.18879020478639e-6, 1e-18);
    check_true("lattice: more than the most", lattice_count(&lattice, 500) == 501);
}

/* A box of 3 x 2 x 2 spacings of 0.5 from (1, 2, 3) on. */
static void test_brick(void)
{
    const struct ball_lattice lattice = {.dimension = 3, .centre = {1.75, 2.5, 3.5}, .radius = 0.75, .spacing = 0.5, .numbers = {3, 2, 2}};
    double x[3][12], *places[3] = {x[0], x[1], x[2]};
    check_true("brick: points", lattice_count(&lattice, 100) == 12 && lattice_count(&lattice, 11) == 12 && lattice_count(&lattice, 5) == 6);
    check_near("brick: volume", lattice_volume(&lattice), 1.5, 1e-15);
    check_near("brick: its low end", lattice_low(&lattice, 2), 3, 1e-15);
    lattice_points(&lattice, places);
    check_near("brick: the first point is half a spacing inside", fabs(x[0][0] - 1.25) + fabs(x[1][0] - 2.25) + fabs(x[2][0] - 3.25), 0, 1e-14);
    check_near("brick: x fastest", fabs(x[0][4] - 1.75) + fabs(x[1][4] - 2.75) + fabs(x[2][4] - 3.25), 0, 1e-14);
    check_near("brick: the last point", fabs(x[0][11] - 2.25) + fabs(x[1][11] - 2.75) + fabs(x[2][11] - 3.75), 0, 1e-14);
}

/* --- runs --- */

struct motion {
    struct test_run run;
    struct dynamic *dynamic;
};

/* A deck whose block has these words; sums of width and turning are taken where curves show them. */
static void open_motion(struct motion *motion, const char *law, double step, const char *words)
{
    struct deck_builder deck = {0};
    deck_add(&deck, "mpm3d test\nmeth rkpm nmat 1 endt 1 dtfx %g\nmate\n1 %s\nrkpm\nprob dynamic\n%s\nends\ncurv widt\ncurv angm\nendi\n", step, law, words);
    memset(motion, 0, sizeof *motion);
    motion->run.diagnostics = diagnostics_open();
    motion->run.text = text_open(motion->run.diagnostics);
    text_include_memory(motion->run.text, "test", deck.text, deck.length);
    free(deck.text);
    motion->run.scene = reader_read(motion->run.text, motion->run.diagnostics);
    timers_start(&motion->run.timers);
    if (diagnostics_errors(motion->run.diagnostics) > 0) {
        diagnostics_print(motion->run.diagnostics, motion->run.text, stderr, false);
        exit(2);
    }
    motion->dynamic = rkpm_dynamic_open(motion->run.scene, &motion->run.timers);
}

static void close_motion(struct motion *motion)
{
    rkpm_dynamic_close(motion->dynamic);
    test_run_close(&motion->run);
}

/* As many steps; whether none was stopped. */
static bool advance(struct motion *motion, int steps)
{
    bool good = true;
    for (int i = 0; i < steps && good; i++)
        good = !rkpm_dynamic_advance(motion->dynamic).is_stopped;
    return good;
}

static const char MAXWELL[] = "fmax 1000 0 0.4 1 5600 0.02", OLDROYD[] = "oldr 1000 12.5 0.4 1 3.6 0.02", HOOKE[] = "neoh 1000 5600 0.4";
static const char PLANE[] = "node disc 0 0.04 0.01 0.002\n", SPACE[] = "dime 3\nnode sphere 0 0.04 0 0.01 0.004\n";

/* G0: 400 steps of 5e-5 under gravity: -1.1962 and 0.018038, and the shape stays, all to 1e-12. */
static void test_flight(void)
{
    static const char *const rules[] = {"inte dni", "inte dni grad implicit", "inte snni", "inte nsni"};
    static const char *const modes[] = {"lagrangian", "semi"};
    char words[300], name[120];
    for (int space = 0; space < 2; space++)
        for (size_t rule = 0; rule < sizeof rules / sizeof rules[0]; rule++)
            for (int mode = 0; mode < 2; mode++) {
                struct motion motion;
                snprintf(words, sizeof words, "%ssupp 2.5 %s mode %s star 0 -1 grav 0 -9.81", space ? SPACE : PLANE, rules[rule], modes[mode]);
                open_motion(&motion, rule % 2 ? OLDROYD : MAXWELL, 5e-5, words);
                const struct dynamic *dynamic = motion.dynamic;
                const double width = dynamic->sums.high[0] - dynamic->sums.low[0];
                bool good = advance(&motion, 400);
                const struct dynamic_sums *sums = &dynamic->sums;
                const double velocity = sums->momentum[1] / (dynamic->mass * (double)dynamic->count);
                good = good && fabs(velocity + 1.1962) < 1e-12 && fabs(sums->centre[1] - 0.018038) < 1e-12
                    && fabs((sums->high[0] - sums->low[0]) / width - 1) < 1e-12 && fabs(sums->least_ratio - 1) < 1e-11;
                snprintf(name, sizeof name, "G0: flight, %s, %s, %s", space ? "space" : "plane", rules[rule], modes[mode]);
                check_true(name, good);
                close_motion(&motion);
            }
}

/* Velocities that are linear in the places strain all nodes alike, by any rule: coefficients move along straight lines as long
 * as no forces act, so that F = 1 + t L after one step of length t; its volume is det F. */
static void test_linear(void)
{
    static const double slope[3][3] = {{3, 1, 0.5}, {-2, 1, 0.7}, {0.3, -0.4, -2}};
    static const char *const rules[] = {"inte dni", "inte dni grad implicit", "inte snni", "inte nsni"};
    char words[300], name[120];
    for (int space = 0; space < 2; space++)
        for (size_t rule = 0; rule < sizeof rules / sizeof rules[0]; rule++)
            for (int semi = 0; semi < 2; semi++) {
                struct motion motion;
                snprintf(words, sizeof words, "%ssupp 2.5 %s mode %s", space ? SPACE : PLANE, rules[rule], semi ? "semi" : "lagrangian");
                open_motion(&motion, HOOKE, 0.02, words);
                struct dynamic *dynamic = motion.dynamic;
                double f[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, worst = 0;
                for (int a = 0; a < dynamic->dimension; a++)
                    for (int b = 0; b < dynamic->dimension; b++) {
                        f[a][b] += 0.02 * slope[a][b];
                        for (size_t n = 0; n < dynamic->count; n++)
                            dynamic->velocity[a][n] += slope[a][b] * dynamic->rest[b][n];
                    }
                const double ratio = f[0][0] * (f[1][1] * f[2][2] - f[1][2] * f[2][1]) - f[0][1] * (f[1][0] * f[2][2] - f[1][2] * f[2][0])
                                   + f[0][2] * (f[1][0] * f[2][1] - f[1][1] * f[2][0]);
                advance(&motion, 1);
                for (size_t n = 0; n < dynamic->count; n++) {
                    for (int a = 0; a < 9; a++)
                        worst = fmax(worst, fabs(dynamic->store->real[COLUMN_DEFORMATION][a][n] + (a % 4 == 0) - f[a / 3][a % 3]));
                    worst = fmax(worst, fabs(dynamic->store->real[COLUMN_VOLUME][0][n] / dynamic->volume - ratio));
                }
                snprintf(name, sizeof name, "linear motion, %s, %s, %s", space ? "space" : "plane", rules[rule], semi ? "semi" : "lagrangian");
                check_near(name, worst, 0, 2e-12);
                close_motion(&motion);
            }
}

/* Kinetic, internal, the wall's and the weight's energy stay together, to the second order of the step; a body that sticks to a
 * wall that does not move loses what it slides away, so that it is let slide. Without a wall momentum and angular momentum stay. */
static void test_energy(void)
{
    static const char *const rules[] = {"inte dni", "inte snni", "inte nsni"};
    char words[300], name[80];
    for (size_t rule = 0; rule < sizeof rules / sizeof rules[0]; rule++) {
        double drift[2];
        for (int i = 0; i < 2; i++) {
            struct motion motion;
            snprintf(words, sizeof words, "node disc 0 0.0102 0.01 0.002 supp 2 %s star 0 -1 grav 0 -9.81 wall spring y 0 1.25e7", rules[rule]);
            open_motion(&motion, MAXWELL, i == 0 ? 1e-4 : 2.5e-5, words);
            const struct dynamic *dynamic = motion.dynamic;
            const double start = dynamic->sums.kinetic, mass = dynamic->mass * (double)dynamic->count;
            drift[i] = 0;
            for (int step = 0; step < (i == 0 ? 100 : 400); step++) {
                advance(&motion, 1);
                const struct dynamic_sums *sums = &dynamic->sums;
                const double sum = sums->kinetic + sums->internal + sums->wall_energy + mass * 9.81 * (sums->centre[1] - 0.0102);
                drift[i] = fmax(drift[i], fabs(sum / start - 1));
            }
            close_motion(&motion);
        }
        printf("   %s: energy changes by %.2e, with steps of a quarter by %.2e\n", rules[rule], drift[0], drift[1]);
        snprintf(name, sizeof name, "energy stays, %s", rules[rule]);
        check_true(name, drift[0] < 2e-2 && drift[1] < 2e-3 && drift[0] / drift[1] > 8);
    }
}

/* A neo-Hookean disc that is sheared and let go swings and turns: momentum stays to rounding, and so does angular momentum but
 * with nsni, whose stabilising stresses are those of small strains and do not turn with the body. */
static void test_momentum(void)
{
    static const char *const rules[] = {"inte dni", "inte snni", "inte nsni"};
    char words[200], name[80];
    for (size_t rule = 0; rule < sizeof rules / sizeof rules[0]; rule++) {
        struct motion motion;
        snprintf(words, sizeof words, "node disc 0 0 0.01 0.002 supp 2 %s spin 20 star 1 2", rules[rule]);
        open_motion(&motion, HOOKE, 5e-5, words);
        struct dynamic *dynamic = motion.dynamic;
        for (size_t n = 0; n < dynamic->count; n++)
            dynamic->velocity[0][n] += 50 * dynamic->rest[1][n];
        rkpm_dynamic_sum(dynamic);
        const struct dynamic_sums before = dynamic->sums;
        const bool good = advance(&motion, 500);
        const struct dynamic_sums *after = &dynamic->sums;
        snprintf(name, sizeof name, "momentum stays, %s", rules[rule]);
        check_near(name, hypot(after->momentum[0] - before.momentum[0], after->momentum[1] - before.momentum[1]) / hypot(before.momentum[0], before.momentum[1]),
                   0, 1e-12);
        snprintf(name, sizeof name, "angular momentum stays, %s", rules[rule]);
        if (rule < 2)
            check_near(name, after->angular / before.angular, 1, 1e-11);
        snprintf(name, sizeof name, "it swings, %s", rules[rule]);
        check_true(name, good && after->internal > 1e-3 * before.kinetic);
        close_motion(&motion);
    }
}

/* The time step is half the time in which a wave crosses the most compressed spacing, or an eighth of that in which shear
 * spreads over it. */
static void test_step(void)
{
    static const double stretches[3] = {0.5, 0.8, 1.25};
    for (int space = 0; space < 2; space++) {
        struct motion motion;
        char words[200];
        snprintf(words, sizeof words, "%ssupp 2.5 inte snni", space ? SPACE : PLANE);
        open_motion(&motion, OLDROYD, 0, words);
        struct dynamic *dynamic = motion.dynamic;
        const double wave = sqrt((1000 * 12.5 * 12.5 + 4.0 / 3 * 180) / 1000), spacing = dynamic->spacing;
        check_near(space ? "time step in space at rest" : "time step in the plane at rest", dynamic->time_step / (0.5 * spacing / wave), 1, 1e-12);
        /* F = R(0.7 about z) diag(stretches) */
        for (int a = 0; a < 3; a++) {
            const double s = space || a < 2 ? stretches[a] : 1;
            dynamic->store->real[COLUMN_DEFORMATION][a][7] = (a == 0 ? cos(0.7) : a == 1 ? -sin(0.7) : 0) * s - (a == 0);
            dynamic->store->real[COLUMN_DEFORMATION][3 + a][7] = (a == 0 ? sin(0.7) : a == 1 ? cos(0.7) : 0) * s - (a == 1);
            dynamic->store->real[COLUMN_DEFORMATION][6 + a][7] = (a == 2) * s - (a == 2);
        }
        check_near(space ? "time step in space, compressed" : "time step in the plane, compressed", rkpm_dynamic_limit(dynamic) / (0.5 * 0.5 * spacing / wave), 1,
                   1e-12);
        close_motion(&motion);
        open_motion(&motion, "oldr 1000 12.5 400 1 3.6 0.02", 0, words);
        check_near(space ? "time step in space, viscous" : "time step in the plane, viscous", motion.dynamic->time_step / (0.125 * spacing * spacing * 1000 / 400),
                   1, 1e-12);
        close_motion(&motion);
    }
}

/* What stops a run names the node. */
static void test_stops(void)
{
    struct motion motion;
    open_motion(&motion, MAXWELL, 1e-5, "node disc 0 0.04 0.01 0.002 supp 2 inte snni star 0 -1");
    motion.dynamic->velocity[1][17] = NAN;
    const struct instability first = rkpm_dynamic_advance(motion.dynamic);
    check_true("a value that is not finite stops the run", first.is_stopped && strstr(first.cause, "not finite") && first.particle >= 0 && first.advice[0]);
    close_motion(&motion);
    open_motion(&motion, MAXWELL, 1e-5, "node disc 0 0.04 0.01 0.002 supp 2 inte snni star 0 -1");
    motion.dynamic->store->real[COLUMN_VOLUME][0][23] *= 0.04;
    const struct instability second = rkpm_dynamic_advance(motion.dynamic);
    check_true("a node of 0.04 of its volume stops the run", second.is_stopped && strstr(second.cause, "volume of a node is 0.04") && second.particle == 23);
    close_motion(&motion);
}

int main(void)
{
    test_lattice();
    test_brick();
    test_flight();
    test_linear();
    test_energy();
    test_momentum();
    test_step();
    test_stops();
    return check_result();
}
