/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "particles/solid.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>
#include <strings.h>

/* Nearer than this to a surface a point is on it. Coordinates of a million spacings at most have
 * round-off of less than half of it. */
static const double MARGIN = 1e-9;
static const double PI = 3.14159265358979323846;

/* --- shapes --- */

static double in_spacings(double place, int axis, const double origin[3], double spacing)
{
    return (place - origin[axis]) / spacing;
}

static const char *place_box(struct solid_step *step, const double origin[3], double spacing)
{
    for (int a = 0; a < 3; a++) {
        if (!(step->number[2 * a] < step->number[2 * a + 1]))
            return "has a lower end that is not below its upper end";
        step->low[a] = in_spacings(step->number[2 * a], a, origin, spacing);
        step->high[a] = in_spacings(step->number[2 * a + 1], a, origin, spacing);
    }
    return NULL;
}

static void place_round(struct solid_step *step, int axis, double centre, const double origin[3], double spacing)
{
    step->is_round[axis] = true;
    step->centre[axis] = in_spacings(centre, axis, origin, spacing);
    step->low[axis] = step->centre[axis] - step->radius;
    step->high[axis] = step->centre[axis] + step->radius;
}

static const char *place_sphere(struct solid_step *step, const double origin[3], double spacing)
{
    step->radius = step->number[3] / spacing;
    for (int a = 0; a < 3; a++)
        place_round(step, a, step->number[a], origin, spacing);
    return NULL;
}

static const char *place_cylinder(struct solid_step *step, const double origin[3], double spacing)
{
    int axis = (int)step->number[0], first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;
    if (!(step->number[4] < step->number[5]))
        return "has a lower end that is not below its upper end";
    step->radius = step->number[3] / spacing;
    place_round(step, first, step->number[1], origin, spacing);
    place_round(step, second, step->number[2], origin, spacing);
    step->low[axis] = in_spacings(step->number[4], axis, origin, spacing);
    step->high[axis] = in_spacings(step->number[5], axis, origin, spacing);
    return NULL;
}

static const char *place_arch(struct solid_step *step, const double origin[3], double spacing)
{
    const double *n = step->number;
    if (!(n[0] < n[1]) || !(n[4] < n[5]))
        return "has a lower end that is not below its upper end";
    if (n[3] == 0)
        return "has no height";
    step->is_arch = true;
    step->foot = in_spacings(n[2], 1, origin, spacing);
    step->rise = n[3] / spacing;
    step->low[0] = in_spacings(n[0], 0, origin, spacing);
    step->high[0] = in_spacings(n[1], 0, origin, spacing);
    step->low[1] = step->foot + fmin(step->rise, 0);
    step->high[1] = step->foot + fmax(step->rise, 0);
    step->low[2] = in_spacings(n[4], 2, origin, spacing);
    step->high[2] = in_spacings(n[5], 2, origin, spacing);
    return NULL;
}

#define LENGTH(name) {name, "length", ARGUMENT_REAL, LIMIT_NONE}
#define RADIUS {"radius", "length", ARGUMENT_REAL, LIMIT_POSITIVE}

static const struct solid_shape shapes[] = {
    {"box", "box", "block between planes",
     (const struct argument[]){LENGTH("x0"), LENGTH("x1"), LENGTH("y0"), LENGTH("y1"), LENGTH("z0"), LENGTH("z1"), {0}},
     place_box},
    {"cyli", "cylinder", "cylinder along axis (x, y or z) about the line at a, b of the two other coordinates, x before y "
                         "before z, from lo to hi on the axis",
     (const struct argument[]){{"axis", NULL, ARGUMENT_WORD, LIMIT_NONE}, LENGTH("a"), LENGTH("b"), RADIUS, LENGTH("lo"),
                               LENGTH("hi"), {0}},
     place_cylinder},
    {"sphe", "sphere", "sphere about its centre",
     (const struct argument[]){LENGTH("xc"), LENGTH("yc"), LENGTH("zc"), RADIUS, {0}}, place_sphere},
    {"arch", "arch", "between the line y = foot and half a sine wave over it from x0 to x1, its top height above it, or below "
                     "it with a height less than 0; from z0 to z1",
     (const struct argument[]){LENGTH("x0"), LENGTH("x1"), LENGTH("foot"), LENGTH("height"), LENGTH("z0"), LENGTH("z1"), {0}},
     place_arch},
    {"stl", "stl", "closed surface of triangles from a file, text or binary; its path is seen from this deck's folder, in "
                   "quotes if it has blanks; scale and move may follow on the line",
     (const struct argument[]){{"file", NULL, ARGUMENT_WORD, LIMIT_NONE}, {0}}, NULL},
};

const struct solid_shape *solid_shapes(int *count)
{
    *count = sizeof shapes / sizeof shapes[0];
    return shapes;
}

const struct solid_shape *solid_shape_find(const char *name)
{
    for (size_t i = 0; i < sizeof shapes / sizeof shapes[0]; i++)
        if (strncasecmp(name, shapes[i].name, 4) == 0)
            return &shapes[i];
    return NULL;
}

/* --- steps --- */

struct solid *solid_open(const double origin[3], double spacing)
{
    struct solid *solid = memory_array(1, sizeof *solid, "a solid");
    memcpy(solid->origin, origin, sizeof solid->origin);
    solid->spacing = spacing;
    return solid;
}

static void free_step(struct solid_step *step)
{
    crossings_close(step->crossings);
    memory_free(step->file);
}

void solid_close(struct solid *solid)
{
    if (!solid)
        return;
    for (size_t s = 0; s < solid->n_steps; s++)
        free_step(&solid->steps[s]);
    memory_free(solid->steps);
    memory_free(solid);
}

static bool is_empty(const long from[3], const long to[3])
{
    return from[0] >= to[0] || from[1] >= to[1] || from[2] >= to[2];
}

/* The points that may be in the body after a step. */
static void extend(struct solid *solid, const struct solid_step *step)
{
    bool was_empty = is_empty(solid->from, solid->to);
    if (step->operation == SOLID_CUT || (step->operation == SOLID_ADD && is_empty(step->from, step->to)))
        return;
    for (int a = 0; a < 3; a++) {
        bool is_lower = step->from[a] < solid->from[a], is_higher = step->to[a] > solid->to[a];
        bool is_union = step->operation == SOLID_ADD;
        if ((is_union && was_empty) || is_union == is_lower)
            solid->from[a] = step->from[a];
        if ((is_union && was_empty) || is_union == is_higher)
            solid->to[a] = step->to[a];
    }
}

/* Fills in extents and points of a step. */
static const char *place_step(const struct solid *solid, struct solid_step *step)
{
    if (step->crossings) {
        memcpy(step->low, step->crossings->low, sizeof step->low);
        memcpy(step->high, step->crossings->high, sizeof step->high);
    } else {
        const char *fault = step->shape->place(step, solid->origin, solid->spacing);
        if (fault)
            return fault;
    }
    for (int a = 0; a < 3; a++) {
        if (!(step->low[a] >= -CROSSINGS_MOST_REACH && step->high[a] <= CROSSINGS_MOST_REACH))
            return "reaches more than a million spacings from the lattice's origin";
        step->from[a] = crossings_above(step->low[a] + MARGIN);
        step->to[a] = crossings_from(step->high[a] - MARGIN);
    }
    return NULL;
}

const char *solid_join(struct solid *solid, const struct solid_step *given)
{
    struct solid_step step = *given;
    const char *fault = place_step(solid, &step);
    if (fault) {
        free_step(&step);
        return fault;
    }
    solid->steps = memory_grow(solid->steps, &solid->capacity, solid->n_steps + 1, sizeof step, "a solid");
    solid->steps[solid->n_steps++] = step;
    extend(solid, &step);
    return NULL;
}

/* --- points --- */

double solid_candidates(const struct solid *solid)
{
    double count = 1;
    for (int a = 0; a < 3; a++)
        count *= solid->to[a] > solid->from[a] ? (double)(solid->to[a] - solid->from[a]) : 0;
    return count;
}

const char *solid_fault(const struct solid *solid)
{
    double points = solid_candidates(solid);
    if (points > 1e9)
        return "the lattice about this body has more than a billion points; expected a larger spacing";
    if (points > 0 && points / (double)(solid->to[0] - solid->from[0]) * (double)solid->n_steps > 3e7)
        return "the lattice about this body has too many lines for so many steps; expected a larger spacing";
    return NULL;
}

/* The points of line (j, k) that are inside an arch: there the wave is farther from its foot than the line is. */
static struct crossings_run arch_run(const struct solid_step *step, long j)
{
    const double part = ((double)j + 0.5 - step->foot) / step->rise, width = step->high[0] - step->low[0];
    if (!(part < 1))
        return (struct crossings_run){0, 0};
    const double way = asin(fmax(part, 0)) / PI * width + MARGIN;
    return (struct crossings_run){(int32_t)crossings_above(step->low[0] + way), (int32_t)crossings_from(step->high[0] - way)};
}

/* The points of line (j, k) that are inside an arch, a round shape or a box. */
static struct crossings_run shape_run(const struct solid_step *step, long j, long k)
{
    const double place[3] = {0, (double)j + 0.5, (double)k + 0.5}, radius = step->radius - MARGIN;
    struct crossings_run run = {(int32_t)step->from[0], (int32_t)step->to[0]};
    const struct crossings_run none = {0, 0};
    if (step->is_arch)
        return arch_run(step, j);
    if (!step->is_round[1] && !step->is_round[2])
        return run;
    double rest = radius * radius;
    for (int a = 1; a < 3; a++)
        if (step->is_round[a])
            rest -= (place[a] - step->centre[a]) * (place[a] - step->centre[a]);
    if (!(radius > 0 && rest > 0))
        return none;
    if (step->is_round[0]) {
        double half = sqrt(rest);
        run.from = (int32_t)crossings_above(step->centre[0] - half);
        run.to = (int32_t)crossings_from(step->centre[0] + half);
    }
    return run;
}

/* The runs of a step on a line; their number goes to *count. `single` is room for one. */
static const struct crossings_run *step_runs(const struct solid_step *step, long j, long k,
                                             struct crossings_run *single, size_t *count)
{
    *count = 0;
    if (j < step->from[1] || j >= step->to[1] || k < step->from[2] || k >= step->to[2])
        return NULL;
    if (step->crossings)
        return crossings_runs(step->crossings, j, k, count);
    *single = shape_run(step, j, k);
    *count = single->from < single->to;
    return single;
}

/* Sets the points from ... to - 1 of a line. */
static void set_points(const struct solid *solid, char *inside, long from, long to, bool is_in)
{
    if (from < solid->from[0])
        from = solid->from[0];
    if (to > solid->to[0])
        to = solid->to[0];
    if (from < to)
        memset(inside + (from - solid->from[0]), is_in, (size_t)(to - from));
}

static void do_step(const struct solid *solid, const struct solid_step *step, long j, long k, char *inside)
{
    struct crossings_run single;
    size_t count;
    const struct crossings_run *runs = step_runs(step, j, k, &single, &count);
    long gap = solid->from[0];
    for (size_t r = 0; r < count; r++) {
        if (step->operation == SOLID_KEEP)
            set_points(solid, inside, gap, runs[r].from, false);
        else
            set_points(solid, inside, runs[r].from, runs[r].to, step->operation == SOLID_ADD);
        gap = runs[r].to;
    }
    if (step->operation == SOLID_KEEP)
        set_points(solid, inside, gap, solid->to[0], false);
}

void solid_visit(const struct solid *solid, solid_visit_line *visit, void *context)
{
    if (is_empty(solid->from, solid->to))
        return;
    size_t width = (size_t)(solid->to[0] - solid->from[0]);
    char *inside = memory_array(width, 1, "a line of points");
    for (long k = solid->from[2]; k < solid->to[2]; k++)
        for (long j = solid->from[1]; j < solid->to[1]; j++) {
            memset(inside, 0, width);
            for (size_t s = 0; s < solid->n_steps; s++)
                do_step(solid, &solid->steps[s], j, k, inside);
            visit(context, &(struct solid_line){solid->from[0], j, k, (long)width, inside});
        }
    memory_free(inside);
}

static void count_line(void *context, const struct solid_line *line)
{
    long *count = context;
    for (long n = 0; n < line->count; n++)
        *count += line->inside[n];
}

long solid_count(const struct solid *solid)
{
    long count = 0;
    solid_visit(solid, count_line, &count);
    return count;
}
