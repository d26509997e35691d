/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes a scene as a deck that can be run again. */
#ifndef DECK_ECHO_H
#define DECK_ECHO_H

#include "deck/scene.h"

#include <stdio.h>

/* Prints the deck as understood: every setting with its value, marked where it is a default.
 * Lists of points, loads and velocities are cut to their first lines, with a comment that says so,
 * unless `whole`. */
void echo_scene(const struct scene *scene, FILE *stream, bool whole);

#endif
