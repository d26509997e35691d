/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rkpm/field.h"

#include <math.h>

/* One row a function. */
struct field_row {
    double (*value)(const struct field *field, const double x[3]);
    double (*slope)(const struct field *field, const double x[3], int axis);
    double (*laplacian)(const struct field *field, const double x[3]);
};

/* --- sin x sin y sin z --- */

/* The product of sines; along an axis, if there is one, of the cosine. */
static double sines(const struct field *field, const double x[3], int axis)
{
    double product = 1;
    for (int a = 0; a < field->dimension; a++)
        product *= a == axis ? cos(x[a]) : sin(x[a]);
    return product;
}

static double sine(const struct field *field, const double x[3])
{
    return sines(field, x, -1);
}

static double sine_laplacian(const struct field *field, const double x[3])
{
    return -field->dimension * sines(field, x, -1);
}

/* --- exp(x y z) --- */

/* The product of coordinates, without that along an axis. */
static double others(const struct field *field, const double x[3], int axis)
{
    double product = 1;
    for (int a = 0; a < field->dimension; a++)
        product *= a == axis ? 1 : x[a];
    return product;
}

static double exponential(const struct field *field, const double x[3])
{
    return exp(others(field, x, -1));
}

static double exponential_slope(const struct field *field, const double x[3], int axis)
{
    return others(field, x, axis) * exponential(field, x);
}

static double exponential_laplacian(const struct field *field, const double x[3])
{
    double sum = 0;
    for (int a = 0; a < field->dimension; a++)
        sum += others(field, x, a) * others(field, x, a);
    return sum * exponential(field, x);
}

/* --- sin k(x1 - x)/sin k(x1 - x0) --- */

static double wave(const struct field *field, const double x[3])
{
    const double k = field->wave_number;
    return sin(k * (field->ends[1] - x[0])) / sin(k * (field->ends[1] - field->ends[0]));
}

static double wave_slope(const struct field *field, const double x[3], int axis)
{
    const double k = field->wave_number;
    return axis == 0 ? -k * cos(k * (field->ends[1] - x[0])) / sin(k * (field->ends[1] - field->ends[0])) : 0;
}

static double wave_laplacian(const struct field *field, const double x[3])
{
    return -field->wave_number * field->wave_number * wave(field, x);
}

/* --- 1 + x + 2 y + 3 z --- */

static double linear(const struct field *field, const double x[3])
{
    double sum = 1;
    for (int a = 0; a < field->dimension; a++)
        sum += (a + 1) * x[a];
    return sum;
}

static double linear_slope(const struct field *field, const double x[3], int axis)
{
    (void)field;
    (void)x;
    return axis + 1;
}

static double linear_laplacian(const struct field *field, const double x[3])
{
    (void)field;
    (void)x;
    return 0;
}

static const struct field_row rows[] = {
    [FUNCTION_SINE] = {sine, sines, sine_laplacian},
    [FUNCTION_EXPONENTIAL] = {exponential, exponential_slope, exponential_laplacian},
    [FUNCTION_WAVE] = {wave, wave_slope, wave_laplacian},
    [FUNCTION_LINEAR] = {linear, linear_slope, linear_laplacian},
};

double field_value(const struct field *field, const double x[3])
{
    return rows[field->function].value(field, x);
}

void field_gradient(const struct field *field, const double x[3], double gradient[3])
{
    for (int a = 0; a < 3; a++)
        gradient[a] = a < field->dimension ? rows[field->function].slope(field, x, a) : 0;
}

double field_laplacian(const struct field *field, const double x[3])
{
    return rows[field->function].laplacian(field, x);
}
