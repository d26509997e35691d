/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Discrete information: the part blocks. */
#include "base/memory.h"
#include "deck/commands_process.h"
#include "deck/number.h"
#include "particles/solid.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static const char *nearest_generator(const char *word)
{
    const char *found = NULL;
    int best = KEYWORD_FAR, count;
    const struct generator_row *rows = generator_rows(&count);
    for (int i = 0; i < count; i++) {
        keyword_nearer(word, rows[i].name, &best, &found);
        keyword_nearer(word, rows[i].long_name, &best, &found);
    }
    return found;
}

/* --- counting numbers ahead: says where one is missing before those behind it are taken amiss --- */

/* The numbers up to the next word that is none. */
struct run_of_numbers {
    long count;
    bool ends_well;        /* a command or the deck's end follows, no misspelt number */
    bool ends_deck;
    bool has_even;         /* some line has as many numbers as a line should */
    long odd_count;        /* numbers of the first line that has not; 0 where there is none */
    struct deck_place odd; /* of its first surplus number, or behind its last one */
};

/* A line of the run while it is counted. */
struct line_of_numbers {
    long count;
    struct deck_word last, surplus;
};

static void end_line(struct run_of_numbers *run, const struct line_of_numbers *line, long a_line)
{
    run->has_even = run->has_even || line->count == a_line;
    if (line->count == a_line || line->count == 0 || run->odd_count > 0)
        return;
    run->odd = line->count > a_line ? line->surplus.place : text_behind(&line->last);
    run->odd_count = line->count;
}

/* Counts from the word behind the last one taken; a line should have `a_line` numbers. */
static struct run_of_numbers numbers_ahead(struct reader *reader, long a_line)
{
    struct run_of_numbers run = {0};
    struct line_of_numbers line = {.last = reader->last};
    struct deck_word word = reader->last;
    double real;
    bool has_next;
    while ((has_next = text_after(reader->text, &word)) && number_is_real(&word, &real)) {
        if (word.place.line != line.last.place.line) {
            end_line(&run, &line, a_line);
            line.count = 0;
        }
        run.count++;
        line.last = word;
        if (++line.count == a_line + 1)
            line.surplus = word;
    }
    end_line(&run, &line, a_line);
    run.ends_deck = !has_next && text_depth(reader->text) == 1;
    run.ends_well = has_next ? reader_is_keyword(&word) : run.ends_deck;
    return run;
}

/* Whether as many numbers follow as n points have. Reports n or the first odd line; where no line
 * is a point, nothing can be said here. */
static bool check_points(struct reader *reader, const struct deck_word *before, const struct value *n, long a_line)
{
    struct run_of_numbers run = numbers_ahead(reader, a_line);
    if (run.count == n->integer * a_line || !run.has_even || !run.ends_well)
        return true;
    reader->is_cut = run.ends_deck;
    if (before->place.line != n->word.place.line)
        diagnostics_error(reader->diagnostics, text_behind(before),
                          "part poin lacks its n; expected a whole number");
    else if (run.odd_count == 0)
        diagnostics_error(reader->diagnostics, n->word.place, "n of part poin is %ld, but %ld points follow",
                          n->integer, run.count / a_line);
    else
        diagnostics_error(reader->diagnostics, run.odd,
                          "this line has %ld numbers; a point has %ld: id material mass x y z", run.odd_count, a_line);
    return false;
}

/* Whether the component was forgotten, so that the first number of the next line was taken for it. */
static bool lacks_component(struct reader *reader, const struct generator *generator, const struct value *values)
{
    const struct argument *arguments = generator->row->arguments;
    long needed = 0;
    while (arguments[needed].name && arguments[needed].kind != ARGUMENT_WORD)
        needed++;
    if (values[0].word.place.line == values[1].word.place.line || reader_at_line_end(reader)
        || numbers_ahead(reader, needed).count != needed - 1)
        return false;
    diagnostics_error(reader->diagnostics, text_behind(&values[0].word),
                      "part lacks its component; expected a whole number");
    return true;
}

/* --- bodies --- */

/* The points of `part poin com n`, one a line. */
static bool read_points(struct reader *reader, struct generator *generator)
{
    const struct deck_word component = reader->last;
    static const struct argument count[] = {{"n", NULL, ARGUMENT_INTEGER, LIMIT_COUNT}, {0}};
    static const struct argument arguments[] = {{"id", NULL, ARGUMENT_INTEGER, LIMIT_COUNT},
                                                {"material", NULL, ARGUMENT_INTEGER, LIMIT_COUNT},
                                                {"mass", "mass", ARGUMENT_REAL, LIMIT_POSITIVE},
                                                {"x", "length", ARGUMENT_REAL, LIMIT_NONE},
                                                {"y", "length", ARGUMENT_REAL, LIMIT_NONE},
                                                {"z", "length", ARGUMENT_REAL, LIMIT_NONE},
                                                {0}};
    struct value n[2], values[KEYWORD_ARGUMENTS];
    size_t capacity = 0;
    if (!reader_values(reader, count, "part poin", n) || !check_points(reader, &component, &n[0], argument_count(arguments)))
        return false;
    for (long i = 0; i < n[0].integer; i++) {
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
        int axis = is_axis ? reader_axis(reader, &values[i]) : 0;
        if (axis < 0)
            return false;
        generator->number[i - 3] = is_axis ? axis : values[i].real;
    }
    double mass = generator->density * generator->spacing * generator->spacing * generator->spacing;
    if (isfinite(mass) && mass > 0)
        return true;
    diagnostics_error(reader->diagnostics, values[1].word.place,
                      "the mass of a particle, density times spacing cubed, is %g", mass);
    return false;
}

/* Checks the number of points against nbmp, without going through an absurd lattice. */
static bool count_points(struct reader *reader, struct scene_body *body)
{
    const struct scene *scene = reader->scene;
    const struct generator *generator = &body->generator;
    double candidates = generator->row->candidates(generator);
    double most = 1e6 + generator->row->sparsity * (double)scene->particles_declared;
    body->count = candidates <= most ? generator_count(generator) : -1;
    if (body->count >= 0 && body->count <= scene->particles_declared - scene->n_particles)
        return true;
    if (scene->particles_declared == 0) /* nbmp is wrong or missing, which is reported */
        return false;
    if (body->count < 0)
        diagnostics_error(reader->diagnostics, body->place,
                          "this body's lattice has %.6g points, far more than nbmp, %ld", candidates,
                          scene->particles_declared);
    else
        diagnostics_error(reader->diagnostics, body->place,
                          "this body has %ld particles, with %ld before it more than nbmp, which is %ld", body->count,
                          scene->n_particles, scene->particles_declared);
    return false;
}

static bool part_may_come(struct reader *reader, const struct deck_word *word)
{
    const struct scene *scene = reader->scene;
    bool good = reader_needs(reader, word, "nbbo");
    good = reader_needs(reader, word, "nbmp") && good;
    good = reader_needs(reader, word, "mate") && good;
    if (scene->bodies_declared == 0 || (long)scene->n_bodies < scene->bodies_declared)
        return good;
    if ((long)scene->n_bodies == scene->bodies_declared) /* said once */
        diagnostics_error(reader->diagnostics, word->place, "one body more than nbbo, which is %ld",
                          scene->bodies_declared);
    return false;
}

/* The lattice and the steps of `part solid`; where the lattice is wrong the steps are read too. */
static bool read_solid(struct reader *reader, struct generator *generator, const struct value *values)
{
    struct deck_word word = values[1].word;
    double real;
    bool is_read = !lacks_component(reader, generator, values) && read_lattice(reader, generator);
    if (is_read)
        generator->solid = solid_open(generator->number, generator->spacing);
    while (!is_read && text_peek(reader->text, &word) && number_is_real(&word, &real))
        reader_word(reader, &word, "a step");
    is_read = reader_solid_block(reader, generator->solid) && is_read;
    const char *fault = is_read ? solid_fault(generator->solid) : NULL;
    if (fault)
        diagnostics_error(reader->diagnostics, values[0].word.place, "%s", fault);
    return is_read && !fault;
}

/* Reads what the generator needs. */
static bool read_generator(struct reader *reader, struct generator *generator, const struct value *values)
{
    char name[40];
    generator->row = generator_find(text_copy(&values[0].word, name, sizeof name));
    if (!generator->row) {
        reader_unknown(reader, &values[0].word, "generator", nearest_generator(name), "part");
        return false;
    }
    if (!generator->row->arguments)
        return read_points(reader, generator);
    if (strcmp(generator->row->name, "soli") == 0)
        return read_solid(reader, generator, values);
    return !lacks_component(reader, generator, values) && read_lattice(reader, generator);
}

static void add_body(struct reader *reader, struct scene_body *body)
{
    struct scene *scene = reader->scene;
    body->first = scene->n_particles;
    body->has_plot_box = reader->has_plot_box;
    memcpy(body->plot_box, reader->plot_box, sizeof body->plot_box);
    scene->n_particles += body->count;
    scene->bodies = memory_grow(scene->bodies, &scene->bodies_capacity, scene->n_bodies + 1, sizeof *body, "bodies");
    scene->bodies[scene->n_bodies++] = *body;
}

/* A body that can't be read keeps its place, so that the numbers of the others are right. */
static void fail_part(struct reader *reader, const struct deck_word *word)
{
    struct scene_body body = {.place = word->place};
    reader->has_bad_part = true;
    add_body(reader, &body);
    reader_skip_numbers(reader);
    reader_skip_solid(reader);
}

static void read_part(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    struct scene_body body = {.place = word->place, .component = (int)values[1].integer - 1,
                              .component_place = values[1].word.place};
    bool may_come = part_may_come(reader, word);
    bool is_read = read_generator(reader, &body.generator, values);
    if (!may_come || !is_read || !count_points(reader, &body)) {
        generator_close(&body.generator);
        fail_part(reader, word);
        return;
    }
    if (body.count == 0)
        diagnostics_warning(reader->diagnostics, word->place, "this body has no particle");
    add_body(reader, &body);
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
    {.name = "part", .methods = METHODS_PARTICLES, .long_name = "particle",
     .arguments = (const struct argument[]){{"generator", NULL, ARGUMENT_WORD, LIMIT_NONE},
                                            {"component", NULL, ARGUMENT_INTEGER, LIMIT_COUNT}, {0}},
     .apply = read_part, .fail = fail_part, .doc = "a body: its generator, component and numbers; after nbbo, nbmp, mate",
     .details = "part generator component\n  arguments of the generator\nThe generators:"},
    {.name = "pt2d", .methods = METHODS_PARTICLES,
     .arguments = (const struct argument[]){LENGTH("x0"), LENGTH("x1"), LENGTH("y0"), LENGTH("y1"), LENGTH("z0"),
                                            LENGTH("z1"), {0}},
     .apply = read_plot_box,
     .doc = "particles of later bodies created outside this box are left out of the animation file"},
    {.name = "Ghos", .methods = METHODS_MPM | METHODS_DYNAMIC, .long_name = "Ghost", .apply = reader_ghosts,
     .doc = "block that closes all particles but those it opens, up to endG; `ghos show` writes closed particles too",
     .details = "Ghost\n  GPD id value          (0 closed, 1 open)\n  GPD id1 id2 value\nendG\nA closed particle takes part in "
                "nothing until `open` opens it. The words:"},
    {.name = "open", .methods = METHODS_MPM | METHODS_DYNAMIC, .apply = reader_opening,
     .doc = "how closed particles open: `open point every n`, `open group k every n`, `open layer every n`, `open all`",
     .details = "open point every n     one particle every n steps, in the order of `scan`\nopen group k every n   k particles\n"
                "open layer every n     a layer\nopen all               all at the first step\n"
                "open settle n          the run ends n steps after the last opening, whatever endt says\n"
                "open until id          no particle opens after this one, nor the rest of its layer"},
    {.name = "buil", .methods = METHODS_MPM | METHODS_DYNAMIC, .long_name = "build", .apply = reader_build,
     .doc = "build direction x, y or z (default), and the thickness of layers; without it particles of one height are a layer",
     .details = "buil x|y|z [thickness]"},
    {.name = "scan", .methods = METHODS_MPM, .apply = reader_scan,
     .doc = "scan angles of layer 1, 2, ... in turn, in degrees; `scan raster` opens particles along lines at that angle",
     .details = "scan a1 a2 ...             turns residual stress; the plane is y z, z x or x y for buil x, y, z\n"
                "scan deck [a1 ...]         particles open in the order of their ids (default)\n"
                "scan raster [serpentine] [a1 ...]   line by line at the layer's angle, with serpentine every other line backwards"},
    {0}};
