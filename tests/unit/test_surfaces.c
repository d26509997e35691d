/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Surfaces of triangles: both kinds of file, and which points of a lattice are inside, against the
 * half spaces of convex bodies and against other formulas, with lattice lines through corners,
 * edges and faces. */
#include "check.h"
#include "particles/crossings.h"
#include "random.h"
#include "scene_text.h"

#include <float.h>

/* --- meshes --- */

enum { MOST_CORNERS = 20000, MOST_BYTES = 6000000 };

struct mesh {
    double corner[MOST_CORNERS][3][3];
    int count;
};

static void add_facet(struct mesh *mesh, const double a[3], const double b[3], const double c[3])
{
    if (mesh->count == MOST_CORNERS)
        exit(1);
    memcpy(mesh->corner[mesh->count][0], a, 3 * sizeof(double));
    memcpy(mesh->corner[mesh->count][1], b, 3 * sizeof(double));
    memcpy(mesh->corner[mesh->count++][2], c, 3 * sizeof(double));
}

static void reverse(struct mesh *mesh, int from)
{
    for (int t = from; t < mesh->count; t++)
        for (int a = 0; a < 3; a++) {
            double swapped = mesh->corner[t][1][a];
            mesh->corner[t][1][a] = mesh->corner[t][2][a];
            mesh->corner[t][2][a] = swapped;
        }
}

/* Normals outwards, each face in two triangles. */
static void add_box(struct mesh *mesh, const double low[3], const double high[3])
{
    for (int axis = 0; axis < 3; axis++)
        for (int side = 0; side < 2; side++) {
            double corner[4][3];
            for (int c = 0; c < 4; c++) {
                bool u = c == 1 || c == 2, v = c >= 2;
                corner[c][axis] = side ? high[axis] : low[axis];
                corner[c][(axis + 1) % 3] = u ? high[(axis + 1) % 3] : low[(axis + 1) % 3];
                corner[c][(axis + 2) % 3] = v ? high[(axis + 2) % 3] : low[(axis + 2) % 3];
            }
            add_facet(mesh, corner[0], corner[side ? 1 : 2], corner[side ? 2 : 1]);
            add_facet(mesh, corner[0], corner[side ? 2 : 3], corner[side ? 3 : 2]);
        }
}

static void add_tetrahedron(struct mesh *mesh, const double at[3], double size)
{
    double v[4][3];
    for (int i = 0; i < 4; i++)
        for (int a = 0; a < 3; a++)
            v[i][a] = at[a] + (i == a + 1 ? size : 0);
    add_facet(mesh, v[0], v[2], v[1]);
    add_facet(mesh, v[0], v[1], v[3]);
    add_facet(mesh, v[0], v[3], v[2]);
    add_facet(mesh, v[1], v[2], v[3]);
}

static void add_octahedron(struct mesh *mesh, const double at[3], double size)
{
    for (int octant = 0; octant < 8; octant++) {
        double v[3][3];
        int flips = 0;
        for (int i = 0; i < 3; i++) {
            int sign = octant >> i & 1 ? -1 : 1;
            flips += sign < 0;
            for (int a = 0; a < 3; a++)
                v[i][a] = at[a] + (a == i ? sign * size : 0);
        }
        add_facet(mesh, v[0], v[flips % 2 ? 2 : 1], v[flips % 2 ? 1 : 2]);
    }
}

/* A convex ball of rows and columns; corners rounded to single precision, as in a binary file. */
static void add_ball(struct mesh *mesh, const double at[3], double radius, int rows)
{
    const double pi = 3.14159265358979323846;
    int columns = 2 * rows;
    for (int row = 0; row < rows; row++)
        for (int column = 0; column < columns; column++) {
            double v[4][3];
            for (int c = 0; c < 4; c++) {
                int r = row + c / 2, n = (column + (c == 1 || c == 2)) % columns;
                double ring = r == 0 || r == rows ? 0 : sin(pi * r / rows), angle = 2 * pi * n / columns;
                v[c][0] = (float)(at[0] + radius * ring * cos(angle));
                v[c][1] = (float)(at[1] + radius * ring * sin(angle));
                v[c][2] = (float)(at[2] + radius * (r == 0 ? 1 : r == rows ? -1 : cos(pi * r / rows)));
            }
            if (row > 0)
                add_facet(mesh, v[0], v[2], v[1]);
            if (row < rows - 1)
                add_facet(mesh, v[0], v[3], v[2]);
        }
}

static double volume_of(const struct mesh *mesh)
{
    double volume = 0;
    for (int t = 0; t < mesh->count; t++) {
        const double *a = mesh->corner[t][0], *b = mesh->corner[t][1], *c = mesh->corner[t][2];
        volume += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    return volume / 6;
}

/* --- files --- */

static char bytes[MOST_BYTES];

static size_t write_text(const struct mesh *mesh)
{
    size_t size = (size_t)snprintf(bytes, sizeof bytes, "solid a body, and facet as a name\r\n");
    for (int t = 0; t < mesh->count; t++) {
        size += (size_t)snprintf(bytes + size, sizeof bytes - size, "  facet normal nan 0 -0.0e0\n outer loop\n");
        for (int c = 0; c < 3; c++)
            size += (size_t)snprintf(bytes + size, sizeof bytes - size, "    vertex %.17g %.17g\t%.17g\r\n", mesh->corner[t][c][0],
                                     mesh->corner[t][c][1], mesh->corner[t][c][2]);
        size += (size_t)snprintf(bytes + size, sizeof bytes - size, " ENDLOOP\n  endfacet\n");
    }
    return size + (size_t)snprintf(bytes + size, sizeof bytes - size, "endsolid a body\n");
}

static void put_little_endian(char *at, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        at[i] = (char)(value >> (8 * i));
}

/* Its head begins like a text. */
static size_t write_binary(const struct mesh *mesh)
{
    memset(bytes, ' ', 84);
    memcpy(bytes, "solid facet normal 0 0 1", 24);
    put_little_endian(bytes + 80, (uint32_t)mesh->count);
    size_t size = 84;
    for (int t = 0; t < mesh->count; t++, size += 50) {
        memset(bytes + size, 0, 50);
        for (int i = 0; i < 9; i++) {
            float value = (float)mesh->corner[t][i / 3][i % 3];
            uint32_t bits;
            memcpy(&bits, &value, sizeof bits);
            put_little_endian(bytes + size + 12 + 4 * i, bits);
        }
    }
    return size;
}

/* --- points --- */

enum { EDGE = 14, LATTICE = 2 * EDGE };

typedef bool inside_rule(const void *context, const double point[3]);

/* Compares the points of a surface (in the file's bytes) with a rule that is given points in the
 * file's lengths. Returns how many differ, or -1 where it is no closed surface. */
static long compare(size_t size, const struct crossings_placement *placement, inside_rule *rule, const void *context,
                    long *total, long *overlapping)
{
    struct stl stl;
    struct stl_gap gap;
    char fault[STL_FAULT];
    const char *why;
    if (!stl_read(&stl, bytes, size, fault)) {
        printf("   %s\n", fault);
        return -1;
    }
    struct crossings *crossings = stl_is_closed(&stl, &gap) ? crossings_open(&stl, placement, &why) : NULL;
    stl_close(&stl);
    if (!crossings)
        return -1;
    long wrong = 0;
    *total = 0;
    for (long k = -EDGE; k < EDGE; k++)
        for (long j = -EDGE; j < EDGE; j++) {
            bool inside[LATTICE] = {false};
            size_t count;
            const struct crossings_run *runs = crossings_runs(crossings, j, k, &count);
            for (size_t r = 0; r < count; r++)
                for (long i = runs[r].from; i < runs[r].to; i++) {
                    if (i >= -EDGE && i < EDGE)
                        inside[i + EDGE] = true;
                    else
                        wrong++;
                }
            for (long i = -EDGE; i < EDGE; i++) {
                double point[3] = {(double)i + 0.5, (double)j + 0.5, (double)k + 0.5};
                for (int a = 0; a < 3; a++)
                    point[a] = (placement->origin[a] + placement->spacing * point[a] - placement->move[a]) / placement->scale;
                bool is_in = rule(context, point);
                *total += is_in;
                wrong += is_in != inside[i + EDGE];
            }
        }
    *overlapping = crossings->overlapping;
    crossings_close(crossings);
    return wrong;
}

/* Within a hundredth of the margin of round-off and single precision this counts as outside. */
static const double NEAR = 1e-7;

struct box_rule {
    double low[3], high[3];
};

static bool in_box(const void *context, const double p[3])
{
    const struct box_rule *box = context;
    bool is_in = true;
    for (int a = 0; a < 3; a++)
        is_in = is_in && box->low[a] + NEAR < p[a] && p[a] < box->high[a] - NEAR;
    return is_in;
}

/* at and size */
static bool in_tetrahedron(const void *context, const double p[3])
{
    const double *t = context, x = p[0] - t[0], y = p[1] - t[1], z = p[2] - t[2];
    return x > NEAR && y > NEAR && z > NEAR && x + y + z < t[3] - NEAR;
}

static bool in_octahedron(const void *context, const double p[3])
{
    const double *t = context;
    return fabs(p[0] - t[0]) + fabs(p[1] - t[1]) + fabs(p[2] - t[2]) < t[3] - NEAR;
}

/* Behind the planes of all triangles. */
static bool in_convex(const void *context, const double p[3])
{
    const struct mesh *mesh = context;
    for (int t = 0; t < mesh->count; t++) {
        const double *a = mesh->corner[t][0], *b = mesh->corner[t][1], *c = mesh->corner[t][2];
        double u[3], v[3], w[3];
        for (int i = 0; i < 3; i++) {
            u[i] = b[i] - a[i];
            v[i] = c[i] - a[i];
            w[i] = p[i] - a[i];
        }
        if (w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) + w[2] * (u[0] * v[1] - u[1] * v[0]) >= 0)
            return false;
    }
    return true;
}

/* `whole` keeps its normals while those of `mesh` are reversed. */
static struct mesh mesh, whole;

/* As text, as a binary file, with reversed normals. */
static void check_files(const char *name, const struct crossings_placement *placement, inside_rule *rule, const void *context)
{
    char full[160];
    static const char *const kinds[] = {"text", "binary", "text reversed", "binary reversed"};
    for (int kind = 0; kind < 4; kind++) {
        long total = 0, overlapping = 0;
        if (kind == 2)
            reverse(&mesh, 0);
        size_t size = kind % 2 ? write_binary(&mesh) : write_text(&mesh);
        long wrong = compare(size, placement, rule, context, &total, &overlapping);
        snprintf(full, sizeof full, "%s, %s: %ld points", name, kinds[kind], total);
        check_true(full, wrong == 0 && overlapping == 0);
    }
    reverse(&mesh, 0);
}

static const struct crossings_placement plain = {.scale = 1, .spacing = 1};
static const struct crossings_placement decimal = {.scale = 0.1, .move = {0.3, -0.2, 0.7}, .origin = {0.3, -0.2, 0.7}, .spacing = 0.1};
static const struct crossings_placement scaled = {.scale = 25.4, .move = {1.27, 2.54, 0}, .origin = {0, 0, -12.7}, .spacing = 25.4};

static void test_boxes(void)
{
    static const struct box_rule boxes[] = {{{-3, -4, -5}, {6, 5, 4}},           /* faces between points */
                                            {{-2.5, -1.5, -4.5}, {6.5, 3.5, 0.5}}, /* faces, edges, corners at points */
                                            {{-2.5, -3, -4.5}, {5, 3.5, 1}},
                                            {{0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}},  /* none */
                                            {{-0.1, 0.2, 0.3}, {5.7, 4.4, 3.1}}};
    for (size_t b = 0; b < sizeof boxes / sizeof boxes[0]; b++) {
        mesh.count = 0;
        add_box(&mesh, boxes[b].low, boxes[b].high);
        check_files("box", &plain, in_box, &boxes[b]);
        check_files("box, decimal spacing", &decimal, in_box, &boxes[b]);
        check_files("box, scaled and moved", &scaled, in_box, &boxes[b]);
    }
}

/* Lattice lines go through the corners and along the edges. */
static void test_slanted(void)
{
    static const double places[][4] = {{0, 0, 0, 9}, {0.5, 0.5, 0.5, 9}, {-3.5, 0.5, 1, 8}, {-2.5, -3.5, -4.5, 10.5}, {-5.2, -4.1, 0.3, 7.7}};
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        mesh.count = 0;
        add_tetrahedron(&mesh, places[i], places[i][3]);
        check_files("tetrahedron", &plain, in_tetrahedron, places[i]);
        check_files("tetrahedron, decimal spacing", &decimal, in_tetrahedron, places[i]);
        mesh.count = 0;
        add_octahedron(&mesh, places[i], 0.5 * places[i][3]);
        const double half[4] = {places[i][0], places[i][1], places[i][2], 0.5 * places[i][3]};
        check_files("octahedron", &plain, in_octahedron, half);
        check_files("octahedron, decimal spacing", &decimal, in_octahedron, half);
    }
}

static void test_balls(void)
{
    struct random random = {7};
    char name[80];
    for (int ball = 0; ball < 8; ball++) {
        double at[3], radius = ball == 7 ? 13 : random_between(&random, 1, 9);
        for (int a = 0; a < 3; a++) /* in some the poles and the circles about them are on lattice lines */
            at[a] = ball == 7 ? 0.31 : ball < 3 ? 0.5 * ball : random_between(&random, -4, 4);
        mesh.count = 0;
        add_ball(&mesh, at, radius, 3 + 2 * ball);
        snprintf(name, sizeof name, "ball %d of radius %.3g", ball, radius);
        whole = mesh;
        check_files(name, &plain, in_convex, &whole);
    }
    long total = 0, overlapping;
    compare(write_binary(&mesh), &plain, in_convex, &whole, &total, &overlapping);
    check_near("volume of the largest ball", (double)total / volume_of(&mesh), 1, 2e-3);
}

/* --- the arch of decks/thesis --- */

/* Its outline by the formulas of tools/make_overhang_stl.awk. */
static bool in_arch(const double p[3])
{
    const double pi = 3.14159265358979323846;
    double x = fabs(p[0]), z = p[2];
    if (!(p[1] > 0 && p[1] < 3 && z > 0 && z < 5) || x >= 4)
        return false;
    if (z > 4)
        return true;
    if (x >= 3 || z == 4)
        return false;
    if (x >= 2)
        return true;
    int chord = (int)(acos(x / 2) * 24 / pi);
    double from = pi * chord / 24, to = pi * (chord + 1) / 24;
    double share = (x - 2 * cos(from)) / (2 * cos(to) - 2 * cos(from));
    return z > 1.5 + 2 * sin(from) + share * 2 * (sin(to) - sin(from));
}

struct arch_count {
    long count, wrong;
};

static void count_arch(void *context, const double position[3], double mass)
{
    struct arch_count *arch = context;
    (void)mass;
    arch->count++;
    arch->wrong += !in_arch(position);
}

/* Through a deck; the points against the formulas, and their volume against the part's. */
static void test_arch(void)
{
    static const double spacings[] = {0.25, 0.1, 0.0625};
    for (int s = 0; s < 3; s++) {
        struct deck_builder deck = {0};
        struct test_run run;
        struct arch_count arch = {0, 0};
        char name[80];
        double h = spacings[s];
        long expected = 0;
        deck_add(&deck, "nbbo 1\nnbmp 300000\nnmat 1\ndcell 1\ngrid -8 8 -8 8 -8 8\nmate\n1 elas 2 1 0.3\n");
        deck_add(&deck, "part solid 1\n1 1 %g 0 0 0\nadd stl \"decks/thesis/overhang_arch.stl\"\nendp\nendi\n", h);
        test_run_open(&run, &deck);
        const struct generator *generator = &run.scene->bodies[0].generator;
        generator->row->visit(generator, count_arch, &arch);
        for (int k = 0; k < 5 / h; k++)
            for (int j = 0; j < 3 / h; j++)
                for (int i = (int)(-4 / h) - 1; i < 4 / h; i++)
                    expected += in_arch((double[]){(i + 0.5) * h, (j + 0.5) * h, (k + 0.5) * h});
        snprintf(name, sizeof name, "arch, spacing %g: %ld points", h, expected);
        check_true(name, arch.wrong == 0 && arch.count == expected && expected > 0);
        snprintf(name, sizeof name, "arch, spacing %g: volume", h);
        check_near(name, (double)arch.count * h * h * h / 59.2042283, 1, h == 0.25 ? 0.015 : 0.005);
        test_run_close(&run);
    }
}

/* --- shells --- */

struct hollow_rule {
    struct box_rule outer, inner;
};

static bool in_hollow(const void *context, const double p[3])
{
    const struct hollow_rule *hollow = context;
    const struct box_rule *inner = &hollow->inner;
    bool is_open = true; /* outside the inner box by more than the margin */
    for (int a = 0; a < 3; a++)
        is_open = is_open && inner->low[a] - NEAR <= p[a] && p[a] <= inner->high[a] + NEAR;
    return in_box(&hollow->outer, p) && !is_open;
}

static bool in_either(const void *context, const double p[3])
{
    const struct hollow_rule *pair = context;
    return in_box(&pair->outer, p) != in_box(&pair->inner, p);
}

static void test_shells(void)
{
    const struct hollow_rule hollow = {{{-6, -7, -8}, {6, 7, 8}}, {{-2.5, -3, -4}, {3, 3.5, 4}}};
    mesh.count = 0;
    add_box(&mesh, hollow.outer.low, hollow.outer.high);
    int inner = mesh.count;
    add_box(&mesh, hollow.inner.low, hollow.inner.high);
    reverse(&mesh, inner);
    check_files("box with a hollow", &plain, in_hollow, &hollow);
    const struct hollow_rule apart = {{{-9, -9, -9}, {-4, -3, -2}}, {{1, 2, 3}, {4, 6, 9}}};
    mesh.count = 0;
    add_box(&mesh, apart.outer.low, apart.outer.high);
    add_box(&mesh, apart.inner.low, apart.inner.high);
    reverse(&mesh, inner);
    check_files("two boxes, one reversed", &plain, in_either, &apart);
    const struct hollow_rule across = {{{-6, -6, -6}, {3, 3, 3}}, {{0, 0, 0}, {6, 6, 6}}};
    long total, overlapping = 0;
    mesh.count = 0;
    add_box(&mesh, across.outer.low, across.outer.high);
    add_box(&mesh, across.inner.low, across.inner.high);
    check_true("shells that overlap cancel, and are counted",
               compare(write_text(&mesh), &plain, in_either, &across, &total, &overlapping) == 0 && overlapping == 27);
}

/* --- wrong and doubtful files --- */

static bool has_fault(size_t size, const char *fragment)
{
    struct stl stl;
    char fault[STL_FAULT] = "";
    if (stl_read(&stl, bytes, size, fault)) {
        stl_close(&stl);
        return false;
    }
    printf("   %s\n", fault);
    return strstr(fault, fragment) != NULL;
}

static bool has_text_fault(const char *text, const char *fragment)
{
    memcpy(bytes, text, strlen(text));
    return has_fault(strlen(text), fragment);
}

static void set_box(void)
{
    mesh.count = 0;
    add_box(&mesh, (double[]){0, 0, 0}, (double[]){3, 4, 5});
}

static void test_wrong_files(void)
{
    set_box();
    size_t size = write_text(&mesh);
    check_true("text cut in a facet", has_fault(size / 2, "the file ends here, it is cut"));
    check_true("text cut before its end", has_fault(size - 17, "expected facet or endsolid"));
    size = write_binary(&mesh);
    check_true("binary cut", has_fault(size - 1, "the file is cut, or no STL file: its head says 12 triangles, there are bytes for 11"));
    check_true("binary cut in its head", has_fault(50, "line 1: the file ends here"));
    put_little_endian(bytes + 84 + 12, 0x7fc00000);
    check_true("binary with nan", has_fault(size, "triangle 1 has the coordinate nan"));
    put_little_endian(bytes + 84 + 50 + 12, 0x7f800000);
    put_little_endian(bytes + 84 + 12, 0);
    check_true("binary with inf", has_fault(size, "triangle 2 has the coordinate inf"));
    check_true("empty file", has_text_fault("", "no STL file"));
    check_true("words", has_text_fault("part bloc 1\n1 2 3\n", "no STL file"));
    check_true("solid without facets", has_text_fault("solid nothing\nendsolid\n", "no triangle with an area"));
    check_true("a number misspelt", has_text_fault("solid\nfacet normal 0 0 1\nouter loop\nvertex 1 2 x3\n", "line 4: expected a number, found 'x3'"));
    check_true("a word misspelt", has_text_fault("solid\nfacet normal 0 0 1\nouter lop\n", "line 3: expected loop, found 'lop'"));
    check_true("a number too large", has_text_fault("solid\nfacet normal 0 0 1\nouter loop\nvertex 1 2 1e99\nvertex 1 1 1\nvertex 0 0 0\n"
                                                    "endloop\nendfacet\nendsolid", "triangle 1 has the coordinate 1e+99"));
    check_true("text behind the end", has_text_fault("solid\nendsolid\nrest\n", "line 3: expected solid, found 'rest'"));
    check_true("one point", has_text_fault("solid\nfacet normal 0 0 1\nouter loop\nvertex 1 2 3\nvertex 1 2 3\nvertex 1 2 3\nendloop\nendfacet\n"
                                           "endsolid", "no triangle with an area"));
    memset(bytes, 0, 200);
    check_true("zeros", has_fault(200, "no triangle with an area"));
    struct random random = {3};
    for (int i = 0; i < 5000; i++)
        bytes[i] = (char)random_bits(&random);
    check_true("noise", has_fault(5000, "cut, or no STL file"));
}

static struct stl_gap find_gap(void)
{
    struct stl stl;
    struct stl_gap gap = {0};
    char fault[STL_FAULT];
    if (!stl_read(&stl, bytes, write_text(&mesh), fault))
        exit(1);
    stl_is_closed(&stl, &gap);
    stl_close(&stl);
    return gap;
}

static void test_gaps(void)
{
    set_box();
    check_true("a closed box", find_gap().count == 0);
    mesh.count--;
    struct stl_gap gap = find_gap();
    check_true("a triangle is missing: three edges", gap.count == 3 && gap.forward + gap.backward == 1);
    double length = 0;
    for (int a = 0; a < 3; a++)
        length += pow(gap.to[a] - gap.from[a], 2);
    check_true("the first of them is an edge of it", length == 9 || length == 16 || length == 25);
    set_box();
    reverse(&mesh, 11);
    gap = find_gap();
    check_true("a triangle is turned: three edges", gap.count == 3 && (gap.forward == 2 || gap.backward == 2));
    set_box();
    add_facet(&mesh, mesh.corner[3][0], mesh.corner[3][1], mesh.corner[3][2]);
    check_true("a triangle is there twice: three edges", find_gap().count == 3);
    set_box();
    mesh.corner[5][1][2] += 1e-4;
    check_true("a corner that is off by 1e-4: two edges that were, two that are", find_gap().count == 4);
    set_box();
    for (int t = 0; t < mesh.count; t++)
        for (int c = 0; c < 3; c++)
            mesh.corner[t][c][t % 3] += (t % 2 ? 1 : -1) * 1e-6;
    check_true("corners that are off by less than a millionth are one", find_gap().count == 0);
}

/* A box with a needle in an edge (its corners are three points of one line) and a facet that has
 * two corners at one place, where the surface is closed all the same. */
static void test_degenerate(void)
{
    const struct box_rule box = {{-2, -2, -2}, {3, 3, 3}};
    struct stl stl;
    struct stl_gap gap;
    char fault[STL_FAULT];
    mesh.count = 0;
    add_box(&mesh, box.low, box.high);
    double middle[3], *a = mesh.corner[0][0], *b = mesh.corner[0][1], *c = mesh.corner[0][2];
    double ends[3][3];
    memcpy(ends, mesh.corner[0], sizeof ends);
    for (int i = 0; i < 3; i++)
        middle[i] = 0.5 * (a[i] + b[i]);
    memcpy(b, middle, sizeof middle); /* a m c, m b c, and the needle a b m on the neighbour's side */
    add_facet(&mesh, middle, ends[1], c);
    add_facet(&mesh, ends[0], ends[1], middle);
    add_facet(&mesh, middle, middle, ends[1]);
    size_t size = write_text(&mesh);
    bool good = stl_read(&stl, bytes, size, fault);
    check_true("degenerate triangles are counted", good && stl.degenerate == 2);
    check_true("and leave the surface closed", good && stl_is_closed(&stl, &gap));
    stl_close(&stl);
    check_files("box with degenerate triangles", &plain, in_box, &box);
    mesh.count -= 2;
    check_true("a corner on an edge leaves it open", find_gap().count == 3);
}

/* --- limits --- */

static bool is_refused(double scale, double spacing, const char *fragment)
{
    struct stl stl;
    char fault[STL_FAULT];
    const char *why = "";
    struct crossings_placement placement = {.scale = scale, .spacing = spacing};
    set_box();
    if (!stl_read(&stl, bytes, write_text(&mesh), fault))
        exit(1);
    struct crossings *crossings = crossings_open(&stl, &placement, &why);
    stl_close(&stl);
    crossings_close(crossings);
    return !crossings && strstr(why, fragment);
}

static void test_limits(void)
{
    check_true("limit: a million spacings", is_refused(1e6, 1, "a million spacings"));
    check_true("limit: no end", is_refused(1e300, 1e-300, "a million spacings"));
    check_true("limit: lines", is_refused(1000, 1, "lattice lines"));
}

/* --- any bytes --- */

/* Files with some bytes changed, added or cut must be read or refused; no more is asked. */
static void test_mutations(void)
{
    static char original[4000];
    struct random random = {11};
    long read = 0, closed = 0, placed = 0;
    enum { TRIES = 20000 };
    for (int i = 0; i < TRIES; i++) {
        set_box();
        size_t size = i % 2 ? write_binary(&mesh) : write_text(&mesh);
        size = size < sizeof original ? size : sizeof original;
        memcpy(original, bytes, size);
        for (int change = random_below(&random, 4); change >= 0; change--) {
            size_t at = (size_t)random_below(&random, (int)size), other = (size_t)random_below(&random, (int)size);
            int what = random_below(&random, 5);
            if (what == 0)
                original[at] = (char)random_bits(&random);
            else if (what == 1)
                original[at] = (char)(original[at] ^ 1 << random_below(&random, 8));
            else if (what == 2)
                original[at] = original[other];
            else if (what == 3)
                memmove(original + at, original + other, size - (at > other ? at : other));
            else if (random_below(&random, 4) == 0)
                size = at + 1;
        }
        char *exact = malloc(size); /* so that sanitizers see a step beyond */
        struct stl stl;
        struct stl_gap gap;
        char fault[STL_FAULT];
        const char *why;
        struct crossings_placement placement = {.scale = 1, .spacing = 0.5};
        if (!exact)
            exit(4);
        memcpy(exact, original, size);
        if (stl_read(&stl, exact, size, fault)) {
            read++;
            if (stl_is_closed(&stl, &gap)) {
                struct crossings *crossings = crossings_open(&stl, &placement, &why);
                closed++;
                placed += crossings != NULL;
                crossings_close(crossings);
            }
            stl_close(&stl);
        }
        free(exact);
    }
    printf("   of %d: %ld read, %ld closed, %ld placed\n", TRIES, read, closed, placed);
    check_true("changed files are read or refused", read > 1000 && closed > 500 && placed > 500 && read < TRIES);
}

int main(void)
{
    test_boxes();
    test_slanted();
    test_balls();
    test_arch();
    test_shells();
    test_wrong_files();
    test_gaps();
    test_degenerate();
    test_limits();
    test_mutations();
    return check_result();
}
