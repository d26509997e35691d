/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Discrete information: the part blocks. */
#include "base/memory.h"
#include "deck/reader.h"

#include <stddef.h>
#include <string.h>

enum { MOST_CANDIDATES_FACTOR = 64 };

static const char *nearest_generator(const char *word)
{
    const char *found = NULL;
    int best = 99, count;
    const struct generator_row *rows = generator_rows(&count);
    for (int i = 0; i < count; i++) {
        const char *spellings[2] = {rows[i].name, rows[i].long_name};
        for (int s = 0; s < 2; s++) {
            int distance = keyword_distance(word, spellings[s]);
            if (distance >= 0 && distance < best) {
                best = distance;
                found = spellings[s];
            }
        }
    }
    return found;
}

/* The points of `part poin com n`, one a line. */
static bool read_points(struct reader *reader, struct generator *generator, long n)
{
    static const struct argument arguments[] = {{"id", NULL, ARGUMENT_INTEGER, LIMIT_COUNT},
                                                {"material", NULL, ARGUMENT_INTEGER, LIMIT_COUNT},
                                                {"mass", "mass", ARGUMENT_REAL, LIMIT_POSITIVE},
                                                {"x", "length", ARGUMENT_REAL, LIMIT_NONE},
                                                {"y", "length", ARGUMENT_REAL, LIMIT_NONE},
                                                {"z", "length", ARGUMENT_REAL, LIMIT_NONE},
                                                {0}};
    struct value values[KEYWORD_ARGUMENTS];
    size_t capacity = 0;
    for (long i = 0; i < n; i++) {
        if (!reader_values(reader, arguments, "part poin", values)
            || !reader_check_id(reader, &values[1], (long)reader->scene->n_materials, "material"))
            return false;
        if (values[0].integer <= reader->scene->n_particles + i) {
            diagnostics_error(reader->diagnostics, values[0].word.place, "point id %ld is taken; expected %ld or more",
                              values[0].integer, reader->scene->n_particles + i + 1);
            return false;
        }
        generator->points = memory_grow(generator->points, &capacity, (size_t)i + 1, sizeof *generator->points, "points");
        generator->points[i] = (struct generator_point){
            values[2].real, {values[3].real, values[4].real, values[5].real}};
        generator->n_points = i + 1;
        generator->material = (int)values[1].integer - 1;
    }
    return true;
}

/* An axis as x, y, z or 1, 2, 3; -1 and an error otherwise. */
static int read_axis(struct reader *reader, const struct value *value)
{
    static const char names[] = "xyzXYZ123";
    const char *found = value->word.length == 1 ? strchr(names, value->word.text[0]) : NULL;
    if (found)
        return (int)(found - names) % 3;
    diagnostics_error(reader->diagnostics, value->word.place, "the axis must be x, y or z");
    return -1;
}

static bool read_lattice(struct reader *reader, struct generator *generator)
{
    struct value values[KEYWORD_ARGUMENTS];
    const struct argument *arguments = generator->row->arguments;
    if (!reader_values(reader, arguments, generator->row->name, values)
        || !reader_check_id(reader, &values[0], (long)reader->scene->n_materials, "material"))
        return false;
    generator->material = (int)values[0].integer - 1;
    generator->density = values[1].real;
    generator->spacing = values[2].real;
    for (int i = 3; i < argument_count(arguments); i++) {
        bool is_axis = arguments[i].kind == ARGUMENT_WORD;
        int axis = is_axis ? read_axis(reader, &values[i]) : 0;
        if (axis < 0)
            return false;
        generator->number[i - 3] = is_axis ? axis : values[i].real;
    }
    return true;
}

/* Checks the number of points against nbmp, without going through an absurd lattice. */
static bool count_points(struct reader *reader, struct scene_body *body)
{
    const struct scene *scene = reader->scene;
    const struct generator *generator = &body->generator;
    double candidates = generator->row->candidates(generator);
    double most = 1e6 + MOST_CANDIDATES_FACTOR * (double)scene->particles_declared;
    body->count = candidates <= most ? generator_count(generator) : -1;
    if (body->count >= 0 && body->count <= scene->particles_declared - scene->n_particles)
        return true;
    if (body->count < 0)
        diagnostics_error(reader->diagnostics, body->place, "this body's lattice has %.6g points; nbmp is %ld",
                          candidates, scene->particles_declared);
    else
        diagnostics_error(reader->diagnostics, body->place,
                          "this body has %ld particles, with %ld before it more than nbmp, which is %ld", body->count,
                          scene->n_particles, scene->particles_declared);
    return false;
}

static bool part_may_come(struct reader *reader, const struct deck_word *word)
{
    const char *missing = !reader->has_bodies_declared     ? "nbbo"
                        : !reader->has_particles_declared ? "nbmp"
                        : reader->scene->n_materials == 0 ? "mate"
                                                          : NULL;
    if (missing && (strcmp(missing, "mate") != 0 || diagnostics_errors(reader->diagnostics) == 0))
        diagnostics_error(reader->diagnostics, word->place, "'part' needs '%s' before it", missing);
    else if (!missing && (long)reader->scene->n_bodies >= reader->scene->bodies_declared)
        diagnostics_error(reader->diagnostics, word->place, "one body more than nbbo, which is %ld",
                          reader->scene->bodies_declared);
    else
        return !missing;
    return false;
}

/* Skips the data lines of a part block that can't be read. */
static void skip_part(struct reader *reader)
{
    struct deck_word word;
    double real;
    for (reader_skip_line(reader); text_peek(reader->text, &word) && reader_is_real(&word, &real);
         reader_skip_line(reader))
        text_next(reader->text, &reader->last);
}

static void read_part(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    struct scene *scene = reader->scene;
    struct scene_body body = {.place = word->place, .component = (int)values[1].integer - 1};
    char name[40];
    bool good = part_may_come(reader, word);
    body.generator.row = generator_find(text_copy(&values[0].word, name, sizeof name));
    if (!body.generator.row)
        reader_unknown(reader, &values[0].word, "generator", nearest_generator(name));
    good = good && body.generator.row && reader_check_id(reader, &values[1], scene->components, "component");
    if (good && !body.generator.row->arguments) {
        struct value n[2];
        good = reader_values(reader, (const struct argument[]){{"n", NULL, ARGUMENT_INTEGER, LIMIT_COUNT}, {0}},
                             "part poin", n)
            && read_points(reader, &body.generator, n[0].integer);
    } else if (good) {
        good = read_lattice(reader, &body.generator);
    }
    if (!good) {
        memory_free(body.generator.points);
        skip_part(reader);
        return;
    }
    if (!count_points(reader, &body))
        body.count = 0;
    body.first = scene->n_particles;
    body.has_plot_box = reader->has_plot_box;
    memcpy(body.plot_box, reader->plot_box, sizeof body.plot_box);
    scene->n_particles += body.count;
    scene->bodies = memory_grow(scene->bodies, &scene->bodies_capacity, scene->n_bodies + 1, sizeof body, "bodies");
    scene->bodies[scene->n_bodies++] = body;
}

static void read_plot_box(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    reader->has_plot_box = true;
    for (int i = 0; i < 6; i++)
        reader->plot_box[i] = values[i].real;
}

#define LENGTH(name) {name, "length", ARGUMENT_REAL, LIMIT_NONE}

const struct keyword discrete_keywords[] = {
    {.name = "part", .long_name = "particle",
     .arguments = (const struct argument[]){{"generator", NULL, ARGUMENT_WORD, LIMIT_NONE},
                                            {"component", NULL, ARGUMENT_INTEGER, LIMIT_COUNT}, {0}},
     .apply = read_part, .doc = "a body: its generator, component and numbers; after nbbo, nbmp, mate",
     .details = "part generator component\n  arguments of the generator\nThe generators:"},
    {.name = "pt2d",
     .arguments = (const struct argument[]){LENGTH("x0"), LENGTH("x1"), LENGTH("y0"), LENGTH("y1"), LENGTH("z0"),
                                            LENGTH("z1"), {0}},
     .apply = read_plot_box,
     .doc = "particles of later bodies created outside this box are left out of the animation file"},
    {0}};
