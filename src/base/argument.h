/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a word of the deck takes: one row an argument, with unit and limit. The reader, the help,
 * the manual and the error messages all use these rows. */
#ifndef BASE_ARGUMENT_H
#define BASE_ARGUMENT_H

#include <stdbool.h>

enum argument_kind {
    ARGUMENT_REAL,
    ARGUMENT_INTEGER,
    ARGUMENT_WORD
};

enum argument_limit {
    LIMIT_NONE,
    LIMIT_POSITIVE,      /* > 0 */
    LIMIT_NOT_NEGATIVE,  /* >= 0 */
    LIMIT_AT_LEAST_ONE,  /* >= 1 */
    LIMIT_COUNT,         /* 1 ... 2147483647 */
    LIMIT_POISSON,       /* -1 < nu < 0.5 */
    LIMIT_STEP_SCALE,    /* 0 < f <= 2.5 */
    LIMIT_BOUNDARY,      /* 0, 1, 2 */
    LIMIT_NORMAL,        /* 0, 1, 2 */
    LIMIT_DIGITS,        /* 2 ... 17 */
    LIMIT_FRACTION,      /* 0 ... 1 */
    LIMIT_BELOW_ONE,     /* -1 < a < 1 */
    LIMIT_FLAG,          /* 0, 1 */
    LIMIT_DIMENSION,     /* 2, 3 */
    LIMIT_AXES,          /* 1, 2, 3 */
    LIMIT_GAUSS,         /* 1 ... 10 */
    LIMIT_ROWS
};

struct argument {
    const char *name;
    const char *unit; /* dimension in words; NULL for a pure number */
    enum argument_kind kind;
    enum argument_limit limit;
};

/* Number of rows before the one without a name. */
int argument_count(const struct argument *arguments);

/* Whether `value` keeps the limit. */
bool argument_within(enum argument_limit limit, double value);

/* The limit in words, such as "greater than 0"; an empty text for LIMIT_NONE. */
const char *argument_limit_text(enum argument_limit limit);

#endif
