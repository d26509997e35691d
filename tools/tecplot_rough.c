/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tecplot_rough.h"

#include <math.h>
#include <stdbool.h>

/* Pivots smaller than this part of the sum of squares mean that rows lie on a line, or on a plane. */
static const double LEAST_PIVOT = 1e-9;

/* Rows to go through, with the coordinates that differ. */
struct cloud {
    const double *place[3];
    const double *values;
    size_t count;
    int dimension;
};

static bool differs(const double *numbers, size_t count)
{
    for (size_t i = 1; i < count; ++i)
        if (numbers[i] != numbers[0])
            return true;
    return false;
}

/* Solves the normal equations [m | r] by elimination; false where they are singular. The matrix is symmetric and
 * positive, which needs no search for pivots. */
static bool solve(int n, double equations[4][5])
{
    for (int i = 0; i < n; ++i) {
        if (!(equations[i][i] > LEAST_PIVOT))
            return false;
        for (int row = 0; row < n; ++row) {
            const double factor = row == i ? 0.0 : equations[row][i] / equations[i][i];
            for (int k = 0; k <= n; ++k)
                equations[row][k] -= factor * equations[i][k];
        }
    }
    return true;
}

/* Value of row a less that of the plane about it; false where there is none. Coordinates are seen from row a, in units
 * of the reach, so that the plane's value there is its constant. */
static bool deviation(const struct cloud *cloud, size_t a, double reach, double *result)
{
    const int n = cloud->dimension + 1;
    double equations[4][5] = {{0.0}};
    for (size_t b = 0; b < cloud->count; ++b) {
        double row[5] = {1.0};
        double square = 0.0;
        for (int i = 1; i < n; ++i) {
            row[i] = (cloud->place[i - 1][b] - cloud->place[i - 1][a]) / reach;
            square += row[i] * row[i];
        }
        if (!(square <= 1.0))
            continue;
        row[n] = cloud->values[b] - cloud->values[a];
        for (int i = 0; i < n; ++i)
            for (int k = 0; k <= n; ++k)
                equations[i][k] += row[i] * row[k];
    }
    const bool has_plane = equations[0][0] > n && solve(n, equations);
    if (has_plane)
        *result = -equations[0][n] / equations[0][0];
    return has_plane;
}

double tecplot_roughness(const double *const places[3], const double *values, size_t count, double reach)
{
    struct cloud cloud = {.values = values, .count = count};
    long double sum = 0.0L;
    size_t found = 0;
    for (int i = 0; i < 3; ++i)
        if (differs(places[i], count))
            cloud.place[cloud.dimension++] = places[i];
    for (size_t a = 0; a < count; ++a) {
        double off = 0.0;
        if (!deviation(&cloud, a, reach, &off))
            continue;
        sum += (long double)off * off;
        ++found;
    }
    return found > 0 ? (double)sqrtl(sum / (long double)found) : (double)NAN;
}
