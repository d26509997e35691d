/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "deck/number.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

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

/* Any number of digits: a copy on the heap serves the long ones. */
bool number_read(const struct deck_word *word, double *real, bool *is_integer)
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

bool number_is_real(const struct deck_word *word, double *real)
{
    bool is_integer;
    return number_read(word, real, &is_integer);
}

bool number_is_integer(const struct deck_word *word, long *integer)
{
    double real;
    bool is_integer;
    if (!number_read(word, &real, &is_integer) || !is_integer || fabs(real) > 9e15)
        return false;
    *integer = (long)real;
    return true;
}
