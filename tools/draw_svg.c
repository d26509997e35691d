/* SPDX-License-Identifier: GPL-3.0-or-later */
/* draw_svg: a page as SVG 1.1 text (see draw_page.h). */
#include "draw_font.h"
#include "draw_page.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Adds formatted text; no call here makes more than the buffer holds. */
static void put(struct draw_page *page, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static void put(struct draw_page *page, const char *format, ...)
{
    char text[400];
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (length > 0)
        draw_bytes_add(&page->text, text, (size_t)length);
}

static void open_text(struct draw_page *page)
{
    put(page,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%g\" height=\"%g\" "
        "viewBox=\"0 0 %g %g\" font-family=\"Helvetica, Arial, sans-serif\">\n",
        page->width, page->height, page->width, page->height);
    put(page, "<rect width=\"%g\" height=\"%g\" fill=\"#ffffff\"/>\n", page->width, page->height);
}

static void close_text(struct draw_page *page)
{
    draw_bytes_free(&page->text);
}

static void put_colour(struct draw_page *page, const char *attribute, struct draw_colour colour)
{
    put(page, " %s=\"#%02x%02x%02x\"", attribute, colour.red, colour.green, colour.blue);
}

static void put_points(struct draw_page *page, const double (*points)[2], size_t count)
{
    put(page, " points=\"");
    for (size_t i = 0; i < count; ++i)
        put(page, "%s%.2f,%.2f",
            i == 0        ? ""
            : i % 10 == 0 ? "\n"
                          : " ",
            points[i][0], points[i][1]);
    put(page, "\"");
}

static void put_line(struct draw_page *page, const double (*points)[2], size_t count,
                     const struct draw_pen *pen)
{
    put(page,
        "<polyline fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"%s\" "
        "stroke-width=\"%g\"",
        pen->dash > 0.0 ? "butt" : "round", pen->thickness);
    put_colour(page, "stroke", pen->colour);
    if (pen->dash > 0.0)
        put(page, " stroke-dasharray=\"%g\"", pen->dash);
    put_points(page, points, count);
    put(page, "/>\n");
}

static void put_polygon(struct draw_page *page, const double (*corners)[2], size_t count,
                        struct draw_colour colour, double opacity)
{
    put(page, "<polygon");
    put_colour(page, "fill", colour);
    if (opacity < 1.0)
        put(page, " fill-opacity=\"%g\"", opacity);
    put_points(page, corners, count);
    put(page, "/>\n");
}

static void put_disc(struct draw_page *page, const double centre[2], double radius,
                     struct draw_colour colour)
{
    put(page, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%g\"", centre[0], centre[1], radius);
    put_colour(page, "fill", colour);
    put(page, "/>\n");
}

/* Text with what XML reserves written as its entities, and without control characters. */
static void put_escaped(struct draw_page *page, const char *text, size_t length)
{
    static const struct {
        char character;
        const char *entity;
    } rows[] = {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
    for (size_t i = 0; i < length; ++i) {
        const char *entity = NULL;
        for (size_t j = 0; j < sizeof rows / sizeof *rows; ++j)
            if (text[i] == rows[j].character)
                entity = rows[j].entity;
        if (entity != NULL)
            put(page, "%s", entity);
        else if ((unsigned char)text[i] >= 0x20)
            draw_bytes_add(&page->text, &text[i], 1);
    }
}

static void put_words(struct draw_page *page, double x, double y, const char *text,
                      const struct draw_text *style)
{
    static const char *const anchors[] = {
        [DRAW_START] = "start", [DRAW_MIDDLE] = "middle", [DRAW_END] = "end"};
    put(page, "<text x=\"%.2f\" y=\"%.2f\" font-size=\"%g\" text-anchor=\"%s\"", x, y, style->size,
        anchors[style->anchor]);
    put_colour(page, "fill", style->colour);
    if (style->bold)
        put(page, " font-weight=\"bold\"");
    if (style->upwards)
        put(page, " transform=\"rotate(-90 %.2f %.2f)\"", x, y);
    put(page, ">");
    double shift = 0.0;
    while (*text != '\0') {
        const char *run;
        int raised;
        const size_t length = draw_font_run(&text, &run, &raised);
        const double height = raised ? DRAW_FONT_RAISED_BY * style->size : 0.0;
        put(page, "<tspan dy=\"%.2f\" font-size=\"%g\">", shift - height,
            raised ? DRAW_FONT_RAISED_SIZE * style->size : style->size);
        put_escaped(page, run, length);
        put(page, "</tspan>");
        shift = height;
    }
    put(page, "</text>\n");
}

static void put_clip(struct draw_page *page, const struct draw_box *box)
{
    if (page->clipped)
        put(page, "</g>\n");
    page->clipped = box != NULL;
    if (box == NULL)
        return;
    const int number = ++page->clip_count;
    put(page,
        "<clipPath id=\"clip%d\"><rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\"/>"
        "</clipPath>\n",
        number, box->left, box->top, box->right - box->left, box->bottom - box->top);
    put(page, "<g clip-path=\"url(#clip%d)\">\n", number);
}

static void make_file(struct draw_page *page, struct draw_bytes *file)
{
    put_clip(page, NULL);
    put(page, "</svg>\n");
    draw_bytes_add(file, page->text.data, page->text.count);
}

const struct draw_backend draw_svg = {"svg",    open_text, close_text, put_line, put_polygon,
                                      put_disc, put_words, put_clip,   make_file};
