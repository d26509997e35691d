/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One step, as the list of thesis 3.1.4 and spec 6. */
#include "base/memory.h"
#include "mpm/mpm.h"

#include <float.h>
#include <math.h>

/* Fewer particles than this are not worth a second thread. */
enum { SHARED_PARTICLES = 4000 };

void mpm_each_block(struct mpm *mpm, block_pass *pass)
{
    const int32_t active = mpm->cells->active;
#pragma omp parallel for schedule(dynamic, 1) if (mpm->shares_always || mpm->cells->count >= SHARED_PARTICLES)
    for (int32_t b = 0; b < active; b++)
        pass(mpm, b);
}

static void scatter_momentum(struct mpm *mpm, int32_t b)
{
    mpm->shape->scatter(mpm, b, true, false);
}

static void scatter_force(struct mpm *mpm, int32_t b)
{
    mpm->shape->scatter(mpm, b, false, true);
}

static void scatter_all(struct mpm *mpm, int32_t b)
{
    mpm->shape->scatter(mpm, b, true, true);
}

/* Where there is contact, by a trial of the step with the stress that the particles have; the grid's own
 * values come afterwards. Momentum, force and normals are on the patches. */
static void find_contact(struct mpm *mpm, double step)
{
    faces_scatter(mpm, NODE_FORCE - NODE_MASS);
    grid_integrate_momentum(mpm->grid, NODE_MASS, NODE_STRAINING - NODE_MASS + 3, step);
    contact_resolve(mpm);
}

/* Steps 1 to 5: mass and momentum to the nodes, boundary conditions, for USF the stress with the
 * nodal velocities before the update, the nodal forces, and the momentum equation on the nodes.
 * Where the stress is not updated in between, momentum and force go to the grid in one pass. */
static void solve_on_grid(struct mpm *mpm)
{
    const double step = mpm->time_step * mpm->momentum_factor;
    const bool stress_first = mpm->scene->scheme == SCHEME_USF;
    const bool joins = mpm->scene->contact_joins;
    if (stress_first) {
        timers_enter(mpm->timers, PHASE_SCATTER);
        mpm_each_block(mpm, joins ? scatter_all : scatter_momentum);
        timers_enter(mpm->timers, PHASE_GRID);
        if (joins)
            find_contact(mpm, step);
        if (mpm->shape->strain_first)
            mpm->shape->strain_first(mpm);
        else
            grid_straining_velocity(mpm->grid, NODE_MASS, 4);
        if (joins)
            contact_join(mpm);
        timers_enter(mpm->timers, PHASE_STRESS);
        mpm_each_block(mpm, mpm->shape->gather_strain);
    }
    timers_enter(mpm->timers, PHASE_SCATTER);
    mpm_each_block(mpm, stress_first ? scatter_force : scatter_all);
    faces_scatter(mpm, stress_first ? 0 : NODE_FORCE - NODE_MASS);
    timers_enter(mpm->timers, PHASE_GRID);
    const int first = stress_first ? NODE_FORCE : NODE_MASS, count = stress_first ? 3 : 7;
    if (mpm->shape->integrate) {
        mpm->shape->integrate(mpm, !stress_first);
    } else if (!mpm->contact) {
        grid_integrate(mpm->grid, first, count, step);
    } else {
        grid_integrate_momentum(mpm->grid, first, count + 3, step);
        contact_resolve(mpm);
        grid_divide(mpm->grid, step);
    }
    mpm->external_work += faces_work(mpm);
}

/* Steps 6 and 7: particle velocities; for USF positions too; for MUSL the new momentum goes to
 * the nodes again. */
static void update_velocities(struct mpm *mpm)
{
    timers_enter(mpm->timers, PHASE_VELOCITY);
    mpm_each_block(mpm, mpm->shape->gather_velocity);
}

/* Step 8: for USL and MUSL stress and position, with the straining velocities of the scheme. */
static void update_stress_last(struct mpm *mpm)
{
    if (mpm->scene->scheme == SCHEME_USF)
        return;
    if (mpm->strains_at_once) /* done with the velocities */
        return;
    timers_enter(mpm->timers, PHASE_GRID);
    if (mpm->shape->strain_last)
        mpm->shape->strain_last(mpm);
    else if (mpm->scene->scheme == SCHEME_MUSL)
        grid_straining_velocity(mpm->grid, NODE_STRAINING, 3);
    if (mpm->scene->contact_joins && mpm->scene->scheme == SCHEME_MUSL)
        contact_join(mpm);
    timers_enter(mpm->timers, PHASE_STRESS);
    mpm_each_block(mpm, mpm->shape->gather_strain);
}

/* Adds the particles order[from] ... order[to - 1]. */
static void add_particles(const struct mpm *mpm, int32_t from, int32_t to, struct sums *total)
{
    const struct store *store = mpm->store;
    for (int32_t k = from; k < to; k++) {
        int32_t p = mpm->cells->order[k];
        double mass = store->real[COLUMN_MASS][0][p], square = 0;
        for (int a = 0; a < 3; a++) {
            double v = store->real[COLUMN_VELOCITY][a][p];
            square += v * v;
            total->momentum[a] += mass * v;
            total->fastest = fabs(v) > total->fastest ? fabs(v) : total->fastest;
        }
        total->kinetic += 0.5 * mass * square;
        total->internal += store->real[COLUMN_ENERGY][0][p];
    }
}

void mpm_discard_grid(struct mpm *mpm)
{
    struct cell_list *cells = mpm->cells;
    const int32_t in_cells = cells->in_cells;
    timers_enter(mpm->timers, PHASE_CELLS);
    cell_list_update(cells, mpm->store);
    if (mpm->scene->lost == LOST_DROP && cells->in_cells < in_cells) { /* what leaves takes its energy along */
        struct sums dropped = {0};
        add_particles(mpm, cells->in_cells, in_cells, &dropped);
        mpm->removed_energy += dropped.kinetic + dropped.internal;
    }
    if (mpm->scene->sorts && cells->moved > 0.1 * cells->count) {
        timers_enter(mpm->timers, PHASE_SORT);
        cell_list_sort(cells, mpm->store);
    }
    grid_follow(mpm->grid);
    if (mpm->centres)
        grid_follow(mpm->centres);
}

void mpm_clear_sums(struct mpm *mpm)
{
    size_t active = (size_t)mpm->cells->active;
    mpm->block_sums = memory_grow(mpm->block_sums, &mpm->block_sums_capacity, active, sizeof *mpm->block_sums, "sums");
    for (size_t b = 0; b < active; b++)
        mpm->block_sums[b] = (struct sums){.least_volume = DBL_MAX};
}

static void add_sums(struct sums *total, const struct sums *part)
{
    total->kinetic += part->kinetic;
    total->internal += part->internal;
    for (int a = 0; a < 3; a++)
        total->momentum[a] += part->momentum[a];
    total->work += part->work;
    total->changed += part->changed;
    total->moved += part->moved;
    total->fastest = part->fastest > total->fastest ? part->fastest : total->fastest;
    total->least_volume = part->least_volume < total->least_volume ? part->least_volume : total->least_volume;
}

struct sums mpm_total(const struct mpm *mpm)
{
    struct sums total = {.least_volume = DBL_MAX};
    add_particles(mpm, 0, mpm->scene->lost == LOST_DROP ? mpm->cells->in_cells : mpm->cells->count, &total);
    return total;
}

/* Sums over blocks in their order, then over the particles that have no cell any more. */
static void sum_particles(struct mpm *mpm, int32_t blocks)
{
    struct sums total = {.least_volume = DBL_MAX};
    for (int32_t b = 0; b < blocks; b++)
        add_sums(&total, &mpm->block_sums[b]);
    mpm->sums = total;
    mpm->external_work += total.work;
    if (mpm->grid->damping > 0)
        mpm->removed_energy += grid_damped_energy(mpm->grid) - total.changed;
    mpm->cells->moved += total.moved;
}

/* Energy that is not accounted for. Velocities belong to the middle of steps: usl and musl have the
 * internal energy half a step after the kinetic one, usf half a step before it. Both are taken at
 * the time where the internal energy lies between two kinetic ones. */
static void balance_energy(struct mpm *mpm, const struct sums *before, double work_before, double removed_before)
{
    double kinetic = 0.5 * (before->kinetic + mpm->sums.kinetic);
    double internal = mpm->scene->scheme == SCHEME_USF ? mpm->sums.internal : before->internal;
    mpm->unbalanced = kinetic + internal + 0.5 * (removed_before + mpm->removed_energy) - mpm->start_energy - work_before;
}

double mpm_stable_step(const struct mpm *mpm, double fastest)
{
    if (mpm->scene->fixed_step > 0)
        return mpm->scene->fixed_step;
    double smallest = DBL_MAX, of_all = DBL_MAX;
    for (size_t i = 0; i < mpm->scene->n_materials; i++) {
        double step = mpm->scene->cell_size / (mpm->scene->materials[i].material.wave_speed + fastest);
        smallest = step < smallest && mpm->is_material_open[i] ? step : smallest;
        of_all = fmin(step, of_all);
    }
    return mpm->step_scale * (smallest < DBL_MAX ? smallest : of_all); /* all where no particle is open yet */
}

/* Kinetic damping (spec 9.5): all velocities to zero when the kinetic energy did not grow. */
static void damp_kinetic(struct mpm *mpm)
{
    if (mpm->sums.kinetic <= mpm->previous_kinetic) {
        for (int a = 0; a < 3; a++)
            for (int32_t p = 0; p < mpm->cells->count; p++)
                mpm->store->real[COLUMN_VELOCITY][a][p] = 0;
        mpm->removed_energy += mpm->sums.kinetic;
        mpm->sums.kinetic = 0;
    }
    mpm->previous_kinetic = mpm->sums.kinetic;
}

void mpm_step(struct mpm *mpm)
{
    if (!mpm->scene->finds_equilibrium && building_step(mpm, mpm->step + 1))
        mpm->time_step = mpm_stable_step(mpm, mpm->sums.fastest);
    const int32_t blocks = mpm->cells->active, frozen_from = mpm->cells->in_cells;
    const struct sums before = mpm->sums;
    const double work_before = mpm->external_work, removed_before = mpm->removed_energy;
    mpm->step++;
    mpm->updates += mpm->cells->count;
    mpm->time += mpm->time_step;
    mpm->taken_step = mpm->time_step;
    mpm->momentum_factor = mpm->step == 1 ? 0.5 : 1;
    mpm->load_factor = mpm->scene->loading_time > 0 ? fmin(1, mpm->time / mpm->scene->loading_time) : 1;
    mpm_clear_sums(mpm);
    smoothing_start(mpm);
    solve_on_grid(mpm);
    update_velocities(mpm);
    update_stress_last(mpm);
    smoothing_finish(mpm);
    timers_enter(mpm->timers, PHASE_SUMS);
    sum_particles(mpm, blocks);
    if (mpm->scene->lost != LOST_DROP)
        add_particles(mpm, frozen_from, mpm->cells->count, &mpm->sums);
    balance_energy(mpm, &before, work_before, removed_before);
    mpm_watch_energy(mpm);
    mpm_discard_grid(mpm);
    timers_enter(mpm->timers, PHASE_SUMS);
    mpm->time_step = mpm_stable_step(mpm, mpm->sums.fastest);
    if (mpm->damps_kinetic)
        damp_kinetic(mpm);
    timers_enter(mpm->timers, PHASE_OTHER);
}
