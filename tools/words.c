/* SPDX-License-Identifier: GPL-3.0-or-later */
/* words: see words.h. */
#define _POSIX_C_SOURCE 200809L

#include "words.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

/* The span in quotes, fit for a terminal and for a message. */
struct words_quotation words_quoted(struct words_span span)
{
    struct words_quotation result;
    size_t end = 0;
    result.text[end++] = '\'';
    for (size_t i = 0; i < span.length && i < WORDS_LONGEST_QUOTATION; ++i) {
        const unsigned char byte = (unsigned char)span.text[i];
        result.text[end++] = byte < 0x20 || byte > 0x7e ? '?' : span.text[i];
    }
    (void)snprintf(result.text + end, sizeof result.text - end, "%s",
                   span.length > WORDS_LONGEST_QUOTATION ? "'..." : "'");
    return result;
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v';
}

static bool is_separator(char c)
{
    return is_blank(c) || c == ',';
}

bool words_is_digit(char c)
{
    return c >= '0' && c <= '9';
}

bool words_is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

const char *words_skip_blanks(const char *cursor)
{
    while (is_blank(*cursor))
        ++cursor;
    return cursor;
}

const char *words_skip_separators(const char *cursor)
{
    while (is_separator(*cursor))
        ++cursor;
    return cursor;
}

/* The characters up to the next blank, comma or end. */
struct words_span words_token(const char *cursor)
{
    const char *end = cursor;
    while (*end != '\0' && !is_separator(*end))
        ++end;
    return (struct words_span){cursor, (size_t)(end - cursor)};
}

/* The letters, digits and underscores at the cursor; empty unless they begin with a letter. */
struct words_span words_keyword(const char *cursor)
{
    const char *end = cursor;
    if (words_is_letter(*end))
        while (words_is_letter(*end) || words_is_digit(*end))
            ++end;
    return (struct words_span){cursor, (size_t)(end - cursor)};
}

struct words_span words_trimmed(struct words_span span)
{
    while (span.length > 0 && is_blank(span.text[0])) {
        ++span.text;
        --span.length;
    }
    while (span.length > 0 && is_blank(span.text[span.length - 1]))
        --span.length;
    return span;
}

bool words_equal(struct words_span span, const char *word)
{
    return span.length == strlen(word) && strncasecmp(span.text, word, span.length) == 0;
}

static size_t smaller(size_t a, size_t b)
{
    return a < b ? a : b;
}

size_t words_distance(const char *one, const char *other)
{
    enum { LONGEST = 63 };
    size_t row[LONGEST + 1]; /* distances of the letters of `one` so far to each start of `other` */
    const size_t length = smaller(strlen(other), LONGEST);
    for (size_t j = 0; j <= length; ++j)
        row[j] = j;
    for (size_t i = 0; one[i] != '\0'; ++i) {
        size_t diagonal = row[0];
        row[0] = i + 1;
        for (size_t j = 1; j <= length; ++j) {
            const size_t changed = diagonal + (strncasecmp(one + i, other + j - 1, 1) != 0);
            diagonal = row[j];
            row[j] = smaller(changed, 1 + smaller(row[j], row[j - 1]));
        }
    }
    return row[length];
}
