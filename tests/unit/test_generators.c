/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The generators of `part` against the definitions of spec 3.3 (cyli: its own line of help): count,
 * order, positions and masses, found here by trying every point of a lattice that is larger than
 * the body. Volumes are compared with those of the shapes. */
#include "check.h"
#include "scene_text.h"

static const double PI = 3.14159265358979323846;

enum { MOST_POINTS = 20000 };

/* Points in the order of their numbers. */
struct cloud {
    int count;
    double position[MOST_POINTS][3], mass[MOST_POINTS];
};

static void add_to_cloud(void *context, const double position[3], double mass)
{
    struct cloud *cloud = context;
    if (cloud->count == MOST_POINTS)
        exit(1);
    for (int a = 0; a < 3; a++)
        cloud->position[cloud->count][a] = position[a];
    cloud->mass[cloud->count++] = mass;
}

/* Density and spacing of all lattices here; powers of two, so that positions and masses are exact. */
static const double DENSITY = 3, SPACING = 0.125;
static const double LATTICE_MASS = 3 * 0.125 * 0.125 * 0.125;

static void write_head(struct deck_builder *deck, int bodies, const char *particles)
{
    deck_add(deck, "nbbo %d\nnbmp %s\nnmat 2\ndcell 1\ngrid -8 8 -8 8 -8 8\n", bodies, particles);
    deck_add(deck, "mate\n1 elas 2 1 0.3\n2 elas 4 1 0.3\n");
}

/* Reads a deck with this part block; returns the number of its points, -1 when it is wrong. The
 * points go to the cloud. */
static long read_part(const char *part, const char *particles, struct cloud *cloud, double *candidates)
{
    struct deck_builder deck = {0};
    struct diagnostics *diagnostics = diagnostics_open();
    struct deck_text *text = text_open(diagnostics);
    write_head(&deck, 1, particles);
    deck_add(&deck, "part %s\nendi\n", part);
    text_include_memory(text, "deck", deck.text, deck.length);
    free(deck.text);
    struct scene *scene = reader_read(text, diagnostics);
    long count = -1;
    cloud->count = 0;
    if (diagnostics_errors(diagnostics) == 0) {
        const struct generator *generator = &scene->bodies[0].generator;
        generator->row->visit(generator, add_to_cloud, cloud);
        *candidates = generator->row->candidates(generator);
        count = generator_count(generator) == scene->bodies[0].count ? scene->bodies[0].count : -2;
    }
    scene_close(scene);
    text_close(text);
    diagnostics_close(diagnostics);
    return count;
}

static struct cloud found, expected;

static bool is_accepted(const char *part, const char *particles)
{
    double candidates;
    return read_part(part, particles, &found, &candidates) >= 0;
}

static void start_expected(void)
{
    expected.count = 0;
}

static void expect_point(double x, double y, double z, double mass)
{
    add_to_cloud(&expected, (const double[]){x, y, z}, mass);
}

/* Compares the points of a part block with `expected`, in order. */
static void check_part(const char *name, const char *part)
{
    double candidates = 0, deviation = 0;
    long count = read_part(part, "20000", &found, &candidates);
    bool good = count == expected.count && found.count == expected.count && candidates >= (double)count;
    for (int i = 0; i < expected.count && good; i++) {
        for (int a = 0; a < 3; a++)
            deviation = fmax(deviation, fabs(found.position[i][a] - expected.position[i][a]));
        deviation = fmax(deviation, fabs(found.mass[i] - expected.mass[i]));
    }
    if (!good)
        printf("   %ld points, %d visited, of %g; %d expected\n", count, found.count, candidates, expected.count);
    check_near(name, good ? deviation : INFINITY, 0, 1e-15);
}

/* Volume of the points found against that of the shape. */
static void check_volume(const char *name, double volume, double tolerance)
{
    double mass = 0;
    for (int i = 0; i < found.count; i++)
        mass += found.mass[i];
    printf("   %d points, volume %.4f of the shape's\n", found.count, mass / (DENSITY * volume));
    check_near(name, mass / (DENSITY * volume), 1, tolerance);
}

/* --- the shapes --- */

static void test_points(void)
{
    start_expected();
    expect_point(0.5, -1, 2, 0.25);
    expect_point(-3, 0, 0, 7);
    expect_point(0.5, -1, 2, 1e-3);
    check_part("poin: as listed", "poin 1 3\n1 1 0.25 0.5 -1 2\n2 2 7 -3 0 0\n3 1 1e-3 0.5 -1 2");
    check_part("poin: larger ids", "poin 1 3\n1 1 0.25 0.5 -1 2\n5 2 7 -3 0 0\n9 1 1e-3 0.5 -1 2");
    check_true("poin: ids that are taken", !is_accepted("poin 1 2\n1 1 1 0 0 0\n1 1 1 1 1 1", "2"));
}

/* x fastest; without the points in the hole, for a hole of so many spacings. */
static void expect_block(const double origin[3], const int n[3], const double hole[2], int hole_numbers)
{
    start_expected();
    for (int k = 0; k < n[2]; k++)
        for (int j = 0; j < n[1]; j++)
            for (int i = 0; i < n[0]; i++) {
                double x = origin[0] + (i + 0.5) * SPACING, y = origin[1] + (j + 0.5) * SPACING;
                double dx = x - hole[0], dy = y - hole[1], radius = hole_numbers * SPACING;
                if (dx * dx + dy * dy >= radius * radius)
                    expect_point(x, y, origin[2] + (k + 0.5) * SPACING, LATTICE_MASS);
            }
}

static void test_block(void)
{
    const double origin[3] = {-1, 0.5, 2}, hole[2] = {0.25, 1.5};
    expect_block(origin, (const int[]){7, 5, 3}, hole, 0);
    check_part("bloc: 7 x 5 x 3", "bloc 1 1 3 0.125 -1 0.5 2 7 5 3");
    check_true("bloc: count", found.count == 105);
    check_volume("bloc: volume", 105 * pow(0.125, 3), 1e-14);
    expect_block(origin, (const int[]){1, 1, 1}, hole, 0);
    check_part("bloc: one point", "block 1 2 3 0.125 -1 0.5 2 1 1 1");
    expect_block(origin, (const int[]){20, 16, 2}, hole, 4);
    check_part("blod: hole inside", "blod 1 1 3 0.125 -1 0.5 2 20 16 2 0.25 1.5 99 4");
    check_volume("blod: volume", (20 * 16 - PI * 16) * 2 * pow(0.125, 3), 0.02);
    expect_block(origin, (const int[]){20, 16, 2}, (const double[]){-1, 0.5}, 6);
    check_part("blod: hole at a corner", "blod 1 1 3 0.125 -1 0.5 2 20 16 2 -1 0.5 0 6");
    expect_block(origin, (const int[]){20, 16, 2}, (const double[]){-5, 0.5}, 6);
    check_part("blod: hole outside", "blod 1 1 3 0.125 -1 0.5 2 20 16 2 -5 0.5 0 6");
}

/* x slowest, z fastest; nr is truncated, and nearer than nr spacings. */
static void expect_sphere(const double centre[3], int nr)
{
    start_expected();
    for (int i = -nr - 3; i <= nr + 3; i++)
        for (int j = -nr - 3; j <= nr + 3; j++)
            for (int k = -nr - 3; k <= nr + 3; k++) {
                double dx = (i - 0.5) * SPACING, dy = (j - 0.5) * SPACING, dz = (k - 0.5) * SPACING;
                if (dx * dx + dy * dy + dz * dz < nr * nr * SPACING * SPACING)
                    expect_point(centre[0] + dx, centre[1] + dy, centre[2] + dz, LATTICE_MASS);
            }
}

static void test_sphere(void)
{
    const double centre[3] = {1, -2, 0.5};
    expect_sphere(centre, 1);
    check_part("sphe: eight points", "sphe 1 1 3 0.125 1 -2 0.5 1");
    check_true("sphe: eight points: count", found.count == 8);
    expect_sphere(centre, 3);
    check_part("sphe: nr is truncated", "sphe 1 1 3 0.125 1 -2 0.5 3.9");
    expect_sphere(centre, 12);
    check_part("sphe: twelve in the radius", "sphere 1 1 3 0.125 1 -2 0.5 12");
    check_volume("sphe: volume", 4 * PI / 3 * pow(12 * 0.125, 3), 0.01);
}

static void expect_disc(const double centre[3], int nr)
{
    start_expected();
    for (int i = -nr - 3; i <= nr + 3; i++)
        for (int j = -nr - 3; j <= nr + 3; j++) {
            double dx = (i - 0.5) * SPACING, dy = (j - 0.5) * SPACING;
            if (dx * dx + dy * dy < nr * nr * SPACING * SPACING)
                expect_point(centre[0] + dx, centre[1] + dy, centre[2] + SPACING / 2, LATTICE_MASS);
        }
}

static void test_disc(void)
{
    const double centre[3] = {1, -2, 0.5};
    expect_disc(centre, 1);
    check_part("cicl: four points", "cicl 1 1 3 0.125 1 -2 0.5 1");
    expect_disc(centre, 20);
    check_part("cicl: twenty in the radius", "cicl 1 1 3 0.125 1 -2 0.5 20");
    check_volume("cicl: volume", PI * pow(20 * 0.125, 2) * 0.125, 0.01);
}

/* Axis slowest, then the second of the other two; centres nearer than the radius to the axis, and
 * below the end face. */
static void expect_cylinder(int axis, const double base[3], double radius, double height)
{
    int n = (int)(radius / SPACING) + 3, first = (axis + 1) % 3, second = (axis + 2) % 3;
    start_expected();
    for (int k = 1; (k - 0.5) * SPACING < height; k++)
        for (int j = -n; j <= n; j++)
            for (int i = -n; i <= n; i++) {
                double du = (i - 0.5) * SPACING, dv = (j - 0.5) * SPACING, position[3];
                if (du * du + dv * dv >= radius * radius)
                    continue;
                position[axis] = base[axis] + (k - 0.5) * SPACING;
                position[first] = base[first] + du;
                position[second] = base[second] + dv;
                expect_point(position[0], position[1], position[2], LATTICE_MASS);
            }
}

static void test_cylinder(void)
{
    static const struct {
        double radius, height;
    } sizes[] = {{0.5, 1}, {0.55, 0.9375}, {0.55, 0.94}, {0.0885, 0.0626}, {1.25, 2.5}, {0.125, 0.125}};
    static const char *const axes[3][3] = {{"1", "x", "X"}, {"2", "y", "Y"}, {"3", "z", "Z"}};
    const double base[3] = {0.5, -1.5, 2};
    char part[120], name[80];
    for (int axis = 0; axis < 3; axis++)
        for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
            expect_cylinder(axis, base, sizes[i].radius, sizes[i].height);
            snprintf(part, sizeof part, "cyli 1 1 3 0.125 %s 0.5 -1.5 2 %.17g %.17g", axes[axis][i % 3],
                     sizes[i].radius, sizes[i].height);
            snprintf(name, sizeof name, "cyli: along %s, radius %g, height %g", axes[axis][1], sizes[i].radius,
                     sizes[i].height);
            check_part(name, part);
            if (sizes[i].height == 2.5)
                check_volume("cyli: volume", PI * 1.25 * 1.25 * 2.5, 0.02);
        }
}

/* --- bounds --- */

/* A body may have as many points as nbmp says, not one more; absurd numbers are refused at once. */
static void test_bounds(void)
{
    static const char *const absurd[] = {
        "bloc 1 1 3 0.125 0 0 0 2147483647 2147483647 2147483647", "bloc 1 1 3 0.125 0 0 0 2147483647 1 1",
        "blod 1 1 3 0.125 0 0 0 2147483647 2147483647 1 0 0 0 2147483647", "sphe 1 1 3 0.125 0 0 0 1e9",
        "sphe 1 1 3 0.125 0 0 0 1e300", "cicl 1 1 3 0.125 0 0 0 2147483647", "cyli 1 1 3 0.125 x 0 0 0 1e30 1",
        "cyli 1 1 3 0.125 x 0 0 0 1 1e30", "cyli 1 1 3 1e-300 x 0 0 0 1e300 1e300",
        "cyli 1 1 3 1e300 x 0 0 0 1e-300 1e-300", "cyli 1 1 3 1e-300 x 0 0 0 1e300 1e-301"};
    char name[80];
    check_true("bounds: as many as nbmp", is_accepted("bloc 1 1 3 0.125 0 0 0 5 5 4", "100") && found.count == 100);
    check_true("bounds: one more than nbmp", !is_accepted("bloc 1 1 3 0.125 0 0 0 101 1 1", "100"));
    check_true("bounds: a sphere larger than nbmp", !is_accepted("sphe 1 1 3 0.125 0 0 0 9", "100"));
    check_true("bounds: points beyond nbmp", !is_accepted("poin 1 2\n1 1 1 0 0 0\n2 1 1 1 1 1", "1"));
    for (size_t i = 0; i < sizeof absurd / sizeof absurd[0]; i++) {
        snprintf(name, sizeof name, "bounds: refused: %.45s", absurd[i]);
        check_true(name, !is_accepted(absurd[i], "100"));
    }
    check_true("bounds: a hole as large as the block",
               !is_accepted("blod 1 1 3 0.125 0 0 0 4 4 4 0.25 0.25 0 9", "100"));
}

/* --- the store --- */

/* Bodies follow each other; a volume is the mass by the density of the material, whatever the
 * density of the lattice. */
static void test_store(void)
{
    struct deck_builder deck = {0};
    struct test_run run;
    bool good = true;
    write_head(&deck, 3, "100");
    deck_add(&deck, "part bloc 1\n1 3 0.125 0 0 0 3 2 1\npart poin 1 2\n7 2 0.5 1 1 1\n8 2 0.25 2 2 2\n"
                    "part cyli 1\n2 3 0.125 z 1 2 3 0.25 0.25\nendi\n");
    test_run_open(&run, &deck);
    static const long first[] = {0, 6, 8}, count[] = {6, 2, 24};
    static const double density[] = {2, 4, 4};
    for (int b = 0; b < 3; b++) {
        good = good && run.scene->bodies[b].first == first[b] && run.scene->bodies[b].count == count[b];
        for (long id = first[b]; id < first[b] + count[b] && good; id++) {
            int32_t p = run.mpm->store->index_of_id[id];
            double mass = b == 1 ? (id == 6 ? 0.5 : 0.25) : LATTICE_MASS;
            good = run.mpm->store->integer[COLUMN_BODY][p] == b && run.mpm->store->integer[COLUMN_ID][p] == id
                && run.mpm->store->real[COLUMN_MASS][0][p] == mass
                && run.mpm->store->real[COLUMN_VOLUME][0][p] == mass / density[b];
        }
    }
    check_true("store: bodies, ids, masses, volumes", good);
    int32_t p = run.mpm->store->index_of_id[5];
    const double position[3] = {0.3125, 0.1875, 0.0625};
    for (int a = 0; a < 3; a++)
        good = good && run.mpm->store->real[COLUMN_POSITION][a][p] == position[a];
    check_true("store: last point of the block", good && run.mpm->store->count == 32);
    test_run_close(&run);
}

int main(void)
{
    test_points();
    test_block();
    test_sphere();
    test_disc();
    test_cylinder();
    test_bounds();
    test_store();
    return check_result();
}
