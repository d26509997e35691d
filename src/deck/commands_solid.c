/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The block of `part solid`: add, cut and keep, each with a shape. */
#define _XOPEN_SOURCE 700
#include "base/memory.h"
#include "deck/reader.h"
#include "particles/bed.h"
#include "particles/solid.h"

#include <stdlib.h>
#include <string.h>

/* Beds of more grains than this would not end. */
enum { MOST_GRAINS = 100000 };

static const char *nearest_shape(const char *word)
{
    const char *found = NULL;
    int best = KEYWORD_FAR, count;
    const struct solid_shape *rows = solid_shapes(&count);
    for (int i = 0; i < count; i++) {
        keyword_nearer(word, rows[i].name, &best, &found);
        keyword_nearer(word, rows[i].long_name, &best, &found);
    }
    return found;
}

/* --- surfaces --- */

static const struct argument scale_arguments[] = {{"factor", NULL, ARGUMENT_REAL, LIMIT_POSITIVE}, {0}};
static const struct argument move_arguments[] = {{"dx", "length", ARGUMENT_REAL, LIMIT_NONE},
                                                 {"dy", "length", ARGUMENT_REAL, LIMIT_NONE},
                                                 {"dz", "length", ARGUMENT_REAL, LIMIT_NONE}, {0}};

const struct keyword surface_keywords[] = {
    {.name = "scale", .arguments = scale_arguments, .doc = "coordinates of the file times this factor (1)"},
    {.name = "move", .arguments = move_arguments, .doc = "then moved by this (0 0 0)"},
    {0}};

/* The optional words behind the file. */
static bool read_surface_words(struct reader *reader, struct solid_step *step)
{
    static const char *const names[] = {"scale", "move", NULL};
    struct value values[KEYWORD_ARGUMENTS];
    step->scale = 1;
    for (int name = reader_optional(reader, names); name >= 0; name = reader_optional(reader, names)) {
        const struct keyword *row = &surface_keywords[name];
        if (!reader_values(reader, row->arguments, row->name, values))
            return false;
        double *target = name == 0 ? &step->scale : step->move;
        for (int i = 0; i < argument_count(row->arguments); i++)
            target[i] = values[i].real;
    }
    return true;
}

static void report_gap(struct reader *reader, struct deck_place place, const char *path, const struct stl_gap *gap)
{
    int triangles = gap->forward + gap->backward;
    diagnostics_error(reader->diagnostics, place,
                      "the surface of '%s' is not closed: %zu edges do not have two triangles of opposite direction, the "
                      "first from %.9g %.9g %.9g to %.9g %.9g %.9g has %d%s; expected a watertight surface, so repair the file",
                      path, gap->count, gap->from[0], gap->from[1], gap->from[2], gap->to[0], gap->to[1], gap->to[2],
                      triangles, triangles == 2 ? " of the same direction" : "");
}

/* Says what was tolerated in the file. */
static void warn_of_surface(struct reader *reader, struct deck_place place, const char *path, const struct stl *stl,
                            const struct crossings *crossings)
{
    char degenerate[80] = "", surplus[80] = "", overlapping[200] = "";
    if (stl->degenerate > 0)
        snprintf(degenerate, sizeof degenerate, "; %zu triangles without area", stl->degenerate);
    if (stl->surplus_bytes > 0)
        snprintf(surplus, sizeof surplus, "; %zu bytes behind the last triangle, ignored", stl->surplus_bytes);
    if (crossings->overlapping > 0)
        snprintf(overlapping, sizeof overlapping,
                 "; shells that overlap: the %ld points inside two of them are outside (one file a shell would join them)",
                 crossings->overlapping);
    if (*degenerate || *surplus || *overlapping)
        diagnostics_warning(reader->diagnostics, place, "'%s' has%s%s%s", path,
                            *degenerate ? degenerate + 1 : *surplus ? surplus + 1 : overlapping + 1,
                            *degenerate ? surplus : "", *degenerate || *surplus ? overlapping : "");
}

/* The crossings of a closed surface in a file's bytes; NULL and an error where it is none. */
static struct crossings *find_crossings(struct reader *reader, struct deck_place place, const char *path,
                                        const char *bytes, size_t size, const struct solid_step *step)
{
    const struct solid *solid = reader->block.solid;
    struct crossings_placement placement = {.scale = step->scale, .spacing = solid->spacing};
    struct crossings *crossings = NULL;
    struct stl stl;
    struct stl_gap gap;
    char text[STL_FAULT];
    const char *fault = NULL;
    memcpy(placement.move, step->move, sizeof placement.move);
    memcpy(placement.origin, solid->origin, sizeof placement.origin);
    if (!stl_read(&stl, bytes, size, text)) {
        diagnostics_error(reader->diagnostics, place, "cannot use '%s': %s", path, text);
        return NULL;
    }
    if (!stl_is_closed(&stl, &gap))
        report_gap(reader, place, path, &gap);
    else
        crossings = crossings_open(&stl, &placement, &fault);
    if (fault)
        diagnostics_error(reader->diagnostics, place, "the surface of '%s' %s", path, fault);
    if (crossings)
        warn_of_surface(reader, place, path, &stl, crossings);
    stl_close(&stl);
    return crossings;
}

/* Fills in file and crossings. */
static bool read_surface(struct reader *reader, const struct deck_word *word, struct solid_step *step)
{
    char *path = text_path(reader->text, word), *bytes = NULL;
    size_t size = 0;
    int failure = 0;
    if (strcmp(path, "-") == 0)
        diagnostics_error(reader->diagnostics, word->place, "standard input can't be a shape's file");
    else
        failure = text_read_file(reader->text, path, STL_MOST_BYTES, &bytes, &size);
    if (failure)
        diagnostics_error(reader->diagnostics, word->place, "cannot read '%s': %s", path, strerror(failure));
    else if (bytes)
        step->crossings = find_crossings(reader, word->place, path, bytes, size, step);
    char *whole = step->crossings ? realpath(path, NULL) : NULL; /* the echo may be read in another folder */
    if (step->crossings)
        step->file = memory_text(whole ? whole : path, strlen(whole ? whole : path));
    free(whole);
    memory_free(path);
    memory_free(bytes);
    return step->crossings;
}

/* --- steps --- */

/* Reads the numbers of a shape, or its file. */
static bool read_shape(struct reader *reader, struct solid_step *step)
{
    struct value values[KEYWORD_ARGUMENTS];
    const struct argument *arguments = step->shape->arguments;
    if (!reader_values(reader, arguments, step->shape->name, values))
        return false;
    if (!step->shape->place)
        return read_surface_words(reader, step) && (!reader->block.solid || read_surface(reader, &values[0].word, step));
    for (int i = 0; i < argument_count(arguments); i++) {
        bool is_axis = arguments[i].kind == ARGUMENT_WORD;
        step->number[i] = is_axis ? reader_axis(reader, &values[i]) : values[i].real;
        if (is_axis && step->number[i] < 0)
            return false;
    }
    return true;
}

static void read_step(struct reader *reader, enum solid_operation operation, const struct deck_word *word,
                      const struct deck_word *name)
{
    char text[40];
    bool is_first = reader->block.steps++ == 0;
    struct solid_step step = {.operation = operation, .shape = solid_shape_find(text_copy(name, text, sizeof text))};
    if (!step.shape) {
        reader_unknown(reader, name, "shape", nearest_shape(text), "solid");
        reader_skip_numbers(reader);
        return;
    }
    if (!read_shape(reader, &step))
        return;
    if (is_first && operation != SOLID_ADD)
        diagnostics_error(reader->diagnostics, word->place, "the first step of a solid must be add");
    const char *fault = reader->block.solid ? solid_join(reader->block.solid, &step) : NULL;
    if (fault)
        diagnostics_error(reader->diagnostics, name->place, "this %s %s", step.shape->long_name, fault);
}

static void fail_step(struct reader *reader, const struct deck_word *word)
{
    (void)word;
    reader->block.steps++;
}

static void add_shape(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    read_step(reader, SOLID_ADD, word, &values[0].word);
}

static void cut_shape(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    read_step(reader, SOLID_CUT, word, &values[0].word);
}

static void keep_shape(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    read_step(reader, SOLID_KEEP, word, &values[0].word);
}

/* --- beds --- */

/* The words `pick k of n` behind a bed; false after an error. */
static bool read_pick(struct reader *reader, struct bed *bed)
{
    static const char *const names[] = {"pick", NULL};
    static const struct argument arguments[] = {{"k", NULL, ARGUMENT_INTEGER, LIMIT_COUNT}, {"n", NULL, ARGUMENT_INTEGER, LIMIT_COUNT}, {0}};
    struct value values[KEYWORD_ARGUMENTS];
    bed->pick = bed->among = 1;
    if (reader_optional(reader, names) < 0)
        return true;
    if (!reader_values(reader, arguments, "pick", values))
        return false;
    bed->pick = values[0].integer;
    bed->among = values[1].integer;
    if (bed->pick <= bed->among)
        return true;
    diagnostics_error(reader->diagnostics, values[0].word.place, "pick takes grain %ld of every %ld; expected one of those", bed->pick,
                      bed->among);
    return false;
}

/* Each grain is a step of its own; in a plane a disc one layer thick. */
static void add_grains(struct reader *reader, const struct deck_word *word, struct bed *bed)
{
    struct solid *solid = reader->block.solid;
    struct grain grain;
    const char *fault = NULL;
    long count = 0;
    while (solid && !fault && count < MOST_GRAINS && bed_next(bed, &grain)) {
        const double *c = grain.centre;
        const struct solid_step ball = {.shape = solid_shape_find("sphe"), .number = {c[0], c[1], c[2], grain.radius}};
        const struct solid_step disc = {.shape = solid_shape_find("cyli"),
                                        .number = {2, c[0], c[1], grain.radius, solid->origin[2], solid->origin[2] + solid->spacing}};
        fault = solid_join(solid, bed->is_flat ? &disc : &ball);
        count++;
    }
    if (fault)
        diagnostics_error(reader->diagnostics, word->place, "a grain of this bed %s", fault);
    else if (solid && count == 0)
        diagnostics_error(reader->diagnostics, word->place, "no grain fits into this bed; expected it longer than two radii");
    else if (count == MOST_GRAINS)
        diagnostics_error(reader->diagnostics, word->place, "this bed has more than %d grains; expected larger ones", MOST_GRAINS - 1);
}

static void read_bed(struct reader *reader, const struct deck_word *word, const struct value *values, bool is_flat)
{
    const int floor = is_flat ? 2 : 4;
    struct bed bed = {.x = {values[0].real, values[1].real}, .is_flat = is_flat, .floor = values[floor].real,
                      .least = values[floor + 1].real, .most = values[floor + 2].real, .seed = (uint64_t)values[floor + 3].integer};
    reader->block.steps++;
    for (int i = 0; i < 2 && !is_flat; i++)
        bed.y[i] = values[2 + i].real;
    if (bed.least > bed.most)
        diagnostics_error(reader->diagnostics, values[floor + 1].word.place, "the least radius, %g, is above the largest, %g", bed.least,
                          bed.most);
    else if (read_pick(reader, &bed))
        add_grains(reader, word, &bed);
}

static void add_discs(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    read_bed(reader, word, values, true);
}

static void add_balls(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    read_bed(reader, word, values, false);
}

#define LENGTH(name) {name, "length", ARGUMENT_REAL, LIMIT_NONE}
#define GRAINS {"rmin", "length", ARGUMENT_REAL, LIMIT_POSITIVE}, {"rmax", "length", ARGUMENT_REAL, LIMIT_POSITIVE}, \
               {"seed", NULL, ARGUMENT_INTEGER, LIMIT_COUNT}

static const struct argument disc_arguments[] = {LENGTH("x0"), LENGTH("x1"), LENGTH("floor"), GRAINS, {0}};
static const struct argument ball_arguments[] = {LENGTH("x0"), LENGTH("x1"), LENGTH("y0"), LENGTH("y1"), LENGTH("floor"), GRAINS, {0}};

static const struct argument shape_argument[] = {{"shape", NULL, ARGUMENT_WORD, LIMIT_NONE}, {0}};

const struct keyword solid_keywords[] = {
    {.name = "add", .arguments = shape_argument, .apply = add_shape, .fail = fail_step,
     .doc = "joins the points inside a shape to the body"},
    {.name = "cut", .arguments = shape_argument, .apply = cut_shape, .fail = fail_step,
     .doc = "takes the points inside a shape away"},
    {.name = "keep", .arguments = shape_argument, .apply = keep_shape, .fail = fail_step,
     .doc = "leaves only the points inside a shape"},
    {.name = "disc", .long_name = "discs", .arguments = disc_arguments, .apply = add_discs, .fail = fail_step,
     .doc = "joins a row of powder, for two dimensions: discs one layer thick that lie on the line y = floor and touch, from x0 to x1, with "
            "radii drawn between two; with `pick k n` behind only number k of every n"},
    {.name = "ball", .long_name = "balls", .arguments = ball_arguments, .apply = add_balls, .fail = fail_step,
     .doc = "joins a bed of powder: rows of balls along x on the plane z = floor, from y0 to y1 as far apart as the largest may be wide; "
            "`pick k n` as with disc"},
    {0}};

bool reader_solid_block(struct reader *reader, struct solid *solid)
{
    const struct reader_solid outer = reader->block;
    reader->block = (struct reader_solid){.is_open = true, .solid = solid};
    const bool is_good = reader_block(reader, solid_keywords, "endp", "solid", NULL);
    reader->block = outer;
    return is_good;
}

void reader_skip_solid(struct reader *reader)
{
    struct deck_word word;
    char text[40];
    if (text_peek(reader->text, &word) && keyword_in(solid_keywords, text_copy(&word, text, sizeof text)))
        reader_solid_block(reader, NULL);
}
