/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads any bytes as a file of triangles, as `add stl` does: once by the reader's own functions, on lattices of two
 * spacings, and once through a deck. What they make of it has to hold together: corners that are there, runs of
 * points in their order and inside the surface's extents, as many points from the deck as from the runs. */
#define _POSIX_C_SOURCE 200809L
#include "deck/diagnostics.h"
#include "deck/reader.h"
#include "folder.h"
#include "fuzz.h"
#include "particles/crossings.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Spacings along the largest extent. */
static const double LENGTHS[] = {7.3, 24};

static void demand(bool holds, const char *what)
{
    if (holds)
        return;
    fprintf(stderr, "fuzz: %s\n", what);
    abort();
}

static void check_triangles(const struct stl *stl)
{
    demand(stl->size > 0 && stl->n_triangles > 0, "triangles without extent");
    for (size_t t = 0; t < stl->n_triangles; t++) {
        const int32_t *corner = stl->triangles[t];
        for (int c = 0; c < 3; c++)
            demand(corner[c] >= 0 && (size_t)corner[c] < stl->n_vertices, "a corner that is not there");
        demand(corner[0] != corner[1] && corner[1] != corner[2] && corner[2] != corner[0], "a triangle with two corners at one place");
    }
}

/* The points of a line; they are in their order, with gaps between the runs, and inside. */
static long count_line(const struct crossings *crossings, long j, long k)
{
    size_t count;
    const struct crossings_run *runs = crossings_runs(crossings, j, k, &count);
    long points = 0;
    for (size_t r = 0; r < count; r++) {
        demand(runs[r].from < runs[r].to, "an empty run");
        demand(r == 0 || runs[r - 1].to <= runs[r].from, "runs that overlap");
        demand(runs[r].from + 0.5 >= crossings->low[0] && runs[r].to - 0.5 <= crossings->high[0], "points outside the extents");
        points += runs[r].to - runs[r].from;
    }
    return points;
}

/* The number of points inside on a lattice; -1 where the surface is refused. */
static long count_points(const struct stl *stl, const struct crossings_placement *placement)
{
    const char *fault;
    struct crossings *crossings = crossings_open(stl, placement, &fault);
    demand(!crossings == (fault != NULL), "a fault and crossings, or none of both");
    if (!crossings)
        return -1;
    long points = 0;
    for (long k = crossings->from[1] - 1; k <= crossings->to[1]; k++)
        for (long j = crossings->from[0] - 1; j <= crossings->to[0]; j++)
            points += count_line(crossings, j, k);
    crossings_close(crossings);
    return points;
}

/* The number of particles of a deck that takes the file; -1 where it is refused. */
static long count_particles(const char *path, double scale)
{
    char deck[1000];
    snprintf(deck, sizeof deck, "mpm3d a body from a file\nnbco 1\nnbbo 1\nnbmp 100000\nnmat 1\ngrid -9 9 -9 9 -9 9\ndcel 1\nmate\n1 elas 1 1 0.3\n"
             "part solid 1\n1 1 1 0 0 0\nadd stl \"%s\" scale %.17g\nendp\nendt 1\nendi\n", path, scale);
    struct diagnostics *diagnostics = diagnostics_open();
    struct deck_text *text = text_open(diagnostics);
    FILE *null = fopen("/dev/null", "w");
    text_include_memory(text, "fuzz", deck, strlen(deck));
    struct scene *scene = reader_read(text, diagnostics);
    demand(null != NULL, "no /dev/null");
    diagnostics_print(diagnostics, text, null, false);
    fclose(null);
    long count = diagnostics_errors(diagnostics) == 0 ? scene->n_particles : -1;
    scene_close(scene);
    text_close(text);
    diagnostics_close(diagnostics);
    return count;
}

/* Whether the file, a closed surface, gives points; the deck has to say the same. */
static bool check_points(const struct stl *stl, const char *path)
{
    struct crossings_placement placement = {.scale = 1};
    memcpy(placement.origin, stl->vertices[0], sizeof placement.origin);
    for (size_t i = 0; i < sizeof LENGTHS / sizeof LENGTHS[0]; i++) {
        placement.spacing = stl->size / LENGTHS[i];
        (void)count_points(stl, &placement);
    }
    const double scale = LENGTHS[0] / stl->size;
    const struct crossings_placement of_deck = {.scale = scale, .spacing = 1};
    const long points = count_points(stl, &of_deck), particles = count_particles(path, scale);
    demand(particles == (points > 0 ? points : -1), "the deck has another number of points");
    return particles > 0;
}

bool fuzz_read(const uint8_t *bytes, size_t size)
{
    static struct folder folder;
    static const char *const name = "body.stl";
    char fault[STL_FAULT] = "", path[FOLDER_PATH];
    struct stl stl;
    struct stl_gap gap;
    if (!*folder.path)
        folder_make(&folder);
    char *copy = malloc(size > 0 ? size : 1); /* not longer: reading beyond the end shows */
    demand(copy != NULL, "no memory");
    if (size > 0)
        memcpy(copy, bytes, size);
    const bool is_read = stl_read(&stl, copy, size, fault);
    free(copy);
    folder_write(&folder, name, bytes, size, path);
    demand(is_read == !*fault, "a fault in a file that is read, or none in another");
    if (!is_read) {
        demand(count_particles(path, 1) < 0, "the deck takes what the reader does not");
        return false;
    }
    check_triangles(&stl);
    const bool is_closed = stl_is_closed(&stl, &gap);
    demand(is_closed == (gap.count == 0), "gaps in a closed surface, or none in an open one");
    const bool is_taken = is_closed && check_points(&stl, path);
    if (!is_closed)
        demand(count_particles(path, LENGTHS[0] / stl.size) < 0, "the deck takes an open surface");
    stl_close(&stl);
    return is_taken;
}
