/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An elastic block that vibrates in free flight for 10 000 steps, by each scheme: linear momentum
 * must stay to round-off, energy as the scheme keeps it; first without any point changing cell,
 * then flying through the grid. Nodes below the mass cutoff are left out of the transfers and
 * take their force with them: with the dialect's cutoff, crossing cells therefore costs momentum;
 * without it (dcell after mate) it does not.
 *
 * The sum of kinetic and internal energy as printed ripples with the phase of the vibration, as the
 * two belong to times half a step apart (of first order in the step); what a scheme loses or gains
 * for good is the difference of means over many periods. */
#include "check.h"
#include "scene_text.h"

enum { EDGE = 6, STEPS = 10000, WINDOW = 1000 };

/* Points 2 x 2 x 2 a cell, stretched along x by the start velocity, on top of a flight velocity. */
static void block_deck(struct deck_builder *deck, const char *scheme, double flight, double stretching, bool has_cutoff)
{
    deck_add(deck, "mpm3d block\nnbco 1\nnbbo 1\nnbmp %d\nnmat 1\ngrid 0 40 0 40 0 40\n", EDGE * EDGE * EDGE);
    deck_add(deck, "%sdtscale %g\nendt 1e9\nbulk 0 0\n%s on\n", has_cutoff ? "dcell 1\n" : "",
             flight > 0 ? 0.3 : 0.05, scheme);
    deck_add(deck, "mate\n1 elas 1 1 0.3\n%spart bloc 1\n1 1 0.5 2 2 2 %d %d %d\nvelo\n", has_cutoff ? "" : "dcell 1\n",
             EDGE, EDGE, EDGE);
    for (int id = 0; id < EDGE * EDGE * EDGE; id++) {
        double x = 0.5 * (id % EDGE - 0.5 * (EDGE - 1));
        deck_add(deck, "node %d %.17g %.17g %.17g\n", id + 1, flight + stretching * x, 0.7 * flight, 0.4 * flight);
    }
    deck_add(deck, "endv\nendi\n");
}

struct drift {
    double momentum; /* largest, relative to the sum of m |v| at the start */
    double energy;   /* mean over the last WINDOW steps less that over the first, relative to the vibration's */
    double ripple;   /* largest change of kinetic + internal as printed, relative to the same */
    double moved;    /* cell changes a point */
    long steps;      /* fewer than STEPS when the run became unstable */
};

/* Sum of m |v|, and the energy of the vibration alone. */
static void start_scales(const struct mpm *mpm, double *momentum, double *energy)
{
    double mass = 0, flight = 0;
    *momentum = 0;
    for (size_t p = 0; p < mpm->store->count; p++) {
        double m = mpm->store->real[COLUMN_MASS][0][p], square = 0;
        for (int a = 0; a < 3; a++)
            square += mpm->store->real[COLUMN_VELOCITY][a][p] * mpm->store->real[COLUMN_VELOCITY][a][p];
        mass += m;
        *momentum += m * sqrt(square);
    }
    for (int a = 0; a < 3; a++)
        flight += 0.5 * mpm->start_momentum[a] * mpm->start_momentum[a] / mass;
    *energy = mpm->start_energy - flight;
}

static struct drift fly(const char *scheme, double flight, double stretching, bool has_cutoff)
{
    struct deck_builder deck = {0};
    struct test_run run;
    struct drift drift = {0};
    double momentum, energy, moved = 0;
    block_deck(&deck, scheme, flight, stretching, has_cutoff);
    test_run_open(&run, &deck);
    const struct mpm *mpm = run.mpm;
    start_scales(mpm, &momentum, &energy);
    while (drift.steps < STEPS) {
        mpm_step(run.mpm);
        if (mpm_check(mpm).is_stopped || fabs(mpm->unbalanced) > 100 * energy)
            break;
        drift.steps++;
        moved += mpm->sums.moved;
        for (int a = 0; a < 3; a++)
            drift.momentum = fmax(drift.momentum, fabs(mpm->sums.momentum[a] - mpm->start_momentum[a]) / momentum);
        drift.ripple = fmax(drift.ripple, fabs(mpm->sums.kinetic + mpm->sums.internal - mpm->start_energy) / energy);
        double window = drift.steps <= WINDOW ? -1.0 : drift.steps > STEPS - WINDOW ? 1.0 : 0;
        drift.energy += window * mpm->unbalanced / energy / WINDOW;
    }
    drift.moved = moved / (double)mpm->store->count;
    test_run_close(&run);
    return drift;
}

static void print_drift(const char *scheme, const char *what, const struct drift *drift)
{
    printf("  %-5s %-20s momentum %.1e  energy %+.2e (ripple %.1e)  %5.1f cell changes a point, %ld steps%s\n", scheme, what,
           drift->momentum, drift->energy, drift->ripple, drift->moved, drift->steps,
           drift->steps < STEPS ? ", then unstable" : "");
}

int main(void)
{
    static const char *const schemes[] = {"usf", "usl", "musl"};
    char name[120];
    printf("  elastic block in free flight, %d steps: drift of momentum and of the vibration's energy\n", STEPS);
    for (int s = 0; s < 3; s++) {
        bool is_usl = strcmp(schemes[s], "usl") == 0;
        struct drift rest = fly(schemes[s], 0, 1e-4, true);
        struct drift cutoff = fly(schemes[s], 5e-3, 1e-3, true), whole = fly(schemes[s], 5e-3, 1e-3, false);
        print_drift(schemes[s], "within cells:", &rest);
        print_drift(schemes[s], "crossing, cutoff:", &cutoff);
        print_drift(schemes[s], "crossing, no cutoff:", &whole);
        snprintf(name, sizeof name, "%s keeps momentum within cells", schemes[s]);
        check_true(name, rest.momentum < 1e-12 && rest.moved == 0);
        snprintf(name, sizeof name, "%s keeps momentum across cells without cutoff", schemes[s]);
        check_true(name, whole.momentum < 1e-12);
        snprintf(name, sizeof name, "%s within cells: energy drift %.1e", schemes[s], rest.energy);
        check_true(name, is_usl ? rest.energy < 0 : fabs(rest.energy) < 1e-3);
    }
    return check_result();
}
