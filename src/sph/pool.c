/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How large the melt pool is, what has been melt, and the track that it leaves. */
#include "sph/sph.h"

#include <float.h>
#include <math.h>

/* Drops in flight are neither of the pool nor of the track; only runs with ejec know them. */
static bool came_off(const struct sph *sph, size_t p)
{
    return sph->columns.parted && sph->columns.parted[p] == SPH_CAME_OFF;
}

static bool is_of_pool(const struct sph *sph, size_t p)
{
    const struct sph_columns *c = &sph->columns;
    return c->state[p] == SPH_FLUID && c->liquid[p] >= 0.5 && sph->bodies[c->body[p]].properties->melts && !came_off(sph, p);
}

void sph_pool(const struct sph *sph, double extents[3])
{
    double low[3] = {DBL_MAX, DBL_MAX, DBL_MAX}, high[3] = {-DBL_MAX, -DBL_MAX, -DBL_MAX};
    for (size_t p = 0; p < sph->store->count; p++)
        for (int a = 0; a < 3 && is_of_pool(sph, p); a++) {
            low[a] = fmin(low[a], sph->columns.x[a][p]);
            high[a] = fmax(high[a], sph->columns.x[a][p]);
        }
    for (int a = 0; a < 3; a++)
        extents[a] = high[a] >= low[a] ? high[a] - low[a] + sph->spacing : 0;
}

/* --- the track --- */

/* Where a particle was at the start. */
static double start_of(const struct sph *sph, size_t p, int axis)
{
    return sph->store->real[COLUMN_INITIAL_POSITION][axis][p];
}

static bool has_been_melt(const struct sph *sph, size_t p)
{
    return sph->columns.fused[p] && sph->columns.state[p] != SPH_REMOVED;
}

/* Tops of what has been melt, by columns two spacings wide along x from `low` on; -DBL_MAX where there is none. */
static void find_tops(const struct sph *sph, double low, size_t columns, double *tops)
{
    const double *x = sph->columns.x[0], *height = sph->columns.x[sph->dimension - 1];
    for (size_t i = 0; i < columns; i++)
        tops[i] = -DBL_MAX;
    for (size_t p = 0; p < sph->store->count; p++) {
        const double column = floor((x[p] - low) / (2 * sph->spacing));
        if (has_been_melt(sph, p) && !came_off(sph, p) && column >= 0 && column < (double)columns)
            tops[(size_t)column] = fmax(tops[(size_t)column], height[p]);
    }
}

/* Over the zone that has been melt, less a column at its ends, which are half solid. */
static double roughness_of(const struct sph *sph, double low, double length)
{
    enum { MOST_COLUMNS = 4096 };
    double tops[MOST_COLUMNS], least = DBL_MAX, most = -DBL_MAX;
    const double wanted = floor(length / (2 * sph->spacing)) - 2;
    const size_t columns = wanted > MOST_COLUMNS ? MOST_COLUMNS : wanted > 0 ? (size_t)wanted : 0;
    find_tops(sph, low + 2 * sph->spacing, columns, tops);
    for (size_t i = 0; i < columns; i++) {
        if (tops[i] == -DBL_MAX)
            continue;
        least = fmin(least, tops[i]);
        most = fmax(most, tops[i]);
    }
    return most >= least ? most - least : 0;
}

struct sph_track sph_track(const struct sph *sph)
{
    const int up = sph->dimension - 1;
    double low[3] = {DBL_MAX, DBL_MAX, DBL_MAX}, high[3] = {-DBL_MAX, -DBL_MAX, -DBL_MAX};
    struct sph_track track = {{0}, 0, 0};
    for (size_t p = 0; p < sph->store->count; p++)
        for (int a = 0; a < 3 && has_been_melt(sph, p); a++) {
            low[a] = fmin(low[a], start_of(sph, p, a));
            high[a] = fmax(high[a], start_of(sph, p, a));
        }
    if (high[0] < low[0])
        return track;
    for (int a = 0; a < 3; a++)
        track.zone[a] = high[a] - low[a] + sph->spacing;
    track.penetration = fmax(0, sph->words->base - (low[up] - 0.5 * sph->spacing));
    track.roughness = roughness_of(sph, low[0] - 0.5 * sph->spacing, track.zone[0]);
    return track;
}
