/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * tecplot_read: see tecplot_read.h.
 *
 * The file is taken line by line. A line is a row of numbers, a record such as TITLE, VARIABLES or
 * ZONE (the table `records`), a line of zone attributes KEY = value (the table `zone_keys`), names
 * that continue VARIABLES, or the bare header words of a table. What a line may be depends on the
 * section the file is in.
 */
#define _POSIX_C_SOURCE 200809L

#include "tecplot_read.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/types.h>

enum {
    LONGEST_NUMBER = 2000, /* characters; a double written out in full has fewer than 1100 */
    LONGEST_QUOTATION = 40 /* characters of the file repeated in a message */
};

enum section { BEFORE_DATA, IN_VARIABLES, IN_ZONE_HEADER, IN_ROWS };

struct reader {
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

    enum section section;
    bool zone_is_implicit; /* rows without any ZONE */
    bool inside_list;      /* between the ( and ) of an attribute */
    bool rows_announced;   /* the zone being read has I= */
    size_t announced_rows;
};

/* A piece of a line. */
struct span {
    const char *text;
    size_t length;
};

/* ---- messages ---- */

static bool fail(struct reader *reader, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(reader->error->text, sizeof reader->error->text, format, arguments);
    va_end(arguments);
    reader->error->line = reader->line_number;
    return false;
}

static bool fail_memory(struct reader *reader)
{
    return fail(reader, "out of memory");
}

struct quotation {
    char text[LONGEST_QUOTATION + sizeof "''..."];
};

/* The span in quotes, fit for a terminal and for a message. */
static struct quotation quoted(struct span span)
{
    struct quotation result;
    size_t end = 0;
    result.text[end++] = '\'';
    for (size_t i = 0; i < span.length && i < LONGEST_QUOTATION; ++i) {
        const unsigned char byte = (unsigned char)span.text[i];
        result.text[end++] = byte < 0x20 || byte > 0x7e ? '?' : span.text[i];
    }
    (void)snprintf(result.text + end, sizeof result.text - end, "%s",
                   span.length > LONGEST_QUOTATION ? "'..." : "'");
    return result;
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
static void *make_room(void *block, size_t *capacity, size_t needed, size_t item_size)
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

static char *copy_of(struct span span)
{
    char *copy = malloc(span.length + 1);
    if (copy != NULL) {
        memcpy(copy, span.text, span.length);
        copy[span.length] = '\0';
    }
    return copy;
}

/* ---- characters and words ---- */

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v';
}

static bool is_separator(char c)
{
    return is_blank(c) || c == ',';
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static const char *skip_blanks(const char *cursor)
{
    while (is_blank(*cursor))
        ++cursor;
    return cursor;
}

static const char *skip_separators(const char *cursor)
{
    while (is_separator(*cursor))
        ++cursor;
    return cursor;
}

/* The characters up to the next blank, comma or end. */
static struct span token_at(const char *cursor)
{
    const char *end = cursor;
    while (*end != '\0' && !is_separator(*end))
        ++end;
    return (struct span){cursor, (size_t)(end - cursor)};
}

/* The letters, digits and underscores at the cursor; empty unless they begin with a letter. */
static struct span keyword_at(const char *cursor)
{
    const char *end = cursor;
    if (is_letter(*end))
        while (is_letter(*end) || is_digit(*end))
            ++end;
    return (struct span){cursor, (size_t)(end - cursor)};
}

static struct span trimmed(struct span span)
{
    while (span.length > 0 && is_blank(span.text[0])) {
        ++span.text;
        --span.length;
    }
    while (span.length > 0 && is_blank(span.text[span.length - 1]))
        --span.length;
    return span;
}

static bool span_equals(struct span span, const char *word)
{
    return span.length == strlen(word) && strncasecmp(span.text, word, span.length) == 0;
}

/* ---- numbers ---- */

/* NaN, nan(...), Inf, Infinity with or without a sign. */
static bool read_nonfinite(struct span span, double *value)
{
    const bool negative = span.length > 0 && span.text[0] == '-';
    if (span.length > 0 && (span.text[0] == '-' || span.text[0] == '+')) {
        ++span.text;
        --span.length;
    }
    if (span_equals(span, "inf") || span_equals(span, "infinity")) {
        *value = negative ? -(double)INFINITY : (double)INFINITY;
        return true;
    }
    const bool payload =
        span.length > 4 && span.text[3] == '(' && span.text[span.length - 1] == ')';
    if (span.length < 3 || (span.length > 3 && !payload) || strncasecmp(span.text, "nan", 3) != 0)
        return false;
    *value = (double)NAN;
    return true;
}

/* Digits with at most one point: how many characters; 0 without a digit. */
static size_t mantissa_length(const char *text, size_t length)
{
    size_t end = 0;
    size_t digits = 0;
    bool point = false;
    while (end < length && (is_digit(text[end]) || (text[end] == '.' && !point))) {
        if (text[end] == '.')
            point = true;
        else
            ++digits;
        ++end;
    }
    return digits > 0 ? end : 0;
}

/* Where the exponent's digits start, its sign included; `length` when the exponent is wrong. */
static size_t exponent_start(const char *text, size_t length, size_t mantissa_end)
{
    size_t start = mantissa_end;
    if (strchr("eEdDqQ", text[start]) != NULL)
        ++start;
    else if (text[start] != '+' && text[start] != '-')
        return length;
    size_t end = start;
    if (end < length && (text[end] == '+' || text[end] == '-'))
        ++end;
    if (end == length)
        return length;
    while (end < length && is_digit(text[end]))
        ++end;
    return end == length ? start : length;
}

const char *tecplot_number(const char *text, size_t length, double *value)
{
    static const char wrong[] = "is not a number";
    if (read_nonfinite((struct span){text, length}, value))
        return NULL;
    if (length > LONGEST_NUMBER)
        return "is too long for a number";
    const size_t sign = length > 0 && (text[0] == '+' || text[0] == '-') ? 1 : 0;
    const size_t mantissa = mantissa_length(text + sign, length - sign);
    if (mantissa == 0)
        return wrong;
    char plain[LONGEST_NUMBER + 2];
    size_t end = sign + mantissa;
    memcpy(plain, text, end);
    if (end < length) {
        const size_t start = exponent_start(text, length, end);
        if (start == length)
            return wrong;
        plain[end++] = 'e';
        memcpy(plain + end, text + start, length - start);
        end += length - start;
    }
    plain[end] = '\0';
    *value = strtod(plain, NULL);
    return isinf(*value) ? "is too large for a number" : NULL;
}

/* A number, or something that can only be meant as one. */
static bool starts_number(const char *cursor)
{
    double ignored;
    const struct span token = token_at(cursor);
    return is_digit(*cursor) || *cursor == '+' || *cursor == '-' || *cursor == '.' ||
           read_nonfinite(token, &ignored);
}

/* ---- variable names ---- */

static bool add_name(struct reader *reader, struct span name)
{
    struct tecplot_file *file = reader->file;
    if (name.length == 0)
        return fail(reader, "variable %zu has an empty name", file->variable_count + 1);
    for (size_t i = 0; i < name.length; ++i)
        if ((unsigned char)name.text[i] < 0x20 || name.text[i] == 0x7f)
            return fail(reader, "%s is not the name of a variable", quoted(name).text);
    char **names = make_room(file->variable_names, &reader->name_capacity, file->variable_count + 1,
                             sizeof *names);
    if (names == NULL)
        return fail_memory(reader);
    file->variable_names = names;
    names[file->variable_count] = copy_of(name);
    if (names[file->variable_count] == NULL)
        return fail_memory(reader);
    ++file->variable_count;
    return true;
}

/* c1, c2, ...: one for each number of the row at the cursor. */
static bool add_numbered_names(struct reader *reader, const char *cursor)
{
    for (size_t number = 1; *(cursor = skip_separators(cursor)) != '\0'; ++number) {
        char name[3 * sizeof number + 2];
        const int length = snprintf(name, sizeof name, "c%zu", number);
        if (length < 0 || !add_name(reader, (struct span){name, (size_t)length}))
            return false;
        cursor += token_at(cursor).length;
    }
    return true;
}

/* Names in quotes or bare words, to the end of the line. */
static bool read_names(struct reader *reader, const char *cursor)
{
    while (*(cursor = skip_separators(cursor)) != '\0') {
        struct span name = token_at(cursor);
        if (*cursor == '"') {
            const char *end = strchr(cursor + 1, '"');
            if (end == NULL)
                return fail(reader, "the closing quote of %s is missing", quoted(name).text);
            name = (struct span){cursor + 1, (size_t)(end - cursor - 1)};
            cursor = end + 1;
        } else {
            if (memchr(name.text, '"', name.length) || memchr(name.text, '=', name.length))
                return fail(reader, "%s is not the name of a variable", quoted(name).text);
            cursor += name.length;
        }
        if (!add_name(reader, trimmed(name)))
            return false;
    }
    return true;
}

/* The first line of a table without keywords: Time engk1 engi1 ... */
static bool read_bare_header(struct reader *reader, const char *cursor)
{
    reader->section = IN_VARIABLES;
    return read_names(reader, cursor);
}

/* ---- zones ---- */

static bool begin_zone(struct reader *reader)
{
    struct tecplot_file *file = reader->file;
    struct tecplot_zone *zones =
        make_room(file->zones, &reader->zone_capacity, file->zone_count + 1, sizeof *zones);
    if (zones == NULL)
        return fail_memory(reader);
    file->zones = zones;
    zones[file->zone_count] =
        (struct tecplot_zone){.title = copy_of((struct span){"", 0}), .solution_time = (double)NAN};
    if (zones[file->zone_count].title == NULL)
        return fail_memory(reader);
    ++file->zone_count;
    reader->value_capacity = 0;
    reader->rows_announced = false;
    return true;
}

static struct tecplot_zone *current_zone(const struct reader *reader)
{
    return &reader->file->zones[reader->file->zone_count - 1];
}

/* The zone being read, if any, has no more rows. */
static bool finish_zone(struct reader *reader, bool at_end_of_file)
{
    const size_t number = reader->file->zone_count;
    if (number == 0)
        return true;
    const size_t rows = current_zone(reader)->row_count;
    if (reader->inside_list)
        return fail(reader, "zone %zu: the closing parenthesis of a list is missing", number);
    if (reader->rows_announced && rows != reader->announced_rows)
        return fail(reader, "zone %zu ends after %zu rows, but its header says I=%zu", number, rows,
                    reader->announced_rows);
    if (at_end_of_file && rows == 0 && !reader->rows_announced)
        return fail(reader, "zone %zu has no rows: the file seems to be cut", number);
    return true;
}

static bool set_zone_title(struct reader *reader, struct span value)
{
    struct tecplot_zone *zone = current_zone(reader);
    char *title = copy_of(trimmed(value));
    if (title == NULL)
        return fail_memory(reader);
    free(zone->title);
    zone->title = title;
    if (strncasecmp(title, "time", 4) != 0 ||
        (!isnan(zone->solution_time) && !zone->time_from_title))
        return true;
    const struct span time = token_at(skip_blanks(title + 4));
    double solution_time;
    if (tecplot_number(time.text, time.length, &solution_time) == NULL) {
        zone->solution_time = solution_time;
        zone->time_from_title = true;
    }
    return true;
}

static bool set_solution_time(struct reader *reader, struct span value)
{
    double solution_time;
    const char *problem = tecplot_number(value.text, value.length, &solution_time);
    if (problem != NULL)
        return fail(reader, "SOLUTIONTIME: %s %s", quoted(value).text, problem);
    current_zone(reader)->solution_time = solution_time;
    current_zone(reader)->time_from_title = false;
    return true;
}

static bool read_count(struct span value, size_t *count)
{
    size_t result = 0;
    for (size_t i = 0; i < value.length; ++i) {
        const size_t digit = (size_t)(value.text[i] - '0');
        if (!is_digit(value.text[i]) || result > (SIZE_MAX - digit) / 10)
            return false;
        result = 10 * result + digit;
    }
    *count = result;
    return value.length > 0;
}

static bool set_announced_rows(struct reader *reader, struct span value)
{
    if (!read_count(value, &reader->announced_rows))
        return fail(reader, "I= must be a number of rows, not %s", quoted(value).text);
    reader->rows_announced = true;
    return true;
}

static bool require_one(struct reader *reader, struct span value)
{
    size_t count;
    if (!read_count(value, &count) || count != 1)
        return fail(reader, "J= and K= must be 1, not %s: only lists of points are read",
                    quoted(value).text);
    return true;
}

static bool require_point(struct reader *reader, struct span value)
{
    if (!span_equals(value, "POINT"))
        return fail(reader, "the data must be in POINT form, not %s", quoted(value).text);
    return true;
}

static bool require_ordered(struct reader *reader, struct span value)
{
    if (!span_equals(value, "ORDERED"))
        return fail(reader, "the zone must be ORDERED, not %s", quoted(value).text);
    return true;
}

static bool ignore_value(struct reader *reader, struct span value)
{
    (void)reader;
    (void)value;
    return true;
}

static const struct zone_key {
    const char *name;
    bool (*set)(struct reader *reader, struct span value);
} zone_keys[] = {
    {"T", set_zone_title},
    {"I", set_announced_rows},
    {"J", require_one},
    {"K", require_one},
    {"F", require_point},
    {"DATAPACKING", require_point},
    {"ZONETYPE", require_ordered},
    {"DT", ignore_value},
    {"C", ignore_value},
    {"SOLUTIONTIME", set_solution_time},
    {"STRANDID", ignore_value},
    {"PARENTZONE", ignore_value},
};

static bool set_attribute(struct reader *reader, struct span key, struct span value)
{
    for (size_t i = 0; i < sizeof zone_keys / sizeof *zone_keys; ++i)
        if (span_equals(key, zone_keys[i].name))
            return zone_keys[i].set(reader, value);
    return fail(reader, "unknown word %s in the header of zone %zu", quoted(key).text,
                reader->file->zone_count);
}

/* The value after KEY =: "text", (list) or word. A list may go on over the following lines. */
static bool read_value(struct reader *reader, const char **cursor, struct span *value)
{
    const char *start = *cursor;
    if (*start == '"') {
        const char *end = strchr(start + 1, '"');
        if (end == NULL)
            return fail(reader, "the closing quote of %s is missing", quoted(token_at(start)).text);
        *value = (struct span){start + 1, (size_t)(end - start - 1)};
        *cursor = end + 1;
    } else if (*start == '(') {
        const char *end = strchr(start, ')');
        reader->inside_list = end == NULL;
        *value = (struct span){start, end == NULL ? strlen(start) : (size_t)(end + 1 - start)};
        *cursor = start + value->length;
    } else {
        *value = token_at(start);
        *cursor = start + value->length;
    }
    return true;
}

/* Behind a list that goes on from the line before, or at the end of the line. */
static const char *skip_list(struct reader *reader, const char *cursor)
{
    if (!reader->inside_list)
        return cursor;
    const char *end = strchr(cursor, ')');
    reader->inside_list = end == NULL;
    return end == NULL ? cursor + strlen(cursor) : end + 1;
}

/* KEY = value pairs to the end of the line; after AUXDATA the key is the user's own. */
static bool read_attributes(struct reader *reader, const char *cursor)
{
    bool auxiliary = false;
    cursor = skip_list(reader, cursor);
    while (*(cursor = skip_separators(cursor)) != '\0') {
        const struct span key = keyword_at(cursor);
        const struct span token = token_at(cursor);
        cursor = skip_blanks(cursor + key.length);
        if (!auxiliary && span_equals(key, "AUXDATA")) {
            auxiliary = true;
            continue;
        }
        if (key.length == 0 || *cursor != '=')
            return fail(reader, "%s in the header of zone %zu: expected KEY = value",
                        quoted(token).text, reader->file->zone_count);
        cursor = skip_blanks(cursor + 1);
        struct span value = {cursor, 0};
        if (!read_value(reader, &cursor, &value))
            return false;
        if (!auxiliary && !set_attribute(reader, key, value))
            return false;
        auxiliary = false;
    }
    return true;
}

/* ---- rows ---- */

/* What must hold before a row is taken: a zone, names, and the zone not full. */
static bool open_row(struct reader *reader, const char *cursor)
{
    if (reader->file->zone_count == 0) {
        if (!begin_zone(reader))
            return false;
        reader->zone_is_implicit = true;
    }
    if (reader->file->variable_count == 0 && !add_numbered_names(reader, cursor))
        return false;
    const struct tecplot_zone *zone = current_zone(reader);
    if (reader->rows_announced && zone->row_count == reader->announced_rows)
        return fail(reader, "zone %zu has more rows than its header says (I=%zu)",
                    reader->file->zone_count, reader->announced_rows);
    reader->section = IN_ROWS;
    return true;
}

/* Room for one more row: where it goes, or NULL. */
static double *room_for_row(struct reader *reader)
{
    struct tecplot_zone *zone = current_zone(reader);
    const size_t columns = reader->file->variable_count;
    if (zone->row_count >= SIZE_MAX / columns - 1)
        return NULL;
    double *values = make_room(zone->values, &reader->value_capacity,
                               (zone->row_count + 1) * columns, sizeof *values);
    if (values == NULL)
        return NULL;
    zone->values = values;
    return values + zone->row_count * columns;
}

static bool read_row(struct reader *reader, const char *cursor)
{
    if (!open_row(reader, cursor))
        return false;
    double *row = room_for_row(reader);
    if (row == NULL)
        return fail_memory(reader);
    const size_t columns = reader->file->variable_count;
    size_t found = 0;
    for (; *(cursor = skip_separators(cursor)) != '\0'; ++found) {
        const struct span token = token_at(cursor);
        double value;
        const char *problem = tecplot_number(token.text, token.length, &value);
        if (problem != NULL)
            return fail(reader, "column %zu: %s %s", found + 1, quoted(token).text, problem);
        if (found < columns)
            row[found] = value;
        cursor += token.length;
    }
    if (found != columns)
        return fail(reader, "the row has %zu columns instead of %zu", found, columns);
    if (!reader->line_complete)
        return fail(reader, "the last row does not end in a newline: the file seems to be cut");
    struct tecplot_zone *zone = current_zone(reader);
    if (zone->row_count++ == 0)
        zone->first_line = reader->line_number;
    return true;
}

/* ---- records ---- */

/* Title text: what stands between the first and the last quote, or the bare rest of the line. */
static bool read_title(struct reader *reader, const char *cursor)
{
    struct span title = trimmed((struct span){cursor, strlen(cursor)});
    if (title.length > 0 && title.text[0] == '"') {
        if (title.length == 1 || title.text[title.length - 1] != '"')
            return fail(reader, "the closing quote of the title is missing");
        title = trimmed((struct span){title.text + 1, title.length - 2});
    }
    char *copy = copy_of(title);
    if (copy == NULL)
        return fail_memory(reader);
    free(reader->file->title);
    reader->file->title = copy;
    return true;
}

static bool read_variables(struct reader *reader, const char *cursor)
{
    if (reader->file->variable_count > 0 || reader->file->zone_count > 0)
        return fail(reader, "VARIABLES must come once, before the data");
    reader->section = IN_VARIABLES;
    return read_names(reader, cursor);
}

static bool read_zone(struct reader *reader, const char *cursor)
{
    if (reader->zone_is_implicit)
        return fail(reader, "ZONE after rows that belong to no zone");
    if (!finish_zone(reader, false) || !begin_zone(reader))
        return false;
    reader->section = IN_ZONE_HEADER;
    return read_attributes(reader, cursor);
}

static bool skip_record(struct reader *reader, const char *cursor)
{
    (void)reader;
    (void)cursor;
    return true;
}

static const struct record {
    const char *name;
    bool needs_equal_sign; /* an equal sign must follow the name */
    bool (*read)(struct reader *reader, const char *cursor);
} records[] = {
    {"TITLE", true, read_title},
    {"VARIABLES", true, read_variables},
    {"ZONE", false, read_zone},
    {"AUXDATA", false, skip_record},
    {"DATASETAUXDATA", false, skip_record},
    {"VARAUXDATA", false, skip_record},
    {"FILETYPE", true, skip_record},
};

static const struct record *find_record(struct span keyword)
{
    for (size_t i = 0; i < sizeof records / sizeof *records; ++i)
        if (span_equals(keyword, records[i].name))
            return &records[i];
    return NULL;
}

static bool read_record(struct reader *reader, const struct record *record, const char *cursor)
{
    cursor = skip_blanks(cursor);
    if (!record->needs_equal_sign)
        return record->read(reader, cursor);
    if (*cursor != '=')
        return fail(reader, "'=' is missing after %s", record->name);
    return record->read(reader, skip_blanks(cursor + 1));
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

static bool read_line_content(struct reader *reader)
{
    cut_comment(reader->line);
    const char *cursor = skip_blanks(reader->line);
    if (*cursor == '\0')
        return true;
    if (reader->inside_list)
        return read_attributes(reader, cursor);
    if (starts_number(cursor))
        return read_row(reader, cursor);
    const struct span keyword = keyword_at(cursor);
    const struct record *record = find_record(keyword);
    if (record != NULL)
        return read_record(reader, record, cursor + keyword.length);
    if (reader->section == IN_ZONE_HEADER)
        return read_attributes(reader, cursor);
    if (reader->section == IN_VARIABLES && *cursor == '"')
        return read_names(reader, cursor);
    if (reader->section == BEFORE_DATA && (is_letter(*cursor) || *cursor == '"'))
        return read_bare_header(reader, cursor);
    return fail(reader, "%s: expected a row of numbers or a Tecplot record",
                quoted(token_at(cursor)).text);
}

/* Takes the next line; false at the end of the file and after a failure (*failed). */
static bool next_line(struct reader *reader, bool *failed)
{
    errno = 0;
    const ssize_t length = getline(&reader->line, &reader->line_capacity, reader->stream);
    if (length < 0) {
        *failed = ferror(reader->stream) || !feof(reader->stream);
        if (*failed)
            fail(reader, "cannot be read: %s", strerror(errno));
        return false;
    }
    ++reader->line_number;
    reader->line_complete = length > 0 && reader->line[length - 1] == '\n';
    *failed = memchr(reader->line, '\0', (size_t)length) != NULL;
    if (*failed)
        fail(reader, "a zero byte: this is not a text file");
    return !*failed;
}

static bool finish_file(struct reader *reader)
{
    if (reader->line_number == 0)
        return fail(reader, "the file is empty");
    if (reader->file->zone_count == 0)
        return fail(reader, "the file ends without any row of numbers");
    return finish_zone(reader, true);
}

static bool read_stream(struct reader *reader)
{
    bool failed = false;
    reader->file->title = copy_of((struct span){"", 0});
    if (reader->file->title == NULL)
        return fail_memory(reader);
    while (next_line(reader, &failed))
        if (!read_line_content(reader))
            return false;
    return !failed && finish_file(reader);
}

bool tecplot_read(const char *path, struct tecplot_file *file, struct tecplot_error *error)
{
    const bool standard_input = strcmp(path, "-") == 0;
    struct reader reader = {.file = file, .error = error};
    *file = (struct tecplot_file){0};
    reader.stream = standard_input ? stdin : fopen(path, "rb");
    if (reader.stream == NULL)
        return fail(&reader, "cannot be opened: %s", strerror(errno));
    const bool done = read_stream(&reader);
    free(reader.line);
    if (!standard_input)
        (void)fclose(reader.stream);
    if (!done)
        tecplot_free(file);
    return done;
}

void tecplot_free(struct tecplot_file *file)
{
    for (size_t i = 0; i < file->variable_count; ++i)
        free(file->variable_names[i]);
    for (size_t i = 0; i < file->zone_count; ++i) {
        free(file->zones[i].title);
        free(file->zones[i].values);
    }
    free(file->variable_names);
    free(file->zones);
    free(file->title);
    *file = (struct tecplot_file){0};
}
