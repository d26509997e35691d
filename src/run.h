/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One run: a deck, its method, its output. All that it owns hangs here, so that several runs can
 * live in one process. */
#ifndef RUN_H
#define RUN_H

#include "base/status.h"
#include "base/timers.h"
#include "deck/diagnostics.h"
#include "method.h"
#include "output/history.h"
#include "output/progress.h"
#include "output/reference.h"
#include "output/vtk.h"

/* What the command line says. */
struct run_options {
    const char *deck;   /* path, or "-" */
    const char *folder; /* of the output files; "" is the present one, NULL that of the checkpoint, else the present one */
    const char *restart; /* checkpoint to go on from, or NULL */
    const char *reference; /* animation file with which the last state is compared, or NULL */
    bool quiet;
    bool has_threads; /* a number of threads was asked for */
    bool only_check;
};

/* How far a run has come. */
struct run_course {
    long step;
    double time, time_step;
    long lost; /* particles that left */
};

struct mpm;
struct sph;
struct rkpm;
struct dynamic;

enum { RUN_TABLES = 8 };

struct run {
    struct run_options options;
    struct diagnostics *diagnostics;
    struct deck_text *text;
    struct scene *scene;
    struct timers timers;
    const struct method *method;
    struct mpm *mpm; /* one of the solvers */
    struct sph *sph;
    struct rkpm *rkpm;
    struct dynamic *dynamic;
    struct store *store; /* its particles */
    struct run_course course;
    struct history_totals totals;
    bool has_output;
    FILE *log;
    char *log_path;
    struct table animation;
    struct table lost; /* particles that left the grid, on request */
    struct table errors; /* against an exact solution, of methods that have them */
    int32_t known_lost;
    int32_t lost_before_step;
    struct history history;
    struct vtk_series vtk;
    struct progress progress;
    struct reference reference;
    struct result_source source;
    unsigned char *is_shown; /* per id, room for the animation */
    float next_output, next_report;
    long dumps;
    int has_told_floating; /* 0, or 1: that free motions of bodies are taken out (quas) */
    double started;
    bool is_under_way;    /* the files are open and at their places */
    char *restart_folder; /* of the checkpoint, where it is also that of the output */
    long checkpoint_step; /* of the last checkpoint; -1: none */
    struct table_mark marks[RUN_TABLES]; /* of the tables at that step */
};

/* Reads the deck, builds the scene and the method, opens the files and writes the start state, or takes the
 * state from a checkpoint and continues its files.
 * Returns STATUS_FINISHED, or why it can't run (messages are printed). Close it in any case. */
enum status run_open(struct run *run, const struct run_options *options);

/* Whether the end time is not passed yet. */
bool run_goes_on(const struct run *run);

/* One step with its output. Anything but STATUS_FINISHED ends the run. */
enum status run_step(struct run *run);

/* Ends the run between two steps, with a checkpoint: STATUS_INTERRUPTED, or STATUS_FILE. */
enum status run_interrupt(struct run *run);

/* Writes the summary and closes the files; `status` says how the run ended. Returns it, or
 * STATUS_FILE when a file could not be completed. */
enum status run_close(struct run *run, enum status status);

#endif
