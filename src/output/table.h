/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Result files as text tables. A file that could not be written is remembered and reported. */
#ifndef OUTPUT_TABLE_H
#define OUTPUT_TABLE_H

#include <stdbool.h>
#include <stdio.h>

/* How numbers look: significant digits, and Fortran's 0.1234E+02 instead of C's 1.234E+01. */
struct table_style {
    int digits;
    bool fortran;
};

struct table {
    char *path;
    FILE *stream;
    struct table_style style;
};

/* Creates `folder`/`name`. Returns false, after a message, when it can't be created. */
bool table_open(struct table *table, const char *folder, const char *name, struct table_style style);

/* The same for the file "job" + ending. */
bool table_open_job(struct table *table, const char *folder, const char *job, const char *ending, struct table_style style);

/* Writes one number, right-adjusted, with a blank before it. */
void table_real(struct table *table, double value);

/* Writes what is buffered. Returns false, after a message, when the file could not be written. */
bool table_flush(struct table *table);

/* Closes the file. Returns false, after a message, when something of it could not be written. */
bool table_close(struct table *table);

#endif
