/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Problems on reproducing kernel particles as a run sees them: each level is a step and counts 1 in time. */
#include "run.h"
#include "rkpm/rkpm.h"
#include "summary.h"

static void open_solver(struct run *run)
{
    static const int number = 1;
    struct rkpm *rkpm = run->rkpm = rkpm_open(run->scene, &run->timers);
    run->store = rkpm->store;
    run->source = (struct result_source){.store = rkpm->store, .body_material_number = &number};
}

static void close_solver(struct run *run)
{
    rkpm_close(run->rkpm);
}

static struct instability advance(struct run *run)
{
    return rkpm_advance(run->rkpm);
}

static void look(struct run *run)
{
    const long step = run->rkpm->step;
    const double time = run->scene->rkpm.problem == PROBLEM_CREEP ? run->rkpm->time : (double)step;
    run->course = (struct run_course){step, time, 1, 0};
    run->totals.time = time;
}

static bool goes_on(const struct run *run)
{
    return rkpm_goes_on(run->rkpm);
}

/* Output comes after the last level or step, whatever single precision makes of its time. */
static bool has_ended(const struct run *run)
{
    return !rkpm_goes_on(run->rkpm);
}

static void exchange(struct run *run, struct checkpoint *checkpoint)
{
    rkpm_exchange(run->rkpm, checkpoint);
}

static void start_table(struct run *run)
{
    const bool is_elastic = run->scene->rkpm.problem == PROBLEM_ELASTIC;
    if (run->scene->rkpm.problem == PROBLEM_CREEP) {
        fprintf(run->errors.stream, "VARIABLES = \"t\" \"load\" \"tip\"\n");
        return;
    }
    fprintf(run->errors.stream, "VARIABLES = \"n\" \"nx\" \"h\" \"L2\" \"H1\" \"rateL2\" \"rateH1\" \"relL2\"%s\n",
            is_elastic ? " \"L2x\" \"L2y\" \"L2z\" \"energy\" \"tip\"" : "");
}

/* The line of the last step in time. */
static bool write_step(struct run *run)
{
    const double values[] = {run->rkpm->time, run->rkpm->load, run->rkpm->tip};
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++)
        table_real(&run->errors, values[i]);
    table_end_line(&run->errors);
    return table_flush(&run->errors);
}

/* The line of the last level. */
static bool write_table(struct run *run)
{
    if (run->scene->rkpm.problem == PROBLEM_CREEP)
        return write_step(run);
    const struct rkpm_level *level = &run->rkpm->levels[run->rkpm->step - 1];
    const struct rkpm_result *result = &level->result;
    const double values[] = {level->box.spacing[0], result->l2, result->h1, result->l2_rate, result->h1_rate,
                             result->l2_relative, result->l2_along[0], result->l2_along[1], result->l2_along[2], result->energy, result->tip};
    const size_t count = run->scene->rkpm.problem == PROBLEM_ELASTIC ? sizeof values / sizeof values[0] : 6;
    fprintf(run->errors.stream, " %9zu %6ld", level->count, level->box.numbers[0]);
    for (size_t i = 0; i < count; i++)
        table_real(&run->errors, values[i]);
    table_end_line(&run->errors);
    return table_flush(&run->errors);
}

static double updates(const struct run *run)
{
    return run->rkpm->updates;
}

const struct method method_rkpm = {
    .name = "rkpm",
    .is_static = true,
    .open = open_solver,
    .close = close_solver,
    .advance = advance,
    .look = look,
    .goes_on = goes_on,
    .has_ended = has_ended,
    .exchange = exchange,
    .start_errors = start_table,
    .write_errors = write_table,
    .print_scene = summary_rkpm_check,
    .print_start = summary_rkpm_start,
    .print_instability = summary_rkpm_instability,
    .print_end = summary_rkpm_end,
    .updates = updates,
};
