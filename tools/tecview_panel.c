/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tecview_panel: see tecview_panel.h. */
#include "tecview_panel.h"
#include "base/memory.h"
#include "draw_boxes.h"
#include "draw_font.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double outline_step = 1.7; /* spacings, of the surface's depth */

/* A section takes points up to this many half sizes away, so that a plane along the surface of a
 * body or between two of its layers meets them, also when they have moved a little. */
static const double section_reach = 1.5;

/* Gaps of a section that are narrower than this many spacings are closed: they come from sheared
 * rows of points, whose boxes don't touch. */
static const double widest_gap = 0.6;

/* The points that a panel shows. */
struct points {
    size_t count;
    double (*places)[3];
    double (*halves)[3];
    double *values;
};

/* The largest scale (points of the screen per length) that fits limits into width x height. */
static double fitting_scale(const double across[2], const double upwards[2], double width,
                            double height)
{
    const double scale = fmin(width / (across[1] - across[0]), height / (upwards[1] - upwards[0]));
    return 0.97 * fmax(scale, 1e-300);
}

static void draw_points(struct tecview_figure *figure, const struct points *points,
                        const struct draw_view *view, const struct draw_box *area,
                        const double middle[2], double scale, bool plain)
{
    struct draw_boxes boxes;
    draw_boxes_open(&boxes, view, (int)(area->right - area->left), (int)(area->bottom - area->top),
                    middle, scale);
    boxes.plain = plain;
    for (size_t i = 0; i < points->count; ++i)
        draw_boxes_add(&boxes, (const double *)points->places[i], (const double *)points->halves[i],
                       tecview_figure_colour(figure, points->values[i]));
    if (plain)
        draw_boxes_fill_gaps(&boxes, widest_gap * figure->cloud.spacing);
    else
        draw_boxes_outline(&boxes, outline_step * figure->cloud.spacing);
    draw_boxes_onto(&boxes, &figure->page.canvas, (int)area->left, (int)area->top);
    draw_boxes_close(&boxes);
}

/* Arrows along x, y and z at the lower left of the area; those that point at the eye are left out.
 */
static void draw_triad(struct tecview_figure *figure, const struct draw_view *view,
                       const struct draw_box *area)
{
    static const char *const names[3] = {"X", "Y", "Z"};
    const double unit = figure->unit;
    const double length = 34.0 * unit;
    const double x = area->left + 48.0 * unit;
    const double y = area->bottom - 42.0 * unit;
    const struct draw_pen pen = {draw_colour_grey, 1.8 * unit, 0.0};
    for (int axis = 0; axis < 3; ++axis) {
        const double right = view->right[axis];
        const double up = view->up[axis];
        const double size = hypot(right, up);
        if (size < 0.1)
            continue;
        const double tip_x = x + length * right;
        const double tip_y = y - length * up;
        draw_page_line(&figure->page, x, y, tip_x, tip_y, &pen);
        for (int side = -1; side <= 1; side += 2) {
            const double back = 6.0 * unit;
            const double a = right / size, b = -up / size;
            draw_page_line(&figure->page, tip_x, tip_y, tip_x - back * a - side * 0.45 * back * b,
                           tip_y - back * b + side * 0.45 * back * a, &pen);
        }
        tecview_figure_write(figure, tip_x + 10.0 * unit * right / size,
                             tip_y - 10.0 * unit * up / size + 5.0 * unit, names[axis],
                             tecview_figure_style(figure, 14.0, DRAW_MIDDLE), HUGE_VAL);
    }
}

/* A ruler of round length at the lower right of the area. */
static void draw_ruler(struct tecview_figure *figure, const struct draw_box *area, double scale)
{
    const double unit = figure->unit;
    const double longest = 0.22 * (area->right - area->left) / scale;
    const double power = pow(10.0, floor(log10(longest)));
    const double length = power * (longest >= 5.0 * power   ? 5.0
                                   : longest >= 2.0 * power ? 2.0
                                                            : 1.0);
    const double y = area->bottom - 24.0 * unit;
    const double right = area->right - 12.0 * unit;
    const double left = right - length * scale;
    const struct draw_pen pen = {draw_colour_grey, 1.8 * unit, 0.0};
    char text[TECVIEW_ROOM];
    draw_page_line(&figure->page, left, y, right, y, &pen);
    draw_page_line(&figure->page, left, y - 4.0 * unit, left, y + 4.0 * unit, &pen);
    draw_page_line(&figure->page, right, y - 4.0 * unit, right, y + 4.0 * unit, &pen);
    (void)snprintf(text, sizeof text, "%g%s%.40s", length,
                   figure->request->length_unit != NULL ? " " : "",
                   tecview_figure_or(figure->request->length_unit, ""));
    tecview_figure_write(figure, 0.5 * (left + right), y + 18.0 * unit, text,
                         tecview_figure_style(figure, 14.0, DRAW_MIDDLE), HUGE_VAL);
}

static void view_of_body(const struct tecview_figure *figure, struct draw_view *view,
                         double across[2], double upwards[2])
{
    const struct tecview_cloud *cloud = &figure->cloud;
    const double(*places)[3] = (const double(*)[3])cloud->positions;
    const double(*halves)[3] = (const double(*)[3])cloud->halves;
    draw_view_from(figure->direction, view);
    draw_view_limits(view->right, places, halves, cloud->count, across);
    draw_view_limits(view->up, places, halves, cloud->count, upwards);
}

void tecview_panel_body(struct tecview_figure *figure, const struct draw_box *panel)
{
    struct draw_view view;
    double across[2], upwards[2];
    const struct tecview_cloud *cloud = &figure->cloud;
    const struct points points = {cloud->count, cloud->positions, cloud->halves, cloud->values};
    struct draw_box area = *panel;
    area.bottom -= 84.0 * figure->unit;
    view_of_body(figure, &view, across, upwards);
    const double scale =
        fitting_scale(across, upwards, area.right - area.left, area.bottom - area.top);
    const double middle[2] = {0.5 * (across[0] + across[1]), 0.5 * (upwards[0] + upwards[1])};
    draw_points(figure, &points, &view, &area, middle, scale, false);
    draw_triad(figure, &view, panel);
    draw_ruler(figure, panel, scale);
}

/* ---- section ---- */

/* The points at the plane; each is moved back by its distance from it, so that where boxes overlap
 * the nearest is seen. */
static void cut_points(const struct tecview_figure *figure, const struct draw_view *view,
                       struct points *points)
{
    const struct tecview_cloud *cloud = &figure->cloud;
    const int axis = figure->section.axis;
    points->places = memory_array(cloud->count, sizeof *points->places, "the section");
    points->halves = memory_array(cloud->count, sizeof *points->halves, "the section");
    points->values = memory_array(cloud->count, sizeof *points->values, "the section");
    for (size_t i = 0; i < cloud->count; ++i) {
        const double distance = fabs(cloud->positions[i][axis] - figure->section.place);
        if (distance > section_reach * cloud->halves[i][axis])
            continue;
        const size_t j = points->count++;
        memcpy(points->places[j], cloud->positions[i], sizeof points->places[j]);
        memcpy(points->halves[j], cloud->halves[i], sizeof points->halves[j]);
        points->places[j][axis] = view->toward[axis] > 0.0 ? -distance : distance;
        points->halves[j][axis] = 0.0;
        points->values[j] = cloud->values[i];
    }
}

static void close_points(struct points *points)
{
    memory_free(points->places);
    memory_free(points->halves);
    memory_free(points->values);
}

static void draw_ticks(struct tecview_figure *figure, const struct draw_box *area,
                       const double across[2], const double upwards[2], const char *names[2])
{
    const double unit = figure->unit;
    const struct draw_pen pen = {draw_colour_grey, 1.2 * unit, 0.0};
    struct draw_axis axis;
    char title[TECVIEW_ROOM];
    double widest = 0.0;
    draw_page_frame(&figure->page, area, &pen);
    draw_axis_open(&axis, across[0], across[1], false,
                   (int)fmax(2.0, (area->right - area->left) / (80.0 * unit)), false);
    for (int i = 0; i < axis.tick_count; ++i) {
        const double x =
            area->left + draw_axis_part(&axis, axis.ticks[i]) * (area->right - area->left);
        draw_page_line(&figure->page, x, area->bottom, x, area->bottom + 5.0 * unit, &pen);
        tecview_figure_write(figure, x, area->bottom + 21.0 * unit, axis.labels[i],
                             tecview_figure_style(figure, 14.0, DRAW_MIDDLE), HUGE_VAL);
    }
    draw_axis_title(&axis, names[0], figure->request->length_unit, title, sizeof title);
    tecview_figure_write(figure, 0.5 * (area->left + area->right), area->bottom + 43.0 * unit,
                         title, tecview_figure_style(figure, 15.0, DRAW_MIDDLE), HUGE_VAL);
    draw_axis_open(&axis, upwards[0], upwards[1], false,
                   (int)fmax(2.0, (area->bottom - area->top) / (60.0 * unit)), false);
    for (int i = 0; i < axis.tick_count; ++i) {
        const double y =
            area->bottom - draw_axis_part(&axis, axis.ticks[i]) * (area->bottom - area->top);
        const struct draw_text style = tecview_figure_style(figure, 14.0, DRAW_END);
        widest = fmax(widest, draw_font_width(axis.labels[i]) * style.size);
        draw_page_line(&figure->page, area->left - 5.0 * unit, y, area->left, y, &pen);
        tecview_figure_write(figure, area->left - 9.0 * unit, y + 5.0 * unit, axis.labels[i], style,
                             HUGE_VAL);
    }
    struct draw_text style = tecview_figure_style(figure, 15.0, DRAW_MIDDLE);
    style.upwards = true;
    draw_axis_title(&axis, names[1], figure->request->length_unit, title, sizeof title);
    tecview_figure_write(figure, area->left - widest - 20.0 * unit,
                         0.5 * (area->top + area->bottom), title, style, HUGE_VAL);
}

/* The view of the section and what it reaches, with a margin; false when it has no point. */
static bool view_of_section(const struct tecview_figure *figure, struct points *points,
                            struct draw_view *view, double across[2], double upwards[2])
{
    static const double faces[3][3] = {{1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, 1.0}};
    draw_view_from(faces[figure->section.axis], view);
    *points = (struct points){0};
    cut_points(figure, view, points);
    if (points->count == 0)
        return false;
    const double(*places)[3] = (const double(*)[3])points->places;
    const double(*halves)[3] = (const double(*)[3])points->halves;
    draw_view_limits(view->right, places, halves, points->count, across);
    draw_view_limits(view->up, places, halves, points->count, upwards);
    const double margin = 0.03 * fmax(across[1] - across[0], upwards[1] - upwards[0]);
    across[0] -= margin;
    across[1] += margin;
    upwards[0] -= margin;
    upwards[1] += margin;
    return true;
}

void tecview_panel_section(struct tecview_figure *figure, const struct draw_box *panel)
{
    static const char *const names[3][2] = {{"Y", "Z"}, {"X", "Z"}, {"X", "Y"}};
    struct points points;
    struct draw_view view;
    double across[2], upwards[2];
    const double unit = figure->unit;
    struct draw_box room = {panel->left + 80.0 * unit, panel->top + 30.0 * unit,
                            panel->right - 12.0 * unit, panel->bottom - 52.0 * unit};
    char text[TECVIEW_ROOM];
    if (view_of_section(figure, &points, &view, across, upwards)) {
        const double scale =
            fitting_scale(across, upwards, room.right - room.left, room.bottom - room.top);
        const double width = floor(scale * (across[1] - across[0]));
        const double height = floor(scale * (upwards[1] - upwards[0]));
        const double left = floor(0.5 * (room.left + room.right - width));
        const double top = floor(0.5 * (room.top + room.bottom - height));
        const struct draw_box area = {left, top, left + width, top + height};
        const double middle[2] = {0.5 * (across[0] + across[1]), 0.5 * (upwards[0] + upwards[1])};
        const char *axes[2] = {names[figure->section.axis][0], names[figure->section.axis][1]};
        draw_points(figure, &points, &view, &area, middle, scale, true);
        draw_ticks(figure, &area, across, upwards, axes);
        (void)snprintf(text, sizeof text, "section %c = %g, %zu point%s",
                       "xyz"[figure->section.axis], figure->section.place, points.count,
                       points.count == 1 ? "" : "s");
        tecview_figure_write(figure, 0.5 * (left + left + width), top - 10.0 * unit, text,
                             tecview_figure_style(figure, 15.0, DRAW_MIDDLE),
                             panel->right - panel->left);
    }
    close_points(&points);
}

/* Says where the body is when the section misses it. */
bool tecview_panel_check(const struct tecview_figure *figure)
{
    struct points points;
    struct draw_view view;
    double across[2], upwards[2], limits[2];
    const int axis = figure->section.axis;
    const bool found =
        !figure->section.wanted || view_of_section(figure, &points, &view, across, upwards);
    if (figure->section.wanted)
        close_points(&points);
    if (!found) {
        const double unit[3] = {axis == 0, axis == 1, axis == 2};
        draw_view_limits(unit, (const double(*)[3])figure->cloud.positions,
                         (const double(*)[3])figure->cloud.halves, figure->cloud.count, limits);
        fprintf(stderr,
                "tecview: error: no point in the section %c=%g: the points reach from %g to %g\n",
                "xyz"[axis], figure->section.place, limits[0], limits[1]);
    }
    return found;
}

/* Body and section side by side or one above the other, whichever shows both larger. */
void tecview_panel_both(struct tecview_figure *figure, const struct draw_box *area)
{
    struct draw_view view;
    struct points points;
    double across[2][2], upwards[2][2];
    view_of_body(figure, &view, across[0], upwards[0]);
    (void)view_of_section(figure, &points, &view, across[1], upwards[1]);
    close_points(&points);
    const double width = area->right - area->left;
    const double height = area->bottom - area->top;
    double wide = HUGE_VAL, high = HUGE_VAL;
    for (int i = 0; i < 2; ++i) {
        wide = fmin(wide, fitting_scale(across[i], upwards[i], width, 0.5 * height));
        high = fmin(high, fitting_scale(across[i], upwards[i], 0.5 * width, height));
    }
    const double shape[2] = {(across[0][1] - across[0][0]) / (upwards[0][1] - upwards[0][0]),
                             (across[1][1] - across[1][0]) / (upwards[1][1] - upwards[1][0])};
    struct draw_box first = *area;
    struct draw_box second = *area;
    if (high >= wide) {
        const double part = fmin(fmax(shape[0] / (shape[0] + shape[1]), 0.38), 0.62);
        first.right = floor(area->left + part * width);
        second.left = first.right;
    } else {
        first.bottom = floor(area->top + 0.5 * height);
        second.top = first.bottom;
    }
    tecview_panel_body(figure, &first);
    tecview_panel_section(figure, &second);
}
