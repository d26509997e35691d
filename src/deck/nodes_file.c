/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nodes of rkpm from a file: a line of coordinates for each, as many as dimensions; a line may be empty, or a comment behind # or !. */
#include "base/memory.h"
#include "deck/commands_rkpm.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Three coordinates of any digits. */
static const size_t MOST_BYTES = (size_t)1 << 30;

/* Reads one line's coordinates; their number, or -1 where something else stands there. */
static int read_line(const char *line, double place[4])
{
    int count = 0;
    for (;;) {
        while (*line == ' ' || *line == '\t' || *line == ',' || *line == '\r')
            line++;
        if (*line == '\0' || *line == '\n' || *line == '#' || *line == '!')
            return count;
        char *end;
        const double number = strtod(line, &end);
        if (end == line || count == 4 || !isfinite(number) || !(*end == '\0' || isspace((unsigned char)*end) || *end == ','))
            return -1;
        place[count++] = number;
        line = end;
    }
}

static void add_place(struct scene_rkpm *rkpm, const double place[3])
{
    rkpm->places = memory_grow(rkpm->places, &rkpm->place_capacity, rkpm->n_places + 1, sizeof *rkpm->places, "nodes");
    memset(rkpm->places[rkpm->n_places], 0, sizeof *rkpm->places);
    memcpy(rkpm->places[rkpm->n_places++], place, (size_t)rkpm->dimension * sizeof *place);
}

/* All lines of a file's bytes, which end with NUL; false after an error. */
static bool read_lines(struct reader *reader, struct deck_place where, char *bytes)
{
    struct scene_rkpm *rkpm = &reader->scene->rkpm;
    long number = 1;
    for (char *line = bytes; *line; number++) {
        double place[4] = {0};
        char *end = line + strcspn(line, "\n");
        const bool is_last = *end == '\0';
        *end = '\0';
        const int count = read_line(line, place);
        if (count != 0 && count != rkpm->dimension) {
            diagnostics_error(reader->diagnostics, where, "line %ld of '%s' has no %ld coordinates", number, rkpm->file, rkpm->dimension);
            return false;
        }
        if (count > 0)
            add_place(rkpm, place);
        line = is_last ? end : end + 1;
    }
    return true;
}

static int compare(const void *a, const void *b)
{
    const double *p = a, *q = b;
    for (int i = 0; i < 3; i++)
        if (p[i] != q[i])
            return p[i] < q[i] ? -1 : 1;
    return 0;
}

/* Two nodes at one place have no cells, and no shape functions that tell them apart. */
static bool check_different(struct reader *reader, struct deck_place where)
{
    const struct scene_rkpm *rkpm = &reader->scene->rkpm;
    double(*sorted)[3] = memory_array(rkpm->n_places, sizeof *sorted, "nodes");
    bool good = true;
    memcpy(sorted, rkpm->places, rkpm->n_places * sizeof *sorted);
    qsort(sorted, rkpm->n_places, sizeof *sorted, compare);
    for (size_t i = 1; i < rkpm->n_places && good; i++)
        if (compare(sorted[i - 1], sorted[i]) == 0) {
            diagnostics_error(reader->diagnostics, where, "'%s' has two nodes at (%.9g, %.9g, %.9g)", rkpm->file, sorted[i][0], sorted[i][1], sorted[i][2]);
            good = false;
        }
    memory_free(sorted);
    return good;
}

/* They have to lie in the box, which says where the body ends. */
static bool check_places(struct reader *reader, struct deck_place where)
{
    const struct scene_rkpm *rkpm = &reader->scene->rkpm;
    for (size_t i = 0; i < rkpm->n_places; i++)
        for (int a = 0; a < rkpm->dimension; a++)
            if (rkpm->places[i][a] < rkpm->box[2 * a] || rkpm->places[i][a] > rkpm->box[2 * a + 1]) {
                diagnostics_error(reader->diagnostics, where, "node %zu of '%s' is outside the box: its %c is %.9g", i + 1, rkpm->file, "xyz"[a],
                                  rkpm->places[i][a]);
                return false;
            }
    if (rkpm->n_places <= (size_t)rkpm->dimension)
        diagnostics_error(reader->diagnostics, where, "'%s' has %zu nodes; expected more than %ld", rkpm->file, rkpm->n_places, rkpm->dimension);
    return rkpm->n_places > (size_t)rkpm->dimension && check_different(reader, where);
}

bool reader_nodes_file(struct reader *reader, struct deck_place where)
{
    struct scene_rkpm *rkpm = &reader->scene->rkpm;
    char *bytes = NULL;
    size_t size = 0;
    const int failure = text_read_file(reader->text, rkpm->file, MOST_BYTES, &bytes, &size);
    if (failure) {
        diagnostics_error(reader->diagnostics, where, "cannot read '%s': %s", rkpm->file, strerror(failure));
        memory_free(bytes);
        return false;
    }
    char *copy = memory_text(bytes ? bytes : "", size);
    const bool good = read_lines(reader, where, copy) && check_places(reader, where);
    memory_free(copy);
    memory_free(bytes);
    return good;
}
