/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "deck/reader.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { SHOWN = 40 };

/* --- numbers --- */

/* Copies a numeric word to `plain` in C's own spelling. The word may have a sign, digits, one
 * point, and an exponent after e, d or a bare sign. Returns false when it is anything else. */
static bool plain_number(const struct deck_word *word, char *plain, size_t size, bool *is_integer)
{
    const char *p = word->text, *end = p + word->length;
    char *out = plain;
    size_t digits = 0;
    if (word->length + 3 > size)
        return false;
    *is_integer = true;
    if (p < end && (*p == '+' || *p == '-'))
        *out++ = *p++;
    for (; p < end && (isdigit((unsigned char)*p) || (*p == '.' && *is_integer)); p++) {
        digits += *p != '.';
        *is_integer = *is_integer && *p != '.';
        *out++ = *p;
    }
    if (digits == 0)
        return false;
    if (p < end) {
        *is_integer = false;
        *out++ = 'e';
        bool has_letter = strchr("eEdD", *p) != NULL;
        p += has_letter;
        bool has_sign = p < end && (*p == '+' || *p == '-');
        if (!has_letter && !has_sign)
            return false;
        if (has_sign)
            *out++ = *p++;
        if (p == end)
            return false;
        for (; p < end; p++) {
            if (!isdigit((unsigned char)*p))
                return false;
            *out++ = *p;
        }
    }
    *out = '\0';
    return true;
}

/* A number may be written with any number of digits; a copy on the heap serves the long ones. */
static bool parse_number(const struct deck_word *word, double *real, bool *is_integer)
{
    char small[128];
    size_t size = word->length + 3;
    char *plain = size <= sizeof small ? small : malloc(size);
    bool good = plain && plain_number(word, plain, size, is_integer);
    if (good)
        *real = strtod(plain, NULL);
    if (plain != small)
        free(plain);
    return good;
}

bool reader_is_real(const struct deck_word *word, double *real)
{
    bool is_integer;
    return parse_number(word, real, &is_integer);
}

bool reader_is_integer(const struct deck_word *word, long *integer)
{
    double real;
    bool is_integer;
    if (!parse_number(word, &real, &is_integer) || !is_integer || fabs(real) > 9e15)
        return false;
    *integer = (long)real;
    return true;
}

/* --- words --- */

static bool take(struct reader *reader, struct deck_word *word)
{
    if (!text_next(reader->text, word))
        return false;
    reader->last = *word;
    return true;
}

bool reader_at_line_end(struct reader *reader)
{
    struct deck_word next;
    return !text_peek(reader->text, &next) || next.place.file != reader->last.place.file
        || next.place.line != reader->last.place.line;
}

void reader_skip_line(struct reader *reader)
{
    struct deck_word word;
    while (!reader_at_line_end(reader))
        take(reader, &word);
}

bool reader_word(struct reader *reader, struct deck_word *word, const char *what)
{
    if (take(reader, word))
        return true;
    diagnostics_error(reader->diagnostics, text_behind(&reader->last), "the deck ends here; expected %s", what);
    return false;
}

void reader_unknown(struct reader *reader, const struct deck_word *word, const char *kind, const char *nearest)
{
    char shown[SHOWN];
    text_copy(word, shown, sizeof shown);
    if (nearest)
        diagnostics_error(reader->diagnostics, word->place, "unknown %s '%s'; did you mean '%s'?", kind, shown, nearest);
    else
        diagnostics_error(reader->diagnostics, word->place, "unknown %s '%s'; see mpm3d --help", kind, shown);
}

static const char *kind_text(const struct argument *argument)
{
    return argument->kind == ARGUMENT_INTEGER ? "a whole number" : argument->kind == ARGUMENT_REAL ? "a number" : "a word";
}

static bool check_limit(struct reader *reader, const struct argument *argument, const char *owner,
                        const struct value *value)
{
    char shown[SHOWN];
    if (argument_within(argument->limit, value->real))
        return true;
    diagnostics_error(reader->diagnostics, value->word.place, "%s of %s must be %s, not %s", argument->name, owner,
                      *argument_limit_text(argument->limit) ? argument_limit_text(argument->limit) : "a finite number",
                      text_copy(&value->word, shown, sizeof shown));
    return false;
}

/* Turns the taken word into the value that the argument asks for. */
static bool read_value(struct reader *reader, const struct argument *argument, const char *owner, struct value *value)
{
    bool is_integer = false;
    char shown[SHOWN];
    if (argument->kind == ARGUMENT_WORD)
        return true;
    bool is_number = parse_number(&value->word, &value->real, &is_integer);
    if (!is_number || (argument->kind == ARGUMENT_INTEGER && !is_integer)) {
        diagnostics_error(reader->diagnostics, value->word.place, "expected %s for %s of %s, found '%s'",
                          kind_text(argument), argument->name, owner, text_copy(&value->word, shown, sizeof shown));
        return false;
    }
    if (argument->kind == ARGUMENT_INTEGER && !reader_is_integer(&value->word, &value->integer)) {
        diagnostics_error(reader->diagnostics, value->word.place, "%s of %s is too large", argument->name, owner);
        return false;
    }
    return check_limit(reader, argument, owner, value);
}

/* Whether the word that follows on another line is the next command instead of an argument. */
static bool is_missing(struct reader *reader, const struct argument *argument)
{
    struct deck_word next;
    double real;
    if (!reader_at_line_end(reader))
        return false;
    return !text_peek(reader->text, &next) || (argument->kind != ARGUMENT_WORD && !reader_is_real(&next, &real));
}

bool reader_values(struct reader *reader, const struct argument *arguments, const char *owner, struct value *values)
{
    bool good = true;
    for (int i = 0; i < argument_count(arguments); i++) {
        values[i] = (struct value){0};
        if (is_missing(reader, &arguments[i])) {
            diagnostics_error(reader->diagnostics, text_behind(&reader->last), "%s lacks its %s; expected %s", owner,
                              arguments[i].name, kind_text(&arguments[i]));
            return false;
        }
        take(reader, &values[i].word);
        if (!read_value(reader, &arguments[i], owner, &values[i]))
            good = false;
    }
    return good;
}

bool reader_check_id(struct reader *reader, const struct value *value, long count, const char *what)
{
    if (value->integer >= 1 && value->integer <= count)
        return true;
    if (count == 0)
        diagnostics_error(reader->diagnostics, value->word.place, "%s %ld does not exist; there is none yet", what,
                          value->integer);
    else
        diagnostics_error(reader->diagnostics, value->word.place, "%s %ld does not exist; expected 1 to %ld", what,
                          value->integer, count);
    return false;
}

int reader_switch(struct reader *reader, const struct value *value, const char *owner)
{
    char word[SHOWN];
    text_copy(&value->word, word, sizeof word);
    if (strcasecmp(word, "on") == 0)
        return 1;
    if (strcasecmp(word, "off") == 0)
        return 0;
    diagnostics_error(reader->diagnostics, value->word.place, "%s must be on or off, not '%s'", owner, word);
    return -1;
}

int reader_optional(struct reader *reader, const char *const *names)
{
    struct deck_word word;
    char text[SHOWN];
    if (reader_at_line_end(reader) || !text_peek(reader->text, &word))
        return -1;
    text_copy(&word, text, sizeof text);
    for (int i = 0; names[i]; i++)
        if (strncasecmp(text, names[i], 4) == 0) {
            take(reader, &word);
            return i;
        }
    return -1;
}

/* --- commands --- */

static void store_values(struct scene *scene, const struct keyword *row, const struct value *values)
{
    char *field = (char *)scene + row->field;
    for (int i = 0; i < argument_count(row->arguments); i++) {
        if (row->arguments[i].kind == ARGUMENT_INTEGER)
            ((long *)(void *)field)[i] = values[i].integer;
        else
            ((double *)(void *)field)[i] = values[i].real;
    }
}

static void run_command(struct reader *reader, const struct keyword *row, const struct deck_word *word)
{
    struct value values[KEYWORD_ARGUMENTS];
    if (row->later) {
        diagnostics_error(reader->diagnostics, word->place, "'%s' is not available in this version: %s", row->name,
                          row->later);
        reader_skip_line(reader);
        return;
    }
    if (!reader_values(reader, row->arguments, row->name, values))
        return;
    if (row->field != KEYWORD_NO_FIELD)
        store_values(reader->scene, row, values);
    if (row->apply)
        row->apply(reader, word, values);
}

void reader_block(struct reader *reader, const struct keyword *table, const char *end, const char *owner)
{
    struct deck_word word;
    char text[SHOWN];
    struct deck_place start = reader->last.place;
    while (text_peek(reader->text, &word)) {
        text_copy(&word, text, sizeof text);
        if (strncasecmp(text, end, 4) == 0) {
            take(reader, &word);
            return;
        }
        const struct keyword *row = keyword_in(table, text);
        if (!row && keyword_find(text, NULL)) { /* a command of the deck: the block was not closed */
            diagnostics_error(reader->diagnostics, word.place, "'%s' inside the block '%s'; expected '%s' first", text,
                              owner, end);
            return;
        }
        take(reader, &word);
        if (row) {
            run_command(reader, row, &word);
            continue;
        }
        const char *nearest = keyword_nearest(table, text);
        reader_unknown(reader, &word, "word in a block", nearest ? nearest : keyword_distance(text, end) >= 0 ? end : NULL);
        reader_skip_line(reader);
    }
    diagnostics_error(reader->diagnostics, start, "the block '%s' is not closed; expected '%s'", owner, end);
}

/* Notes a word that is no command. Runs of numbers are one mistake: they belong to what precedes. */
static void unknown_command(struct reader *reader, const struct deck_word *word, const char *text)
{
    double real;
    if (reader_is_real(word, &real))
        diagnostics_error(reader->diagnostics, word->place, "expected a keyword, found the number %s", text);
    else
        reader_unknown(reader, word, "keyword", keyword_nearest_top(text));
    reader_skip_line(reader);
}

static void finish(struct reader *reader)
{
    struct deck_place end = reader->last.place;
    if (!reader->ended && diagnostics_errors(reader->diagnostics) == 0)
        diagnostics_error(reader->diagnostics, text_behind(&reader->last), "the deck ends without 'endi'");
    if (diagnostics_errors(reader->diagnostics) == 0)
        reader_finish_general(reader, end);
    if (diagnostics_errors(reader->diagnostics) == 0)
        reader_finish_grid(reader, end);
    if (diagnostics_errors(reader->diagnostics) == 0)
        reader_finish_materials(reader, end);
    reader_finish_targets(reader);
}

struct scene *reader_read(struct deck_text *text, struct diagnostics *diagnostics)
{
    struct reader reader = {.text = text, .diagnostics = diagnostics, .scene = scene_open()};
    struct deck_word word;
    char name[SHOWN];
    reader.last.place = (struct deck_place){0, 1, 1, 0};
    while (!reader.ended && take(&reader, &word)) {
        text_copy(&word, name, sizeof name);
        enum category category;
        const struct keyword *row = keyword_find(name, &category);
        if (row)
            reader.scene->given[category] |= UINT64_C(1) << (row - keyword_table(category));
        if (row)
            run_command(&reader, row, &word);
        else
            unknown_command(&reader, &word, name);
    }
    finish(&reader);
    return reader.scene;
}
