/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reproducing kernel particles in motion as a run sees them. */
#include "rkpm/dynamic.h"
#include "run.h"
#include "summary.h"

static void open_solver(struct run *run)
{
    static const int number = 1;
    struct dynamic *dynamic = run->dynamic = rkpm_dynamic_open(run->scene, &run->timers);
    run->store = dynamic->store;
    run->source = (struct result_source){.store = dynamic->store, .body_material = &dynamic->material, .body_material_number = &number,
                                         .n_open = &dynamic->fixed.shown, .shows_closed = run->scene->building.shows_ghosts};
}

static void close_solver(struct run *run)
{
    rkpm_dynamic_close(run->dynamic);
}

static struct instability advance(struct run *run)
{
    return rkpm_dynamic_advance(run->dynamic);
}

static void look(struct run *run)
{
    const struct dynamic *dynamic = run->dynamic;
    const struct dynamic_sums *sums = &dynamic->sums;
    const int axis = dynamic->words->dynamic.wall == RKPM_WALL_NONE ? 1 : dynamic->words->dynamic.wall_axis;
    double *value = run->totals.value;
    run->course = (struct run_course){dynamic->step, dynamic->time, dynamic->time_step, 0};
    run->totals.time = dynamic->time;
    value[TOTAL_KINETIC] = sums->kinetic;
    value[TOTAL_INTERNAL] = sums->internal;
    for (int a = 0; a < 3; a++) {
        value[TOTAL_MOMENTUM_X + a] = sums->momentum[a];
        value[TOTAL_CENTRE_X + a] = sums->centre[a];
        value[TOTAL_MEAN_VELOCITY_X + a] = sums->momentum[a] / (dynamic->mass * (double)dynamic->count);
    }
    value[TOTAL_WIDTH] = sums->high[0] - sums->low[0] + dynamic->spacing;
    value[TOTAL_TOP] = sums->high[axis] + 0.5 * dynamic->spacing;
    value[TOTAL_BOTTOM] = sums->low[axis] - 0.5 * dynamic->spacing;
    value[TOTAL_ANGULAR] = sums->angular;
    value[TOTAL_TURN] = sums->turn;
    value[TOTAL_LEAST_RATIO] = sums->least_ratio;
    value[TOTAL_MOST_RATIO] = sums->most_ratio;
    value[TOTAL_WALL_FORCE] = sums->wall_force;
    value[TOTAL_WALL_ENERGY] = sums->wall_energy;
    value[TOTAL_FEW_NEIGHBOURS] = (double)sums->few_neighbours;
}

static void show(struct run *run)
{
    rkpm_dynamic_show(run->dynamic);
}

static bool goes_on(const struct run *run)
{
    return run->dynamic->step == 0 || run->dynamic->time <= run->scene->end_time;
}

static void exchange(struct run *run, struct checkpoint *checkpoint)
{
    rkpm_dynamic_exchange(run->dynamic, checkpoint);
}

static double updates(const struct run *run)
{
    return run->dynamic->updates;
}

const struct method method_dynamic = {
    .name = "rkpm",
    .open = open_solver,
    .close = close_solver,
    .advance = advance,
    .look = look,
    .show = show,
    .goes_on = goes_on,
    .exchange = exchange,
    .print_scene = summary_dynamic_check,
    .print_start = summary_dynamic_start,
    .print_instability = summary_dynamic_instability,
    .print_end = summary_dynamic_end,
    .updates = updates,
};
