/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tecplot_find: see tecplot_find.h. */
#define _POSIX_C_SOURCE 200809L

#include "tecplot_find.h"
#include "words.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/* The variable whose name is nearest, or NULL when none is near. */
static const char *nearest_name(const struct tecplot_file *file, const char *name)
{
    const char *nearest = NULL;
    size_t best = strlen(name) / 2 + 1;
    for (size_t i = 0; i < file->variable_count; ++i) {
        const size_t distance = words_distance(name, file->variable_names[i]);
        if (distance < best) {
            best = distance;
            nearest = file->variable_names[i];
        }
    }
    return nearest;
}

static void complain_variable(const char *tool, const struct tecplot_file *file, const char *name)
{
    const char *nearest = nearest_name(file, name);
    fprintf(stderr, "%s: error: no variable '%s'; the file has:", tool, name);
    for (size_t i = 0; i < file->variable_count; ++i) {
        const char *quote = strchr(file->variable_names[i], ' ') != NULL ? "'" : "";
        fprintf(stderr, " %s%s%s", quote, file->variable_names[i], quote);
    }
    if (nearest != NULL)
        fprintf(stderr, " (nearest: '%s')", nearest);
    fputc('\n', stderr);
}

bool tecplot_find_column(const char *tool, const struct tecplot_file *file, const char *name,
                         size_t *column)
{
    size_t exact = 0;
    size_t similar = 0;
    for (size_t i = 0; i < file->variable_count; ++i) {
        const char *candidate = file->variable_names[i];
        const bool same = strcmp(candidate, name) == 0;
        if (same || (exact == 0 && strcasecmp(candidate, name) == 0))
            *column = i;
        exact += same;
        similar += strcasecmp(candidate, name) == 0;
    }
    if (similar == 0)
        complain_variable(tool, file, name);
    else if (exact > 1 || (exact == 0 && similar > 1))
        fprintf(stderr, "%s: error: more than one variable is called '%s'\n", tool, name);
    return exact == 1 || (exact == 0 && similar == 1);
}

bool tecplot_find_ordinal(const char *text, size_t *ordinal)
{
    double number;
    const char *problem = tecplot_number(text, strlen(text), &number);
    if (problem != NULL || !(number >= 1.0 && number <= 1e15 && floor(number) == number) ||
        number >= (double)SIZE_MAX)
        return false;
    *ordinal = (size_t)number;
    return true;
}

bool tecplot_find_zone(const char *tool, const struct tecplot_file *file, const char *word,
                       const struct tecplot_zone **zone)
{
    size_t number = file->zone_count;
    if (strcmp(word, "first") == 0)
        number = 1;
    else if (strcmp(word, "last") != 0 && !tecplot_find_ordinal(word, &number)) {
        fprintf(stderr, "%s: error: --zone must be last, first or a number from 1, not '%s'\n",
                tool, word);
        return false;
    }
    if (number > file->zone_count) {
        fprintf(stderr, "%s: error: no zone %zu, the file has %zu\n", tool, number,
                file->zone_count);
        return false;
    }
    *zone = &file->zones[number - 1];
    return true;
}
