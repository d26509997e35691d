/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tecplot_find: variables and zones by what the user calls them. What is not there is said on
 * standard error, after the name of the tool. */
#ifndef TOOLS_TECPLOT_FIND_H
#define TOOLS_TECPLOT_FIND_H

#include "tecplot_read.h"

/* The column of that name: spelt exactly so, else the only one that differs in case alone. */
bool tecplot_find_column(const char *tool, const struct tecplot_file *file, const char *name,
                         size_t *column);

/* The zone called "last", "first" or a number from 1. */
bool tecplot_find_zone(const char *tool, const struct tecplot_file *file, const char *word,
                       const struct tecplot_zone **zone);

/* A whole number from 1, as in --zone 2. */
bool tecplot_find_ordinal(const char *text, size_t *ordinal);

#endif
