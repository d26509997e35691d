/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a part that is built up adds to a run: closed particles that open, and what they bring along. */
#include "base/checkpoint.h"
#include "base/memory.h"
#include "deck/diagnostics.h"
#include "mpm/mpm.h"
#include "process/schedule.h"
#include "process/transformation.h"

#include <math.h>

static bool has_building(const struct mpm *mpm)
{
    return mpm->scene->building.has_ghosts || store_has(mpm->store, COLUMN_LAYER);
}

/* Materials of open particles limit the time step, and those of no particle at all, as in the reference. */
static void note_material(struct mpm *mpm, size_t p)
{
    mpm->is_material_open[mpm->material_number_of_body[mpm->store->integer[COLUMN_BODY][p]] - 1] = true;
}

static void note_materials(struct mpm *mpm)
{
    const struct scene *scene = mpm->scene;
    mpm->is_material_open = memory_array(scene->n_materials, sizeof *mpm->is_material_open, "materials");
    for (size_t i = 0; i < scene->n_materials; i++)
        mpm->is_material_open[i] = true;
    for (size_t b = 0; b < scene->n_bodies && scene->building.has_ghosts; b++)
        mpm->is_material_open[mpm->material_number_of_body[b] - 1] = false;
    for (size_t p = 0; p < mpm->n_open && scene->building.has_ghosts; p++)
        note_material(mpm, p);
}

void building_open(struct mpm *mpm, struct diagnostics *diagnostics)
{
    const struct scene *scene = mpm->scene;
    mpm->n_open = mpm->store->count;
    if (has_building(mpm))
        mpm->schedule = schedule_open(scene, mpm->store, &mpm->n_open);
    if (transformation_has_residual(scene))
        transformation_set_residual(scene, mpm->store);
    transformation_set_phase(scene, mpm->store);
    if (transformation_has_heat(scene))
        mpm->heat = heat_open();
    note_materials(mpm);
    if (scene->building.opening != OPENING_NONE && schedule_left(mpm->schedule) == 0)
        diagnostics_error(diagnostics, scene->building.open_place, "'open' opens nothing: no particle is closed by 'Ghost'");
    else if (scene->building.opening == OPENING_NONE && mpm->n_open == 0)
        diagnostics_error(diagnostics, scene->building.ghost_place,
                          "no particle is open, and 'open' is not given; expected 'GPD id 1' or 'open ...'");
    else if (mpm->schedule && scene->building.until >= 0
             && (size_t)mpm->store->index_of_id[scene->building.until] < mpm->n_open)
        diagnostics_error(diagnostics, scene->building.until_place, "open until: particle %ld is open at the start",
                          scene->building.until + 1);
}

void building_close(struct mpm *mpm)
{
    schedule_close(mpm->schedule);
    heat_close(mpm->heat);
    memory_free(mpm->is_material_open);
}

/* Energy that particles get without the help of motion counts as work done on the run. */
static void take_energy(struct mpm *mpm, double energy)
{
    mpm->sums.internal += energy;
    mpm->external_work += energy;
}

/* `ndam` may have another factor for the time when all is open. */
static void choose_damping(struct mpm *mpm)
{
    if (mpm->schedule && schedule_last_step(mpm->schedule) > 0)
        mpm->grid->damping = mpm->scene->nodal_damping[schedule_left(mpm->schedule) == 0];
}

/* Particles open in the order of their layers, not of cells: they are sorted in memory when more than this
 * part of them is new. */
static const double MOST_SCATTERED = 0.02;

/* Lets the next n closed particles take part; what they hold counts as work done on the run. */
static void admit(struct mpm *mpm, int32_t n)
{
    const struct store *store = mpm->store;
    const size_t first = (size_t)mpm->cells->count;
    cell_list_admit(mpm->cells, store, n);
    for (size_t p = first; p < first + (size_t)n; p++) {
        const double mass = store->real[COLUMN_MASS][0][p];
        double square = 0;
        note_material(mpm, p);
        if (mpm->scene->lost == LOST_DROP && mpm->cells->cell[p] == CELL_NONE)
            continue;
        for (int a = 0; a < 3; a++) {
            const double velocity = store->real[COLUMN_VELOCITY][a][p];
            square += velocity * velocity;
            mpm->sums.momentum[a] += mass * velocity;
            mpm->start_momentum[a] += mass * velocity;
            mpm->sums.fastest = fmax(mpm->sums.fastest, fabs(velocity));
        }
        mpm->sums.kinetic += 0.5 * mass * square;
        mpm->external_work += 0.5 * mass * square;
        take_energy(mpm, store->real[COLUMN_ENERGY][0][p]);
    }
    choose_damping(mpm);
    grid_follow(mpm->grid);
    if (mpm->centres)
        grid_follow(mpm->centres);
}

long building_next_step(const struct mpm *mpm)
{
    const long next = mpm->schedule ? schedule_next_step(mpm->schedule) : 0;
    if (next > 0 || !mpm->heat || heat_count(mpm->heat) == 0)
        return next;
    return schedule_last_step(mpm->schedule) + mpm->scene->building.interval;
}

bool building_step(struct mpm *mpm, long step)
{
    if (building_next_step(mpm) != step)
        return false;
    const size_t n = schedule_due(mpm->schedule, step);
    if (mpm->heat)
        take_energy(mpm, heat_switch_off(mpm->heat, mpm->scene, mpm->store));
    if (n > 0)
        admit(mpm, (int32_t)n);
    if (n > 0 && mpm->heat)
        take_energy(mpm, heat_switch_on(mpm->heat, mpm->scene, mpm->store, mpm->cells, mpm->cells->count - 1));
    if (mpm->scene->sorts && mpm->cells->moved > MOST_SCATTERED * mpm->cells->count)
        cell_list_sort(mpm->cells, mpm->store);
    return n > 0;
}

/* The hot zone is around a particle that opened. */
static void exchange_heat(struct mpm *mpm, struct checkpoint *checkpoint)
{
    const size_t most = mpm->schedule ? (size_t)mpm->cells->count : 0;
    const size_t count = checkpoint_count(checkpoint, "hot particles", heat_count(mpm->heat), most);
    int32_t *ids = heat_ids(mpm->heat, count);
    if (!checkpoint_item(checkpoint, "ids of hot particles", ids, sizeof *ids, count))
        return;
    for (size_t i = 0; i < count; i++)
        if (ids[i] < 0 || (size_t)ids[i] >= mpm->store->count || mpm->store->index_of_id[ids[i]] >= mpm->cells->count)
            checkpoint_reject(checkpoint, "ids of hot particles");
}

void building_exchange(struct mpm *mpm, struct checkpoint *checkpoint)
{
    if (mpm->heat)
        exchange_heat(mpm, checkpoint);
    if (!checkpoint_is_reading(checkpoint))
        return;
    const size_t count = (size_t)mpm->cells->count, opened = count - mpm->n_open;
    if (count < mpm->n_open || (mpm->schedule ? !schedule_skip(mpm->schedule, opened) : opened > 0))
        checkpoint_reject(checkpoint, "open particles");
    const long next = mpm->schedule ? schedule_next_step(mpm->schedule) : 0;
    if (!mpm->scene->finds_equilibrium && next > 0 && next <= mpm->step) /* the next ones would wait for ever */
        checkpoint_reject(checkpoint, "open particles");
    for (size_t p = 0; p < count && mpm->scene->building.has_ghosts; p++)
        note_material(mpm, p);
    choose_damping(mpm);
}

bool building_has_settled(const struct mpm *mpm, long step)
{
    const long settling = mpm->scene->building.settling;
    return settling >= 0 && step >= schedule_last_step(mpm->schedule) + settling;
}
