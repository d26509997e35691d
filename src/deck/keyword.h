/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The words of a deck: one const row each, in one table per place where a word may stand. The
 * reader, --help, the manual and the error messages use the same rows. */
#ifndef DECK_KEYWORD_H
#define DECK_KEYWORD_H

#include "base/argument.h"
#include "base/methods.h"
#include "deck/text.h"

struct reader;

/* The thesis's seven categories. */
enum category {
    CATEGORY_GENERAL,
    CATEGORY_MATERIAL,
    CATEGORY_GRID,
    CATEGORY_DISCRETE,
    CATEGORY_LOADING,
    CATEGORY_SOLVING,
    CATEGORY_OUTPUT,
    CATEGORY_COUNT
};

/* An argument as read. */
struct value {
    double real;
    long integer;
    struct deck_word word;
};

enum { KEYWORD_NO_FIELD = 0, KEYWORD_ARGUMENTS = 16 };

/* What a word with one argument may have as it, and where in struct scene the place of it among the names goes: an enum,
 * or, for off and on, a bool. */
struct keyword_choice {
    const char *const *names; /* ended by NULL; four characters count */
    size_t field;
    bool is_flag;
};

struct keyword {
    const char *name;      /* four characters count; shorter names must be written exactly */
    const char *long_name; /* the usual longer spelling; NULL: the name */
    const struct argument *arguments;
    /* Offset in struct scene of the first of as many consecutive doubles (or longs, for integers)
     * as there are arguments, to store them; KEYWORD_NO_FIELD: only `apply` is called. */
    size_t field;
    const struct keyword_choice *choice; /* or NULL */
    unsigned methods; /* METHODS_... in which it has a meaning; 0: all */
    /* Called after the arguments are read and stored; may be NULL. */
    void (*apply)(struct reader *reader, const struct deck_word *word, const struct value *values);
    /* Called instead of `apply` after wrong arguments, which are reported; may be NULL. */
    void (*fail)(struct reader *reader, const struct deck_word *word);
    const char *doc;
    const char *details; /* sub-block syntax and order rules for --help, or NULL */
    const char *later;   /* not NULL: known word without its feature; says what is missing */
    bool once;           /* may stand in a deck only once */
};

/* The table of a category, ended by a row without name. */
const struct keyword *keyword_table(enum category category);
const char *keyword_category_title(enum category category);

/* Tables of the sub-blocks of load, velo and Ghost, ended by a row without name. */
extern const struct keyword load_keywords[], velocity_keywords[], ghost_keywords[];

/* The steps of part solid, and the words that may follow a shape from a file. */
extern const struct keyword solid_keywords[], surface_keywords[];

/* The block of sph, and what prop may say of a material beside tables. */
extern const struct keyword sph_keywords[], property_keywords[];

/* The block of rkpm. */
extern const struct keyword rkpm_keywords[];

/* The row in `table` whose first four characters agree with a NUL-ended word, or NULL. */
const struct keyword *keyword_in(const struct keyword *table, const char *word);

/* The row of any top-level word, or NULL; its category goes to *category where not NULL. */
const struct keyword *keyword_find(const char *word, enum category *category);

/* Name of the keyword nearest to a misspelt word, or NULL when none is near. */
const char *keyword_nearest(const struct keyword *table, const char *word);
const char *keyword_nearest_top(const char *word);

/* Distance of a word from the nearer spelling of a row, -1 if far. */
int keyword_row_distance(const struct keyword *row, const char *word);

/* Whether two spellings are near enough for a suggestion; smaller is nearer, -1 is far. */
int keyword_distance(const char *word, const char *name);

/* Keeps `name` (may be NULL) in *found when it is nearer to the word than *best, and its distance in
 * *best. Start with KEYWORD_FAR. */
enum { KEYWORD_FAR = 99 };
void keyword_nearer(const char *word, const char *name, int *best, const char **found);

#endif
