/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tecview_figure: see tecview_figure.h. */
#include "tecview_figure.h"
#include "draw_font.h"

#include <math.h>

struct draw_text tecview_figure_style(const struct tecview_figure *figure, double size,
                                      enum draw_anchor anchor)
{
    return (struct draw_text){
        .colour = draw_colour_black, .size = fmax(size * figure->unit, 9.0), .anchor = anchor};
}

void tecview_figure_write(struct tecview_figure *figure, double x, double y, const char *text,
                          struct draw_text style, double room)
{
    const double width = draw_font_width(text) * style.size;
    if (width > room)
        style.size *= room / width;
    draw_page_text(&figure->page, x, y, text, &style);
}

const char *tecview_figure_or(const char *text, const char *otherwise)
{
    return text != NULL ? text : otherwise;
}

struct draw_colour tecview_figure_colour(const struct tecview_figure *figure, double value)
{
    return draw_colour_of(&figure->map, draw_axis_part(&figure->scale, value));
}
