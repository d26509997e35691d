/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checkpoints of a run, and going on from one as if there had been no break: the output files are cut off where
 * they ended at the checkpoint, and continued. */
#ifndef RESTART_H
#define RESTART_H

#include "run.h"

/* Writes the checkpoint "job.rest" into the folder of the run, after bringing its tables to the disk; the one
 * before is kept. STATUS_FILE, after a message, when that fails. */
enum status restart_write(struct run *run);

/* Name of that file; the caller frees it. */
char *restart_path(const struct run *run);

/* Takes the state from the checkpoint of the command line into a run that was just built. Only the end time,
 * the report lines, `rest` and `sort` of the deck may differ from the deck of the checkpoint. STATUS_FILE, after a
 * message, when the file can't be used; no file is changed. */
enum status restart_read(struct run *run);

/* Goes on with the tables of the run, which are open: all of them are looked at before the first is cut.
 * STATUS_FILE, after a message, when one is not that of the checkpoint. */
enum status restart_continue(struct run *run);

#endif
