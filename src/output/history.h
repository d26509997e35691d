/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables with one line a step: curves, energy, momentum (spec 11). */
#ifndef OUTPUT_HISTORY_H
#define OUTPUT_HISTORY_H

#include "deck/scene.h"
#include "output/table.h"

/* Totals that a step's lines need. */
struct history_totals {
    double time, contact[3];
    double value[TOTAL_COUNT]; /* by enum total; what a method does not have stays 0 */
};

struct history {
    struct table curves, energy, momentum, contact;
};

/* Opens the files of the scene in `folder`; writes the headers of new ones. */
bool history_open(struct history *history, const struct scene *scene, const char *folder, enum table_mode mode);

/* Writes one line to each. */
void history_step(struct history *history, const struct scene *scene, const struct result_source *source,
                  const struct history_totals *totals);

/* Writes what is buffered; false, after a message, on failure. */
bool history_flush(struct history *history);
bool history_close(struct history *history);

#endif
