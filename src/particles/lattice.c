/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "particles/lattice.h"

#include <math.h>
#include <stdint.h>

static const double PI = 3.14159265358979323846;
/* Points that are on the rim but for rounding belong to it. */
static const double RIM = 1e-12;

static bool is_box(const struct ball_lattice *lattice)
{
    return lattice->numbers[0] > 0;
}

static double box_points(const struct ball_lattice *lattice)
{
    double count = 1;
    for (int a = 0; a < lattice->dimension; a++)
        count *= (double)lattice->numbers[a];
    return count;
}

double lattice_low(const struct ball_lattice *lattice, int axis)
{
    return lattice->centre[axis] - (is_box(lattice) ? 0.5 * (double)lattice->numbers[axis] * lattice->spacing : lattice->radius);
}

double lattice_volume(const struct ball_lattice *lattice)
{
    const double r = lattice->radius;
    if (is_box(lattice))
        return box_points(lattice) * pow(lattice->spacing, lattice->dimension);
    return lattice->dimension == 2 ? PI * r * r : 4.0 / 3 * PI * r * r * r;
}

/* Half the points of the longest row. */
static long half_row(const struct ball_lattice *lattice)
{
    return (long)fmin(floor(lattice->radius / lattice->spacing + 0.5 + RIM), 1e6);
}

/* Points are at (n + 1/2) spacings from the centre. */
static double offset_of(long n)
{
    return (double)n + 0.5;
}

/* Half the points of the row at given places along the other axes. */
static long half_row_at(const struct ball_lattice *lattice, long j, long k)
{
    const double ratio = lattice->radius / lattice->spacing, y = offset_of(j), z = lattice->dimension == 3 ? offset_of(k) : 0;
    const double rest = ratio * ratio * (1 + RIM) - y * y - z * z;
    return rest < 0.25 ? 0 : (long)floor(sqrt(rest) + 0.5);
}

size_t lattice_count(const struct ball_lattice *lattice, size_t most)
{
    const long half = half_row(lattice);
    size_t count = 0;
    if (is_box(lattice))
        return box_points(lattice) > (double)most ? most + 1 : (size_t)box_points(lattice);
    if ((double)half * (double)half > (double)most) /* their disc alone has more */
        return most + 1;
    for (long k = lattice->dimension == 3 ? -half : 0; k < (lattice->dimension == 3 ? half : 1); k++)
        for (long j = -half; j < half; j++) {
            count += 2 * (size_t)half_row_at(lattice, j, k);
            if (count > most)
                return most + 1;
        }
    return count;
}

static void fill_box(const struct ball_lattice *lattice, double *const x[3])
{
    const size_t count = lattice_count(lattice, SIZE_MAX - 1);
    for (size_t p = 0; p < count; p++) {
        size_t rest = p;
        for (int a = 0; a < lattice->dimension; a++) {
            x[a][p] = lattice_low(lattice, a) + lattice->spacing * offset_of((long)(rest % (size_t)lattice->numbers[a]));
            rest /= (size_t)lattice->numbers[a];
        }
    }
}

void lattice_points(const struct ball_lattice *lattice, double *const x[3])
{
    const long half = half_row(lattice);
    size_t p = 0;
    if (is_box(lattice)) {
        fill_box(lattice, x);
        return;
    }
    for (long k = lattice->dimension == 3 ? -half : 0; k < (lattice->dimension == 3 ? half : 1); k++)
        for (long j = -half; j < half; j++) {
            const long row = half_row_at(lattice, j, k);
            for (long i = -row; i < row; i++, p++) {
                x[0][p] = lattice->centre[0] + lattice->spacing * offset_of(i);
                x[1][p] = lattice->centre[1] + lattice->spacing * offset_of(j);
                x[2][p] = lattice->dimension == 3 ? lattice->centre[2] + lattice->spacing * offset_of(k) : 0;
            }
        }
}
