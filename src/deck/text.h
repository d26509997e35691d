/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The text of a deck as a stream of words with their places (spec 1.2).
 * Words are separated by blanks, tabs or one comma; '!' starts a comment that ends with the
 * line; LF and CRLF end lines. There is no limit on the length of a line, a word, or on their
 * number. Included files are read in place. */
#ifndef DECK_TEXT_H
#define DECK_TEXT_H

#include <stdbool.h>
#include <stddef.h>

struct deck_place {
    int file;      /* index into deck_text.files */
    long line;     /* from 1 */
    long column;   /* from 1, in bytes */
    size_t offset; /* of the place in the file's text */
};

struct deck_word {
    const char *text; /* inside the file's text, not ended by NUL */
    size_t length;
    struct deck_place place;
};

struct deck_file {
    char *name;
    char *text;
    size_t size;  /* up to the first NUL byte */
    bool has_nul; /* the file goes on behind it, but is not read */
};

struct deck_text; /* the files and the point reached in each */
struct diagnostics;

/* An empty stream that reports lexical mistakes to `diagnostics`. */
struct deck_text *text_open(struct diagnostics *diagnostics);
void text_close(struct deck_text *text);

/* Starts reading the file `path` ("-" is standard input) at the present point.
 * Returns 0, or an errno value when it can't be read. */
int text_include_file(struct deck_text *text, const char *path);

/* The same with `size` bytes of memory, copied, under a name for messages. */
void text_include_memory(struct deck_text *text, const char *name, const char *bytes, size_t size);

/* All bytes of a file that a deck names ("-" is standard input), at most `most` of them; the caller
 * frees them with memory_free, also on failure. Returns 0, or an errno value: EFBIG where there
 * are more. */
int text_read_file(const struct deck_text *text, const char *path, size_t most, char **bytes, size_t *size);

/* The path of a file that a word, quoted or not, names: seen from the folder of the deck in which
 * the word stands. The caller frees it with memory_free. */
char *text_path(const struct deck_text *text, const struct deck_word *word);

/* Makes text_include_file and text_read_file fail with EPERM: what is read from memory stays there. */
void text_refuse_includes(struct deck_text *text);

/* The next word, or false at the end of the last file. */
bool text_next(struct deck_text *text, struct deck_word *word);

/* The next word without taking it. */
bool text_peek(struct deck_text *text, struct deck_word *word);

/* Replaces a word by the one after it in its file, without taking any; false at the file's end. */
bool text_after(struct deck_text *text, struct deck_word *word);

/* The word after the next one where both stand on one line; takes none. */
bool text_second(struct deck_text *text, struct deck_word *word);

/* The rest of the line that ends the last word taken, without comment, with runs of blanks
 * squeezed; takes it. The caller frees it with memory_free. */
char *text_rest_of_line(struct deck_text *text, const struct deck_word *from);

/* Whether this file is being read already (an include that includes itself). */
bool text_is_open(const struct deck_text *text, const char *path);

/* Whether a file ended at a NUL byte, which was reported. */
bool text_is_cut(const struct deck_text *text);

/* Files being read now: 1 in the deck itself, more inside includes. */
int text_depth(const struct deck_text *text);
int text_file_count(const struct deck_text *text);
const struct deck_file *text_file(const struct deck_text *text, int file);

/* The place just behind a word. */
struct deck_place text_behind(const struct deck_word *word);

/* The same for messages: where the word does not fit, "..." ends it. */
char *text_show(const struct deck_word *word, char *buffer, size_t size);

/* Copies the word, cut to fit `size`, as a C string. Returns buffer. */
char *text_copy(const struct deck_word *word, char *buffer, size_t size);

#endif
