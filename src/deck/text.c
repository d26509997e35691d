/* SPDX-License-Identifier: GPL-3.0-or-later */
#define _POSIX_C_SOURCE 200809L
#include "deck/text.h"
#include "base/memory.h"
#include "deck/diagnostics.h"

#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/* A point in a file that is being read. */
struct cursor {
    int file;
    size_t offset;
    size_t line_start;
    long line;
    bool after_comma; /* a comma was passed since the last word of this line */
    bool line_begins; /* no word taken from this line yet */
    bool is_silent;   /* looking ahead: mistakes are reported when the words are taken */
};

struct deck_text {
    struct diagnostics *diagnostics;
    struct deck_file *files;
    size_t n_files, files_capacity;
    struct cursor *stack;
    size_t depth, stack_capacity;
    struct deck_word peeked;
    bool has_peeked;
    bool refuses_includes;
    bool is_cut; /* a file ended at a NUL byte */
};

struct deck_text *text_open(struct diagnostics *diagnostics)
{
    struct deck_text *text = memory_array(1, sizeof *text, "the deck");
    text->diagnostics = diagnostics;
    return text;
}

void text_close(struct deck_text *text)
{
    if (!text)
        return;
    for (size_t i = 0; i < text->n_files; i++) {
        memory_free(text->files[i].name);
        memory_free(text->files[i].text);
    }
    memory_free(text->files);
    memory_free(text->stack);
    memory_free(text);
}

/* Reads all of a stream into a growing array. Returns 0 or an errno value; EFBIG for more than
 * `most` bytes. */
static int read_all(FILE *stream, size_t most, char **bytes, size_t *size)
{
    size_t capacity = 0, used = 0;
    char *array = NULL;
    while (used <= most) {
        array = memory_grow(array, &capacity, used + 65536, 1, "the deck");
        size_t got = fread(array + used, 1, capacity - used, stream);
        used += got;
        if (got == 0)
            break;
    }
    int failure = ferror(stream) ? (errno ? errno : EIO) : used > most ? EFBIG : 0;
    *bytes = array;
    *size = used;
    return failure;
}

int text_read_file(const struct deck_text *text, const char *path, size_t most, char **bytes, size_t *size)
{
    bool standard = strcmp(path, "-") == 0;
    *bytes = NULL;
    *size = 0;
    if (text->refuses_includes)
        return EPERM;
    errno = 0;
    FILE *stream = standard ? stdin : fopen(path, "rb");
    if (!stream)
        return errno ? errno : EIO;
    int failure = read_all(stream, most, bytes, size);
    if (!standard)
        fclose(stream);
    return failure;
}

int text_include_file(struct deck_text *text, const char *path)
{
    char *bytes;
    size_t size;
    int failure = text_read_file(text, path, SIZE_MAX / 4, &bytes, &size);
    if (!failure)
        text_include_memory(text, strcmp(path, "-") == 0 ? "<stdin>" : path, bytes, size);
    memory_free(bytes);
    return failure;
}

char *text_path(const struct deck_text *text, const struct deck_word *word)
{
    const char *deck = text->files[word->place.file].name, *name = word->text;
    size_t length = word->length;
    if (*name == '"') {
        name++;
        length -= length > 1 && name[length - 2] == '"' ? 2 : 1;
    }
    const char *slash = strrchr(deck, '/');
    size_t folder = slash && (length == 0 || name[0] != '/') ? (size_t)(slash - deck) + 1 : 0;
    char *path = memory_array(folder + length + 1, 1, "a file name");
    memcpy(path, deck, folder);
    memcpy(path + folder, name, length);
    return path;
}

void text_include_memory(struct deck_text *text, const char *name, const char *bytes, size_t size)
{
    static const char mark[] = "\xEF\xBB\xBF"; /* that some editors put before UTF-8 */
    if (size >= 3 && memcmp(bytes, mark, 3) == 0) {
        bytes += 3;
        size -= 3;
    }
    text->files = memory_grow(text->files, &text->files_capacity, text->n_files + 1,
                              sizeof *text->files, "the deck");
    struct deck_file *file = &text->files[text->n_files];
    file->name = memory_text(name, strlen(name));
    file->text = memory_text(bytes, size);
    const char *nul = memchr(file->text, 0, size);
    file->size = nul ? (size_t)(nul - file->text) : size;
    file->has_nul = nul != NULL;
    text->stack = memory_grow(text->stack, &text->stack_capacity, text->depth + 1,
                              sizeof *text->stack, "the deck");
    text->stack[text->depth++] = (struct cursor){.file = (int)text->n_files, .line = 1, .line_begins = true};
    text->n_files++;
}

void text_refuse_includes(struct deck_text *text)
{
    text->refuses_includes = true;
}

bool text_is_cut(const struct deck_text *text)
{
    return text->is_cut;
}

static struct deck_place place_of(const struct cursor *cursor)
{
    return (struct deck_place){cursor->file, cursor->line,
                               (long)(cursor->offset - cursor->line_start) + 1, cursor->offset};
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f' || c == '\0';
}

static bool ends_word(char c)
{
    return is_blank(c) || c == '\n' || c == ',' || c == '!';
}

static void pass_line_end(struct cursor *cursor)
{
    cursor->offset++;
    cursor->line++;
    cursor->line_start = cursor->offset;
    cursor->after_comma = false;
    cursor->line_begins = true;
}

/* Passes a comma. Of a run of commas the first that is too many is reported. */
static void pass_comma(struct deck_text *text, struct cursor *cursor)
{
    const struct deck_file *file = &text->files[cursor->file];
    bool is_wrong = cursor->after_comma || cursor->line_begins;
    if (is_wrong && !cursor->is_silent)
        diagnostics_error(text->diagnostics, place_of(cursor),
                          cursor->after_comma ? "empty word between two commas; expected a word or number"
                                              : "comma before the first word of a line");
    cursor->after_comma = true;
    do
        cursor->offset++;
    while (is_wrong && cursor->offset < file->size
           && (file->text[cursor->offset] == ',' || is_blank(file->text[cursor->offset])));
}

/* Moves the cursor to the next word of its file; false at the file's end. */
static bool find_word(struct deck_text *text, struct cursor *cursor)
{
    const struct deck_file *file = &text->files[cursor->file];
    while (cursor->offset < file->size) {
        char c = file->text[cursor->offset];
        if (c == '\n')
            pass_line_end(cursor);
        else if (is_blank(c))
            cursor->offset++;
        else if (c == ',')
            pass_comma(text, cursor);
        else if (c == '!')
            while (cursor->offset < file->size && file->text[cursor->offset] != '\n')
                cursor->offset++;
        else
            return true;
    }
    if (file->has_nul && !cursor->is_silent) {
        text->is_cut = true;
        diagnostics_error(text->diagnostics, place_of(cursor), "NUL byte; a deck is plain text, reading stops here");
    }
    return false;
}

/* Moves the cursor behind a quoted word, which may hold anything but a line end. */
static void pass_quoted(struct deck_text *text, struct cursor *cursor)
{
    const struct deck_file *file = &text->files[cursor->file];
    size_t end = cursor->offset + 1;
    while (end < file->size && file->text[end] != '"' && file->text[end] != '\n')
        end++;
    bool is_closed = end < file->size && file->text[end] == '"';
    if (!is_closed && !cursor->is_silent)
        diagnostics_error(text->diagnostics, place_of(cursor), "the quotation mark is not closed on this line");
    cursor->offset = end + is_closed;
}

/* The word at the cursor, which moves behind it. */
static void pass_word(struct deck_text *text, struct cursor *cursor, struct deck_word *word)
{
    const struct deck_file *file = &text->files[cursor->file];
    word->place = place_of(cursor);
    word->text = file->text + cursor->offset;
    if (*word->text == '"')
        pass_quoted(text, cursor);
    else
        while (cursor->offset < file->size && !ends_word(file->text[cursor->offset]))
            cursor->offset++;
    word->length = (size_t)(file->text + cursor->offset - word->text);
    cursor->after_comma = false;
    cursor->line_begins = false;
}

static bool take_word(struct deck_text *text, struct deck_word *word)
{
    while (text->depth > 0 && !diagnostics_is_full(text->diagnostics)) {
        struct cursor *cursor = &text->stack[text->depth - 1];
        if (find_word(text, cursor)) {
            pass_word(text, cursor, word);
            return true;
        }
        text->depth--;
    }
    return false;
}

bool text_next(struct deck_text *text, struct deck_word *word)
{
    if (!text->has_peeked)
        return take_word(text, word);
    *word = text->peeked;
    text->has_peeked = false;
    return true;
}

bool text_peek(struct deck_text *text, struct deck_word *word)
{
    if (!text->has_peeked)
        text->has_peeked = take_word(text, &text->peeked);
    if (text->has_peeked)
        *word = text->peeked;
    return text->has_peeked;
}

bool text_after(struct deck_text *text, struct deck_word *word)
{
    const struct deck_place *place = &word->place;
    struct cursor cursor = {.file = place->file, .offset = place->offset + word->length,
                            .line_start = place->offset - (size_t)(place->column - 1), .line = place->line,
                            .is_silent = true};
    if (!find_word(text, &cursor))
        return false;
    pass_word(text, &cursor, word);
    return true;
}

bool text_second(struct deck_text *text, struct deck_word *word)
{
    long line;
    if (!text_peek(text, word))
        return false;
    line = word->place.line;
    return text_after(text, word) && word->place.line == line;
}

char *text_rest_of_line(struct deck_text *text, const struct deck_word *from)
{
    const struct deck_file *file = &text->files[from->place.file];
    size_t start = from->place.offset;
    size_t end = start;
    while (end < file->size && file->text[end] != '\n' && file->text[end] != '!')
        end++;
    char *line = memory_text(file->text + start, end - start);
    size_t used = 0;
    for (size_t i = 0; i < end - start; i++) {
        char c = is_blank(line[i]) ? ' ' : line[i];
        if (c != ' ' || (used > 0 && line[used - 1] != ' '))
            line[used++] = c;
    }
    while (used > 0 && line[used - 1] == ' ')
        used--;
    line[used] = '\0';
    struct cursor *cursor = text->depth > 0 ? &text->stack[text->depth - 1] : NULL;
    if (cursor && cursor->file == from->place.file && !text->has_peeked) {
        while (cursor->offset < file->size && file->text[cursor->offset] != '\n')
            cursor->offset++;
    }
    return line;
}

bool text_is_open(const struct deck_text *text, const char *path)
{
    struct stat sought, open;
    if (text->refuses_includes || stat(path, &sought) != 0)
        return false;
    for (size_t i = 0; i < text->depth; i++)
        if (stat(text->files[text->stack[i].file].name, &open) == 0 && open.st_dev == sought.st_dev
            && open.st_ino == sought.st_ino)
            return true;
    return false;
}

int text_depth(const struct deck_text *text)
{
    return (int)text->depth;
}

int text_file_count(const struct deck_text *text)
{
    return (int)text->n_files;
}

const struct deck_file *text_file(const struct deck_text *text, int file)
{
    return &text->files[file];
}

struct deck_place text_behind(const struct deck_word *word)
{
    struct deck_place place = word->place;
    place.column += (long)word->length;
    place.offset += word->length;
    return place;
}

char *text_show(const struct deck_word *word, char *buffer, size_t size)
{
    text_copy(word, buffer, size);
    if (word->length < size)
        return buffer;
    size_t end = size - 4;
    while (end > 0 && ((unsigned char)buffer[end] & 0xC0) == 0x80) /* not inside a UTF-8 character */
        end--;
    memcpy(buffer + end, "...", 4);
    return buffer;
}

char *text_copy(const struct deck_word *word, char *buffer, size_t size)
{
    size_t length = word->length < size - 1 ? word->length : size - 1;
    memcpy(buffer, word->text, length);
    buffer[length] = '\0';
    return buffer;
}
