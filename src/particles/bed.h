/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Beds of powder: grains that lie on a floor and touch, one behind the other along x; in space in rows side by side along y,
 * as wide as the largest grain may be. Radii are drawn evenly between two. */
#ifndef PARTICLES_BED_H
#define PARTICLES_BED_H

#include <stdbool.h>
#include <stdint.h>

struct bed {
    double x[2], y[2];    /* between which grains lie wholly; in a plane y is not used */
    double floor;         /* on which they lie: a y in a plane, a z in space */
    double least, most;   /* radii */
    uint64_t seed;
    long pick, among;     /* only grain `pick` of every `among`, from 1; 1, 1 is all */
    bool is_flat;
    long row, number;     /* of the grain that comes next; the rest is found by bed_next */
    double last_x, last_radius;
};

struct grain {
    double centre[3], radius;
};

/* The next grain that is picked; false behind the last one. Start with row, number and last_radius 0. */
bool bed_next(struct bed *bed, struct grain *grain);

#endif
