/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What of the program a run uses, and the memory of each part. */
#ifndef ACCOUNT_H
#define ACCOUNT_H

#include "mpm/mpm.h"

#include <stdio.h>

/* Columns with their bytes. */
void account_columns(const struct store *store, FILE *stream);

/* The same, the parts in use with theirs (parts that hold nothing but code: none), and one line of the parts
 * that the scene leaves out. */
void account_print(const struct mpm *mpm, FILE *stream);

/* Bytes of all rows of that table: particles, lists, grid and rooms of threads, as they are now. */
double account_bytes(const struct mpm *mpm);

#endif
