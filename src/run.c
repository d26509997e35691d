/* SPDX-License-Identifier: GPL-3.0-or-later */
#define _POSIX_C_SOURCE 200809L
#include "run.h"
#include "base/memory.h"
#include "base/threads.h"
#include "deck/echo.h"
#include "deck/reader.h"
#include "output/animation.h"
#include "restart.h"
#include "summary.h"
#include "version.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* --- reading --- */

/* Name of the output files: the deck's name without folder and without a final ".mpm". */
static char *job_name(const char *deck)
{
    const char *slash = strrchr(deck, '/');
    const char *name = strcmp(deck, "-") == 0 ? "stdin" : slash ? slash + 1 : deck;
    size_t length = strlen(name);
    if (length > 4 && strcmp(name + length - 4, ".mpm") == 0)
        length -= 4;
    return memory_text(name, length);
}

/* Opens the deck; like the reference's, its name may be given without ".mpm". */
static int include_deck(struct run *run)
{
    int failure = text_include_file(run->text, run->options.deck);
    if (failure != ENOENT)
        return failure;
    size_t size = strlen(run->options.deck) + 5;
    char *path = memory_array(size, 1, "a file name");
    snprintf(path, size, "%s.mpm", run->options.deck);
    failure = text_include_file(run->text, path);
    memory_free(path);
    return failure;
}

static void print_diagnostics(struct run *run)
{
    bool colour = isatty(STDERR_FILENO) && !getenv("NO_COLOR");
    diagnostics_print(run->diagnostics, run->text, stderr, colour);
}

static enum status read_deck(struct run *run)
{
    run->diagnostics = diagnostics_open();
    run->text = text_open(run->diagnostics);
    int failure = include_deck(run);
    if (failure) {
        status_error("cannot read '%s': %s", run->options.deck, strerror(failure));
        return STATUS_FILE;
    }
    run->scene = reader_read(run->text, run->diagnostics);
    run->scene->job = job_name(run->options.deck);
    print_diagnostics(run);
    return diagnostics_errors(run->diagnostics) > 0 ? STATUS_DECK : STATUS_FINISHED;
}

static enum status build(struct run *run)
{
    run->method = method_of(scene_method(run->scene));
    run->method->open(run);
    run->method->look(run);
    run->is_shown = memory_array(run->scene->writes_animation ? run->store->count : 0, 1, "output");
    vtk_open(&run->vtk, run->options.folder, run->scene->job);
    print_diagnostics(run);
    return diagnostics_errors(run->diagnostics) > 0 ? STATUS_DECK : STATUS_FINISHED;
}

/* --- output --- */

/* The files of a run that goes on are there. */
static enum table_mode mode_of(const struct run *run)
{
    return run->options.restart ? TABLE_CONTINUED : TABLE_NEW;
}

/* Opens the table "job" + ending in the folder of the run. */
static bool open_table(struct run *run, struct table *table, const char *ending)
{
    return table_open_job(table, run->options.folder, run->scene->job, ending,
                          (struct table_style){(int)run->scene->digits, run->scene->bare_headers}, mode_of(run));
}

static enum status open_log(struct run *run)
{
    struct table table = {0};
    bool good = open_table(run, &table, ".out");
    run->log = table.stream;
    run->log_path = table.path;
    return good ? STATUS_FINISHED : STATUS_FILE;
}

static bool open_tables(struct run *run)
{
    const struct scene *scene = run->scene;
    bool good = open_log(run) == STATUS_FINISHED
             && (run->method->is_static || history_open(&run->history, scene, run->options.folder, mode_of(run)))
             && (!run->method->write_errors || open_table(run, &run->errors, "_error.dat"))
             && (!scene->writes_animation || open_table(run, &run->animation, "_anim.dat"))
             && (!scene->writes_lost || open_table(run, &run->lost, "_lost.dat"));
    if (good && scene->writes_animation)
        table_by_zones(&run->animation);
    if (good && scene->writes_lost)
        table_by_lines(&run->lost);
    return good;
}

static enum status open_output(struct run *run)
{
    const char *folder = run->options.folder;
    if (*folder && mode_of(run) == TABLE_NEW && mkdir(folder, 0777) != 0 && errno != EEXIST) {
        status_error("cannot create the folder '%s': %s", folder, strerror(errno));
        return STATUS_FILE;
    }
    run->has_output = true;
    return open_tables(run) ? STATUS_FINISHED : STATUS_FILE;
}

/* Marks the particles that the animation file shows: those that had a cell in this step (all of
 * them at the start), created inside the pt2d box of their body. */
static void mark_shown(struct run *run)
{
    const struct store *store = run->store;
    const double *const x[3] = {store->real[COLUMN_POSITION][0], store->real[COLUMN_POSITION][1],
                                store->real[COLUMN_POSITION][2]};
    if (run->dumps == 0)
        for (size_t p = 0; p < store->count; p++) {
            const struct scene_body *body = run->scene->n_bodies > 0 ? &run->scene->bodies[store->integer[COLUMN_BODY][p]] : NULL;
            bool is_in = true;
            for (int a = 0; a < 3 && body && body->has_plot_box; a++)
                is_in = is_in && x[a][p] >= body->plot_box[2 * a] && x[a][p] <= body->plot_box[2 * a + 1];
            run->is_shown[store->integer[COLUMN_ID][p]] = is_in;
        }
    if (run->method->hide_lost)
        run->method->hide_lost(run);
}

/* What output reads of particles, as far as steps don't keep it. */
static void bring_up_to_date(struct run *run)
{
    if (run->method->show)
        run->method->show(run);
}

static enum status write_dump(struct run *run)
{
    bool good = true;
    bring_up_to_date(run);
    if (run->scene->writes_animation) {
        mark_shown(run);
        good = animation_zone(&run->animation, run->scene, &run->source, run->is_shown, run->course.time);
    }
    if (run->scene->writes_vtk)
        good = vtk_write(&run->vtk, run->scene, &run->source, run->course.time) && good;
    run->dumps++;
    fprintf(run->log, "Write output data at time %.6E\n", run->course.time);
    good = (run->method->is_static || history_flush(&run->history)) && good;
    if (fflush(run->log) != 0) {
        status_error("cannot write '%s': %s", run->log_path, strerror(errno));
        good = false;
    }
    return good ? STATUS_FINISHED : STATUS_FILE;
}

static void write_report_line(struct run *run)
{
    const struct history_totals *totals = &run->totals;
    fprintf(run->log, " Step=%6ld   T=%10.3E   DT=%10.3E   K.E.=%10.3E  T.E.=%10.3E\n", run->course.step, run->course.time,
            run->course.time_step, totals->value[TOTAL_KINETIC], totals->value[TOTAL_KINETIC] + totals->value[TOTAL_INTERNAL]);
    fprintf(run->log, "              Mx=%10.3E   My=%10.3E   Mz=%10.3E\n", totals->value[TOTAL_MOMENTUM_X],
            totals->value[TOTAL_MOMENTUM_Y], totals->value[TOTAL_MOMENTUM_Z]);
}

/* Lists the particles that left the grid since the last call. */
static void write_lost(struct run *run)
{
    const struct store *store = run->store;
    for (; run->known_lost < run->course.lost; run->known_lost++) {
        const int32_t p = run->method->lost_particle(run, run->known_lost);
        table_real(&run->lost, run->course.time);
        fprintf(run->lost.stream, " %9d", store->integer[COLUMN_ID][p] + 1);
        for (int a = 0; a < 3; a++)
            table_real(&run->lost, store->real[COLUMN_POSITION][a][p]);
        for (int a = 0; a < 3; a++)
            table_real(&run->lost, store->real[COLUMN_VELOCITY][a][p]);
        table_end_line(&run->lost);
    }
}

/* What the files of a new run begin with. */
static enum status start_output(struct run *run)
{
    const struct scene *scene = run->scene;
    run->is_under_way = true;
    if (scene->writes_vtk && run->method->has_grid && !vtk_write_grid(&run->vtk, scene))
        return STATUS_FILE;
    if (scene->writes_animation)
        animation_header(&run->animation, scene);
    if (scene->writes_lost) {
        fprintf(run->lost.stream, "VARIABLES = \"Time\" \"id\" \"X\" \"Y\" \"Z\" \"velx\" \"vely\" \"velz\"\n");
        write_lost(run);
    }
    if (run->method->start_errors)
        run->method->start_errors(run);
    fprintf(run->log, "! mpm3d %s: the deck as understood; it can be run again\n", VERSION);
    echo_scene(scene, run->log, scene->n_particles <= 20000);
    run->method->print_start(run, run->log);
    run->next_output = (float)scene->output_interval;
    return write_dump(run);
}

static enum status continue_output(struct run *run)
{
    enum status status = restart_continue(run);
    run->is_under_way = status == STATUS_FINISHED;
    return status;
}

/* --- the run --- */

/* Where nothing else is said, the files of a run that goes on are beside its checkpoint. */
static void choose_folder(struct run *run)
{
    const char *path = run->options.restart, *slash = path ? strrchr(path, '/') : NULL;
    if (run->options.folder)
        return;
    run->restart_folder = slash ? memory_text(path, slash == path ? 1 : (size_t)(slash - path)) : NULL;
    run->options.folder = slash ? run->restart_folder : "";
}

enum status run_open(struct run *run, const struct run_options *options)
{
    *run = (struct run){.options = *options, .checkpoint_step = -1};
    run->started = threads_clock();
    timers_start(&run->timers);
    choose_folder(run);
    enum status status = read_deck(run);
    if (status == STATUS_FINISHED)
        status = build(run);
    if (status == STATUS_FINISHED && options->reference)
        status = reference_open(&run->reference, options->reference, run->scene);
    if (status == STATUS_FINISHED && options->restart)
        status = restart_read(run);
    if (status != STATUS_FINISHED || options->only_check)
        return status;
    timers_enter(&run->timers, PHASE_OUTPUT);
    status = open_output(run);
    if (status == STATUS_FINISHED)
        status = options->restart ? continue_output(run) : start_output(run);
    timers_enter(&run->timers, PHASE_OTHER);
    progress_open(&run->progress, !options->quiet, run->course.time, run->scene->end_time);
    return status;
}

bool run_goes_on(const struct run *run)
{
    return run->method->goes_on(run);
}

/* The lines of this step, and the dump when it is due. The reference counts output times in
 * single precision; so does this (spec 5). */
static enum status write_step(struct run *run)
{
    const double time = run->course.time;
    enum status status = STATUS_FINISHED;
    if (run->method->write_errors && !run->method->write_errors(run))
        return STATUS_FILE;
    if (!run->method->is_static)
        history_step(&run->history, run->scene, &run->source, &run->totals);
    if (run->scene->writes_lost)
        write_lost(run);
    if (time >= (double)run->next_report && !run->method->is_static) {
        run->next_report = (float)((double)run->next_report + run->scene->report_interval);
        write_report_line(run);
    }
    const bool is_due = time >= (double)run->next_output;
    if (is_due || (run->method->has_ended && run->method->has_ended(run))) {
        if (is_due)
            run->next_output = (float)((double)run->next_output + run->scene->output_interval);
        status = write_dump(run);
    }
    return status;
}

/* Whether a checkpoint is to be written after a step that began at time `before`, or after the last one. */
static bool is_checkpoint_due(const struct run *run, double before)
{
    const struct scene *scene = run->scene;
    if (scene->restart_steps == 0 && scene->restart_interval == 0)
        return false;
    if (!run_goes_on(run))
        return true;
    if (scene->restart_steps > 0)
        return run->course.step % scene->restart_steps == 0;
    return floor(run->course.time / scene->restart_interval) > floor(before / scene->restart_interval);
}

enum status run_interrupt(struct run *run)
{
    enum status status = restart_write(run);
    return status == STATUS_FINISHED ? STATUS_INTERRUPTED : status;
}

enum status run_step(struct run *run)
{
    const double before = run->course.time;
    struct instability instability = run->method->advance(run);
    run->method->look(run);
    if (instability.is_stopped) {
        if (run->scene->writes_lost)
            write_lost(run);
        bring_up_to_date(run);
        progress_close(&run->progress);
        run->method->print_instability(run, &instability, stderr);
        run->method->print_instability(run, &instability, run->log);
        return STATUS_UNSTABLE;
    }
    timers_enter(&run->timers, PHASE_OUTPUT);
    enum status status = write_step(run);
    if (status == STATUS_FINISHED && is_checkpoint_due(run, before))
        status = restart_write(run);
    progress_show(&run->progress, run->course.step, run->course.time, run->scene->end_time);
    timers_enter(&run->timers, PHASE_OTHER);
    return status;
}

/* Closes the files; false when one could not be completed. */
static bool close_output(struct run *run)
{
    bool good = true;
    if (run->animation.stream || run->animation.path)
        good = table_close(&run->animation);
    if (run->lost.path)
        good = table_close(&run->lost) && good;
    if (run->errors.path)
        good = table_close(&run->errors) && good;
    good = history_close(&run->history) && good;
    if (run->log && (ferror(run->log) | fclose(run->log)) != 0) {
        status_error("cannot write '%s': %s", run->log_path, strerror(errno));
        good = false;
    }
    memory_free(run->log_path);
    return good;
}

/* The error of the last state, beside what it took, to the terminal and the log. */
static enum status print_error(struct run *run, double seconds)
{
    FILE *const streams[] = {run->log, stdout};
    enum status status = STATUS_FINISHED;
    bring_up_to_date(run);
    mark_shown(run);
    for (int i = 0; i < 2 && status == STATUS_FINISHED; i++) {
        status = reference_print(&run->reference, run->scene, &run->source, run->is_shown, run->course.time, streams[i]);
        if (status == STATUS_FINISHED)
            summary_cost(&run->course, run->method->updates(run), &run->timers, seconds, streams[i]);
    }
    if (fflush(stdout) != 0) {
        status_error("cannot write the error: %s", strerror(errno));
        status = STATUS_FILE;
    }
    return status;
}

/* How to go on with a run that was interrupted. */
static void print_way_on(const struct run *run, FILE *stream)
{
    char *path = restart_path(run);
    fprintf(stream, "to go on: mpm3d --restart %s %s\n", path, run->options.deck);
    memory_free(path);
}

enum status run_close(struct run *run, enum status status)
{
    progress_close(&run->progress);
    if (run->is_under_way) {
        timers_enter(&run->timers, PHASE_OTHER);
        double seconds = threads_clock() - run->started;
        run->method->print_end(run, seconds, status, run->log);
        if (!run->options.quiet)
            run->method->print_end(run, seconds, status, stderr);
        if (status == STATUS_FINISHED && run->method->print_doubt) {
            run->method->print_doubt(run, run->log);
            run->method->print_doubt(run, stderr);
        }
        if (status == STATUS_FINISHED && run->options.reference)
            status = print_error(run, seconds);
        if (status == STATUS_INTERRUPTED)
            print_way_on(run, run->log);
        if (status == STATUS_INTERRUPTED && !run->options.quiet)
            print_way_on(run, stderr);
    }
    if (run->has_output && !close_output(run) && status == STATUS_FINISHED)
        status = STATUS_FILE;
    reference_close(&run->reference);
    memory_free(run->is_shown);
    memory_free(run->restart_folder);
    vtk_close(&run->vtk);
    if (run->method)
        run->method->close(run);
    scene_close(run->scene);
    text_close(run->text);
    diagnostics_close(run->diagnostics);
    return status;
}
