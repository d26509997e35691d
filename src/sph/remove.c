/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Particles that take part no more: those that left the grid, and hot ones that came off the metal (spec am-sph 14). */
#include "base/memory.h"
#include "sph/pair.h"
#include "sph/sph.h"

#include <math.h>

/* Particles nearer than so many h_s belong together. */
static const double LINKED = 1.2;
/* In a thread of single particles each is linked with four others; at the surface of a drop with more than six. */
enum { LEAST_LINKS = 6 };
/* So many steps from one look at what came off to the next. */
enum { LOOK_STEPS = 25 };
enum { UNKNOWN = -1 };

/* Without volume a particle is in no sum. */
static void remove_particle(struct sph *sph, size_t p)
{
    const struct sph_columns *c = &sph->columns;
    struct sph_budget *budget = &sph->budget;
    c->state[p] = SPH_REMOVED;
    c->volume[p] = 0;
    if (sph->removed)
        sph->removed[budget->removed] = sph->store->integer[COLUMN_ID][p];
    budget->removed++;
    budget->removed_mass += c->mass[p];
    budget->removed_heat += c->enthalpy ? c->mass[p] * c->enthalpy[p] : 0;
}

static bool is_outside(const struct sph *sph, size_t p)
{
    const double *grid = sph->scene->grid;
    for (int a = sph->period > 0 ? 1 : 0; a < sph->dimension; a++)
        if (sph->columns.x[a][p] < grid[2 * a] || sph->columns.x[a][p] > grid[2 * a + 1])
            return true;
    return false;
}

void remove_outsiders(struct sph *sph)
{
    for (size_t p = 0; p < sph->store->count; p++)
        if (sph->columns.state[p] == SPH_FLUID && is_outside(sph, p))
            remove_particle(sph, p);
}

/* --- what came off --- */

static bool is_linked(const struct sph *sph, size_t a, size_t b)
{
    const double reach = fmin(LINKED * sph->words->wide_smoothing * sph->spacing, 2 * sph->smoothing);
    struct pair pair;
    if (sph->columns.state[b] == SPH_REMOVED)
        return false;
    pair_way(sph, a, b, sph->dimension, &pair);
    return pair.square < reach * reach;
}

/* Whether a particle belongs to a thread of single ones. */
static bool is_of_thread(const struct sph *sph, size_t a)
{
    const struct neighbour_lists *near = &sph->neighbours->near;
    int links = 0;
    for (int64_t k = near->first[a]; k < near->first[a + 1] && links < LEAST_LINKS; k++)
        links += is_linked(sph, a, (size_t)near->list[k]);
    return sph->columns.state[a] == SPH_FLUID && links < LEAST_LINKS;
}

/* Gives `label` to particle `start` and all that are linked with it, by way of others; how many they are. A thread holds
 * nothing: what one leads to is not linked by it. */
static int32_t label_cluster(struct sph *sph, size_t start, int32_t label)
{
    const struct neighbour_lists *near = &sph->neighbours->near;
    int32_t *labels = sph->clusters, *queue = sph->clusters + sph->store->count, n = 0;
    labels[start] = label;
    queue[n++] = (int32_t)start;
    for (int32_t i = 0; i < n; i++) {
        const size_t a = (size_t)queue[i];
        if (i > 0 && is_of_thread(sph, a))
            continue;
        for (int64_t k = near->first[a]; k < near->first[a + 1]; k++) {
            const size_t b = (size_t)near->list[k];
            if (labels[b] != UNKNOWN || !is_linked(sph, a, b))
                continue;
            labels[b] = label;
            queue[n++] = (int32_t)b;
        }
    }
    return n;
}

/* Labels of clusters, from 0; the main one is what is linked with a solid or a wall, or else the largest: it has the label
 * that is returned. */
static int32_t find_clusters(struct sph *sph)
{
    const int32_t *state = sph->columns.state;
    const size_t count = sph->store->count;
    int32_t most = 0, main = 0, next = 1;
    if (!sph->clusters)
        sph->clusters = memory_array(2 * count, sizeof *sph->clusters, "what came off");
    for (size_t p = 0; p < count; p++)
        sph->clusters[p] = UNKNOWN;
    for (size_t p = 0; p < count; p++)
        if ((state[p] == SPH_SOLID || state[p] == SPH_WALL) && sph->clusters[p] == UNKNOWN) {
            label_cluster(sph, p, main);
            most = (int32_t)count;
        }
    for (size_t p = 0; p < count; p++) {
        if (state[p] == SPH_REMOVED || sph->clusters[p] != UNKNOWN)
            continue;
        const int32_t size = label_cluster(sph, p, next);
        if (size > most) {
            most = size;
            main = next;
        }
        next++;
    }
    return main;
}

long sph_detached(struct sph *sph)
{
    const int32_t main = find_clusters(sph);
    long count = 0;
    for (size_t p = 0; p < sph->store->count; p++)
        count += sph->columns.state[p] != SPH_REMOVED && sph->clusters[p] != main;
    return count;
}

void remove_ejected(struct sph *sph)
{
    const struct sph_columns *c = &sph->columns;
    const double hottest = sph->words->ejected_above;
    if (!c->parted || sph->step % LOOK_STEPS != 0 || !(sph->budget.fastest > 0 || sph->budget.hottest > hottest))
        return;
    const int32_t main = find_clusters(sph);
    for (size_t p = 0; p < sph->store->count; p++) {
        const bool came_off = c->state[p] == SPH_FLUID && sph->clusters[p] != main;
        c->parted[p] = came_off ? SPH_CAME_OFF : is_of_thread(sph, p) ? SPH_OF_THREAD : SPH_HOLDS;
        if (came_off && c->temperature[p] > hottest)
            remove_particle(sph, p);
    }
}
