/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Points of a square or cubic lattice in a disc or ball, or in a box of whole numbers of spacings. No point of a disc or ball is at the
 * centre: they are half a spacing away from it along each axis, so that they lie alike on all sides; those of a box are
 * half a spacing inside of it. */
#ifndef PARTICLES_LATTICE_H
#define PARTICLES_LATTICE_H

#include <stdbool.h>
#include <stddef.h>

struct ball_lattice {
    int dimension; /* 2: a disc in the plane z = 0; 3: a ball */
    double centre[3], radius, spacing;
    long numbers[3]; /* of points along the axes of a box, whose `radius` is half its longest side; 0: a disc or ball */
};

/* The low end along an axis. */
double lattice_low(const struct ball_lattice *lattice, int axis);

/* Area or volume. */
double lattice_volume(const struct ball_lattice *lattice);

/* Number of points, those on the rim included; more than `most` count as most + 1. */
size_t lattice_count(const struct ball_lattice *lattice, size_t most);

/* Puts the points into x[axis], x fastest. */
void lattice_points(const struct ball_lattice *lattice, double *const x[3]);

#endif
