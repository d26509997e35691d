/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tecplot_number: see tecplot_read.h. */
#define _POSIX_C_SOURCE 200809L

#include "tecplot_read.h"
#include "words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum {
    LONGEST_NUMBER = 2000 /* characters; a double written out in full has fewer than 1100 */
};

/* NaN, nan(...), Inf, Infinity with or without a sign. */
static bool read_nonfinite(struct words_span span, double *value)
{
    const bool negative = span.length > 0 && span.text[0] == '-';
    if (span.length > 0 && (span.text[0] == '-' || span.text[0] == '+')) {
        ++span.text;
        --span.length;
    }
    if (words_equal(span, "inf") || words_equal(span, "infinity")) {
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
    while (end < length && (words_is_digit(text[end]) || (text[end] == '.' && !point))) {
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
    while (end < length && words_is_digit(text[end]))
        ++end;
    return end == length ? start : length;
}

const char *tecplot_number(const char *text, size_t length, double *value)
{
    static const char wrong[] = "is not a number";
    if (read_nonfinite((struct words_span){text, length}, value))
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
