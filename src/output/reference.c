/* SPDX-License-Identifier: GPL-3.0-or-later */
#define _POSIX_C_SOURCE 200809L
#include "output/reference.h"
#include "base/memory.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* --- reading --- */

static void forget_names(struct reference *reference)
{
    for (size_t i = 0; i < reference->n_names; i++)
        memory_free(reference->names[i]);
    reference->n_names = 0;
}

/* The names in quotes; the reference program pads them with blanks. */
static void read_names(struct reference *reference, const char *text)
{
    forget_names(reference);
    for (const char *open = strchr(text, '"'); open; open = strchr(open, '"')) {
        const char *close = strchr(++open, '"');
        if (!close)
            break;
        size_t length = (size_t)(close - open);
        while (length > 0 && open[length - 1] == ' ')
            length--;
        reference->names = memory_grow(reference->names, &reference->name_room, reference->n_names + 1,
                                       sizeof *reference->names, "a reference");
        reference->names[reference->n_names++] = memory_text(open, length);
        open = close + 1;
    }
}

/* Each zone takes the place of the one before. */
static void begin_zone(struct reference *reference, const char *text)
{
    const char *rows = strstr(text, " I="), *time = strstr(text, "SOLUTIONTIME=");
    reference->rows = reference->n_values = 0;
    reference->rows_declared = rows ? strtoul(rows + 3, NULL, 10) : 0;
    reference->time = time ? strtod(time + 13, NULL) : NAN;
}

/* A line of numbers, one for each name; false where it is not that. */
static bool read_row(struct reference *reference, const char *text)
{
    const size_t needed = reference->n_values + reference->n_names;
    reference->values =
        memory_grow(reference->values, &reference->value_room, needed, sizeof *reference->values, "a reference");
    while (reference->n_values < needed) {
        char *end;
        const double value = strtod(text, &end);
        if (end == text || !isfinite(value))
            return false;
        reference->values[reference->n_values++] = value;
        text = end;
    }
    reference->rows++;
    return text[strspn(text, " \t\r\n")] == '\0';
}

static bool read_line(struct reference *reference, const char *text, bool *is_in_zone)
{
    text += strspn(text, " \t\r\n");
    if (*text == '\0' || strncasecmp(text, "TITLE", 5) == 0)
        return true;
    if (strncasecmp(text, "VARIABLES", 9) == 0) {
        read_names(reference, text);
        return reference->n_names > 0;
    }
    if (strncasecmp(text, "ZONE", 4) == 0) {
        *is_in_zone = reference->n_names > 0;
        begin_zone(reference, text);
        return *is_in_zone;
    }
    return *is_in_zone && read_row(reference, text);
}

static enum status read_file(struct reference *reference, FILE *file)
{
    char *line = NULL;
    size_t room = 0, number = 0;
    bool is_in_zone = false, good = true;
    while (good && getline(&line, &room, file) >= 0) {
        number++;
        good = read_line(reference, line, &is_in_zone);
    }
    free(line);
    if (!good)
        status_error("%s:%zu: not a line of an animation file, or not one number for each name", reference->path, number);
    else if (ferror(file))
        status_error("cannot read '%s': %s", reference->path, strerror(errno));
    else if (reference->rows == 0 || (reference->rows_declared > 0 && reference->rows != reference->rows_declared))
        status_error("'%s' is cut: its last zone has %zu rows of %zu", reference->path, reference->rows,
                     reference->rows_declared);
    else
        return STATUS_FINISHED;
    return STATUS_FILE;
}

/* --- comparing --- */

/* A column of the reference beside what gives it in the run: a coordinate, or a result. */
struct pair {
    size_t column;
    int axis; /* of a coordinate; -1: a result */
    const struct result *result;
};

static bool find_pair(const struct reference *reference, const struct scene *scene, size_t column, struct pair *pair)
{
    static const char *const axes[] = {"X", "Y", "Z"};
    const char *name = reference->names[column];
    *pair = (struct pair){column, -1, NULL};
    for (int a = 0; a < 3; a++)
        if (strcasecmp(name, axes[a]) == 0)
            pair->axis = a;
    for (size_t i = 0; i < scene->n_results && pair->axis < 0; i++)
        if (strcasecmp(name, scene->results[i]->name) == 0)
            pair->result = scene->results[i];
    return pair->axis >= 0 || pair->result;
}

static double value_of(const struct pair *pair, const struct result_source *source, size_t p)
{
    return pair->axis >= 0 ? source->store->real[COLUMN_POSITION][pair->axis][p] : pair->result->value(source, p);
}

static enum status check_scene(const struct reference *reference, const struct scene *scene)
{
    struct pair pair;
    size_t common = 0;
    for (size_t c = 0; c < reference->n_names; c++)
        common += find_pair(reference, scene, c, &pair);
    if (!scene->writes_animation)
        status_error("--error compares what tecp writes, and the deck has no tecp");
    else if (common == 0)
        status_error("'%s' has no variable of the deck's outr, and no X, Y, Z", reference->path);
    else if (reference->rows > (size_t)scene->n_particles)
        status_error("'%s' has %zu rows, the deck only %zu particles", reference->path, reference->rows,
                     (size_t)scene->n_particles);
    else
        return STATUS_FINISHED;
    return STATUS_USAGE;
}

enum status reference_open(struct reference *reference, const char *path, const struct scene *scene)
{
    *reference = (struct reference){.path = path, .time = NAN};
    FILE *file = fopen(path, "r");
    if (!file) {
        status_error("cannot read '%s': %s", path, strerror(errno));
        return STATUS_FILE;
    }
    enum status status = read_file(reference, file);
    fclose(file);
    return status == STATUS_FINISHED ? check_scene(reference, scene) : status;
}

static void print_pair(const struct reference *reference, const struct pair *pair, const struct result_source *source,
                       const unsigned char *is_shown, FILE *stream)
{
    double least = INFINITY, most = -INFINITY, sum = 0, largest = 0;
    size_t row = 0;
    for (size_t id = 0; id < source->store->count; id++) {
        const size_t p = (size_t)source->store->index_of_id[id];
        if (!is_shown[id] || !result_is_shown(source, p))
            continue;
        const double expected = reference->values[row++ * reference->n_names + pair->column];
        const double difference = value_of(pair, source, p) - expected;
        least = fmin(least, expected);
        most = fmax(most, expected);
        sum += difference * difference;
        largest = fmax(largest, fabs(difference));
    }
    const double range = most - least, scale = range > 0 ? range : 1;
    fprintf(stream, "  %-8s  %.6E  %.6E  %.6E%s\n", reference->names[pair->column], sqrt(sum / (double)row) / scale,
            largest / scale, range, range > 0 ? "" : "  differences as they are");
}

enum status reference_print(const struct reference *reference, const struct scene *scene, const struct result_source *source,
                            const unsigned char *is_shown, double time, FILE *stream)
{
    size_t rows = 0;
    struct pair pair;
    for (size_t id = 0; id < source->store->count; id++)
        rows += is_shown[id] && result_is_shown(source, (size_t)source->store->index_of_id[id]);
    if (rows != reference->rows) {
        status_error("the run ends with %zu particles to show, the last zone of '%s' has %zu", rows, reference->path,
                     reference->rows);
        return STATUS_USAGE;
    }
    fprintf(stream, "error against the last zone of %s, %zu rows; time %.6E, there %.6E\n", reference->path, rows, time,
            reference->time);
    fprintf(stream, "  variable  L2 / range    max / range   range\n");
    for (size_t c = 0; c < reference->n_names; c++)
        if (find_pair(reference, scene, c, &pair))
            print_pair(reference, &pair, source, is_shown, stream);
    return STATUS_FINISHED;
}

void reference_close(struct reference *reference)
{
    forget_names(reference);
    memory_free(reference->names);
    memory_free(reference->values);
}
