/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces on coefficients, collected by each from the nodes whose rows it stands in, and what nodes get from coefficients. */
#include "base/memory.h"
#include "rkpm/dynamic.h"

#include <string.h>

/* --- pairs --- */

/* Neighbours' rows lie far apart; a copy in the order in which they are read costs as much room again. */
static void copy_gradients(const struct nodal *nodal, struct dynamic_pairs *pairs, size_t total)
{
    const size_t each = (size_t)(nodal->rows * nodal->dimension), stride = (size_t)nodal->stride;
    memory_free(pairs->gradients);
    pairs->gradients = memory_array(total * each, sizeof(double), "pairs of nodes");
    for (size_t p = 0; p < total; p++)
        for (size_t i = 0; i < each; i++)
            pairs->gradients[p * each + i] = nodal->gradients[((size_t)pairs->node[p] * each + i) * stride + (size_t)pairs->place[p]];
}

void rkpm_dynamic_pairs(struct dynamic *dynamic)
{
    const struct nodal *nodal = &dynamic->nodal;
    struct dynamic_pairs *pairs = &dynamic->pairs;
    const size_t count = nodal->count;
    size_t total = 0;
    if (!pairs->first)
        pairs->first = memory_array(dynamic->store->count + 2, sizeof *pairs->first, "pairs of nodes");
    int32_t *first = pairs->first;
    memset(first, 0, (count + 2) * sizeof *first);
    for (size_t n = 0; n < count; n++)
        for (int k = 0; k < nodal->neighbours[n]; k++, total++)
            first[rkpm_nodal_neighbour(nodal, n)[k] + 2]++;
    for (size_t i = 0; i < count; i++)
        first[i + 2] += first[i + 1];
    pairs->node = memory_grow(pairs->node, &pairs->capacity[0], total, sizeof *pairs->node, "pairs of nodes");
    pairs->place = memory_grow(pairs->place, &pairs->capacity[1], total, sizeof *pairs->place, "pairs of nodes");
    /* first[i + 1] goes from the start of i up to its end, which is the start of the next one */
    for (size_t n = 0; n < count; n++)
        for (int k = 0; k < nodal->neighbours[n]; k++) {
            const int32_t to = first[rkpm_nodal_neighbour(nodal, n)[k] + 1]++;
            pairs->node[to] = (int32_t)n;
            pairs->place[to] = k;
        }
    if (!dynamic->is_semi)
        copy_gradients(nodal, pairs, total);
    else
        pairs->force = memory_grow(pairs->force, &pairs->capacity[2], count * (size_t)nodal->stride * (size_t)dynamic_lanes(dynamic->dimension),
                                   sizeof(double), "pairs of nodes");
}

/* --- forces --- */

/* What a node's rows, read one after another, give to each of its neighbours: -sum of load times row. */
THREADS_INLINE void give(const struct dynamic *dynamic, size_t node, const int d)
{
    const struct nodal *nodal = &dynamic->nodal;
    const size_t stride = (size_t)nodal->stride, count = (size_t)nodal->neighbours[node];
    const int lanes = dynamic_lanes(d);
    double *restrict force = dynamic->pairs.force + node * stride * (size_t)lanes;
    memset(force, 0, count * (size_t)lanes * sizeof *force);
    for (int r = 0; r < nodal->rows; r++) {
        const double *restrict load = dynamic_load(dynamic, node, r, d), *restrict along[3];
        for (int j = 0; j < d; j++)
            along[j] = rkpm_nodal_gradient(nodal, node, r, j);
        for (size_t k = 0; k < count; k++)
            for (int j = 0; j < d; j++)
                for (int i = 0; i < lanes; i++)
                    force[k * (size_t)lanes + (size_t)i] -= load[j * lanes + i] * along[j][k];
    }
}

THREADS_VECTORISED
static void give_2(const struct dynamic *dynamic, size_t node)
{
    give(dynamic, node, 2);
}

THREADS_VECTORISED
static void give_3(const struct dynamic *dynamic, size_t node)
{
    give(dynamic, node, 3);
}

/* The sum of what nodes give to a coefficient. */
THREADS_INLINE void collect_given(const struct dynamic *dynamic, size_t coefficient, double force[3], const int d)
{
    const struct dynamic_pairs *pairs = &dynamic->pairs;
    const size_t lanes = (size_t)dynamic_lanes(d), stride = (size_t)dynamic->nodal.stride;
    double sum[DYNAMIC_MOST_LANES] = {0};
    for (int32_t p = pairs->first[coefficient]; p < pairs->first[coefficient + 1]; p++) {
        const double *restrict given = pairs->force + ((size_t)pairs->node[p] * stride + (size_t)pairs->place[p]) * lanes;
        for (size_t i = 0; i < lanes; i++)
            sum[i] += given[i];
    }
    memcpy(force, sum, 3 * sizeof *sum);
}

/* -sum over rows of load times row, from the copy of rows in the order of pairs. */
THREADS_INLINE void collect_all(const struct dynamic *dynamic, size_t coefficient, double force[3], const int d)
{
    const struct nodal *nodal = &dynamic->nodal;
    const struct dynamic_pairs *pairs = &dynamic->pairs;
    const size_t rows = (size_t)nodal->rows, each = rows * (size_t)d;
    const int lanes = dynamic_lanes(d);
    double sum[DYNAMIC_MOST_LANES] = {0};
    for (int32_t p = pairs->first[coefficient]; p < pairs->first[coefficient + 1]; p++) {
        const size_t node = (size_t)pairs->node[p];
        const double *restrict load = dynamic_load(dynamic, node, 0, d);
        const double *restrict row = pairs->gradients + (size_t)p * each;
        for (size_t r = 0; r < rows; r++, load += d * lanes, row += d)
            for (int j = 0; j < d; j++)
                for (int i = 0; i < lanes; i++)
                    sum[i] -= load[j * lanes + i] * row[j];
    }
    memcpy(force, sum, 3 * sizeof *sum);
}

THREADS_INLINE void collect(const struct dynamic *dynamic, size_t coefficient, double force[3], const int d)
{
    if (dynamic->is_semi)
        collect_given(dynamic, coefficient, force, d);
    else
        collect_all(dynamic, coefficient, force, d);
}

THREADS_VECTORISED
static void collect_2(const struct dynamic *dynamic, size_t coefficient, double force[3])
{
    collect(dynamic, coefficient, force, 2);
}

THREADS_VECTORISED
static void collect_3(const struct dynamic *dynamic, size_t coefficient, double force[3])
{
    collect(dynamic, coefficient, force, 3);
}

void rkpm_dynamic_forces(struct dynamic *dynamic)
{
    const double *gravity = dynamic->words->dynamic.gravity;
    const int axis = dynamic->words->dynamic.wall_axis;
    rkpm_dynamic_wall(dynamic);
#pragma omp parallel for schedule(static) if (dynamic->nodes >= DYNAMIC_FEW_NODES)
    for (size_t n = 0; n < (dynamic->is_semi ? dynamic->nodes : 0); n++)
        (dynamic->dimension == 2 ? give_2 : give_3)(dynamic, n);
#pragma omp parallel for schedule(static) if (dynamic->nodes >= DYNAMIC_FEW_NODES)
    for (size_t n = 0; n < dynamic->nodes; n++) {
        double force[3] = {0};
        (dynamic->dimension == 2 ? collect_2 : collect_3)(dynamic, n, force);
        if (n >= dynamic->count) { /* what the body does to a fixed node */
            dynamic->wall_force[n] = -force[axis];
            continue;
        }
        force[axis] += dynamic->wall_force[n];
        for (int a = 0; a < dynamic->dimension; a++)
            dynamic->acceleration[a][n] = force[a] / dynamic->mass + gravity[a];
    }
}

/* --- places --- */

static void interpolate(const struct dynamic *dynamic, double *const of[3], double *const to[3])
{
    const double *const from[3] = {of[0], of[1], of[2]};
#pragma omp parallel for schedule(static) if (dynamic->count >= DYNAMIC_FEW_NODES)
    for (size_t n = 0; n < dynamic->count; n++) {
        double sum[3];
        rkpm_nodal_interpolate(&dynamic->nodal, n, from, 1, sum, dynamic->dimension);
        for (int a = 0; a < dynamic->dimension; a++)
            to[a][n] = sum[a];
    }
}

void rkpm_dynamic_places(struct dynamic *dynamic)
{
    double *const *place = dynamic->store->real[COLUMN_POSITION];
    if (!dynamic->is_semi)
        interpolate(dynamic, dynamic->coefficient, place);
    for (int a = 0; a < dynamic->dimension && dynamic->is_semi; a++)
        memcpy(place[a], dynamic->coefficient[a], dynamic->count * sizeof(double));
}

void rkpm_dynamic_show(struct dynamic *dynamic)
{
    rkpm_dynamic_places(dynamic);
    interpolate(dynamic, dynamic->velocity, dynamic->store->real[COLUMN_VELOCITY]);
}
