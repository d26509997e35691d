/* SPDX-License-Identifier: GPL-3.0-or-later */
/* words: pieces of a line of text, as the reader of Tecplot files sees them. */
#ifndef TOOLS_WORDS_H
#define TOOLS_WORDS_H

#include <stdbool.h>
#include <stddef.h>

enum { WORDS_LONGEST_QUOTATION = 40 /* characters of the file repeated in a message */ };

/* A piece of a line. */
struct words_span {
    const char *text;
    size_t length;
};

struct words_quotation {
    char text[WORDS_LONGEST_QUOTATION + sizeof "''..."];
};

/* The span in quotes, fit for a terminal and for a message. */
struct words_quotation words_quoted(struct words_span span);

bool words_is_digit(char c);
bool words_is_letter(char c); /* or an underscore */

const char *words_skip_blanks(const char *cursor);
const char *words_skip_separators(const char *cursor); /* blanks and commas */

/* The characters up to the next blank, comma or end. */
struct words_span words_token(const char *cursor);

/* The letters, digits and underscores at the cursor; empty unless they begin with a letter. */
struct words_span words_keyword(const char *cursor);

/* The span without leading and trailing blanks. */
struct words_span words_trimmed(struct words_span span);

/* Whether the span is the word, in upper or lower case. */
bool words_equal(struct words_span span, const char *word);

/* How many letters have to be changed, added or left out to make one word of the other; upper and
 * lower case are the same. */
size_t words_distance(const char *one, const char *other);

#endif
