/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The block of reproducing kernel particles, for the table of solving settings. */
#ifndef DECK_COMMANDS_RKPM_H
#define DECK_COMMANDS_RKPM_H

#include "deck/reader.h"

void reader_rkpm(struct reader *reader, const struct deck_word *word, const struct value *values);

/* Reads the nodes of scene->rkpm.file, when box and dimension are known; false after an error at a place. */
bool reader_nodes_file(struct reader *reader, struct deck_place where);

#endif
