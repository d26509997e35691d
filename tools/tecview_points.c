/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * tecview points: a picture of the particles of one zone: the body, a section, or both, with the
 * colours' scale, the axes and the smallest and largest value.
 */
#include "draw_font.h"
#include "tecplot_find.h"
#include "tecview_panel.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WIDTH = 1200, HEIGHT = 800 };

static const double smallest_unit = 0.6; /* so that the text of small pictures has room */

/* ---- what is asked for ---- */

static bool read_section(const char *text, struct tecview_section *section)
{
    if (text == NULL)
        return true;
    const char *axis = *text != '\0' ? strchr("xyzXYZ", *text) : NULL;
    *section = (struct tecview_section){.wanted = true};
    if (axis == NULL || text[1] != '=' ||
        tecplot_number(text + 2, strlen(text + 2), &section->place) != NULL ||
        !isfinite(section->place))
        return tecview_complain("--section must be like x=0, y=2.5 or z=-1, not", text);
    section->axis = (int)(axis - "xyzXYZ") % 3;
    return true;
}

static const struct {
    const char *name;
    double direction[3];
} directions[] = {
    {"iso", {0.85, -1.2, 0.85}}, {"front", {0.0, -1.0, 0.0}}, {"back", {0.0, 1.0, 0.0}},
    {"side", {1.0, 0.0, 0.0}},   {"left", {-1.0, 0.0, 0.0}},  {"top", {0.0, 0.0, 1.0}},
    {"below", {0.0, 0.0, -1.0}},
};

static bool read_numbers(const char *text, double numbers[3])
{
    for (int i = 0; i < 3; ++i) {
        const size_t length = strcspn(text, ",");
        if (tecplot_number(text, length, &numbers[i]) != NULL || !isfinite(numbers[i]) ||
            (text[length] == ',') != (i < 2))
            return false;
        text += length + 1;
    }
    return numbers[0] != 0.0 || numbers[1] != 0.0 || numbers[2] != 0.0;
}

static bool read_direction(const char *text, double direction[3])
{
    for (size_t i = 0; i < sizeof directions / sizeof *directions; ++i)
        if (strcmp(text, directions[i].name) == 0) {
            memcpy(direction, directions[i].direction, sizeof directions[i].direction);
            return true;
        }
    return read_numbers(text, direction) ||
           tecview_complain("--from must be iso, front, back, left, side, top, below or x,y,z, not",
                            text);
}

/* One layer of points is seen from straight above it, other bodies from a corner. */
static const char *usual_direction(const struct tecview_cloud *cloud)
{
    static const char *const above[3] = {"side", "front", "top"};
    for (int axis = 0; axis < 3; ++axis) {
        double low = HUGE_VAL;
        double high = -HUGE_VAL;
        for (size_t i = 0; i < cloud->count; ++i) {
            low = fmin(low, cloud->positions[i][axis]);
            high = fmax(high, cloud->positions[i][axis]);
        }
        if (high - low < 0.5 * cloud->spacing && cloud->count > 8)
            return above[axis];
    }
    return "iso";
}

static void open_scale(struct tecview_figure *figure)
{
    const struct tecview_cloud *cloud = &figure->cloud;
    double low = cloud->nan_count < cloud->count ? cloud->low : 0.0;
    double high = cloud->nan_count < cloud->count ? cloud->high : 0.0;
    if (!isnan(figure->request->range[0])) {
        low = figure->request->range[0];
        high = figure->request->range[1];
    }
    draw_axis_spread(&low, &high, false);
    figure->constant = !(cloud->high > cloud->low);
    draw_axis_open(&figure->scale, low, high, false, 6, false);
}

/* ---- the figure ---- */

/* The bar of colours with its numbers in the area's right; the area loses that part. */
static void draw_colour_bar(struct tecview_figure *figure, struct draw_box *area)
{
    const struct draw_axis *scale = &figure->scale;
    const double unit = figure->unit;
    const struct draw_text style = tecview_figure_style(figure, 15.0, DRAW_START);
    const struct draw_pen pen = {draw_colour_grey, 1.2 * unit, 0.0};
    char title[TECVIEW_ROOM];
    double widest = 0.0;
    for (int i = 0; i < scale->tick_count; ++i)
        widest = fmax(widest, draw_font_width(scale->labels[i]) * style.size);
    draw_axis_title(scale, tecview_figure_or(figure->request->label, figure->request->of),
                    figure->request->unit, title, sizeof title);
    const double bar = 22.0 * unit;
    const double title_width = fmin(draw_font_width(title) * style.size, 220.0 * unit);
    const double width = fmax(bar + 10.0 * unit + widest, title_width);
    const double left = floor(area->right - width);
    const double height = area->bottom - area->top;
    const struct draw_box box = {left, floor(area->top + 0.12 * height), floor(left + bar),
                                 floor(area->bottom - 0.12 * height)};
    for (double y = box.top; y < box.bottom; y += 1.0) {
        const struct draw_box line = {box.left, y, box.right, y + 1.0};
        const double part = (box.bottom - y - 0.5) / (box.bottom - box.top);
        draw_page_fill(&figure->page, &line, draw_colour_of(&figure->map, part), 1.0);
    }
    draw_page_frame(&figure->page, &box, &pen);
    for (int i = 0; i < scale->tick_count; ++i) {
        const double y =
            box.bottom - draw_axis_part(scale, scale->ticks[i]) * (box.bottom - box.top);
        draw_page_line(&figure->page, box.right, y, box.right + 5.0 * unit, y, &pen);
        tecview_figure_write(figure, box.right + 10.0 * unit, y + 5.0 * unit, scale->labels[i],
                             style, HUGE_VAL);
    }
    tecview_figure_write(figure, left, box.top - 14.0 * unit, title, style, width);
    area->right = left - 24.0 * unit;
}

static void draw_head(struct tecview_figure *figure, struct draw_box *area)
{
    const double unit = figure->unit;
    const struct tecview_cloud *cloud = &figure->cloud;
    char text[TECVIEW_ROOM];
    char time[60] = "";
    char deformed[60] = "";
    const char *file_title =
        *figure->file->title != '\0' ? figure->file->title : figure->request->paths[0];
    const char *title = tecview_figure_or(figure->request->title, file_title);
    struct draw_text style = tecview_figure_style(figure, 23.0, DRAW_START);
    style.bold = true;
    tecview_figure_write(figure, area->left, area->top + 20.0 * unit, title, style,
                         area->right - area->left);
    if (!isnan(figure->zone->solution_time))
        (void)snprintf(time, sizeof time, "time %.6g, ", figure->zone->solution_time);
    if (figure->request->deform[0] != NULL)
        (void)snprintf(deformed, sizeof deformed, ", displacements x %g", cloud->deform_scale);
    (void)snprintf(text, sizeof text, "%s%zu point%s%s", time, cloud->count,
                   cloud->count == 1 ? "" : "s", deformed);
    style = tecview_figure_style(figure, 15.0, DRAW_START);
    style.colour = draw_colour_grey;
    tecview_figure_write(figure, area->left, area->top + 46.0 * unit, text, style,
                         area->right - area->left);
    area->top += 60.0 * unit;
}

/* How many values lie outside the range of colours, in words; empty without any. */
static void say_outside(const struct tecview_figure *figure, char *text, size_t room)
{
    size_t below = 0;
    size_t above = 0;
    for (size_t i = 0; i < figure->cloud.count; ++i) {
        below += figure->cloud.values[i] < figure->scale.low;
        above += figure->cloud.values[i] > figure->scale.high;
    }
    text[0] = '\0';
    if (below + above > 0)
        (void)snprintf(text, room, "; %zu below and %zu above the range", below, above);
}

static void draw_caption(struct tecview_figure *figure, struct draw_box *area)
{
    const struct tecview_cloud *cloud = &figure->cloud;
    const char *name = tecview_figure_or(figure->request->label, figure->request->of);
    const char *unit = tecview_figure_or(figure->request->unit, "");
    const char *space = *unit != '\0' ? " " : "";
    const double *a = cloud->low_place;
    const double *b = cloud->high_place;
    char text[TECVIEW_ROOM];
    char outside[80];
    char without[60] = "";
    if (cloud->nan_count > 0)
        (void)snprintf(without, sizeof without, "; %zu without a value (grey)", cloud->nan_count);
    say_outside(figure, outside, sizeof outside);
    if (cloud->nan_count == cloud->count)
        (void)snprintf(text, sizeof text, "%.60s: no point has a value", name);
    else if (figure->constant)
        (void)snprintf(text, sizeof text, "%.60s: %.6g%s%.20s everywhere%s", name, cloud->low,
                       space, unit, without);
    else
        (void)snprintf(
            text, sizeof text,
            "%.60s: from %.5g%s%.20s at (%.4g, %.4g, %.4g) to %.5g%s%.20s at (%.4g, %.4g, "
            "%.4g)%s%s",
            name, cloud->low, space, unit, a[0], a[1], a[2], cloud->high, space, unit, b[0], b[1],
            b[2], without, outside);
    struct draw_text style = tecview_figure_style(figure, 15.0, DRAW_START);
    tecview_figure_write(figure, area->left, area->bottom - 4.0 * figure->unit, text, style,
                         area->right - area->left);
    area->bottom -= 30.0 * figure->unit;
}

static void draw_figure(struct tecview_figure *figure)
{
    const double margin = 26.0 * figure->unit;
    struct draw_box area = {margin, margin, figure->page.width - margin,
                            figure->page.height - margin};
    draw_head(figure, &area);
    draw_caption(figure, &area);
    draw_colour_bar(figure, &area);
    area =
        (struct draw_box){floor(area.left), floor(area.top), floor(area.right), floor(area.bottom)};
    if (figure->section.wanted && figure->request->both)
        tecview_panel_both(figure, &area);
    else if (figure->section.wanted)
        tecview_panel_section(figure, &area);
    else
        tecview_panel_body(figure, &area);
}

static bool make_figure(struct tecview_figure *figure)
{
    const struct tecview_request *request = figure->request;
    if (!tecplot_find_zone("tecview", figure->file, request->zone, &figure->zone) ||
        !tecview_cloud_open(request, figure->file, figure->zone, &figure->cloud))
        return false;
    bool done = read_direction(tecview_figure_or(request->from, usual_direction(&figure->cloud)),
                               figure->direction) &&
                tecview_panel_check(figure) &&
                tecview_open_page(request, WIDTH, HEIGHT, &figure->page);
    if (done) {
        figure->unit =
            fmax(fmin(figure->page.width / WIDTH, figure->page.height / HEIGHT), smallest_unit);
        draw_colour_fill_map(&figure->map);
        open_scale(figure);
        draw_figure(figure);
        done = tecview_write_page(request, &figure->page);
        draw_page_close(&figure->page);
    }
    tecview_cloud_close(&figure->cloud);
    return done;
}

bool tecview_points(const struct tecview_request *request)
{
    struct tecview_figure figure = {.request = request};
    struct tecplot_file file;
    struct tecplot_error error;
    if (request->of == NULL)
        return tecview_complain("the variable is missing:", "--of");
    if (request->path_count > 1)
        return tecview_complain("points takes one file; too many:", request->paths[1]);
    if (draw_page_backend(request->out) != &draw_raster)
        return tecview_complain("a picture of points is a .png file, not", request->out);
    if (request->both && request->section == NULL)
        return tecview_complain("--both needs", "--section");
    if (!read_section(request->section, &figure.section))
        return false;
    if (!tecplot_read(request->paths[0], &file, &error)) {
        tecplot_print_error(request->paths[0], &error);
        return false;
    }
    figure.file = &file;
    const bool done = make_figure(&figure);
    tecplot_free(&file);
    return done;
}
