/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A small `struct sph` built by hand, for tests of its parts: particles on a lattice of squares or cubes, body by body, the
 * columns bound and the neighbours listed. */
#ifndef UNIT_SPH_FIXTURE_H
#define UNIT_SPH_FIXTURE_H

#include "base/memory.h"
#include "sph/sph.h"

#include <math.h>
#include <string.h>

enum { FIXTURE_BODIES = 8, FIXTURE_ROWS = 8 };

struct fixture {
    struct sph sph;
    struct scene_sph words;
    struct sph_body bodies[FIXTURE_BODIES];
    double body_heat[FIXTURE_BODIES];
    struct properties materials[FIXTURE_BODIES]; /* by body */
    struct scene_wall walls[FIXTURE_BODIES];
    struct scene_beam_piece piece;
    size_t filled;
};

/* Gives a table of a material rows T1 v1 T2 v2 ... */
static inline void fixture_table(struct properties *properties, enum property property, size_t rows, const double *numbers)
{
    struct property_table *table = &properties->tables[property];
    table->count = table->capacity = rows;
    table->temperatures = memory_array(rows, sizeof(double), "a table");
    table->values = memory_array(rows, sizeof(double), "a table");
    for (size_t i = 0; i < rows; i++) {
        table->temperatures[i] = numbers[2 * i];
        table->values[i] = numbers[2 * i + 1];
    }
}

/* The same with one value at all temperatures. */
static inline void fixture_constant(struct properties *properties, enum property property, double value)
{
    fixture_table(properties, property, 1, (double[]){0, value});
}

/* A material of constant density, capacity and conductivity. */
static inline void fixture_plain_material(struct properties *properties, double density, double capacity, double conductivity)
{
    fixture_constant(properties, PROPERTY_DENSITY, density);
    fixture_constant(properties, PROPERTY_CAPACITY, capacity);
    fixture_constant(properties, PROPERTY_CONDUCTIVITY, conductivity);
}

/* Points the columns at those of the store, as after each sorting. */
static inline void fixture_bind(struct fixture *fixture)
{
    struct store *store = fixture->sph.store;
    struct sph_columns *c = &fixture->sph.columns;
    for (int a = 0; a < 3; a++) {
        c->x[a] = store->real[COLUMN_POSITION][a];
        c->v[a] = fixture->sph.seen[a] = store->real[COLUMN_VELOCITY][a];
        c->a[a] = store->real[COLUMN_ACCELERATION][a];
        c->wide_normal[a] = store->real[COLUMN_WIDE_NORMAL][a];
    }
    c->mass = store->real[COLUMN_MASS][0];
    c->volume = store->real[COLUMN_VOLUME][0];
    c->density = store->real[COLUMN_DENSITY][0];
    c->reference = store->real[COLUMN_REFERENCE_DENSITY][0];
    c->excess_offset = store->real[COLUMN_EXCESS_OFFSET][0];
    c->smoothing = store->real[COLUMN_SMOOTHING_LENGTH][0];
    c->viscosity = store->real[COLUMN_VISCOSITY][0];
    c->temperature = store->real[COLUMN_TEMPERATURE][0];
    c->enthalpy = store->real[COLUMN_ENTHALPY][0];
    c->liquid = store->real[COLUMN_LIQUID][0];
    c->conductivity = store->real[COLUMN_CONDUCTIVITY][0];
    c->heat_rate = store->real[COLUMN_HEAT_RATE][0];
    c->laser_power = store->real[COLUMN_LASER_POWER][0];
    c->state = store->integer[COLUMN_STATE];
    c->body = store->integer[COLUMN_BODY];
}

/* Room for `count` particles. Words that matter are set afterwards in fixture->words. */
static inline struct fixture *fixture_open(int dimension, double spacing, double ratio, size_t count)
{
    static const enum column columns[] = {
        COLUMN_POSITION, COLUMN_VELOCITY, COLUMN_ACCELERATION, COLUMN_WIDE_NORMAL, COLUMN_MASS, COLUMN_VOLUME, COLUMN_DENSITY,
        COLUMN_REFERENCE_DENSITY, COLUMN_EXCESS_OFFSET, COLUMN_SMOOTHING_LENGTH, COLUMN_VISCOSITY, COLUMN_TEMPERATURE,
        COLUMN_ENTHALPY, COLUMN_LIQUID, COLUMN_CONDUCTIVITY, COLUMN_HEAT_RATE, COLUMN_LASER_POWER, COLUMN_LISTED_POSITION,
        COLUMN_STATE, COLUMN_BODY, COLUMN_ID};
    uint64_t wanted = 0;
    for (size_t i = 0; i < sizeof columns / sizeof columns[0]; i++)
        wanted |= column_bit(columns[i]);
    struct fixture *fixture = memory_array(1, sizeof *fixture, "a test");
    struct sph *sph = &fixture->sph;
    fixture->words = (struct scene_sph){.dimension = dimension, .smoothing = ratio, .heat = HEAT_ENTHALPY, .melt_sound_factor = 1};
    fixture->words.walls = fixture->walls;
    fixture->words.beam.pieces = &fixture->piece;
    sph->words = &fixture->words;
    sph->bodies = fixture->bodies;
    sph->body_heat = fixture->body_heat;
    for (int b = 0; b < FIXTURE_BODIES; b++)
        fixture->bodies[b].properties = &fixture->materials[b];
    sph->dimension = dimension;
    sph->spacing = spacing;
    sph->smoothing = ratio * spacing;
    sph->kernel = kernel_of(sph->smoothing, dimension);
    sph->wide = kernel_of(1.8 * spacing, dimension);
    sph->self_value = kernel_value(&sph->kernel, 0);
    sph->store = store_open(count, wanted);
    sph->neighbours = neighbours_open(sph->store, dimension, 2 * sph->smoothing, 0, 0.25 * spacing);
    sph->is_shared = sph->neighbours->is_shared = true;
    fixture_bind(fixture);
    return fixture;
}

static inline void fixture_close(struct fixture *fixture)
{
    heat_free(&fixture->sph);
    laser_free(&fixture->sph);
    neighbours_close(fixture->sph.neighbours);
    store_close(fixture->sph.store);
    for (int b = 0; b < FIXTURE_BODIES; b++)
        properties_close(&fixture->materials[b]);
    memory_free(fixture);
}

/* A wall of given temperature from body `body`; its particles are added with SPH_WALL. */
static inline void fixture_warm_wall(struct fixture *fixture, int body, double temperature)
{
    struct scene_wall *wall = &fixture->walls[fixture->words.n_walls++];
    *wall = (struct scene_wall){.body = body, .heat = WALL_TEMPERATURE, .temperature = temperature};
    fixture->bodies[body].wall = wall;
}

/* One particle of the lattice's volume, with the density of its material. */
static inline void fixture_particle(struct fixture *fixture, int body, enum sph_state state, const double x[3], double temperature)
{
    const size_t p = fixture->filled++;
    const struct sph_columns *c = &fixture->sph.columns;
    const struct properties *properties = &fixture->materials[body];
    for (int a = 0; a < 3; a++)
        c->x[a][p] = a < fixture->sph.dimension ? x[a] : 0;
    c->volume[p] = pow(fixture->sph.spacing, fixture->sph.dimension);
    c->density[p] = property_value(&properties->tables[PROPERTY_DENSITY], temperature);
    c->mass[p] = c->density[p] * c->volume[p];
    c->smoothing[p] = fixture->sph.smoothing;
    c->temperature[p] = temperature;
    c->enthalpy[p] = properties->n_kinks ? properties_enthalpy(properties, temperature) : 0;
    c->liquid[p] = properties_liquid(properties, temperature);
    c->state[p] = (int32_t)state;
    c->body[p] = body;
    fixture->sph.store->integer[COLUMN_ID][p] = fixture->sph.store->index_of_id[p] = (int32_t)p;
}

/* The particles of lattice places from[] up to, without, to[]: at the middle of their squares or cubes. */
static inline void fixture_block(struct fixture *fixture, int body, enum sph_state state, const int from[3], const int to[3],
                                 double temperature)
{
    const double dx = fixture->sph.spacing;
    for (int k = from[2]; k < to[2]; k++)
        for (int j = from[1]; j < to[1]; j++)
            for (int i = from[0]; i < to[0]; i++)
                fixture_particle(fixture, body, state, (double[]){(i + 0.5) * dx, (j + 0.5) * dx, (k + 0.5) * dx}, temperature);
}

/* Lists the neighbours: particles move in memory. The store has to be full. */
static inline void fixture_list(struct fixture *fixture)
{
    neighbours_follow(fixture->sph.neighbours);
    fixture_bind(fixture);
}

/* A step of heat alone. */
static inline void fixture_heat_step(struct fixture *fixture, double time_step)
{
    struct sph *sph = &fixture->sph;
    sph->time_step = time_step;
    heat_properties(sph);
    if (fixture->words.beam.is_on)
        laser_deposit(sph);
    heat_flow(sph);
    heat_advance(sph, time_step);
    sph->time += time_step;
}

/* Heat of all particles but walls. */
static inline double fixture_heat(const struct fixture *fixture)
{
    const struct sph_columns *c = &fixture->sph.columns;
    double sum = 0;
    for (size_t p = 0; p < fixture->sph.store->count; p++)
        sum += c->state[p] == SPH_WALL ? 0 : c->mass[p] * c->enthalpy[p];
    return sum;
}

/* Linear interpolation of a column between the particles along x that are nearest to the line at the given y (2D). */
static inline double fixture_along_x(const struct fixture *fixture, const double *column, double x, double y)
{
    const struct sph_columns *c = &fixture->sph.columns;
    const double aside = 0.75 * fixture->sph.spacing;
    double left = -INFINITY, right = INFINITY, value_left = 0, value_right = 0;
    for (size_t p = 0; p < fixture->sph.store->count; p++) {
        const double at = c->x[0][p];
        if (c->state[p] == SPH_WALL || fabs(c->x[1][p] - y) > aside)
            continue;
        if (at <= x && at >= left)
            left = at, value_left = column[p];
        if (at > x && at <= right)
            right = at, value_right = column[p];
    }
    if (!isfinite(left) || !isfinite(right))
        return isfinite(left) ? value_left : value_right;
    return value_left + (value_right - value_left) * (x - left) / (right - left);
}

#endif
