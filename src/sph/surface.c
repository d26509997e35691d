/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where the surface is, which way it faces and how it is curved: the balanced continuum surface force of spec
 * am-sph 6.3, steps B to G. The wide kernel serves this geometry; the force itself (surface_forces.c) takes the normal
 * of the kernel of the pressure force, so that an even pressure sigma kappa holds it exactly.
 *
 * All that is not removed counts, walls and solids too: liquid beside its own solid has no surface there, and where
 * both end in the open the surface goes on from one to the other.
 *
 * Work arrays: 0 has 1/|n| where the normal is kept and 0 elsewhere, 1 the curvature before it is smoothed. */
#include "sph/surface.h"

#include <math.h>

/* Particles with |N| h above this, and their neighbours, are looked at with the wide kernel. */
static const double STRONG = 0.05;
/* Films of one or two layers of particles: less of the surroundings is filled, or normals of both sides meet. */
static const double SPARSE = 0.35, OPPOSITE = -0.3;
/* The list of the forces' kernel finds all that the wide kernel can see of the surface up to this ratio of both. */
static const double LONGEST_RATIO = 1.75;
/* Depth below the surface over h_s, as polynomial of how much more than half of the surroundings is filled. */
static const double DEPTH[2][4] = {{0.3989, 2.0182, -4.1546, 2.9309}, {0.4060, 1.9221, -3.9722, 2.8071}};
static const double MOST_FILLED = 0.97, LEAST_CORRECTION = 0.5;

enum { KEPT = 1, THIN = 2 };

/* --- who is looked at --- */

static bool is_moving(const struct sph *sph, size_t b)
{
    const int32_t state = sph->columns.state[b];
    if (state != SPH_WALL)
        return state == SPH_FLUID;
    const double *velocity = sph->bodies[sph->columns.body[b]].wall->velocity;
    return velocity[0] != 0 || velocity[1] != 0 || velocity[2] != 0;
}

static bool sees_motion(const struct sph *sph, size_t a)
{
    const struct neighbour_lists *near = &sph->neighbours->near;
    bool sees = is_moving(sph, a);
    for (int64_t n = near->first[a]; n < near->first[a + 1] && !sees; n++)
        sees = is_moving(sph, (size_t)near->list[n]);
    return sees;
}

/* N of particle a with the kernel of the forces. */
THREADS_INLINE void fixed_normal(const struct sph *sph, size_t a, int dimension, bool varies)
{
    const struct neighbour_lists *near = &sph->neighbours->near;
    double normal[3] = {0};
    for (int64_t n = near->first[a]; n < near->first[a + 1]; n++) {
        const size_t b = (size_t)near->list[n];
        struct pair pair;
        if (!pair_of(sph, a, b, dimension, varies, &pair))
            continue;
        for (int i = 0; i < dimension; i++)
            normal[i] += 2 * sph->columns.volume[b] * pair.slope * pair.d[i];
    }
    for (int i = 0; i < 3; i++)
        sph->columns.normal[i][a] = normal[i];
}

/* N of walls and solids; that of the fluid is made together with its density. Where nothing around one moves, nor did
 * the last time, N is still what it was, unless particles have other places in memory now. */
THREADS_INLINE void fixed_normals(struct sph *sph, int dimension, bool varies)
{
    const int32_t *state = sph->columns.state;
    const bool is_new = sph->normals_builds != sph->neighbours->builds;
    const size_t count = sph->store->count;
#pragma omp parallel for schedule(static) if (sph->is_shared)
    for (size_t a = 0; a < count; a++) {
        const bool is_fixed = state[a] == SPH_SOLID || state[a] == SPH_WALL, sees = !is_fixed || sees_motion(sph, a);
        if (is_fixed && (is_new || sees || sph->saw_motion[a]))
            fixed_normal(sph, a, dimension, varies);
        sph->saw_motion[a] = sees;
    }
    sph->normals_builds = sph->neighbours->builds;
}

static bool is_strong(const struct sph *sph, size_t a)
{
    const struct sph_columns *c = &sph->columns;
    const double h = c->smoothing[a], n0 = c->normal[0][a], n1 = c->normal[1][a], n2 = c->normal[2][a];
    return c->state[a] != SPH_REMOVED && (n0 * n0 + n1 * n1 + n2 * n2) * h * h > STRONG * STRONG;
}

/* Leaves 1 in work 0 for candidates, and their columns empty for all particles. */
static void mark_candidates(struct sph *sph)
{
    const struct sph_columns *c = &sph->columns;
    const struct neighbours *neighbours = sph->neighbours;
    const bool is_far = neighbours->wide.reach > LONGEST_RATIO * neighbours->near.reach;
    const struct neighbour_lists *lists = is_far ? &neighbours->wide : &neighbours->near;
    const size_t count = sph->store->count;
#pragma omp parallel for schedule(static) if (sph->is_shared)
    for (size_t a = 0; a < count; a++)
        sph->is_kept[a] = is_strong(sph, a);
#pragma omp parallel for schedule(static) if (sph->is_shared)
    for (size_t a = 0; a < count; a++) {
        bool is_candidate = sph->is_kept[a];
        for (int64_t n = lists->first[a]; n < lists->first[a + 1] && !is_candidate; n++)
            is_candidate = sph->is_kept[lists->list[n]];
        sph->work[0][a] = is_candidate && c->state[a] != SPH_REMOVED;
        for (int i = 0; i < 3; i++)
            c->wide_normal[i][a] = 0;
        c->wide_shepard[a] = c->curvature[a] = 0;
    }
}

/* The band lists candidates in the order of memory. */
static void compact(struct sph *sph)
{
    size_t n = 0;
    for (size_t a = 0; a < sph->store->count; a++) {
        if (sph->work[0][a] > 0)
            sph->band[n++] = (int32_t)a;
        sph->work[0][a] = 0;
        sph->is_kept[a] = 0;
    }
    sph->n_band = n;
}

/* --- normals --- */

/* Steps B and C. */
THREADS_INLINE void wide_normals(struct sph *sph, int dimension, bool varies)
{
    const struct neighbour_lists *wide = &sph->neighbours->wide;
    const struct sph_columns *c = &sph->columns;
#pragma omp parallel for schedule(static) if (sph->is_shared)
    for (size_t k = 0; k < sph->n_band; k++) {
        const size_t a = (size_t)sph->band[k];
        double filled = c->volume[a] * surface_kernel(sph, a, a, dimension, varies).value, normal[3] = {0};
        for (int64_t n = wide->first[a]; n < wide->first[a + 1]; n++) {
            const size_t b = (size_t)wide->list[n];
            struct pair pair;
            if (!surface_pair(sph, a, b, dimension, varies, &pair))
                continue;
            filled += c->volume[b] * pair.value;
            for (int i = 0; i < dimension; i++)
                normal[i] += 2 * c->volume[b] * pair.slope * pair.d[i];
        }
        c->wide_shepard[a] = filled;
        for (int i = 0; i < 3; i++)
            c->wide_normal[i][a] = normal[i];
    }
}

/* (3.26): each side of a pair over the Shepard sum of the other; particles outside the band are surrounded. */
THREADS_INLINE void thesis_normals(struct sph *sph, int dimension, bool varies)
{
    const struct neighbour_lists *wide = &sph->neighbours->wide;
    const struct sph_columns *c = &sph->columns;
#pragma omp parallel for schedule(static) if (sph->is_shared)
    for (size_t k = 0; k < sph->n_band; k++) {
        const size_t a = (size_t)sph->band[k];
        const double own = 1 / c->wide_shepard[a];
        double normal[3] = {0};
        for (int64_t n = wide->first[a]; n < wide->first[a + 1]; n++) {
            const size_t b = (size_t)wide->list[n];
            struct pair pair;
            if (!surface_pair(sph, a, b, dimension, varies, &pair))
                continue;
            const double both = own + (c->wide_shepard[b] > 0 ? 1 / c->wide_shepard[b] : 1);
            for (int i = 0; i < dimension; i++)
                normal[i] += both * c->volume[b] * pair.slope * pair.d[i];
        }
        for (int i = 0; i < 3; i++)
            c->wide_normal[i][a] = normal[i];
    }
}

static void keep_normals(struct sph *sph)
{
    const double threshold = sph->words->surface_threshold;
#pragma omp parallel for schedule(static) if (sph->is_shared)
    for (size_t k = 0; k < sph->n_band; k++) {
        const size_t a = (size_t)sph->band[k];
        const double length = surface_normal_length(sph, a);
        sph->is_kept[a] = length * surface_length(sph, a) > threshold ? KEPT : 0;
        sph->work[0][a] = sph->is_kept[a] ? 1 / length : 0;
    }
}

/* --- curvature --- */

static double between(double value, double most)
{
    return value > most ? most : value < -most ? -most : value;
}

/* Steps D and E for particle a; finds also whether it is in a thin film. */
THREADS_INLINE void curvature_of(struct sph *sph, size_t a, int dimension, bool varies)
{
    const struct neighbour_lists *wide = &sph->neighbours->wide;
    const struct sph_columns *c = &sph->columns;
    const double *inverse = sph->work[0], length = surface_length(sph, a);
    double filled = c->volume[a] * surface_kernel(sph, a, a, dimension, varies).value, sum = 0, own[3];
    bool is_thin = c->wide_shepard[a] < SPARSE;
    for (int i = 0; i < 3; i++)
        own[i] = c->wide_normal[i][a] * inverse[a];
    for (int64_t n = wide->first[a]; n < wide->first[a + 1]; n++) {
        const size_t b = (size_t)wide->list[n];
        struct pair pair;
        if (!(inverse[b] > 0) || !surface_pair(sph, a, b, dimension, varies, &pair))
            continue;
        double change[3] = {0}, cosine = 0;
        for (int i = 0; i < dimension; i++) {
            const double other = c->wide_normal[i][b] * inverse[b];
            change[i] = other - own[i];
            cosine += other * own[i];
        }
        filled += c->volume[b] * pair.value;
        sum += c->volume[b] * pair.slope * pair_dot(change, pair.d, dimension);
        /* b is on the far side of a film, not of a gap: the normal of a points to it. */
        is_thin = is_thin || (cosine < OPPOSITE && pair.square < length * length && pair_dot(own, pair.d, dimension) < 0);
    }
    sph->work[1][a] = between(-sum / filled, (dimension - 1) / (2 * length));
    if (is_thin)
        sph->is_kept[a] = THIN;
}

THREADS_INLINE void raw_curvatures(struct sph *sph, int dimension, bool varies)
{
#pragma omp parallel for schedule(static) if (sph->is_shared)
    for (size_t k = 0; k < sph->n_band; k++)
        if (sph->is_kept[sph->band[k]])
            curvature_of(sph, (size_t)sph->band[k], dimension, varies);
}

/* Curvature at the surface, from that of the surface through particle a parallel to it (step G). */
static double corrected(const struct sph *sph, size_t a, double curvature, int dimension)
{
    const double *p = DEPTH[dimension - 2], twice = 2 * sph->columns.wide_shepard[a] - 1;
    const double g = twice > MOST_FILLED ? MOST_FILLED : twice > 0 ? twice : 0;
    const double depth = g * (p[0] + g * (p[1] + g * (p[2] + g * p[3]))) * surface_length(sph, a);
    const double ratio = 1 + depth * curvature / (dimension - 1);
    return curvature / (ratio > LEAST_CORRECTION ? ratio : LEAST_CORRECTION);
}

/* Steps F and G. */
THREADS_INLINE void smooth_curvatures(struct sph *sph, int dimension, bool varies)
{
    const struct neighbour_lists *wide = &sph->neighbours->wide;
    const struct sph_columns *c = &sph->columns;
    const bool corrects = sph->words->corrects_depth && sph->words->surface == SURFACE_BALANCED;
#pragma omp parallel for schedule(static) if (sph->is_shared)
    for (size_t k = 0; k < sph->n_band; k++) {
        const size_t a = (size_t)sph->band[k];
        if (sph->is_kept[a] != KEPT)
            continue;
        double filled = c->volume[a] * surface_kernel(sph, a, a, dimension, varies).value, sum = filled * sph->work[1][a];
        for (int64_t n = wide->first[a]; n < wide->first[a + 1]; n++) {
            const size_t b = (size_t)wide->list[n];
            struct pair pair;
            if (!(sph->work[0][b] > 0) || !surface_pair(sph, a, b, dimension, varies, &pair))
                continue;
            filled += c->volume[b] * pair.value;
            sum += c->volume[b] * pair.value * sph->work[1][b];
        }
        c->curvature[a] = corrects ? corrected(sph, a, sum / filled, dimension) : sum / filled;
    }
}

void surface_find(struct sph *sph)
{
    RUN_FORM(fixed_normals, sph);
    mark_candidates(sph);
    compact(sph);
    RUN_FORM(wide_normals, sph);
    if (sph->words->surface == SURFACE_THESIS)
        RUN_FORM(thesis_normals, sph);
    keep_normals(sph);
    if (sph->words->surface == SURFACE_OFF)
        return;
    RUN_FORM(raw_curvatures, sph);
    RUN_FORM(smooth_curvatures, sph);
}
