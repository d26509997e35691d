/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Result names of `outr`, `curv`, `curx` (spec 3.6): one const row each. */
#ifndef PARTICLES_RESULTS_H
#define PARTICLES_RESULTS_H

#include "particles/columns.h"

struct material;

/* What a result is computed from. */
struct result_source {
    const struct store *store;
    const struct material *const *body_material; /* material of each body */
    const int *body_material_number;             /* its number in the deck */
    const int32_t *n_open;                       /* particles at places from here on are closed; NULL: none is */
    bool shows_closed;
};

/* Whether the particle at place p is closed. */
static inline bool result_is_closed(const struct result_source *source, size_t p)
{
    return source->n_open && p >= (size_t)*source->n_open;
}

/* Whether output shows the particle at place p. */
static inline bool result_is_shown(const struct result_source *source, size_t p)
{
    return source->shows_closed || !result_is_closed(source, p);
}

struct result {
    const char *name;
    const char *unit;
    const char *doc;
    bool is_integer;
    bool is_total_in_curves; /* engk and engi are sums over all particles in a curve */
    const char *later;       /* not NULL: known name without its feature */
    enum column columns[3];  /* columns that it needs, ended by COLUMN_NONE */
    double (*value)(const struct result_source *source, size_t particle);
};

/* Row of a name (NUL-ended, four characters count), or NULL. */
const struct result *result_find(const char *name);
const struct result *result_rows(int *count);

#endif
