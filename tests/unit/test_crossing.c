/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cell crossing: a soft bar in tension moves through the grid at a constant speed, and the noise of its
 * stress is measured once it has gone three cells.
 *
 * Forces on the points, -dS/dX of S = peak sin(pi X / length), balance the stress S(X) at the material
 * place X whatever the law and the strain, as the section keeps its area (Poisson's ratio 0, walls
 * beside the bar). Damping brings the bar to this state; gravity gives back what it takes from the speed.
 * The peak is 5 % of Young's modulus, so points come to lie at all places in their cells, and a cell has one,
 * two or three of them. The speed is 2 % of the wave's.
 *
 * Linear shapes throw the stress off by most of its mean each time a point changes cell, whatever transfers the
 * velocities: it comes from the jump of the gradients. pic and apic are not the cure. Points that reach
 * into the next cells before they cross are: gimp, bimp, sgmp.
 * xfer apic keeps a point's velocity gradient, which is that of the light node that a point meets when it enters an
 * empty cell; where that node's acceleration goes into the gradient unlimited, the run ends there. */
#include "base/threads.h"
#include "check.h"
#include "scene_text.h"

enum { CELLS = 16, POINTS = 2 * CELLS };

static const double PI = 3.14159265358979323846, PEAK = 0.05, SPEED = 0.02, DAMPING = 0.2, FROM = 3, TO = 6;

/* Stress at the end of point i - 1 and the start of point i, and the mean over point i. */
static double stress_before(int i)
{
    return PEAK * sin(PI * i / POINTS);
}

static double stress_in(int i)
{
    return PEAK * POINTS / PI * (cos(PI * i / POINTS) - cos(PI * (i + 1) / POINTS));
}

/* A row of points along the middle of a channel of one cell, two in each cell. Units: cell size, density
 * and Young's modulus are 1. */
static void bar_deck(struct deck_builder *deck, const char *words)
{
    bool is_wide = strcmp(words, "gimp") == 0 || strcmp(words, "bimp") == 0;
    const char *across = is_wide ? "-1 2" : "0 1";
    deck_add(deck, "mpm3d bar\nnbco 1\nnbbo 1\nnbmp %d\nnmat 1\n", POINTS);
    deck_add(deck, "spx -6 30\nspy %s\nspz %s\ndcell 1\nfixed 0 0 2 2 2 2\n", across, across);
    deck_add(deck, "dtscale 0.5\nendt 1e9\nbulk 0 0\nDamp %g\n%s\n", DAMPING, words);
    deck_add(deck, "mate\n1 elas 1 1 0\npart poin 1 %d\n", POINTS);
    for (int i = 0; i < POINTS; i++)
        deck_add(deck, "%d 1 0.5 %.17g 0.5 0.5\n", i + 1, (i + 0.5) / 2);
    deck_add(deck, "load\ngrav 1 %.17g 0 0\n", DAMPING * SPEED);
    for (int i = 0; i < POINTS; i++)
        deck_add(deck, "part %d %.17g 0 0\n", i + 1, stress_before(i) - stress_before(i + 1));
    deck_add(deck, "endl\nvelo\nbody 1 %.17g 0 0\nendv\nendi\n", SPEED);
}

/* Root mean square of the stress's deviation over the mean stress. */
static double stress_noise(const struct mpm *mpm)
{
    double sum = 0;
    for (int i = 0; i < POINTS; i++) {
        double deviation = mpm->store->real[COLUMN_STRESS][0][mpm->store->index_of_id[i]] - stress_in(i);
        sum += deviation * deviation;
    }
    return sqrt(sum / POINTS) / (2 / PI * PEAK);
}

struct noise {
    double mean, worst; /* root mean square, and largest, from three cells on */
    double cells;       /* way of the bar; less than TO where the run became unstable */
};

static struct noise cross(const char *words)
{
    struct deck_builder deck = {0};
    struct test_run run;
    struct noise noise = {0};
    long steps = 0;
    bar_deck(&deck, words);
    test_run_open(&run, &deck);
    while (noise.cells < TO) {
        mpm_step(run.mpm);
        if (mpm_check(run.mpm).is_stopped)
            break;
        noise.cells = SPEED * run.mpm->time;
        if (noise.cells < FROM)
            continue;
        double now = stress_noise(run.mpm);
        noise.worst = fmax(noise.worst, now);
        noise.mean += now * now;
        steps++;
    }
    noise.mean = sqrt(noise.mean / (double)steps);
    test_run_close(&run);
    return noise;
}

static void print_noise(const char *name, const struct noise *noise, double linear)
{
    printf("  %-14s", name);
    if (noise->cells < TO)
        printf(" unstable after %.2f cells\n", noise->cells);
    else
        printf(" %.3f, at most %.3f; %.1f times quieter than linear\n", noise->mean, noise->worst,
               linear / noise->mean);
}

int main(void)
{
    static const struct {
        const char *name, *words;
        double factor; /* quieter than linear at least; 0: only shown */
    } rows[] = {{"linear", "", 0}, {"linear, pic", "xfer pic", 0}, {"linear, apic", "xfer apic", 0},
                {"sgmp", "sgmp", 5}, {"gimp", "gimp", 5}, {"bimp", "bimp", 5}};
    double linear = 0;
    threads_set(1); /* waiting for other threads takes longer than all the work here */
    printf("  bar in tension moving %g cells: deviation of the stress over its mean, after %g cells\n", TO, FROM);
    for (int i = 0; i < 6; i++) {
        char name[100];
        struct noise noise = cross(rows[i].words);
        linear = i == 0 ? noise.mean : linear;
        print_noise(rows[i].name, &noise, linear);
        if (rows[i].factor == 0)
            continue;
        snprintf(name, sizeof name, "%s: stress at least %g times quieter than linear across cells", rows[i].name,
                 rows[i].factor);
        check_true(name, noise.cells >= TO && rows[i].factor * noise.mean < linear);
    }
    return check_result();
}
