/* SPDX-License-Identifier: GPL-3.0-or-later */
/* draw_canvas: see draw_canvas.h. */
#include "draw_canvas.h"
#include "base/memory.h"

#include <math.h>

void draw_canvas_open(struct draw_canvas *canvas, int width, int height)
{
    const size_t count = (size_t)width * (size_t)height;
    *canvas = (struct draw_canvas){.width = width, .height = height};
    canvas->points = memory_array(count, sizeof *canvas->points, "the picture");
    canvas->cover = memory_array(count, 1, "the picture");
    for (size_t i = 0; i < count; ++i)
        canvas->points[i] = draw_colour_white;
    canvas->first_column = width;
    canvas->first_row = height;
    draw_canvas_clip(canvas, NULL);
}

void draw_canvas_close(struct draw_canvas *canvas)
{
    memory_free(canvas->points);
    memory_free(canvas->cover);
}

void draw_canvas_clip(struct draw_canvas *canvas, const struct draw_box *box)
{
    canvas->clip = box != NULL ? *box : (struct draw_box){0.0, 0.0, canvas->width, canvas->height};
}

static int at_least(int value, int limit)
{
    return value < limit ? limit : value;
}

static int at_most(int value, int limit)
{
    return value > limit ? limit : value;
}

/* A coordinate as the number of a point, 0..limit, also when it is far away. */
static int point_number(double coordinate, int limit)
{
    return (int)fmin(fmax(floor(coordinate), 0.0), (double)limit);
}

/* The points of the canvas that a shape can touch; they are remembered as marked. */
struct region {
    int first_column, end_column, first_row, end_row;
};

static struct region touch(struct draw_canvas *canvas, struct draw_box box)
{
    const struct region region = {point_number(box.left - 1.0, canvas->width),
                                  point_number(box.right + 2.0, canvas->width),
                                  point_number(box.top - 1.0, canvas->height),
                                  point_number(box.bottom + 2.0, canvas->height)};
    canvas->first_column = at_most(canvas->first_column, region.first_column);
    canvas->end_column = at_least(canvas->end_column, region.end_column);
    canvas->first_row = at_most(canvas->first_row, region.first_row);
    canvas->end_row = at_least(canvas->end_row, region.end_row);
    return region;
}

/* A shape whose edge is `inside` points further out covers this part of the point. */
static void cover_point(struct draw_canvas *canvas, int column, int row, double inside)
{
    const double part = fmin(fmax(inside + 0.5, 0.0), 1.0);
    unsigned char *cover = &canvas->cover[(size_t)row * (size_t)canvas->width + (size_t)column];
    const unsigned char value = (unsigned char)(255.0 * part + 0.5);
    if (value > *cover)
        *cover = value;
}

/* The distance of a point from a line between two points. */
static double distance_from(double x, double y, const double from[2], const double along[2],
                            double squared_length)
{
    const double dx = x - from[0];
    const double dy = y - from[1];
    double part = 0.0;
    if (squared_length > 0.0)
        part = fmin(fmax((dx * along[0] + dy * along[1]) / squared_length, 0.0), 1.0);
    return hypot(dx - part * along[0], dy - part * along[1]);
}

void draw_canvas_mark_line(struct draw_canvas *canvas, const double from[2], const double to[2],
                           double thickness)
{
    const double radius = 0.5 * thickness;
    const double along[2] = {to[0] - from[0], to[1] - from[1]};
    const double squared_length = along[0] * along[0] + along[1] * along[1];
    const struct region region = touch(
        canvas, (struct draw_box){fmin(from[0], to[0]) - radius, fmin(from[1], to[1]) - radius,
                                  fmax(from[0], to[0]) + radius, fmax(from[1], to[1]) + radius});
    for (int row = region.first_row; row < region.end_row; ++row)
        for (int column = region.first_column; column < region.end_column; ++column) {
            const double distance =
                distance_from(column + 0.5, row + 0.5, from, along, squared_length);
            if (distance < radius + 0.5)
                cover_point(canvas, column, row, radius - distance);
        }
}

/* How far inside the convex polygon a point is; negative outside. `sense` is the sign of its area.
 */
static double depth_in_polygon(double x, double y, const double (*corners)[2], size_t count,
                               double sense)
{
    double depth = HUGE_VAL;
    for (size_t i = 0; i < count; ++i) {
        const double *a = corners[i];
        const double *b = corners[(i + 1) % count];
        const double length = hypot(b[0] - a[0], b[1] - a[1]);
        if (length > 0.0)
            depth = fmin(depth, sense * ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) /
                                    length);
    }
    return depth;
}

void draw_canvas_mark_polygon(struct draw_canvas *canvas, const double (*corners)[2], size_t count)
{
    struct draw_box box = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    double area = 0.0;
    for (size_t i = 0; i < count; ++i) {
        const double *next = corners[(i + 1) % count];
        area += corners[i][0] * next[1] - corners[i][1] * next[0];
        box.left = fmin(box.left, corners[i][0]);
        box.right = fmax(box.right, corners[i][0]);
        box.top = fmin(box.top, corners[i][1]);
        box.bottom = fmax(box.bottom, corners[i][1]);
    }
    const struct region region = touch(canvas, box);
    for (int row = region.first_row; row < region.end_row; ++row)
        for (int column = region.first_column; column < region.end_column; ++column)
            cover_point(
                canvas, column, row,
                depth_in_polygon(column + 0.5, row + 0.5, corners, count, area < 0.0 ? -1.0 : 1.0));
}

void draw_canvas_paint(struct draw_canvas *canvas, struct draw_colour colour, double opacity)
{
    const struct draw_box clip = canvas->clip;
    for (int row = canvas->first_row; row < canvas->end_row; ++row)
        for (int column = canvas->first_column; column < canvas->end_column; ++column) {
            const size_t i = (size_t)row * (size_t)canvas->width + (size_t)column;
            if (canvas->cover[i] == 0)
                continue;
            if (column + 0.5 > clip.left && column + 0.5 < clip.right && row + 0.5 > clip.top &&
                row + 0.5 < clip.bottom)
                canvas->points[i] = draw_colour_mixed(canvas->points[i], colour,
                                                      opacity * canvas->cover[i] / 255.0);
            canvas->cover[i] = 0;
        }
    canvas->first_column = canvas->width;
    canvas->end_column = 0;
    canvas->first_row = canvas->height;
    canvas->end_row = 0;
}
