/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "particles/bed.h"
#include "base/scatter.h"

#include <math.h>

/* Ends that only round-off takes beyond those of the bed. */
static const double ROUND_OFF = 1e-9;

/* The next grain of the row, picked or not; false where it would reach beyond the end. */
static bool lay_grain(struct bed *bed, struct grain *grain)
{
    const double radius = bed->least + (bed->most - bed->least) * (0.5 + scatter(bed->seed, (uint64_t)bed->number, 0));
    /* grains on one floor touch at this distance along it */
    const double x = bed->last_radius > 0 ? bed->last_x + 2 * sqrt(bed->last_radius * radius) : bed->x[0] + radius;
    if (!(x + radius <= bed->x[1] + ROUND_OFF * (bed->x[1] - bed->x[0])))
        return false;
    const double aside = bed->is_flat ? 0 : bed->y[0] + (double)(2 * bed->row + 1) * bed->most, height = bed->floor + radius;
    *grain = (struct grain){{x, bed->is_flat ? height : aside, bed->is_flat ? 0 : height}, radius};
    bed->last_x = x;
    bed->last_radius = radius;
    bed->number++;
    return true;
}

static bool has_row(const struct bed *bed)
{
    if (bed->is_flat)
        return bed->row == 0;
    return bed->y[0] + (double)(2 * bed->row + 2) * bed->most <= bed->y[1] + ROUND_OFF * (bed->y[1] - bed->y[0]);
}

bool bed_next(struct bed *bed, struct grain *grain)
{
    while (has_row(bed)) {
        if (!lay_grain(bed, grain)) {
            bed->row++;
            bed->last_radius = 0;
        } else if ((bed->number - 1) % bed->among == bed->pick - 1)
            return true;
    }
    return false;
}
