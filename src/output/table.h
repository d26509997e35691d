/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Result files as text tables. A file that could not be written is remembered and reported. */
#ifndef OUTPUT_TABLE_H
#define OUTPUT_TABLE_H

#include <stdbool.h>
#include <stdint.h>
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
    char *buffer;
    int failure; /* errno of the first line that could not be written, or 0 */
};

/* A new file, or the one that is there, to go on with. */
enum table_mode { TABLE_NEW, TABLE_CONTINUED };

/* Opens `folder`/`name`. Returns false, after a message, when that is not possible. */
bool table_open(struct table *table, const char *folder, const char *name, struct table_style style, enum table_mode mode);

/* The same for the file "job" + ending. */
bool table_open_job(struct table *table, const char *folder, const char *job, const char *ending, struct table_style style,
                    enum table_mode mode);

/* Writes one number, right-adjusted, with a blank before it. */
void table_real(struct table *table, double value);

/* Ends a line; in a table by lines it goes to the file. */
void table_end_line(struct table *table);

/* To be called first: each line goes to the file when it ends, or all at once when it is flushed, up to some
 * megabytes. What kills the run then leaves whole lines, or zones. */
void table_by_lines(struct table *table);
void table_by_zones(struct table *table);

/* Writes what is buffered. Returns false, after a message, when the file could not be written. */
bool table_flush(struct table *table);

/* A place in a file from which to go on: its length then, and a checksum of the last bytes before. */
struct table_mark {
    int64_t length;
    uint64_t checksum;
};

/* Brings all that was written to the disk and marks its end. False, after a message, on failure. */
bool table_set_mark(struct table *table, struct table_mark *mark);

/* Whether the file is still that of the mark, and longer or as long; says so where it is not. */
bool table_has_mark(const struct table *table, const struct table_mark *mark);

/* Cuts the file off at the mark and goes on there. False, after a message, on failure. */
bool table_return_to(struct table *table, const struct table_mark *mark);

/* Closes the file. Returns false, after a message, when something of it could not be written. */
bool table_close(struct table *table);

#endif
