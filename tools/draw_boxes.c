/* SPDX-License-Identifier: GPL-3.0-or-later */
/* draw_boxes: see draw_boxes.h. */
#include "draw_boxes.h"
#include "base/memory.h"

#include <math.h>

enum { FINE = 2 /* fine points per point and axis */ };

static const double edge_shade = 0.86;    /* of the lines between boxes */
static const double smallest_edged = 9.0; /* fine points; smaller faces have no such lines */
static const double outline_shade = 0.55;
static const double smallest_turn = 1e-6; /* faces turned less than this to the eye are not seen */

static void normalise(double vector[3])
{
    const double length = sqrt(draw_view_part(vector, vector));
    for (int i = 0; i < 3; ++i)
        vector[i] /= length;
}

static void cross(const double a[3], const double b[3], double result[3])
{
    for (int i = 0; i < 3; ++i)
        result[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

void draw_view_from(const double direction[3], struct draw_view *view)
{
    double upwards[3] = {0.0, 0.0, 1.0};
    for (int i = 0; i < 3; ++i)
        view->toward[i] = direction[i];
    normalise(view->toward);
    if (fabs(view->toward[2]) > 0.999) {
        upwards[1] = 1.0;
        upwards[2] = 0.0;
    }
    cross(upwards, view->toward, view->right);
    normalise(view->right);
    cross(view->toward, view->right, view->up);
}

double draw_view_part(const double axis[3], const double place[3])
{
    return axis[0] * place[0] + axis[1] * place[1] + axis[2] * place[2];
}

void draw_view_limits(const double axis[3], const double (*places)[3], const double (*halves)[3],
                      size_t count, double limits[2])
{
    limits[0] = HUGE_VAL;
    limits[1] = -HUGE_VAL;
    for (size_t i = 0; i < count; ++i) {
        const double middle = draw_view_part(axis, places[i]);
        const double half = fabs(axis[0]) * halves[i][0] + fabs(axis[1]) * halves[i][1] +
                            fabs(axis[2]) * halves[i][2];
        limits[0] = fmin(limits[0], middle - half);
        limits[1] = fmax(limits[1], middle + half);
    }
}

void draw_boxes_open(struct draw_boxes *boxes, const struct draw_view *view, int width, int height,
                     const double middle[2], double scale)
{
    const size_t count = (size_t)width * (size_t)height * FINE * FINE;
    *boxes = (struct draw_boxes){.view = *view,
                                 .middle = {middle[0], middle[1]},
                                 .scale = scale * FINE,
                                 .width = width * FINE,
                                 .height = height * FINE};
    boxes->depth = memory_array(count, sizeof *boxes->depth, "the picture");
    boxes->points = memory_array(count, sizeof *boxes->points, "the picture");
    for (size_t i = 0; i < count; ++i) {
        boxes->depth[i] = -HUGE_VALF;
        boxes->points[i] = draw_colour_white;
    }
}

void draw_boxes_close(struct draw_boxes *boxes)
{
    memory_free(boxes->depth);
    memory_free(boxes->points);
}

/* A face on the screen: middle, half edges, and how the depth changes along these. */
struct face {
    double middle[2];
    double edges[2][2];
    double depth, slopes[2];
    double limits[2]; /* part of a half edge from which on it is drawn as a line */
    struct draw_colour colour, edge_colour;
};

/* Narrows the columns low..high of a row to those where |value + slope * column| <= 1. */
static void narrow(double value, double slope, double *low, double *high)
{
    static const double slack = 1e-9; /* no gaps between faces that touch */
    if (fabs(slope) < 1e-12) {
        if (fabs(value) > 1.0 + slack)
            *high = *low - 1.0;
        return;
    }
    const double a = (-1.0 - slack - value) / slope;
    const double b = (1.0 + slack - value) / slope;
    *low = fmax(*low, fmin(a, b));
    *high = fmin(*high, fmax(a, b));
}

static void draw_point(struct draw_boxes *boxes, int column, int row, double depth,
                       struct draw_colour colour)
{
    const size_t i = (size_t)row * (size_t)boxes->width + (size_t)column;
    if (depth > boxes->depth[i]) {
        boxes->depth[i] = (float)depth;
        boxes->points[i] = colour;
    }
}

/* One row of a face. A place on it is middle + s * edge 0 + t * edge 1, both from -1 to 1. */
static void draw_row(struct draw_boxes *boxes, const struct face *face, int row, double determinant)
{
    const double(*edges)[2] = face->edges;
    const double y = row + 0.5 - face->middle[1];
    const double s_slope = edges[1][1] / determinant;
    const double t_slope = -edges[0][1] / determinant;
    const double s_first = (0.5 - face->middle[0]) * s_slope - y * edges[1][0] / determinant;
    const double t_first = (0.5 - face->middle[0]) * t_slope + y * edges[0][0] / determinant;
    double low = 0.0;
    double high = boxes->width - 1.0;
    narrow(s_first, s_slope, &low, &high);
    narrow(t_first, t_slope, &low, &high);
    if (low > high)
        return;
    for (int column = (int)ceil(low); column <= high; ++column) {
        const double s = s_first + column * s_slope;
        const double t = t_first + column * t_slope;
        const bool at_edge = fabs(s) > face->limits[0] || fabs(t) > face->limits[1];
        draw_point(boxes, column, row, face->depth + s * face->slopes[0] + t * face->slopes[1],
                   at_edge ? face->edge_colour : face->colour);
    }
}

static void draw_face(struct draw_boxes *boxes, const struct face *face)
{
    const double determinant =
        face->edges[0][0] * face->edges[1][1] - face->edges[1][0] * face->edges[0][1];
    const double height = fabs(face->edges[0][1]) + fabs(face->edges[1][1]);
    if (fabs(determinant) < 1e-12)
        return;
    const double first = fmax(ceil(face->middle[1] - height - 0.5), 0.0);
    const double last = fmin(floor(face->middle[1] + height - 0.5), boxes->height - 1.0);
    for (double row = first; row <= last; row += 1.0)
        draw_row(boxes, face, (int)row, determinant);
}

/* The part of the light that the visible face across an axis gets. */
static double light_on(const struct draw_view *view, int axis)
{
    static const double light[3] = {-0.25, 0.62, 0.74}; /* right, up, toward */
    const double part =
        light[0] * view->right[axis] + light[1] * view->up[axis] + light[2] * view->toward[axis];
    return view->toward[axis] < 0.0 ? -part : part;
}

/* How bright that face is: 1 for the brightest of a view. */
static double brightness(const struct draw_view *view, int axis)
{
    double brightest = light_on(view, axis);
    for (int i = 0; i < 3; ++i)
        if (fabs(view->toward[i]) > smallest_turn)
            brightest = fmax(brightest, light_on(view, i));
    return 1.0 - 0.42 * (brightest - light_on(view, axis));
}

/* The face of a box at the side (-1 or 1) of an axis. */
static struct face face_of(const struct draw_boxes *boxes, const double place[3],
                           const double half[3], int axis, double side)
{
    const struct draw_view *view = &boxes->view;
    struct face face;
    double middle[3] = {place[0], place[1], place[2]};
    middle[axis] += side * half[axis];
    face.middle[0] = 0.5 * boxes->width +
                     boxes->scale * (draw_view_part(view->right, middle) - boxes->middle[0]);
    face.middle[1] =
        0.5 * boxes->height - boxes->scale * (draw_view_part(view->up, middle) - boxes->middle[1]);
    face.depth = draw_view_part(view->toward, middle);
    for (int i = 0; i < 2; ++i) {
        const int other = (axis + 1 + i) % 3;
        face.edges[i][0] = boxes->scale * view->right[other] * half[other];
        face.edges[i][1] = -boxes->scale * view->up[other] * half[other];
        face.slopes[i] = view->toward[other] * half[other];
        const double length = hypot(face.edges[i][0], face.edges[i][1]);
        face.limits[i] = 2.0 * length >= smallest_edged ? 1.0 - 1.0 / length : 2.0;
    }
    return face;
}

void draw_boxes_add(struct draw_boxes *boxes, const double place[3], const double half[3],
                    struct draw_colour colour)
{
    for (int axis = 0; axis < 3; ++axis) {
        const double toward = boxes->view.toward[axis];
        if (fabs(toward) <= smallest_turn)
            continue;
        const double side = toward < 0.0 ? -1.0 : 1.0;
        struct face face = face_of(boxes, place, half, axis, side);
        face.colour =
            boxes->plain ? colour : draw_colour_shaded(colour, brightness(&boxes->view, axis));
        face.edge_colour = draw_colour_shaded(face.colour, edge_shade);
        draw_face(boxes, &face);
    }
}

void draw_boxes_outline(struct draw_boxes *boxes, double step)
{
    static const int neighbours[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    for (int row = 1; row + 1 < boxes->height; ++row)
        for (int column = 1; column + 1 < boxes->width; ++column) {
            const size_t i = (size_t)row * (size_t)boxes->width + (size_t)column;
            bool edge = false;
            for (int k = 0; k < 4 && boxes->depth[i] > -HUGE_VALF; ++k) {
                const size_t j = (size_t)(row + neighbours[k][1]) * (size_t)boxes->width +
                                 (size_t)(column + neighbours[k][0]);
                edge = edge || boxes->depth[i] - boxes->depth[j] > step;
            }
            if (edge)
                boxes->points[i] = draw_colour_shaded(boxes->points[i], outline_shade);
        }
}

/* Fills the gaps of a row or column of `count` points, `stride` apart, from both sides. */
static void fill_line(struct draw_boxes *boxes, size_t first, size_t stride, int count, int widest)
{
    int last = -1; /* the last point that shows a box */
    for (int i = 0; i < count; ++i) {
        if (boxes->depth[first + (size_t)i * stride] == -HUGE_VALF)
            continue;
        for (int j = last + 1; last >= 0 && i - last - 1 <= widest && j < i; ++j) {
            const size_t from = first + (size_t)(j - last < i - j ? last : i) * stride;
            boxes->points[first + (size_t)j * stride] = boxes->points[from];
            boxes->depth[first + (size_t)j * stride] = boxes->depth[from];
        }
        last = i;
    }
}

void draw_boxes_fill_gaps(struct draw_boxes *boxes, double width)
{
    const int widest = (int)fmin(width * boxes->scale, boxes->width + boxes->height);
    const size_t row_length = (size_t)boxes->width;
    for (int row = 0; row < boxes->height; ++row)
        fill_line(boxes, (size_t)row * row_length, 1, boxes->width, widest);
    for (int column = 0; column < boxes->width; ++column)
        fill_line(boxes, (size_t)column, row_length, boxes->height, widest);
}

void draw_boxes_onto(const struct draw_boxes *boxes, struct draw_canvas *canvas, int left, int top)
{
    for (int row = 0; row < boxes->height / FINE; ++row)
        for (int column = 0; column < boxes->width / FINE; ++column) {
            int red = 0, green = 0, blue = 0;
            const int x = left + column, y = top + row;
            if (x < 0 || y < 0 || x >= canvas->width || y >= canvas->height)
                continue;
            for (int k = 0; k < FINE * FINE; ++k) {
                const struct draw_colour *point =
                    &boxes->points[(size_t)(row * FINE + k / FINE) * (size_t)boxes->width +
                                   (size_t)(column * FINE + k % FINE)];
                red += point->red;
                green += point->green;
                blue += point->blue;
            }
            const int count = FINE * FINE;
            canvas->points[(size_t)y * (size_t)canvas->width + (size_t)x] =
                (struct draw_colour){(unsigned char)((red + count / 2) / count),
                                     (unsigned char)((green + count / 2) / count),
                                     (unsigned char)((blue + count / 2) / count)};
        }
}
