/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * draw_colour: colours of pictures, made in the Oklab space (Ottosson 2020), where equal steps look
 * equal: a map for values, whose lightness grows evenly, and colours that tell series apart.
 */
#ifndef TOOLS_DRAW_COLOUR_H
#define TOOLS_DRAW_COLOUR_H

#include <stddef.h>

struct draw_colour {
    unsigned char red, green, blue;
};

enum { DRAW_MAP_STEPS = 256, DRAW_SERIES_COLOURS = 8 };

struct draw_map {
    struct draw_colour steps[DRAW_MAP_STEPS];
};

/* The colour of lightness 0..1, chroma and hue (degrees); the chroma is lowered until the screen
 * can show it. */
struct draw_colour draw_colour_oklch(double lightness, double chroma, double hue);

/* From dark violet over blue and green to light yellow. */
void draw_colour_fill_map(struct draw_map *map);

/* The colour of a part 0..1 of the range; beyond it that of the end, grey for NaN. */
struct draw_colour draw_colour_of(const struct draw_map *map, double part);

/* The colour of series `number`; after DRAW_SERIES_COLOURS they come again. */
struct draw_colour draw_colour_series(size_t number);

/* All three parts times factor 0..1. */
struct draw_colour draw_colour_shaded(struct draw_colour colour, double factor);

/* `over` with opacity 0..1 on `under`. */
struct draw_colour draw_colour_mixed(struct draw_colour under, struct draw_colour over,
                                     double opacity);

extern const struct draw_colour draw_colour_black, draw_colour_white, draw_colour_grey,
    draw_colour_pale, draw_colour_nan;

#endif
