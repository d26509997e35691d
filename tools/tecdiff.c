/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * tecdiff: compares two Tecplot files or tables of numbers, silently when they agree.
 *
 * Structure (variables, zones, rows, solution times) is compared first, then every number that both
 * files have. See the text of usage() for the meaning of the tolerances and of the exit status.
 */
#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tecplot_read.h"

enum exit_status { AGREE = 0, DIFFER = 1, TROUBLE = 2 };

struct options {
    double absolute;
    double relative;
    size_t entries; /* differing entries to print */
    bool column_scale;
    bool ignore_names;
    bool quiet;
    bool help;
    const char *paths[2];
};

struct place {
    size_t zone; /* counted from 0 */
    size_t row;
};

/* What was found for one variable. */
struct finding {
    bool compared;
    size_t entry_count; /* entries that differ */
    double largest_absolute;
    double largest_relative;
    struct place absolute_place;
    struct place relative_place;
};

struct comparison {
    const struct options *options;
    struct tecplot_file files[2];
    size_t variable_count;    /* that both files have */
    size_t zone_count;        /* that both files have */
    struct finding *findings; /* one for each of these variables */
    double *scales;           /* likewise, of the zone being compared */
    size_t entry_count;       /* entries that differ, all variables */
    size_t entries_printed;
    size_t structure_count; /* differences of structure */
};

static void usage(FILE *stream)
{
    fputs("usage: tecdiff [-a ABS] [-r REL] [-n COUNT] [--scale] [--ignore-names] [-q] A B\n"
          "\n"
          "Compares two Tecplot files or tables of numbers, variable by variable (matched by\n"
          "position) and zone by zone. Prints nothing when they agree.\n"
          "\n"
          "  -a ABS          absolute tolerance (0)\n"
          "  -r REL          relative tolerance (0)\n"
          "  -n COUNT        differing entries to print (10)\n"
          "  --scale         REL is relative to the largest finite |value| of the variable in\n"
          "                  that zone of A, not to the larger of the two numbers\n"
          "  --ignore-names  variables may have different names\n"
          "  -q              print nothing, only give the exit status\n"
          "\n"
          "Numbers differ when |a-b| > ABS + REL*scale. NaN equals only NaN, an infinity only\n"
          "the same infinity, and -0 equals 0. Solution times are compared like numbers when both\n"
          "files state them in the same way; titles and comments are not compared.\n"
          "A file \"-\" is standard input.\n"
          "\n"
          "exit status: 0 the files agree, 1 they differ, 2 wrong usage or a file that is\n"
          "unreadable, damaged or cut\n"
          "\n"
          "example: tecdiff -r 1e-6 --scale run1/bar_anim.dat run2/bar_anim.dat\n",
          stream);
}

/* ---- command line ---- */

static bool complain(const char *what, const char *text)
{
    fprintf(stderr, "tecdiff: error: %s '%s'; see tecdiff --help\n", what, text);
    return false;
}

static bool read_tolerance(const char *text, double *tolerance)
{
    const char *problem = tecplot_number(text, strlen(text), tolerance);
    if (problem == NULL && isfinite(*tolerance) && *tolerance >= 0.0)
        return true;
    return complain("a tolerance must be a number >= 0, not", text);
}

static bool read_count(const char *text, size_t *count)
{
    double number;
    const char *problem = tecplot_number(text, strlen(text), &number);
    if (problem != NULL || !(number >= 0.0 && number <= 1e15 && floor(number) == number))
        return complain("-n must be a whole number >= 0, not", text);
    *count = number < (double)SIZE_MAX ? (size_t)number : SIZE_MAX;
    return true;
}

/* -a, -r and -n with the argument that follows; NULL when it is missing. */
static bool read_valued_option(const char *option, const char *value, struct options *options)
{
    if (value == NULL)
        return complain("a number is missing after", option);
    if (strcmp(option, "-a") == 0)
        return read_tolerance(value, &options->absolute);
    if (strcmp(option, "-r") == 0)
        return read_tolerance(value, &options->relative);
    return read_count(value, &options->entries);
}

/* The switch of that name, or NULL. */
static bool *find_switch(const char *name, struct options *options)
{
    const struct {
        const char *name;
        bool *on;
    } switches[] = {
        {"--scale", &options->column_scale},
        {"--ignore-names", &options->ignore_names},
        {"-q", &options->quiet},
        {"--quiet", &options->quiet},
        {"--help", &options->help},
        {"-h", &options->help},
    };
    for (size_t i = 0; i < sizeof switches / sizeof *switches; ++i)
        if (strcmp(name, switches[i].name) == 0)
            return switches[i].on;
    return NULL;
}

static bool is_valued_option(const char *argument)
{
    return argument[0] == '-' && argument[1] != '\0' && strchr("arn", argument[1]) != NULL &&
           argument[2] == '\0';
}

static bool read_command_line(int argument_count, char **arguments, struct options *options)
{
    size_t path_count = 0;
    bool options_ended = false;
    for (int i = 1; i < argument_count; ++i) {
        const char *argument = arguments[i];
        if (options_ended || argument[0] != '-' || argument[1] == '\0') {
            if (path_count == 2)
                return complain("two files are compared; what is", argument);
            options->paths[path_count++] = argument;
        } else if (strcmp(argument, "--") == 0) {
            options_ended = true;
        } else if (is_valued_option(argument)) {
            ++i;
            if (!read_valued_option(argument, i < argument_count ? arguments[i] : NULL, options))
                return false;
        } else {
            bool *on = find_switch(argument, options);
            if (on == NULL)
                return complain("unknown option", argument);
            *on = true;
        }
    }
    if (options->help || path_count == 2)
        return true;
    fputs("tecdiff: error: two files are needed\n", stderr);
    usage(stderr);
    return false;
}

/* ---- numbers ---- */

static size_t smaller(size_t a, size_t b)
{
    return a < b ? a : b;
}

static double size_of_difference(double a, double b)
{
    if ((isnan(a) && isnan(b)) || a == b)
        return 0.0;
    return isfinite(a) && isfinite(b) ? fabs(a - b) : (double)INFINITY;
}

static double larger_size(double a, double b)
{
    return fmax(fabs(a), fabs(b));
}

static bool within_tolerance(const struct options *options, double difference, double scale)
{
    if (difference == 0.0)
        return true;
    return isfinite(difference) && difference <= options->absolute + options->relative * scale;
}

/* The largest finite |value| of a variable in a zone of A. */
static double column_scale(const struct comparison *comparison, size_t zone, size_t variable)
{
    const struct tecplot_file *file = &comparison->files[0];
    double scale = 0.0;
    for (size_t row = 0; row < file->zones[zone].row_count; ++row) {
        const double value = file->zones[zone].values[row * file->variable_count + variable];
        if (isfinite(value))
            scale = fmax(scale, fabs(value));
    }
    return scale;
}

/* ---- structure ---- */

/* Counts a difference of structure; true when it is to be printed. */
static bool structure_differs(struct comparison *comparison)
{
    ++comparison->structure_count;
    return !comparison->options->quiet;
}

static void compare_names(struct comparison *comparison)
{
    for (size_t i = 0; i < comparison->variable_count; ++i) {
        const char *name_a = comparison->files[0].variable_names[i];
        const char *name_b = comparison->files[1].variable_names[i];
        comparison->findings[i].compared =
            comparison->options->ignore_names || strcmp(name_a, name_b) == 0;
        if (!comparison->findings[i].compared && structure_differs(comparison))
            printf("variable %zu: '%s' in A, '%s' in B (not compared)\n", i + 1, name_a, name_b);
    }
}

static void compare_rows_and_time(struct comparison *comparison, size_t number)
{
    const struct tecplot_zone *a = &comparison->files[0].zones[number];
    const struct tecplot_zone *b = &comparison->files[1].zones[number];
    if (a->row_count != b->row_count && structure_differs(comparison))
        printf("zone %zu: %zu rows in A, %zu rows in B\n", number + 1, a->row_count, b->row_count);
    if (a->time_from_title != b->time_from_title || isnan(a->solution_time) ||
        isnan(b->solution_time))
        return;
    const double difference = size_of_difference(a->solution_time, b->solution_time);
    const double scale = larger_size(a->solution_time, b->solution_time);
    if (!within_tolerance(comparison->options, difference, scale) && structure_differs(comparison))
        printf("zone %zu: solution time %.17g in A, %.17g in B\n", number + 1, a->solution_time,
               b->solution_time);
}

static void compare_structure(struct comparison *comparison)
{
    const struct tecplot_file *a = &comparison->files[0];
    const struct tecplot_file *b = &comparison->files[1];
    if (a->variable_count != b->variable_count && structure_differs(comparison))
        printf("variables: %zu in A, %zu in B\n", a->variable_count, b->variable_count);
    compare_names(comparison);
    if (a->zone_count != b->zone_count && structure_differs(comparison))
        printf("zones: %zu in A, %zu in B\n", a->zone_count, b->zone_count);
    for (size_t zone = 0; zone < comparison->zone_count; ++zone)
        compare_rows_and_time(comparison, zone);
}

/* ---- entries ---- */

/* An entry that differs by more than the tolerance. */
struct entry {
    size_t variable;
    struct place place;
    double a;
    double b;
    double difference;
    double scale;
};

/* What is done with an entry that differs; false ends the search. */
typedef bool (*entry_visitor)(struct comparison *comparison, const struct entry *entry);

static bool visit_row(struct comparison *comparison, struct place place, const double *scales,
                      entry_visitor visit)
{
    const struct options *options = comparison->options;
    const struct tecplot_file *files = comparison->files;
    const double *a = files[0].zones[place.zone].values + place.row * files[0].variable_count;
    const double *b = files[1].zones[place.zone].values + place.row * files[1].variable_count;
    for (size_t i = 0; i < comparison->variable_count; ++i) {
        struct entry entry = {.variable = i, .place = place, .a = a[i], .b = b[i]};
        entry.difference = size_of_difference(a[i], b[i]);
        entry.scale = options->column_scale ? scales[i] : larger_size(a[i], b[i]);
        if (comparison->findings[i].compared &&
            !within_tolerance(options, entry.difference, entry.scale) && !visit(comparison, &entry))
            return false;
    }
    return true;
}

static bool visit_zone(struct comparison *comparison, size_t zone, entry_visitor visit)
{
    const size_t rows = smaller(comparison->files[0].zones[zone].row_count,
                                comparison->files[1].zones[zone].row_count);
    if (comparison->options->column_scale)
        for (size_t i = 0; i < comparison->variable_count; ++i)
            comparison->scales[i] = column_scale(comparison, zone, i);
    for (size_t row = 0; row < rows; ++row)
        if (!visit_row(comparison, (struct place){zone, row}, comparison->scales, visit))
            return false;
    return true;
}

/* Visits the entries that differ, in the order of the files. */
static void visit_entries(struct comparison *comparison, entry_visitor visit)
{
    for (size_t zone = 0; zone < comparison->zone_count; ++zone)
        if (!visit_zone(comparison, zone, visit))
            return;
}

static bool record_entry(struct comparison *comparison, const struct entry *entry)
{
    struct finding *finding = &comparison->findings[entry->variable];
    const double difference = entry->difference;
    const double relative =
        isfinite(difference) && entry->scale > 0.0 ? difference / entry->scale : (double)INFINITY;
    if (finding->entry_count == 0 || difference > finding->largest_absolute) {
        finding->largest_absolute = difference;
        finding->absolute_place = entry->place;
    }
    if (finding->entry_count == 0 || relative > finding->largest_relative) {
        finding->largest_relative = relative;
        finding->relative_place = entry->place;
    }
    ++finding->entry_count;
    ++comparison->entry_count;
    return !comparison->options->quiet; /* one is enough for the exit status */
}

static bool print_entry(struct comparison *comparison, const struct entry *entry)
{
    if (comparison->entries_printed == comparison->options->entries)
        return false;
    printf("zone %zu row %zu %s: %.17g in A, %.17g in B\n", entry->place.zone + 1,
           entry->place.row + 1, comparison->files[0].variable_names[entry->variable], entry->a,
           entry->b);
    ++comparison->entries_printed;
    return true;
}

/* ---- report ---- */

static void print_place(struct place place, const char *end)
{
    printf(" %6zu %9zu%s", place.zone + 1, place.row + 1, end);
}

static void print_table(const struct comparison *comparison)
{
    printf("%-12s %10s %13s %6s %9s  %13s %6s %9s\n", "variable", "differing", "max abs diff",
           "zone", "row", "max rel diff", "zone", "row");
    for (size_t i = 0; i < comparison->variable_count; ++i) {
        const struct finding *finding = &comparison->findings[i];
        if (finding->entry_count == 0)
            continue;
        printf("%-12s %10zu %13.6e", comparison->files[0].variable_names[i], finding->entry_count,
               finding->largest_absolute);
        print_place(finding->absolute_place, "");
        printf("  %13.6e", finding->largest_relative);
        print_place(finding->relative_place, "\n");
    }
}

/* Prints what was found about the numbers. */
static void report_entries(struct comparison *comparison)
{
    print_table(comparison);
    visit_entries(comparison, print_entry);
    if (comparison->entries_printed < comparison->entry_count)
        printf("%zu of %zu differing entries shown\n", comparison->entries_printed,
               comparison->entry_count);
}

/* ---- main ---- */

static enum exit_status compare(struct comparison *comparison)
{
    compare_structure(comparison);
    visit_entries(comparison, record_entry);
    if (comparison->entry_count > 0 && !comparison->options->quiet)
        report_entries(comparison);
    return comparison->entry_count + comparison->structure_count > 0 ? DIFFER : AGREE;
}

/* Both files are in memory. */
static enum exit_status open_comparison(struct comparison *comparison)
{
    const struct tecplot_file *files = comparison->files;
    comparison->variable_count = smaller(files[0].variable_count, files[1].variable_count);
    comparison->zone_count = smaller(files[0].zone_count, files[1].zone_count);
    comparison->findings = calloc(comparison->variable_count, sizeof *comparison->findings);
    comparison->scales = calloc(comparison->variable_count, sizeof *comparison->scales);
    enum exit_status status = TROUBLE;
    if (comparison->findings == NULL || comparison->scales == NULL)
        fputs("tecdiff: error: out of memory\n", stderr);
    else
        status = compare(comparison);
    free(comparison->scales);
    free(comparison->findings);
    return status;
}

static enum exit_status compare_files(const struct options *options)
{
    struct comparison comparison = {.options = options};
    enum exit_status status = AGREE;
    for (size_t i = 0; i < 2; ++i) {
        struct tecplot_error error;
        if (!tecplot_read(options->paths[i], &comparison.files[i], &error)) {
            tecplot_print_error(options->paths[i], &error);
            status = TROUBLE;
        }
    }
    if (status == AGREE)
        status = open_comparison(&comparison);
    tecplot_free(&comparison.files[0]);
    tecplot_free(&comparison.files[1]);
    return status;
}

int main(int argument_count, char **arguments)
{
    struct options options = {.entries = 10};
    if (!read_command_line(argument_count, arguments, &options))
        return TROUBLE;
    enum exit_status status = AGREE;
    if (options.help)
        usage(stdout);
    else
        status = compare_files(&options);
    if (fflush(stdout) != 0 || ferror(stdout)) {
        fputs("tecdiff: error: the result cannot be written\n", stderr);
        return TROUBLE;
    }
    return (int)status;
}
