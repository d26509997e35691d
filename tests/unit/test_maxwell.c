/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The generalised Maxwell law at a point, against closed forms: rows M1 to M5 of the spec's 11.3, bulk relaxation, rotation.
 * In M1 to M4 one element without a spring beside it is strained uniaxially, (1, -nu, -nu) 1e-3, by a ramp of a unit of
 * time or by a jump; with viscosity eta the relaxation time is eta/mu. */
#include "check.h"
#include "material/law.h"
#include "material/maxwell.h"

#include <string.h>

enum { MOST = 3, EXPONENTIAL = 1, MIDPOINT = 2, VOLUME = 4 };

static const double NU = 0.3, STRAIN = 1e-3, ETA = 5;

/* One point. */
struct point {
    struct law_element elements[MOST];
    struct material material;
    double strain[6], trace, stress[6], spin[3], history[6 * MOST];
    double *columns[6 * MOST];
};

/* A point at rest: long-time modulus, and elements of moduli E and relaxation times. */
static void start_point(struct point *point, unsigned words, double long_time, int n, const double (*elements)[2])
{
    memset(point, 0, sizeof *point);
    point->material = (struct material){.law = &law_maxw, .parameter = {1, long_time, NU}, .elements = point->elements,
                                        .n_elements = n, .words = words};
    for (int i = 0; i < n; i++)
        point->elements[i] = (struct law_element){.strength = elements[i][0], .time = elements[i][1]};
    for (int k = 0; k < 6 * MOST; k++)
        point->columns[k] = &point->history[k];
    check_true("maxw: a material is accepted", !law_maxw.prepare(&point->material));
}

static struct law_batch batch_of(struct point *point, double time_step)
{
    struct law_batch batch = {.count = 1, .material = &point->material, .time_step = time_step, .trace = &point->trace,
                              .history = point->columns};
    for (int a = 0; a < 6; a++) {
        batch.strain[a] = &point->strain[a];
        batch.stress[a] = &point->stress[a];
    }
    for (int a = 0; a < 3; a++)
        batch.spin[a] = &point->spin[a];
    return batch;
}

/* One step with the strain increment of the point. */
static void advance(struct point *point, double time_step)
{
    point->trace = point->strain[0] + point->strain[1] + point->strain[2];
    const struct law_batch batch = batch_of(point, time_step);
    law_maxw.update(&batch);
}

static void set_uniaxial(struct point *point, double strain)
{
    point->strain[0] = strain;
    point->strain[1] = point->strain[2] = -NU * strain;
}

static double deviator(const struct point *point)
{
    return point->stress[0] - (point->stress[0] + point->stress[1] + point->stress[2]) / 3;
}

/* eta/mu of an element of modulus E. */
static double time_of(double young)
{
    return ETA * 2 * (1 + NU) / young;
}

/* Deviatoric stress after a ramp of a unit of time in `steps` steps. */
static double ramp(unsigned words, double young, double time, int steps)
{
    struct point point;
    start_point(&point, words, 0, 1, (const double[][2]){{young, time}});
    set_uniaxial(&point, STRAIN / steps);
    for (int i = 0; i < steps; i++)
        advance(&point, 1.0 / steps);
    return deviator(&point);
}

/* 2 mu lambda rate (1 - exp(-1/lambda)) with the rate of the deviator, 2/3 (1 + nu) 1e-3. */
static double ramp_exact(double young, double time)
{
    return young / (1 + NU) * time * 2.0 / 3 * (1 + NU) * STRAIN * -expm1(-1 / time);
}

/* M1. The midpoint rule is wrong by the factor (x/2)/sinh(x/2), x = dt/lambda, at all times. */
static void test_ramp(void)
{
    static const struct {
        double young, expected;
    } cases[] = {{10, 4.6507988000e-3}, {100, 8.6627118595e-3}}; /* spec 11.3, M1 */
    char name[80];
    for (int i = 0; i < 2; i++)
        for (int steps = 1; steps <= 100; steps *= 10) {
            const double young = cases[i].young, time = time_of(young), exact = ramp_exact(young, time);
            const double x = 1 / (steps * time), factor = 0.5 * x / sinh(0.5 * x);
            snprintf(name, sizeof name, "M1: ramp, E %g, %d steps, exponential rule", young, steps);
            check_near(name, ramp(0, young, time, steps) / exact, 1, 1e-12);
            snprintf(name, sizeof name, "M1: ramp, E %g, %d steps, midpoint rule", young, steps);
            check_near(name, ramp(MIDPOINT, young, time, steps) / exact, factor, 1e-12);
            snprintf(name, sizeof name, "M1: ramp, E %g, %d steps, the listed stress", young, steps);
            check_near(name, ramp(EXPONENTIAL, young, time, steps) / cases[i].expected, 1, 1e-9);
        }
    static const struct {
        double young, error;
        int steps;
    } listed[] = {{10, -2.465e-4, 10}, {100, -2.424e-2, 10}, {10, -2.465e-6, 100}, {100, -2.465e-4, 100}};
    for (int i = 0; i < 4; i++) {
        const double time = time_of(listed[i].young);
        snprintf(name, sizeof name, "M1: listed error of the midpoint rule, E %g, %d steps", listed[i].young, listed[i].steps);
        check_near(name, (ramp(MIDPOINT, listed[i].young, time, listed[i].steps) / ramp_exact(listed[i].young, time) - 1) / listed[i].error,
                   1, 5e-4);
    }
}

/* Deviatoric stress at 1 of a strain that jumps at 0.5, in a step of no length before the `steps` steps from there to 1, or
 * within the step that ends at 0.5. */
static double relaxation(unsigned words, double young, int steps, bool jumps_within)
{
    struct point point;
    start_point(&point, words, 0, 1, (const double[][2]){{young, time_of(young)}});
    set_uniaxial(&point, STRAIN);
    advance(&point, jumps_within ? 0.5 / steps : 0);
    set_uniaxial(&point, 0);
    for (int i = 0; i < steps; i++)
        advance(&point, 0.5 / steps);
    return deviator(&point);
}

/* M2 and M3. */
static void test_relaxation(void)
{
    static const struct {
        double young, expected;
    } cases[] = {{10, 4.53808266e-3}, {100, 1.42411595e-3}}; /* spec 11.3, M2 */
    char name[80];
    for (int i = 0; i < 2; i++)
        for (int rule = EXPONENTIAL; rule <= MIDPOINT; rule++)
            for (int steps = 1; steps <= 1000; steps *= 10) {
                const double exact = 2.0 / 3 * STRAIN * cases[i].young * exp(-0.5 / time_of(cases[i].young));
                const double stress = relaxation((unsigned)rule, cases[i].young, steps, false);
                snprintf(name, sizeof name, "M2: relaxation, E %g, %d steps, %s", cases[i].young, steps, law_maxw.words[rule - 1]);
                check_near(name, stress / exact, 1, 1e-12);
                snprintf(name, sizeof name, "M2: relaxation, E %g, %d steps, %s: the listed stress", cases[i].young, steps,
                         law_maxw.words[rule - 1]);
                check_near(name, stress / cases[i].expected, 1, 4e-9); /* half a unit of its last digit */
            }
    static const struct {
        int steps;
        double error;
    } listed[] = {{5, -3.77e-2}, {10, -1.90e-2}, {50, -3.84e-3}}; /* spec 11.3, M3: dt 0.1, 0.05, 0.01 */
    for (int i = 0; i < 3; i++) {
        snprintf(name, sizeof name, "M3: jump within one of %d steps", listed[i].steps);
        check_near(name, (relaxation(MIDPOINT, 10, listed[i].steps, true) / cases[0].expected - 1) / listed[i].error, 1, 1e-2);
    }
}

/* M4: steps long against the relaxation time. Midpoint: (x/2)/sinh(x/2) - 1. */
static void test_stiff(void)
{
    static const struct {
        double ratio, error;
    } listed[] = {{1, -4.05e-2}, {10, -0.933}, {100, -1}, {1000, -1}}; /* spec 11.3, M4 */
    char name[80];
    for (int i = 0; i < 4; i++) {
        const double time = 0.1 / listed[i].ratio, exact = ramp_exact(100, time);
        snprintf(name, sizeof name, "M4: stiff ramp, dt/lambda %g, exponential rule", listed[i].ratio);
        check_near(name, ramp(EXPONENTIAL, 100, time, 10) / exact, 1, 1e-11);
        snprintf(name, sizeof name, "M4: stiff ramp, dt/lambda %g, midpoint rule", listed[i].ratio);
        check_near(name, ramp(MIDPOINT, 100, time, 10) / exact - 1, listed[i].error, 1e-3);
    }
}

/* M5: 1000 cycles in a million steps of deviatoric strain diag(1, -1, 0) sin(2 pi t), mu_0 1, 0.2 of it without end: the
 * stress a sin + b cos with a = 2 (0.2 + 0.8 w^2/(1 + w^2)), b = 1.6 w/(1 + w^2), w = 2 pi. Spec 11.3 lists the largest error,
 * 4.2e-7 of the amplitude, which is of second order in the step, and allows 2 % of it. */
static void test_cycles(unsigned words)
{
    const double dt = 1e-3, w = 2 * acos(-1), share = 2 * (1 + NU);
    const double in_phase = 1.9604727631, out_of_phase = 0.2483569538; /* spec 11.3, M5 */
    struct point point;
    char name[80];
    double first = 0, last = 0;
    start_point(&point, words, 0.2 * share, 1, (const double[][2]){{0.8 * share, 1}});
    check_near("M5: closed form, in phase", 2 * (0.2 + 0.8 * w * w / (1 + w * w)), in_phase, 1e-10);
    check_near("M5: closed form, out of phase", 1.6 * w / (1 + w * w), out_of_phase, 1e-10);
    for (int i = 1; i <= 1000000; i++) {
        const double phase = w * (i % 1000) * dt, before = w * ((i - 1) % 1000) * dt;
        point.strain[0] = sin(phase) - sin(before);
        point.strain[1] = -point.strain[0];
        advance(&point, dt);
        const double error = fabs(point.stress[0] - in_phase * sin(phase) - out_of_phase * cos(phase)) / hypot(in_phase, out_of_phase);
        if (i > 20000 && i <= 21000) /* what came with the start is gone by exp(-20) */
            first = fmax(first, error);
        if (i > 999000)
            last = fmax(last, error);
    }
    const char *rule = words == MIDPOINT ? "midpoint" : "exponential";
    printf("   %s rule: largest error %.3e in cycle 21, %.3e in cycle 1000\n", rule, first, last);
    snprintf(name, sizeof name, "M5: cyclic strain, %s rule: error", rule);
    check_near(name, last / 4.2e-7, 1, 0.02);
    snprintf(name, sizeof name, "M5: cyclic strain, %s rule: no drift", rule);
    check_near(name, last - first, 0, 1e-8);
}

/* Three elements, with and without bulk relaxation: after a jump of any strain each part relaxes by its own exponentials,
 * sigma = K(t) tr + 2 mu(t) dev. The moduli at once limit the time step. */
static void test_all_parts(unsigned words)
{
    static const double elements[][2] = {{20, 0.1}, {30, 1}, {40, 7}}, strain[6] = {1e-3, -3e-3, 5e-3, 7e-3, -11e-3, 13e-3};
    const double time = 0.9, trace = 3e-3;
    struct point point;
    double young = 10, deviation = 0;
    start_point(&point, words, 10, 3, elements);
    check_near("maxw: modulus at once limits the step", point.material.wave_speed, sqrt(100 * (1 - NU) / ((1 + NU) * (1 - 2 * NU))),
               1e-12);
    memcpy(point.strain, strain, sizeof strain);
    advance(&point, 0);
    memset(point.strain, 0, sizeof point.strain);
    for (int i = 0; i < 9; i++)
        advance(&point, time / 9);
    for (int i = 0; i < 3; i++)
        young += elements[i][0] * exp(-time / elements[i][1]);
    const double shear = young / (2 * (1 + NU)), bulk = (words & VOLUME ? young : 100) / (3 * (1 - 2 * NU));
    for (int a = 0; a < 6; a++) {
        const double expected = a < 3 ? bulk * trace + 2 * shear * (strain[a] - trace / 3) : shear * strain[a];
        deviation = fmax(deviation, fabs(point.stress[a] - expected));
    }
    check_near(words & VOLUME ? "maxw: three elements, pressure relaxes" : "maxw: three elements, pressure does not relax", deviation, 0,
               1e-14);
}

/* A point that is strained, and then turned by a quarter in 1000 steps while it relaxes, has the stress of one that
 * is not turned, turned in the end: components xx and yy change places, xz becomes yz, and so on. The exact rotation turns
 * by 2 atan(w/2) a step. */
static void test_turn(void)
{
    static const double elements[][2] = {{20, 0.1}, {30, 1}}, strain[6] = {1e-3, -3e-3, 5e-3, 7e-3, -11e-3, 13e-3};
    struct point still, turned;
    start_point(&still, VOLUME, 10, 2, elements);
    memcpy(still.strain, strain, sizeof strain);
    advance(&still, 0);
    memset(still.strain, 0, sizeof still.strain);
    start_point(&turned, VOLUME, 10, 2, elements);
    memcpy(turned.strain, strain, sizeof strain);
    advance(&turned, 0);
    memset(turned.strain, 0, sizeof turned.strain);
    turned.spin[2] = 2 * tan(acos(-1) / 4000); /* 1000 steps of pi/2000 */
    for (int i = 0; i < 1000; i++) {
        const struct law_batch batch = batch_of(&turned, 1e-3);
        law_rotate_exact(&batch);
        law_rotate_history(&batch, law_rotate_exact);
        advance(&turned, 1e-3);
        advance(&still, 1e-3);
    }
    const double *s = still.stress, expected[6] = {s[1], s[0], s[2], s[4], -s[3], -s[5]};
    double deviation = 0;
    for (int a = 0; a < 6; a++)
        deviation = fmax(deviation, fabs(turned.stress[a] - expected[a]));
    check_near("maxw: stress and elements turn with the point", deviation, 0, 1e-13);
}

/* Points of a batch, from any place of the history on, are updated as each alone, and nothing else is touched. */
static void test_batch(void)
{
    enum { POINTS = 13, FROM = 3, COUNT = 7 };
    static const double elements[][2] = {{20, 0.1}, {30, 1}};
    double strain[6][POINTS], trace[POINTS], stress[6][POINTS], history[12][POINTS], *columns[12];
    struct point point;
    bool good = true;
    start_point(&point, VOLUME, 10, 2, elements);
    for (int j = 0; j < POINTS; j++) {
        for (int a = 0; a < 6; a++) {
            strain[a][j] = 1e-3 * sin(1 + a + 7 * j);
            stress[a][j] = sin(2 + 3 * a + j);
        }
        trace[j] = strain[0][j] + strain[1][j] + strain[2][j];
        for (int k = 0; k < 12; k++)
            history[k][j] = cos(k + 5 * j), columns[k] = history[k];
    }
    struct law_batch batch = {.count = COUNT, .material = &point.material, .time_step = 0.02, .trace = trace + FROM,
                              .history = columns, .history_from = FROM};
    for (int a = 0; a < 6; a++)
        batch.strain[a] = strain[a] + FROM, batch.stress[a] = stress[a] + FROM;
    law_maxw.update(&batch);
    for (int j = 0; j < POINTS; j++) {
        for (int a = 0; a < 6; a++) {
            point.strain[a] = strain[a][j];
            point.stress[a] = sin(2 + 3 * a + j);
        }
        for (int k = 0; k < 12; k++)
            point.history[k] = cos(k + 5 * j);
        if (j >= FROM && j < FROM + COUNT)
            advance(&point, 0.02);
        for (int a = 0; a < 6; a++)
            good = good && point.stress[a] == stress[a][j];
        for (int k = 0; k < 12; k++)
            good = good && point.history[k] == history[k][j];
    }
    check_true("maxw: a batch is its points", good);
}

/* Steps of no length and of any length: nothing overflows, and the share goes to 1/x. */
static void test_factors(void)
{
    for (int rule = MAXWELL_EXPONENTIAL; rule <= MAXWELL_MIDPOINT; rule++) {
        const struct maxwell_factors none = maxwell_factors((enum maxwell_rule)rule, 0, 3), all = maxwell_factors((enum maxwell_rule)rule, 1e300, 1);
        check_true("maxw: a step of no length is elastic", none.decay == 1 && none.share == 1);
        check_true("maxw: an endless step leaves nothing", all.decay == 0 && all.share < 1e-299);
    }
    const struct maxwell_factors small = maxwell_factors(MAXWELL_EXPONENTIAL, 1e-9, 1), large = maxwell_factors(MAXWELL_EXPONENTIAL, 1e3, 1);
    check_near("maxw: share of a short step, 1 - x/2", small.share, 1 - 0.5e-9, 1e-16);
    check_near("maxw: share of a long step, 1/x", large.share, 1e-3, 1e-18);
}

/* Both rules at once are refused. */
static void test_words(void)
{
    struct law_element element = {.strength = 1, .time = 1};
    struct material material = {.law = &law_maxw, .parameter = {1, 1, NU}, .elements = &element, .n_elements = 1,
                                .words = EXPONENTIAL | MIDPOINT};
    check_true("maxw: one rule", law_maxw.prepare(&material) != NULL);
}

int main(void)
{
    test_factors();
    test_ramp();
    test_relaxation();
    test_stiff();
    test_cycles(EXPONENTIAL);
    test_cycles(MIDPOINT);
    test_all_parts(0);
    test_all_parts(VOLUME);
    test_turn();
    test_batch();
    test_words();
    return check_result();
}
