/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A few helpers for tests: each check prints one line, `ok name` or `FAIL name: why`. */
#ifndef UNIT_CHECK_H
#define UNIT_CHECK_H

#include <math.h>
#include <stdbool.h>
#include <stdio.h>

static int check_failures;

static inline void check_true(const char *name, bool good)
{
    if (good) {
        printf("ok %s\n", name);
    } else {
        printf("FAIL %s\n", name);
        check_failures++;
    }
}

/* |value - expected| <= tolerance, absolute. */
static inline void check_near(const char *name, double value, double expected, double tolerance)
{
    if (fabs(value - expected) <= tolerance) {
        printf("ok %s\n", name);
    } else {
        printf("FAIL %s: %.17g instead of %.17g (tolerance %.3g)\n", name, value, expected, tolerance);
        check_failures++;
    }
}

static inline int check_result(void)
{
    return check_failures > 0;
}

#endif
