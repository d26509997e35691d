/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * tecview: pictures of the particles of a Tecplot file and charts of its curves.
 *
 * The command line becomes a request by the table `options`; tecview_points.c or tecview_curve.c
 * then draws it.
 */
#include "tecview.h"
#include "base/memory.h"
#include "tecplot_read.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum exit_status { DONE = 0, TROUBLE = 2 };

enum command { POINTS = 1, CURVE = 2 };

enum kind { FLAG, TEXT, TWO_TEXTS, NUMBER, RANGE, SIZE, CONDITION };

#define TO(field) offsetof(struct tecview_request, field)

static const struct option {
    const char *name;
    int commands; /* those that know it, POINTS | CURVE */
    enum kind kind;
    size_t offset; /* of what it sets */
    const char *operands;
    const char *explanation;
} options[] = {
    {"--out", POINTS | CURVE, TEXT, TO(out), "FILE", "the picture: .png; a chart also .svg"},
    {"--zone", POINTS | CURVE, TEXT, TO(zone), "N", "last, first or a number from 1 (last)"},
    {"--title", POINTS | CURVE, TEXT, TO(title), "TEXT", "title (that of the file)"},
    {"--unit", POINTS | CURVE, TEXT, TO(unit), "TEXT", "unit of the values; of X,Y in a chart"},
    {"--range", POINTS | CURVE, RANGE, TO(range), "LO HI", "range of colours, or of y"},
    {"--size", POINTS | CURVE, SIZE, TO(size), "WxH", "size in points (1200x800, 900x560)"},
    {"--of", POINTS, TEXT, TO(of), "VAR", "the variable that gives the colour"},
    {"--label", POINTS, TEXT, TO(label), "TEXT", "what to call that variable"},
    {"--length-unit", POINTS, TEXT, TO(length_unit), "TEXT", "unit of the coordinates"},
    {"--from", POINTS, TEXT, TO(from), "WHERE",
     "iso, front, back, left, side, top, below or x,y,z"},
    {"--section", POINTS, TEXT, TO(section), "x=0", "the points in a plane x=, y= or z="},
    {"--both", POINTS, FLAG, TO(both), "", "the body beside its section"},
    {"--deform", POINTS, TWO_TEXTS, TO(deform), "U,V,W F",
     "displacements shown F times (a number or auto), 0 for none: disx,disy,disz 50"},
    {"--spacing", POINTS, NUMBER, TO(spacing), "H", "size of the cubes (from the neighbours)"},
    {"--where", POINTS, CONDITION, TO(conditions), "VAR LO HI",
     "only points with LO <= VAR <= HI; may be repeated"},
    {"--x", CURVE, TEXT, TO(x), "VAR", "variable along (the first)"},
    {"--y", CURVE, TEXT, TO(y), "VAR,VAR", "variables upwards"},
    {"--group", CURVE, TEXT, TO(group), "VAR", "a series for each word of this variable"},
    {"--log", CURVE, TEXT, TO(log), "x|y|xy", "logarithmic scales"},
    {"--points", CURVE, FLAG, TO(marks), "", "marks on the lines (of more than 60 points not all)"},
    {"--pareto", CURVE, FLAG, TO(pareto), "",
     "marks without lines; the rows that no row beats in x and in y are joined"},
    {"--xrange", CURVE, RANGE, TO(x_range), "LO HI", "range of x"},
    {"--xlabel", CURVE, TEXT, TO(x_label), "TEXT", "what to call x"},
    {"--ylabel", CURVE, TEXT, TO(y_label), "TEXT", "what to call y"},
    {"--legend", CURVE, TEXT, TO(legend), "A,B,...", "what to call the series"},
};

enum { OPTION_COUNT = sizeof options / sizeof *options };

static const char *const command_names[] = {[POINTS] = "points", [CURVE] = "curve"};

bool tecview_complain(const char *what, const char *text)
{
    fprintf(stderr, "tecview: error: %s '%s'\n", what, text);
    return false;
}

static void print_options(FILE *stream, int commands)
{
    for (size_t i = 0; i < OPTION_COUNT; ++i)
        if (options[i].commands == commands) {
            char words[40];
            (void)snprintf(words, sizeof words, "%s %s", options[i].name, options[i].operands);
            fprintf(stream, "  %-22s %s\n", words, options[i].explanation);
        }
}

static void usage(FILE *stream)
{
    fputs("usage: tecview points FILE --of VAR --out FILE.png [OPTION]...\n"
          "       tecview curve FILE... --y VAR --out FILE.svg [OPTION]...\n"
          "\n"
          "Draws the particles of a Tecplot file, or a chart of the columns of files or tables.\n"
          "\n",
          stream);
    print_options(stream, POINTS | CURVE);
    fputs("\npoints:\n", stream);
    print_options(stream, POINTS);
    fputs("\ncurve:\n", stream);
    print_options(stream, CURVE);
    fputs(
        "\nThe file's X, Y and Z are where the particles are now. In texts ^{2} is raised. Values\n"
        "that are NaN are drawn grey, in a chart left out; they are counted.\n"
        "\n"
        "exit status: 0 done, 2 wrong usage, a file that cannot be read or written, or nothing\n"
        "to draw\n"
        "\n"
        "examples: tecview points bar_anim.dat --of seqv --unit MPa --section y=0 --both --out "
        "a.png\n"
        "          tecview curve bar_curv.dat --x Time --y engk,engi --unit ms,mJ --out b.svg\n",
        stream);
}

/* ---- command line ---- */

static bool read_number(const char *text, double *number)
{
    return tecplot_number(text, strlen(text), number) == NULL && isfinite(*number);
}

static bool read_two_numbers(char **operands, double *numbers, const char *option)
{
    for (int i = 0; i < 2; ++i)
        if (!read_number(operands[i], &numbers[i])) {
            fprintf(stderr, "tecview: error: %s: '%s' is not a number\n", option, operands[i]);
            return false;
        }
    return true;
}

/* Two numbers that leave room for a scale. */
static bool read_range(char **operands, double *range, const char *option)
{
    if (!read_two_numbers(operands, range, option))
        return false;
    if (!(range[0] < range[1]))
        fprintf(stderr, "tecview: error: %s: %s must be less than %s\n", option, operands[0],
                operands[1]);
    return range[0] < range[1];
}

static bool read_size(const char *text, double *size)
{
    const char *cross = strchr(text, 'x');
    const bool good = cross != NULL &&
                      tecplot_number(text, (size_t)(cross - text), &size[0]) == NULL &&
                      read_number(cross + 1, &size[1]) && size[0] >= 400.0 && size[0] <= 10000.0 &&
                      size[1] >= 300.0 && size[1] <= 10000.0 && floor(size[0]) == size[0] &&
                      floor(size[1]) == size[1];
    return good ||
           tecview_complain("--size must be like 1200x800, from 400x300 to 10000x10000, not", text);
}

static bool read_condition(char **operands, struct tecview_request *request)
{
    double limits[2];
    if (!read_two_numbers(operands + 1, limits, "--where"))
        return false;
    request->conditions[request->condition_count++] =
        (struct tecview_condition){operands[0], limits[0], limits[1]};
    return true;
}

static int operand_count(enum kind kind)
{
    static const int counts[] = {[FLAG] = 0,  [TEXT] = 1, [TWO_TEXTS] = 2, [NUMBER] = 1,
                                 [RANGE] = 2, [SIZE] = 1, [CONDITION] = 3};
    return counts[kind];
}

static bool set_option(const struct option *option, char **operands,
                       struct tecview_request *request)
{
    void *field = (char *)request + option->offset;
    switch (option->kind) {
    case FLAG:
        *(bool *)field = true;
        return true;
    case TEXT:
    case TWO_TEXTS:
        for (int i = 0; i < operand_count(option->kind); ++i)
            ((const char **)field)[i] = operands[i];
        return true;
    case NUMBER:
        return (read_number(operands[0], field) && *(double *)field > 0.0) ||
               tecview_complain("not a number greater than 0:", operands[0]);
    case RANGE:
        return read_range(operands, field, option->name);
    case SIZE:
        return read_size(operands[0], field);
    case CONDITION:
        return read_condition(operands, request);
    }
    return false;
}

static const struct option *find_option(const char *name)
{
    for (size_t i = 0; i < OPTION_COUNT; ++i)
        if (strcmp(name, options[i].name) == 0)
            return &options[i];
    return NULL;
}

/* Reads the option at arguments[*index] and moves *index to its last operand. */
static bool read_option(int argument_count, char **arguments, int *index, enum command command,
                        struct tecview_request *request)
{
    const struct option *option = find_option(arguments[*index]);
    if (option == NULL)
        return tecview_complain("unknown option (tecview --help lists them):", arguments[*index]);
    if ((option->commands & (int)command) == 0) {
        fprintf(stderr, "tecview: error: '%s' has no option '%s'\n", command_names[command],
                option->name);
        return false;
    }
    const int count = operand_count(option->kind);
    if (argument_count - *index - 1 < count) {
        fprintf(stderr, "tecview: error: %s needs %s\n", option->name, option->operands);
        return false;
    }
    *index += count;
    return set_option(option, &arguments[*index - count + 1], request);
}

static bool read_command_line(int argument_count, char **arguments, enum command command,
                              struct tecview_request *request)
{
    for (int i = 2; i < argument_count; ++i)
        if (arguments[i][0] == '-' && arguments[i][1] == '-') {
            if (!read_option(argument_count, arguments, &i, command, request))
                return false;
        } else
            request->paths[request->path_count++] = arguments[i];
    if (request->path_count == 0)
        return tecview_complain("a file is needed after", command_names[command]);
    return true;
}

/* ---- what both commands use ---- */

bool tecview_open_page(const struct tecview_request *request, int width, int height,
                       struct draw_page *page)
{
    const struct draw_backend *backend = draw_page_backend(request->out);
    if (backend == NULL)
        return tecview_complain("--out must end in .png or .svg, not", request->out);
    if (request->size[0] > 0.0) {
        width = (int)request->size[0];
        height = (int)request->size[1];
    }
    draw_page_open(page, backend, width, height);
    return true;
}

bool tecview_write_page(const struct tecview_request *request, struct draw_page *page)
{
    if (draw_page_write(page, request->out))
        return true;
    fprintf(stderr, "%s: error: cannot be written: %s\n", request->out, strerror(errno));
    return false;
}

/* ---- main ---- */

static bool run(int argument_count, char **arguments, enum command command)
{
    const size_t count = (size_t)argument_count;
    struct tecview_request request = {.zone = "last",
                                      .range = {(double)NAN, (double)NAN},
                                      .x_range = {(double)NAN, (double)NAN},
                                      .spacing = (double)NAN};
    request.paths = memory_array(count, sizeof *request.paths, "the command line");
    request.conditions = memory_array(count, sizeof *request.conditions, "the command line");
    bool done = read_command_line(argument_count, arguments, command, &request);
    if (done && request.out == NULL)
        done = tecview_complain("the picture's file is missing:", "--out");
    if (done)
        done = command == POINTS ? tecview_points(&request) : tecview_curve(&request);
    memory_free(request.paths);
    memory_free(request.conditions);
    return done;
}

int main(int argument_count, char **arguments)
{
    for (int i = 1; i < argument_count; ++i)
        if (strcmp(arguments[i], "--help") == 0 || strcmp(arguments[i], "-h") == 0) {
            usage(stdout);
            return fflush(stdout) == 0 ? DONE : TROUBLE;
        }
    for (int command = POINTS; argument_count > 1 && command <= CURVE; ++command)
        if (strcmp(arguments[1], command_names[command]) == 0)
            return run(argument_count, arguments, (enum command)command) ? DONE : TROUBLE;
    if (argument_count > 1)
        (void)tecview_complain("the first word must be points or curve, not", arguments[1]);
    usage(stderr);
    return TROUBLE;
}
