/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Background grid: extents, cell size, boundary codes. */
#include "deck/reader.h"

#include <limits.h>
#include <math.h>
#include <stddef.h>

#define LENGTH(name) {name, "length", ARGUMENT_REAL, LIMIT_NONE}
#define CODE(name) {name, NULL, ARGUMENT_INTEGER, LIMIT_BOUNDARY}

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
    {.name = "grid",
     .arguments = (const struct argument[]){LENGTH("x0"), LENGTH("x1"), LENGTH("y0"), LENGTH("y1"), LENGTH("z0"),
                                            LENGTH("z1"), {0}},
     .field = offsetof(struct scene, grid), .apply = read_grid, .doc = "extents of the grid"},
    {.name = "spx", .arguments = (const struct argument[]){LENGTH("x0"), LENGTH("x1"), {0}},
     .field = offsetof(struct scene, grid), .apply = read_span_x, .doc = "extent of the grid along x"},
    {.name = "spy", .arguments = (const struct argument[]){LENGTH("y0"), LENGTH("y1"), {0}},
     .field = offsetof(struct scene, grid[2]), .apply = read_span_y, .doc = "extent of the grid along y"},
    {.name = "spz", .arguments = (const struct argument[]){LENGTH("z0"), LENGTH("z1"), {0}},
     .field = offsetof(struct scene, grid[4]), .apply = read_span_z, .doc = "extent of the grid along z"},
    {.name = "dcel", .long_name = "dcell",
     .arguments = (const struct argument[]){{"size", "length", ARGUMENT_REAL, LIMIT_POSITIVE}, {0}},
     .field = offsetof(struct scene, cell_size),
     .doc = "cell size; before mate, else the nodal mass cutoff is zero"},
    {.name = "fixe", .long_name = "fixed",
     .arguments = (const struct argument[]){CODE("x-"), CODE("x+"), CODE("y-"), CODE("y+"), CODE("z-"), CODE("z+"), {0}},
     .field = offsetof(struct scene, boundary),
     .doc = "boundary codes of the six faces: 0 free, 1 fixed, 2 normal component fixed"},
    {0}};

/* Checks the extent and number of cells along one axis. */
static void check_span(struct reader *reader, int axis)
{
    const struct scene *scene = reader->scene;
    const struct deck_place place = reader->span_place[axis];
    double low = scene->grid[2 * axis], high = scene->grid[2 * axis + 1];
    double cells = trunc((high - low) / scene->cell_size + 0.5);
    if (place.line == 0) /* not read: its mistake is reported */
        return;
    if (!(high > low))
        diagnostics_error(reader->diagnostics, place, "the grid has no extent along %c: it goes from %g to %g",
                          "xyz"[axis], low, high);
    else if (scene->cell_size > 0 && !(cells >= 1 && cells < INT_MAX - 8))
        diagnostics_error(reader->diagnostics, place, "the grid has %g cells of size %g along %c; expected 1 to %d",
                          cells, scene->cell_size, "xyz"[axis], INT_MAX - 9);
}

void reader_finish_grid(struct reader *reader, struct deck_place end)
{
    static const char *const spans[] = {"spx", "spy", "spz"};
    bool has_grid = reader_was_given(reader, "grid");
    int given = 0;
    if (!reader_was_given(reader, "dcel"))
        diagnostics_error(reader->diagnostics, end, "the cell size is not given; expected 'dcel'");
    for (int a = 0; a < 3; a++)
        given += has_grid || reader_was_given(reader, spans[a]);
    if (given == 0)
        diagnostics_error(reader->diagnostics, end, "the extents of the grid are not given; expected 'grid'");
    for (int a = 0; a < 3; a++)
        if (given > 0 && !has_grid && !reader_was_given(reader, spans[a]))
            diagnostics_error(reader->diagnostics, end, "the extent of the grid along %c is not given; expected '%s'",
                              "xyz"[a], spans[a]);
        else
            check_span(reader, a);
}
