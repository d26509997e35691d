/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The words of additive manufacturing, for the tables of their categories. Each reads what stands
 * behind its word into the scene. */
#ifndef DECK_COMMANDS_PROCESS_H
#define DECK_COMMANDS_PROCESS_H

#include "deck/reader.h"

/* Discrete information. */
void reader_ghosts(struct reader *reader, const struct deck_word *word, const struct value *values);
void reader_opening(struct reader *reader, const struct deck_word *word, const struct value *values);
void reader_build(struct reader *reader, const struct deck_word *word, const struct value *values);
void reader_scan(struct reader *reader, const struct deck_word *word, const struct value *values);

/* Loading. */
void reader_residual(struct reader *reader, const struct deck_word *word, const struct value *values);
void reader_phase(struct reader *reader, const struct deck_word *word, const struct value *values);
void reader_heat(struct reader *reader, const struct deck_word *word, const struct value *values);
extern const struct argument reader_residual_arguments[], reader_phase_arguments[], reader_heat_arguments[];

/* Background grid. */
void reader_hold(struct reader *reader, const struct deck_word *word, const struct value *values);

/* Closed particles that the deck has not, schedules without any. */
void reader_check_ghosts(struct reader *reader);

#endif
