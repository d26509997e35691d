/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a run is between two steps: particles, who is where, numbers that go on. All else follows from the deck
 * or is made anew in each step. */
#include "base/checkpoint.h"
#include "base/memory.h"
#include "mpm/equilibrium.h"

#include <limits.h>
#include <math.h>
#include <string.h>

/* So many more can be counted from there. */
static const long MOST_STEPS = LONG_MAX / 2;

#define FIELD(name) {#name, offsetof(struct mpm, name), sizeof(((struct mpm *)NULL)->name)}

/* Numbers that a step takes from the one before. */
static const struct {
    const char *name;
    size_t offset, size;
} fields[] = {
    FIELD(step),
    FIELD(time),
    FIELD(time_step),
    FIELD(first_time_step),
    FIELD(sums),
    FIELD(contact_force),
    FIELD(start_energy),
    FIELD(external_work),
    FIELD(removed_energy),
    FIELD(unbalanced),
    FIELD(energy_supply),
    FIELD(growing_steps),
    FIELD(previous_kinetic),
    FIELD(start_momentum),
};

/* No run is at such numbers: counting on from them would fail. */
static bool are_sound(const struct mpm *mpm)
{
    const double positive[] = {mpm->time_step, mpm->first_time_step};
    for (size_t i = 0; i < sizeof positive / sizeof positive[0]; i++)
        if (!(positive[i] > 0 && isfinite(positive[i])))
            return false;
    return mpm->step >= 0 && mpm->step < MOST_STEPS && mpm->time >= 0 && isfinite(mpm->time) && mpm->growing_steps >= 0
        && mpm->growing_steps <= mpm->step;
}

static void exchange_fields(struct mpm *mpm, struct checkpoint *checkpoint)
{
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++)
        checkpoint_item(checkpoint, fields[i].name, (char *)mpm + fields[i].offset, fields[i].size, 1);
    if (checkpoint_is_reading(checkpoint) && checkpoint_is_good(checkpoint) && !are_sound(mpm))
        checkpoint_reject(checkpoint, "step and time");
}

static void swap_columns(struct store *store, enum column first, enum column second)
{
    for (int a = 0; a < 3; a++) {
        double *column = store->real[first][a];
        store->real[first][a] = store->real[second][a];
        store->real[second][a] = column;
    }
}

/* Cells follow from the places; with TLmp and smal, where they stay, from the initial ones. */
static void find_cells(struct mpm *mpm)
{
    if (mpm->place != COLUMN_POSITION)
        swap_columns(mpm->store, COLUMN_POSITION, COLUMN_INITIAL_POSITION);
    cell_list_build(mpm->cells, mpm->store);
    if (mpm->place != COLUMN_POSITION)
        swap_columns(mpm->store, COLUMN_POSITION, COLUMN_INITIAL_POSITION);
    grid_follow(mpm->grid);
    if (mpm->centres)
        grid_follow(mpm->centres);
}

/* Whether the order ends with all that have no cell, each of them once. */
static bool are_lost(const struct cell_list *cells)
{
    bool *is_listed = memory_array((size_t)cells->count, sizeof *is_listed, "lost particles");
    bool is_right = true;
    for (int32_t k = cells->in_cells; k < cells->count && is_right; k++) {
        const int32_t p = cells->order[k];
        is_right = p >= 0 && p < cells->count && cells->cell[p] == CELL_NONE && !is_listed[p];
        if (is_right)
            is_listed[p] = true;
    }
    memory_free(is_listed);
    return is_right;
}

/* Who takes part, and the particles that left the grid in the order in which they did. */
static void exchange_cells(struct mpm *mpm, struct checkpoint *checkpoint)
{
    struct cell_list *cells = mpm->cells;
    const bool is_reading = checkpoint_is_reading(checkpoint);
    cells->count = (int32_t)checkpoint_count(checkpoint, "particles that take part", (size_t)cells->count, mpm->store->count);
    double moved = cells->moved;
    if (checkpoint_item(checkpoint, "moved", &moved, sizeof moved, 1) && is_reading) {
        find_cells(mpm);
        cells->moved = moved;
    }
    const int32_t lost = cells->count - cells->in_cells;
    if (checkpoint_item(checkpoint, "lost particles", cells->order + cells->in_cells, sizeof *cells->order, (size_t)lost)
        && is_reading && !are_lost(cells))
        checkpoint_reject(checkpoint, "lost particles");
}

void mpm_exchange(struct mpm *mpm, struct checkpoint *checkpoint)
{
    exchange_fields(mpm, checkpoint);
    store_exchange(mpm->store, checkpoint, mpm->scene->n_bodies);
    exchange_cells(mpm, checkpoint);
    building_exchange(mpm, checkpoint);
    if (mpm->equilibrium)
        equilibrium_exchange(mpm, checkpoint);
}
