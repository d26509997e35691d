/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "deck/keyword.h"

#include <ctype.h>
#include <string.h>
#include <strings.h>

extern const struct keyword general_keywords[], material_keywords[], grid_keywords[], discrete_keywords[],
    loading_keywords[], solving_keywords[], output_keywords[];

static const struct {
    const struct keyword *table;
    const char *title;
} categories[CATEGORY_COUNT] = {
    [CATEGORY_GENERAL] = {general_keywords, "General information"},
    [CATEGORY_MATERIAL] = {material_keywords, "Material model"},
    [CATEGORY_GRID] = {grid_keywords, "Background grid"},
    [CATEGORY_DISCRETE] = {discrete_keywords, "Discrete information"},
    [CATEGORY_LOADING] = {loading_keywords, "Loading"},
    [CATEGORY_SOLVING] = {solving_keywords, "Solving settings"},
    [CATEGORY_OUTPUT] = {output_keywords, "Post-processing output"},
};

const struct keyword *keyword_table(enum category category)
{
    return categories[category].table;
}

const char *keyword_category_title(enum category category)
{
    return categories[category].title;
}

const struct keyword *keyword_in(const struct keyword *table, const char *word)
{
    for (const struct keyword *row = table; row->name; row++)
        if (strncasecmp(word, row->name, 4) == 0)
            return row;
    return NULL;
}

const struct keyword *keyword_find(const char *word, enum category *category)
{
    for (int c = 0; c < CATEGORY_COUNT; c++) {
        const struct keyword *row = keyword_in(categories[c].table, word);
        if (row && category)
            *category = (enum category)c;
        if (row)
            return row;
    }
    return NULL;
}

/* Edit distance with swaps of neighbours, of at most 15 characters each. */
static int edit_distance(const char *a, const char *b)
{
    enum { LONGEST = 15 };
    int d[LONGEST + 1][LONGEST + 1];
    int n = (int)strlen(a), m = (int)strlen(b);
    if (n > LONGEST || m > LONGEST)
        return LONGEST;
    for (int i = 0; i <= n; i++)
        for (int j = 0; j <= m; j++) {
            if (i == 0 || j == 0) {
                d[i][j] = i + j;
                continue;
            }
            int differs = tolower((unsigned char)a[i - 1]) != tolower((unsigned char)b[j - 1]);
            int best = d[i - 1][j - 1] + differs;
            if (d[i - 1][j] + 1 < best)
                best = d[i - 1][j] + 1;
            if (d[i][j - 1] + 1 < best)
                best = d[i][j - 1] + 1;
            if (i > 1 && j > 1 && tolower((unsigned char)a[i - 1]) == tolower((unsigned char)b[j - 2])
                && tolower((unsigned char)a[i - 2]) == tolower((unsigned char)b[j - 1])
                && d[i - 2][j - 2] + 1 < best)
                best = d[i - 2][j - 2] + 1;
            d[i][j] = best;
        }
    return d[n][m];
}

int keyword_distance(const char *word, const char *name)
{
    int length = (int)strlen(word), difference = length - (int)strlen(name);
    if (difference < -2 || difference > 2)
        return -1;
    int distance = edit_distance(word, name);
    return distance <= 2 && distance * 3 <= length + 1 ? distance : -1;
}

int keyword_row_distance(const struct keyword *row, const char *word)
{
    int by_name = keyword_distance(word, row->name);
    int by_long_name = row->long_name ? keyword_distance(word, row->long_name) : -1;
    return by_name < 0 || (by_long_name >= 0 && by_long_name < by_name) ? by_long_name : by_name;
}

void keyword_nearer(const char *word, const char *name, int *best, const char **found)
{
    int distance = name ? keyword_distance(word, name) : -1;
    if (distance >= 0 && distance < *best) {
        *best = distance;
        *found = name;
    }
}

/* Improves *best and *found by the rows of a table. */
static void nearest(const struct keyword *table, const char *word, int *best, const char **found)
{
    for (const struct keyword *row = table; row->name; row++) {
        keyword_nearer(word, row->name, best, found);
        keyword_nearer(word, row->long_name, best, found);
    }
}

const char *keyword_nearest(const struct keyword *table, const char *word)
{
    int best = KEYWORD_FAR;
    const char *found = NULL;
    nearest(table, word, &best, &found);
    return found;
}

const char *keyword_nearest_top(const char *word)
{
    int best = KEYWORD_FAR;
    const char *found = NULL;
    for (int c = 0; c < CATEGORY_COUNT; c++)
        nearest(categories[c].table, word, &best, &found);
    return found;
}
