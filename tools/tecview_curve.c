/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * tecview curve: columns of Tecplot files or tables against another column, as lines or marks.
 *
 * A series is one variable of one file and, with --group, of one word of the group.
 */
#define _POSIX_C_SOURCE 200809L

#include "base/memory.h"
#include "tecplot_find.h"
#include "tecview.h"
#include "tecview_chart.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WIDTH = 900, HEIGHT = 560, MOST_SERIES = 64 };

struct plot {
    const struct tecview_request *request;
    struct tecview_chart chart;
    size_t series_capacity;
    size_t variable_count;     /* of --y */
    size_t not_a_number;       /* points left out */
    size_t not_above_zero;     /* likewise, on a logarithmic scale */
    char x_name[TECVIEW_NAME]; /* of the first file */
};

/* The number of pieces of a list with commas, and piece `number`; false when it has none such. */
static size_t list_length(const char *list)
{
    size_t count = 1;
    for (; *list != '\0'; ++list)
        count += *list == ',';
    return count;
}

static bool list_piece(const char *list, size_t number, char *piece, size_t room)
{
    for (; number > 0; --number) {
        list = strchr(list, ',');
        if (list == NULL)
            return false;
        ++list;
    }
    const size_t length = strcspn(list, ",");
    (void)snprintf(piece, room, "%.*s", (int)(length < room ? length : room - 1), list);
    return true;
}

/* The file's name without its folder. */
static const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL && slash[1] != '\0' ? slash + 1 : path;
}

static void add_word(char name[TECVIEW_NAME], const char *word)
{
    size_t length = strlen(name);
    if (length > 0 && length + 2 < TECVIEW_NAME) {
        memcpy(name + length, ", ", 3);
        length += 2;
    }
    for (; *word != '\0' && length + 1 < TECVIEW_NAME; ++word)
        name[length++] = *word;
    name[length] = '\0';
}

/* The series of that name, which is new when there is none; NULL (after a message) for too many. */
static struct tecview_series *series_called(struct plot *plot, const char *name)
{
    struct tecview_chart *chart = &plot->chart;
    for (size_t i = 0; i < chart->series_count; ++i)
        if (strcmp(chart->series[i].name, name) == 0)
            return &chart->series[i];
    if (chart->series_count == MOST_SERIES) {
        fprintf(stderr, "tecview: error: more than %d series\n", MOST_SERIES);
        return NULL;
    }
    chart->series = memory_grow(chart->series, &plot->series_capacity, chart->series_count + 1,
                                sizeof *chart->series, "the series");
    struct tecview_series *series = &chart->series[chart->series_count++];
    *series = (struct tecview_series){0};
    (void)snprintf(series->name, sizeof series->name, "%s", name);
    return series;
}

/* Adds a point unless it cannot be drawn. */
static void add_point(struct plot *plot, struct tecview_series *series, double x, double y)
{
    if (!isfinite(x) || !isfinite(y)) {
        ++plot->not_a_number;
        return;
    }
    if ((plot->chart.logarithmic[0] && x <= 0.0) || (plot->chart.logarithmic[1] && y <= 0.0)) {
        ++plot->not_above_zero;
        return;
    }
    series->points = memory_grow(series->points, &series->capacity, series->count + 1,
                                 sizeof *series->points, "a curve");
    series->points[series->count][0] = x;
    series->points[series->count++][1] = y;
}

/* What the rows of a file give: one variable against x. */
struct source {
    const struct tecplot_file *file;
    const struct tecplot_zone *zone;
    const char *path;
    size_t x, y, group;
};

static bool add_rows(struct plot *plot, const struct source *source, const char *variable)
{
    const struct tecview_request *request = plot->request;
    for (size_t i = 0; i < source->zone->row_count; ++i) {
        const double *row = &source->zone->values[i * source->file->variable_count];
        char name[TECVIEW_NAME] = "";
        if (plot->variable_count > 1 || (request->path_count == 1 && request->group == NULL))
            add_word(name, variable);
        if (request->group != NULL)
            add_word(name, source->file->labels[(size_t)row[source->group]]);
        if (request->path_count > 1)
            add_word(name, base_name(source->path));
        struct tecview_series *series = series_called(plot, name);
        if (series == NULL)
            return false;
        add_point(plot, series, row[source->x], row[source->y]);
    }
    return true;
}

static bool find_x(const struct plot *plot, const struct tecplot_file *file, size_t *column)
{
    *column = 0;
    return plot->request->x == NULL ||
           tecplot_find_column("tecview", file, plot->request->x, column);
}

static bool add_zone(struct plot *plot, struct source *source)
{
    const struct tecview_request *request = plot->request;
    if (!find_x(plot, source->file, &source->x) ||
        (request->group != NULL &&
         !tecplot_find_column("tecview", source->file, request->group, &source->group)))
        return false;
    if (plot->x_name[0] == '\0')
        (void)snprintf(plot->x_name, sizeof plot->x_name, "%s",
                       source->file->variable_names[source->x]);
    for (size_t i = 0; i < plot->variable_count; ++i) {
        char variable[TECVIEW_NAME];
        if (!list_piece(request->y, i, variable, sizeof variable) ||
            !tecplot_find_column("tecview", source->file, variable, &source->y) ||
            !add_rows(plot, source, variable))
            return false;
    }
    return true;
}

static bool add_file(struct plot *plot, const char *path)
{
    struct tecplot_file file;
    struct tecplot_error error;
    struct source source = {.file = &file, .path = path};
    if (!tecplot_read_table(path, plot->request->group, &file, &error)) {
        tecplot_print_error(path, &error);
        return false;
    }
    const bool done = tecplot_find_zone("tecview", &file, plot->request->zone, &source.zone) &&
                      add_zone(plot, &source);
    tecplot_free(&file);
    return done;
}

/* ---- what the request says about the chart ---- */

static bool read_log(const char *text, bool logarithmic[2])
{
    if (text == NULL)
        return true;
    for (const char *letter = text; *letter != '\0'; ++letter) {
        if (*letter != 'x' && *letter != 'y')
            return tecview_complain("--log must be x, y or xy, not", text);
        logarithmic[*letter - 'x'] = true;
    }
    return *text != '\0' || tecview_complain("--log must be x, y or xy, not", text);
}

static bool read_ranges(const struct tecview_request *request, struct tecview_chart *chart)
{
    for (int i = 0; i < 2; ++i) {
        chart->ranges[0][i] = request->x_range[i];
        chart->ranges[1][i] = request->range[i];
    }
    for (int axis = 0; axis < 2; ++axis)
        if (chart->logarithmic[axis] && chart->ranges[axis][0] <= 0.0)
            return tecview_complain("a logarithmic scale begins above 0, not in",
                                    axis == 0 ? "--xrange" : "--range");
    return true;
}

static bool open_plot(struct plot *plot)
{
    const struct tecview_request *request = plot->request;
    struct tecview_chart *chart = &plot->chart;
    plot->variable_count = list_length(request->y);
    if (request->pareto && plot->variable_count > 1)
        return tecview_complain("--pareto takes one variable, not", request->y);
    chart->title = request->title != NULL ? request->title : "";
    chart->lines = !request->pareto;
    chart->marks = request->marks || request->pareto;
    chart->pareto = request->pareto;
    for (size_t axis = 0; axis < 2 && request->unit != NULL; ++axis)
        (void)list_piece(request->unit, axis, chart->units[axis], sizeof chart->units[axis]);
    return read_log(request->log, chart->logarithmic) && read_ranges(request, chart);
}

static void write_note(struct plot *plot)
{
    char *note = plot->chart.note;
    const size_t room = sizeof plot->chart.note;
    if (plot->not_a_number > 0)
        (void)snprintf(note, room, "%zu point%s without a number left out", plot->not_a_number,
                       plot->not_a_number == 1 ? "" : "s");
    const size_t length = strlen(note);
    if (plot->not_above_zero > 0)
        (void)snprintf(note + length, room - length, "%s%zu point%s not above zero left out",
                       length > 0 ? ", " : "", plot->not_above_zero,
                       plot->not_above_zero == 1 ? "" : "s");
    if (*note != '\0')
        fprintf(stderr, "tecview: warning: %s\n", note);
}

static bool check_points(const struct plot *plot)
{
    size_t count = 0;
    for (size_t i = 0; i < plot->chart.series_count; ++i)
        count += plot->chart.series[i].count;
    return count > 0 || tecview_complain("no point to draw of", plot->request->y);
}

static bool draw_plot(struct plot *plot)
{
    const struct tecview_request *request = plot->request;
    struct tecview_chart *chart = &plot->chart;
    struct draw_page page;
    write_note(plot);
    if (!check_points(plot))
        return false;
    chart->names[0] = request->x_label != NULL ? request->x_label : plot->x_name;
    chart->names[1] = request->y_label != NULL    ? request->y_label
                      : plot->variable_count == 1 ? request->y
                                                  : "";
    for (size_t i = 0; request->legend != NULL && i < chart->series_count; ++i)
        (void)list_piece(request->legend, i, chart->series[i].name, sizeof chart->series[i].name);
    chart->legend = chart->series_count > 1 || request->legend != NULL || chart->pareto;
    if (!tecview_open_page(request, WIDTH, HEIGHT, &page))
        return false;
    tecview_chart_draw(chart, &page);
    const bool done = tecview_write_page(request, &page);
    draw_page_close(&page);
    return done;
}

bool tecview_curve(const struct tecview_request *request)
{
    struct plot plot = {.request = request};
    if (request->y == NULL)
        return tecview_complain("the variables are missing:", "--y");
    bool done = open_plot(&plot);
    for (size_t i = 0; done && i < request->path_count; ++i)
        done = add_file(&plot, request->paths[i]);
    done = done && draw_plot(&plot);
    for (size_t i = 0; i < plot.chart.series_count; ++i)
        memory_free(plot.chart.series[i].points);
    memory_free(plot.chart.series);
    return done;
}
