/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * draw_page: a page on which lines, shapes and text are drawn, for a PNG or an SVG file alike.
 *
 * Lengths are points of the screen; (0, 0) is the upper left corner, y downwards.
 */
#ifndef TOOLS_DRAW_PAGE_H
#define TOOLS_DRAW_PAGE_H

#include "draw_canvas.h"
#include "draw_deflate.h"

#include <stdbool.h>

enum draw_anchor { DRAW_START, DRAW_MIDDLE, DRAW_END };

enum draw_shape { DRAW_DISC, DRAW_SQUARE, DRAW_TRIANGLE, DRAW_DIAMOND, DRAW_SHAPE_COUNT };

struct draw_pen {
    struct draw_colour colour;
    double thickness;
    double dash; /* length of dashes and gaps, 0 for a full line */
};

struct draw_text {
    struct draw_colour colour;
    double size;             /* of a line of text */
    enum draw_anchor anchor; /* what of the text is at its place; the baseline in height */
    bool upwards;            /* turned, to be read from below to above */
    bool bold;
};

struct draw_page {
    const struct draw_backend *backend;
    double width, height;
    struct draw_canvas canvas; /* of a PNG file */
    struct draw_bytes text;    /* of an SVG file */
    int clip_count;            /* likewise: boxes so far */
    bool clipped;
};

/* What a kind of file does; draw_raster.c and draw_svg.c have one row each. */
struct draw_backend {
    const char *suffix;
    void (*open)(struct draw_page *page);
    void (*close)(struct draw_page *page);
    void (*line)(struct draw_page *page, const double (*points)[2], size_t count,
                 const struct draw_pen *pen);
    void (*polygon)(struct draw_page *page, const double (*corners)[2], size_t count,
                    struct draw_colour colour, double opacity);
    void (*disc)(struct draw_page *page, const double centre[2], double radius,
                 struct draw_colour colour);
    void (*text)(struct draw_page *page, double x, double y, const char *text,
                 const struct draw_text *style);
    void (*clip)(struct draw_page *page, const struct draw_box *box);
    void (*file)(struct draw_page *page, struct draw_bytes *file);
};

extern const struct draw_backend draw_raster, draw_svg;

/* The kind of file that a name ends in (.png, .svg), or NULL. */
const struct draw_backend *draw_page_backend(const char *path);

/* A white page. */
void draw_page_open(struct draw_page *page, const struct draw_backend *backend, int width,
                    int height);
void draw_page_close(struct draw_page *page);

/* Writes the file; false (and errno) when it cannot be written. */
bool draw_page_write(struct draw_page *page, const char *path);

void draw_page_line(struct draw_page *page, double x0, double y0, double x1, double y1,
                    const struct draw_pen *pen);

/* A line through `count` points, without those that nobody could tell from their neighbours. */
void draw_page_curve(struct draw_page *page, const double (*points)[2], size_t count,
                     const struct draw_pen *pen);

/* A filled box, and the outline of one. */
void draw_page_fill(struct draw_page *page, const struct draw_box *box, struct draw_colour colour,
                    double opacity);
void draw_page_frame(struct draw_page *page, const struct draw_box *box,
                     const struct draw_pen *pen);

/* A filled mark of a series, about 2 * radius high. */
void draw_page_mark(struct draw_page *page, enum draw_shape shape, const double centre[2],
                    double radius, struct draw_colour colour);

void draw_page_text(struct draw_page *page, double x, double y, const char *text,
                    const struct draw_text *style);

/* Nothing is drawn outside the box until the next call; NULL for the whole page. */
void draw_page_clip(struct draw_page *page, const struct draw_box *box);

#endif
