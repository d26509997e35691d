/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The material point method as a run sees it. */
#include "mpm/equilibrium.h"
#include "mpm/mpm.h"
#include "run.h"
#include "summary.h"

#include <math.h>

static void open_solver(struct run *run)
{
    struct mpm *mpm = run->mpm = mpm_open(run->scene, &run->timers, run->diagnostics);
    if (run->options.has_threads)
        mpm_share_always(mpm);
    run->store = mpm->store;
    run->source = (struct result_source){mpm->store, mpm->material_of_body, mpm->material_number_of_body, &mpm->cells->count,
                                         run->scene->building.shows_ghosts, NULL};
}

static void close_solver(struct run *run)
{
    mpm_close(run->mpm);
}

static void look(struct run *run)
{
    const struct mpm *mpm = run->mpm;
    run->course = (struct run_course){mpm->step, mpm->time, mpm->time_step, mpm->cells->count - mpm->cells->in_cells};
    run->totals.time = mpm->time;
    run->totals.value[TOTAL_KINETIC] = mpm->sums.kinetic;
    run->totals.value[TOTAL_INTERNAL] = mpm->sums.internal;
    for (int a = 0; a < 3; a++) {
        run->totals.value[TOTAL_MOMENTUM_X + a] = mpm->sums.momentum[a];
        run->totals.contact[a] = mpm->contact_force[a];
    }
}

/* An equilibrium instead of a time step: counted in time, told in the log. */
static struct instability equilibrate(struct run *run)
{
    const long due = building_next_step(run->mpm);
    if (due > 0)
        building_step(run->mpm, due);
    run->mpm->smooths = store_has(run->mpm->store, COLUMN_SMOOTHED_PRESSURE);
    run->mpm->time += 1;
    mpm_equilibrate(run->mpm);
    if (equilibrium_report(run->mpm)->floating > 0 && !run->has_told_floating) {
        run->has_told_floating = 1;
        summary_floating(run->mpm, stderr);
        summary_floating(run->mpm, run->log);
    }
    summary_equilibrium(run->mpm, run->log);
    return equilibrium_check(run->mpm);
}

static struct instability advance(struct run *run)
{
    run->lost_before_step = run->mpm->cells->count - run->mpm->cells->in_cells;
    if (run->scene->finds_equilibrium)
        return equilibrate(run);
    run->mpm->smooths = store_has(run->mpm->store, COLUMN_SMOOTHED_PRESSURE)
                     && (run->mpm->time + run->mpm->time_step >= (double)run->next_output
                         || building_has_settled(run->mpm, run->mpm->step + 1));
    mpm_step(run->mpm);
    return mpm_check(run->mpm);
}

/* Whether particles are still to open, or a hot zone is to cool, before the run ends. */
static bool opens_more(const struct run *run)
{
    const long next = building_next_step(run->mpm);
    return next > 0 && !building_has_settled(run->mpm, next - 1);
}

/* Whether the last step ended the run for another reason than the end time; its state is written. */
static bool has_ended(const struct run *run)
{
    if (run->scene->finds_equilibrium)
        return !opens_more(run);
    return building_has_settled(run->mpm, run->mpm->step);
}

static bool goes_on(const struct run *run)
{
    const struct scene *scene = run->scene;
    const struct sums *sums = &run->mpm->sums;
    if (scene->finds_equilibrium)
        return run->mpm->step == 0 || opens_more(run);
    if (scene->building.settling >= 0)
        return !has_ended(run);
    double time = run->mpm->time, least = fmax(scene->end_time, scene->settling[0]);
    if (run->mpm->step == 0 || time <= scene->end_time)
        return true;
    if (scene->loading_time == 0)
        return false;
    double latest = scene->settling[1] > 0 ? scene->settling[1] : 10 * least;
    bool is_at_rest = sums->kinetic / (sums->kinetic + sums->internal) < 0.005 && time > scene->settling[0];
    return !is_at_rest && time <= latest;
}

static void hide_lost(struct run *run)
{
    const struct cell_list *cells = run->mpm->cells;
    for (int32_t k = cells->count - run->lost_before_step; k < cells->count; k++)
        run->is_shown[run->store->integer[COLUMN_ID][cells->order[k]]] = 0;
}

/* Those that left stand at the end of the order, the first one last. */
static int32_t lost_particle(const struct run *run, int32_t n)
{
    const struct cell_list *cells = run->mpm->cells;
    return cells->order[cells->count - 1 - n];
}

static void exchange(struct run *run, struct checkpoint *checkpoint)
{
    mpm_exchange(run->mpm, checkpoint);
}

static double updates(const struct run *run)
{
    return run->mpm->updates;
}

const struct method method_mpm = {
    .name = "mpm",
    .has_grid = true,
    .open = open_solver,
    .close = close_solver,
    .advance = advance,
    .look = look,
    .goes_on = goes_on,
    .has_ended = has_ended,
    .hide_lost = hide_lost,
    .lost_particle = lost_particle,
    .exchange = exchange,
    .print_scene = summary_check,
    .print_start = summary_start,
    .print_instability = summary_instability,
    .print_end = summary_end,
    .print_doubt = summary_doubt,
    .updates = updates,
};

const struct method *method_of(enum method_name name)
{
    static const struct method *const rows[] = {[METHOD_MPM] = &method_mpm, [METHOD_SPH] = &method_sph, [METHOD_RKPM] = &method_rkpm,
                                              [METHOD_DYNAMIC] = &method_dynamic};
    return rows[name];
}
