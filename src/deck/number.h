/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers as decks spell them: with a sign, a point, an exponent behind e, d or its bare sign. */
#ifndef DECK_NUMBER_H
#define DECK_NUMBER_H

#include "deck/text.h"

#include <stdbool.h>

/* Whether a word reads as a number (spec 1.4: also with d, or without exponent letter); its value, and whether it is spelt as a
 * whole one. */
bool number_read(const struct deck_word *word, double *real, bool *is_integer);

/* Whether a word reads as a whole number; its value goes to *integer. */
bool number_is_integer(const struct deck_word *word, long *integer);

/* Whether a word reads as a number. */
bool number_is_real(const struct deck_word *word, double *real);

#endif
