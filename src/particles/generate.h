/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Generators: the shapes of the deck's `part` blocks as points on a lattice (spec 3.3). One
 * generator is one const row. */
#ifndef PARTICLES_GENERATE_H
#define PARTICLES_GENERATE_H

#include "base/argument.h"

#include <stdbool.h>
#include <stddef.h>

enum { GENERATOR_NUMBERS = 12 };

/* A point given one by one. */
struct generator_point {
    double mass;
    double position[3];
};

struct generator_row;
struct solid;

/* What a `part` block says. */
struct generator {
    const struct generator_row *row;
    int material;       /* from 0 */
    double density;     /* sets the particles' mass; unused by points */
    double spacing;     /* of the lattice; 0 for points */
    double number[GENERATOR_NUMBERS]; /* the row's own arguments */
    struct generator_point *points;   /* of the point list */
    long n_points;
    struct solid *solid;              /* of solid */
};

/* Called for every point of a generator, in the order of the particle numbers. */
typedef void generator_visit(void *context, const double position[3], double mass);

struct generator_row {
    const char *name;
    const char *long_name;
    const char *doc;
    const struct argument *arguments; /* material, density, spacing first; NULL for the point list */
    /* Upper bound of the lattice points looked at, so that absurd sizes are refused early. */
    double (*candidates)(const struct generator *generator);
    double sparsity; /* lattice points looked at for each one kept, at most, except for a few bodies */
    long (*count)(const struct generator *generator); /* of the points kept; NULL: all candidates are */
    void (*visit)(const struct generator *generator, generator_visit *visit, void *context);
};

/* Row of a name (four characters count, NUL-ended), or NULL. */
const struct generator_row *generator_find(const char *name);
const struct generator_row *generator_rows(int *count);

/* Number of points. */
long generator_count(const struct generator *generator);

/* Frees the point list and the solid. */
void generator_close(struct generator *generator);

#endif
