/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "deck/reader.h"
#include "base/memory.h"
#include "deck/number.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { SHOWN = 40 };

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

void reader_skip_numbers(struct reader *reader)
{
    struct deck_word word;
    double real;
    for (reader_skip_line(reader); text_peek(reader->text, &word) && number_is_real(&word, &real);
         reader_skip_line(reader))
        take(reader, &word);
}

bool reader_word(struct reader *reader, struct deck_word *word, const char *what)
{
    if (take(reader, word))
        return true;
    diagnostics_error(reader->diagnostics, text_behind(&reader->last), "the deck ends here; expected %s", what);
    reader->is_cut = true;
    return false;
}

/* The block that a word ends, or NULL. */
static const char *block_of_end(const char *word)
{
    static const char *const ends[][2] = {{"endl", "load"}, {"endv", "velo"}, {"endp", "part solid"}, {"endg", "Ghost"}, {"ends", "sph' or 'rkpm"}};
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++)
        if (strncasecmp(word, ends[i][0], 4) == 0)
            return ends[i][1];
    return NULL;
}

bool reader_is_keyword(const struct deck_word *word)
{
    char text[SHOWN];
    text_copy(word, text, sizeof text);
    return keyword_find(text, NULL) || keyword_in(load_keywords, text) || keyword_in(velocity_keywords, text)
        || keyword_in(solid_keywords, text) || keyword_in(ghost_keywords, text)
        || keyword_in(sph_keywords, text) || keyword_in(rkpm_keywords, text) || block_of_end(text);
}

bool reader_has_more(struct reader *reader)
{
    struct deck_word word;
    return !reader_at_line_end(reader) && text_peek(reader->text, &word) && !reader_is_keyword(&word);
}

/* Whether a word is a command in its full spelling; a file or a name may begin like one. */
static bool is_command(const struct deck_word *word)
{
    char text[SHOWN];
    const struct keyword *row = keyword_find(text_copy(word, text, sizeof text), NULL);
    return row && (strcasecmp(text, row->name) == 0 || (row->long_name && strcasecmp(text, row->long_name) == 0));
}

/* Whether a word is a step of a solid, or ends its block. */
static bool is_step(const struct deck_word *word)
{
    char text[SHOWN];
    const struct keyword *row = keyword_in(solid_keywords, text_copy(word, text, sizeof text));
    return strcasecmp(text, row ? row->name : "endp") == 0;
}

void reader_unknown(struct reader *reader, const struct deck_word *word, const char *kind, const char *nearest,
                    const char *topic)
{
    char shown[SHOWN];
    text_show(word, shown, sizeof shown);
    if (nearest)
        diagnostics_error(reader->diagnostics, word->place, "unknown %s '%s'; did you mean '%s'?", kind, shown,
                          nearest);
    else
        diagnostics_error(reader->diagnostics, word->place, "unknown %s '%s'; see mpm3d --help%s%s", kind, shown,
                          *topic ? " " : "", topic);
}

/* --- arguments --- */

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
    text_show(&value->word, shown, sizeof shown);
    if (!isfinite(value->real))
        diagnostics_error(reader->diagnostics, value->word.place, "%s of %s is too large: %s", argument->name, owner,
                          shown);
    else
        diagnostics_error(reader->diagnostics, value->word.place, "%s of %s must be %s, not %s", argument->name, owner,
                          argument_limit_text(argument->limit), shown);
    return false;
}

/* Turns the taken word into the value that the argument asks for. */
static bool read_value(struct reader *reader, const struct argument *argument, const char *owner, struct value *value)
{
    bool is_integer = false;
    char shown[SHOWN];
    if (argument->kind == ARGUMENT_WORD)
        return true;
    bool is_number = number_read(&value->word, &value->real, &is_integer);
    if (!is_number || (argument->kind == ARGUMENT_INTEGER && !is_integer)) {
        diagnostics_error(reader->diagnostics, value->word.place, "expected %s for %s of %s, found '%s'",
                          kind_text(argument), argument->name, owner, text_show(&value->word, shown, sizeof shown));
        return false;
    }
    if (argument->kind == ARGUMENT_INTEGER && !number_is_integer(&value->word, &value->integer)) {
        diagnostics_error(reader->diagnostics, value->word.place, "%s of %s is too large: %s", argument->name, owner,
                          text_show(&value->word, shown, sizeof shown));
        return false;
    }
    return check_limit(reader, argument, owner, value);
}

/* Whether the next word is the id of a material: a law follows it. */
static bool is_material_id(struct reader *reader)
{
    struct deck_word law;
    char text[SHOWN];
    return text_second(reader->text, &law) && law_find(text_copy(&law, text, sizeof text));
}

/* Whether the next word is not the argument but already what follows the command. */
static bool is_missing(struct reader *reader, const struct argument *argument)
{
    struct deck_word next;
    double real;
    if (!text_peek(reader->text, &next)) {
        reader->is_cut = true;
        return true;
    }
    bool at_line_end = reader_at_line_end(reader);
    if (argument->kind == ARGUMENT_WORD)
        return at_line_end && (is_command(&next) || (reader->block.is_open && is_step(&next)));
    if (number_is_real(&next, &real))
        return reader->in_materials && is_material_id(reader);
    return reader_is_keyword(&next) || (at_line_end && !strchr("0123456789+-.", *next.text));
}

bool reader_values(struct reader *reader, const struct argument *arguments, const char *owner, struct value *values)
{
    bool good = true;
    for (int i = 0; i < argument_count(arguments); i++) {
        values[i] = (struct value){0};
        if (is_missing(reader, &arguments[i])) {
            if (good)
                diagnostics_error(reader->diagnostics, text_behind(&reader->last), "%s lacks its %s; expected %s",
                                  owner, arguments[i].name, kind_text(&arguments[i]));
            return false;
        }
        take(reader, &values[i].word);
        if (!read_value(reader, &arguments[i], owner, &values[i]))
            good = false;
    }
    struct deck_word next;
    while (!good && !reader_at_line_end(reader) && text_peek(reader->text, &next) && !reader_is_keyword(&next))
        take(reader, &next);
    return good;
}

/* Whether some text could not be read, so that what seems missing may be there. */
static bool misses_part(const struct reader *reader)
{
    return reader->is_partial || text_is_cut(reader->text);
}

bool reader_check_id(struct reader *reader, const struct value *value, long count, const char *what)
{
    if (value->integer >= 1 && value->integer <= count)
        return true;
    if ((count > 0 && !misses_part(reader)) || diagnostics_errors(reader->diagnostics) == 0)
        diagnostics_error(reader->diagnostics, value->word.place, "%s %ld does not exist; expected 1 to %ld", what,
                          value->integer, count);
    return false;
}

int reader_switch(struct reader *reader, const struct value *value, const char *owner)
{
    char word[SHOWN];
    text_show(&value->word, word, sizeof word);
    if (strcasecmp(word, "on") == 0)
        return 1;
    if (strcasecmp(word, "off") == 0)
        return 0;
    diagnostics_error(reader->diagnostics, value->word.place, "%s must be on or off, not '%s'", owner, word);
    return -1;
}

int reader_axis(struct reader *reader, const struct value *value)
{
    char shown[SHOWN];
    static const char names[] = "xyzXYZ123";
    const char *found = value->word.length == 1 ? strchr(names, value->word.text[0]) : NULL;
    if (found)
        return (int)(found - names) % 3;
    diagnostics_error(reader->diagnostics, value->word.place, "the axis must be x, y or z, not '%s'",
                      text_show(&value->word, shown, sizeof shown));
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

void reader_expect(struct reader *reader, const char *owner, const char *expected)
{
    struct deck_word word;
    char shown[SHOWN];
    if (reader_at_line_end(reader) || !text_peek(reader->text, &word))
        diagnostics_error(reader->diagnostics, text_behind(&reader->last), "%s lacks its next word; expected %s", owner, expected);
    else
        diagnostics_error(reader->diagnostics, word.place, "expected %s behind %s, found '%s'", expected, owner,
                          text_show(&word, shown, sizeof shown));
    reader_skip_line(reader);
}

/* --- commands --- */

/* Stores which of the names of a choice stands as the argument; false, after an error, where none does. */
static bool choose(struct reader *reader, const struct keyword *row, const struct value *value)
{
    const struct keyword_choice *choice = row->choice;
    char *field = (char *)reader->scene + choice->field;
    char word[SHOWN], expected[120] = "";
    int count = 0;
    text_copy(&value->word, word, sizeof word);
    for (; choice->names[count]; count++) {
        const bool is_on = count == 1;
        if (strncasecmp(word, choice->names[count], 4) == 0) {
            if (choice->is_flag)
                memcpy(field, &is_on, sizeof is_on);
            else
                memcpy(field, &count, sizeof count); /* enums have the size of int */
            return true;
        }
    }
    for (int i = 0; i < count; i++) {
        const size_t length = strlen(expected);
        snprintf(expected + length, sizeof expected - length, "%s%s", i == 0 ? "" : i + 1 < count ? ", " : " or ", choice->names[i]);
    }
    diagnostics_error(reader->diagnostics, value->word.place, "%s must be %s, not '%s'", row->name, expected,
                      text_show(&value->word, word, sizeof word));
    return false;
}

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
    reader_use(reader, "", row->name, row->methods, word->place);
    if (row->later) {
        diagnostics_error(reader->diagnostics, word->place, "'%s' is not available in this version: %s", row->name,
                          row->later);
        reader_skip_numbers(reader);
        return;
    }
    if (!reader_values(reader, row->arguments, row->name, values) || (row->choice && !choose(reader, row, &values[0]))) {
        if (row->fail)
            row->fail(reader, word);
        return;
    }
    if (row->field != KEYWORD_NO_FIELD)
        store_values(reader->scene, row, values);
    if (row->apply)
        row->apply(reader, word, values);
}

/* The bit of a top-level command in scene.given and reader.missing. */
static uint64_t bit_of(const char *name, enum category *category)
{
    const struct keyword *row = keyword_find(name, category);
    return UINT64_C(1) << (row - keyword_table(*category));
}

bool reader_was_given(const struct reader *reader, const char *name)
{
    enum category category;
    uint64_t bit = bit_of(name, &category);
    return misses_part(reader) || (reader->scene->given[category] & bit);
}

bool reader_is_missing(const struct reader *reader, const char *name)
{
    enum category category;
    uint64_t bit = bit_of(name, &category);
    return reader->missing[category] & bit;
}

bool reader_needs(struct reader *reader, const struct deck_word *word, const char *name)
{
    char shown[SHOWN];
    enum category category;
    uint64_t bit = bit_of(name, &category);
    if (reader_was_given(reader, name))
        return true;
    if (!reader_is_missing(reader, name))
        diagnostics_error(reader->diagnostics, word->place, "'%s' needs '%s' before it",
                          text_show(word, shown, sizeof shown), name);
    reader->missing[category] |= bit;
    return false;
}

void reader_command(struct reader *reader, const struct keyword *row, const struct deck_word *word)
{
    enum category category;
    uint64_t bit = bit_of(row->name, &category);
    if (row->once && (reader->scene->given[category] & bit))
        diagnostics_error(reader->diagnostics, word->place, "'%s' was given before", row->name);
    reader->scene->given[category] |= bit;
    reader->command = row->name;
    run_command(reader, row, word);
}

/* Notes a number where a word has to stand. A run of numbers is one mistake. */
static void unexpected_number(struct reader *reader, const struct deck_word *word, const char *what, const char *before)
{
    char shown[SHOWN];
    text_show(word, shown, sizeof shown);
    if (before)
        diagnostics_error(reader->diagnostics, word->place, "expected %s, found the number %s; '%s' takes no more",
                          what, shown, before);
    else
        diagnostics_error(reader->diagnostics, word->place, "expected %s, found the number %s", what, shown);
    reader_skip_numbers(reader);
}

/* --- blocks --- */

/* Whether a word that means something in the block and in the deck means the latter: commands of
 * the deck are followed by a word, those of blocks by an id. */
static bool leaves_block(struct reader *reader, const char *text)
{
    struct deck_word second;
    return keyword_find(text, NULL) && text_second(reader->text, &second) && !strchr("0123456789+-.", *second.text);
}

/* Whether an unknown word in a block was meant to end it: it is spelt nearly so, or nothing that
 * belongs to the block comes behind it. */
static bool seems_end(struct reader *reader, const struct keyword *table, const char *text, const char *end)
{
    struct deck_word next;
    char name[SHOWN];
    double real;
    const char *nearest = keyword_nearest(table, text);
    int distance = keyword_distance(text, end);
    if (distance >= 0 && (!nearest || distance < keyword_distance(text, nearest)))
        return true;
    return reader_at_line_end(reader) && text_peek(reader->text, &next) && !number_is_real(&next, &real)
        && !keyword_in(table, text_copy(&next, name, sizeof name)) && strncasecmp(name, end, 4) != 0;
}

/* Notes a word that does not belong in a block; whether it was meant to end the block. */
static bool unknown_in_block(struct reader *reader, const struct deck_word *word, const struct keyword *table,
                             const char *end, const char *owner)
{
    char text[SHOWN], what[SHOWN];
    double real;
    text_copy(word, text, sizeof text);
    snprintf(what, sizeof what, "a word of '%s' or '%s'", owner, end);
    if (number_is_real(word, &real)) {
        unexpected_number(reader, word, what, NULL);
        return false;
    }
    bool is_end = seems_end(reader, table, text, end);
    reader_unknown(reader, word, "word in a block", is_end ? end : keyword_nearest(table, text), owner);
    if (!is_end)
        reader_skip_numbers(reader);
    return is_end;
}

/* A command of the deck inside a block is reported once, and run as if the block had been closed,
 * so that its own mistakes are found too. False where that goes too deep. */
static bool command_in_block(struct reader *reader, struct deck_word *word, const char *end, const char *owner,
                             bool *is_reported)
{
    char text[SHOWN];
    text_copy(word, text, sizeof text);
    if (!*is_reported)
        diagnostics_error(reader->diagnostics, word->place, "'%s' inside the block '%s'; expected '%s' first", text,
                          owner, end);
    *is_reported = true;
    if (reader->depth == READER_DEPTH)
        return false;
    take(reader, word);
    reader_command(reader, keyword_find(text, NULL), word);
    return true;
}

bool reader_block(struct reader *reader, const struct keyword *table, const char *end, const char *owner, struct deck_place *places)
{
    struct deck_word word;
    char text[SHOWN];
    struct deck_place start = reader->last.place;
    const int errors = diagnostics_errors(reader->diagnostics);
    bool is_reported = false, is_closed = false;
    reader->depth++;
    while (!is_closed && !reader->ended && text_peek(reader->text, &word)) {
        const struct keyword *row = keyword_in(table, text_copy(&word, text, sizeof text));
        if (keyword_find(text, NULL) && (!row || leaves_block(reader, text))) {
            if (!command_in_block(reader, &word, end, owner, &is_reported))
                break;
            continue;
        }
        take(reader, &word);
        if (row && places)
            places[row - table] = word.place;
        if (strncasecmp(text, end, 4) == 0)
            is_closed = true;
        else if (row)
            run_command(reader, row, &word);
        else
            is_closed = unknown_in_block(reader, &word, table, end, owner);
    }
    reader->depth--;
    if (!is_closed && !is_reported) {
        if (!reader->is_cut)
            diagnostics_error(reader->diagnostics, start, "the block '%s' is not closed; expected '%s'", owner, end);
        reader->is_cut = true;
    }
    return diagnostics_errors(reader->diagnostics) == errors;
}

/* --- the deck --- */

/* Goes on behind a misspelt command. Where only one is meant it is run, so that what depends on
 * it is not reported too; otherwise all that may be meant count as given. */
static void guess_command(struct reader *reader, const struct deck_word *word, const char *text, int distance)
{
    const struct keyword *meant = NULL;
    int count = 0;
    for (int c = 0; c < CATEGORY_COUNT; c++)
        for (const struct keyword *row = keyword_table((enum category)c); row->name; row++)
            if (keyword_row_distance(row, text) == distance) {
                reader->scene->given[c] |= UINT64_C(1) << (row - keyword_table((enum category)c));
                meant = row;
                count++;
            }
    if (count == 1 && distance == 1 && strcmp(meant->name, "endi") != 0)
        run_command(reader, meant, word);
    else
        reader_skip_numbers(reader);
}

static void unknown_command(struct reader *reader, const struct deck_word *word, const char *text)
{
    double real;
    if (number_is_real(word, &real)) {
        unexpected_number(reader, word, "a keyword", reader->command);
        return;
    }
    if (block_of_end(text)) {
        diagnostics_error(reader->diagnostics, word->place, "'%.4s' ends no block; expected '%s' before it", text,
                          block_of_end(text));
        return;
    }
    const char *nearest = keyword_nearest_top(text);
    reader_unknown(reader, word, "keyword", nearest, "");
    if (nearest) {
        guess_command(reader, word, text, keyword_distance(text, nearest));
        return;
    }
    reader->is_partial = true;
    reader_skip_numbers(reader);
}

/* What the whole deck lacks; not asked when a part of it could not be read. */
static void finish(struct reader *reader)
{
    struct deck_place end = reader->last.place;
    if (reader->is_cut || misses_part(reader))
        return;
    if (!reader->ended && !reader_was_given(reader, "endi")) {
        diagnostics_error(reader->diagnostics, text_behind(&reader->last), "the deck ends without 'endi'");
        return;
    }
    if (!reader_check_methods(reader))
        return;
    if (reader->scene->method == METHOD_RKPM) {
        reader_finish_rkpm(reader);
        return;
    }
    reader_finish_grid(reader, end);
    reader_finish_materials(reader);
    reader_finish_targets(reader);
    reader_finish_solving(reader);
    reader_finish_process(reader);
    if (reader->scene->method == METHOD_SPH)
        reader_finish_sph(reader);
    reader_finish_general(reader, end);
}

struct scene *reader_read(struct deck_text *text, struct diagnostics *diagnostics)
{
    struct reader reader = {.text = text, .diagnostics = diagnostics, .scene = scene_open()};
    struct deck_word word;
    char name[SHOWN];
    reader.last.place = (struct deck_place){0, 1, 1, 0};
    while (!reader.ended && take(&reader, &word)) {
        const struct keyword *row = keyword_find(text_copy(&word, name, sizeof name), NULL);
        if (row)
            reader_command(&reader, row, &word);
        else
            unknown_command(&reader, &word, name);
    }
    finish(&reader);
    memory_free(reader.uses);
    return reader.scene;
}
