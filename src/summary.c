/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "summary.h"
#include "account.h"
#include "base/threads.h"
#include "process/schedule.h"
#include "mpm/equilibrium.h"

#include <math.h>

enum { SHOWN_LOST = 10 };

void summary_check(const struct run *run, FILE *stream)
{
    const struct mpm *mpm = run->mpm;
    const struct cell_frame *frame = &mpm->cells->frame;
    fprintf(stream, "%zu particles in %zu bodies, %zu materials\n", mpm->store->count, mpm->scene->n_bodies,
            mpm->scene->n_materials);
    fprintf(stream, "grid of %d x %d x %d cells of %g; %d blocks of 4 x 4 x 4 hold particles\n", frame->cells[0],
            frame->cells[1], frame->cells[2], frame->size, mpm->cells->active);
    if (mpm->scene->finds_equilibrium) {
        fprintf(stream, "static equilibrium to %g of the unbalanced forces, in %ld Newton steps at most\n",
                mpm->scene->equilibrium_tolerance, mpm->scene->equilibrium_steps);
        return;
    }
    fprintf(stream, "first time step %.6E, about %.0f steps to the end\n", mpm->first_time_step,
            ceil(mpm->scene->end_time / mpm->first_time_step));
}

void summary_start(const struct run *run, FILE *stream)
{
    const struct mpm *mpm = run->mpm;
    fprintf(stream, "\n");
    summary_check(run, stream);
    account_print(mpm, stream);
    fprintf(stream, "mass cutoff of the nodes %.6E\n", mpm->scene->mass_cutoff);
    fprintf(stream, "kinetic energy %.9E, internal energy %.9E\n\n", mpm->sums.kinetic, mpm->sums.internal);
}

/* A particle that went wrong: where it is, in which cell, of which law. */
static void print_particle(const struct mpm *mpm, long id, FILE *stream)
{
    const struct store *store = mpm->store;
    const struct cell_frame *frame = &mpm->cells->frame;
    const size_t p = (size_t)store->index_of_id[id];
    const int32_t body = store->integer[COLUMN_BODY][p];
    fprintf(stream, "       particle %ld of body %d, law %s, at (%.6g, %.6g, %.6g), velocity (%.6g, %.6g, %.6g), ", id + 1, body + 1,
            mpm->material_of_body[body]->law->name, store->real[COLUMN_POSITION][0][p], store->real[COLUMN_POSITION][1][p],
            store->real[COLUMN_POSITION][2][p], store->real[COLUMN_VELOCITY][0][p], store->real[COLUMN_VELOCITY][1][p],
            store->real[COLUMN_VELOCITY][2][p]);
    double cell[3];
    bool is_inside = true;
    for (int a = 0; a < 3; a++) {
        const double x = store->real[COLUMN_POSITION][a][p];
        cell[a] = fmin(floor((x - frame->low[a]) / frame->size) + 1, frame->cells[a]);
        is_inside = is_inside && x >= frame->low[a] && x <= frame->high[a];
    }
    if (is_inside)
        fprintf(stream, "cell %.0f %.0f %.0f\n", cell[0], cell[1], cell[2]);
    else
        fprintf(stream, "outside the grid\n");
}

void summary_instability(const struct run *run, const struct instability *instability, FILE *stream)
{
    const struct mpm *mpm = run->mpm;
    fprintf(stream, "mpm3d: the run is stopped at step %ld, time %.6E: %s\n", mpm->step, mpm->time,
            instability->cause);
    if (instability->particle >= 0)
        print_particle(mpm, instability->particle, stream);
    fprintf(stream, "       %s; the output up to the step before is kept\n", instability->advice);
}

void summary_floating(const struct mpm *mpm, FILE *stream)
{
    const struct equilibrium_report *report = equilibrium_report(mpm);
    fprintf(stream, "mpm3d: warning: body %d floats freely: %d rigid motions are taken out, its centre and orientation stay",
            report->floating_body + 1, report->floating_motions);
    if (report->floating > 1)
        fprintf(stream, " (%ld parts float)", report->floating);
    fprintf(stream, "\n");
}

void summary_equilibrium(const struct mpm *mpm, FILE *stream)
{
    const struct equilibrium_report *report = equilibrium_report(mpm);
    bool is_found = report->state == EQUILIBRIUM_FOUND;
    fprintf(stream, "%s at time %.6E: residual %.1e of the forces, %ld Newton steps, %ld iterations",
            is_found ? "equilibrium found" : "no equilibrium found", mpm->time, report->residual, report->newton_steps,
            report->iterations);
    if (report->damped_steps > 0)
        fprintf(stream, ", then %ld steps with kinetic damping", report->damped_steps);
    if (report->kept_particles > 0)
        fprintf(stream, "; %ld particles, up to %.1e cells beyond the face of a cell, still counted for it", report->kept_particles,
                report->kept_distance);
    fprintf(stream, "\n");
    if (!is_found && report->newton_steps > 0)
        fprintf(stream, "largest unbalanced force at the node (%.6g, %.6g, %.6g)\n", report->worst[0], report->worst[1],
                report->worst[2]);
}

/* What the linear systems of quas took. */
static void print_systems(const struct mpm *mpm, FILE *stream)
{
    long applications;
    double seconds;
    equilibrium_cost(mpm, &applications, &seconds);
    fprintf(stream, "  the stiffness was applied %ld times, with all that belongs to it %.2f ns per particle\n\n", applications,
            applications > 0 ? 1e9 * seconds / ((double)applications * (double)mpm->store->count) : 0);
}

/* Nanoseconds per particle-step without output. */
static double solver_cost(double updates, const struct timers *timers, double seconds)
{
    double solver = seconds - timers->seconds[PHASE_OUTPUT] - timers->seconds[PHASE_OTHER];
    return 1e9 * solver / (updates > 0 ? updates : 1);
}

void summary_cost(const struct run_course *course, double updates, const struct timers *timers, double seconds, FILE *stream)
{
    fprintf(stream, "run time %.6f s, %ld steps, %.2f ns per particle-step without output\n", seconds, course->step,
            solver_cost(updates, timers, seconds));
}

void summary_timers(double updates, const struct timers *timers, double seconds, FILE *stream)
{
    updates = updates > 0 ? updates : 1;
    fprintf(stream, "\n  phase                  seconds       %%   ns per particle-step\n");
    for (int phase = 0; phase < PHASE_COUNT; phase++) {
        double spent = timers->seconds[phase];
        if (spent == 0)
            continue;
        fprintf(stream, "  %-20s %9.3f  %6.1f   %8.2f\n", timers_name((enum phase)phase), spent,
                seconds > 0 ? 100 * spent / seconds : 0, 1e9 * spent / updates);
    }
    fprintf(stream, "  %-20s %9.3f  %6.1f   %8.2f without output, %d threads\n\n", "total", seconds, 100.0,
            solver_cost(updates, timers, seconds), threads_available());
}

static void print_lost(const struct mpm *mpm, FILE *stream)
{
    const struct cell_list *cells = mpm->cells;
    int32_t lost = cells->count - cells->in_cells;
    if (lost == 0) {
        fprintf(stream, "no particle lost");
        return;
    }
    fprintf(stream, "%d particles left the grid and are %s (first ids:", lost,
            mpm->scene->lost == LOST_DROP ? "left out" : "frozen");
    for (int32_t k = cells->in_cells; k < cells->count && k < cells->in_cells + SHOWN_LOST; k++)
        fprintf(stream, " %d", mpm->store->integer[COLUMN_ID][cells->order[k]] + 1);
    int32_t p = cells->order[cells->in_cells];
    fprintf(stream, "%s; the first at %.6g %.6g %.6g)", lost > SHOWN_LOST ? " ..." : "",
            mpm->store->real[COLUMN_POSITION][0][p], mpm->store->real[COLUMN_POSITION][1][p],
            mpm->store->real[COLUMN_POSITION][2][p]);
}

/* Change of momentum relative to the sum of all particles' |m v| scale. */
static double momentum_change(const struct mpm *mpm)
{
    double change = 0, scale = 0, mass = 0;
    for (int32_t p = 0; p < mpm->cells->count; p++)
        mass += mpm->store->real[COLUMN_MASS][0][p];
    for (int a = 0; a < 3; a++) {
        double difference = mpm->sums.momentum[a] - mpm->start_momentum[a];
        change += difference * difference;
    }
    scale = sqrt(2 * mass * fmax(mpm->sums.kinetic, mpm->start_energy));
    return scale > 0 ? sqrt(change) / scale : 0;
}

const char *summary_ending(enum status status)
{
    static const char *const endings[] = {[STATUS_FINISHED] = "finished", [STATUS_UNSTABLE] = "stopped, unstable",
                                          [STATUS_FILE] = "stopped, a file could not be written"};
    return status == STATUS_INTERRUPTED ? "interrupted" : endings[status];
}

void summary_end(const struct run *run, double seconds, enum status status, FILE *stream)
{
    const struct mpm *mpm = run->mpm;
    summary_timers(mpm->updates, &run->timers, seconds, stream);
    if (mpm->equilibrium)
        print_systems(mpm, stream);
    fprintf(stream, "%s after %ld steps at time %.6E: ", summary_ending(status), mpm->step, mpm->time);
    print_lost(mpm, stream);
    if (mpm->scene->finds_equilibrium) /* motion is left out, and with it the balance of its energy */
        fprintf(stream, "\n");
    else
        fprintf(stream, ", energy balance %.1e, momentum change %.1e\n", mpm_energy_error(mpm), momentum_change(mpm));
    const size_t closed = mpm->schedule ? schedule_left(mpm->schedule) : 0;
    if (closed > 0)
        fprintf(stream, "%zu particles are still to open: the run ends before step %ld, that of the last opening\n", closed,
                schedule_last_step(mpm->schedule));
}

void summary_doubt(const struct run *run, FILE *stream)
{
    const struct mpm *mpm = run->mpm;
    if (!mpm->scene->finds_equilibrium && mpm_has_gained_energy(mpm))
        fprintf(stream, "mpm3d: warning: %.0f %% of the energy came from nowhere: do not trust this run; try a smaller dtsc, gimp or "
                "bimp\n", 100 * mpm_energy_error(mpm));
}
