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

/* What is found of a particle: nothing; the normal for its area; the normal for curvatures beside it; its curvature too; all
 * that a force takes. */
enum { RING_NONE, RING_AREA, RING_NORMAL, RING_CURVATURE, RING_FORCE };

/* --- who is looked at --- */

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
        const bool is_fixed = state[a] == SPH_SOLID || state[a] == SPH_WALL;
        const bool sees = !is_fixed || sph->beside[a] != BESIDE_NOTHING;
        if (is_fixed && (is_new || sees || sph->saw_motion[a]))
            fixed_normal(sph, a, dimension, varies);
        sph->saw_motion[a] = sees;
    }
}

static bool is_strong(const struct sph *sph, size_t a)
{
    const struct sph_columns *c = &sph->columns;
    const double h = c->smoothing[a], n0 = c->normal[0][a], n1 = c->normal[1][a], n2 = c->normal[2][a];
    return c->state[a] != SPH_REMOVED && (n0 * n0 + n1 * n1 + n2 * n2) * h * h > STRONG * STRONG;
}

/* Leaves 1 in work 0 for candidates. */
static void mark_candidates(struct sph *sph)
{
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
        sph->work[0][a] = is_candidate && sph->columns.state[a] != SPH_REMOVED;
    }
}

/* Candidates that the wide kernel of a particle of one ring reaches are at least of the next one. Threads that meet write
 * the same. */
static void spread(struct sph *sph, unsigned char from, unsigned char to)
{
    const struct neighbour_lists *wide = &sph->neighbours->wide;
    const size_t count = sph->store->count;
    unsigned char *ring = sph->ring;
#pragma omp parallel for schedule(dynamic, 512) if (sph->is_shared)
    for (size_t a = 0; a < count; a++) {
        unsigned char own, other;
#pragma omp atomic read
        own = ring[a];
        for (int64_t n = wide->first[a]; own == from && n < wide->first[a + 1]; n++) {
            const int32_t b = wide->list[n];
#pragma omp atomic read
            other = ring[b];
            if (other >= to || !(sph->work[0][b] > 0))
                continue;
#pragma omp atomic write
            ring[b] = to;
        }
    }
}

/* Forces act on the fluid alone: what it does not see needs no curvature and no normal, but where it radiates. */
static void find_rings(struct sph *sph)
{
    const struct scene_sph *words = sph->words;
    const unsigned char rest = words->surface == SURFACE_THESIS ? RING_NORMAL : words->radiates ? RING_AREA : RING_NONE;
    const size_t count = sph->store->count;
#pragma omp parallel for schedule(static) if (sph->is_shared)
    for (size_t a = 0; a < count; a++)
        sph->ring[a] = !(sph->work[0][a] > 0) ? RING_NONE : sph->columns.state[a] == SPH_FLUID ? RING_FORCE : rest;
    if (words->surface == SURFACE_OFF)
        return;
    spread(sph, RING_FORCE, RING_CURVATURE);
    spread(sph, RING_CURVATURE, RING_NORMAL);
}

/* The band lists what is in a ring in the order of memory; the columns of the others are empty. */
static void compact(struct sph *sph)
{
    const struct sph_columns *c = &sph->columns;
    size_t n = 0;
    for (size_t a = 0; a < sph->store->count; a++) {
        sph->work[0][a] = 0;
        sph->is_kept[a] = 0;
        c->curvature[a] = 0;
        if (sph->ring[a] > RING_NONE) {
            sph->band[n++] = (int32_t)a;
            continue;
        }
        c->wide_shepard[a] = 0;
        sph->saw_wide_motion[a] = true;
        for (int i = 0; i < 3; i++)
            c->wide_normal[i][a] = 0;
    }
    sph->n_band = n;
}

/* --- normals --- */

/* Whether the wide normal of the last step is still that of a wall or solid. */
static bool is_as_before(struct sph *sph, size_t a)
{
    if (sph_moves(sph, a)) {
        sph->saw_wide_motion[a] = true;
        return false;
    }
    const struct neighbour_lists *wide = &sph->neighbours->wide;
    bool sees = sph_moves(sph, a);
    for (int64_t n = wide->first[a]; n < wide->first[a + 1] && !sees; n++)
        sees = sph_moves(sph, (size_t)wide->list[n]);
    const bool is_same = !sees && !sph->saw_wide_motion[a] && sph->normals_builds == sph->neighbours->builds;
    sph->saw_wide_motion[a] = sees;
    return is_same;
}

/* Steps B and C. */
THREADS_INLINE void wide_normals(struct sph *sph, int dimension, bool varies)
{
    const struct neighbour_lists *wide = &sph->neighbours->wide;
    const struct sph_columns *c = &sph->columns;
#pragma omp parallel for schedule(dynamic, 256) if (sph->is_shared)
    for (size_t k = 0; k < sph->n_band; k++) {
        const size_t a = (size_t)sph->band[k];
        if (is_as_before(sph, a))
            continue;
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
        const double length = sph->ring[a] >= RING_NORMAL ? surface_normal_length(sph, a) : 0;
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
    const bool leaves_films = !sph->words->holds_films;
    bool is_thin = leaves_films && c->wide_shepard[a] < SPARSE;
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
        is_thin = is_thin || (leaves_films && cosine < OPPOSITE && pair.square < length * length && pair_dot(own, pair.d, dimension) < 0);
    }
    sph->work[1][a] = between(-sum / filled, (dimension - 1) / (2 * length));
    if (is_thin)
        sph->is_kept[a] = THIN;
}

THREADS_INLINE void raw_curvatures(struct sph *sph, int dimension, bool varies)
{
#pragma omp parallel for schedule(dynamic, 256) if (sph->is_shared)
    for (size_t k = 0; k < sph->n_band; k++)
        if (sph->is_kept[sph->band[k]] && sph->ring[sph->band[k]] >= RING_CURVATURE)
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
#pragma omp parallel for schedule(dynamic, 256) if (sph->is_shared)
    for (size_t k = 0; k < sph->n_band; k++) {
        const size_t a = (size_t)sph->band[k];
        if (sph->is_kept[a] != KEPT || sph->ring[a] != RING_FORCE)
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
    find_rings(sph);
    compact(sph);
    RUN_FORM(wide_normals, sph);
    sph->normals_builds = sph->neighbours->builds;
    if (sph->words->surface == SURFACE_THESIS)
        RUN_FORM(thesis_normals, sph);
    keep_normals(sph);
    if (sph->words->surface == SURFACE_OFF)
        return;
    RUN_FORM(raw_curvatures, sph);
    RUN_FORM(smooth_curvatures, sph);
}
