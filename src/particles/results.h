/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Result names of `outr`, `curv`, `curx` (spec 3.6): one const row each. */
#ifndef PARTICLES_RESULTS_H
#define PARTICLES_RESULTS_H

#include "base/methods.h"
#include "particles/columns.h"
#include "particles/state.h"

struct material;

/* What a result is computed from. */
struct result_source {
    const struct store *store;
    const struct material *const *body_material; /* material of each body */
    const int *body_material_number;             /* its number in the deck */
    const int32_t *n_open;                       /* particles at places from here on are closed; NULL: none is */
    bool shows_closed;
    const double *body_heat;                     /* power of heat from each body, of walls of smoothed particles; or NULL */
};

/* Whether the particle at place p is closed. */
static inline bool result_is_closed(const struct result_source *source, size_t p)
{
    return source->n_open && p >= (size_t)*source->n_open;
}

/* Whether output shows the particle at place p. */
static inline bool result_is_shown(const struct result_source *source, size_t p)
{
    const int32_t *state = source->store->integer[COLUMN_STATE];
    return (source->shows_closed || !result_is_closed(source, p)) && !(state && state[p] == SPH_REMOVED);
}

/* Sums and extremes of all particles that a curve may show. */
enum total {
    TOTAL_NONE,
    TOTAL_KINETIC,
    TOTAL_INTERNAL,
    TOTAL_MOMENTUM_X,
    TOTAL_MOMENTUM_Y,
    TOTAL_MOMENTUM_Z,
    TOTAL_HEAT,
    TOTAL_LASER_IN,
    TOTAL_ABSORBED,
    TOTAL_REFLECTED,
    TOTAL_TRANSMITTED,
    TOTAL_RADIATED,
    TOTAL_EVAPORATED,
    TOTAL_THROUGH_WALLS,
    TOTAL_VISCOUS_HEAT,
    TOTAL_VOLUME_HEAT,
    TOTAL_HOTTEST,
    TOTAL_FASTEST,
    TOTAL_REMOVED,
    TOTAL_DETACHED,
    TOTAL_POOL_LENGTH,
    TOTAL_POOL_WIDTH,
    TOTAL_POOL_DEPTH,
    TOTAL_FUSED_LENGTH,
    TOTAL_FUSED_WIDTH,
    TOTAL_PENETRATION,
    TOTAL_ROUGHNESS,
    TOTAL_WIDTH,
    TOTAL_TOP,
    TOTAL_BOTTOM,
    TOTAL_CENTRE_X,
    TOTAL_CENTRE_Y,
    TOTAL_CENTRE_Z,
    TOTAL_MEAN_VELOCITY_X,
    TOTAL_MEAN_VELOCITY_Y,
    TOTAL_MEAN_VELOCITY_Z,
    TOTAL_ANGULAR,
    TOTAL_TURN,
    TOTAL_LEAST_RATIO,
    TOTAL_MOST_RATIO,
    TOTAL_WALL_FORCE,
    TOTAL_WALL_ENERGY,
    TOTAL_FEW_NEIGHBOURS,
    TOTAL_COUNT
};

struct result {
    const char *name;
    const char *unit;
    const char *doc;
    bool is_integer;
    unsigned methods;        /* METHODS_... that particles have it in; 0: all */
    unsigned total_methods;  /* the same of the total */
    enum total total;        /* what curves show, as those of engk and engi do; TOTAL_NONE: the particle's */
    const char *later;       /* not NULL: known name without its feature */
    enum column columns[3];  /* columns that it needs, ended by COLUMN_NONE */
    double (*value)(const struct result_source *source, size_t particle); /* NULL: there is only the total */
};

/* Methods in which a curve of this result has a meaning. */
static inline unsigned result_curve_methods(const struct result *result)
{
    return result->total == TOTAL_NONE ? result->methods : result->total_methods;
}

/* Row of a name (NUL-ended, four characters count), or NULL. */
const struct result *result_find(const char *name);
const struct result *result_rows(int *count);

#endif
