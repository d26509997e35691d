/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * tecplot_read: see tecplot_read.h.
 *
 * The file is taken line by line. A line is a row of numbers or a line of the header (see
 * tecplot_header.c). What a line may be depends on the section the file is in.
 */
#define _POSIX_C_SOURCE 200809L

#include "tecplot_reader.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/types.h>

/* ---- messages ---- */

bool tecplot_fail(struct tecplot_reader *reader, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(reader->error->text, sizeof reader->error->text, format, arguments);
    va_end(arguments);
    reader->error->line = reader->line_number;
    return false;
}

bool tecplot_fail_memory(struct tecplot_reader *reader)
{
    return tecplot_fail(reader, "out of memory");
}

void tecplot_print_error(const char *path, const struct tecplot_error *error)
{
    if (error->line > 0)
        fprintf(stderr, "%s:%zu: error: %s\n", path, error->line, error->text);
    else
        fprintf(stderr, "%s: error: %s\n", path, error->text);
}

/* ---- memory ---- */

/* Makes room for `needed` items: the block, moved perhaps, or NULL with the old one kept. */
void *tecplot_make_room(void *block, size_t *capacity, size_t needed, size_t item_size)
{
    if (block != NULL && needed <= *capacity)
        return block;
    size_t larger = *capacity > SIZE_MAX / 2 ? SIZE_MAX : *capacity * 2;
    if (larger < 16)
        larger = 16;
    if (larger < needed)
        larger = needed;
    if (larger > SIZE_MAX / item_size)
        return NULL;
    void *moved = realloc(block, larger * item_size);
    if (moved != NULL)
        *capacity = larger;
    return moved;
}

char *tecplot_copy(struct words_span span)
{
    char *copy = malloc(span.length + 1);
    if (copy != NULL) {
        memcpy(copy, span.text, span.length);
        copy[span.length] = '\0';
    }
    return copy;
}
/* A number, or something that can only be meant as one. */
static bool starts_number(const char *cursor)
{
    double ignored;
    const struct words_span token = words_token(cursor);
    return words_is_digit(*cursor) || *cursor == '+' || *cursor == '-' || *cursor == '.' ||
           (tecplot_number(token.text, token.length, &ignored) == NULL);
}

/* ---- rows ---- */

/* The variable of that name, or a number that no variable has. */
static size_t column_called(const struct tecplot_file *file, const char *name)
{
    for (size_t i = 0; name != NULL && i < file->variable_count; ++i)
        if (strcasecmp(file->variable_names[i], name) == 0)
            return i;
    return SIZE_MAX;
}

/* What must hold before a row is taken: a zone, names, and the zone not full. */
static bool open_row(struct tecplot_reader *reader, const char *cursor)
{
    if (reader->file->zone_count == 0) {
        if (!tecplot_begin_zone(reader))
            return false;
        reader->zone_is_implicit = true;
    }
    if (reader->file->variable_count == 0 && !tecplot_number_names(reader, cursor))
        return false;
    const struct tecplot_zone *zone = tecplot_current_zone(reader);
    if (reader->rows_announced && zone->row_count == reader->announced_rows)
        return tecplot_fail(reader, "zone %zu has more rows than its header says (I=%zu)",
                            reader->file->zone_count, reader->announced_rows);
    if (zone->row_count == 0)
        reader->label_column = column_called(reader->file, reader->label_name);
    reader->section = IN_ROWS;
    return true;
}

/* Room for one more row: where it goes, or NULL. */
static double *room_for_row(struct tecplot_reader *reader)
{
    struct tecplot_zone *zone = tecplot_current_zone(reader);
    const size_t columns = reader->file->variable_count;
    if (zone->row_count >= SIZE_MAX / columns - 1)
        return NULL;
    double *values = tecplot_make_room(zone->values, &reader->value_capacity,
                                       (zone->row_count + 1) * columns, sizeof *values);
    if (values == NULL)
        return NULL;
    zone->values = values;
    return values + zone->row_count * columns;
}

/* The next value of a row: up to the next blank or comma, or between quotes where words are. */
static struct words_span value_token(const struct tecplot_reader *reader, const char **cursor)
{
    const char *start = *cursor;
    const char *quote = reader->words_allowed && *start == '"' ? strchr(start + 1, '"') : NULL;
    struct words_span token = words_token(start);
    *cursor = start + token.length;
    if (quote != NULL) {
        token = words_trimmed((struct words_span){start + 1, (size_t)(quote - start - 1)});
        *cursor = quote + 1;
    }
    return token;
}

/* The number of a word among the file's labels, which it joins when it is new. */
static bool read_label(struct tecplot_reader *reader, struct words_span token, double *value)
{
    struct tecplot_file *file = reader->file;
    size_t number = 0;
    while (number < file->label_count &&
           (strlen(file->labels[number]) != token.length ||
            strncmp(file->labels[number], token.text, token.length) != 0))
        ++number;
    *value = (double)number;
    if (number < file->label_count)
        return true;
    char **labels =
        tecplot_make_room(file->labels, &reader->label_capacity, number + 1, sizeof *labels);
    if (labels == NULL)
        return tecplot_fail_memory(reader);
    file->labels = labels;
    labels[number] = tecplot_copy(token);
    if (labels[number] == NULL)
        return tecplot_fail_memory(reader);
    ++file->label_count;
    return true;
}

static bool read_value(struct tecplot_reader *reader, size_t column, struct words_span token,
                       double *value)
{
    if (column == reader->label_column)
        return read_label(reader, token, value);
    const char *problem = tecplot_number(token.text, token.length, value);
    if (problem == NULL)
        return true;
    *value = (double)NAN;
    return reader->words_allowed ||
           tecplot_fail(reader, "column %zu: %s %s", column + 1, words_quoted(token).text, problem);
}

static bool read_row(struct tecplot_reader *reader, const char *cursor)
{
    if (!open_row(reader, cursor))
        return false;
    double *row = room_for_row(reader);
    if (row == NULL)
        return tecplot_fail_memory(reader);
    const size_t columns = reader->file->variable_count;
    size_t found = 0;
    for (; *(cursor = words_skip_separators(cursor)) != '\0'; ++found) {
        const struct words_span token = value_token(reader, &cursor);
        double value;
        if (!read_value(reader, found, token, &value))
            return false;
        if (found < columns)
            row[found] = value;
    }
    if (found != columns)
        return tecplot_fail(reader, "the row has %zu columns instead of %zu", found, columns);
    if (!reader->line_complete)
        return tecplot_fail(reader,
                            "the last row does not end in a newline: the file seems to be cut");
    struct tecplot_zone *zone = tecplot_current_zone(reader);
    if (zone->row_count++ == 0)
        zone->first_line = reader->line_number;
    return true;
}

/* ---- lines ---- */

/* Ends the line at a # that is not inside quotes. */
static void cut_comment(char *line)
{
    if (strchr(line, '#') == NULL)
        return;
    bool inside_quotes = false;
    for (; *line != '\0'; ++line) {
        if (*line == '"')
            inside_quotes = !inside_quotes;
        if (*line == '#' && !inside_quotes)
            *line = '\0';
        if (*line == '\0')
            return;
    }
}

/* A number, or in a table with words anything behind the header that is not a record. */
static bool starts_row(const struct tecplot_reader *reader, const char *cursor)
{
    if (reader->inside_list)
        return false;
    const bool behind_header = reader->section == IN_ROWS || reader->file->variable_count > 0;
    return starts_number(cursor) ||
           (reader->words_allowed && behind_header && reader->section != IN_ZONE_HEADER &&
            !(reader->section == IN_VARIABLES && *cursor == '"') && !tecplot_is_record(cursor));
}

static bool read_line_content(struct tecplot_reader *reader)
{
    cut_comment(reader->line);
    const char *cursor = words_skip_blanks(reader->line);
    if (*cursor == '\0')
        return true;
    return starts_row(reader, cursor) ? read_row(reader, cursor)
                                      : tecplot_read_header(reader, cursor);
}

/* Takes the next line; false at the end of the file and after a failure (*failed). */
static bool next_line(struct tecplot_reader *reader, bool *failed)
{
    errno = 0;
    const ssize_t length = getline(&reader->line, &reader->line_capacity, reader->stream);
    if (length < 0) {
        *failed = ferror(reader->stream) || !feof(reader->stream);
        if (*failed)
            tecplot_fail(reader, "cannot be read: %s", strerror(errno));
        return false;
    }
    ++reader->line_number;
    reader->line_complete = length > 0 && reader->line[length - 1] == '\n';
    *failed = memchr(reader->line, '\0', (size_t)length) != NULL;
    if (*failed)
        tecplot_fail(reader, "a zero byte: this is not a text file");
    return !*failed;
}

static bool finish_file(struct tecplot_reader *reader)
{
    if (reader->line_number == 0)
        return tecplot_fail(reader, "the file is empty");
    if (reader->file->zone_count == 0)
        return tecplot_fail(reader, "the file ends without any row of numbers");
    return tecplot_finish_zone(reader, true);
}

static bool read_stream(struct tecplot_reader *reader)
{
    bool failed = false;
    reader->file->title = tecplot_copy((struct words_span){"", 0});
    if (reader->file->title == NULL)
        return tecplot_fail_memory(reader);
    while (next_line(reader, &failed))
        if (!read_line_content(reader))
            return false;
    return !failed && finish_file(reader);
}

static bool read_path(const char *path, struct tecplot_reader *reader)
{
    const bool standard_input = strcmp(path, "-") == 0;
    *reader->file = (struct tecplot_file){0};
    reader->stream = standard_input ? stdin : fopen(path, "rb");
    if (reader->stream == NULL)
        return tecplot_fail(reader, "cannot be opened: %s", strerror(errno));
    const bool done = read_stream(reader);
    free(reader->line);
    if (!standard_input)
        (void)fclose(reader->stream);
    if (!done)
        tecplot_free(reader->file);
    return done;
}

bool tecplot_read(const char *path, struct tecplot_file *file, struct tecplot_error *error)
{
    struct tecplot_reader reader = {.file = file, .error = error};
    return read_path(path, &reader);
}

bool tecplot_read_table(const char *path, const char *label_name, struct tecplot_file *file,
                        struct tecplot_error *error)
{
    struct tecplot_reader reader = {
        .file = file, .error = error, .words_allowed = true, .label_name = label_name};
    return read_path(path, &reader);
}

void tecplot_free(struct tecplot_file *file)
{
    for (size_t i = 0; i < file->variable_count; ++i)
        free(file->variable_names[i]);
    for (size_t i = 0; i < file->zone_count; ++i) {
        free(file->zones[i].title);
        free(file->zones[i].values);
    }
    for (size_t i = 0; i < file->label_count; ++i)
        free(file->labels[i]);
    free(file->labels);
    free(file->variable_names);
    free(file->zones);
    free(file->title);
    *file = (struct tecplot_file){0};
}
