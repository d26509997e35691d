/* SPDX-License-Identifier: GPL-3.0-or-later */
#define _POSIX_C_SOURCE 200809L
#include "output/progress.h"
#include "base/threads.h"

#include <stdio.h>
#include <unistd.h>

static const double INTERVAL = 0.2;

static double part_done(double time, double end_time)
{
    double done = end_time > 0 ? time / end_time : 1;
    return done > 1 ? 1 : done;
}

void progress_open(struct progress *progress, bool wanted, double time, double end_time)
{
    *progress = (struct progress){.is_on = wanted && isatty(STDERR_FILENO), .from = part_done(time, end_time)};
    progress->started = progress->shown = threads_clock();
}

void progress_show(struct progress *progress, long step, double time, double end_time)
{
    if (!progress->is_on)
        return;
    double now = threads_clock();
    if (now - progress->shown < INTERVAL)
        return;
    progress->shown = now;
    double done = part_done(time, end_time), gained = done - progress->from;
    double left = gained > 0 ? (now - progress->started) * (1 - done) / gained : 0;
    fprintf(stderr, "\r%3.0f %%  step %ld  time %.4g of %.4g  about %.0f s left   ", 100 * done, step, time, end_time, left);
    fflush(stderr);
}

void progress_close(struct progress *progress)
{
    if (progress->is_on)
        fprintf(stderr, "\r%78s\r", "");
    progress->is_on = false;
}
