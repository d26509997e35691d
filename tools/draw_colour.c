/* SPDX-License-Identifier: GPL-3.0-or-later */
/* draw_colour: see draw_colour.h. */
#include "draw_colour.h"

#include <math.h>
#include <stdbool.h>

static const double radians = 3.14159265358979323846 / 180.0;

const struct draw_colour draw_colour_black = {25, 25, 30};
const struct draw_colour draw_colour_white = {255, 255, 255};
const struct draw_colour draw_colour_grey = {95, 95, 100};
const struct draw_colour draw_colour_pale = {225, 225, 228};
const struct draw_colour draw_colour_nan = {165, 165, 165};

/* Linear red, green and blue of an Oklab colour. */
static void oklab_to_linear(double lightness, double a, double b, double rgb[3])
{
    const double l = pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3.0);
    const double m = pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3.0);
    const double s = pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3.0);
    rgb[0] = 4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s;
    rgb[1] = -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s;
    rgb[2] = -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s;
}

/* The byte of a linear part (sRGB's transfer curve). */
static unsigned char screen_byte(double linear)
{
    const double part = fmin(fmax(linear, 0.0), 1.0);
    const double curved = part <= 0.0031308 ? 12.92 * part : 1.055 * pow(part, 1.0 / 2.4) - 0.055;
    return (unsigned char)lround(255.0 * curved);
}

static void oklch_to_linear(double lightness, double chroma, double hue, double rgb[3])
{
    oklab_to_linear(lightness, chroma * cos(hue * radians), chroma * sin(hue * radians), rgb);
}

static bool can_be_shown(const double rgb[3])
{
    for (int i = 0; i < 3; ++i)
        if (rgb[i] < -0.002 || rgb[i] > 1.002)
            return false;
    return true;
}

struct draw_colour draw_colour_oklch(double lightness, double chroma, double hue)
{
    double rgb[3];
    double shown = 0.0;
    double hidden = 2.0 * chroma;
    for (int i = 0; i < 20; ++i) { /* the first middle is the chroma itself */
        const double middle = 0.5 * (shown + hidden);
        oklch_to_linear(lightness, middle, hue, rgb);
        if (can_be_shown(rgb) && i == 0)
            break;
        *(can_be_shown(rgb) ? &shown : &hidden) = middle;
    }
    return (struct draw_colour){screen_byte(rgb[0]), screen_byte(rgb[1]), screen_byte(rgb[2])};
}

/* Less colour in the middle, where the screen can show less. */
static double map_chroma(double part)
{
    return 0.13 - 0.10 * part + 0.13 * part * part;
}

void draw_colour_fill_map(struct draw_map *map)
{
    for (int i = 0; i < DRAW_MAP_STEPS; ++i) {
        const double part = (double)i / (DRAW_MAP_STEPS - 1);
        map->steps[i] =
            draw_colour_oklch(0.30 + 0.62 * part, map_chroma(part), 305.0 - 205.0 * part);
    }
}

struct draw_colour draw_colour_of(const struct draw_map *map, double part)
{
    if (isnan(part))
        return draw_colour_nan;
    const double inside = fmin(fmax(part, 0.0), 1.0);
    return map->steps[lround(inside * (DRAW_MAP_STEPS - 1))];
}

struct draw_colour draw_colour_series(size_t number)
{
    static const struct {
        double lightness, chroma, hue;
    } rows[DRAW_SERIES_COLOURS] = {
        {0.50, 0.16, 255.0}, {0.62, 0.18, 45.0},  {0.58, 0.14, 155.0}, {0.48, 0.17, 330.0},
        {0.70, 0.14, 85.0},  {0.68, 0.12, 215.0}, {0.42, 0.14, 20.0},  {0.45, 0.03, 255.0},
    };
    const size_t i = number % DRAW_SERIES_COLOURS;
    return draw_colour_oklch(rows[i].lightness, rows[i].chroma, rows[i].hue);
}

struct draw_colour draw_colour_shaded(struct draw_colour colour, double factor)
{
    return (struct draw_colour){(unsigned char)lround(colour.red * factor),
                                (unsigned char)lround(colour.green * factor),
                                (unsigned char)lround(colour.blue * factor)};
}

static unsigned char mixed_byte(unsigned char under, unsigned char over, double opacity)
{
    return (unsigned char)lround(under + opacity * ((double)over - under));
}

struct draw_colour draw_colour_mixed(struct draw_colour under, struct draw_colour over,
                                     double opacity)
{
    return (struct draw_colour){mixed_byte(under.red, over.red, opacity),
                                mixed_byte(under.green, over.green, opacity),
                                mixed_byte(under.blue, over.blue, opacity)};
}
