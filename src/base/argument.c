/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/argument.h"

#include <float.h>
#include <limits.h>
#include <stddef.h>

struct limit {
    const char *text;
    double low, high;
    bool low_open, high_open;
};

static const struct limit limits[LIMIT_ROWS] = {
    [LIMIT_NONE] = {"", -DBL_MAX, DBL_MAX, false, false},
    [LIMIT_POSITIVE] = {"greater than 0", 0, DBL_MAX, true, false},
    [LIMIT_NOT_NEGATIVE] = {"0 or more", 0, DBL_MAX, false, false},
    [LIMIT_AT_LEAST_ONE] = {"1 or more", 1, DBL_MAX, false, false},
    [LIMIT_COUNT] = {"from 1 to 2147483647", 1, INT_MAX, false, false},
    [LIMIT_POISSON] = {"between -1 and 0.5", -1, 0.5, true, true},
    [LIMIT_STEP_SCALE] = {"greater than 0 and at most 2.5", 0, 2.5, true, false},
    [LIMIT_BOUNDARY] = {"0 (free), 1 (fixed) or 2 (normal component fixed)", 0, 2, false, false},
    [LIMIT_NORMAL] = {"0 (of both components), 1 (of the first) or 2 (of the second)", 0, 2, false, false},
    [LIMIT_DIGITS] = {"from 2 to 17", 2, 17, false, false},
    [LIMIT_FRACTION] = {"from 0 to 1", 0, 1, false, false},
    [LIMIT_BELOW_ONE] = {"between -1 and 1", -1, 1, true, true},
    [LIMIT_FLAG] = {"0 or 1", 0, 1, false, false},
    [LIMIT_DIMENSION] = {"2 or 3", 2, 3, false, false},
    [LIMIT_AXES] = {"1, 2 or 3", 1, 3, false, false},
    [LIMIT_GAUSS] = {"from 1 to 10", 1, 10, false, false},
};

int argument_count(const struct argument *arguments)
{
    int count = 0;
    while (arguments && arguments[count].name)
        count++;
    return count;
}

bool argument_within(enum argument_limit limit, double value)
{
    const struct limit *row = &limits[limit];
    bool above = row->low_open ? value > row->low : value >= row->low;
    bool below = row->high_open ? value < row->high : value <= row->high;
    return above && below;
}

const char *argument_limit_text(enum argument_limit limit)
{
    return limits[limit].text;
}
