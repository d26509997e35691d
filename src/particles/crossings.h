/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which points of a lattice are inside a closed surface: lines along x through the points cross
 * the triangles, and between the crossings of odd and even number is the inside.
 *
 * The lattice has its points at (i + 1/2, j + 1/2, k + 1/2) for whole i, j, k: lengths here are in
 * spacings. A point is inside when it is so by more than `margin`, which covers the precision of
 * the file's coordinates: four lines at the corners of a square of twice the margin about the point
 * and the points of each that keep the margin from its crossings. So a point on a face is outside,
 * whichever way the face lies. */
#ifndef PARTICLES_CROSSINGS_H
#define PARTICLES_CROSSINGS_H

#include "particles/stl.h"

/* Neighbouring points of a line: i = from ... to - 1. */
struct crossings_run {
    int32_t from, to;
};

struct crossings {
    double low[3], high[3];     /* extents of the surface */
    long from[2], to[2];        /* lines j = from[0] ... to[0] - 1, k = from[1] ... to[1] - 1 */
    size_t *start;              /* of each line's runs, j fastest, and one more */
    struct crossings_run *runs;
    long overlapping;           /* points outside because they are inside an even number of shells of one direction */
};

enum { CROSSINGS_MOST_REACH = 1000000, CROSSINGS_MOST_LINES = 10000000, CROSSINGS_MOST = 20000000 };

/* Places a surface: a coordinate is ((scale x + move) - origin) / spacing there. NULL when it is too
 * large; `fault` then says why. O(lines + triangles + crossings). */
struct crossings_placement {
    double scale, move[3], origin[3], spacing;
};
struct crossings *crossings_open(const struct stl *stl, const struct crossings_placement *placement, const char **fault);
void crossings_close(struct crossings *crossings);

/* The runs of a line, in order; their number goes to *count. Lines beyond the surface have none. */
const struct crossings_run *crossings_runs(const struct crossings *crossings, long j, long k, size_t *count);

/* The first whole i with i + 1/2 > place, and the first with i + 1/2 >= place. */
long crossings_above(double place);
long crossings_from(double place);

#endif
