/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Particles of smoothed particles placed by hand, as far as finding the surface needs them: no deck, no steps. Density 1,
 * volumes of the lattice, surface tension a straight line of the temperature. N and the Shepard sums, which a run makes
 * with its densities, come from a plain loop over all pairs. */
#ifndef UNIT_SURFACE_FIXTURE_H
#define UNIT_SURFACE_FIXTURE_H

#include "base/memory.h"
#include "sph/sph.h"

#include <math.h>
#include <stdlib.h>

enum { FIXTURE_FLUID, FIXTURE_SOLID, FIXTURE_WALL, FIXTURE_BODIES };

struct fixture {
    struct scene_sph words;
    struct scene_wall wall;
    struct properties properties;
    double temperatures[2], tensions[2];
    struct sph_body bodies[FIXTURE_BODIES];
    struct sph sph;
    size_t n, capacity;
    double (*x)[3], *temperature;
    int32_t *state;
    uint64_t more_columns; /* that a test needs besides, as bits */
};

/* Fluid, solid and an adiabatic wall are bodies 0, 1, 2. Words can be changed before fixture_start. */
static inline void fixture_open(struct fixture *fixture, int dimension, double spacing, double h_ratio)
{
    *fixture = (struct fixture){.words = {.dimension = dimension, .smoothing = h_ratio, .wide_smoothing = 1.8,
                                          .surface = SURFACE_BALANCED, .corrects_depth = true, .surface_threshold = 0.1,
                                          .ambient_pressure = 101325}};
    fixture->temperatures[0] = -1e6;
    fixture->temperatures[1] = 1e6;
    fixture->sph.spacing = spacing;
    fixture->wall.heat = WALL_ADIABATIC;
}

/* Surface tension at temperature 0 and its slope. */
static inline void fixture_tension(struct fixture *fixture, double tension, double slope)
{
    fixture->tensions[0] = tension - slope * 1e6;
    fixture->tensions[1] = tension + slope * 1e6;
}

static inline void fixture_add(struct fixture *fixture, double x, double y, double z, int32_t state, double temperature)
{
    size_t rooms[3] = {fixture->capacity, fixture->capacity, fixture->capacity};
    const size_t n = fixture->n++;
    fixture->x = memory_grow(fixture->x, &rooms[0], n + 1, sizeof *fixture->x, "test");
    fixture->temperature = memory_grow(fixture->temperature, &rooms[1], n + 1, sizeof *fixture->temperature, "test");
    fixture->state = memory_grow(fixture->state, &rooms[2], n + 1, sizeof *fixture->state, "test");
    fixture->capacity = rooms[0] < rooms[1] ? rooms[0] : rooms[1];
    fixture->capacity = rooms[2] < fixture->capacity ? rooms[2] : fixture->capacity;
    fixture->x[n][0] = x;
    fixture->x[n][1] = y;
    fixture->x[n][2] = z;
    fixture->state[n] = state;
    fixture->temperature[n] = temperature;
}

static inline void fixture_bind(struct sph *sph)
{
    struct store *store = sph->store;
    struct sph_columns *c = &sph->columns;
    for (int a = 0; a < 3; a++) {
        c->x[a] = store->real[COLUMN_POSITION][a];
        c->a[a] = store->real[COLUMN_ACCELERATION][a];
        c->normal[a] = store->real[COLUMN_NORMAL][a];
        c->wide_normal[a] = store->real[COLUMN_WIDE_NORMAL][a];
    }
    c->volume = store->real[COLUMN_VOLUME][0];
    c->density = store->real[COLUMN_DENSITY][0];
    c->smoothing = store->real[COLUMN_SMOOTHING_LENGTH][0];
    c->shepard = store->real[COLUMN_SHEPARD][0];
    c->wide_shepard = store->real[COLUMN_WIDE_SHEPARD][0];
    c->curvature = store->real[COLUMN_CURVATURE][0];
    c->temperature = store->real[COLUMN_TEMPERATURE][0];
    c->state = store->integer[COLUMN_STATE];
    c->body = store->integer[COLUMN_BODY];
}

/* N and Shepard sum of particle a, by a loop over all particles. */
static inline void fixture_sums(const struct sph *sph, size_t a, double normal[3], double *shepard)
{
    const struct sph_columns *c = &sph->columns;
    normal[0] = normal[1] = normal[2] = *shepard = 0;
    for (size_t b = 0; b < sph->store->count; b++) {
        double square = 0;
        for (int i = 0; i < 3; i++)
            square += (c->x[i][a] - c->x[i][b]) * (c->x[i][a] - c->x[i][b]);
        if (square >= sph->kernel.reach2)
            continue;
        *shepard += c->volume[b] * kernel_value(&sph->kernel, sqrt(square));
        for (int i = 0; i < 3; i++)
            normal[i] += 2 * c->volume[b] * kernel_slope(&sph->kernel, sqrt(square)) * (c->x[i][a] - c->x[i][b]);
    }
}

/* Step A of spec 6.3. */
static inline void fixture_normals(struct sph *sph)
{
    struct sph_columns *c = &sph->columns;
    for (size_t a = 0; a < sph->store->count; a++) {
        double normal[3];
        fixture_sums(sph, a, normal, &c->shepard[a]);
        for (int i = 0; i < 3 && c->state[a] == SPH_FLUID; i++)
            c->normal[i][a] = normal[i];
    }
}

static inline void fixture_fill(struct fixture *fixture)
{
    struct sph *sph = &fixture->sph;
    for (size_t p = 0; p < fixture->n; p++) {
        for (int a = 0; a < 3; a++)
            sph->columns.x[a][p] = fixture->x[p][a];
        sph->columns.volume[p] = pow(sph->spacing, sph->dimension);
        sph->columns.density[p] = 1;
        sph->columns.smoothing[p] = sph->smoothing;
        sph->columns.temperature[p] = fixture->temperature[p];
        sph->columns.state[p] = fixture->state[p];
        sph->columns.body[p] = fixture->state[p] == SPH_WALL    ? FIXTURE_WALL
                               : fixture->state[p] == SPH_SOLID ? FIXTURE_SOLID
                                                                : FIXTURE_FLUID;
        sph->store->integer[COLUMN_ID][p] = (int32_t)p;
    }
}

/* Makes the particles that were added, their lists, N and Shepard sums. */
static inline void fixture_start(struct fixture *fixture)
{
    static const enum column columns[] = {COLUMN_POSITION, COLUMN_LISTED_POSITION, COLUMN_ACCELERATION, COLUMN_NORMAL,
                                          COLUMN_WIDE_NORMAL, COLUMN_VOLUME, COLUMN_DENSITY, COLUMN_SMOOTHING_LENGTH,
                                          COLUMN_SHEPARD, COLUMN_WIDE_SHEPARD, COLUMN_CURVATURE, COLUMN_TEMPERATURE,
                                          COLUMN_STATE, COLUMN_BODY, COLUMN_ID};
    struct sph *sph = &fixture->sph;
    uint64_t wanted = fixture->more_columns;
    for (size_t i = 0; i < sizeof columns / sizeof columns[0]; i++)
        wanted |= column_bit(columns[i]);
    fixture->properties.is_given = true;
    fixture->properties.tables[PROPERTY_SURFACE_TENSION] =
        (struct property_table){.count = 2, .temperatures = fixture->temperatures, .values = fixture->tensions};
    for (int b = 0; b < FIXTURE_BODIES; b++)
        fixture->bodies[b].properties = &fixture->properties;
    fixture->bodies[FIXTURE_WALL].wall = &fixture->wall;
    sph->words = &fixture->words;
    sph->bodies = fixture->bodies;
    sph->dimension = (int)fixture->words.dimension;
    sph->smoothing = fixture->words.smoothing * sph->spacing;
    sph->kernel = kernel_of(sph->smoothing, sph->dimension);
    sph->wide = kernel_of(fixture->words.wide_smoothing * sph->spacing, sph->dimension);
    sph->store = store_open(fixture->n, wanted);
    for (int i = 0; i < 3; i++)
        sph->work[i] = memory_array(fixture->n, sizeof(double), "test");
    sph->band = memory_array(fixture->n, sizeof *sph->band, "test");
    sph->is_kept = memory_array(fixture->n, sizeof *sph->is_kept, "test");
    sph->beside = memory_array(fixture->n, sizeof *sph->beside, "test");
    sph->ring = memory_array(fixture->n, sizeof *sph->ring, "test");
    sph->saw_motion = memory_array(fixture->n, sizeof *sph->saw_motion, "test");
    sph->saw_wide_motion = memory_array(fixture->n, sizeof *sph->saw_wide_motion, "test");
    sph->neighbours = neighbours_open(sph->store, sph->dimension, 2 * sph->smoothing,
                                      2 * fixture->words.wide_smoothing * sph->spacing, 0.25 * sph->spacing);
    sph->is_shared = sph->neighbours->is_shared = sph->has_fixed = true;
    fixture_bind(sph);
    fixture_fill(fixture);
    neighbours_follow(sph->neighbours);
    fixture_bind(sph);
    fixture_normals(sph);
}

/* Surface and forces, from accelerations of zero. */
static inline void fixture_run(struct fixture *fixture)
{
    struct sph *sph = &fixture->sph;
    for (int i = 0; i < 3; i++)
        for (size_t p = 0; p < sph->store->count; p++)
            sph->columns.a[i][p] = 0;
    flow_surroundings(sph);
    surface_find(sph);
    surface_forces(sph);
}

static inline void fixture_close(struct fixture *fixture)
{
    struct sph *sph = &fixture->sph;
    for (int i = 0; i < 3; i++)
        memory_free(sph->work[i]);
    memory_free(sph->band);
    memory_free(sph->is_kept);
    memory_free(sph->beside);
    memory_free(sph->ring);
    memory_free(sph->saw_motion);
    memory_free(sph->saw_wide_motion);
    neighbours_close(sph->neighbours);
    store_close(sph->store);
    memory_free(fixture->x);
    memory_free(fixture->temperature);
    memory_free(fixture->state);
}

#endif
