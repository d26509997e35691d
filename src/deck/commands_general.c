/* SPDX-License-Identifier: GPL-3.0-or-later */
/* General information: title, counts, end, include. */
#include "base/memory.h"
#include "deck/reader.h"

#include <limits.h>
#include <stddef.h>
#include <string.h>

enum { MOST_FILES = 10000, MOST_DEPTH = 100, MOST_MATERIALS = 100000 };

static void read_title(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)values;
    reader->command = NULL; /* a number on the next line is none too many for the title */
    memory_free(reader->scene->title);
    reader->scene->title = text_rest_of_line(reader->text, word);
}

/* A wrong number of components is reported; no component is too large for it. */
static void fail_components(struct reader *reader, const struct deck_word *word)
{
    (void)word;
    reader->scene->components = INT_MAX;
}

/* A count that comes after what it counts. */
static void check_order(struct reader *reader, const struct deck_word *word, const char *name, const char *user,
                        size_t used)
{
    if (used > 0 && !reader_is_missing(reader, name))
        diagnostics_error(reader->diagnostics, word->place, "'%s' has to come before the first '%s'", name, user);
}

static void read_bodies(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    check_order(reader, word, "nbbo", "part", reader->scene->n_bodies);
    reader->bodies_place = values[0].word.place;
}

static void read_particles(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    check_order(reader, word, "nbmp", "part", reader->scene->n_bodies);
    reader->particles_place = values[0].word.place;
}

static void read_materials(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    check_order(reader, word, "nmat", "mate", reader->scene->n_materials);
    if (values[0].integer <= MOST_MATERIALS)
        return;
    diagnostics_error(reader->diagnostics, values[0].word.place, "materials of nmat must be at most %d, not %ld",
                      MOST_MATERIALS, values[0].integer);
    reader->scene->materials_declared = 0;
}

static void read_end(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    (void)values;
    reader->ended = true;
}

/* Starts reading a file; what is wrong with it, or NULL. */
static const char *include(struct reader *reader, const char *path)
{
    if (text_is_open(reader->text, path))
        return "the file includes itself";
    if (text_depth(reader->text) > MOST_DEPTH)
        return "too many includes inside includes";
    if (text_file_count(reader->text) > MOST_FILES)
        return "too many included files";
    if (*path == '\0' || path[strlen(path) - 1] == '/')
        return "a file name is missing";
    if (strcmp(path, "-") == 0)
        return "standard input can't be included";
    int failure = text_include_file(reader->text, path);
    return failure ? strerror(failure) : NULL;
}

/* What an unread file holds is not known. */
static void fail_include(struct reader *reader, const struct deck_word *word)
{
    (void)word;
    reader->is_partial = true;
}

static void read_include(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    const struct deck_word *file = &values[0].word;
    char *path = text_path(reader->text, file);
    const char *wrong = include(reader, path);
    if (wrong) {
        diagnostics_error(reader->diagnostics, file->place, "cannot include '%s': %s", path, wrong);
        fail_include(reader, word);
    }
    memory_free(path);
}

const struct keyword general_keywords[] = {
    {.name = "mpm3", .long_name = "mpm3d", .apply = read_title, .doc = "title: the whole line"},
    {.name = "nbco", .methods = METHODS_PARTICLES, .arguments = (const struct argument[]){{"components", NULL, ARGUMENT_INTEGER, LIMIT_COUNT}, {0}},
     .field = offsetof(struct scene, components), .fail = fail_components,
     .doc = "number of components (velocity fields for contact)"},
    {.name = "nbbo", .methods = METHODS_PARTICLES, .arguments = (const struct argument[]){{"bodies", NULL, ARGUMENT_INTEGER, LIMIT_COUNT}, {0}},
     .field = offsetof(struct scene, bodies_declared), .apply = read_bodies, .once = true,
     .doc = "number of bodies; before part, load, velo"},
    {.name = "nbmp", .methods = METHODS_PARTICLES, .arguments = (const struct argument[]){{"particles", NULL, ARGUMENT_INTEGER, LIMIT_COUNT}, {0}},
     .field = offsetof(struct scene, particles_declared), .apply = read_particles, .once = true,
     .doc = "number of particles; before mate, part, curv"},
    {.name = "nmat", .methods = METHODS_TIMED, .arguments = (const struct argument[]){{"materials", NULL, ARGUMENT_INTEGER, LIMIT_COUNT}, {0}},
     .field = offsetof(struct scene, materials_declared), .apply = read_materials, .once = true,
     .doc = "number of materials; before mate"},
    {.name = "incl", .long_name = "include",
     .arguments = (const struct argument[]){{"file", NULL, ARGUMENT_WORD, LIMIT_NONE}, {0}}, .apply = read_include,
     .fail = fail_include,
     .doc = "reads another file here; its path is seen from this deck's folder, in quotes if it has blanks"},
    {.name = "endi", .long_name = "endinput", .apply = read_end, .doc = "end of the deck; what follows is ignored"},
    {0}};

void reader_finish_general(struct reader *reader, struct deck_place end)
{
    struct scene *scene = reader->scene;
    if (!reader_was_given(reader, "part"))
        diagnostics_lack(reader->diagnostics, end, "the deck has no particles; expected a 'part' block");
    else if (scene->n_bodies > 0 && scene->n_particles == 0 && !reader->has_bad_part)
        diagnostics_error(reader->diagnostics, scene->bodies[0].place, "the bodies of this deck hold no particle");
    if (!scene->title)
        scene->title = memory_text("mpm3d", 5);
    if (diagnostics_errors(reader->diagnostics) > 0)
        return;
    if ((long)scene->n_bodies < scene->bodies_declared)
        diagnostics_warning(reader->diagnostics, reader->bodies_place, "nbbo says %ld bodies, the deck has %zu",
                            scene->bodies_declared, scene->n_bodies);
    if (scene->n_particles < scene->particles_declared)
        diagnostics_warning(reader->diagnostics, reader->particles_place, "nbmp says %ld particles, the deck has %ld",
                            scene->particles_declared, scene->n_particles);
}
