/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "deck/diagnostics.h"
#include "base/memory.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum { SHOWN_WIDTH = 110, SHOWN_ERRORS = 100 };

struct note {
    struct deck_place place;
    bool is_error;
    char *text;
    size_t order;
};

struct diagnostics {
    struct note *notes;
    size_t count, capacity;
    int errors;
};

struct diagnostics *diagnostics_open(void)
{
    return memory_array(1, sizeof(struct diagnostics), "messages");
}

static void forget(struct diagnostics *diagnostics)
{
    for (size_t i = 0; i < diagnostics->count; i++)
        memory_free(diagnostics->notes[i].text);
    diagnostics->count = 0;
}

void diagnostics_close(struct diagnostics *diagnostics)
{
    if (!diagnostics)
        return;
    forget(diagnostics);
    memory_free(diagnostics->notes);
    memory_free(diagnostics);
}

static bool is_control(char c)
{
    return (unsigned char)c < 32 || c == 127;
}

/* Whether a byte continues a UTF-8 character, so that it takes no place on the screen. */
static bool is_continuation(char c)
{
    return ((unsigned char)c & 0xC0) == 0x80;
}

/* Whether a mistake was noted at this place. */
static bool is_noted(const struct diagnostics *diagnostics, struct deck_place place)
{
    for (size_t i = 0; i < diagnostics->count; i++) {
        const struct note *note = &diagnostics->notes[i];
        if (note->is_error && note->place.file == place.file && note->place.offset == place.offset)
            return true;
    }
    return false;
}

static void add(struct diagnostics *diagnostics, struct deck_place place, bool is_error,
                const char *format, va_list arguments)
{
    diagnostics->errors += is_error;
    if (diagnostics->count >= SHOWN_ERRORS)
        return;
    char text[1024];
    vsnprintf(text, sizeof text, format, arguments);
    for (char *c = text; *c; c++) /* words of the deck must not reach a terminal as control sequences */
        if (is_control(*c))
            *c = '?';
    diagnostics->notes = memory_grow(diagnostics->notes, &diagnostics->capacity, diagnostics->count + 1,
                                     sizeof *diagnostics->notes, "messages");
    diagnostics->notes[diagnostics->count] =
        (struct note){place, is_error, memory_text(text, strlen(text)), diagnostics->count};
    diagnostics->count++;
}

void diagnostics_error(struct diagnostics *diagnostics, struct deck_place place, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    if (!is_noted(diagnostics, place))
        add(diagnostics, place, true, format, arguments);
    va_end(arguments);
}

void diagnostics_lack(struct diagnostics *diagnostics, struct deck_place place, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    add(diagnostics, place, true, format, arguments);
    va_end(arguments);
}

void diagnostics_warning(struct diagnostics *diagnostics, struct deck_place place, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    if (!is_noted(diagnostics, place))
        add(diagnostics, place, false, format, arguments);
    va_end(arguments);
}

int diagnostics_errors(const struct diagnostics *diagnostics)
{
    return diagnostics->errors;
}

bool diagnostics_is_full(const struct diagnostics *diagnostics)
{
    return diagnostics->errors > SHOWN_ERRORS;
}

static int by_place(const void *left, const void *right)
{
    const struct note *a = left, *b = right;
    if (a->place.file != b->place.file)
        return a->place.file < b->place.file ? -1 : 1;
    if (a->place.offset != b->place.offset)
        return a->place.offset < b->place.offset ? -1 : 1;
    return a->order < b->order ? -1 : a->order > b->order;
}

/* Prints the line of the place, cut to a window when it is long, and a caret under the place. */
static void print_line(const struct deck_file *file, struct deck_place place, FILE *stream)
{
    size_t start = place.offset, end = place.offset;
    while (start > 0 && file->text[start - 1] != '\n' && place.offset - start < SHOWN_WIDTH / 2)
        start--;
    while (end < file->size && file->text[end] != '\n' && end - start < SHOWN_WIDTH)
        end++;
    while (start < place.offset && is_continuation(file->text[start]))
        start++;
    int before = 0;
    fputs("    ", stream);
    for (size_t i = start; i < end; i++) {
        char c = file->text[i];
        before += i < place.offset && !is_continuation(c);
        fputc(c == '\t' || c == '\r' ? ' ' : is_control(c) ? '?' : c, stream);
    }
    fprintf(stream, "\n    %*s^\n", before, "");
}

static void print_note(const struct note *note, const struct deck_text *text, FILE *stream, bool colour)
{
    const struct deck_file *file = text_file(text, note->place.file);
    const char *begin = !colour ? "" : note->is_error ? "\033[1;31m" : "\033[1;35m";
    fprintf(stream, "%s:%ld:%ld: %s%s:%s %s\n", file->name, note->place.line, note->place.column, begin,
            note->is_error ? "error" : "warning", colour ? "\033[0m" : "", note->text);
    print_line(file, note->place, stream);
}

void diagnostics_print(struct diagnostics *diagnostics, const struct deck_text *text, FILE *stream, bool colour)
{
    if (diagnostics->count > 1)
        qsort(diagnostics->notes, diagnostics->count, sizeof *diagnostics->notes, by_place);
    for (size_t i = 0; i < diagnostics->count; i++)
        print_note(&diagnostics->notes[i], text, stream, colour);
    if (diagnostics_is_full(diagnostics))
        fprintf(stream, "... and more errors; reading stopped\n");
    forget(diagnostics);
}
