/* SPDX-License-Identifier: GPL-3.0-or-later */
/* swing: the strongest swing in a curve over time, its period and how fast it dies away.
 *
 * Rows need not be evenly spaced, but times must grow. Both weigh the curve with a Hann window, so
 * that a drift and quicker or slower swings of smaller size hardly count. */
#ifndef TOOLS_SWING_H
#define TOOLS_SWING_H

#include <stdbool.h>
#include <stddef.h>

enum { SWING_LEAST_ROWS = 8 };

/* At least SWING_LEAST_ROWS rows whose times grow. */
bool swing_has_time(const double *times, size_t count);

/* The period for which the curve has the largest Fourier component, of those that fit 2 to 200
 * times into its time. */
double swing_period(const double *values, const double *times, size_t count);

/* The rate b of exp(-b t): from the size of that swing in the first and in the second half of the
 * time. */
double swing_decay(const double *values, const double *times, size_t count);

#endif
