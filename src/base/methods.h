/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The methods, and masks of them in tables: which methods a word, law or result belongs to. */
#ifndef BASE_METHODS_H
#define BASE_METHODS_H

#include <stddef.h>

/* Reproducing kernel particles have two: problems that are solved once, and motion in time. */
enum method_name { METHOD_MPM, METHOD_SPH, METHOD_RKPM, METHOD_DYNAMIC, METHOD_COUNT };

/* In a row's column `methods`; 0: all of them. */
enum {
    METHODS_MPM = 1 << METHOD_MPM,
    METHODS_SPH = 1 << METHOD_SPH,
    METHODS_PROBLEM = 1 << METHOD_RKPM,
    METHODS_DYNAMIC = 1 << METHOD_DYNAMIC,
    METHODS_RKPM = METHODS_PROBLEM | METHODS_DYNAMIC, /* both, which decks tell apart by `prob` */
    METHODS_PARTICLES = METHODS_MPM | METHODS_SPH,    /* those that move bodies of particles in time */
    METHODS_TIMED = METHODS_PARTICLES | METHODS_DYNAMIC /* all that go on in time */
};

/* Whether a row with this mask has a meaning in a scene of the method. */
static inline int methods_include(unsigned methods, enum method_name method)
{
    return methods == 0 || (methods >> method & 1);
}

/* Puts the names of the methods of a mask into a text, with `before` and `after` each and `between` them. */
void methods_text(unsigned methods, const char *before, const char *after, const char *between, char *text, size_t size);

/* The name of a method in decks. */
const char *methods_name(enum method_name method);

#endif
