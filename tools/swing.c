/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "swing.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

/* Frequencies, in swings in the time of the curve: the range searched, and its first steps. */
static const double FEWEST = 2, MOST = 200, STEP = 0.25;
/* Parts of an interval that golden section leaves, and how often. */
static const double GOLDEN = 0.61803398874989485;
enum { SECTIONS = 60 };

struct curve {
    const double *values, *times;
    size_t count;
};

bool swing_has_time(const double *times, size_t count)
{
    for (size_t i = 1; i < count; ++i)
        if (!(times[i] > times[i - 1]))
            return false;
    return count >= SWING_LEAST_ROWS;
}

static double span(const struct curve *curve)
{
    return curve->times[curve->count - 1] - curve->times[0];
}

/* The window at a row times the time that the row stands for. */
static double weight(const struct curve *curve, size_t i)
{
    const double *t = curve->times;
    const double before = i > 0 ? t[i - 1] : t[i];
    const double after = i + 1 < curve->count ? t[i + 1] : t[i];
    return 0.25 * (after - before) * (1 - cos(2 * PI * (t[i] - t[0]) / span(curve)));
}

static double weighted_mean(const struct curve *curve)
{
    double sum = 0;
    double weights = 0;
    for (size_t i = 0; i < curve->count; ++i) {
        sum += weight(curve, i) * curve->values[i];
        weights += weight(curve, i);
    }
    return sum / weights;
}

/* Size of the Fourier component of an angular frequency. */
static double component(const struct curve *curve, double mean, double frequency)
{
    double real = 0;
    double imaginary = 0;
    for (size_t i = 0; i < curve->count; ++i) {
        const double value = weight(curve, i) * (curve->values[i] - mean);
        const double phase = frequency * (curve->times[i] - curve->times[0]);
        real += value * cos(phase);
        imaginary += value * sin(phase);
    }
    return hypot(real, imaginary);
}

/* The largest component between two frequencies, where there is one maximum. */
static double refined(const struct curve *curve, double mean, double low, double high)
{
    double inner_low = high - GOLDEN * (high - low);
    double inner_high = low + GOLDEN * (high - low);
    double at_low = component(curve, mean, inner_low);
    double at_high = component(curve, mean, inner_high);
    for (int i = 0; i < SECTIONS; ++i) {
        if (at_low > at_high) {
            high = inner_high;
            inner_high = inner_low;
            at_high = at_low;
            inner_low = high - GOLDEN * (high - low);
            at_low = component(curve, mean, inner_low);
        } else {
            low = inner_low;
            inner_low = inner_high;
            at_low = at_high;
            inner_high = low + GOLDEN * (high - low);
            at_high = component(curve, mean, inner_high);
        }
    }
    return 0.5 * (low + high);
}

static double strongest_frequency(const struct curve *curve)
{
    const double unit = 2 * PI / span(curve);
    const double mean = weighted_mean(curve);
    /* no more than one swing in two rows can be seen */
    const double most = fmin(MOST, 0.5 * (double)(curve->count - 1));
    const size_t steps = most > FEWEST ? (size_t)((most - FEWEST) / STEP) : 0;
    double best = FEWEST;
    double largest = -1;
    for (size_t i = 0; i <= steps; ++i) {
        const double frequency = FEWEST + (double)i * STEP;
        const double size = component(curve, mean, frequency * unit);
        if (size > largest) {
            largest = size;
            best = frequency;
        }
    }
    return refined(curve, mean, (best - STEP) * unit, (best + STEP) * unit);
}

static double centre(const struct curve *curve)
{
    return 0.5 * (curve->times[0] + curve->times[curve->count - 1]);
}

/* Size of the swing, up to a factor. */
static double size_of(const struct curve *curve, double frequency)
{
    return component(curve, weighted_mean(curve), frequency) / span(curve);
}

double swing_period(const double *values, const double *times, size_t count)
{
    const struct curve curve = {values, times, count};
    return 2 * PI / strongest_frequency(&curve);
}

double swing_decay(const double *values, const double *times, size_t count)
{
    const struct curve curve = {values, times, count};
    const double frequency = strongest_frequency(&curve);
    const double middle = times[0] + 0.5 * span(&curve);
    size_t before = 0;
    while (before < count && times[before] < middle)
        ++before;
    const struct curve first = {values, times, before};
    const struct curve second = {values + before, times + before, count - before};
    return log(size_of(&first, frequency) / size_of(&second, frequency)) /
           (centre(&second) - centre(&first));
}
