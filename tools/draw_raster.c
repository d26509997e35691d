/* SPDX-License-Identifier: GPL-3.0-or-later */
/* draw_raster: a page as a picture of points, for PNG files (see draw_page.h). */
#include "draw_font.h"
#include "draw_page.h"
#include "draw_png.h"

#include <math.h>

static void open_canvas(struct draw_page *page)
{
    draw_canvas_open(&page->canvas, (int)page->width, (int)page->height);
}

static void close_canvas(struct draw_page *page)
{
    draw_canvas_close(&page->canvas);
}

/* Marks the dashes of one piece of a line; *walked is the length of the line before it. */
static void mark_dashes(struct draw_canvas *canvas, const double from[2], const double to[2],
                        const struct draw_pen *pen, double *walked)
{
    const double length = hypot(to[0] - from[0], to[1] - from[1]);
    const double period = 2.0 * pen->dash;
    double start = floor(*walked / period) * period - *walked;
    for (; start < length; start += period) {
        const double a = fmax(start, 0.0);
        const double b = fmin(start + pen->dash, length);
        if (b <= a)
            continue;
        const double begin[2] = {from[0] + a / length * (to[0] - from[0]),
                                 from[1] + a / length * (to[1] - from[1])};
        const double end[2] = {from[0] + b / length * (to[0] - from[0]),
                               from[1] + b / length * (to[1] - from[1])};
        draw_canvas_mark_line(canvas, begin, end, pen->thickness);
    }
    *walked += length;
}

static void draw_line(struct draw_page *page, const double (*points)[2], size_t count,
                      const struct draw_pen *pen)
{
    double walked = 0.0;
    for (size_t i = 0; i + 1 < count; ++i)
        if (pen->dash > 0.0)
            mark_dashes(&page->canvas, points[i], points[i + 1], pen, &walked);
        else
            draw_canvas_mark_line(&page->canvas, points[i], points[i + 1], pen->thickness);
    draw_canvas_paint(&page->canvas, pen->colour, 1.0);
}

static void draw_polygon(struct draw_page *page, const double (*corners)[2], size_t count,
                         struct draw_colour colour, double opacity)
{
    draw_canvas_mark_polygon(&page->canvas, corners, count);
    draw_canvas_paint(&page->canvas, colour, opacity);
}

static void draw_disc(struct draw_page *page, const double centre[2], double radius,
                      struct draw_colour colour)
{
    draw_canvas_mark_line(&page->canvas, centre, centre, 2.0 * radius);
    draw_canvas_paint(&page->canvas, colour, 1.0);
}

/* Where the pieces of a text go. */
struct placed_text {
    struct draw_canvas *canvas;
    double start[2];
    double along[2]; /* one length of size 1 in the direction of reading */
    double thickness;
};

static void mark_piece(void *owner, const double from[2], const double to[2])
{
    const struct placed_text *text = owner;
    const double *along = text->along;
    const double begin[2] = {text->start[0] + from[0] * along[0] + from[1] * along[1],
                             text->start[1] + from[0] * along[1] - from[1] * along[0]};
    const double end[2] = {text->start[0] + to[0] * along[0] + to[1] * along[1],
                           text->start[1] + to[0] * along[1] - to[1] * along[0]};
    draw_canvas_mark_line(text->canvas, begin, end, text->thickness);
}

static void draw_words(struct draw_page *page, double x, double y, const char *text,
                       const struct draw_text *style)
{
    static const double part_before[] = {[DRAW_START] = 0.0, [DRAW_MIDDLE] = 0.5, [DRAW_END] = 1.0};
    const double before = part_before[style->anchor] * draw_font_width(text);
    struct placed_text placed = {.canvas = &page->canvas,
                                 .thickness = style->size * (style->bold ? 0.115 : 0.086)};
    placed.along[0] = style->upwards ? 0.0 : style->size;
    placed.along[1] = style->upwards ? -style->size : 0.0;
    placed.start[0] = x - before * placed.along[0];
    placed.start[1] = y - before * placed.along[1];
    draw_font_pieces(text, mark_piece, &placed);
    draw_canvas_paint(&page->canvas, style->colour, 1.0);
}

static void clip_canvas(struct draw_page *page, const struct draw_box *box)
{
    draw_canvas_clip(&page->canvas, box);
}

static void make_file(struct draw_page *page, struct draw_bytes *file)
{
    draw_png(&page->canvas, file);
}

const struct draw_backend draw_raster = {"png",      open_canvas,  close_canvas,
                                         draw_line,  draw_polygon, draw_disc,
                                         draw_words, clip_canvas,  make_file};
