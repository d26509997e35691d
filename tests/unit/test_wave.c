/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An elastic bar in its first free standing mode over one period: velocity against the exact mode
 * v = v0 cos(pi x / L) cos(pi c t / L), at four resolutions, first at rest in the grid, then
 * travelling through it by an eighth of its length, so that every point crosses cells. The error
 * is the root of the mean square over points and steps, relative to that of the mode.
 *
 * Velocity and stress leapfrog: usl and musl start with v at 0, stress at 0 and half a kick, so v
 * after n steps belongs to t_n - dt/2. usf strains before it kicks: its stress after n steps is the
 * sum of dt times v_0 ... v_(n-1), which belongs to t_n when v_n belongs to t_n + dt/2; its half
 * kick in the first step makes v_1 right to second order. The exact mode is taken at these times. */
#include "check.h"
#include "scene_text.h"

static const double LENGTH = 1.0, YOUNG = 1.0, DENSITY = 1.0, AMPLITUDE = 1e-7, PI = 3.14159265358979323846;

/* A bar of `cells` cells, 2 x 2 x 2 points a cell, nu 0, with empty grid at both ends. */
static void bar_deck(struct deck_builder *deck, int cells, const char *scheme, double travel_speed)
{
    double size = LENGTH / cells, spacing = size / 2;
    deck_add(deck, "mpm3d bar\nnbco 1\nnbbo 1\nnbmp %d\nnmat 1\n", 8 * cells);
    deck_add(deck, "grid %.17g %.17g 0 %.17g 0 %.17g\ndcell %.17g\nfixed 0 0 2 2 2 2\n", -LENGTH, 2 * LENGTH, size, size, size);
    deck_add(deck, "dtscale 0.5\nendt 10\nbulk 0 0\n%s on\nmate\n1 elas %.17g %.17g 0\n", scheme, DENSITY, YOUNG);
    deck_add(deck, "part bloc 1\n1 %.17g %.17g 0 0 0 %d 2 2\nvelo\n", DENSITY, spacing, 2 * cells);
    for (int id = 0; id < 8 * cells; id++) {
        double x = (id % (2 * cells) + 0.5) * spacing;
        deck_add(deck, "node %d %.17g 0 0\n", id + 1, travel_speed + AMPLITUDE * cos(PI * x / LENGTH));
    }
    deck_add(deck, "endv\nendi\n");
}

/* Mean square of the velocity errors after a step. */
static double squared_error(const struct mpm *mpm, int cells, double step, double travel_speed, double wave_speed)
{
    double shift = mpm->scene->scheme == SCHEME_USF ? 0.5 : -0.5;
    double sum = 0, spacing = LENGTH / cells / 2, time = mpm->time + shift * step;
    for (int id = 0; id < 2 * cells; id++) { /* the rows across the bar are alike */
        double x = (id + 0.5) * spacing;
        double exact = travel_speed + AMPLITUDE * cos(PI * x / LENGTH) * cos(PI * wave_speed * time / LENGTH);
        double error = mpm->store->real[COLUMN_VELOCITY][0][mpm->store->index_of_id[id]] - exact;
        sum += error * error;
    }
    return sum / (2 * cells);
}

static double error_of(int cells, const char *scheme, double travel)
{
    struct deck_builder deck = {0};
    struct test_run run;
    double wave_speed = sqrt(YOUNG / DENSITY), period = 2 * LENGTH / wave_speed, sum = 0, speed = travel * LENGTH / period;
    long steps = 0;
    bar_deck(&deck, cells, scheme, speed);
    test_run_open(&run, &deck);
    while (run.mpm->time < period) {
        double step = run.mpm->time_step;
        mpm_step(run.mpm);
        sum += squared_error(run.mpm, cells, step, speed, wave_speed);
        steps++;
    }
    test_run_close(&run);
    return sqrt(sum / (double)steps) / (AMPLITUDE / 2); /* the mode's own root mean square */
}

/* Errors at four resolutions and the order between the last two. */
static double print_row(const char *scheme, double travel, double errors[4])
{
    double order = 0;
    printf("  %-5s %-8s", scheme, travel > 0 ? "crossing" : "at rest");
    for (int i = 0; i < 4; i++) {
        errors[i] = error_of(8 << i, scheme, travel);
        printf("  %.3e", errors[i]);
        if (i > 0) {
            order = log2(errors[i - 1] / errors[i]);
            printf(" (%4.2f)", order);
        }
    }
    printf("\n");
    return order;
}

int main(void)
{
    static const char *const schemes[] = {"usf", "usl", "musl"};
    printf("  velocity error of the first mode, and order, with 8, 16, 32, 64 cells in the length\n");
    for (int s = 0; s < 3; s++) {
        double rest[4], crossing[4];
        char name[80];
        double order = print_row(schemes[s], 0, rest);
        print_row(schemes[s], 0.125, crossing);
        snprintf(name, sizeof name, "%s converges with order %.2f before points cross cells", schemes[s], order);
        check_true(name, order >= 1.8);
        snprintf(name, sizeof name, "%s: cell crossing costs a factor %.1f at 64 cells", schemes[s], crossing[3] / rest[3]);
        check_true(name, crossing[3] < 0.1);
    }
    return check_result();
}
