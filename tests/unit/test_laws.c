/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The laws against closed forms. Expected numbers follow from Hooke's law, the von Mises yield
 * condition with linear hardening, and the formulas 6.3, 6.5, 6.6 of the spec; each test says how. */
#include "base/tensor.h"
#include "check.h"
#include "material/law.h"
#include "random.h"

#include <string.h>

enum { POINTS = 128 };

/* Points of one material, with room for all that a law may want. */
struct points {
    double strain[6][POINTS], spin[3][POINTS], trace[POINTS], volume_before[POINTS], volume[POINTS], mass[POINTS];
    double work[POINTS], stress[6][POINTS], energy[POINTS], viscous[POINTS], plastic[POINTS], yield[POINTS];
};

/* Step and cell of the artificial viscosity. */
struct setting {
    double time_step, cell_size, quadratic, linear;
};

static const struct setting usual = {1e-3, 0.5, 1.5, 0.06};

static struct material make_material(const struct law *law, const double parameters[5])
{
    struct material material = {.law = law};
    for (int i = 0; i < 5; i++)
        material.parameter[i] = parameters[i];
    if (law->prepare(&material))
        check_true("laws: a material is accepted", false);
    return material;
}

static struct law_batch make_batch(struct points *points, int from, int count, const struct material *material,
                                   const struct setting *setting)
{
    struct law_batch batch = {
        .count = count, .material = material, .time_step = setting->time_step, .cell_size = setting->cell_size,
        .bulk_quadratic = setting->quadratic, .bulk_linear = setting->linear,
        .trace = points->trace + from, .volume_before = points->volume_before + from,
        .volume = points->volume + from, .mass = points->mass + from, .work = points->work + from,
        .energy = points->energy + from, .viscous_pressure = points->viscous + from,
        .plastic_strain = points->plastic + from, .yield_stress = points->yield + from,
    };
    for (int a = 0; a < 6; a++) {
        batch.strain[a] = points->strain[a] + from;
        batch.stress[a] = points->stress[a] + from;
    }
    for (int a = 0; a < 3; a++)
        batch.spin[a] = points->spin[a] + from;
    return batch;
}

/* Volume, rotation, law and energy of one step, as spec 6.2 lists them. */
static void advance(struct points *points, int from, int count, const struct material *material,
                    const struct setting *setting, void (*rotate)(const struct law_batch *batch))
{
    struct law_batch batch = make_batch(points, from, count, material, setting);
    for (int j = from; j < from + count; j++) {
        points->trace[j] = points->strain[0][j] + points->strain[1][j] + points->strain[2][j];
        points->volume_before[j] = points->volume[j];
        points->volume[j] *= 1 + points->trace[j];
    }
    if (rotate)
        rotate(&batch);
    law_energy_before(&batch);
    material->law->update(&batch);
    law_energy_after(&batch);
}

/* One point without stress, of unit volume. */
static void start_point(struct points *points, const struct material *material)
{
    memset(points, 0, sizeof *points);
    points->volume[0] = 1;
    points->mass[0] = material->density;
    points->yield[0] = material->yield_stress;
}

static void set_strain(struct points *points, double xx, double yy, double zz, double yz, double xz, double xy)
{
    const double strain[6] = {xx, yy, zz, yz, xz, xy};
    for (int a = 0; a < 6; a++)
        points->strain[a][0] = strain[a];
}

/* The same increment `steps` times. */
static void strain_point(struct points *points, const struct material *material, int steps)
{
    for (int i = 0; i < steps; i++)
        advance(points, 0, 1, material, &usual, NULL);
}

static double von_mises(const struct points *points, int j)
{
    return tensor_von_mises(points->stress[0][j], points->stress[1][j], points->stress[2][j], points->stress[3][j],
                            points->stress[4][j], points->stress[5][j]);
}

/* Checks the six components of point 0, relative to `scale`. */
static void check_stress(const char *name, const struct points *points, const double expected[6], double scale,
                         double tolerance)
{
    double deviation = 0;
    for (int a = 0; a < 6; a++)
        deviation = fmax(deviation, fabs(points->stress[a][0] - expected[a]) / scale);
    check_near(name, deviation, 0, tolerance);
}

/* --- elasticity --- */

static const double elastic[5] = {2, 210, 0.3};
static const double SHEAR = 210 / 2.6, BULK = 210 / 1.2;

/* Uniaxial strain e: xx = (K + 4G/3) e, yy = zz = (K - 2G/3) e. Simple shear g without rotation:
 * xy = G g, and as Jaumann's rate has it (Dienes 1979): xy = G sin g, xx = -yy = G (1 - cos g). */
static void test_elastic(void)
{
    struct material material = make_material(&law_elas, elastic);
    struct points points;
    check_near("elas: wave speed", material.wave_speed, sqrt((BULK + 4 * SHEAR / 3) / 2), 1e-13);
    start_point(&points, &material);
    set_strain(&points, 1e-4, 0, 0, 0, 0, 0);
    strain_point(&points, &material, 100);
    double axial = (BULK + 4 * SHEAR / 3) * 0.01, lateral = (BULK - 2 * SHEAR / 3) * 0.01;
    check_stress("elas: uniaxial strain", &points, (const double[]){axial, lateral, lateral, 0, 0, 0}, axial, 1e-14);
    check_near("elas: volume", points.volume[0], pow(1.0001, 100), 1e-14);
    start_point(&points, &material);
    set_strain(&points, 0, 0, 0, 0, 0, 1e-4);
    strain_point(&points, &material, 100);
    check_stress("elas: simple shear", &points, (const double[]){0, 0, 0, 0, 0, SHEAR * 0.01}, SHEAR * 0.01, 1e-14);
    check_near("elas: shear energy", points.energy[0], 0.5 * SHEAR * 1e-4, 1e-15);
}

/* Largest deviation from Dienes' solution at shear 1 in so many steps. */
static double jaumann_error(void (*rotate)(const struct law_batch *batch), int steps)
{
    struct material material = make_material(&law_elas, elastic);
    struct points points;
    start_point(&points, &material);
    set_strain(&points, 0, 0, 0, 0, 0, 1.0 / steps);
    points.spin[2][0] = -0.5 / steps; /* v_x = y: w3 = (dv_y/dx - dv_x/dy) / 2 */
    for (int i = 0; i < steps; i++)
        advance(&points, 0, 1, &material, &usual, rotate);
    const double expected[6] = {SHEAR * (1 - cos(1)), -SHEAR * (1 - cos(1)), 0, 0, 0, SHEAR * sin(1)};
    double error = 0;
    for (int a = 0; a < 6; a++)
        error = fmax(error, fabs(points.stress[a][0] - expected[a]) / SHEAR);
    return error;
}

/* Rotation and increment one after the other are of first order: twice the steps, half the error. */
static void test_large_shear(void)
{
    double exact = jaumann_error(law_rotate_exact, 500) / jaumann_error(law_rotate_exact, 1000);
    double stepped = jaumann_error(law_rotate_explicit, 500) / jaumann_error(law_rotate_explicit, 1000);
    check_near("elas: large shear, exact rotation: order", exact, 2, 0.01);
    check_near("elas: large shear, explicit rotation: order", stepped, 2, 0.01);
    check_near("elas: large shear, exact rotation: error", jaumann_error(law_rotate_exact, 1000), 0, 1e-3);
}

/* --- plasticity --- */

static const double perfect[5] = {2, 210, 0.3, 0.9}, hardening[5] = {2, 210, 0.3, 0.9, 42};
/* H = E Et / (E - Et) */
static const double YIELD = 0.9, SLOPE = 210.0 * 42 / (210 - 42);

/* Uniaxial strain e: q = 2 G e at first; beyond yield q = Y + H p with 2 G e - 3 G p = q.
 * Axial stress K e + 2 q / 3, lateral K e - q / 3. */
static void test_uniaxial_strain(const struct law *law, const double parameters[5], double h, int steps)
{
    struct material material = make_material(law, parameters);
    struct points points;
    char name[80];
    double e = 0.02, p = (2 * SHEAR * e - YIELD) / (3 * SHEAR + h), q = YIELD + h * p;
    start_point(&points, &material);
    set_strain(&points, e / steps, 0, 0, 0, 0, 0);
    strain_point(&points, &material, steps);
    double axial = BULK * e + 2 * q / 3, lateral = BULK * e - q / 3;
    snprintf(name, sizeof name, "%s: uniaxial strain in %d steps", law->name, steps);
    check_stress(name, &points, (const double[]){axial, lateral, lateral, 0, 0, 0}, axial, 1e-14);
    snprintf(name, sizeof name, "%s: on the yield surface after %d steps", law->name, steps);
    check_near(name, von_mises(&points, 0) / q, 1, 1e-14);
    snprintf(name, sizeof name, "%s: plastic strain after %d steps", law->name, steps);
    check_near(name, points.plastic[0] / p, 1, 1e-13);
}

/* Pure shear g: q = sqrt(3) G g at first; beyond yield sqrt(3) G g - 3 G p = Y + H p. */
static void test_pure_shear(const struct law *law, const double parameters[5], double h)
{
    struct material material = make_material(law, parameters);
    char name[80];
    double g = 0.02, p = (sqrt(3) * SHEAR * g - YIELD) / (3 * SHEAR + h), q = YIELD + h * p;
    for (int axis = 0; axis < 3; axis++) {
        struct points points;
        double expected[6] = {0};
        start_point(&points, &material);
        points.strain[3 + axis][0] = -g / 10;
        expected[3 + axis] = -q / sqrt(3);
        strain_point(&points, &material, 10);
        snprintf(name, sizeof name, "%s: pure shear %s", law->name, (const char *[]){"yz", "xz", "xy"}[axis]);
        check_stress(name, &points, expected, q, 1e-14);
        snprintf(name, sizeof name, "%s: pure shear %s: plastic strain", law->name,
                 (const char *[]){"yz", "xz", "xy"}[axis]);
        check_near(name, points.plastic[0] / p, 1, 1e-13);
    }
}

/* Below yield nothing plastic happens; unloading is elastic. */
static void test_unloading(const struct law *law, const double parameters[5], double h)
{
    struct material material = make_material(law, parameters);
    struct points points;
    char name[80];
    double below = 0.999 * YIELD / (sqrt(3) * SHEAR), beyond = 3 * below, back = 0.5 * below;
    start_point(&points, &material);
    set_strain(&points, 0, 0, 0, 0, 0, below);
    strain_point(&points, &material, 1);
    snprintf(name, sizeof name, "%s: no plastic strain below yield", law->name);
    check_true(name, points.plastic[0] == 0 && points.yield[0] == YIELD);
    set_strain(&points, 0, 0, 0, 0, 0, beyond - below);
    strain_point(&points, &material, 1);
    set_strain(&points, 0, 0, 0, 0, 0, -back);
    strain_point(&points, &material, 1);
    double p = (sqrt(3) * SHEAR * beyond - YIELD) / (3 * SHEAR + h), q = YIELD + h * p;
    snprintf(name, sizeof name, "%s: elastic unloading", law->name);
    check_near(name, points.stress[5][0], q / sqrt(3) - SHEAR * back, 1e-14);
}

/* Uniaxial stress: beyond yield axial strain rises by ds/Et = ds/E + ds/H, lateral strain falls by
 * nu ds/E + ds/(2H); the axial stress has to follow with slope Et and the lateral one to stay 0. */
static void test_tangent(void)
{
    struct material material = make_material(&law_pla2, hardening);
    struct points points;
    double step = 0.05, lateral = -0.3 * YIELD / 210;
    start_point(&points, &material);
    set_strain(&points, YIELD / 210, lateral, lateral, 0, 0, 0);
    strain_point(&points, &material, 1);
    const double at_yield[6] = {YIELD};
    check_stress("pla2: uniaxial stress up to yield", &points, at_yield, YIELD, 1e-14);
    lateral = -0.3 * step / 210 - 0.5 * step / SLOPE;
    set_strain(&points, step / 42, lateral, lateral, 0, 0, 0);
    strain_point(&points, &material, 20);
    check_near("pla2: slope is the tangent modulus", (points.stress[0][0] - YIELD) / (20 * step / 42) / 42, 1, 1e-13);
    check_near("pla2: lateral stress", points.stress[1][0], 0, 1e-13);
    check_near("pla2: plastic strain of uniaxial stress", points.plastic[0] / (20 * step / SLOPE), 1, 1e-13);
    check_near("pla2: yield stress of uniaxial stress", points.yield[0], YIELD + 20 * step, 1e-13);
}

/* --- batches --- */

static void fill_randomly(struct points *points, const struct material *material, uint64_t seed)
{
    struct random random = {seed};
    for (int j = 0; j < POINTS; j++) {
        for (int a = 0; a < 6; a++) {
            points->strain[a][j] = random_between(&random, -0.002, 0.002);
            points->stress[a][j] = random_between(&random, -1, 1);
        }
        for (int a = 0; a < 3; a++)
            points->spin[a][j] = random_between(&random, -0.3, 0.3);
        points->volume[j] = random_between(&random, 0.5, 1.5);
        points->mass[j] = material->density * random_between(&random, 0.5, 1.5);
        points->energy[j] = random_between(&random, 0, 1);
        points->viscous[j] = random_between(&random, 0, 1);
        points->plastic[j] = random_between(&random, 0, 0.1);
        points->yield[j] = material->yield_stress + random_between(&random, 0, 1);
    }
}

typedef void rotation(const struct law_batch *batch);

static rotation *const rotations[] = {NULL, law_rotate_explicit, law_rotate_exact};
static const char *const rotation_names[] = {"off", "explicit", "exact"};

/* Point by point, in one batch of any length, from any offset: the same bits, and nothing outside
 * the batch is touched. */
static void test_batches(const struct law *law, const double parameters[5], int r)
{
    struct material material = make_material(law, parameters);
    struct points start, single, batch;
    char name[80];
    bool good = true;
    memset(&start, 0, sizeof start);
    fill_randomly(&start, &material, 11);
    single = start;
    for (int j = 0; j < POINTS; j++)
        advance(&single, j, 1, &material, &usual, rotations[r]);
    for (int count = 1; count <= 70; count++)
        for (int from = 0; from < 8; from++) {
            struct points expected = start;
            batch = start;
            advance(&batch, from, count, &material, &usual, rotations[r]);
            double *to = (double *)(void *)&expected, *of = (double *)(void *)&single;
            for (size_t column = 0; column < sizeof expected / sizeof(double) / POINTS; column++)
                memcpy(to + column * POINTS + from, of + column * POINTS + from, (size_t)count * sizeof(double));
            good = good && memcmp(&batch, &expected, sizeof batch) == 0;
        }
    snprintf(name, sizeof name, "%s: batches, rotation %s", law->name, rotation_names[r]);
    check_true(name, good);
}

/* Order of the axes and sign of the permutation, which axial vectors change with. */
static const struct {
    int axis[3];
    double sign;
} permutations[] = {{{1, 2, 0}, 1}, {{2, 0, 1}, 1}, {{1, 0, 2}, -1}, {{0, 2, 1}, -1}, {{2, 1, 0}, -1}};

/* Component a of a permuted tensor is component map[a] of the original. */
static void permuted_components(const int axis[3], int map[6])
{
    static const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
    static const int component[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
    for (int a = 0; a < 6; a++)
        map[a] = component[axis[row[a]]][axis[column[a]]];
}

static double permutation_deviation(const struct points *start, const struct material *material, int r, int which)
{
    int map[6];
    struct points original = *start, permuted = *start;
    permuted_components(permutations[which].axis, map);
    for (int a = 0; a < 6; a++) {
        memcpy(permuted.strain[a], start->strain[map[a]], sizeof permuted.strain[a]);
        memcpy(permuted.stress[a], start->stress[map[a]], sizeof permuted.stress[a]);
    }
    for (int a = 0; a < 3; a++)
        for (int j = 0; j < POINTS; j++)
            permuted.spin[a][j] = permutations[which].sign * start->spin[permutations[which].axis[a]][j];
    advance(&original, 0, POINTS, material, &usual, rotations[r]);
    advance(&permuted, 0, POINTS, material, &usual, rotations[r]);
    double deviation = 0;
    for (int j = 0; j < POINTS; j++) {
        for (int a = 0; a < 6; a++)
            deviation = fmax(deviation, fabs(permuted.stress[a][j] - original.stress[map[a]][j]));
        deviation = fmax(deviation, fabs(permuted.energy[j] - original.energy[j]));
        deviation = fmax(deviation, fabs(permuted.plastic[j] - original.plastic[j]));
        deviation = fmax(deviation, fabs(permuted.yield[j] - original.yield[j]));
    }
    return deviation;
}

/* No axis is special. Stresses are of order 1. */
static void test_permutations(const struct law *law, const double parameters[5], int r)
{
    struct material material = make_material(law, parameters);
    struct points start;
    char name[80];
    double deviation = 0;
    memset(&start, 0, sizeof start);
    fill_randomly(&start, &material, 12);
    for (int which = 0; which < 5; which++)
        deviation = fmax(deviation, permutation_deviation(&start, &material, r, which));
    snprintf(name, sizeof name, "%s: permuted axes, rotation %s", law->name, rotation_names[r]);
    check_near(name, deviation, 0, 2e-14);
}

/* --- artificial viscosity and energy --- */

/* 6.5, 6.6 for one point whose stresses before (rotated) and after are known. */
static void viscous_and_energy(const struct points *before, const struct points *after, int j,
                               const struct material *material, const struct setting *setting, double *viscous,
                               double *energy)
{
    double trace = before->strain[0][j] + before->strain[1][j] + before->strain[2][j], work = 0;
    double rate = fmin(trace / setting->time_step, 0), density = before->mass[j] / after->volume[j];
    double size = setting->cell_size, speed = material->law == &law_elas ? material->wave_speed : 0;
    double mean = (after->stress[0][j] + after->stress[1][j] + after->stress[2][j]) / 3;
    *viscous = mean < 0 ? density * size * size * setting->quadratic * rate * rate
                          - setting->linear * density * size * speed * rate
                        : 0;
    for (int a = 0; a < 6; a++)
        work += (before->stress[a][j] + after->stress[a][j]) * before->strain[a][j];
    work -= 2 * *viscous * trace;
    *energy = before->energy[j] + 0.25 * (before->volume[j] + after->volume[j]) * work;
}

static void test_viscosity(const struct law *law, const double parameters[5])
{
    struct material material = make_material(law, parameters);
    const struct setting setting = {0.003, 0.7, 1.5, 0.3};
    struct points before, after;
    char name[80];
    double deviation = 0, largest = 0;
    int kinds[4] = {0};
    memset(&before, 0, sizeof before);
    fill_randomly(&before, &material, 13);
    after = before;
    advance(&after, 0, POINTS, &material, &setting, NULL);
    for (int j = 0; j < POINTS; j++) {
        double viscous, energy;
        viscous_and_energy(&before, &after, j, &material, &setting, &viscous, &energy);
        deviation = fmax(deviation, fabs(after.viscous[j] - viscous));
        deviation = fmax(deviation, fabs(after.energy[j] - energy));
        largest = fmax(largest, viscous);
        double mean = after.stress[0][j] + after.stress[1][j] + after.stress[2][j];
        kinds[(after.trace[j] < 0) + 2 * (mean < 0)]++;
    }
    snprintf(name, sizeof name, "%s: viscosity and energy of random points", law->name);
    check_near(name, deviation / largest, 0, 1e-14);
    snprintf(name, sizeof name, "%s: viscosity: all four cases occur", law->name);
    check_true(name, kinds[0] > 5 && kinds[1] > 5 && kinds[2] > 5 && kinds[3] > 5);
}

/* By hand, with G = 3/4, K = 3 (E = 27/13, nu = 5/13), density 1: M = K + 4G/3 = 4, c = 2. Cell 2,
 * step 1/2, b1 = 3/2, b2 = 0.06; mass and volume 1.
 * First xx = -1/4: stress -1, -5/8, -5/8; volume 3/4, density 4/3, rate -1/2;
 *   q = 4/3 (4 * 3/2 * 1/4 + 0.06 * 2 * 2 / 2) = 2.16; w = 1/4 + 2 * 2.16 / 4 = 1.33;
 *   energy = 1.33 (1 + 3/4) / 4 = 0.581875.
 * Then xx = 1/2, xy = 1/4: stress 1, 5/8, 5/8, xy 3/16; volume 9/8; tension: q = 0;
 *   w = -1/2 + 1/2 + 3/64; energy += 3/64 (3/4 + 9/8) / 4. */
static void test_two_steps(void)
{
    struct material material = make_material(&law_elas, (const double[5]){1, 27.0 / 13, 5.0 / 13});
    const struct setting setting = {0.5, 2, 1.5, 0.06};
    struct points points;
    start_point(&points, &material);
    set_strain(&points, -0.25, 0, 0, 0, 0, 0);
    advance(&points, 0, 1, &material, &setting, law_rotate_explicit);
    check_near("energy: viscous pressure of the first step", points.viscous[0], 2.16, 1e-14);
    check_near("energy: first step", points.energy[0], 0.581875, 1e-14);
    set_strain(&points, 0.5, 0, 0, 0, 0, 0.25);
    advance(&points, 0, 1, &material, &setting, law_rotate_explicit);
    check_near("energy: no viscous pressure in tension", points.viscous[0], 0, 0);
    check_near("energy: second step", points.energy[0], 0.581875 + 3.0 / 64 * 1.875 / 4, 1e-14);
    check_stress("energy: final stress", &points, (const double[]){1, 0.625, 0.625, 0, 0, 0.1875}, 1, 1e-14);
}

/* --- rotation --- */

enum { TURNS = 10000 };

static const double start_stress[6] = {3, -1, 0.5, 0.7, -0.4, 1.2};

/* Turns the start stress TURNS times by the axial vector w. */
static void turn(struct points *points, rotation *rotate, const double w[3])
{
    struct material material = make_material(&law_elas, elastic);
    start_point(points, &material);
    for (int a = 0; a < 6; a++)
        points->stress[a][0] = start_stress[a];
    for (int a = 0; a < 3; a++)
        points->spin[a][0] = w[a];
    struct law_batch batch = make_batch(points, 0, 1, &material, &usual);
    for (int i = 0; i < TURNS; i++)
        rotate(&batch);
}

/* The start stress turned by an angle about a unit axis n: R = 1 + sin N + (1 - cos) N N. */
static void turned_stress(const double n[3], double angle, double expected[6])
{
    static const int component[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
    const double cross[3][3] = {{0, -n[2], n[1]}, {n[2], 0, -n[0]}, {-n[1], n[0], 0}};
    double r[3][3], s = sin(angle), c = 1 - cos(angle);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            r[i][j] = (i == j) + s * cross[i][j] + c * (n[i] * n[j] - (i == j));
    for (int i = 0; i < 3; i++)
        for (int j = i; j < 3; j++) {
            double sum = 0;
            for (int k = 0; k < 3; k++)
                for (int l = 0; l < 3; l++)
                    sum += r[i][k] * start_stress[component[k][l]] * r[j][l];
            expected[component[i][j]] = sum;
        }
}

/* A full turn in TURNS steps about an oblique axis. Hughes and Winget turn by 2 atan(w / 2) instead
 * of w a step, so that the end is TURNS w^3 / 12 = 2e-7 short of the full turn. */
static void test_exact_turn(void)
{
    const double n[3] = {2.0 / 7, -3.0 / 7, 6.0 / 7}, w = 2 * acos(-1) / TURNS;
    struct points points;
    double expected[6], size = tensor_von_mises(3, -1, 0.5, 0.7, -0.4, 1.2);
    turn(&points, law_rotate_exact, (const double[]){n[0] * w, n[1] * w, n[2] * w});
    double angle = TURNS * 2 * atan(w / 2);
    printf("   a turn ends %.4g rad short; predicted %.4g\n", 2 * acos(-1) - angle, TURNS * w * w * w / 12);
    check_near("exact rotation: von Mises after a turn", von_mises(&points, 0) / size, 1, 1e-10);
    double trace = points.stress[0][0] + points.stress[1][0] + points.stress[2][0];
    check_near("exact rotation: mean after a turn", trace, 2.5, 1e-10);
    turned_stress(n, angle, expected);
    check_stress("exact rotation: ends at the predicted angle", &points, expected, size, 1e-10);
    check_stress("exact rotation: comes back after a turn", &points, start_stress, size, 5e-7);
}

/* About z the explicit formula 6.3 turns the deviator in the plane, (s1 - s2) / 2 and s6, by w and
 * stretches it by sqrt(1 + 4 w^2) a step; the pair s4, s5 by sqrt(1 + w^2); s3 and s1 + s2 stay. */
static void test_explicit_turn(void)
{
    double w = 2 * acos(-1) / TURNS;
    struct points points;
    turn(&points, law_rotate_explicit, (const double[]){0, 0, w});
    double plane = hypot((points.stress[0][0] - points.stress[1][0]) / 2, points.stress[5][0]) / hypot(2, 1.2);
    double across = hypot(points.stress[3][0], points.stress[4][0]) / hypot(0.7, -0.4);
    double predicted_plane = pow(1 + 4 * w * w, TURNS / 2), predicted_across = pow(1 + w * w, TURNS / 2);
    printf("   a turn stretches the deviator in the plane by %.9f (predicted %.9f), across by %.9f (%.9f)\n", plane,
           predicted_plane, across, predicted_across);
    check_near("explicit rotation: drift in the plane", plane, predicted_plane, 1e-10);
    check_near("explicit rotation: drift across the plane", across, predicted_across, 1e-10);
    check_near("explicit rotation: mean in the plane", points.stress[0][0] + points.stress[1][0], 2, 1e-10);
    check_near("explicit rotation: normal to the plane", points.stress[2][0], 0.5, 0);
}

/* Both rotations agree to first order in the spin, about every axis. */
static void test_rotations_agree(void)
{
    double deviation = 0, w = 1e-6;
    for (int axis = 0; axis < 3; axis++) {
        struct points a, b;
        double n[3] = {0}, expected[6];
        n[axis] = 1;
        struct material material = make_material(&law_elas, elastic);
        start_point(&a, &material);
        for (int c = 0; c < 6; c++)
            a.stress[c][0] = start_stress[c];
        a.spin[axis][0] = w;
        b = a;
        struct law_batch exact = make_batch(&a, 0, 1, &material, &usual);
        struct law_batch stepped = make_batch(&b, 0, 1, &material, &usual);
        law_rotate_exact(&exact);
        law_rotate_explicit(&stepped);
        turned_stress(n, w, expected);
        for (int c = 0; c < 6; c++)
            deviation = fmax(deviation, fmax(fabs(a.stress[c][0] - expected[c]), fabs(b.stress[c][0] - expected[c])));
    }
    check_near("rotations: a small turn about each axis", deviation, 0, 10 * w * w);
}

int main(void)
{
    static const struct {
        const struct law *law;
        const double *parameters;
        double slope;
    } laws[] = {{&law_pla1, perfect, 0}, {&law_pla2, hardening, 210.0 * 42 / (210 - 42)}, {&law_elas, elastic, 0}};
    test_elastic();
    test_large_shear();
    for (int i = 0; i < 2; i++) {
        for (int steps = 1; steps <= 100; steps *= 10)
            test_uniaxial_strain(laws[i].law, laws[i].parameters, laws[i].slope, steps);
        test_pure_shear(laws[i].law, laws[i].parameters, laws[i].slope);
        test_unloading(laws[i].law, laws[i].parameters, laws[i].slope);
    }
    test_tangent();
    for (int i = 0; i < 3; i++) {
        for (int r = 0; r < 3; r++) {
            test_batches(laws[i].law, laws[i].parameters, r);
            test_permutations(laws[i].law, laws[i].parameters, r);
        }
        test_viscosity(laws[i].law, laws[i].parameters);
    }
    test_two_steps();
    test_exact_turn();
    test_explicit_turn();
    test_rotations_agree();
    return check_result();
}
