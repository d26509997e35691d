/* SPDX-License-Identifier: GPL-3.0-or-later */
/* draw_axis: see draw_axis.h. */
#include "draw_axis.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A tick this part of a step beyond an end still belongs to the scale. */
static const double slack = 1e-6;

/* The round number 1, 2 or 5 times a power of ten that is nearest to `rough`. */
static double round_step(double rough)
{
    static const double limits[] = {1.414, 3.162, 7.071}; /* halfway, as ratios */
    static const double rounds[] = {1.0, 2.0, 5.0};
    const double power = pow(10.0, floor(log10(rough)));
    for (int i = 0; i < 3; ++i)
        if (rough <= limits[i] * power)
            return rounds[i] * power;
    return 10.0 * power;
}

/* The step between ticks; a finer one where fewer than two ticks would lie on the scale. */
static double step_of(double low, double high, int wanted)
{
    double step = round_step((high - low) / wanted);
    for (int i = 1; i < 4 && floor(high / step + slack) - ceil(low / step - slack) < 1.0; ++i)
        step = round_step((high - low) / (wanted << i));
    return step;
}

static void add_tick(struct draw_axis *axis, double value, const char *label)
{
    if (axis->tick_count == DRAW_AXIS_TICKS)
        return;
    axis->ticks[axis->tick_count] = value;
    (void)snprintf(axis->labels[axis->tick_count], DRAW_AXIS_LABEL, "%s", label);
    ++axis->tick_count;
}

/* Numbers that would need many zeros are given in units of a power of ten. */
static int common_exponent(double low, double high)
{
    const double largest = fmax(fabs(low), fabs(high));
    if (largest < 1e5 && largest >= 1e-2)
        return 0;
    return 3 * (int)floor(log10(largest) / 3.0 + 1e-9);
}

static void place_linear_ticks(struct draw_axis *axis, int wanted, bool widen)
{
    const double step = step_of(axis->low, axis->high, wanted);
    const double first = widen ? floor(axis->low / step + slack) : ceil(axis->low / step - slack);
    const double last = widen ? ceil(axis->high / step - slack) : floor(axis->high / step + slack);
    if (widen) {
        axis->low = first * step;
        axis->high = last * step;
    }
    axis->exponent = common_exponent(axis->low, axis->high);
    const double unit = pow(10.0, axis->exponent);
    const int digits = (int)fmax(0.0, -floor(log10(step / unit) + slack));
    for (double i = first; i <= last && axis->tick_count < DRAW_AXIS_TICKS; i += 1.0) {
        char label[DRAW_AXIS_LABEL];
        const double value = i * step;
        (void)snprintf(label, sizeof label, "%.*f", digits < 15 ? digits : 15,
                       i == 0.0 ? 0.0 : value / unit);
        add_tick(axis, value, label);
    }
}

static void label_power(char *label, double mantissa, int exponent, bool plain)
{
    if (plain)
        (void)snprintf(label, DRAW_AXIS_LABEL, "%.*f", exponent < 0 ? -exponent : 0,
                       mantissa * pow(10.0, exponent));
    else if (mantissa == 1.0)
        (void)snprintf(label, DRAW_AXIS_LABEL, "10^{%d}", exponent);
    else
        (void)snprintf(label, DRAW_AXIS_LABEL, "%.0fx10^{%d}", mantissa, exponent);
}

/* The ticks of a decade: all with labels, 1, 2 and 5, only 1, or none. */
static void place_decade(struct draw_axis *axis, int exponent, int labels, bool alone, bool plain)
{
    for (int mantissa = 1; mantissa <= (alone ? 1 : 9); ++mantissa) {
        const double value = mantissa * pow(10.0, exponent);
        const bool between = mantissa == 2 || mantissa == 5;
        char label[DRAW_AXIS_LABEL] = "";
        if (labels > 2 || (labels == 2 && between) || (labels > 0 && mantissa == 1))
            label_power(label, mantissa, exponent, plain);
        if (value >= axis->low * (1.0 - slack) && value <= axis->high * (1.0 + slack))
            add_tick(axis, value, label);
    }
}

/* Decades with labels, at least every so many; 2 and 5 have them too where decades are few. */
static void place_decades(struct draw_axis *axis, int wanted)
{
    const int first = (int)floor(log10(axis->low));
    const int last = (int)ceil(log10(axis->high));
    const double decades = log10(axis->high / axis->low);
    const int every = (int)fmax(1.0, ceil(decades / wanted));
    const bool plain = axis->low > 0.9e-3 && axis->high < 1.1e4;
    const int labels = decades <= 0.5 ? 3 : decades <= 2.0 ? 2 : 1;
    for (int exponent = first; exponent <= last; ++exponent)
        place_decade(axis, exponent, exponent % every == 0 ? labels : 0, decades > 5.0, plain);
}

static int label_count(const struct draw_axis *axis)
{
    int count = 0;
    for (int i = 0; i < axis->tick_count; ++i)
        count += axis->labels[i][0] != '\0';
    return count;
}

void draw_axis_open(struct draw_axis *axis, double low, double high, bool logarithmic, int wanted,
                    bool widen)
{
    *axis = (struct draw_axis){.low = low, .high = high, .logarithmic = logarithmic};
    if (logarithmic)
        place_decades(axis, wanted);
    else
        place_linear_ticks(axis, wanted, widen);
    if (logarithmic && label_count(axis) < 2) { /* a part of a decade: as on a linear scale */
        axis->tick_count = 0;
        place_linear_ticks(axis, wanted, false);
    }
}

double draw_axis_part(const struct draw_axis *axis, double value)
{
    if (axis->logarithmic)
        return log(value / axis->low) / log(axis->high / axis->low);
    return (value - axis->low) / (axis->high - axis->low);
}

void draw_axis_spread(double *low, double *high, bool logarithmic)
{
    const double largest = fmax(fabs(*low), fabs(*high));
    if (*high - *low > 1e-9 * largest)
        return;
    const double margin = largest > 0.0 ? 0.1 * largest : 1.0;
    *low = logarithmic ? *low / 2.0 : *low - margin;
    *high = logarithmic ? *high * 2.0 : *high + margin;
}

void draw_axis_title(const struct draw_axis *axis, const char *name, const char *unit, char *title,
                     unsigned long room)
{
    char power[16] = "";
    const bool has_unit = unit != NULL && *unit != '\0';
    if (axis->exponent != 0)
        (void)snprintf(power, sizeof power, "10^{%d}%s", axis->exponent, has_unit ? " " : "");
    if (*name == '\0')
        (void)snprintf(title, room, "%s%s", power, has_unit ? unit : "");
    else if (axis->exponent != 0 || has_unit)
        (void)snprintf(title, room, "%s (%s%s)", name, power, has_unit ? unit : "");
    else
        (void)snprintf(title, room, "%s", name);
}
