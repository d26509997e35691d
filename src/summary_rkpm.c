/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a run on reproducing kernel particles says at its start and end. */
#include "summary.h"
#include "account.h"
#include "rkpm/rkpm.h"

static void print_box(const struct rkpm *rkpm, const struct rkpm_level *level, FILE *stream)
{
    fprintf(stream, "%zu nodes:", level->count);
    for (int a = 0; a < level->box.dimension; a++)
        fprintf(stream, "%s%ld", a == 0 ? " " : " x ", level->box.numbers[a]);
    for (int a = 0; a < level->box.dimension; a++)
        fprintf(stream, "%s%.6g", a == 0 ? ", spacing " : " ", level->box.spacing[a]);
    const bool has_body = scene_rkpm_has_body(rkpm->words);
    static const char *const iterations[] = {[SOLVER_CONJUGATE] = ", solved by conjugate gradients",
                                             [SOLVER_BICGSTAB] = ", solved by stabilised biconjugate gradients"};
    const struct solver *solver = rkpm->words->problem == PROBLEM_CREEP ? rkpm->creep.solver : &level->solver;
    if (rkpm->words->problem != PROBLEM_APPROXIMATION)
        fprintf(stream, "; %d unknowns, matrix of %.0f bytes at most%s", has_body ? solver_unknowns(solver) : level->system.count,
                has_body ? solver->bytes : level->system.bytes, has_body && solver_iterates(solver) ? iterations[solver->kind] : "");
    fprintf(stream, "\n");
}

void summary_rkpm_check(const struct run *run, FILE *stream)
{
    const struct rkpm *rkpm = run->rkpm;
    for (size_t i = 0; i < rkpm->n_levels; i++)
        print_box(rkpm, &rkpm->levels[i], stream);
    fprintf(stream, "Gauss points per cell and axis: ");
    if (rkpm->words->problem != PROBLEM_APPROXIMATION && rkpm->words->integration == INTEGRATION_GAUSS)
        fprintf(stream, "%d, ", rkpm->gauss);
    fprintf(stream, "of norms %d\n", rkpm->norm_gauss);
}

void summary_rkpm_start(const struct run *run, FILE *stream)
{
    fprintf(stream, "\n");
    summary_rkpm_check(run, stream);
    account_columns(run->rkpm->store, stream);
    fprintf(stream, "\n");
}

void summary_rkpm_instability(const struct run *run, const struct instability *instability, FILE *stream)
{
    const struct rkpm *rkpm = run->rkpm;
    fprintf(stream, "mpm3d: the run is stopped with %zu nodes: %s\n", rkpm->levels[rkpm->words->problem == PROBLEM_CREEP ? 0 : rkpm->step - 1].count, instability->cause);
    fprintf(stream, "       %s; the output up to the step before is kept\n", instability->advice);
}

/* Errors of all levels, with their orders between levels. */
static void print_errors(const struct rkpm *rkpm, FILE *stream)
{
    fprintf(stream, "      nodes     along x      spacing     L2 error    order     H1 error    order\n");
    for (long i = 0; i < rkpm->step; i++) {
        const struct rkpm_level *level = &rkpm->levels[i];
        const struct rkpm_result *result = &level->result;
        fprintf(stream, "  %9zu   %9ld   %10.4e   %10.6e", level->count, level->box.numbers[0], level->box.spacing[0], result->l2);
        fprintf(stream, i == 0 ? "        " : "  %6.3f", result->l2_rate);
        fprintf(stream, "   %10.6e", result->h1);
        fprintf(stream, i == 0 ? "\n" : "  %6.3f\n", result->h1_rate);
    }
}

void summary_rkpm_end(const struct run *run, double seconds, enum status status, FILE *stream)
{
    const struct rkpm *rkpm = run->rkpm;
    long enlarged = 0, lowered = 0, given_up = 0;
    summary_timers(rkpm->updates, &run->timers, seconds, stream);
    const bool is_creep = rkpm->words->problem == PROBLEM_CREEP;
    const long levels = is_creep ? 1 : rkpm->step;
    if (!is_creep)
        print_errors(rkpm, stream);
    for (long i = 0; i < levels; i++) {
        enlarged += rkpm->levels[i].result.enlarged;
        lowered += rkpm->levels[i].result.lowered;
        given_up += rkpm->levels[i].solver.has_given_up;
    }
    if (given_up > 0)
        fprintf(stream, "the iteration did not get there in %ld of the problems: solved by elimination\n", given_up);
    fprintf(stream, is_creep ? "%s after %ld of %zu steps: " : "%s after %ld of %zu problems: ", summary_ending(status), rkpm->step, is_creep ? rkpm->creep.n_steps : rkpm->n_levels);
    if (enlarged == 0 && lowered == 0)
        fprintf(stream, "no point had too few nodes\n");
    else
        fprintf(stream, "too few nodes: supports were enlarged at %ld points, the order was lowered at %ld\n", enlarged, lowered);
}
