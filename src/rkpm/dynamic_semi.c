/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The semi-Lagrangian kernel (spec rkpm 7): nodes move with the body, and shape functions are those of their places. A wall
 * of fixed nodes touches the body through them (natural kernel contact, spec 8). */
#include "rkpm/dynamic.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* --- motion --- */

/* dx = sum Psi_J dx_J with the shape functions of the places before. */
static void move_nodes(struct dynamic *dynamic)
{
    const double *const increment[3] = {dynamic->increment, dynamic->increment + 1, dynamic->increment + 2};
    const int d = dynamic->dimension;
#pragma omp parallel for schedule(static) if (dynamic->nodes >= DYNAMIC_FEW_NODES)
    for (size_t n = 0; n < dynamic->count; n++) {
        double way[3];
        rkpm_nodal_interpolate(&dynamic->nodal, n, increment, (size_t)dynamic_lanes(d), way, d);
        for (int a = 0; a < d; a++)
            dynamic->coefficient[a][n] += way[a];
    }
}

/* --- fixed nodes --- */

/* Without the body near it a fixed node forgets what it went through. */
static void forget(struct dynamic *dynamic, size_t slot)
{
    struct store *store = dynamic->store;
    const size_t terms = (size_t)(dynamic->dimension * dynamic->gradient_terms);
    for (int a = 0; a < 6; a++)
        store->real[COLUMN_STRESS][a][slot] = 0;
    for (int a = 0; a < 9; a++)
        store->real[COLUMN_DEFORMATION][a][slot] = 0;
    for (int k = 0; k < store->n_history; k++)
        store->history[k][slot] = 0;
    store->real[COLUMN_VOLUME][0][slot] = pow(dynamic->spacing, dynamic->dimension);
    store->real[COLUMN_ENERGY][0][slot] = 0;
    if (terms > 0)
        memset(dynamic->gradient_stress + slot * terms, 0, terms * sizeof(double));
    dynamic->fixed.is_active[slot] = false;
}

static void find_box(const struct dynamic *dynamic, double low[3], double high[3])
{
    for (int a = 0; a < dynamic->dimension; a++) {
        low[a] = high[a] = dynamic->coefficient[a][0];
        for (size_t n = 1; n < dynamic->count; n++) {
            low[a] = fmin(low[a], dynamic->coefficient[a][n]);
            high[a] = fmax(high[a], dynamic->coefficient[a][n]);
        }
    }
}

/* Beyond the last fixed nodes the body would fall through. */
static void check_end(struct dynamic *dynamic, const double low[3], const double high[3])
{
    const int axis = dynamic->words->dynamic.wall_axis;
    for (int a = 0; a < dynamic->dimension; a++) {
        if (a == axis || (low[a] > dynamic->fixed.low[a] && high[a] < dynamic->fixed.high[a]))
            continue;
        dynamic->instability = (struct instability){.is_stopped = true, .particle = -1};
        snprintf(dynamic->instability.cause, sizeof dynamic->instability.cause, "the body reaches the end of the wall, %g to %g along %c",
                 dynamic->fixed.low[a], dynamic->fixed.high[a], "xyz"[a]);
        snprintf(dynamic->instability.advice, sizeof dynamic->instability.advice, "end the run earlier, or take wall spring");
    }
}

/* Behind the last fixed nodes nothing holds a node any more. */
static void check_through(struct dynamic *dynamic)
{
    const int axis = dynamic->words->dynamic.wall_axis;
    for (size_t n = 0; n < dynamic->count && !dynamic->instability.is_stopped; n++) {
        const double below = dynamic->words->dynamic.wall_position - dynamic->coefficient[axis][n];
        if (dynamic->coefficient[axis][n] >= dynamic->fixed.low[axis])
            continue;
        dynamic->instability = (struct instability){.is_stopped = true, .particle = (long)n};
        snprintf(dynamic->instability.cause, sizeof dynamic->instability.cause, "a node went through the wall, %.3g below it", below);
        snprintf(dynamic->instability.advice, sizeof dynamic->instability.advice, "the body is too soft for its speed: take a smaller spacing, or wall spring");
    }
}

/* Fixed nodes within two supports of the body's box take part: those within one support have it as a neighbour, and they need
 * their own neighbours. */
static void choose_fixed(struct dynamic *dynamic)
{
    const struct dynamic_fixed *fixed = &dynamic->fixed;
    double low[3] = {0}, high[3] = {0};
    dynamic->nodes = dynamic->count;
    if (fixed->count == 0 || fixed->is_left_out)
        return;
    find_box(dynamic, low, high);
    bool is_near = true;
    for (int a = 0; a < dynamic->dimension; a++) {
        low[a] -= 2 * dynamic->nodal.support.radius[a];
        high[a] += 2 * dynamic->nodal.support.radius[a];
        is_near = is_near && low[a] <= fixed->high[a] && high[a] >= fixed->low[a];
    }
    if (!is_near)
        return;
    check_end(dynamic, low, high);
    check_through(dynamic);
    for (size_t slot = dynamic->count; slot < dynamic->store->count; slot++) {
        bool is_in = true;
        for (int a = 0; a < dynamic->dimension; a++)
            is_in = is_in && dynamic->rest[a][slot] >= low[a] && dynamic->rest[a][slot] <= high[a];
        if (!is_in)
            continue;
        const size_t node = dynamic->nodes++;
        dynamic->slot[node] = (int32_t)slot;
        for (int a = 0; a < dynamic->dimension; a++) {
            dynamic->coefficient[a][node] = dynamic->rest[a][slot];
            dynamic->increment[node * (size_t)dynamic_lanes(dynamic->dimension) + (size_t)a] = 0;
        }
    }
}

static bool touches_body(const struct dynamic *dynamic, size_t node)
{
    const int32_t *neighbour = rkpm_nodal_neighbour(&dynamic->nodal, node);
    for (int k = 0; k < dynamic->nodal.neighbours[node]; k++)
        if ((size_t)neighbour[k] < dynamic->count)
            return true;
    return false;
}

/* Nodes that have the body as a neighbour carry stress; those that lost it forget theirs. Slots of nodes ascend. */
static void activate(struct dynamic *dynamic)
{
    size_t node = dynamic->count;
    for (size_t slot = dynamic->count; slot < dynamic->store->count; slot++) {
        const bool is_near = node < dynamic->nodes && (size_t)dynamic->slot[node] == slot;
        const bool touches = is_near && touches_body(dynamic, node);
        node += is_near;
        if (touches)
            dynamic->fixed.is_active[slot] = true;
        else if (dynamic->fixed.is_active[slot])
            forget(dynamic, slot);
    }
}

void rkpm_dynamic_release(struct dynamic *dynamic)
{
    const struct scene_dynamic *words = &dynamic->words->dynamic;
    const double away = dynamic->sums.momentum[words->wall_axis];
    if (words->wall != RKPM_WALL_NATURAL || !words->wall_releases)
        return;
    if (dynamic->fixed.is_released)
        dynamic->fixed.is_released = away > 0;
    else
        dynamic->fixed.is_released = dynamic->sums.wall_force < 0 && away > 0;
}

/* --- rows --- */

static void make_rows(struct dynamic *dynamic)
{
    rkpm_nodal_resize(&dynamic->nodal, dynamic->nodes);
    rkpm_nodal_renew(&dynamic->nodal);
    rkpm_dynamic_pairs(dynamic);
}

void rkpm_dynamic_renew(struct dynamic *dynamic)
{
    choose_fixed(dynamic);
    make_rows(dynamic);
}

/* Boxes of snni are as large as the volumes before the step. */
void rkpm_dynamic_follow(struct dynamic *dynamic)
{
    timers_enter(dynamic->timers, PHASE_MOVE);
    move_nodes(dynamic);
    timers_enter(dynamic->timers, PHASE_CELLS);
    dynamic->fixed.is_left_out = dynamic->fixed.is_released;
    choose_fixed(dynamic);
    for (size_t n = 0; n < dynamic->nodes; n++)
        dynamic->volumes[n] = dynamic->store->real[COLUMN_VOLUME][0][dynamic->slot[n]];
    make_rows(dynamic);
    activate(dynamic);
}
