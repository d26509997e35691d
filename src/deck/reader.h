/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads a deck into a scene: the loop over words, and what all readers share. */
#ifndef DECK_READER_H
#define DECK_READER_H

#include "deck/diagnostics.h"
#include "deck/keyword.h"
#include "deck/scene.h"

#include <stdint.h>

enum { READER_DEPTH = 4 }; /* of blocks in blocks, which only wrong decks have */

struct solid;

enum { READER_WORDS = 64 }; /* of the blocks sph and rkpm, at most */

/* A word or result that not all methods have, where it first stands. */
struct reader_use {
    const char *kind, *name;
    unsigned methods;
    struct deck_place place;
};

/* The block of part solid that is being read. */
struct reader_solid {
    bool is_open;
    struct solid *solid; /* NULL where its lattice is wrong: the steps are checked as far as can be */
    long steps;          /* read so far, wrong ones too */
};

struct reader {
    struct deck_text *text;
    struct diagnostics *diagnostics;
    struct scene *scene;
    const char *command;           /* the last command of the deck itself */
    struct deck_word last;         /* last word taken, to report what is missing behind it */
    int depth;                     /* of blocks inside blocks */
    bool ended;                    /* endi was read */
    bool is_cut;                   /* the deck ended inside a command: what else is missing is no news */
    bool is_partial;               /* a line or file was not understood: what seems missing may be there */
    bool in_materials;             /* a number before the name of a law is the next material's id */
    bool has_bad_material, has_bad_part, has_bad_sph, has_bad_rkpm;
    bool has_scheme;               /* some scheme was switched on at some place */
    bool scheme_is_on[3];          /* by enum scheme */
    bool has_output_interval;
    struct reader_solid block;
    bool has_plot_box;             /* pt2d was read: it holds for bodies that follow */
    double plot_box[6];
    struct reader_use *uses;
    size_t n_uses, uses_capacity;
    struct deck_place method_place, sph_places[READER_WORDS], rkpm_places[READER_WORDS]; /* by row of sph_keywords and rkpm_keywords; line 0: not given */
    uint64_t missing[CATEGORY_COUNT]; /* words reported as missing, like scene.given */
    struct deck_place output_interval_place, bodies_place, particles_place, materials_place;
    struct deck_place cell_place, contact_place, interpolation_place, total_place, transfer_place, averaging_place, equilibrium_place, small_place, span_place[3];
    struct deck_place mass_scale_place, fixed_step_place, light_mass_place, last_usl_place;
};

/* Reads the deck from `text` into a new scene. Mistakes go to `diagnostics`; when there are any
 * the scene is incomplete and only good for closing. */
struct scene *reader_read(struct deck_text *text, struct diagnostics *diagnostics);

/* Takes the next word; false (and an error that names `what`) at the end of the deck. */
bool reader_word(struct reader *reader, struct deck_word *word, const char *what);

/* Reads the arguments of a word, checking kind and limit of each. On a mistake: reports it, skips
 * the rest of the line up to the next keyword and returns false. `owner` names the word in
 * messages. */
bool reader_values(struct reader *reader, const struct argument *arguments, const char *owner, struct value *values);

/* Notes that a word of a kind ("" for keywords) was used that only some methods have. */
void reader_use(struct reader *reader, const char *kind, const char *name, unsigned methods, struct deck_place place);

/* Reports such words that the deck's method does not have, where they stand: nothing is left out silently. False where the
 * deck has no `meth` and should: what else is wrong follows from that. */
bool reader_check_methods(struct reader *reader);

/* Takes words up to, not including, the next one that begins a line. */
void reader_skip_line(struct reader *reader);

/* Takes the rest of the line and all lines below it that begin with a number. */
void reader_skip_numbers(struct reader *reader);

/* Whether the next word begins a line, or there is none. */
bool reader_at_line_end(struct reader *reader);

/* Whether a word stands behind the last one on its line that begins no command: a further argument. */
bool reader_has_more(struct reader *reader);

/* Whether the deck has used this command before, as far as can be said. */
bool reader_was_given(const struct reader *reader, const char *name);

/* Whether command `name` was given; reports once in a deck that `word` needs it before. */
bool reader_needs(struct reader *reader, const struct deck_word *word, const char *name);

/* Whether `name` was reported as missing; then coming too late is no second mistake. */
bool reader_is_missing(const struct reader *reader, const char *name);

/* Whether a word is a command of the deck, or a word of its load and velo blocks. */
bool reader_is_keyword(const struct deck_word *word);

/* Runs a command of the deck whose word was taken. */
void reader_command(struct reader *reader, const struct keyword *row, const struct deck_word *word);

/* Reports an id that is not in 1 ... count; returns whether it is in the range. When there is
 * nothing to count the reason was reported before. */
bool reader_check_id(struct reader *reader, const struct value *value, long count, const char *what);

/* Reports the unknown word with the nearest name, or with the `topic` of --help that tells. */
void reader_unknown(struct reader *reader, const struct deck_word *word, const char *kind, const char *nearest,
                    const char *topic);

/* Reads the commands of a sub-block until the word `end`; where each of the table's rows stands goes into places, if not
 * NULL. Returns whether no error was reported. */
bool reader_block(struct reader *reader, const struct keyword *table, const char *end, const char *owner, struct deck_place *places);

/* on or off; -1 and an error otherwise. */
int reader_switch(struct reader *reader, const struct value *value, const char *owner);

/* Takes an optional word of the same line if it is one of `names` (ended by NULL); returns its
 * index or -1. */
int reader_optional(struct reader *reader, const char *const *names);

/* Says what has to stand behind the last word of a command, and what stands there instead. Takes the rest of the line. */
void reader_expect(struct reader *reader, const char *owner, const char *expected);

/* An axis as x, y, z or 1, 2, 3: 0, 1, 2; -1 and an error otherwise. */
int reader_axis(struct reader *reader, const struct value *value);

/* Reads the steps of part solid up to endp and joins them to `solid`; where it is NULL they are only
 * checked. Returns whether all is right. */
bool reader_solid_block(struct reader *reader, struct solid *solid);

/* Takes the steps of a solid that was not recognised as one, where some follow. */
void reader_skip_solid(struct reader *reader);

/* Checks that need the whole deck (categories' own files). */
void reader_finish_sph(struct reader *reader);
void reader_finish_rkpm(struct reader *reader);
void reader_finish_general(struct reader *reader, struct deck_place end);
void reader_finish_grid(struct reader *reader, struct deck_place end);
void reader_finish_materials(struct reader *reader);
void reader_finish_targets(struct reader *reader);
void reader_finish_solving(struct reader *reader);
void reader_finish_process(struct reader *reader);

#endif
