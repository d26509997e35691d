/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "particles/generate.h"
#include "base/memory.h"
#include "particles/solid.h"

#include <math.h>
#include <strings.h>

#define MATERIAL {"material", NULL, ARGUMENT_INTEGER, LIMIT_COUNT}
#define DENSITY {"density", "mass/length^3", ARGUMENT_REAL, LIMIT_POSITIVE}
#define SPACING {"spacing", "length", ARGUMENT_REAL, LIMIT_POSITIVE}
#define LENGTH(name) {name, "length", ARGUMENT_REAL, LIMIT_NONE}
#define COUNT(name) {name, NULL, ARGUMENT_INTEGER, LIMIT_COUNT}

static double lattice_mass(const struct generator *g)
{
    return g->density * g->spacing * g->spacing * g->spacing;
}

/* A lattice row of points i = first ... last at base + (i - 1/2) spacing. */
struct lattice_row {
    double base, spacing;
    long first, last;
};

static double row_distance(const struct lattice_row *row, double centre, long i)
{
    double position = row->base + ((double)i - 0.5) * row->spacing;
    return position - centre;
}

static bool row_inside(const struct lattice_row *row, double centre, long i, double rest, double radius)
{
    double distance = row_distance(row, centre, i);
    return rest + distance * distance < radius * radius;
}

/* The first i from low on, at most high, whose inside is `wanted`; inside changes once between. */
static long row_change(const struct lattice_row *row, double centre, long low, long high, double rest, double radius,
                       bool wanted)
{
    while (low < high) {
        long middle = low + (high - low) / 2;
        if (row_inside(row, centre, middle, rest, radius) == wanted)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

/* Points of a row that are nearer to the centre than radius, `rest` being the square of their
 * distance in the other directions. They are neighbours, and round-off keeps the order of the
 * distances, so that bisection finds exactly those that going through all would find. */
static long row_count(const struct lattice_row *row, double centre, double rest, double radius)
{
    long low = row->first, high = row->last + 1;
    while (low < high) { /* the first point not left of the centre */
        long middle = low + (high - low) / 2;
        if (row_distance(row, centre, middle) >= 0)
            high = middle;
        else
            low = middle + 1;
    }
    long from = row_change(row, centre, row->first, low, rest, radius, true);
    long to = row_change(row, centre, low, row->last + 1, rest, radius, false);
    return to - from;
}

/* --- poin: points given one by one --- */

static double point_candidates(const struct generator *g)
{
    return (double)g->n_points;
}

static void point_visit(const struct generator *g, generator_visit *visit, void *context)
{
    for (long i = 0; i < g->n_points; i++)
        visit(context, g->points[i].position, g->points[i].mass);
}

/* --- bloc, blod: a block, x fastest; blod leaves out a round hole along z --- */

enum { BLOCK_ORIGIN = 0, BLOCK_NUMBERS = 3, HOLE_CENTRE = 6, HOLE_RADIUS = 9 };

static double block_candidates(const struct generator *g)
{
    return g->number[BLOCK_NUMBERS] * g->number[BLOCK_NUMBERS + 1] * g->number[BLOCK_NUMBERS + 2];
}

static bool in_hole(const struct generator *g, double x, double y)
{
    double dx = x - g->number[HOLE_CENTRE], dy = y - g->number[HOLE_CENTRE + 1];
    double radius = g->number[HOLE_RADIUS] * g->spacing;
    return dx * dx + dy * dy < radius * radius;
}

static void visit_block(const struct generator *g, bool has_hole, generator_visit *visit, void *context)
{
    const double *origin = &g->number[BLOCK_ORIGIN], *numbers = &g->number[BLOCK_NUMBERS];
    for (long k = 1; k <= (long)numbers[2]; k++)
        for (long j = 1; j <= (long)numbers[1]; j++)
            for (long i = 1; i <= (long)numbers[0]; i++) {
                double position[3] = {origin[0] + ((double)i - 0.5) * g->spacing,
                                      origin[1] + ((double)j - 0.5) * g->spacing,
                                      origin[2] + ((double)k - 0.5) * g->spacing};
                if (!has_hole || !in_hole(g, position[0], position[1]))
                    visit(context, position, lattice_mass(g));
            }
}

/* Counts along the longer side, row by row along the shorter one. */
static long holed_block_count(const struct generator *g)
{
    const double *origin = &g->number[BLOCK_ORIGIN], *numbers = &g->number[BLOCK_NUMBERS];
    const double *centre = &g->number[HOLE_CENTRE];
    int along = numbers[1] > numbers[0], across = 1 - along;
    struct lattice_row row = {origin[along], g->spacing, 1, (long)numbers[along]};
    struct lattice_row rows = {origin[across], g->spacing, 1, (long)numbers[across]};
    long in_layer = 0;
    for (long j = rows.first; j <= rows.last; j++) {
        double distance = row_distance(&rows, centre[across], j);
        in_layer += row.last - row_count(&row, centre[along], distance * distance, g->number[HOLE_RADIUS] * g->spacing);
    }
    return in_layer * (long)numbers[2];
}

static void block_visit(const struct generator *g, generator_visit *visit, void *context)
{
    visit_block(g, false, visit, context);
}

static void holed_block_visit(const struct generator *g, generator_visit *visit, void *context)
{
    visit_block(g, true, visit, context);
}

/* --- sphe: a sphere, x slowest --- */

enum { SPHERE_CENTRE = 0, SPHERE_RADIUS = 3 };

static double sphere_candidates(const struct generator *g)
{
    double n = 2 * trunc(g->number[SPHERE_RADIUS]);
    return n * n * n;
}

static long sphere_count(const struct generator *g)
{
    long n = (long)g->number[SPHERE_RADIUS], count = 0;
    double radius = (double)n * g->spacing;
    const double *centre = &g->number[SPHERE_CENTRE];
    const struct lattice_row x = {centre[0], g->spacing, 1 - n, n}, y = {centre[1], g->spacing, 1 - n, n},
                             z = {centre[2], g->spacing, 1 - n, n};
    for (long i = 1 - n; i <= n; i++)
        for (long j = 1 - n; j <= n; j++) {
            double dx = row_distance(&x, centre[0], i), dy = row_distance(&y, centre[1], j);
            count += row_count(&z, centre[2], dx * dx + dy * dy, radius);
        }
    return count;
}

static void sphere_visit(const struct generator *g, generator_visit *visit, void *context)
{
    long n = (long)g->number[SPHERE_RADIUS];
    double radius = (double)n * g->spacing;
    const double *centre = &g->number[SPHERE_CENTRE];
    for (long i = 1 - n; i <= n; i++)
        for (long j = 1 - n; j <= n; j++)
            for (long k = 1 - n; k <= n; k++) {
                double position[3] = {centre[0] + ((double)i - 0.5) * g->spacing,
                                      centre[1] + ((double)j - 0.5) * g->spacing,
                                      centre[2] + ((double)k - 0.5) * g->spacing};
                double dx = position[0] - centre[0], dy = position[1] - centre[1], dz = position[2] - centre[2];
                if (dx * dx + dy * dy + dz * dz < radius * radius)
                    visit(context, position, lattice_mass(g));
            }
}

/* --- cicl: a disc one layer thick, x slowest --- */

static double disc_candidates(const struct generator *g)
{
    return 4 * g->number[SPHERE_RADIUS] * g->number[SPHERE_RADIUS];
}

static long disc_count(const struct generator *g)
{
    long n = (long)g->number[SPHERE_RADIUS], count = 0;
    const double *centre = &g->number[SPHERE_CENTRE];
    const struct lattice_row x = {centre[0], g->spacing, 1 - n, n}, y = {centre[1], g->spacing, 1 - n, n};
    for (long i = 1 - n; i <= n; i++) {
        double dx = row_distance(&x, centre[0], i);
        count += row_count(&y, centre[1], dx * dx, (double)n * g->spacing);
    }
    return count;
}

static void disc_visit(const struct generator *g, generator_visit *visit, void *context)
{
    long n = (long)g->number[SPHERE_RADIUS];
    double radius = (double)n * g->spacing;
    const double *centre = &g->number[SPHERE_CENTRE];
    for (long i = 1 - n; i <= n; i++)
        for (long j = 1 - n; j <= n; j++) {
            double position[3] = {centre[0] + ((double)i - 0.5) * g->spacing,
                                  centre[1] + ((double)j - 0.5) * g->spacing, centre[2] + 0.5 * g->spacing};
            double dx = position[0] - centre[0], dy = position[1] - centre[1];
            if (dx * dx + dy * dy < radius * radius)
                visit(context, position, lattice_mass(g));
        }
}

/* --- cyli: a cylinder along x, y or z; axis slowest, then the second of the other axes --- */

enum { CYLINDER_AXIS = 0, CYLINDER_BASE = 1, CYLINDER_RADIUS = 4, CYLINDER_HEIGHT = 5 };

/* Lattice points across half the width, and along the height; a point whose centre lies on the
 * end face (round-off apart) is not in. */
static void cylinder_numbers(const struct generator *g, double *across, double *along)
{
    *across = ceil(g->number[CYLINDER_RADIUS] / g->spacing);
    *along = floor(g->number[CYLINDER_HEIGHT] / g->spacing + 0.5 - 1e-9);
    if (*along < 1) /* no layer: however wide it is */
        *across = *along = 0;
}

static double cylinder_candidates(const struct generator *g)
{
    double across, along;
    cylinder_numbers(g, &across, &along);
    return 4 * across * across * along;
}

static long cylinder_count(const struct generator *g)
{
    double across, along;
    cylinder_numbers(g, &across, &along);
    long n = (long)across, in_layer = 0;
    const struct lattice_row row = {0, g->spacing, 1 - n, n};
    for (long j = 1 - n; j <= n; j++) {
        double dv = row_distance(&row, 0, j);
        in_layer += row_count(&row, 0, dv * dv, g->number[CYLINDER_RADIUS]);
    }
    return in_layer * (long)along;
}

static void cylinder_visit(const struct generator *g, generator_visit *visit, void *context)
{
    double across, along;
    cylinder_numbers(g, &across, &along);
    const double *base = &g->number[CYLINDER_BASE];
    double radius = g->number[CYLINDER_RADIUS];
    int axis = (int)g->number[CYLINDER_AXIS], first = (axis + 1) % 3, second = (axis + 2) % 3;
    long n = (long)across;
    for (long k = 1; k <= (long)along; k++)
        for (long j = 1 - n; j <= n; j++)
            for (long i = 1 - n; i <= n; i++) {
                double du = ((double)i - 0.5) * g->spacing, dv = ((double)j - 0.5) * g->spacing;
                if (du * du + dv * dv >= radius * radius)
                    continue;
                double position[3];
                position[axis] = base[axis] + ((double)k - 0.5) * g->spacing;
                position[first] = base[first] + du;
                position[second] = base[second] + dv;
                visit(context, position, lattice_mass(g));
            }
}

/* --- soli: shapes joined and cut, x fastest --- */

enum { SOLID_ORIGIN = 0 };

static double solid_points(const struct generator *g)
{
    return solid_candidates(g->solid);
}

static long solid_number(const struct generator *g)
{
    return solid_count(g->solid);
}

/* What a line of a solid's points is given to. */
struct line_context {
    const struct generator *generator;
    generator_visit *visit;
    void *context;
};

static void visit_line(void *context, const struct solid_line *line)
{
    const struct line_context *to = context;
    const struct generator *g = to->generator;
    const double *origin = &g->number[SOLID_ORIGIN];
    for (long n = 0; n < line->count; n++) {
        if (!line->inside[n])
            continue;
        double position[3] = {origin[0] + ((double)(line->i + n) + 0.5) * g->spacing,
                              origin[1] + ((double)line->j + 0.5) * g->spacing,
                              origin[2] + ((double)line->k + 0.5) * g->spacing};
        to->visit(to->context, position, lattice_mass(g));
    }
}

static void visit_solid(const struct generator *g, generator_visit *visit, void *context)
{
    struct line_context to = {g, visit, context};
    solid_visit(g->solid, visit_line, &to);
}

static const struct generator_row rows[] = {
    {"poin", "point", "points one by one: n times `id material mass x y z`", NULL, point_candidates, 1, NULL, point_visit},
    {"bloc", "block", "block of nx x ny x nz points from its corner, x fastest",
     (const struct argument[]){MATERIAL, DENSITY, SPACING, LENGTH("x0"), LENGTH("y0"), LENGTH("z0"), COUNT("nx"),
                               COUNT("ny"), COUNT("nz"), {0}},
     block_candidates, 1, NULL, block_visit},
    {"sphe", "sphere", "sphere of nr points in the radius about its centre, x slowest",
     (const struct argument[]){MATERIAL, DENSITY, SPACING, LENGTH("xc"), LENGTH("yc"), LENGTH("zc"),
                               {"nr", NULL, ARGUMENT_REAL, LIMIT_AT_LEAST_ONE}, {0}},
     sphere_candidates, 4, sphere_count, sphere_visit},
    {"blod", "blod", "block with a round hole along z of nr points in the radius, x fastest",
     (const struct argument[]){MATERIAL, DENSITY, SPACING, LENGTH("x0"), LENGTH("y0"), LENGTH("z0"), COUNT("nx"),
                               COUNT("ny"), COUNT("nz"), LENGTH("xh"), LENGTH("yh"), LENGTH("zh"), COUNT("nr"), {0}},
     block_candidates, 64, holed_block_count, holed_block_visit},
    {"cicl", "cicl", "disc one layer thick, nr points in the radius, x slowest",
     (const struct argument[]){MATERIAL, DENSITY, SPACING, LENGTH("xc"), LENGTH("yc"), LENGTH("z0"), COUNT("nr"), {0}},
     disc_candidates, 4, disc_count, disc_visit},
    {"cyli", "cylinder", "cylinder along axis (1 x, 2 y, 3 z, or the letter) from the centre of its base, axis slowest",
     (const struct argument[]){MATERIAL, DENSITY, SPACING, {"axis", NULL, ARGUMENT_WORD, LIMIT_NONE}, LENGTH("xb"),
                               LENGTH("yb"), LENGTH("zb"), {"radius", "length", ARGUMENT_REAL, LIMIT_POSITIVE},
                               {"height", "length", ARGUMENT_REAL, LIMIT_POSITIVE}, {0}},
     cylinder_candidates, 4, cylinder_count, cylinder_visit},
    {"soli", "solid", "block of shapes joined, cut away or kept, up to endp, on the lattice with a corner (not a point) at "
                      "x0, y0, z0; x fastest",
     (const struct argument[]){MATERIAL, DENSITY, SPACING, LENGTH("x0"), LENGTH("y0"), LENGTH("z0"), {0}},
     solid_points, 1000, solid_number, visit_solid},
};

const struct generator_row *generator_rows(int *count)
{
    *count = sizeof rows / sizeof rows[0];
    return rows;
}

const struct generator_row *generator_find(const char *name)
{
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (strncasecmp(name, rows[i].name, 4) == 0)
            return &rows[i];
    return NULL;
}

long generator_count(const struct generator *generator)
{
    const struct generator_row *row = generator->row;
    return row->count ? row->count(generator) : (long)row->candidates(generator);
}

void generator_close(struct generator *generator)
{
    memory_free(generator->points);
    solid_close(generator->solid);
    generator->points = NULL;
    generator->solid = NULL;
}
