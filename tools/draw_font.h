/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * draw_font: letters made of strokes, ASCII 32 to 126.
 *
 * Lengths are parts of the text's size (the height of a line, as in other programs); a capital
 * letter is 0.716 high. In a text ^{...} is raised and smaller, as in m^{2}.
 */
#ifndef TOOLS_DRAW_FONT_H
#define TOOLS_DRAW_FONT_H

#include <stddef.h>

#define DRAW_FONT_CAPITAL 0.716    /* height of a capital letter */
#define DRAW_FONT_RAISED_SIZE 0.72 /* of raised text */
#define DRAW_FONT_RAISED_BY 0.36   /* its baseline above that of the text */

/* Takes one piece of a stroke: from (x, y) to (x, y), y upwards from the baseline. */
typedef void draw_font_piece(void *owner, const double from[2], const double to[2]);

/* Gives the pieces of a text of size 1 that starts at (0, 0). */
void draw_font_pieces(const char *text, draw_font_piece *take, void *owner);

/* The width of a text of size 1. */
double draw_font_width(const char *text);

/* How a text falls apart at ^{ and }: the length of the first run and whether it is raised;
 * *text moves behind the run, *skip to behind its mark. Returns 0 at the end. */
size_t draw_font_run(const char **text, const char **run, int *raised);

#endif
