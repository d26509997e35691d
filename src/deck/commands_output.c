/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Post-processing output: intervals, result names, curves, file styles. */
#include "base/memory.h"
#include "deck/reader.h"

#include <limits.h>
#include <math.h>
#include <stddef.h>
#include <string.h>
#include <strings.h>

/* The row of a result name; reports unknown and unavailable ones and returns NULL. */
static const struct result *find_result(struct reader *reader, const struct deck_word *word)
{
    char name[40];
    const struct result *row = result_find(text_copy(word, name, sizeof name));
    if (row && row->later) {
        diagnostics_error(reader->diagnostics, word->place, "result '%s' is not available in this version: %s",
                          row->name, row->later);
        return NULL;
    }
    if (row)
        return row;
    int best = KEYWORD_FAR, count;
    const struct result *rows = result_rows(&count);
    const char *nearest = NULL;
    for (int i = 0; i < count; i++)
        keyword_nearer(name, rows[i].name, &best, &nearest);
    reader_unknown(reader, word, "result", nearest, "outr");
    reader_skip_line(reader);
    return NULL;
}

static void read_output_interval(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)values;
    reader->has_output_interval = true;
    reader->output_interval_place = word->place;
}

static void read_tecplot(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    (void)values;
    reader->scene->writes_animation = true;
}

/* Notes a result that only some methods have; one that is a sum over all particles has no place beside particles. */
static bool use_result(struct reader *reader, const struct result *result, const struct deck_word *word, bool is_curve)
{
    if (!is_curve && !result->value) {
        diagnostics_error(reader->diagnostics, word->place, "'%s' is of all particles together: only for 'curv %s'", result->name,
                          result->name);
        return false;
    }
    reader_use(reader, "result ", result->name, is_curve ? result_curve_methods(result) : result->methods, word->place);
    return true;
}

static void read_result(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    struct scene *scene = reader->scene;
    const struct result *row = find_result(reader, &values[0].word);
    if (!row || !use_result(reader, row, &values[0].word, false))
        return;
    scene->results = memory_grow(scene->results, &scene->results_capacity, scene->n_results + 1,
                                 sizeof *scene->results, "results");
    scene->results[scene->n_results++] = row;
}

static void add_curve(struct scene *scene, struct scene_curve curve)
{
    scene->curves = memory_grow(scene->curves, &scene->curves_capacity, scene->n_curves + 1, sizeof curve, "curves");
    scene->curves[scene->n_curves++] = curve;
}

static void read_curve(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    struct scene_curve curve = {.result = find_result(reader, &values[0].word), .place = values[0].word.place};
    struct deck_word next;
    struct value id = {.integer = 1};
    const bool is_nodes = reader->scene->method == METHOD_RKPM; /* whose number is known at the end of the deck */
    if (!is_nodes)
        reader_needs(reader, word, "nbmp");
    bool has_id = !reader_at_line_end(reader) && text_peek(reader->text, &next) && next.length > 0
               && strchr("0123456789+-.", next.text[0]);
    if (has_id) {
        struct value read[2];
        if (!reader_values(reader, (const struct argument[]){{"particle", NULL, ARGUMENT_INTEGER, LIMIT_COUNT}, {0}},
                           "curv", read))
            return;
        id = read[0];
        curve.place = id.word.place;
        if (!is_nodes && !reader_check_id(reader, &id, reader->scene->particles_declared, "particle"))
            return;
    }
    curve.particle = id.integer - 1;
    if (curve.result && use_result(reader, curve.result, &values[0].word, true))
        add_curve(reader->scene, curve);
}

static void read_near_curve(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    struct scene_curve curve = {.result = find_result(reader, &values[0].word), .is_near = true, .place = word->place};
    for (int a = 0; a < 3; a++)
        curve.point[a] = values[1 + a].real;
    const bool has_cells = reader->scene->method == METHOD_MPM;
    if ((!has_cells || reader_needs(reader, word, "dcel")) && reader_needs(reader, word, "part") && curve.result
        && use_result(reader, curve.result, &values[0].word, curve.result->value != NULL))
        add_curve(reader->scene, curve);
}

/* A word that must be one of two; stores whether it was the first. */
static void read_choice(struct reader *reader, const struct value *value, const char *first, const char *second,
                        const char *owner, bool *is_first)
{
    char word[40];
    text_show(&value->word, word, sizeof word);
    if (strncasecmp(word, first, 4) != 0 && strncasecmp(word, second, 4) != 0)
        diagnostics_error(reader->diagnostics, value->word.place, "%s must be %s or %s, not '%s'", owner, first, second,
                          word);
    else
        *is_first = strncasecmp(word, first, 4) == 0;
}

static void read_names(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    read_choice(reader, &values[0], "mpm3d", "job", "names", &reader->scene->bare_names);
}

static void read_headers(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    read_choice(reader, &values[0], "mpm3d", "tecplot", "head", &reader->scene->bare_headers);
}

static void read_zones(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    read_choice(reader, &values[0], "body", "all", "zone", &reader->scene->zones_by_body);
}

static void read_paraview(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const char *const formats[] = {"ascii", "binary", NULL};
    (void)word;
    (void)values;
    int format = reader_optional(reader, formats);
    reader->scene->writes_vtk = true;
    reader->scene->vtk_format = format == 0 ? VTK_TEXT : format == 1 ? VTK_BINARY : VTK_AUTO;
}

static void read_smoothing(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    (void)values;
    reader->scene->smooths_pressure = true;
}

/* every n [steps], or every t time. */
static void read_restart(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const char *const every[] = {"every", NULL}, *const units[] = {"steps", "time", NULL};
    static const struct argument number[] = {{"number", NULL, ARGUMENT_REAL, LIMIT_POSITIVE}, {0}};
    struct value value[2];
    (void)word;
    (void)values;
    if (reader_optional(reader, every) < 0) {
        diagnostics_error(reader->diagnostics, text_behind(&reader->last), "rest lacks 'every n steps' or 'every t time'");
        reader_skip_line(reader);
        return;
    }
    if (!reader_values(reader, number, "rest", value))
        return;
    const bool is_time = reader_optional(reader, units) == 1;
    if (!is_time && (value[0].real != floor(value[0].real) || value[0].real > INT_MAX)) {
        diagnostics_error(reader->diagnostics, value[0].word.place,
                          "rest every: %g is no whole number of steps; a time is 'every %g time'", value[0].real, value[0].real);
        return;
    }
    reader->scene->restart_steps = is_time ? 0 : (long)value[0].real;
    reader->scene->restart_interval = is_time ? value[0].real : 0;
}

#define INTERVAL ((const struct argument[]){{"interval", "time", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE}, {0}})
#define RESULT {"result", NULL, ARGUMENT_WORD, LIMIT_NONE}
#define LENGTH(name) {name, "length", ARGUMENT_REAL, LIMIT_NONE}

const struct keyword output_keywords[] = {
    {.name = "outt", .methods = METHODS_TIMED, .long_name = "outtime", .arguments = INTERVAL, .field = offsetof(struct scene, output_interval),
     .apply = read_output_interval, .doc = "interval of the animation output; after endt, which sets it too"},
    {.name = "rptt", .methods = METHODS_TIMED, .long_name = "rpttime", .arguments = INTERVAL, .field = offsetof(struct scene, report_interval),
     .doc = "interval of the report lines; 0 is every step"},
    {.name = "tecp", .long_name = "tecplot", .apply = read_tecplot, .doc = "write the animation file job_anim.dat"},
    {.name = "outr", .arguments = (const struct argument[]){RESULT, {0}}, .apply = read_result,
     .doc = "adds a result to the animation file", .details = "outr result\nThe results:"},
    {.name = "curv", .methods = METHODS_TIMED, .long_name = "curve", .arguments = (const struct argument[]){RESULT, {0}}, .apply = read_curve,
     .doc = "adds a curve: a result of one particle (default 1), written every step; with meth rkpm behind meth",
     .details = "curv result [particle]     (the id on the same line)\nThe results:"},
    {.name = "curx", .methods = METHODS_PARTICLES, .arguments = (const struct argument[]){RESULT, LENGTH("x"), LENGTH("y"), LENGTH("z"), {0}},
     .apply = read_near_curve, .doc = "adds a curve of the particle within a quarter cell of a point, with meth sph of the nearest one within half a "
            "spacing; after meth and all part"},
    {.name = "name", .methods = METHODS_TIMED, .long_name = "names",
     .arguments = (const struct argument[]){{"job|mpm3d", NULL, ARGUMENT_WORD, LIMIT_NONE}, {0}}, .apply = read_names,
     .doc = "names of the energy and momentum files: job_energy.dat, or EnergyPlot.dat as in MPM3D-F90"},
    {.name = "head", .long_name = "header",
     .arguments = (const struct argument[]){{"tecplot|mpm3d", NULL, ARGUMENT_WORD, LIMIT_NONE}, {0}},
     .apply = read_headers, .doc = "headers of the tables: Tecplot's, or the bare ones of MPM3D-F90"},
    {.name = "zone", .methods = METHODS_PARTICLES, .arguments = (const struct argument[]){{"all|body", NULL, ARGUMENT_WORD, LIMIT_NONE}, {0}},
     .apply = read_zones, .doc = "zones of the animation file: one of all particles (default), or one for each body"},
    {.name = "digi", .long_name = "digits",
     .arguments = (const struct argument[]){{"digits", NULL, ARGUMENT_INTEGER, LIMIT_DIGITS}, {0}},
     .field = offsetof(struct scene, digits), .doc = "significant digits in the tables (7; MPM3D-F90 has 4)"},
    {.name = "smoo", .methods = METHODS_MPM, .apply = read_smoothing, .doc = "adds a smoothed pressure to the ParaView files"},
    {.name = "para", .long_name = "paraview", .apply = read_paraview,
     .doc = "write ParaView files job_anim_N.vtu and job_anim.pvd; `para ascii` or `para binary` (by size). With meth sph the results of outr stand in them too"},
    {.name = "rest", .methods = METHODS_TIMED, .long_name = "restart", .apply = read_restart,
     .doc = "`rest every n steps` or `rest every t time`: then, and at the end, writes a checkpoint job.rest to go on "
            "from with mpm3d --restart job.rest job.mpm",
     .details = "rest every n steps\nrest every t time\nThe one before is kept as job.rest.old. A run that is interrupted by "
                "Ctrl-C or SIGTERM writes\none without rest too. Files that the run had written go on where they were at the "
                "checkpoint;\nendt, rptt, rest and sort of the deck may be others."},
    {0}};
