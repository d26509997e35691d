/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Help on the words of a deck, from the tables. */
#ifndef DECK_HELP_H
#define DECK_HELP_H

#include <stdbool.h>
#include <stdio.h>

/* All words by category, a line each. */
void help_words(FILE *stream);

/* One word with its arguments, units and limits; also laws, generators and results. Returns false
 * when the word is unknown, after naming the nearest one. */
bool help_word(const char *word, FILE *stream);

/* The manual: all words with their arguments, laws, equations of state, generators, loads,
 * velocities and results, as Markdown. */
void help_manual(FILE *stream);

#endif
