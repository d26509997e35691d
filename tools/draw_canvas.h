/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * draw_canvas: a picture of points in memory, with smooth lines.
 *
 * Lengths are in points; (0, 0) is the upper left corner, y downwards, and the centre of the first
 * point is (0.5, 0.5). Lines and shapes are marked first, each point keeping the largest cover, and
 * then painted at once, so that the joints of a line are no darker than the line.
 */
#ifndef TOOLS_DRAW_CANVAS_H
#define TOOLS_DRAW_CANVAS_H

#include "draw_colour.h"

#include <stddef.h>

struct draw_box {
    double left, top, right, bottom;
};

struct draw_canvas {
    int width, height;
    struct draw_colour *points;                       /* rows from the top */
    unsigned char *cover;                             /* 0..255 of what is marked */
    int first_column, end_column, first_row, end_row; /* where something is marked */
    struct draw_box clip;                             /* nothing is painted outside */
};

/* A white canvas. */
void draw_canvas_open(struct draw_canvas *canvas, int width, int height);
void draw_canvas_close(struct draw_canvas *canvas);

/* Sets what is painted from now on; NULL for the whole canvas. */
void draw_canvas_clip(struct draw_canvas *canvas, const struct draw_box *box);

/* Marks a line with round ends; from == to gives a disc of diameter `thickness`. */
void draw_canvas_mark_line(struct draw_canvas *canvas, const double from[2], const double to[2],
                           double thickness);

/* Marks the inside of a convex polygon, corners in any sense of rotation. */
void draw_canvas_mark_polygon(struct draw_canvas *canvas, const double (*corners)[2], size_t count);

/* Paints what is marked and forgets it. */
void draw_canvas_paint(struct draw_canvas *canvas, struct draw_colour colour, double opacity);

#endif
