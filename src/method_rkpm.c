/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Problems on reproducing kernel particles as a run sees them: each level is a step. */
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
    const struct rkpm *rkpm = run->rkpm;
    run->course = (struct run_course){rkpm->step, rkpm->time, 1, 0};
    run->totals.time = rkpm->time;
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

/* --- the table of errors --- */

/* The last step in time. */
static void write_step(struct run *run)
{
    const double values[] = {run->rkpm->time, run->rkpm->load, run->rkpm->tip};
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++)
        table_real(&run->errors, values[i]);
}

/* The last level; what only displacements have. */
static void write_level(struct run *run)
{
    const struct rkpm_level *level = &run->rkpm->levels[run->rkpm->step - 1];
    const struct rkpm_result *result = &level->result;
    const double values[] = {level->box.spacing[0], result->l2, result->h1, result->l2_rate, result->h1_rate, result->l2_relative};
    fprintf(run->errors.stream, " %9zu %6ld", level->count, level->box.numbers[0]);
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++)
        table_real(&run->errors, values[i]);
}

static void write_elastic(struct run *run)
{
    const struct rkpm_result *result = &run->rkpm->levels[run->rkpm->step - 1].result;
    const double values[] = {result->l2_along[0], result->l2_along[1], result->l2_along[2], result->energy, result->tip};
    write_level(run);
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++)
        table_real(&run->errors, values[i]);
}

#define OF_LEVELS "\"n\" \"nx\" \"h\" \"L2\" \"H1\" \"rateL2\" \"rateH1\" \"relL2\""

static const struct error_table {
    const char *names;
    void (*write)(struct run *run);
} tables[] = {
    [PROBLEM_APPROXIMATION] = {OF_LEVELS, write_level},
    [PROBLEM_HELMHOLTZ] = {OF_LEVELS, write_level},
    [PROBLEM_POISSON] = {OF_LEVELS, write_level},
    [PROBLEM_ELASTIC] = {OF_LEVELS " \"L2x\" \"L2y\" \"L2z\" \"energy\" \"tip\"", write_elastic},
    [PROBLEM_CREEP] = {"\"t\" \"load\" \"tip\"", write_step},
};

static void start_table(struct run *run)
{
    fprintf(run->errors.stream, "VARIABLES = %s\n", tables[run->scene->rkpm.problem].names);
}

static bool write_table(struct run *run)
{
    tables[run->scene->rkpm.problem].write(run);
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
