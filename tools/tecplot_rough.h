/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tecplot_rough: how far values are from smooth. */
#ifndef TOOLS_TECPLOT_ROUGH_H
#define TOOLS_TECPLOT_ROUGH_H

#include <stddef.h>

/* The root mean square, over all rows, of the value less that of the plane that fits those within `reach` best, itself
 * among them. Coordinates that are the same in all rows do not count; rows with too few neighbours for a plane are left
 * out, NaN when all are. */
double tecplot_roughness(const double *const places[3], const double *values, size_t count, double reach);

#endif
