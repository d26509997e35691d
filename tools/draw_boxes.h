/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * draw_boxes: solid boxes along the axes, seen from a direction without perspective. Each point of
 * the picture shows the nearest box. It is drawn at twice the size and made smaller at the end.
 */
#ifndef TOOLS_DRAW_BOXES_H
#define TOOLS_DRAW_BOXES_H

#include "draw_canvas.h"

#include <stdbool.h>

/* Unit vectors of a view in space. */
struct draw_view {
    double right[3], up[3], toward[3]; /* toward the one who looks */
};

struct draw_boxes {
    struct draw_view view;
    double middle[2];  /* what is in the middle of the picture, along right and up */
    double scale;      /* fine points per length */
    int width, height; /* fine points */
    float *depth;      /* along toward; -infinity where nothing is */
    struct draw_colour *points;
    bool plain; /* without shades */
};

/* The view from a direction (any length > 0), with z upwards, or y when that is impossible. */
void draw_view_from(const double direction[3], struct draw_view *view);

/* The part of a place along a unit vector. */
double draw_view_part(const double axis[3], const double place[3]);

/* The outermost right (axis 0) or up (axis 1) that boxes reach: limits[0], limits[1]. */
void draw_view_limits(const double axis[3], const double (*places)[3], const double (*halves)[3],
                      size_t count, double limits[2]);

/* An empty picture of width x height points of the screen; `scale` is points per length. */
void draw_boxes_open(struct draw_boxes *boxes, const struct draw_view *view, int width, int height,
                     const double middle[2], double scale);
void draw_boxes_close(struct draw_boxes *boxes);

void draw_boxes_add(struct draw_boxes *boxes, const double place[3], const double half[3],
                    struct draw_colour colour);

/* Darkens the edges behind which it goes down by more than `step`. */
void draw_boxes_outline(struct draw_boxes *boxes, double step);

/* Fills gaps between boxes, along rows and columns, that are no wider than this length. */
void draw_boxes_fill_gaps(struct draw_boxes *boxes, double width);

/* Puts the picture on the canvas, its upper left corner at (left, top). */
void draw_boxes_onto(const struct draw_boxes *boxes, struct draw_canvas *canvas, int left, int top);

#endif
