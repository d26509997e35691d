/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solids: bodies on a lattice, made of shapes that are joined, cut away or kept one after the other.
 *
 * The lattice has its points at origin + (i + 1/2, j + 1/2, k + 1/2) spacings for all whole i, j, k.
 * A point is inside a shape when it is so by more than 1e-9 spacings (surfaces of triangles: see
 * crossings.h), so that a point on the surface is outside whatever the round-off of the deck's
 * numbers. */
#ifndef PARTICLES_SOLID_H
#define PARTICLES_SOLID_H

#include "base/argument.h"
#include "particles/crossings.h"

enum solid_operation { SOLID_ADD, SOLID_CUT, SOLID_KEEP };

enum { SOLID_NUMBERS = 6 };

struct solid_step;

/* A kind of shape. */
struct solid_shape {
    const char *name;
    const char *long_name;
    const char *doc;
    const struct argument *arguments; /* words are an axis (as 0, 1, 2) or a file */
    /* Fills in a step's extents in spacings from its numbers; NULL for surfaces. Returns what is
     * wrong with the numbers, or NULL. */
    const char *(*place)(struct solid_step *step, const double origin[3], double spacing);
};

struct solid_step {
    enum solid_operation operation;
    const struct solid_shape *shape;
    double number[SOLID_NUMBERS]; /* as in the deck */
    char *file;                   /* of a surface, NULL otherwise; freed with the solid */
    double scale, move[3];        /* of a surface */
    struct crossings *crossings;  /* of a surface */
    double low[3], high[3];       /* extents, in spacings from the origin */
    double centre[3], radius;     /* round in those axes, in spacings */
    bool is_round[3];
    bool is_arch;
    double foot, rise;            /* of an arch, in spacings */
    long from[3], to[3];          /* points that may be inside: from ... to - 1 */
};

struct solid {
    double origin[3], spacing;
    struct solid_step *steps;
    size_t n_steps, capacity;
    long from[3], to[3]; /* points that may be in the body */
};

/* A line of lattice points: inside[n] says of point (i + n, j, k) whether it is in the body. */
struct solid_line {
    long i, j, k;
    long count;
    const char *inside;
};
typedef void solid_visit_line(void *context, const struct solid_line *line);

const struct solid_shape *solid_shapes(int *count);

/* The shape of a name (four characters count, NUL-ended), or NULL. */
const struct solid_shape *solid_shape_find(const char *name);

struct solid *solid_open(const double origin[3], double spacing);
void solid_close(struct solid *solid);

/* Takes over a step with its operation, shape and numbers; a surface also with file, scale, move and
 * crossings. Returns what is wrong with it, or NULL; then it is freed. */
const char *solid_join(struct solid *solid, const struct solid_step *step);

/* Why the body is too large to go through its lattice, or NULL. */
const char *solid_fault(const struct solid *solid);

/* Points of the lattice that have to be looked at. */
double solid_candidates(const struct solid *solid);

/* Number of points, and the lines that may hold some, j fastest. */
long solid_count(const struct solid *solid);
void solid_visit(const struct solid *solid, solid_visit_line *visit, void *context);

#endif
