/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solids against whole-number rules: a point stands at (a, b, c) half spacings with odd a, b, c, so
 * that it can be said exactly whether it is inside, outside or on a surface. Spacings here are
 * decimal fractions, which have round-off. */
#include "check.h"
#include "particles/solid.h"
#include "scene_text.h"

/* --- the partitioned cylinder of the thesis --- */

struct cylinder_rule {
    int n;       /* points across; 80 fine, 40 coarse */
    char groove; /* a, b, or a blank */
};

/* a and b are twice the distances from the axis in spacings; k counts layers from 0. */
static bool in_cylinder(const struct cylinder_rule *rule, long a, long b, long k)
{
    long n = rule->n, square = a * a + b * b;
    bool in_opening = 25 * square < 9 * n * n && 5 * labs(a) > n;
    bool in_a = 5 * a > n && 10 * labs(b) < 3 * n && 4 * k >= n;
    bool in_b = 5 * a > n && b > 0 && 10 * b < 3 * n;
    return square < n * n && !in_opening && !(rule->groove == 'a' && in_a) && !(rule->groove == 'b' && in_b);
}

/* The points of a part, as they come. */
struct cloud {
    double (*position)[3];
    long count;
};

static void add_to_cloud(void *context, const double position[3], double mass)
{
    struct cloud *cloud = context;
    (void)mass;
    memcpy(cloud->position[cloud->count++], position, 3 * sizeof(double));
}

/* Reads a deck with this part; exits when it is wrong. */
static struct cloud read_cloud(const char *part)
{
    struct deck_builder deck = {0};
    struct test_run run;
    deck_add(&deck, "nbbo 1\nnbmp 500000\nnmat 1\ndcell 0.38\ngrid -8 8 -8 8 -8 8\nmate\n1 elas 2 1 0.3\n%s\nendi\n", part);
    test_run_open(&run, &deck);
    struct cloud cloud = {.position = malloc((size_t)run.scene->n_particles * sizeof *cloud.position)};
    if (!cloud.position)
        exit(4);
    const struct generator *generator = &run.scene->bodies[0].generator;
    generator->row->visit(generator, add_to_cloud, &cloud);
    check_true("count and visit agree", cloud.count == run.scene->n_particles && cloud.count == generator_count(generator));
    test_run_close(&run);
    return cloud;
}

static void test_cylinder_deck(const char *file, struct cylinder_rule rule, long expected, const long layer[2], long line)
{
    char part[120], name[160];
    double spacing = 7.6 / rule.n, deviation = 0;
    long at = 0, rows[4] = {0}, in_layer[80] = {0};
    snprintf(part, sizeof part, "incl decks/thesis/%s", file);
    struct cloud cloud = read_cloud(part);
    for (long k = 0; k < rule.n / 2; k++)
        for (long b = 1 - rule.n; b < rule.n; b += 2)
            for (long a = 1 - rule.n; a < rule.n; a += 2) {
                if (!in_cylinder(&rule, a, b, k))
                    continue;
                const double place[3] = {0.5 * (double)a * spacing, 0.5 * (double)b * spacing, ((double)k + 0.5) * spacing};
                for (int i = 0; i < 3 && at < cloud.count; i++)
                    deviation = fmax(deviation, fabs(cloud.position[at][i] - place[i]));
                at++;
                in_layer[k]++;
                rows[0] += a == 1 - rule.n;
                rows[1] += a == rule.n - 1;
                rows[2] += b == 1 - rule.n;
                rows[3] += b == rule.n - 1;
            }
    snprintf(name, sizeof name, "%s: %ld points", file, expected);
    check_true(name, cloud.count == expected && at == expected);
    snprintf(name, sizeof name, "%s: each point in its place, x fastest, then y, z", file);
    check_near(name, deviation, 0, 1e-14);
    snprintf(name, sizeof name, "%s: layers of %ld below, %ld above, outermost lines of %ld", file, layer[0], layer[1], line);
    bool is_good = true;
    for (int k = 0; k < rule.n / 2; k++)
        is_good = is_good && in_layer[k] == layer[4 * k >= rule.n];
    for (int side = 0; side < 4; side++)
        is_good = is_good && (rows[side] == line * rule.n / 2 || (side == 1 && rule.groove != ' '));
    check_true(name, is_good);
    free(cloud.position);
}

static void test_cylinders(void)
{
    test_cylinder_deck("partitioned_cylinder.inc", (struct cylinder_rule){80, ' '}, 159040, (long[]){3976, 3976}, 12);
    test_cylinder_deck("partitioned_cylinder_coarse.inc", (struct cylinder_rule){40, ' '}, 20080, (long[]){1004, 1004}, 8);
    test_cylinder_deck("partitioned_cylinder_groove_a.inc", (struct cylinder_rule){80, 'a'}, 151160, (long[]){3976, 3582}, 12);
    test_cylinder_deck("partitioned_cylinder_groove_b.inc", (struct cylinder_rule){80, 'b'}, 151160, (long[]){3779, 3779}, 12);
    test_cylinder_deck("partitioned_cylinder_groove_a_coarse.inc", (struct cylinder_rule){40, 'a'}, 19100, (long[]){1004, 906}, 8);
    test_cylinder_deck("partitioned_cylinder_groove_b_coarse.inc", (struct cylinder_rule){40, 'b'}, 19100, (long[]){955, 955}, 8);
}

/* --- shapes with points on their surface --- */

enum { EDGE = 20, LATTICE = 2 * EDGE };

/* Which of the points -EDGE ... EDGE - 1 are in a body; others are counted in `beyond`. */
struct lattice_points {
    char in[LATTICE][LATTICE][LATTICE];
    long beyond;
};

static void mark_line(void *context, const struct solid_line *line)
{
    struct lattice_points *points = context;
    for (long n = 0; n < line->count; n++) {
        long i = line->i + n + EDGE, j = line->j + EDGE, k = line->k + EDGE;
        if (!line->inside[n])
            continue;
        if (i < 0 || i >= LATTICE || j < 0 || j >= LATTICE || k < 0 || k >= LATTICE)
            points->beyond++;
        else
            points->in[i][j][k] = 1;
    }
}

/* A step in whole half spacings; shape and rule are the same thing said twice. */
struct half_step {
    enum solid_operation operation;
    const char *shape;
    int number[6];
};

/* Whether a point is strictly inside, in half spacings. */
static bool is_strictly_in(const struct half_step *step, const int p[3])
{
    const int *n = step->number;
    if (*step->shape == 'b')
        return n[0] < p[0] && p[0] < n[1] && n[2] < p[1] && p[1] < n[3] && n[4] < p[2] && p[2] < n[5];
    if (*step->shape == 'a') {
        const double wave = n[3] * sin(acos(-1) * (p[0] - n[0]) / (n[1] - n[0])), above = p[1] - n[2];
        const bool is_under = n[3] > 0 ? 0 < above && above < wave - 1e-7 : 0 > above && above > wave + 1e-7;
        return n[0] < p[0] && p[0] < n[1] && is_under && n[4] < p[2] && p[2] < n[5];
    }
    if (*step->shape == 's')
        return (p[0] - n[0]) * (p[0] - n[0]) + (p[1] - n[1]) * (p[1] - n[1]) + (p[2] - n[2]) * (p[2] - n[2]) < n[3] * n[3];
    int axis = n[0], u = p[axis == 0 ? 1 : 0] - n[1], v = p[axis == 2 ? 1 : 2] - n[2];
    return u * u + v * v < n[3] * n[3] && n[4] < p[axis] && p[axis] < n[5];
}

/* The steps as a solid on a lattice of decimal spacing and origin. */
static struct solid *make_solid(const struct half_step *steps, int count, const double origin[3], double spacing)
{
    struct solid *solid = solid_open(origin, spacing);
    for (int s = 0; s < count; s++) {
        struct solid_step step = {.operation = steps[s].operation, .shape = solid_shape_find(steps[s].shape)};
        static const int axes_of_box[] = {0, 0, 1, 1, 2, 2}, axes_of_sphere[] = {0, 1, 2, -1, -1, -1},
                         axes_of_arch[] = {0, 0, 1, -1, 2, 2};
        for (int i = 0; i < SOLID_NUMBERS; i++) {
            int cylinder_axis = steps[s].number[0];
            int axes_of_cylinder[] = {-1, cylinder_axis == 0 ? 1 : 0, cylinder_axis == 2 ? 1 : 2, -1, cylinder_axis, cylinder_axis};
            const int *axes = *steps[s].shape == 'b' ? axes_of_box : *steps[s].shape == 's' ? axes_of_sphere
                            : *steps[s].shape == 'a' ? axes_of_arch : axes_of_cylinder;
            step.number[i] = 0.5 * steps[s].number[i] * spacing + (axes[i] < 0 ? 0 : origin[axes[i]]);
        }
        if (*steps[s].shape == 'c')
            step.number[0] = steps[s].number[0];
        if (solid_join(solid, &step))
            exit(1);
    }
    return solid;
}

/* Compares a solid with the rule, point by point, on several lattices. */
static void check_steps(const char *name, const struct half_step *steps, int count)
{
    static const struct {
        double origin[3], spacing;
    } lattices[] = {{{0, 0, 0}, 1}, {{0, 0, 0}, 0.1}, {{-3.8, 0.3, 0.7}, 0.095}, {{1234.5, -77.7, 0.01}, 0.19}, {{1e-3, 0, 3e3}, 0.03}};
    static struct lattice_points points;
    long wrong = 0, total = 0;
    for (size_t l = 0; l < sizeof lattices / sizeof lattices[0]; l++) {
        struct solid *solid = make_solid(steps, count, lattices[l].origin, lattices[l].spacing);
        points = (struct lattice_points){.beyond = 0};
        solid_visit(solid, mark_line, &points);
        long found = solid_count(solid);
        wrong += points.beyond;
        total = 0;
        for (int i = 0; i < LATTICE; i++)
            for (int j = 0; j < LATTICE; j++)
                for (int k = 0; k < LATTICE; k++) {
                    const int p[3] = {2 * (i - EDGE) + 1, 2 * (j - EDGE) + 1, 2 * (k - EDGE) + 1};
                    bool is_in = false;
                    for (int s = 0; s < count; s++) {
                        bool is_there = is_strictly_in(&steps[s], p);
                        is_in = steps[s].operation == SOLID_ADD ? is_in || is_there
                              : steps[s].operation == SOLID_CUT ? is_in && !is_there
                                                                : is_in && is_there;
                    }
                    wrong += is_in != (points.in[i][j][k] != 0);
                    total += is_in;
                }
        wrong += found != total;
        solid_close(solid);
    }
    printf("   %s: %ld points\n", name, total);
    check_true(name, wrong == 0);
}

static void test_shapes(void)
{
    /* the faces of the first of each pair go through points, those of the second between them */
    check_steps("box, points on its faces", (struct half_step[]){{SOLID_ADD, "box", {-5, 7, 1, 9, -11, 13}}}, 1);
    check_steps("box, faces between points", (struct half_step[]){{SOLID_ADD, "box", {-6, 8, 2, 10, -10, 12}}}, 1);
    check_steps("box of one point", (struct half_step[]){{SOLID_ADD, "box", {-2, 0, 0, 2, 4, 6}}}, 1);
    check_steps("box between points: empty", (struct half_step[]){{SOLID_ADD, "box", {1, 3, 0, 20, 0, 20}}}, 1);
    /* 3 4 5 and 6 8 10 about a point: points at exactly the radius */
    check_steps("sphere about a point", (struct half_step[]){{SOLID_ADD, "sphere", {1, 3, -5, 10}}}, 1);
    check_steps("sphere about a corner", (struct half_step[]){{SOLID_ADD, "sphere", {0, 2, -4, 15}}}, 1);
    check_steps("large sphere about a point", (struct half_step[]){{SOLID_ADD, "sphere", {1, 1, 1, 26}}}, 1);
    /* sin 30 degrees is 1/2: points on the wave */
    check_steps("arch", (struct half_step[]){{SOLID_ADD, "arch", {-11, 13, 1, 20, -4, 6}}}, 1);
    check_steps("arch that hangs down", (struct half_step[]){{SOLID_ADD, "arch", {-12, 14, 2, -17, -4, 6}}}, 1);
    check_steps("a wave", (struct half_step[]){{SOLID_ADD, "box", {-20, 20, -20, 0, -2, 2}}, {SOLID_CUT, "arch", {-20, 0, 0, -9, -2, 2}},
                                               {SOLID_ADD, "arch", {0, 20, 0, 9, -2, 2}}}, 3);
    for (int axis = 0; axis < 3; axis++) {
        check_steps("cylinder about points", (struct half_step[]){{SOLID_ADD, "cyli", {axis, 3, -5, 10, -7, 13}}}, 1);
        check_steps("cylinder about a corner", (struct half_step[]){{SOLID_ADD, "cylinder", {axis, -2, 4, 13, -8, 12}}}, 1);
    }
}

static void test_order(void)
{
    const struct half_step a = {SOLID_ADD, "box", {-21, 21, -11, 11, -9, 9}}, b = {SOLID_CUT, "sphere", {1, 1, 1, 10}},
                           c = {SOLID_ADD, "cyli", {1, 1, 1, 5, -25, 25}}, d = {SOLID_KEEP, "box", {-15, 31, -31, 5, -31, 31}},
                           e = {SOLID_ADD, "sphere", {-21, -21, -21, 15}}, f = {SOLID_KEEP, "sphere", {1, 1, 1, 26}};
    check_steps("add cut", (struct half_step[]){a, b}, 2);
    check_steps("add cut add", (struct half_step[]){a, b, c}, 3);
    check_steps("add add cut: the other order", (struct half_step[]){a, c, b}, 3);
    check_steps("add cut add keep", (struct half_step[]){a, b, c, d}, 4);
    check_steps("add keep add", (struct half_step[]){a, d, e}, 3);
    check_steps("add add keep keep cut", (struct half_step[]){a, e, d, f, b}, 5);
    check_steps("what is kept apart is nothing", (struct half_step[]){b, d, c, {SOLID_KEEP, "box", {27, 37, 27, 37, 27, 37}}}, 4);
    check_steps("add behind nothing", (struct half_step[]){a, {SOLID_KEEP, "box", {27, 37, 27, 37, 27, 37}}, e}, 3);
}

/* Sizes that no lattice should be gone through for are refused at once. */
static void test_limits(void)
{
    static const struct half_step far = {SOLID_ADD, "box", {0, 2000002, 0, 2, 0, 2}}, wide = {SOLID_ADD, "box", {0, 2000000, 0, 2000000, 0, 2}};
    struct solid *solid = solid_open((double[]){0, 0, 0}, 1);
    struct solid_step step = {.operation = far.operation, .shape = solid_shape_find("box")};
    for (int i = 0; i < SOLID_NUMBERS; i++)
        step.number[i] = 0.5 * far.number[i];
    check_true("limit: a million spacings from the origin", solid_join(solid, &step) && solid->n_steps == 0);
    for (int i = 0; i < SOLID_NUMBERS; i++)
        step.number[i] = 0.5 * wide.number[i];
    check_true("limit: points of the lattice", !solid_join(solid, &step) && solid_fault(solid));
    step.number[1] = 10;
    step.number[3] = 1e4;
    step.number[5] = 1e4;
    solid_close(solid);
    solid = solid_open((double[]){0, 0, 0}, 1);
    check_true("limit: lines of the lattice", !solid_join(solid, &step) && solid_fault(solid));
    step.number[5] = 100;
    solid_close(solid);
    solid = solid_open((double[]){0, 0, 0}, 1);
    check_true("limit: ten million points are none", !solid_join(solid, &step) && !solid_fault(solid) && solid_count(solid) == 10000000);
    step.number[0] = 10;
    check_true("a box turned round", solid_join(solid, &step));
    step = (struct solid_step){.shape = solid_shape_find("arch"), .number = {0, 2, 0, 0, 0, 1}};
    check_true("an arch without height", solid_join(solid, &step));
    step.number[3] = -1;
    check_true("an arch", !solid_join(solid, &step));
    solid_close(solid);
}

int main(void)
{
    test_cylinders();
    test_shapes();
    test_order();
    test_limits();
    return check_result();
}
