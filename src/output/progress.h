/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The progress line, on terminals only. */
#ifndef OUTPUT_PROGRESS_H
#define OUTPUT_PROGRESS_H

#include <stdbool.h>

struct progress {
    bool is_on;
    double started, shown; /* clock */
    double from;           /* part of the run that was done at the start */
};

/* Switches the line on when standard error is a terminal and `wanted`. The run starts at `time`. */
void progress_open(struct progress *progress, bool wanted, double time, double end_time);

/* Shows step, time and remaining time, a few times a second. */
void progress_show(struct progress *progress, long step, double time, double end_time);

/* Clears the line. */
void progress_close(struct progress *progress);

#endif
