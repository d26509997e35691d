/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tecview_figure: what a picture of points is made of, and its text. */
#ifndef TOOLS_TECVIEW_FIGURE_H
#define TOOLS_TECVIEW_FIGURE_H

#include "draw_axis.h"
#include "tecview_cloud.h"

enum { TECVIEW_ROOM = 400 /* characters of a line of text */ };

struct tecview_section {
    bool wanted;
    int axis;
    double place;
};

struct tecview_figure {
    const struct tecview_request *request;
    const struct tecplot_file *file;
    const struct tecplot_zone *zone;
    struct tecview_cloud cloud;
    struct tecview_section section;
    double direction[3]; /* from which the body is seen */
    struct draw_map map;
    struct draw_axis scale; /* of the colours */
    bool constant;          /* all values are the same */
    struct draw_page page;
    double unit; /* points of the screen per point of the usual size */
};

/* Black text of a size, which grows with the picture, but stays readable. */
struct draw_text tecview_figure_style(const struct tecview_figure *figure, double size,
                                      enum draw_anchor anchor);

/* Writes text, smaller when it is wider than `room`. */
void tecview_figure_write(struct tecview_figure *figure, double x, double y, const char *text,
                          struct draw_text style, double room);

/* The text, or the other one when it is NULL. */
const char *tecview_figure_or(const char *text, const char *otherwise);

/* The colour of a value. */
struct draw_colour tecview_figure_colour(const struct tecview_figure *figure, double value);

#endif
