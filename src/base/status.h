/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exit codes of the program, and messages to the terminal. */
#ifndef BASE_STATUS_H
#define BASE_STATUS_H

enum status {
    STATUS_FINISHED = 0,
    STATUS_USAGE = 1,        /* wrong command line */
    STATUS_DECK = 2,         /* the deck is wrong */
    STATUS_UNSTABLE = 3,     /* the run went unstable */
    STATUS_FILE = 4,         /* a file could not be read or written, or memory ran out */
    STATUS_INTERRUPTED = 130 /* stopped by a signal, after a summary */
};

/* Prints "mpm3d: error: ..." and a line end to standard error. */
void status_error(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Prints "mpm3d: warning: ..." and a line end to standard error. */
void status_warning(const char *format, ...) __attribute__((format(printf, 1, 2)));

#endif
