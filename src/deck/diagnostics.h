/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mistakes found in a deck: collected while reading, printed in one go, in the order of the
 * text, each as file:line:column with the line, a caret and what was expected. */
#ifndef DECK_DIAGNOSTICS_H
#define DECK_DIAGNOSTICS_H

#include "deck/text.h"

#include <stdio.h>

struct diagnostics *diagnostics_open(void);
void diagnostics_close(struct diagnostics *diagnostics);

/* Notes a mistake at a place of the deck. Two mistakes at one place are noted once. */
void diagnostics_error(struct diagnostics *diagnostics, struct deck_place place, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Notes something that the whole deck lacks; unlike mistakes, several may share a place. */
void diagnostics_lack(struct diagnostics *diagnostics, struct deck_place place, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Notes something that is accepted but deserves a look. */
void diagnostics_warning(struct diagnostics *diagnostics, struct deck_place place, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

int diagnostics_errors(const struct diagnostics *diagnostics);

/* Whether there are so many mistakes that no more are shown. */
bool diagnostics_is_full(const struct diagnostics *diagnostics);

/* Prints everything noted since the last call, sorted by place, in colour where asked. */
void diagnostics_print(struct diagnostics *diagnostics, const struct deck_text *text, FILE *stream, bool colour);

#endif
