/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The words of smoothed particles, for the tables of their categories. */
#ifndef DECK_COMMANDS_SPH_H
#define DECK_COMMANDS_SPH_H

#include "deck/reader.h"

/* Material model. */
void reader_property(struct reader *reader, const struct deck_word *word, const struct value *values);
extern const struct argument reader_property_arguments[];

/* Solving settings. */
void reader_sph(struct reader *reader, const struct deck_word *word, const struct value *values);

#endif
