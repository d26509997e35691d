/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Background grid: extents, cell size, boundary codes. */
#include "deck/reader.h"

#include <limits.h>
#include <math.h>
#include <stddef.h>

#define LENGTH(name) {name, "length", ARGUMENT_REAL, LIMIT_NONE}
#define CODE(name) {name, NULL, ARGUMENT_INTEGER, LIMIT_BOUNDARY}

const struct keyword grid_keywords[] = {
    {.name = "grid",
     .arguments = (const struct argument[]){LENGTH("x0"), LENGTH("x1"), LENGTH("y0"), LENGTH("y1"), LENGTH("z0"),
                                            LENGTH("z1"), {0}},
     .field = offsetof(struct scene, grid), .doc = "extents of the grid"},
    {.name = "spx", .arguments = (const struct argument[]){LENGTH("x0"), LENGTH("x1"), {0}},
     .field = offsetof(struct scene, grid), .doc = "extent of the grid along x"},
    {.name = "spy", .arguments = (const struct argument[]){LENGTH("y0"), LENGTH("y1"), {0}},
     .field = offsetof(struct scene, grid[2]), .doc = "extent of the grid along y"},
    {.name = "spz", .arguments = (const struct argument[]){LENGTH("z0"), LENGTH("z1"), {0}},
     .field = offsetof(struct scene, grid[4]), .doc = "extent of the grid along z"},
    {.name = "dcel", .long_name = "dcell",
     .arguments = (const struct argument[]){{"size", "length", ARGUMENT_REAL, LIMIT_POSITIVE}, {0}},
     .field = offsetof(struct scene, cell_size),
     .doc = "cell size; before mate, else the nodal mass cutoff is zero"},
    {.name = "fixe", .long_name = "fixed",
     .arguments = (const struct argument[]){CODE("x-"), CODE("x+"), CODE("y-"), CODE("y+"), CODE("z-"), CODE("z+"), {0}},
     .field = offsetof(struct scene, boundary),
     .doc = "boundary codes of the six faces: 0 free, 1 fixed, 2 normal component fixed"},
    {0}};

void reader_finish_grid(struct reader *reader, struct deck_place end)
{
    const struct scene *scene = reader->scene;
    if (scene->cell_size <= 0) {
        diagnostics_error(reader->diagnostics, end, "the cell size is not given; expected 'dcel'");
        return;
    }
    for (int a = 0; a < 3; a++) {
        double span = scene->grid[2 * a + 1] - scene->grid[2 * a];
        double cells = trunc(span / scene->cell_size + 0.5);
        if (!(span > 0))
            diagnostics_error(reader->diagnostics, end, "the grid has no extent along %c; expected 'sp%c low high'",
                              "xyz"[a], "xyz"[a]);
        else if (!(cells >= 1 && cells < INT_MAX - 8))
            diagnostics_error(reader->diagnostics, end, "the grid has %g cells along %c; expected 1 to %d", cells,
                              "xyz"[a], INT_MAX - 9);
    }
}
