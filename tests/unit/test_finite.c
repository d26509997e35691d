/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laws of finite strain at a point: rows F1 to F6 of the spec's 11.3, steps that are long against the relaxation time, that
 * conformation stays positive, small strains, points of a batch. */
#include "check.h"
#include "base/symmetric.h"
#include "base/tensor.h"
#include "material/law.h"
#include "random.h"

#include <string.h>

enum { MOST = 20, MOST_HISTORY = 7 + 6 * MOST };
enum { MAXWELL_EXPONENTIAL_WORD = 1, MAXWELL_MIDPOINT_WORD = 2, OLDROYD_STRANG = 1, OLDROYD_LIE = 2, OLDROYD_EXPONENTIAL = 4 };

/* One point. */
struct point {
    struct law_element elements[MOST];
    struct material material;
    double strain[6], spin[3], trace, volume_before, volume, stress[6], terms[2], history[MOST_HISTORY];
    double *columns[MOST_HISTORY];
};

static void start_point(struct point *point, const struct law *law, unsigned words, const double *parameters, int n, const double (*elements)[2])
{
    memset(point, 0, sizeof *point);
    point->material = (struct material){.law = law, .elements = point->elements, .n_elements = n, .words = words};
    for (int i = 0; i < argument_count(law->parameters); i++)
        point->material.parameter[i] = parameters[i];
    for (int i = 0; i < n; i++)
        point->elements[i] = (struct law_element){.strength = elements[i][0], .time = elements[i][1]};
    for (int k = 0; k < MOST_HISTORY; k++)
        point->columns[k] = &point->history[k];
    point->volume = 1;
    const char *wrong = law->prepare(&point->material);
    if (wrong)
        check_true(wrong, false);
}

static struct law_batch batch_of(struct point *point, double time_step)
{
    struct law_batch batch = {.count = 1, .material = &point->material, .time_step = time_step, .trace = &point->trace,
                              .volume_before = &point->volume_before, .volume = &point->volume,
                              .terms = {&point->terms[0], &point->terms[1]}, .history = point->columns};
    for (int a = 0; a < 6; a++) {
        batch.strain[a] = &point->strain[a];
        batch.stress[a] = &point->stress[a];
    }
    for (int a = 0; a < 3; a++)
        batch.spin[a] = &point->spin[a];
    return batch;
}

/* One step with a relative gradient less 1, as strain and spin of particles are made of it. */
static void advance(struct point *point, double time_step, double g[3][3])
{
    const double strain[6] = {g[0][0], g[1][1], g[2][2], g[1][2] + g[2][1], g[0][2] + g[2][0], g[0][1] + g[1][0]};
    memcpy(point->strain, strain, sizeof strain);
    point->spin[0] = 0.5 * (g[2][1] - g[1][2]);
    point->spin[1] = 0.5 * (g[0][2] - g[2][0]);
    point->spin[2] = 0.5 * (g[1][0] - g[0][1]);
    point->trace = strain[0] + strain[1] + strain[2];
    point->volume_before = point->volume;
    const struct law_batch batch = batch_of(point, time_step);
    point->material.law->update(&batch);
}

/* --- gradients --- */

static void multiply(double a[3][3], double b[3][3], double c[3][3])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            c[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
}

/* after before^-1 - 1 */
static void relative(double before[3][3], double after[3][3], double g[3][3])
{
    double inverse[3][3];
    tensor_inverse(before, tensor_determinant(before), inverse);
    multiply(after, inverse, g);
    for (int a = 0; a < 3; a++)
        g[a][a] -= 1;
}

/* The path of row F2. */
static void path(double t, double f[3][3])
{
    static const double slope[3][3] = {{0.4, 0.3, 0}, {-0.1, -0.2, 0.1}, {0, 0.2, 0.3}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            f[i][j] = (i == j) + t * slope[i][j];
}

/* Rotation by an angle about (1, 2, 2)/3 (Rodrigues). */
static void rotation(double angle, double q[3][3])
{
    static const double n[3] = {1.0 / 3, 2.0 / 3, 2.0 / 3};
    const double cross[3][3] = {{0, -n[2], n[1]}, {n[2], 0, -n[0]}, {-n[1], n[0], 0}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            q[i][j] = (i == j) * cos(angle) + (1 - cos(angle)) * n[i] * n[j] + sin(angle) * cross[i][j];
}

/* Follows the path of F2 turned by up to `angle` in 200 steps; 0: not turned, `scale` 0: only turned. */
static void follow_path(struct point *point, double time_step, double scale, double angle)
{
    double before[3][3], after[3][3], plain[3][3], q[3][3], g[3][3];
    path(0, before);
    for (int k = 1; k <= 200; k++) {
        path(scale * k / 200, plain);
        rotation(angle * k / 200, q);
        multiply(q, plain, after);
        relative(before, after, g);
        advance(point, time_step, g);
        memcpy(before, after, sizeof after);
    }
}

/* Laws as the rows have them: mu 2000, a fifth of it without end; lambda 0.02; nu 0.4, kappa 28000/3. */
static const double MAXWELL[] = {1000, 1120, 0.4}, OLDROYD[] = {1000, 12.5, 0.4}, POWER[] = {1000, 12.5, 4, 0.7};

static void start_maxwell(struct point *point, unsigned words)
{
    start_point(point, &law_fmax, words, MAXWELL, 1, (const double[][2]){{4480, 0.02}});
}

static void start_oldroyd(struct point *point, unsigned words)
{
    start_point(point, &law_oldr, words, OLDROYD, 2, (const double[][2]){{3.6, 0.02}, {8, 0.05}});
}

/* --- the rows --- */

static void start_case(struct point *point, int i)
{
    if (i < 2)
        start_maxwell(point, i == 0 ? MAXWELL_MIDPOINT_WORD : MAXWELL_EXPONENTIAL_WORD);
    else if (i < 5)
        start_oldroyd(point, i == 2 ? 0 : i == 3 ? OLDROYD_LIE : OLDROYD_EXPONENTIAL);
    else
        start_point(point, &law_powl, 0, POWER, 0, NULL);
}

static const char *const cases[] = {"fmax, midpoint", "fmax, exponential", "oldr, strang", "oldr, lie", "oldr, exponential", "powl"};

/* F1 and F3: the stress of a point that also turns, by 2.5 in all, is that of the other one turned; the rate-dependent
 * part of oldr and powl, sym(1 - f^-1)/dt, is that of a step, where a rotation of it counts in second order. */
static void test_rotation(void)
{
    static const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
    static const int place[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
    char name[80];
    for (int i = 0; i < 5; i++) {
        struct point still, turned, rigid;
        double q[3][3], size = 0, deviation = 0;
        start_case(&still, i);
        start_case(&turned, i);
        start_case(&rigid, i);
        /* the solvent's stress is no part of what is carried along */
        still.material.parameter[2] = turned.material.parameter[2] = rigid.material.parameter[2] = i < 2 ? 0.4 : 0;
        follow_path(&still, 1e-3, 1, 0);
        follow_path(&turned, 1e-3, 1, 2.5);
        follow_path(&rigid, 1e-3, 0, 2.5);
        rotation(2.5, q);
        for (int a = 0; a < 6; a++) {
            double sum = 0;
            for (int k = 0; k < 9; k++)
                sum += q[row[a]][k / 3] * still.stress[place[k / 3][k % 3]] * q[column[a]][k % 3];
            deviation = fmax(deviation, fabs(sum - turned.stress[a]));
            size = fmax(size, fabs(sum));
        }
        printf("   %s: deviation %.1e of the stress\n", cases[i], deviation / size);
        snprintf(name, sizeof name, "F1: objectivity, %s", cases[i]);
        check_near(name, deviation / size, 0, 1e-11); /* spec 11.3, F1 */
        deviation = 0;
        for (int a = 0; a < 6; a++)
            deviation = fmax(deviation, fabs(rigid.stress[a]));
        snprintf(name, sizeof name, "F3: a rotation from rest gives no stress, %s", cases[i]);
        check_near(name, deviation / rigid.material.shear_modulus, 0, 1e-9); /* spec 11.3, F3 */
    }
}

/* F2, with its numbers in the order xx yy zz yz xz xy. */
static void test_path(void)
{
    static const double expected[6] = {3835.918956, 3413.096864, 3745.698563, 93.795673, 13.149260, 39.751208}; /* spec 11.3, F2 */
    struct point point;
    char name[40];
    start_maxwell(&point, MAXWELL_MIDPOINT_WORD);
    check_near("F2: kappa is 28000/3", point.material.bulk_modulus, 28000.0 / 3, 1e-8);
    check_near("F2: mu is 2000", point.material.shear_modulus, 2000, 1e-9);
    follow_path(&point, 1e-3, 1, 0);
    for (int a = 0; a < 6; a++) {
        snprintf(name, sizeof name, "F2: stress %d", a + 1);
        /* 1e-8 of the listed number, and half a unit of its last digit */
        check_near(name, point.stress[a], expected[a], 1e-8 * expected[a] + 5e-7);
    }
    double f[3][3];
    path(1, f);
    check_near("F2: the volume is det F", point.volume, tensor_determinant(f), 1e-13);
}

/* Simple shear at a rate of 50 to a total shear in steps: shear stress, and first normal stress difference. */
static void shear(struct point *point, double total, int steps, double *stress, double *difference)
{
    double g[3][3] = {{0}};
    g[0][1] = total / steps;
    for (int k = 0; k < steps; k++)
        advance(point, total / 50 / steps, g);
    *stress = point->stress[5];
    *difference = point->stress[0] - point->stress[1];
}

/* F4: mu 2000, nothing of it without end. F5: the upper-convected fluid of the same numbers. */
static void test_shear(void)
{
    static const double totals[] = {1, 5}, integral[2][2] = {{1302.217, 1070.685}, {9247.99, 12569.7}},
                        convected[2][2] = {{1264.241, 1056.964}, {1986.524, 3838.289}}; /* spec 11.3, F4 and F5 */
    static const double no_spring[] = {1000, 0, 0.4}, no_solvent[] = {1000, 12.5, 0};
    struct point point;
    double stress, difference;
    char name[80];
    for (int i = 0; i < 2; i++) {
        start_point(&point, &law_fmax, 0, no_spring, 1, (const double[][2]){{5600, 0.02}});
        shear(&point, totals[i], 2000, &stress, &difference);
        snprintf(name, sizeof name, "F4: shear of %g, shear stress", totals[i]);
        check_near(name, stress / integral[i][0], 1, 1e-5);
        snprintf(name, sizeof name, "F4: shear of %g, normal stress difference", totals[i]);
        check_near(name, difference / integral[i][1], 1, 1e-5);
        start_point(&point, &law_oldr, 0, no_solvent, 1, (const double[][2]){{40, 0.02}});
        shear(&point, totals[i], 120, &stress, &difference);
        printf("   shear of %g, 120 steps, strang: errors %.2e %.2e\n", totals[i], stress / convected[i][0] - 1, difference / convected[i][1] - 1);
        snprintf(name, sizeof name, "F5: shear of %g, shear stress", totals[i]);
        check_near(name, stress / convected[i][0], 1, 1e-4);
        snprintf(name, sizeof name, "F5: shear of %g, normal stress difference", totals[i]);
        check_near(name, difference / convected[i][1], 1, 1e-4);
    }
    /* spec 6.2: 30 steps to 3 lambda */
    start_point(&point, &law_oldr, OLDROYD_LIE, no_solvent, 1, (const double[][2]){{40, 0.02}});
    shear(&point, 3, 30, &stress, &difference);
    check_near("oldr: error of the rule lie in 30 steps, -4.9 %", stress / (2000 * -expm1(-3)) - 1, -0.049, 5e-4);
    start_point(&point, &law_oldr, OLDROYD_STRANG, no_solvent, 1, (const double[][2]){{40, 0.02}});
    shear(&point, 3, 30, &stress, &difference);
    check_near("oldr: error of the rule strang in 30 steps, -0.04 %", stress / (2000 * -expm1(-3)) - 1, -4e-4, 5e-5);
    start_point(&point, &law_oldr, OLDROYD_EXPONENTIAL, no_solvent, 1, (const double[][2]){{40, 0.02}});
    shear(&point, 3, 30, &stress, &difference);
    /* (1 - exp(-3))(1 + ...): the shear stress of linear shear is exact */
    check_near("oldr: the rule exponential is exact for the shear stress", stress / (2000 * -expm1(-3)), 1, 1e-13);
    printf("   oldr, exponential: error of the normal stress difference %.2e\n", difference / (4000 * (1 - 4 * exp(-3))) - 1);
    check_near("oldr: the rule exponential, normal stress difference", difference / (4000 * (1 - 4 * exp(-3))), 1, 3e-3);
}

/* F6: a step of no viscosity that makes the density 1.01 times as large. */
static void test_pressure(void)
{
    static const double fluid[] = {1000, 12.5, 0, 1};
    struct point point;
    double g[3][3] = {{0}};
    for (int a = 0; a < 3; a++)
        g[a][a] = cbrt(1 / 1.01) - 1;
    start_point(&point, &law_powl, 0, fluid, 0, NULL);
    advance(&point, 1, g);
    check_near("F6: pressure of the density", -point.stress[1] / 1610.16411, 1, 4e-9); /* half a unit of the last digit listed */
    check_near("F6: pressure of the density, formula", -point.stress[2] / (1000 * 12.5 * 12.5 / 7 * (pow(1.01, 7) - 1)), 1, 1e-10);
    check_near("F6: the volume follows", point.volume, 1 / 1.01, 1e-15);
}

/* --- beyond the rows --- */

/* Simple shear of viscosity: rate 50, K 4, n 0.7: 4 50^0.7; of the solvent of oldr alone 0.4 50. */
static void test_viscous(void)
{
    static const double newtonian[] = {1000, 12.5, 0.4, 1};
    struct point point;
    double stress, difference;
    start_point(&point, &law_powl, 0, POWER, 0, NULL);
    shear(&point, 1, 10, &stress, &difference);
    check_near("powl: shear stress K rate^n", stress / (4 * pow(50, 0.7)), 1, 1e-14);
    start_point(&point, &law_powl, 0, newtonian, 0, NULL);
    shear(&point, 1, 10, &stress, &difference);
    check_near("powl: Newtonian with n = 1", stress, 20, 1e-12);
    start_point(&point, &law_oldr, 0, OLDROYD, 1, (const double[][2]){{1e-30, 1}});
    shear(&point, 1, 10, &stress, &difference);
    check_near("oldr: shear stress of the solvent", stress, 20, 1e-12);
    start_point(&point, &law_powl, 0, POWER, 0, NULL);
    double g[3][3] = {{0, 1e-12, 0}};
    advance(&point, 1, g);
    check_near("powl: the least rate, 1e-6", point.stress[5] / (4 * pow(1e-6, -0.3) * 1e-12), 1, 1e-12);
    advance(&point, 0, g);
    check_true("powl: a step of no length gives no viscous stress", point.stress[5] == 0);
}

/* Steps of 1 to 1000 relaxation times. In slow shear the stress is viscosity times rate, and twice that times lambda times
 * rate the normal stress difference: the rule exponential keeps both, and so does fmax for a small strain; strang and lie
 * leave the share exp(-x/2) x/(1 - exp(-x)) and x/(exp(x) - 1) of the stress in steady shear. */
static void test_stiff(void)
{
    static const double no_solvent[] = {1000, 12.5, 0}, no_spring[] = {1000, 0, 0.4};
    char name[80];
    for (double x = 1; x <= 1000; x *= 10) {
        const double time = 1e-3, rate = 1e-2, dt = x * time;
        struct point point;
        double g[3][3] = {{0, rate * dt, 0}};
        start_point(&point, &law_oldr, OLDROYD_EXPONENTIAL, no_solvent, 1, (const double[][2]){{4, time}});
        for (int k = 0; k < 60; k++)
            advance(&point, dt, g);
        snprintf(name, sizeof name, "oldr: dt/lambda %g, exponential", x);
        check_near(name, point.stress[5] / (4 * rate), 1, 1e-12);
        start_point(&point, &law_oldr, OLDROYD_STRANG, no_solvent, 1, (const double[][2]){{4, time}});
        for (int k = 0; k < 60; k++)
            advance(&point, dt, g);
        snprintf(name, sizeof name, "oldr: dt/lambda %g, strang", x);
        check_near(name, point.stress[5] / (4 * rate), exp(-0.5 * x) * x / -expm1(-x), 1e-12);
        start_point(&point, &law_oldr, OLDROYD_LIE, no_solvent, 1, (const double[][2]){{4, time}});
        for (int k = 0; k < 60; k++)
            advance(&point, dt, g);
        snprintf(name, sizeof name, "oldr: dt/lambda %g, lie", x);
        check_near(name, point.stress[5] / (4 * rate), exp(-x) * x / -expm1(-x), 1e-12);
        start_point(&point, &law_fmax, 0, no_spring, 1, (const double[][2]){{5600, time}});
        g[0][1] = 1e-11 * x;
        for (int k = 0; k < 60; k++)
            advance(&point, dt, g);
        snprintf(name, sizeof name, "fmax: dt/lambda %g, small strain", x);
        check_near(name, point.stress[5] / (2000 * 1e-11), 1, 1e-9);
    }
}

/* The least eigenvalue of c, whose parts less 1 stand in an element's history, over the largest. */
static double least_conformation(const struct point *point, int element)
{
    const double *e = &point->history[1 + 6 * element];
    double c[SYMMETRIC_LARGEST][SYMMETRIC_LARGEST] = {{1 + e[0], e[5], e[4]}, {e[5], 1 + e[1], e[3]}, {e[4], e[3], 1 + e[2]}};
    double value[SYMMETRIC_LARGEST], vectors[SYMMETRIC_LARGEST][SYMMETRIC_LARGEST];
    symmetric_eigen(3, c, value, vectors);
    return fmin(fmin(value[0], value[1]), value[2]) / fmax(fmax(value[0], value[1]), value[2]);
}

/* Large steps of any gradient that turns nothing inside out, of any length against the relaxation times. */
static void test_positive(void)
{
    for (int rule = 0; rule < 3; rule++) {
        struct random state = {77};
        double least = 1;
        for (int run = 0; run < 200; run++) {
            struct point point;
            const double x = pow(10, random_between(&state, -3, 3));
            start_oldroyd(&point, 1u << rule);
            for (int k = 0; k < 50; k++) {
                double g[3][3], f[3][3];
                do {
                    for (int a = 0; a < 9; a++) {
                        g[a / 3][a % 3] = random_between(&state, -0.5, 0.5);
                        f[a / 3][a % 3] = g[a / 3][a % 3] + (a % 4 == 0);
                    }
                } while (!(tensor_determinant(f) > 0.2 && tensor_determinant(f) < 5));
                advance(&point, 0.02 * x, g);
                least = fmin(least, fmin(least_conformation(&point, 0), least_conformation(&point, 1)));
            }
        }
        printf("   rule %d: least eigenvalue of c over its largest %.2e\n", rule, least);
        check_true(rule == 0 ? "oldr, strang: c stays positive" : rule == 1 ? "oldr, lie: c stays positive" : "oldr, exponential: c stays positive",
                   least > 0);
    }
}

/* Where relaxation is fast fmax shears as a fluid whose viscosity grows with the strain, eta (1 + gamma^2/3) (spec 6.1). */
static void test_limit(void)
{
    static const double no_spring[] = {1000, 0, 0.4};
    struct point point;
    double stress, difference;
    start_point(&point, &law_fmax, 0, no_spring, 1, (const double[][2]){{5600, 2e-6}});
    shear(&point, 2, 2000, &stress, &difference);
    check_near("fmax: fast relaxation, 1 + gamma^2/3", stress / (2000 * 2e-6 * 50), 1 + 4.0 / 3, 2e-3); /* corrections are of the order of lambda times the rate and of a step of gamma */
}

/* For small strains fmax is maxw: the difference is of the order of the strain (spec 6.1). */
static void test_small(void)
{
    double last = 0;
    for (double scale = 1e-3; scale > 1e-7; scale /= 10) {
        struct point finite, small;
        double size = 0, deviation = 0, f[3][3], g[3][3], before[3][3];
        start_maxwell(&finite, 0);
        start_point(&small, &law_maxw, 0, MAXWELL, 1, (const double[][2]){{4480, 0.02}});
        path(0, before);
        for (int k = 1; k <= 200; k++) {
            path(scale * k / 200, f);
            relative(before, f, g);
            memcpy(before, f, sizeof f);
            advance(&finite, 1e-3, g);
            advance(&small, 1e-3, g);
        }
        for (int a = 0; a < 6; a++) {
            deviation = fmax(deviation, fabs(finite.stress[a] - small.stress[a]));
            size = fmax(size, fabs(small.stress[a]));
        }
        printf("   strains of %g: fmax differs from maxw by %.3g times that\n", scale, deviation / size / scale);
        check_true("fmax: goes to maxw in proportion to the strain", deviation / size < 10 * scale && (last == 0 || fabs(deviation / size / (0.1 * last) - 1) < 0.02));
        last = deviation / size;
    }
}

/* Points of a batch, from any place of the history on, are updated as each alone, and nothing else is touched. */
static void test_batch(void)
{
    enum { POINTS = 13, FROM = 3, COUNT = 7 };
    for (int i = 0; i < 6; i++) {
        struct point single[POINTS], start;
        double strain[6][POINTS], spin[3][POINTS], trace[POINTS], stress[6][POINTS], volume[2][POINTS], terms[2][POINTS], history[MOST_HISTORY][POINTS];
        double *columns[MOST_HISTORY];
        bool good = true;
        start_case(&start, i);
        const int n = law_history(&start.material);
        for (int j = 0; j < POINTS; j++) {
            start_case(&single[j], i);
            for (int a = 0; a < 6; a++)
                single[j].strain[a] = strain[a][j] = 1e-2 * sin(1 + a + 7 * j), single[j].stress[a] = stress[a][j] = 1;
            for (int a = 0; a < 3; a++)
                single[j].spin[a] = spin[a][j] = 1e-2 * cos(1 + a + 5 * j);
            single[j].trace = trace[j] = strain[0][j] + strain[1][j] + strain[2][j];
            single[j].volume_before = volume[0][j] = volume[1][j] = 1 + 0.1 * j;
            for (int k = 0; k < n; k++)
                single[j].history[k] = history[k][j] = 0.01 * cos(k + 5 * j), columns[k] = history[k];
        }
        struct law_batch batch = {.count = COUNT, .material = &start.material, .time_step = 1e-3, .trace = trace + FROM,
                                  .volume_before = volume[0] + FROM, .volume = volume[1] + FROM, .terms = {terms[0] + FROM, terms[1] + FROM},
                                  .history = columns, .history_from = FROM};
        for (int a = 0; a < 6; a++)
            batch.strain[a] = strain[a] + FROM, batch.stress[a] = stress[a] + FROM;
        for (int a = 0; a < 3; a++)
            batch.spin[a] = spin[a] + FROM;
        start.material.law->update(&batch);
        for (int j = 0; j < POINTS; j++) {
            if (j >= FROM && j < FROM + COUNT) {
                const struct law_batch alone = batch_of(&single[j], 1e-3);
                single[j].material.law->update(&alone);
                good = good && single[j].volume == volume[1][j];
            }
            for (int a = 0; a < 6; a++)
                good = good && single[j].stress[a] == stress[a][j];
            for (int k = 0; k < n; k++)
                good = good && single[j].history[k] == history[k][j];
        }
        char name[60];
        snprintf(name, sizeof name, "%s: a batch is its points", cases[i]);
        check_true(name, good);
    }
}

/* Twenty elements, each a twentieth of one, are that one. */
static void test_many(void)
{
    struct point one, many;
    double elements[MOST][2], deviation = 0;
    for (int i = 0; i < MOST; i++)
        elements[i][0] = 4480.0 / MOST, elements[i][1] = 0.02;
    start_maxwell(&one, 0);
    start_point(&many, &law_fmax, 0, MAXWELL, MOST, (const double(*)[2])elements);
    follow_path(&one, 1e-3, 1, 0);
    follow_path(&many, 1e-3, 1, 0);
    for (int a = 0; a < 6; a++)
        deviation = fmax(deviation, fabs(many.stress[a] / one.stress[a] - 1));
    check_near("fmax: an element in twenty parts", deviation, 0, 1e-12);
    start_point(&one, &law_oldr, 0, OLDROYD, 1, (const double[][2]){{4, 0.02}});
    for (int i = 0; i < MOST; i++)
        elements[i][0] = 4.0 / MOST;
    start_point(&many, &law_oldr, 0, OLDROYD, MOST, (const double(*)[2])elements);
    follow_path(&one, 1e-3, 1, 0);
    follow_path(&many, 1e-3, 1, 0);
    deviation = 0;
    for (int a = 0; a < 6; a++)
        deviation = fmax(deviation, fabs(many.stress[a] / one.stress[a] - 1));
    check_near("oldr: a polymer in twenty parts", deviation, 0, 1e-12);
}

/* Two rules at once are refused. */
static void test_words(void)
{
    struct law_element element = {.strength = 1, .time = 1};
    struct material maxwell = {.law = &law_fmax, .parameter = {1, 1, 0.3}, .elements = &element, .n_elements = 1, .words = 3};
    struct material oldroyd = {.law = &law_oldr, .parameter = {1, 1, 0.3}, .elements = &element, .n_elements = 1, .words = 6};
    check_true("fmax: one rule", law_fmax.prepare(&maxwell) != NULL);
    check_true("oldr: one rule", law_oldr.prepare(&oldroyd) != NULL);
}

int main(void)
{
    test_rotation();
    test_path();
    test_shear();
    test_pressure();
    test_viscous();
    test_stiff();
    test_positive();
    test_limit();
    test_small();
    test_batch();
    test_many();
    test_words();
    return check_result();
}
