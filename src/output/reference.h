/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A field to compare a run's last state with: the last zone of an animation file (--error). */
#ifndef OUTPUT_REFERENCE_H
#define OUTPUT_REFERENCE_H

#include "base/status.h"
#include "deck/scene.h"
#include "particles/results.h"

#include <stdio.h>

struct reference {
    const char *path; /* borrowed */
    char **names;     /* of the columns */
    size_t n_names, name_room;
    double *values; /* rows of the zone, n_names each */
    size_t n_values, value_room;
    size_t rows, rows_declared; /* declared: I= of the zone, or 0 */
    double time;                /* SOLUTIONTIME of the zone, or NaN */
};

/* Reads the last zone of the animation file at `path` and checks that it can be compared with results of the scene.
 * Returns STATUS_FINISHED; STATUS_FILE when it can't be read or is damaged or cut, STATUS_USAGE when the scene
 * writes no animation, has fewer particles or no variable in common (after a message). Close it in any case. */
enum status reference_open(struct reference *reference, const char *path, const struct scene *scene);

/* Prints, for the coordinates and each result that both have, the root mean square and the largest difference over the
 * particles that the animation file shows (is_shown[id], as for animation_zone), in parts of the variable's range in the
 * reference; where that is 0, as they are. Returns STATUS_USAGE, after a message, when the numbers of rows differ. */
enum status reference_print(const struct reference *reference, const struct scene *scene, const struct result_source *source,
                            const unsigned char *is_shown, double time, FILE *stream);

void reference_close(struct reference *reference);

#endif
