/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Background grid: extents, cell size, boundary codes. */
#include "deck/commands_process.h"

#include <limits.h>
#include <math.h>
#include <stddef.h>

#define LENGTH(name) {name, "length", ARGUMENT_REAL, LIMIT_NONE}
#define CODE(name) {name, NULL, ARGUMENT_INTEGER, LIMIT_BOUNDARY}

static void read_cell_size(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    reader->cell_place = values[0].word.place;
}

static void read_grid(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    for (int a = 0; a < 3; a++)
        reader->span_place[a] = values[2 * a].word.place;
}

static void read_span_x(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    reader->span_place[0] = values[0].word.place;
}

static void read_span_y(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    reader->span_place[1] = values[0].word.place;
}

static void read_span_z(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    reader->span_place[2] = values[0].word.place;
}

const struct keyword grid_keywords[] = {
    {.name = "grid", .methods = METHODS_PARTICLES,
     .arguments = (const struct argument[]){LENGTH("x0"), LENGTH("x1"), LENGTH("y0"), LENGTH("y1"), LENGTH("z0"),
                                            LENGTH("z1"), {0}},
     .field = offsetof(struct scene, grid), .apply = read_grid, .doc = "extents of the grid; with meth sph of the room for particles"},
    {.name = "spx", .methods = METHODS_PARTICLES, .arguments = (const struct argument[]){LENGTH("x0"), LENGTH("x1"), {0}},
     .field = offsetof(struct scene, grid), .apply = read_span_x, .doc = "extent of the grid along x"},
    {.name = "spy", .methods = METHODS_PARTICLES, .arguments = (const struct argument[]){LENGTH("y0"), LENGTH("y1"), {0}},
     .field = offsetof(struct scene, grid[2]), .apply = read_span_y, .doc = "extent of the grid along y"},
    {.name = "spz", .methods = METHODS_PARTICLES, .arguments = (const struct argument[]){LENGTH("z0"), LENGTH("z1"), {0}},
     .field = offsetof(struct scene, grid[4]), .apply = read_span_z, .doc = "extent of the grid along z"},
    {.name = "dcel", .methods = METHODS_MPM, .long_name = "dcell",
     .arguments = (const struct argument[]){{"size", "length", ARGUMENT_REAL, LIMIT_POSITIVE}, {0}},
     .field = offsetof(struct scene, cell_size), .apply = read_cell_size,
     .doc = "cell size; before mate, else the nodal mass cutoff is zero"},
    {.name = "fixe", .methods = METHODS_MPM, .long_name = "fixed",
     .arguments = (const struct argument[]){CODE("x-"), CODE("x+"), CODE("y-"), CODE("y+"), CODE("z-"), CODE("z+"), {0}},
     .field = offsetof(struct scene, boundary),
     .doc = "boundary codes of the six faces: 0 free, 1 fixed, 2 normal component fixed"},
    {.name = "fixn", .methods = METHODS_MPM, .apply = reader_hold,
     .doc = "holds grid nodes in a box along x, y, z (1 held, 0 free), or with `fixn cyli` in an annulus",
     .details = "fixn x0 x1 y0 y1 z0 z1 ix iy iz\nfixn cyli axis a b r0 r1 ix iy iz   (a b: the axis in the other two coordinates, in the "
                "order x y z)\nBoth limits count in."},
    {0}};

static double cells_along(const struct scene *scene, int axis)
{
    return trunc((scene->grid[2 * axis + 1] - scene->grid[2 * axis]) / scene->cell_size + 0.5);
}

/* Checks the extent along one axis, where it was read. */
static bool check_span(struct reader *reader, int axis)
{
    double low = reader->scene->grid[2 * axis], high = reader->scene->grid[2 * axis + 1];
    if (reader->span_place[axis].line == 0)
        return false;
    if (high > low)
        return true;
    diagnostics_error(reader->diagnostics, reader->span_place[axis],
                      "the grid has no extent along %c: it goes from %g to %g", "xyz"[axis], low, high);
    return false;
}

/* Checks the number of cells. Where it is wrong along all axes, the cell size is to blame. */
static void check_cells(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    bool good[3];
    for (int a = 0; a < 3; a++)
        good[a] = cells_along(scene, a) >= 1 && cells_along(scene, a) < INT_MAX - 8;
    bool all_wrong = !good[0] && !good[1] && !good[2];
    for (int a = 0; a < (all_wrong ? 1 : 3); a++)
        if (!good[a])
            diagnostics_error(reader->diagnostics, all_wrong ? reader->cell_place : reader->span_place[a],
                              "the grid has %g cells of size %g along %c; expected 1 to %d", cells_along(scene, a),
                              scene->cell_size, "xyz"[a], INT_MAX - 9);
}

/* Reports each axis without an extent, or all at once. */
static bool check_given(struct reader *reader, struct deck_place end)
{
    static const char *const names[] = {"spx", "spy", "spz"};
    int given = 0;
    if (reader_was_given(reader, "grid"))
        return true;
    for (int a = 0; a < 3; a++)
        given += reader_was_given(reader, names[a]);
    if (given == 0)
        diagnostics_lack(reader->diagnostics, end, "the extents of the grid are not given; expected 'grid'");
    for (int a = 0; a < 3; a++)
        if (given > 0 && !reader_was_given(reader, names[a]))
            diagnostics_lack(reader->diagnostics, end, "the extent of the grid along %c is not given; expected '%s'",
                             "xyz"[a], names[a]);
    return given == 3;
}

void reader_finish_grid(struct reader *reader, struct deck_place end)
{
    const bool has_cells = reader->scene->method == METHOD_MPM;
    if (has_cells && !reader_was_given(reader, "dcel"))
        diagnostics_lack(reader->diagnostics, end, "the cell size is not given; expected 'dcel'");
    bool good = check_given(reader, end);
    for (int a = 0; a < 3; a++)
        good = check_span(reader, a) && good;
    if (good && has_cells && reader->cell_place.line > 0)
        check_cells(reader);
}
