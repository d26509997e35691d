/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The beam (spec am-sph 9): it comes down along the last axis in columns of cells, and each cell takes the part that its
 * filling absorbs from what is left of the column's power; particles share that of the cells around them.
 *
 * Cells lie at fixed places, with faces at multiples of their size, so that they do not move with the particles. Only
 * columns that the beam reaches and levels that have particles exist. Each column gathers from the particles around
 * it in their order, and each particle from the cells around it: the number of threads changes nothing. */
#include "base/memory.h"
#include "sph/sph.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The beam reaches so many radii: beyond are 2e-9 of it. */
static const double BEAM_REACH = 3;
/* Cells filled less than this do not make a surface. */
static const double LEAST_FILLING = 1e-6;
/* The depth of absorption where none is given, over the spacing: 95 % within one spacing. */
static const double SHORT_DEPTH = 3;
/* What lies farther, in cells, is not under the beam: its level would not fit into a number. */
static const double FARTHEST = 1e12;
/* Fewer than this are not worth a second thread. */
enum { SHARED_ITEMS = 4000 };
static const double PI = 3.14159265358979323846;

/* A particle under the beam lies between cell centres: cell (column, level) and the next ones, with the way from
 * there in cells. In two dimensions there is one lateral axis. */
struct lit {
    int32_t particle, column[2], level;
    double way[3];
};

struct sph_march {
    int lateral;           /* axes across the beam */
    double cell, volume;   /* size and volume of cells */
    double centre[2];      /* of the beam */
    long low[2];           /* first column along an axis */
    int columns[2];        /* how many */
    size_t levels;

    struct lit *lit;       /* by base column, in it in the order of memory */
    int64_t *level_of;     /* base levels of those, then the levels that exist */
    int32_t *base_of;      /* of each particle: its base column, or -1 */
    int32_t *base_first;
    double *parts[2];      /* of the power, by column along an axis */
    double *cells;         /* filled volume of cells, then power per volume; columns one behind the other */
    double *powers[3];     /* of columns: absorbed, reflected, transmitted */
    size_t n_lit, lit_capacity, level_capacity, base_capacity, parts_capacity[2], cells_capacity, powers_capacity[3];
};

static struct sph_march *march_of(struct sph *sph)
{
    if (sph->march)
        return sph->march;
    sph->march = memory_array(1, sizeof *sph->march, "the beam");
    sph->march->base_of = memory_array(sph->store->count, sizeof(int32_t), "the beam");
    return sph->march;
}

void laser_free(struct sph *sph)
{
    struct sph_march *march = sph->march;
    if (!march)
        return;
    void *const arrays[] = {march->lit, march->level_of, march->base_of, march->base_first, march->parts[0], march->parts[1],
                            march->cells, march->powers[0], march->powers[1], march->powers[2], march};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++)
        memory_free(arrays[i]);
    sph->march = NULL;
}

/* --- columns --- */

/* The columns that the beam reaches along an axis, and their parts of its power: integrals of the Gauss bell, scaled so
 * that they sum up to 1. */
static void lay_columns(struct sph_march *march, int axis, double radius)
{
    const double d = march->cell, centre = march->centre[axis], scale = sqrt(2) / radius;
    double sum = 0;
    march->low[axis] = (long)floor((centre - BEAM_REACH * radius) / d);
    march->columns[axis] = (int)((long)floor((centre + BEAM_REACH * radius) / d) - march->low[axis]) + 1;
    march->parts[axis] = memory_grow(march->parts[axis], &march->parts_capacity[axis], (size_t)march->columns[axis],
                                     sizeof(double), "the beam");
    for (int i = 0; i < march->columns[axis]; i++) {
        const double left = (double)(march->low[axis] + i) * d - centre;
        march->parts[axis][i] = erf((left + d) * scale) - erf(left * scale);
        sum += march->parts[axis][i];
    }
    for (int i = 0; i < march->columns[axis]; i++)
        march->parts[axis][i] /= sum;
}

static void lay_cells(struct sph_march *march, const struct sph *sph, const double centre[2])
{
    const struct scene_beam *beam = &sph->words->beam;
    march->lateral = sph->dimension - 1;
    march->cell = (beam->bin > 0 ? beam->bin : 1) * sph->spacing;
    march->volume = pow(march->cell, sph->dimension);
    for (int i = 0; i < 2; i++) {
        march->centre[i] = i < march->lateral ? centre[i] : 0;
        march->columns[i] = 1;
        march->low[i] = 0;
        if (i < march->lateral)
            lay_columns(march, i, beam->radius);
    }
}

/* --- particles under the beam --- */

/* Base columns along the lateral axes, counted from the one before the first column, and their rest. */
static bool base_along(const struct sph_march *march, int axis, double x, int32_t *column, double *way)
{
    const double place = x / march->cell - 0.5, base = floor(place);
    const double index = base - (double)march->low[axis] + 1;
    if (!(index >= 0 && index <= march->columns[axis]))
        return false;
    *column = (int32_t)index;
    *way = place - base;
    return true;
}

/* Base columns lie in rows of one more than there are columns. */
static int32_t base_count(const struct sph_march *march)
{
    return (march->columns[0] + 1) * (march->lateral == 2 ? march->columns[1] + 1 : 1);
}

static int32_t base_index(const struct sph_march *march, int32_t i, int32_t j)
{
    return j * (march->columns[0] + 1) + i;
}

static int32_t base_of_particle(const struct sph_march *march, const struct sph *sph, size_t p)
{
    int32_t column[2] = {0, 0};
    double way;
    if (sph->columns.state[p] != SPH_FLUID && sph->columns.state[p] != SPH_SOLID)
        return -1;
    if (sph->words->lets_beam_through && sph->columns.parted && sph->columns.parted[p] != SPH_HOLDS)
        return -1;
    if (!(fabs(sph->columns.x[march->lateral][p]) < FARTHEST * march->cell))
        return -1;
    for (int a = 0; a < march->lateral; a++)
        if (!base_along(march, a, sph->columns.x[a][p], &column[a], &way))
            return -1;
    return base_index(march, column[0], column[1]);
}

static void light_particle(const struct sph_march *march, const struct sph *sph, size_t p, struct lit *lit, int64_t *level)
{
    const double place = sph->columns.x[march->lateral][p] / march->cell - 0.5, base = floor(place);
    *lit = (struct lit){.particle = (int32_t)p};
    for (int a = 0; a < march->lateral; a++)
        base_along(march, a, sph->columns.x[a][p], &lit->column[a], &lit->way[a]);
    lit->way[march->lateral] = place - base;
    *level = (int64_t)base;
}

/* Collects the particles under the beam by counting sort over base columns. */
static void find_lit(struct sph_march *march, const struct sph *sph)
{
    const size_t count = sph->store->count;
    const int32_t bases = base_count(march);
    march->base_first = memory_grow(march->base_first, &march->base_capacity, (size_t)bases + 2, sizeof(int32_t), "the beam");
    int32_t *first = march->base_first;
    memset(first, 0, ((size_t)bases + 2) * sizeof *first);
#pragma omp parallel for schedule(static) if (sph->is_shared)
    for (size_t p = 0; p < count; p++)
        march->base_of[p] = base_of_particle(march, sph, p);
    for (size_t p = 0; p < count; p++)
        if (march->base_of[p] >= 0)
            first[march->base_of[p] + 2]++;
    for (int32_t b = 0; b < bases; b++)
        first[b + 2] += first[b + 1];
    march->n_lit = (size_t)first[bases + 1];
    march->lit = memory_grow(march->lit, &march->lit_capacity, march->n_lit, sizeof *march->lit, "the beam");
    march->level_of = memory_grow(march->level_of, &march->level_capacity, 3 * march->n_lit, sizeof *march->level_of, "the beam");
    for (size_t p = 0; p < count; p++)
        if (march->base_of[p] >= 0) {
            const int32_t at = first[march->base_of[p] + 1]++;
            light_particle(march, sph, p, &march->lit[at], &march->level_of[at]);
        }
}

/* --- levels --- */

static int compare_levels(const void *a, const void *b)
{
    const int64_t x = *(const int64_t *)a, y = *(const int64_t *)b;
    return (x > y) - (x < y);
}

static size_t find_level(const int64_t *levels, size_t count, int64_t level)
{
    size_t low = 0, high = count;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        if (levels[middle] <= level)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Appends the two levels of each particle that are not those of the particle before to a list, sorts it, and leaves out what
 * is twice there. Empty levels in between are transparent: what flies far above costs no memory. */
static void find_levels(struct sph_march *march)
{
    const int64_t *base = march->level_of;
    int64_t *levels = march->level_of + march->n_lit;
    size_t count = 0, kept = 0;
    bool known[256] = {false}; /* of the base levels around that of the first particle */
    for (size_t i = 0; i < march->n_lit; i++) {
        const int64_t offset = base[i] - base[0] + 128;
        const bool is_near = offset >= 0 && offset < 256;
        if (is_near && known[offset])
            continue;
        if (is_near)
            known[offset] = true;
        levels[count++] = base[i];
        levels[count++] = base[i] + 1;
    }
    qsort(levels, count, sizeof *levels, compare_levels);
    for (size_t i = 0; i < count; i++)
        if (i == 0 || levels[i] != levels[kept - 1])
            levels[kept++] = levels[i];
    march->levels = kept;
#pragma omp parallel for schedule(static) if (march->n_lit >= SHARED_ITEMS)
    for (size_t i = 0; i < march->n_lit; i++)
        march->lit[i].level = (int32_t)find_level(levels, kept, base[i]);
}

/* --- the march --- */

static double weight_along(double way, bool is_next)
{
    return is_next ? way : 1 - way;
}

/* The base columns whose particles reach into column (i, j): its own and those before, which have the numbers i + 1 and i as
 * they count from the column before the first. Returns how many. */
static int bases_of_column(const struct sph_march *march, int32_t i, int32_t j, int32_t bases[4])
{
    int count = 0;
    for (int32_t dj = 0; dj <= (march->lateral == 2 ? 1 : 0); dj++)
        for (int32_t di = 0; di <= 1; di++)
            bases[count++] = base_index(march, i + di, j + dj);
    return count;
}

static double weight_across(const struct sph_march *march, const struct lit *lit, int32_t i, int32_t j)
{
    const double weight = weight_along(lit->way[0], lit->column[0] == i);
    return march->lateral == 2 ? weight * weight_along(lit->way[1], lit->column[1] == j) : weight;
}

/* The volume of particles in the cells of column (i, j). */
static void fill_column(const struct sph_march *march, const double *volume, int32_t i, int32_t j, double *filled)
{
    int32_t bases[4];
    const int count = bases_of_column(march, i, j, bases);
    memset(filled, 0, march->levels * sizeof *filled);
    for (int k = 0; k < count; k++)
        for (int32_t n = march->base_first[bases[k]]; n < march->base_first[bases[k] + 1]; n++) {
            const struct lit *lit = &march->lit[n];
            const double share = weight_across(march, lit, i, j) * volume[lit->particle], up = lit->way[march->lateral];
            filled[lit->level] += share * weight_along(up, false);
            filled[lit->level + 1] += share * weight_along(up, true);
        }
}

/* Absorptivity of the particles of one cell at their temperatures, by their share of it. */
static double absorptivity_of_cell(const struct sph_march *march, const struct sph *sph, int32_t i, int32_t j, size_t level)
{
    int32_t bases[4];
    const int count = bases_of_column(march, i, j, bases);
    double sum = 0, weights = 0;
    for (int k = 0; k < count; k++)
        for (int32_t n = march->base_first[bases[k]]; n < march->base_first[bases[k] + 1]; n++) {
            const struct lit *lit = &march->lit[n];
            const bool is_next = (size_t)lit->level + 1 == level;
            if ((size_t)lit->level != level && !is_next)
                continue;
            const struct properties *properties = sph->bodies[sph->columns.body[lit->particle]].properties;
            const double weight = weight_across(march, lit, i, j) * weight_along(lit->way[march->lateral], is_next)
                                * sph->columns.volume[lit->particle];
            sum += weight * property_value(&properties->tables[PROPERTY_ABSORPTIVITY], sph->columns.temperature[lit->particle]);
            weights += weight;
        }
    return weights > 0 ? sum / weights : 0;
}

/* Marches down column (i, j) with the power that falls on it; leaves power per volume of particles in its cells. */
static void march_down(const struct sph_march *march, const struct sph *sph, int32_t i, int32_t j, double power)
{
    const struct scene_beam *beam = &sph->words->beam;
    const size_t column = (size_t)j * (size_t)march->columns[0] + (size_t)i;
    const double depth = beam->depth > 0 ? beam->depth : SHORT_DEPTH / sph->spacing;
    double *cells = march->cells + column * march->levels;
    size_t top = march->levels;
    fill_column(march, sph->columns.volume, i, j, cells);
    while (top > 0 && !(cells[top - 1] > LEAST_FILLING * march->volume))
        cells[--top] = 0;
    const double absorptivity = top == 0               ? 1 /* nothing is hit */
                              : beam->absorptivity > 0 ? beam->absorptivity
                                                       : absorptivity_of_cell(march, sph, i, j, top - 1);
    double left = absorptivity * power;
    march->powers[1][column] = power - left;
    march->powers[0][column] = 0;
    for (size_t k = top; k-- > 0;) {
        const double filling = cells[k] / march->volume;
        const double taken = -left * expm1(-depth * (filling < 1 ? filling : 1) * march->cell);
        march->powers[0][column] += taken;
        left -= taken;
        cells[k] = cells[k] > 0 ? taken / cells[k] : 0;
    }
    march->powers[2][column] = left;
}

static void march_columns(struct sph_march *march, const struct sph *sph, double power)
{
    const size_t columns = (size_t)march->columns[0] * (size_t)march->columns[1];
    march->cells = memory_grow(march->cells, &march->cells_capacity, columns * march->levels, sizeof(double), "the beam");
    for (int i = 0; i < 3; i++)
        march->powers[i] = memory_grow(march->powers[i], &march->powers_capacity[i], columns, sizeof(double), "the beam");
#pragma omp parallel for schedule(static) if (sph->is_shared)
    for (size_t k = 0; k < columns; k++) {
        const int32_t i = (int32_t)(k % (size_t)march->columns[0]), j = (int32_t)(k / (size_t)march->columns[0]);
        march_down(march, sph, i, j, power * march->parts[0][i] * (march->lateral == 2 ? march->parts[1][j] : 1));
    }
}

/* What a particle takes from the cells around it that the beam reaches. */
static double power_per_volume(const struct sph_march *march, const struct lit *lit)
{
    const double up = lit->way[march->lateral];
    double sum = 0;
    for (int32_t j = march->lateral == 2 ? lit->column[1] - 1 : 0; j <= (march->lateral == 2 ? lit->column[1] : 0); j++)
        for (int32_t i = lit->column[0] - 1; i <= lit->column[0]; i++) {
            if (i < 0 || i >= march->columns[0] || j < 0 || j >= march->columns[1])
                continue;
            const size_t column = (size_t)j * (size_t)march->columns[0] + (size_t)i;
            const double *cells = march->cells + column * march->levels + lit->level;
            sum += weight_across(march, lit, i, j) * (weight_along(up, false) * cells[0] + weight_along(up, true) * cells[1]);
        }
    return sum;
}

static void share_power(const struct sph_march *march, const struct sph *sph)
{
#pragma omp parallel for schedule(static) if (sph->is_shared)
    for (size_t n = 0; n < march->n_lit; n++) {
        const size_t p = (size_t)march->lit[n].particle;
        sph->columns.laser_power[p] += sph->columns.volume[p] * power_per_volume(march, &march->lit[n]);
    }
}

static void add_powers(const struct sph_march *march, struct sph_powers *powers, double power)
{
    const size_t columns = (size_t)march->columns[0] * (size_t)march->columns[1];
    powers->laser_in += power;
    for (size_t k = 0; k < columns; k++) {
        powers->absorbed += march->powers[0][k];
        powers->reflected += march->powers[1][k];
        powers->transmitted += march->powers[2][k];
    }
}

/* --- the beam --- */

/* The whole power of the beam: in two dimensions per length across the plane (spec 9). */
static double beam_power(const struct scene_beam *beam, int dimension)
{
    if (dimension == 3)
        return beam->power;
    return beam->reading == BEAM_LINE ? beam->power / beam->thickness : beam->power * sqrt(2 / PI) / beam->radius;
}

/* The part of a step in which a piece of the path is on, so that pulses have their energy whatever the step, and where the
 * beam is in its middle. */
static double part_of_step(const struct scene_beam_piece *piece, double time, double time_step, double centre[2])
{
    const double from = fmax(piece->times[0], time), to = fmin(piece->times[1], time + time_step);
    const double middle = time_step > 0 ? 0.5 * (from + to) : time, span = piece->times[1] - piece->times[0];
    const double way = span > 0 && isfinite(span) ? (middle - piece->times[0]) / span : 0;
    for (int a = 0; a < 2; a++)
        centre[a] = piece->from[a] + way * (piece->to[a] - piece->from[a]);
    if (time_step > 0)
        return fmax(to - from, 0) / time_step;
    return piece->times[0] <= time && time < piece->times[1] ? 1 : 0;
}

void laser_deposit(struct sph *sph)
{
    const struct scene_beam *beam = &sph->words->beam;
    struct sph_march *march = march_of(sph);
    struct sph_powers *powers = &sph->powers;
    powers->laser_in = powers->absorbed = powers->reflected = powers->transmitted = 0;
    memset(sph->columns.laser_power, 0, sph->store->count * sizeof(double));
    for (size_t i = 0; i < beam->n_pieces; i++) {
        double centre[2];
        const double part = part_of_step(&beam->pieces[i], sph->time, sph->time_step, centre);
        if (!(part > 0))
            continue;
        const double power = part * beam_power(beam, sph->dimension);
        lay_cells(march, sph, centre);
        find_lit(march, sph);
        if (march->n_lit == 0) {
            powers->laser_in += power;
            powers->transmitted += power;
            continue;
        }
        find_levels(march);
        march_columns(march, sph, power);
        share_power(march, sph);
        add_powers(march, powers, power);
    }
}
