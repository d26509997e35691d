/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Speed of the MPM step: cost by phase and threads against the memory bandwidth of this machine,
 * its growth with the number of particles, and with laws and shape functions.
 * bench [quick], or bench laws [ROUNDS], bench features [ROUNDS] for these alone */
#include "base/memory.h"
#include "base/threads.h"
#include "deck/diagnostics.h"
#include "deck/reader.h"
#include "mpm/mpm.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- memory bandwidth --- */

enum { TRIAD_LENGTH = 20000000, TRIAD_RUNS = 5 };

/* Best of a few runs of a[i] = b[i] + s c[i], in bytes per second: three streams, as counted by
 * the STREAM benchmark. */
static double triad_bandwidth(void)
{
    double *a = memory_array(TRIAD_LENGTH, sizeof *a, "triad");
    double *b = memory_array(TRIAD_LENGTH, sizeof *b, "triad");
    double *c = memory_array(TRIAD_LENGTH, sizeof *c, "triad");
    double best = 0;
    for (int run = 0; run < TRIAD_RUNS; run++) {
        double start = threads_clock();
#pragma omp parallel for schedule(static)
        for (int i = 0; i < TRIAD_LENGTH; i++)
            a[i] = b[i] + 3.0 * c[i];
        double speed = 3.0 * sizeof(double) * TRIAD_LENGTH / (threads_clock() - start);
        best = speed > best ? speed : best;
    }
    if (a[TRIAD_LENGTH / 2] != 0)
        printf("unexpected\n");
    memory_free(a);
    memory_free(b);
    memory_free(c);
    return best;
}

/* --- bytes that a step has to move --- */

/* Columns that each pass of a MUSL step reads, and those that it writes back. */
static const enum column scatter_reads[] = {COLUMN_POSITION, COLUMN_VELOCITY, COLUMN_MASS, COLUMN_STRESS,
                                            COLUMN_VOLUME, COLUMN_VISCOUS_PRESSURE, COLUMN_NONE};
static const enum column velocity_reads[] = {COLUMN_POSITION, COLUMN_VELOCITY, COLUMN_MASS, COLUMN_NONE};
static const enum column velocity_writes[] = {COLUMN_VELOCITY, COLUMN_NONE};
static const enum column stress_reads[] = {COLUMN_POSITION, COLUMN_STRESS, COLUMN_VOLUME, COLUMN_MASS, COLUMN_ENERGY,
                                           COLUMN_VISCOUS_PRESSURE, COLUMN_BODY, COLUMN_NONE};
static const enum column stress_writes[] = {COLUMN_POSITION, COLUMN_STRESS, COLUMN_VOLUME, COLUMN_ENERGY,
                                            COLUMN_VISCOUS_PRESSURE, COLUMN_NONE};

static double bytes_of(const enum column *columns)
{
    double bytes = 0;
    for (; *columns != COLUMN_NONE; columns++) {
        const struct column_row *row = column_row(*columns);
        bytes += (double)row->components * (row->is_integer ? sizeof(int32_t) : sizeof(double));
    }
    return bytes;
}

/* With the order and the cells of the particles. */
static double bytes_per_particle_step(void)
{
    return bytes_of(scatter_reads) + bytes_of(velocity_reads) + bytes_of(velocity_writes) + bytes_of(stress_reads)
         + bytes_of(stress_writes) + 3 * sizeof(int32_t) + 2 * sizeof(uint8_t);
}

/* --- runs --- */

struct measure {
    double seconds; /* per particle-step */
    double fastest; /* the same, of the fastest step */
    double phase[PHASE_COUNT];
    double bytes; /* per particle, in memory */
};

/* The laws most used, as their lines in a deck; those with exp, log or pow say what they need them for. */
static const struct bench_law {
    const char *name, *lines, *why;
} laws[] = {
    {"elas", "1 elas 7.85e-3 210.0e3 0.30\n", ""},
    {"pla2", "1 pla2 7.85e-3 210.0e3 0.30 1.0 1000\n", ""},
    {"dpm", "1 dpm 7.85e-3 210.0e3 0.30 0.4 1.0 0.1 0.5\n", ""},
    {"null", "1 null 7.85e-3 210.0e3 1e-3\nseos 1 4 5000\n", ""},
    {"neoh", "1 neoh 7.85e-3 210.0e3 0.30\n", "log of the volume ratio; nine columns more"},
    {"hiex", "1 hiex 7.85e-3 6930\nseos 1 3 3.7 0.03 4.15 0.95 0.3 0.07\ndeto 20 20 20\n", "two exp of JWL"},
    {"john", "1 john 7.85e-3 210.0e3 0.30 1.0 2.0 0.3 0.02 1.0 293 1800 450 1e-3\n", "three pow, one log"},
    {"sjc", "1 sjc 7.85e-3 210.0e3 0.30 1.0 2.0 0.3 0.02 1e-3\nseos 1 2 4600 1.5 2.0 0\n", "two pow, one log"},
};

/* A moving block of n x n x m points, 8 a cell. */
static char *block_deck(int n, int m, const char *law, const char *words)
{
    char *deck = memory_array(4096, 1, "deck");
    int cells = (n > m ? n : m) / 2 + 12;
    snprintf(deck, 4096,
             "mpm3d block\nnbco 1\nnbbo 1\nnbmp %d\nnmat 1\ngrid 0 %d 0 %d 0 %d\ndcell 1.0\ndtscale 0.5\nendt 1\n"
             "jaum on\nmusl on\n%s\nmate\n%spart bloc 1\n1 7.85e-3 0.5 5 5 5 %d %d %d\n"
             "velo\nbody 1 10 20 30\nendv\nendi\n",
             n * n * m, cells, cells, cells, words, law, n, n, m);
    return deck;
}

/* Lets the block shear and grow longer, so that all points yield where there is plasticity. */
static void strain_block(struct mpm *mpm)
{
    double *const *x = mpm->store->real[COLUMN_POSITION], *const *v = mpm->store->real[COLUMN_VELOCITY];
    for (size_t p = 0; p < mpm->store->count; p++) {
        v[0][p] += 4 * (x[1][p] - 15);
        v[1][p] -= 2 * (x[1][p] - 15);
        v[2][p] += 3 * (x[2][p] - 15);
    }
}

static struct measure run_block(int n, int m, int threads, int steps, const char *law, const char *words)
{
    struct diagnostics *diagnostics = diagnostics_open();
    struct deck_text *text = text_open(diagnostics);
    char *deck = block_deck(n, m, law, words);
    text_include_memory(text, "bench", deck, strlen(deck));
    struct scene *scene = reader_read(text, diagnostics);
    struct timers timers;
    struct measure result = {0};
    threads_set(threads);
    timers_start(&timers);
    if (diagnostics_errors(diagnostics) > 0) {
        diagnostics_print(diagnostics, text, stderr, false);
        exit(2);
    }
    struct mpm *mpm = mpm_open(scene, &timers, diagnostics);
    strain_block(mpm);
    for (int i = 0; i < 3; i++)
        mpm_step(mpm);
    timers_start(&timers);
    double start = threads_clock(), before = start, fastest = 1e9;
    for (int i = 0; i < steps; i++) {
        mpm_step(mpm);
        double now = threads_clock();
        fastest = now - before < fastest ? now - before : fastest;
        before = now;
    }
    double updates = (double)mpm->store->count * steps;
    result.seconds = (before - start) / updates;
    result.fastest = fastest / (double)mpm->store->count;
    timers_enter(&timers, PHASE_OTHER);
    for (int phase = 0; phase < PHASE_COUNT; phase++)
        result.phase[phase] = timers.seconds[phase] / updates;
    result.bytes = (double)store_bytes_per_particle(mpm->store) + cell_list_bytes_per_particle(mpm->cells)
                 + (double)grid_bytes(mpm->grid) / (double)mpm->store->count;
    mpm_close(mpm);
    scene_close(scene);
    text_close(text);
    diagnostics_close(diagnostics);
    memory_free(deck);
    return result;
}

/* The fastest of a few runs: others on the machine only ever slow one down. */
static struct measure best_of(int runs, int n, int m, int threads, int steps)
{
    struct measure best = run_block(n, m, threads, steps, laws[0].lines, "");
    for (int i = 1; i < runs; i++) {
        struct measure next = run_block(n, m, threads, steps, laws[0].lines, "");
        if (next.seconds < best.seconds)
            best = next;
    }
    return best;
}

static void print_threads(int all, int steps)
{
    double traffic = bytes_per_particle_step();
    printf("elastic block of 160000 points, 8 a cell, musl, jaum on; %d steps, best of 3\n\n", steps);
    printf("threads   ns per particle-step   triad GB/s   bytes per particle-step   fraction of the limit   efficiency\n");
    double single = 0;
    struct measure result = {0};
    for (int threads = 1; threads <= all; threads = threads < all && 2 * threads > all ? all : 2 * threads) {
        threads_set(threads);
        double bandwidth = triad_bandwidth();
        result = best_of(3, 50, 64, threads, steps);
        single = threads == 1 ? result.seconds : single;
        printf("%7d %22.1f %12.1f %25.0f %23.2f %12.2f\n", threads, 1e9 * result.seconds, 1e-9 * bandwidth, traffic,
               traffic / bandwidth / result.seconds, single / result.seconds / threads);
        if (threads == all)
            break;
    }
    printf("\nmemory: %.0f bytes per particle\n\nphase                 ns per particle-step, %d threads\n", result.bytes, all);
    for (int phase = 0; phase < PHASE_COUNT; phase++)
        printf("%-20s %8.2f\n", timers_name((enum phase)phase), 1e9 * result.phase[phase]);
}

static void print_growth(int all, bool quick)
{
    static const struct {
        int n, m, steps;
    } sizes[] = {{20, 50, 400}, {40, 50, 100}, {50, 64, 60}, {80, 100, 20}, {100, 125, 10}, {125, 160, 6}};
    printf("\ngrowth with size                        ns per particle-step\n points     MB of particles    1 thread   %d threads\n", all);
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0] - (quick ? 3 : 0); i++) {
        struct measure single = best_of(2, sizes[i].n, sizes[i].m, 1, sizes[i].steps);
        struct measure many = best_of(2, sizes[i].n, sizes[i].m, all, sizes[i].steps);
        double points = (double)sizes[i].n * sizes[i].n * sizes[i].m;
        printf("%8.0f %14.0f %15.1f %11.1f\n", points, 1e-6 * points * single.bytes, 1e9 * single.seconds, 1e9 * many.seconds);
        fflush(stdout);
    }
}

enum { LAWS = sizeof laws / sizeof laws[0], SHAPES = 3 };

static void print_laws_table(double best[LAWS][SHAPES], int threads)
{
    printf("\n%d thread%s\n", threads, threads == 1 ? "" : "s");
    printf("law    linear    gimp    bimp   gimp/linear  bimp/linear   linear/elas  gimp/elas  bimp/elas\n");
    for (int l = 0; l < LAWS; l++) {
        printf("%-5s", laws[l].name);
        for (int s = 0; s < SHAPES; s++)
            printf(" %7.1f", 1e9 * best[l][s]);
        printf(" %13.2f %12.2f %13.2f %10.2f %10.2f  %s\n", best[l][1] / best[l][0], best[l][2] / best[l][0],
               best[l][0] / best[0][0], best[l][1] / best[0][1], best[l][2] / best[0][2], laws[l].why);
    }
}

/* Laws by shape functions. Rounds go over all cases in turn, and the fastest step of a case counts: so what
 * else the machine does meets all cases alike, and is left out as far as it can be. */
static void print_laws(int all, int rounds, int steps)
{
    static const char *const shapes[SHAPES] = {"", "gimp", "bimp"};
    static double best[2][LAWS][SHAPES];
    for (int round = 0; round < rounds; round++)
        for (int i = 0; i < 2 * SHAPES * LAWS; i++) {
            int l = i / (2 * SHAPES), s = i / 2 % SHAPES;
            double seconds = run_block(40, 40, i % 2 ? all : 1, steps, laws[l].lines, shapes[s]).fastest;
            if (round == 0 || seconds < best[i % 2][l][s])
                best[i % 2][l][s] = seconds;
        }
    printf("\nlaws by shape functions: ns per particle-step, 64000 points, fastest step of %d rounds of %d steps\n",
           rounds, steps);
    print_laws_table(best[0], 1);
    print_laws_table(best[1], all);
    fflush(stdout);
}

/* Two scenes in turn, so that what else the machine does meets both: their fastest steps, of some rounds. */
static void compare(const char *first, const char *second, int rounds, struct measure best[2])
{
    for (int round = 0; round < rounds; round++)
        for (int i = 0; i < 2; i++) {
            struct measure next = run_block(40, 40, 1, 10, laws[0].lines, i ? second : first);
            if (round == 0 || next.fastest < best[i].fastest)
                best[i] = next;
        }
}

/* What a feature costs where it is on. Where it is off nearly nothing of its own files is run (tests/check/leave_out.sh
 * counts that); what the loop over particles itself has for it, such as a test, is in both times here. */
static void print_features(int rounds)
{
    static const char *const plain = "bulk 0 0 jaum off";
    static const char *const features[][2] = {{"bulk 1.5 0.06 jaum off", "artificial viscosity"},
                                              {"bulk 0 0 jaum on", "rotation of stress"},
                                              {"bulk 0 0 jaum off Damp 1", "loads and damping"},
                                              {"bulk 0 0 jaum off ndam 1", "nodal damping"},
                                              {"bulk 0 0 jaum off bbar", "bbar"},
                                              {"bulk 0 0 jaum off xfer apic", "apic"},
                                              {"bulk 0 0 jaum off smoo para", "smoothed pressure's columns"}};
    struct measure best[2];
    printf("\nfeatures: ns per particle-step without and with, 64000 points, one thread, fastest step of %d rounds of 10\n", rounds);
    for (size_t i = 0; i < sizeof features / sizeof features[0]; i++) {
        compare(plain, features[i][0], rounds, best);
        printf("%-28s %8.1f %8.1f %8.3f times\n", features[i][1], 1e9 * best[0].fastest, 1e9 * best[1].fastest,
               best[1].fastest / best[0].fastest);
    }
    compare("", "", 1, best);
    double all = 0;
    for (int phase = 0; phase < PHASE_COUNT; phase++)
        all += best[0].phase[phase];
    printf("checks of every step (sums, energy, speeds, volumes): %.2f %% of the step\n", 100 * best[0].phase[PHASE_SUMS] / all);
}

/* The same body in a grid with edges 100 times as long. */
static void print_large_grid(int rounds)
{
    struct measure best[2];
    compare("", "grid 0 3200 0 3200 0 3200", rounds, best);
    printf("\na grid with edges 100 times as long: %.3f times the time, %.3f times the memory (%.0f, %.0f bytes per particle)\n",
           best[1].fastest / best[0].fastest, best[1].bytes / best[0].bytes, best[0].bytes, best[1].bytes);
}

int main(int count, char **arguments)
{
    bool quick = count > 1 && strcmp(arguments[1], "quick") == 0;
    threads_wait_briefly(arguments);
    int all = threads_available();
    if (count > 1 && strcmp(arguments[1], "laws") == 0) {
        print_laws(all, count > 2 ? atoi(arguments[2]) : 5, 10);
        return 0;
    }
    if (count > 1 && strcmp(arguments[1], "features") == 0) {
        print_features(count > 2 ? atoi(arguments[2]) : 5);
        print_large_grid(count > 2 ? atoi(arguments[2]) : 5);
        return 0;
    }
    print_threads(all, quick ? 20 : 60);
    print_features(quick ? 2 : 5);
    print_large_grid(quick ? 2 : 5);
    print_laws(all, quick ? 2 : 5, 10);
    print_growth(all, quick);
    return 0;
}
