/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes a scene as a deck that can be run again. */
#ifndef DECK_ECHO_H
#define DECK_ECHO_H

#include "deck/keyword.h"
#include "deck/scene.h"

#include <stdio.h>

/* Prints the deck as understood: every setting with its value, marked where it is a default.
 * Lists of points, loads and velocities are cut to their first lines, with a comment that says so,
 * unless `whole`. */
void echo_scene(const struct scene *scene, FILE *stream, bool whole);

/* Numbers with a blank before each, and as many digits as it takes to read the same ones again. */
void echo_numbers(FILE *stream, const double *values, int count);

/* The name that a scene has of a choice. */
const char *echo_choice(const struct scene *scene, const struct keyword_choice *choice);

#endif
