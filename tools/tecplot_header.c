/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * tecplot_header: the lines of a Tecplot file that are no rows of numbers: TITLE, VARIABLES and
 * ZONE (the table `records`), zone attributes KEY = value (the table `zone_keys`), and names.
 */
#define _POSIX_C_SOURCE 200809L

#include "tecplot_reader.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* ---- variable names ---- */

static bool add_name(struct tecplot_reader *reader, struct words_span name)
{
    struct tecplot_file *file = reader->file;
    if (name.length == 0)
        return tecplot_fail(reader, "variable %zu has an empty name", file->variable_count + 1);
    for (size_t i = 0; i < name.length; ++i)
        if ((unsigned char)name.text[i] < 0x20 || name.text[i] == 0x7f)
            return tecplot_fail(reader, "%s is not the name of a variable",
                                words_quoted(name).text);
    char **names = tecplot_make_room(file->variable_names, &reader->name_capacity,
                                     file->variable_count + 1, sizeof *names);
    if (names == NULL)
        return tecplot_fail_memory(reader);
    file->variable_names = names;
    names[file->variable_count] = tecplot_copy(name);
    if (names[file->variable_count] == NULL)
        return tecplot_fail_memory(reader);
    ++file->variable_count;
    return true;
}

/* c1, c2, ...: one for each number of the row at the cursor. */
bool tecplot_number_names(struct tecplot_reader *reader, const char *cursor)
{
    for (size_t number = 1; *(cursor = words_skip_separators(cursor)) != '\0'; ++number) {
        char name[3 * sizeof number + 2];
        const int length = snprintf(name, sizeof name, "c%zu", number);
        if (length < 0 || !add_name(reader, (struct words_span){name, (size_t)length}))
            return false;
        cursor += words_token(cursor).length;
    }
    return true;
}

/* Names in quotes or bare words, to the end of the line. */
static bool read_names(struct tecplot_reader *reader, const char *cursor)
{
    while (*(cursor = words_skip_separators(cursor)) != '\0') {
        struct words_span name = words_token(cursor);
        if (*cursor == '"') {
            const char *end = strchr(cursor + 1, '"');
            if (end == NULL)
                return tecplot_fail(reader, "the closing quote of %s is missing",
                                    words_quoted(name).text);
            name = (struct words_span){cursor + 1, (size_t)(end - cursor - 1)};
            cursor = end + 1;
        } else {
            if (memchr(name.text, '"', name.length) || memchr(name.text, '=', name.length))
                return tecplot_fail(reader, "%s is not the name of a variable",
                                    words_quoted(name).text);
            cursor += name.length;
        }
        if (!add_name(reader, words_trimmed(name)))
            return false;
    }
    return true;
}

/* The first line of a table without keywords: Time engk1 engi1 ... */
static bool read_bare_header(struct tecplot_reader *reader, const char *cursor)
{
    reader->section = reader->words_allowed ? IN_ROWS : IN_VARIABLES;
    return read_names(reader, cursor);
}

/* ---- zones ---- */

bool tecplot_begin_zone(struct tecplot_reader *reader)
{
    struct tecplot_file *file = reader->file;
    struct tecplot_zone *zones =
        tecplot_make_room(file->zones, &reader->zone_capacity, file->zone_count + 1, sizeof *zones);
    if (zones == NULL)
        return tecplot_fail_memory(reader);
    file->zones = zones;
    zones[file->zone_count] = (struct tecplot_zone){
        .title = tecplot_copy((struct words_span){"", 0}), .solution_time = (double)NAN};
    if (zones[file->zone_count].title == NULL)
        return tecplot_fail_memory(reader);
    ++file->zone_count;
    reader->value_capacity = 0;
    reader->rows_announced = false;
    return true;
}

struct tecplot_zone *tecplot_current_zone(const struct tecplot_reader *reader)
{
    return &reader->file->zones[reader->file->zone_count - 1];
}

/* The zone being read, if any, has no more rows. */
bool tecplot_finish_zone(struct tecplot_reader *reader, bool at_end_of_file)
{
    const size_t number = reader->file->zone_count;
    if (number == 0)
        return true;
    const size_t rows = tecplot_current_zone(reader)->row_count;
    if (reader->inside_list)
        return tecplot_fail(reader, "zone %zu: the closing parenthesis of a list is missing",
                            number);
    if (reader->rows_announced && rows != reader->announced_rows)
        return tecplot_fail(reader, "zone %zu ends after %zu rows, but its header says I=%zu",
                            number, rows, reader->announced_rows);
    if (at_end_of_file && rows == 0 && !reader->rows_announced)
        return tecplot_fail(reader, "zone %zu has no rows: the file seems to be cut", number);
    return true;
}

static bool set_zone_title(struct tecplot_reader *reader, struct words_span value)
{
    struct tecplot_zone *zone = tecplot_current_zone(reader);
    char *title = tecplot_copy(words_trimmed(value));
    if (title == NULL)
        return tecplot_fail_memory(reader);
    free(zone->title);
    zone->title = title;
    if (strncasecmp(title, "time", 4) != 0 ||
        (!isnan(zone->solution_time) && !zone->time_from_title))
        return true;
    const struct words_span time = words_token(words_skip_blanks(title + 4));
    double solution_time;
    if (tecplot_number(time.text, time.length, &solution_time) == NULL) {
        zone->solution_time = solution_time;
        zone->time_from_title = true;
    }
    return true;
}

static bool set_solution_time(struct tecplot_reader *reader, struct words_span value)
{
    double solution_time;
    const char *problem = tecplot_number(value.text, value.length, &solution_time);
    if (problem != NULL)
        return tecplot_fail(reader, "SOLUTIONTIME: %s %s", words_quoted(value).text, problem);
    tecplot_current_zone(reader)->solution_time = solution_time;
    tecplot_current_zone(reader)->time_from_title = false;
    return true;
}

static bool read_count(struct words_span value, size_t *count)
{
    size_t result = 0;
    for (size_t i = 0; i < value.length; ++i) {
        const size_t digit = (size_t)(value.text[i] - '0');
        if (!words_is_digit(value.text[i]) || result > (SIZE_MAX - digit) / 10)
            return false;
        result = 10 * result + digit;
    }
    *count = result;
    return value.length > 0;
}

static bool set_announced_rows(struct tecplot_reader *reader, struct words_span value)
{
    if (!read_count(value, &reader->announced_rows))
        return tecplot_fail(reader, "I= must be a number of rows, not %s",
                            words_quoted(value).text);
    reader->rows_announced = true;
    return true;
}

static bool require_one(struct tecplot_reader *reader, struct words_span value)
{
    size_t count;
    if (!read_count(value, &count) || count != 1)
        return tecplot_fail(reader, "J= and K= must be 1, not %s: only lists of points are read",
                            words_quoted(value).text);
    return true;
}

static bool require_point(struct tecplot_reader *reader, struct words_span value)
{
    if (!words_equal(value, "POINT"))
        return tecplot_fail(reader, "the data must be in POINT form, not %s",
                            words_quoted(value).text);
    return true;
}

static bool require_ordered(struct tecplot_reader *reader, struct words_span value)
{
    if (!words_equal(value, "ORDERED"))
        return tecplot_fail(reader, "the zone must be ORDERED, not %s", words_quoted(value).text);
    return true;
}

static bool ignore_value(struct tecplot_reader *reader, struct words_span value)
{
    (void)reader;
    (void)value;
    return true;
}

static const struct zone_key {
    const char *name;
    bool (*set)(struct tecplot_reader *reader, struct words_span value);
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

static bool set_attribute(struct tecplot_reader *reader, struct words_span key,
                          struct words_span value)
{
    for (size_t i = 0; i < sizeof zone_keys / sizeof *zone_keys; ++i)
        if (words_equal(key, zone_keys[i].name))
            return zone_keys[i].set(reader, value);
    return tecplot_fail(reader, "unknown word %s in the header of zone %zu", words_quoted(key).text,
                        reader->file->zone_count);
}

/* The value after KEY =: "text", (list) or word. A list may go on over the following lines. */
static bool read_value(struct tecplot_reader *reader, const char **cursor, struct words_span *value)
{
    const char *start = *cursor;
    if (*start == '"') {
        const char *end = strchr(start + 1, '"');
        if (end == NULL)
            return tecplot_fail(reader, "the closing quote of %s is missing",
                                words_quoted(words_token(start)).text);
        *value = (struct words_span){start + 1, (size_t)(end - start - 1)};
        *cursor = end + 1;
    } else if (*start == '(') {
        const char *end = strchr(start, ')');
        reader->inside_list = end == NULL;
        *value =
            (struct words_span){start, end == NULL ? strlen(start) : (size_t)(end + 1 - start)};
        *cursor = start + value->length;
    } else {
        *value = words_token(start);
        *cursor = start + value->length;
    }
    return true;
}

/* Behind a list that goes on from the line before, or at the end of the line. */
static const char *skip_list(struct tecplot_reader *reader, const char *cursor)
{
    if (!reader->inside_list)
        return cursor;
    const char *end = strchr(cursor, ')');
    reader->inside_list = end == NULL;
    return end == NULL ? cursor + strlen(cursor) : end + 1;
}

/* KEY = value pairs to the end of the line; after AUXDATA the key is the user's own. */
static bool read_attributes(struct tecplot_reader *reader, const char *cursor)
{
    bool auxiliary = false;
    cursor = skip_list(reader, cursor);
    while (*(cursor = words_skip_separators(cursor)) != '\0') {
        const struct words_span key = words_keyword(cursor);
        const struct words_span token = words_token(cursor);
        cursor = words_skip_blanks(cursor + key.length);
        if (!auxiliary && words_equal(key, "AUXDATA")) {
            auxiliary = true;
            continue;
        }
        if (key.length == 0 || *cursor != '=')
            return tecplot_fail(reader, "%s in the header of zone %zu: expected KEY = value",
                                words_quoted(token).text, reader->file->zone_count);
        cursor = words_skip_blanks(cursor + 1);
        struct words_span value = {cursor, 0};
        if (!read_value(reader, &cursor, &value))
            return false;
        if (!auxiliary && !set_attribute(reader, key, value))
            return false;
        auxiliary = false;
    }
    return true;
}
/* ---- records ---- */

/* Title text: what stands between the first and the last quote, or the bare rest of the line. */
static bool read_title(struct tecplot_reader *reader, const char *cursor)
{
    struct words_span title = words_trimmed((struct words_span){cursor, strlen(cursor)});
    if (title.length > 0 && title.text[0] == '"') {
        if (title.length == 1 || title.text[title.length - 1] != '"')
            return tecplot_fail(reader, "the closing quote of the title is missing");
        title = words_trimmed((struct words_span){title.text + 1, title.length - 2});
    }
    char *copy = tecplot_copy(title);
    if (copy == NULL)
        return tecplot_fail_memory(reader);
    free(reader->file->title);
    reader->file->title = copy;
    return true;
}

static bool read_variables(struct tecplot_reader *reader, const char *cursor)
{
    if (reader->file->variable_count > 0 || reader->file->zone_count > 0)
        return tecplot_fail(reader, "VARIABLES must come once, before the data");
    reader->section = IN_VARIABLES;
    return read_names(reader, cursor);
}

static bool read_zone(struct tecplot_reader *reader, const char *cursor)
{
    if (reader->zone_is_implicit)
        return tecplot_fail(reader, "ZONE after rows that belong to no zone");
    if (!tecplot_finish_zone(reader, false) || !tecplot_begin_zone(reader))
        return false;
    reader->section = IN_ZONE_HEADER;
    return read_attributes(reader, cursor);
}

static bool skip_record(struct tecplot_reader *reader, const char *cursor)
{
    (void)reader;
    (void)cursor;
    return true;
}

static const struct record {
    const char *name;
    bool needs_equal_sign; /* an equal sign must follow the name */
    bool (*read)(struct tecplot_reader *reader, const char *cursor);
} records[] = {
    {"TITLE", true, read_title},
    {"VARIABLES", true, read_variables},
    {"ZONE", false, read_zone},
    {"AUXDATA", false, skip_record},
    {"DATASETAUXDATA", false, skip_record},
    {"VARAUXDATA", false, skip_record},
    {"FILETYPE", true, skip_record},
};

static const struct record *find_record(struct words_span keyword)
{
    for (size_t i = 0; i < sizeof records / sizeof *records; ++i)
        if (words_equal(keyword, records[i].name))
            return &records[i];
    return NULL;
}

static bool read_record(struct tecplot_reader *reader, const struct record *record,
                        const char *cursor)
{
    cursor = words_skip_blanks(cursor);
    if (!record->needs_equal_sign)
        return record->read(reader, cursor);
    if (*cursor != '=')
        return tecplot_fail(reader, "'=' is missing after %s", record->name);
    return record->read(reader, words_skip_blanks(cursor + 1));
}

bool tecplot_is_record(const char *cursor)
{
    return find_record(words_keyword(cursor)) != NULL;
}

bool tecplot_read_header(struct tecplot_reader *reader, const char *cursor)
{
    const struct words_span keyword = words_keyword(cursor);
    const struct record *record = reader->inside_list ? NULL : find_record(keyword);
    if (record != NULL)
        return read_record(reader, record, cursor + keyword.length);
    if (reader->inside_list || reader->section == IN_ZONE_HEADER)
        return read_attributes(reader, cursor);
    if (reader->section == IN_VARIABLES && *cursor == '"')
        return read_names(reader, cursor);
    if (reader->section == BEFORE_DATA && (words_is_letter(*cursor) || *cursor == '"'))
        return read_bare_header(reader, cursor);
    return tecplot_fail(reader, "%s: expected a row of numbers or a Tecplot record",
                        words_quoted(words_token(cursor)).text);
}
