/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tecplot_reader: what tecplot_read.c and tecplot_header.c share while a file is read. */
#ifndef TOOLS_TECPLOT_READER_H
#define TOOLS_TECPLOT_READER_H

#include "tecplot_read.h"
#include "words.h"

#include <stdio.h>

enum tecplot_section { BEFORE_DATA, IN_VARIABLES, IN_ZONE_HEADER, IN_ROWS };

struct tecplot_reader {
    FILE *stream;
    char *line;
    size_t line_capacity;
    size_t line_number;
    bool line_complete; /* the line ended in a newline */

    struct tecplot_file *file;
    struct tecplot_error *error;
    size_t name_capacity;
    size_t zone_capacity;
    size_t value_capacity; /* of the zone being read */
    size_t label_capacity;

    enum tecplot_section section;
    bool zone_is_implicit; /* rows without any ZONE */
    bool inside_list;      /* between the ( and ) of an attribute */
    bool rows_announced;   /* the zone being read has I= */
    size_t announced_rows;

    bool words_allowed;     /* a row may have words among its numbers */
    const char *label_name; /* the variable whose values are words, or NULL */
    size_t label_column;
};

/* Says what is wrong in the line being read; false. */
bool tecplot_fail(struct tecplot_reader *reader, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
bool tecplot_fail_memory(struct tecplot_reader *reader);

/* Makes room for `needed` items: the block, moved perhaps, or NULL with the old one kept. */
void *tecplot_make_room(void *block, size_t *capacity, size_t needed, size_t item_size);

/* A text of its own, or NULL without memory. */
char *tecplot_copy(struct words_span span);

/* Starts a zone without rows. */
bool tecplot_begin_zone(struct tecplot_reader *reader);

/* The zone being read; there must be one. */
struct tecplot_zone *tecplot_current_zone(const struct tecplot_reader *reader);

/* The zone being read, if any, has no more rows. */
bool tecplot_finish_zone(struct tecplot_reader *reader, bool at_end_of_file);

/* Names c1, c2, ...: one for each number of the row at the cursor. */
bool tecplot_number_names(struct tecplot_reader *reader, const char *cursor);

/* Whether the line at the cursor begins with the name of a record such as ZONE. */
bool tecplot_is_record(const char *cursor);

/* Takes a line that is not a row of numbers. */
bool tecplot_read_header(struct tecplot_reader *reader, const char *cursor);

#endif
