/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The animation file: particles at the output times, as a Tecplot table (spec 11). */
#ifndef OUTPUT_ANIMATION_H
#define OUTPUT_ANIMATION_H

#include "deck/scene.h"
#include "output/table.h"

/* Writes title and variable names. */
void animation_header(struct table *table, const struct scene *scene);

/* Writes one zone: the particles for which is_shown[id] is not 0 and that are not closed, in the order of their ids.
 * Returns false, after a message, when the file could not be written. */
bool animation_zone(struct table *table, const struct scene *scene, const struct result_source *source,
                    const unsigned char *is_shown, double time);

#endif
