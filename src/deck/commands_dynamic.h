/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Words of the block rkpm that go with `prob dynamic`, for its table. */
#ifndef DECK_COMMANDS_DYNAMIC_H
#define DECK_COMMANDS_DYNAMIC_H

#include "deck/reader.h"

extern const char *const reader_kernel_modes[]; /* by enum kernel_mode, ended by NULL */

/* The numbers of `node disc` or `node sphere`, which comes before `dime` or behind it. */
void reader_lattice(struct reader *reader, int dimension, struct deck_place place);

/* Force per volume of `prob creep`. */
void reader_rkpm_weight(struct reader *reader, const struct deck_word *word, const struct value *values);

/* node brick: extents of two or three axes, then the spacing. */
void reader_brick(struct reader *reader, struct deck_place place);
void reader_start_velocity(struct reader *reader, const struct deck_word *word, const struct value *values);
void reader_rkpm_gravity(struct reader *reader, const struct deck_word *word, const struct value *values);
void reader_rkpm_wall(struct reader *reader, const struct deck_word *word, const struct value *values);

/* Whether doubles can tell nodes apart, of which one is `farthest` from the origin; else an error at the place (check_rkpm). */
bool reader_check_spacing(struct reader *reader, struct deck_place place, double farthest, double spacing);

/* What only the whole block shows; words of problems in it are reported before. */
void reader_finish_dynamic(struct reader *reader);

#endif
