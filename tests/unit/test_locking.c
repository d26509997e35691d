/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Volumetric locking: Cook's membrane in plane strain at Poisson's ratio 0.4995, by shape function.
 * A panel with corners (0, 0) (48, 44) (48, 60) (0, 44) is clamped at x = 0 and pulled upwards by a force
 * spread over its last 4 mm; 2 x 2 points in a cell of 8 mm, those on slanted edges with the part of their
 * square that is inside; damped to rest. The locking factor is the mean displacement of the loaded points
 * over the converged one.
 *
 * Converged: 15.70 (times force over Young's modulus, unit thickness): four-node finite elements with averaged
 * volume change give 15.634 15.670 15.685 with 48, 96, 192 elements along each side. Factors of this test's
 * panel with 6, 12, 24 cells in the length:
 *     linear 0.47 0.62 0.78    gimp 0.47 0.62 0.78    bimp 0.74 0.89 0.95
 *     bbar   0.94 0.97 0.99    sgmp 1.01 1.01 1.00
 * gimp locks as linear shapes do: inside their cells its points give the same weights. sgmp keeps some
 * motion that its nodes do not see, which moves its factor by 0.01 over time. */
#include "base/threads.h"
#include "check.h"
#include "scene_text.h"

enum { CELLS = 6, MOST_POINTS = 200 };

static const double LENGTH = 48, STRIP = 4, YOUNG = 1, POISSON = 0.4995, DENSITY = 1e-3, LOAD = 1e-5, CONVERGED = 15.70;
static const double LEAST_PART = 0.05; /* of a point's square; smaller ones are left out */
static const double DAMPING = 0.86, END_TIME = 20; /* about critical; then within 0.5 % of rest */

/* The points of the panel, the loaded ones last. */
struct panel {
    double size, spacing; /* of cells, between points */
    double at[MOST_POINTS][2], volume[MOST_POINTS];
    int count, first_loaded;
    double loaded_volume;
};

static void add_point(struct panel *panel, double x, double y)
{
    const double half = panel->spacing / 2;
    const double low = fmax(y - half, 44 * x / LENGTH), high = fmin(y + half, 44 + 16 * x / LENGTH);
    if (high - low < LEAST_PART * panel->spacing)
        return;
    panel->at[panel->count][0] = x;
    panel->at[panel->count][1] = y;
    panel->volume[panel->count] = panel->spacing * panel->size * (high - low);
    if (x > LENGTH - STRIP)
        panel->loaded_volume += panel->volume[panel->count];
    else
        panel->first_loaded = panel->count + 1;
    panel->count++;
}

static void fill_panel(struct panel *panel)
{
    *panel = (struct panel){.size = LENGTH / CELLS, .spacing = LENGTH / CELLS / 2};
    for (int i = 0; i < 2 * CELLS; i++)
        for (int j = 0; j < 3 * CELLS; j++)
            add_point(panel, (i + 0.5) * panel->spacing, (j + 0.5) * panel->spacing);
}

/* Wide supports have their walls one cell inside the grid. */
static void panel_deck(struct deck_builder *deck, const struct panel *panel, const char *words)
{
    const double size = panel->size;
    const double beyond = strcmp(words, "gimp") == 0 || strcmp(words, "bimp") == 0 ? size : 0;
    const double wall = strcmp(words, "sgmp") == 0 ? size : beyond;
    deck_add(deck, "mpm3d Cook's membrane\nnbco 1\nnbbo 1\nnbmp %d\nnmat 1\n", panel->count);
    deck_add(deck, "spx %.17g %.17g\nspy %.17g %.17g\n", -wall, LENGTH + 2 * size, -2 * size, 60 + 4 + 2 * size);
    deck_add(deck, "spz %.17g %.17g\ndcell %.17g\nfixed 1 0 0 0 2 2\n", -beyond, size + beyond, size);
    deck_add(deck, "usl on\ndtscale 0.5\nendt %g\nDamp %g\n%s\n", END_TIME, DAMPING, words);
    deck_add(deck, "mate\n1 elas %g %g %g\npart poin 1 %d\n", DENSITY, YOUNG, POISSON, panel->count);
    for (int i = 0; i < panel->count; i++)
        deck_add(deck, "%d 1 %.17g %.17g %.17g %.17g\n", i + 1, DENSITY * panel->volume[i], panel->at[i][0],
                 panel->at[i][1], size / 2);
    deck_add(deck, "load\n");
    for (int i = panel->first_loaded; i < panel->count; i++)
        deck_add(deck, "part %d 0 %.17g 0\n", i + 1, LOAD * size * panel->volume[i] / panel->loaded_volume);
    deck_add(deck, "endl\nendi\n");
}

/* Mean displacement of the loaded points over that of the converged solution. */
static double locking_factor(const struct panel *panel, const char *words)
{
    struct deck_builder deck = {0};
    struct test_run run;
    double sum = 0;
    panel_deck(&deck, panel, words);
    test_run_open(&run, &deck);
    while (run.mpm->time < END_TIME && !mpm_check(run.mpm).is_stopped)
        mpm_step(run.mpm);
    const struct store *store = run.mpm->store;
    for (int i = panel->first_loaded; i < panel->count; i++)
        sum += panel->volume[i] * (store->real[COLUMN_POSITION][1][store->index_of_id[i]] - panel->at[i][1]);
    test_run_close(&run);
    return sum / panel->loaded_volume * YOUNG / LOAD / CONVERGED;
}

int main(void)
{
    static const struct {
        const char *name, *words;
        double least, most; /* of the factor */
    } rows[] = {{"linear", "", 0.4, 0.5}, {"gimp", "gimp", 0.4, 0.5}, {"bimp", "bimp", 0.7, 0.8},
                {"linear, bbar", "bbar", 0.92, 0.97}, {"sgmp", "sgmp", 0.97, 1.04}};
    struct panel panel;
    threads_set(1); /* waiting for other threads takes longer than all the work here */
    fill_panel(&panel);
    printf("  Cook's membrane, plane strain, Poisson's ratio %g, %d cells in the length, %d points\n", POISSON, CELLS,
           panel.count);
    for (int i = 0; i < 5; i++) {
        char name[100];
        double factor = locking_factor(&panel, rows[i].words);
        printf("  %-14s displacement %7.3f, locking factor %.3f\n", rows[i].name, factor * CONVERGED, factor);
        snprintf(name, sizeof name, "%s: locking factor between %g and %g", rows[i].name, rows[i].least, rows[i].most);
        check_true(name, factor > rows[i].least && factor < rows[i].most);
    }
    return check_result();
}
