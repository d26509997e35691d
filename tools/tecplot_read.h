/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * tecplot_read: a Tecplot ASCII file in POINT form, or a plain table of numbers, in memory.
 *
 * Read are
 *   - TITLE, VARIABLES and one ZONE per output time, with the number of rows (I=) or without it;
 *   - tables without any ZONE, with one header line (VARIABLES = ... or bare words) or with none:
 *     they become one zone, and without a header the variables are called c1, c2, ...
 * A file that is damaged, cut or not of this kind is refused with the line and the reason.
 */
#ifndef TOOLS_TECPLOT_READ_H
#define TOOLS_TECPLOT_READ_H

#include <stdbool.h>
#include <stddef.h>

struct tecplot_zone {
    char *title;          /* the text of T="...", empty when there is none */
    double solution_time; /* SOLUTIONTIME, else the number of T="time <number>", else NaN */
    bool time_from_title; /* the time was taken from the title: few digits */
    size_t row_count;
    size_t first_line; /* line of the first row in the file, 0 without rows */
    double *values;    /* row_count rows of variable_count numbers, NULL without rows */
};

struct tecplot_file {
    char *title; /* empty when there is none */
    size_t variable_count;
    char **variable_names; /* without leading and trailing blanks */
    size_t zone_count;     /* at least 1 after a successful read */
    struct tecplot_zone *zones;
    size_t label_count; /* the words of the variable whose values are words */
    char **labels;      /* its values are numbers of these, from 0 */
};

struct tecplot_error {
    size_t line;    /* 0 when the error belongs to no line */
    char text[320]; /* what is wrong, without the name of the file */
};

/* Reads the file at path ("-" is standard input). On failure *error says why and *file is empty. */
bool tecplot_read(const char *path, struct tecplot_file *file, struct tecplot_error *error);

/*
 * As tecplot_read, for a table that may have words among its numbers. The values of the variable
 * called label_name (NULL for none) become numbers of file->labels; other words become NaN.
 */
bool tecplot_read_table(const char *path, const char *label_name, struct tecplot_file *file,
                        struct tecplot_error *error);

/* Frees what a read left in *file; an empty *file is fine. */
void tecplot_free(struct tecplot_file *file);

/* Prints "path:line: error: text" to standard error. */
void tecplot_print_error(const char *path, const struct tecplot_error *error);

/*
 * Reads one number, C or Fortran style (1.5, 0.15E+01, 1.5D0, 0.15-104, NaN, -Infinity).
 * Returns NULL, or what is wrong with the text ("is not a number", ...).
 */
const char *tecplot_number(const char *text, size_t length, double *value);

#endif
