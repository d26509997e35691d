/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Particle properties as named columns: the table that sorting, output, restart and the memory
 * account go over. A scene has only the columns that its method, laws and outputs ask for. */
#ifndef PARTICLES_COLUMNS_H
#define PARTICLES_COLUMNS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum column {
    COLUMN_NONE, /* ends lists */
    COLUMN_POSITION,
    COLUMN_VELOCITY,
    COLUMN_STRESS,
    COLUMN_VOLUME,
    COLUMN_MASS,
    COLUMN_ENERGY,
    COLUMN_VISCOUS_PRESSURE,
    COLUMN_PLASTIC_STRAIN,
    COLUMN_YIELD_STRESS,
    COLUMN_MEAN_STRESS,
    COLUMN_EQUIVALENT_STRESS,
    COLUMN_TEMPERATURE,
    COLUMN_DAMAGE,
    COLUMN_FAILED,
    COLUMN_LIGHTING_TIME,
    COLUMN_DEFORMATION,
    COLUMN_FIRST_STRESS,
    COLUMN_SMOOTHED_PRESSURE,
    COLUMN_START_POSITION,
    COLUMN_AFFINE,
    COLUMN_LOAD,
    COLUMN_RESIDUAL,
    COLUMN_INITIAL_POSITION,
    COLUMN_DENSITY,
    COLUMN_REFERENCE_DENSITY,
    COLUMN_PRESSURE,
    COLUMN_EXCESS_OFFSET,
    COLUMN_OPENED,
    COLUMN_EXCESS_GRADIENT,
    COLUMN_SMOOTHING_LENGTH,
    COLUMN_VISCOSITY,
    COLUMN_SHEPARD,
    COLUMN_NORMAL,
    COLUMN_WIDE_NORMAL,
    COLUMN_WIDE_SHEPARD,
    COLUMN_CURVATURE,
    COLUMN_ACCELERATION,
    COLUMN_LISTED_POSITION,
    COLUMN_ENTHALPY,
    COLUMN_LIQUID,
    COLUMN_CONDUCTIVITY,
    COLUMN_HEAT_RATE,
    COLUMN_LASER_POWER,
    COLUMN_COEFFICIENT,
    COLUMN_FIELD,
    COLUMN_EXACT,
    COLUMN_ID,
    COLUMN_BODY,
    COLUMN_LAYER,
    COLUMN_STATE,
    COLUMN_FUSED,
    COLUMN_PARTED,
    COLUMN_COUNT
};

enum { COLUMN_COMPONENTS = 9 };

struct column_row {
    const char *name;
    int components;
    bool is_integer; /* int32_t instead of double */
    double initial;  /* at the start of a run */
    const char *unit;
    const char *doc;
};

/* The row of a column. */
const struct column_row *column_row(enum column column);

/* The particles of a run. Component arrays have `count` entries and are NULL where the scene
 * does not have the column. Ids and bodies are numbered from 0 here, from 1 in decks and files. */
struct store {
    size_t count;
    double *real[COLUMN_COUNT][COLUMN_COMPONENTS];
    int32_t *integer[COLUMN_COUNT];
    double **history; /* columns of laws that keep more the more a deck tells them to */
    int n_history;
    int32_t *index_of_id; /* where the particle of an id is now */
    double *scratch;      /* room for one component while sorting */
};

/* Allocates the columns in `wanted` (a bit for each column) for `count` particles. */
struct store *store_open(size_t count, uint64_t wanted);

/* Adds `components` columns of history, all zero. */
void store_open_history(struct store *store, int components);
void store_close(struct store *store);

bool store_has(const struct store *store, enum column column);

/* Puts particle order[k] at place k, for k < count, in every column; order holds the places below
 * count. Ids go along. */
void store_reorder(struct store *store, const int32_t *order, size_t count);

/* Bytes per particle in the columns, with index and scratch. */
size_t store_bytes_per_particle(const struct store *store);

/* Pressure of the particle at place p: of the equation of state where there is one, else minus the
 * mean of its stress. */
double store_pressure(const struct store *store, size_t p);

/* Writes all columns in the order of memory to a checkpoint, or takes them from one; there ids and bodies are looked at. */
struct checkpoint;
void store_exchange(struct store *store, struct checkpoint *checkpoint, size_t bodies);

static inline uint64_t column_bit(enum column column)
{
    return (uint64_t)1 << column;
}

#endif
