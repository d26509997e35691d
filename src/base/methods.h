/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The methods, and masks of them in tables: which methods a word, law or result belongs to. */
#ifndef BASE_METHODS_H
#define BASE_METHODS_H

enum method_name { METHOD_MPM, METHOD_SPH };

/* In a row's column `methods`; 0: all of them. */
enum { METHODS_MPM = 1 << METHOD_MPM, METHODS_SPH = 1 << METHOD_SPH };

/* Whether a row with this mask has a meaning in a scene of the method. */
static inline int methods_include(unsigned methods, enum method_name method)
{
    return methods == 0 || (methods >> method & 1);
}

#endif
