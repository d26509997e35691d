/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The hat function of a node averaged over a window: the wide shape functions along an axis. */
#ifndef MPM_HAT_H
#define MPM_HAT_H

#include "base/threads.h"

#include <math.h>
#include <stdbool.h>

/* Half width of the reference's gimp particles, in cells, whatever their spacing (spec 7.2). */
static const double HAT_FIXED_HALF_WIDTH = 0.25;

/* The hat function averaged over a particle of half width l (above 0, at most 1/2), and its slope, at
 * distance r from the node, all in cells (Bardenhagen and Kober, CMES 5, 2004). With l = 1/2 it is the
 * quadratic B-spline. */
THREADS_INLINE void hat_averaged(double r, double l, double *weight, double *slope)
{
    double distance = fabs(r);
    double rest = 1 + l - distance, tail = rest > 0 ? rest : 0;
    bool is_top = distance < l, is_side = distance <= 1 - l;
    *weight = is_top ? 1 - (r * r + l * l) / (2 * l) : is_side ? 1 - distance : tail * tail / (4 * l);
    *slope = -copysign(is_top ? distance / l : is_side ? 1 : tail / (2 * l), r);
}

#endif
