/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tecview_chart: see tecview_chart.h. */
#include "tecview_chart.h"
#include "base/memory.h"
#include "draw_axis.h"
#include "draw_font.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROOM = 300, MANY = 60 /* points of a series */ };

static const double text_size = 14.0;
static const double line_height = 21.0; /* of the legend */
static const double sample_width = 30.0;
static const double mark_radius = 4.0;
static const double clear = 11.0; /* between legend and curves */

struct drawing {
    const struct tecview_chart *chart;
    struct draw_page *page;
    struct draw_box area; /* inside the frame */
    struct draw_axis axes[2];
};

static struct draw_text style_of(enum draw_anchor anchor)
{
    return (struct draw_text){.colour = draw_colour_black, .size = text_size, .anchor = anchor};
}

/* ---- scales ---- */

static void find_range(const struct tecview_chart *chart, int axis, double *low, double *high)
{
    *low = HUGE_VAL;
    *high = -HUGE_VAL;
    for (size_t s = 0; s < chart->series_count; ++s)
        for (size_t i = 0; i < chart->series[s].count; ++i) {
            *low = fmin(*low, chart->series[s].points[i][axis]);
            *high = fmax(*high, chart->series[s].points[i][axis]);
        }
}

/* Lines begin and end at the frame; marks stay away from it. */
static void open_axis(struct drawing *drawing, int axis)
{
    const struct tecview_chart *chart = drawing->chart;
    const struct draw_box *area = &drawing->area;
    const bool logarithmic = chart->logarithmic[axis];
    const bool given = !isnan(chart->ranges[axis][0]);
    const double length = axis == 0 ? area->right - area->left : area->bottom - area->top;
    const int wanted = (int)fmax(2.0, length / (axis == 0 ? 95.0 : 62.0));
    double low = chart->ranges[axis][0];
    double high = chart->ranges[axis][1];
    if (!given) {
        find_range(chart, axis, &low, &high);
        draw_axis_spread(&low, &high, logarithmic);
        const double margin = axis == 1 || chart->marks ? 0.05 : 0.0;
        const double factor = logarithmic ? pow(high / low, margin) : 1.0;
        const double step = logarithmic ? 0.0 : margin * (high - low);
        const bool near_zero = !logarithmic && low >= 0.0 && low < 0.1 * high;
        low = near_zero ? 0.0 : (low - step) / factor;
        high = (high + step) * factor;
    }
    draw_axis_open(&drawing->axes[axis], low, high, logarithmic, wanted, false);
}

static void place(const struct drawing *drawing, const double point[2], double result[2])
{
    const struct draw_box *area = &drawing->area;
    result[0] =
        area->left + draw_axis_part(&drawing->axes[0], point[0]) * (area->right - area->left);
    result[1] =
        area->bottom - draw_axis_part(&drawing->axes[1], point[1]) * (area->bottom - area->top);
}

static double widest_label(const struct draw_axis *axis)
{
    double widest = 0.0;
    for (int i = 0; i < axis->tick_count; ++i)
        widest = fmax(widest, draw_font_width(axis->labels[i]) * text_size);
    return widest;
}

/* Lines, ticks and numbers of a scale. */
static void draw_scale(const struct drawing *drawing, int axis)
{
    const struct draw_axis *scale = &drawing->axes[axis];
    const struct draw_box *area = &drawing->area;
    const struct draw_pen pale = {draw_colour_pale, 1.0, 0.0};
    const struct draw_pen grey = {draw_colour_grey, 1.0, 0.0};
    for (int i = 0; i < scale->tick_count; ++i) {
        const bool major = scale->labels[i][0] != '\0';
        const double tick = major ? 6.0 : 3.0;
        const double part = draw_axis_part(scale, scale->ticks[i]);
        const double x = area->left + part * (area->right - area->left);
        const double y = area->bottom - part * (area->bottom - area->top);
        if (axis == 0) {
            const struct draw_text style = style_of(DRAW_MIDDLE);
            if (major)
                draw_page_line(drawing->page, x, area->top, x, area->bottom, &pale);
            draw_page_line(drawing->page, x, area->bottom, x, area->bottom + tick, &grey);
            draw_page_text(drawing->page, x, area->bottom + 22.0, scale->labels[i], &style);
        } else {
            const struct draw_text style = style_of(DRAW_END);
            if (major)
                draw_page_line(drawing->page, area->left, y, area->right, y, &pale);
            draw_page_line(drawing->page, area->left - tick, y, area->left, y, &grey);
            draw_page_text(drawing->page, area->left - 10.0, y + 5.0, scale->labels[i], &style);
        }
    }
}

static void draw_titles(const struct drawing *drawing)
{
    const struct tecview_chart *chart = drawing->chart;
    const struct draw_box *area = &drawing->area;
    struct draw_text style = style_of(DRAW_MIDDLE);
    char title[ROOM];
    style.size = 15.0;
    draw_axis_title(&drawing->axes[0], chart->names[0], chart->units[0], title, sizeof title);
    draw_page_text(drawing->page, 0.5 * (area->left + area->right), area->bottom + 46.0, title,
                   &style);
    style.upwards = true;
    draw_axis_title(&drawing->axes[1], chart->names[1], chart->units[1], title, sizeof title);
    draw_page_text(drawing->page, area->left - widest_label(&drawing->axes[1]) - 24.0,
                   0.5 * (area->top + area->bottom), title, &style);
    style = style_of(DRAW_START);
    style.size = 18.0;
    style.bold = true;
    const double width = draw_font_width(chart->title) * style.size;
    style.size *= fmin(1.0, (drawing->page->width - 40.0) / fmax(width, 1.0));
    draw_page_text(drawing->page, 20.0, 30.0, chart->title, &style);
    style = style_of(DRAW_END);
    style.colour = draw_colour_grey;
    style.size = 12.0;
    draw_page_text(drawing->page, drawing->page->width - 20.0, drawing->page->height - 8.0,
                   chart->note, &style);
}

/* ---- series ---- */

static enum draw_shape shape_of(size_t number)
{
    return (enum draw_shape)(number % DRAW_SHAPE_COUNT);
}

static struct draw_pen pen_of(size_t number)
{
    return (struct draw_pen){draw_colour_series(number), 1.8,
                             number < DRAW_SERIES_COLOURS ? 0.0 : 6.0};
}

/* The places of a series on the page; to be freed. */
static double (*places_of(const struct drawing *drawing, const struct tecview_series *series))[2]
{
    double(*places)[2] = memory_array(series->count, sizeof *places, "a curve");
    for (size_t i = 0; i < series->count; ++i)
        place(drawing, series->points[i], places[i]);
    return places;
}

static void draw_line(const struct drawing *drawing, size_t number)
{
    const struct tecview_series *series = &drawing->chart->series[number];
    const struct draw_pen pen = pen_of(number);
    double(*places)[2] = places_of(drawing, series);
    draw_page_curve(drawing->page, (const double(*)[2])places, series->count, &pen);
    memory_free(places);
}

static bool is_inside(const struct drawing *drawing, const double point[2])
{
    const struct draw_box *area = &drawing->area;
    return point[0] > area->left - 0.5 && point[0] < area->right + 0.5 &&
           point[1] > area->top - 0.5 && point[1] < area->bottom + 0.5;
}

/* Marks at the frame are drawn whole; of many along a line only those that can be told apart. */
static void draw_marks(const struct drawing *drawing, size_t number)
{
    const struct tecview_series *series = &drawing->chart->series[number];
    const bool thinned = drawing->chart->lines && series->count > MANY;
    const double *last = NULL;
    double(*places)[2] = places_of(drawing, series);
    for (size_t i = 0; i < series->count; ++i) {
        const double distance =
            last != NULL ? hypot(places[i][0] - last[0], places[i][1] - last[1]) : HUGE_VAL;
        if (!is_inside(drawing, places[i]) || (thinned && distance < 5.0 * mark_radius))
            continue;
        draw_page_mark(drawing->page, shape_of(number), places[i], mark_radius,
                       draw_colour_series(number));
        last = places[i];
    }
    memory_free(places);
}

/* ---- Pareto front ---- */

static int by_x_then_y(const void *one, const void *other)
{
    const double *a = one;
    const double *b = other;
    for (int i = 0; i < 2; ++i)
        if (a[i] != b[i])
            return a[i] < b[i] ? -1 : 1;
    return 0;
}

size_t tecview_chart_front(double (*points)[2], size_t count)
{
    size_t on_front = 0;
    if (count == 0)
        return 0;
    qsort(points, count, sizeof *points, by_x_then_y);
    for (size_t i = 0; i < count; ++i)
        if (on_front == 0 || points[i][1] < points[on_front - 1][1]) {
            const double point[2] = {points[i][0], points[i][1]};
            memmove(points[on_front + 1], points[on_front], (i - on_front) * sizeof *points);
            memcpy(points[on_front++], point, sizeof point);
        }
    return on_front;
}

static const struct draw_pen *front_pen(void)
{
    static const struct draw_pen pen = {{25, 25, 30}, 1.5, 5.0};
    return &pen;
}

/* A dark ring, drawn below the mark. */
static void draw_ring(struct draw_page *page, const double centre[2])
{
    draw_page_mark(page, DRAW_DISC, centre, mark_radius + 4.0, draw_colour_black);
    draw_page_mark(page, DRAW_DISC, centre, mark_radius + 2.7, draw_colour_white);
}

static void draw_front(const struct drawing *drawing)
{
    const struct tecview_chart *chart = drawing->chart;
    size_t count = 0;
    for (size_t s = 0; s < chart->series_count; ++s)
        count += chart->series[s].count;
    double(*points)[2] = memory_array(count, sizeof *points, "the front");
    count = 0;
    for (size_t s = 0; s < chart->series_count; ++s) {
        if (chart->series[s].count > 0)
            memcpy(points[count], chart->series[s].points, chart->series[s].count * sizeof *points);
        count += chart->series[s].count;
    }
    count = tecview_chart_front(points, count);
    for (size_t i = 0; i < count; ++i) {
        const double point[2] = {points[i][0], points[i][1]};
        place(drawing, point, points[i]);
    }
    draw_page_clip(drawing->page, &drawing->area);
    draw_page_curve(drawing->page, (const double(*)[2])points, count, front_pen());
    draw_page_clip(drawing->page, NULL);
    for (size_t i = 0; i < count; ++i)
        if (is_inside(drawing, points[i]))
            draw_ring(drawing->page, points[i]);
    memory_free(points);
}

/* ---- legend ---- */

static void legend_size(const struct tecview_chart *chart, double *width, double *height)
{
    double widest = chart->pareto ? draw_font_width("Pareto front") : 0.0;
    for (size_t s = 0; s < chart->series_count; ++s)
        widest = fmax(widest, draw_font_width(chart->series[s].name));
    *width = widest * text_size + sample_width + 32.0;
    *height = ((double)chart->series_count + (chart->pareto ? 1.0 : 0.0)) * line_height + 8.0;
}

/* How much of the series a box hides: points in it and, of lines, places between points. */
static size_t hidden_by(const struct drawing *drawing, const struct draw_box *box)
{
    enum { BETWEEN = 8 };
    size_t hidden = 0;
    for (size_t s = 0; s < drawing->chart->series_count; ++s) {
        const struct tecview_series *series = &drawing->chart->series[s];
        double last[2] = {0.0, 0.0};
        for (size_t i = 0; i < series->count; ++i) {
            double here[2];
            place(drawing, series->points[i], here);
            for (int k = 1; k <= BETWEEN; ++k) {
                const double part = i > 0 && drawing->chart->lines ? (double)k / BETWEEN : 1.0;
                const double x = last[0] + part * (here[0] - last[0]);
                const double y = last[1] + part * (here[1] - last[1]);
                hidden += x > box->left - clear && x < box->right + clear && y > box->top - clear &&
                          y < box->bottom + clear;
            }
            memcpy(last, here, sizeof last);
        }
    }
    return hidden;
}

/* A corner of the area where the legend hides nothing; false when there is none. */
static bool find_corner(const struct drawing *drawing, struct draw_box *box)
{
    const struct draw_box *area = &drawing->area;
    double width, height;
    legend_size(drawing->chart, &width, &height);
    for (int corner = 0; corner < 4; ++corner) {
        const double left = corner % 2 == 0 ? area->right - width - 10.0 : area->left + 10.0;
        const double top = corner < 2 ? area->top + 10.0 : area->bottom - height - 10.0;
        *box = (struct draw_box){left, top, left + width, top + height};
        if (box->left > area->left && box->bottom < area->bottom && box->top > area->top &&
            hidden_by(drawing, box) == 0)
            return true;
    }
    return false;
}

static void draw_legend(const struct drawing *drawing, const struct draw_box *box)
{
    const struct tecview_chart *chart = drawing->chart;
    const struct draw_pen frame = {draw_colour_pale, 1.0, 0.0};
    const struct draw_text style = style_of(DRAW_START);
    draw_page_fill(drawing->page, box, draw_colour_white, 0.9);
    draw_page_frame(drawing->page, box, &frame);
    for (size_t s = 0; s <= chart->series_count; ++s) {
        const bool front = s == chart->series_count;
        const struct draw_pen pen = front ? *front_pen() : pen_of(s);
        const double y = box->top + 4.0 + ((double)s + 0.5) * line_height;
        const double left = box->left + 8.0;
        const double centre[2] = {left + 0.5 * sample_width, y};
        if (front && !chart->pareto)
            break;
        if (front || chart->lines)
            draw_page_line(drawing->page, left, y, left + sample_width, y, &pen);
        if (front)
            draw_ring(drawing->page, centre);
        else if (chart->marks)
            draw_page_mark(drawing->page, shape_of(s), centre, mark_radius, pen.colour);
        draw_page_text(drawing->page, left + sample_width + 8.0, y + 5.0,
                       front ? "Pareto front" : chart->series[s].name, &style);
    }
}

/* ---- the chart ---- */

/* The frame leaves room for the scales' numbers, which depend on the frame. */
static void lay_out(struct drawing *drawing, double right)
{
    const struct tecview_chart *chart = drawing->chart;
    drawing->area = (struct draw_box){80.0, *chart->title != '\0' ? 48.0 : 20.0, right,
                                      drawing->page->height - 68.0};
    open_axis(drawing, 1);
    drawing->area.left = floor(widest_label(&drawing->axes[1]) + 48.0);
    open_axis(drawing, 0);
}

void tecview_chart_draw(const struct tecview_chart *chart, struct draw_page *page)
{
    struct drawing drawing = {.chart = chart, .page = page};
    struct draw_box legend = {0};
    const struct draw_pen frame = {draw_colour_grey, 1.2, 0.0};
    const double right = page->width - 28.0;
    lay_out(&drawing, right);
    if (chart->legend && !find_corner(&drawing, &legend)) { /* beside the frame then */
        double width, height;
        legend_size(chart, &width, &height);
        width = fmin(width, 0.5 * page->width);
        lay_out(&drawing, right - width - 4.0);
        legend = (struct draw_box){drawing.area.right + 14.0, drawing.area.top,
                                   drawing.area.right + 14.0 + width, drawing.area.top + height};
    }
    draw_scale(&drawing, 0);
    draw_scale(&drawing, 1);
    draw_titles(&drawing);
    draw_page_frame(page, &drawing.area, &frame);
    draw_page_clip(page, &drawing.area);
    for (size_t s = 0; chart->lines && s < chart->series_count; ++s)
        draw_line(&drawing, s);
    draw_page_clip(page, NULL);
    if (chart->pareto)
        draw_front(&drawing);
    for (size_t s = 0; s < chart->series_count; ++s)
        if (chart->marks || chart->series[s].count == 1)
            draw_marks(&drawing, s);
    if (chart->legend)
        draw_legend(&drawing, &legend);
}
