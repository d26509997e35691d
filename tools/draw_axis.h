/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * draw_axis: a scale with ticks at round numbers: 1, 2 or 5 times a power of ten apart, or decades
 * when it is logarithmic.
 */
#ifndef TOOLS_DRAW_AXIS_H
#define TOOLS_DRAW_AXIS_H

#include <stdbool.h>

enum { DRAW_AXIS_TICKS = 40, DRAW_AXIS_LABEL = 32 };

struct draw_axis {
    double low, high; /* its ends */
    bool logarithmic;
    int exponent; /* labels are in units of 10^exponent; 0 unless linear */
    int tick_count;
    double ticks[DRAW_AXIS_TICKS];
    char labels[DRAW_AXIS_TICKS][DRAW_AXIS_LABEL]; /* empty for a minor tick */
};

/* A scale from low to high (low < high; > 0 when logarithmic) with about `wanted` labels. With
 * `widen` the ends move out to ticks. */
void draw_axis_open(struct draw_axis *axis, double low, double high, bool logarithmic, int wanted,
                    bool widen);

/* Where a value is on the scale: 0 at its low, 1 at its high end. */
double draw_axis_part(const struct draw_axis *axis, double value);

/* Widens an empty range, so that a scale has some length. */
void draw_axis_spread(double *low, double *high, bool logarithmic);

/* The name of a scale with its unit (may be NULL) and power: name (10^{3} unit). */
void draw_axis_title(const struct draw_axis *axis, const char *name, const char *unit, char *title,
                     unsigned long room);

#endif
