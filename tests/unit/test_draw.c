/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The drawing parts of tools/tecview: packing, PNG, colours, letters, scales, boxes, fronts.
 * With FILE X Y it prints the size of a PNG file and the colour of a point, for test_tools.sh. */
#include "check.h"
#include "read_png.h"

#include "../../tools/draw_axis.h"
#include "../../tools/draw_boxes.h"
#include "../../tools/draw_font.h"
#include "../../tools/draw_page.h"
#include "../../tools/draw_png.h"
#include "../../tools/tecview_chart.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint32_t random_state = 12345;

static unsigned random_number(unsigned below)
{
    random_state = random_state * 1664525u + 1013904223u;
    return (random_state >> 8) % below;
}

/* --- packing --- */

/* Packs and unpacks; returns the packed size, 0 when the bytes are not the same. */
static size_t packed_size(const unsigned char *data, size_t count)
{
    struct draw_bytes packed = {0};
    draw_deflate(data, count, &packed);
    unsigned char *back = malloc(count + 1);
    bool same = back && unpack(packed.data, packed.count, back, count) && memcmp(back, data, count) == 0;
    size_t size = same ? packed.count : 0;
    free(back);
    draw_bytes_free(&packed);
    return size;
}

static void test_packing(void)
{
    enum { COUNT = 120000 };
    unsigned char *data = malloc(COUNT);
    bool good = data != NULL;
    for (unsigned letters = 1; good && letters <= 256; letters *= 4) {
        for (size_t i = 0; i < COUNT; i++)
            data[i] = (unsigned char)random_number(letters);
        good = packed_size(data, COUNT) > 0;
    }
    check_true("packing gives the bytes back, few and many letters", good);
    good = true;
    for (size_t count = 0; count < 700; count++) {
        memset(data, (int)count, count);
        good = good && packed_size(data, count) > 0;
    }
    check_true("packing gives equal bytes back, 0 to 699", good);
    /* 32768 bytes back is as far as a repetition may be; a random byte has 8 bits or 9 */
    for (size_t i = 0; i < 65600; i++)
        data[i] = i < 32700 ? (unsigned char)random_number(256) : data[i - 32700];
    check_near("packing uses what is 32700 bytes back", (double)packed_size(data, 65400), 32700 * 1.055, 1000.0);
    for (size_t i = 0; i < 65600; i++)
        data[i] = i < 32800 ? (unsigned char)random_number(256) : data[i - 32800];
    check_near("packing can't use what is 32800 bytes back", (double)packed_size(data, 65600), 65600 * 1.055, 1000.0);
    memset(data, 7, COUNT);
    /* 258 bytes a repetition of 13 bits: 120000 / 258 * 13 / 8 = 756 bytes, and a few */
    check_near("packing of equal bytes", (double)packed_size(data, COUNT), 766.0, 10.0);
    free(data);
}

/* --- pictures --- */

static void test_png(void)
{
    struct draw_canvas canvas;
    struct draw_bytes file = {0};
    struct picture picture;
    draw_canvas_open(&canvas, 123, 77);
    for (size_t i = 0; i < 123 * 77; i++)
        canvas.points[i] = (struct draw_colour){(unsigned char)i, (unsigned char)random_number(3), (unsigned char)(i / 123)};
    draw_png(&canvas, &file);
    const char *problem = read_png(file.data, file.count, &picture);
    check_true("png: head, chunks, check sums", problem == NULL);
    check_true("png: size", picture.width == 123 && picture.height == 77);
    check_true("png: points", problem == NULL && memcmp(picture.points, canvas.points, 3 * 123 * 77) == 0);
    file.data[60] ^= 4;
    free(picture.points);
    check_true("png: a wrong bit is found", read_png(file.data, file.count, &picture) != NULL);
    free(picture.points);
    draw_bytes_free(&file);
    draw_canvas_close(&canvas);
}

static double red_at(const struct draw_canvas *canvas, int x, int y)
{
    return canvas->points[y * canvas->width + x].red;
}

static void test_canvas(void)
{
    struct draw_canvas canvas;
    const struct draw_colour black = {0, 0, 0};
    draw_canvas_open(&canvas, 40, 40);
    draw_canvas_mark_line(&canvas, (const double[]){10.0, 20.25}, (const double[]){30.0, 20.25}, 2.0);
    draw_canvas_mark_line(&canvas, (const double[]){20.0, 20.25}, (const double[]){30.0, 20.25}, 2.0);
    draw_canvas_paint(&canvas, black, 1.0);
    /* the line covers y from 19.25 to 21.25: 3/4 of row 19, row 20, 1/4 of row 21, once */
    check_near("canvas: line, upper edge", red_at(&canvas, 25, 19), 255.0 * 0.25, 1.0);
    check_near("canvas: line, middle", red_at(&canvas, 25, 20), 0.0, 0.5);
    check_near("canvas: line, lower edge", red_at(&canvas, 25, 21), 255.0 * 0.75, 1.0);
    check_near("canvas: nothing beside the line", red_at(&canvas, 25, 22) + red_at(&canvas, 5, 20), 510.0, 0.5);
    const struct draw_box clip = {0.0, 0.0, 10.0, 40.0};
    draw_canvas_clip(&canvas, &clip);
    draw_canvas_mark_polygon(&canvas, (const double[][2]){{5.0, 5.0}, {15.0, 5.0}, {15.0, 15.0}, {5.0, 15.0}}, 4);
    draw_canvas_paint(&canvas, black, 0.5);
    check_near("canvas: half opaque", red_at(&canvas, 7, 7), 127.5, 1.0);
    check_near("canvas: nothing outside the clip", red_at(&canvas, 12, 7), 255.0, 0.5);
    draw_canvas_mark_line(&canvas, (const double[]){-1e30, 3.0}, (const double[]){1e30, 3.0}, 1.0);
    draw_canvas_paint(&canvas, black, 1.0);
    check_true("canvas: a line far beyond the ends", red_at(&canvas, 3, 30) == 255.0);
    draw_canvas_close(&canvas);
}

/* Relative luminance of a screen colour (IEC 61966-2-1), to the power 1/3 as lightness. */
static double lightness(struct draw_colour colour)
{
    const double parts[3] = {colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0};
    static const double weights[3] = {0.2126, 0.7152, 0.0722};
    double sum = 0.0;
    for (int i = 0; i < 3; i++)
        sum += weights[i] * (parts[i] <= 0.04045 ? parts[i] / 12.92 : pow((parts[i] + 0.055) / 1.055, 2.4));
    return cbrt(sum);
}

static void test_colours(void)
{
    struct draw_map map;
    draw_colour_fill_map(&map);
    bool rises = true;
    double steepest = 0.0;
    for (int i = 4; i < DRAW_MAP_STEPS; i++) {
        double step = lightness(map.steps[i]) - lightness(map.steps[i - 4]);
        rises = rises && step > 0.0;
        steepest = fmax(steepest, step);
    }
    double mean = 4.0 * (lightness(map.steps[DRAW_MAP_STEPS - 1]) - lightness(map.steps[0])) / (DRAW_MAP_STEPS - 1);
    check_true("map: lightness rises everywhere", rises);
    check_true("map: no step twice as steep as the mean", steepest < 2.0 * mean);
    struct draw_colour low = draw_colour_of(&map, -3.0), high = draw_colour_of(&map, 7.0), none = draw_colour_of(&map, NAN);
    check_true("map: beyond its ends", memcmp(&low, &map.steps[0], 3) == 0 && memcmp(&high, &map.steps[255], 3) == 0);
    check_true("map: grey without a value", none.red == none.green && none.green == none.blue);
    /* sRGB red in Oklch: 0.62796, 0.25768, 29.234 degrees (Ottosson) */
    struct draw_colour red = draw_colour_oklch(0.62796, 0.25768, 29.234);
    check_true("oklch: red", red.red >= 254 && red.green <= 2 && red.blue <= 2);
}

/* --- text --- */

struct extent {
    int count;
    double left, right, low, high;
};

static void take_piece(void *owner, const double from[2], const double to[2])
{
    struct extent *extent = owner;
    extent->count++;
    extent->left = fmin(extent->left, fmin(from[0], to[0]));
    extent->right = fmax(extent->right, fmax(from[0], to[0]));
    extent->low = fmin(extent->low, fmin(from[1], to[1]));
    extent->high = fmax(extent->high, fmax(from[1], to[1]));
}

static struct extent extent_of(const char *text)
{
    struct extent extent = {0, HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL};
    draw_font_pieces(text, take_piece, &extent);
    return extent;
}

static void test_font(void)
{
    bool drawn = true, inside = true;
    for (char letter = 33; letter < 127; letter++) {
        const char text[2] = {letter, '\0'};
        struct extent extent = extent_of(text);
        drawn = drawn && extent.count > 0;
        inside = inside && extent.left > 0.0 && extent.right < draw_font_width(text) && extent.low > -0.26 && extent.high < 0.84;
    }
    check_true("font: every letter has strokes", drawn);
    check_true("font: every letter stays in its place", inside);
    check_near("font: height of a capital", extent_of("H").high, DRAW_FONT_CAPITAL, 1e-12);
    check_true("font: digits are equally wide", draw_font_width("1111") == draw_font_width("0000"));
    check_near("font: widths add up", draw_font_width("ab c"), draw_font_width("ab") + draw_font_width(" c"), 1e-12);
    check_true("font: raised text", extent_of("m^{2}").high > 1.2 * extent_of("m").high
                                        && draw_font_width("m^{2}") < draw_font_width("m2"));
    check_true("font: an open brace is text", draw_font_width("a^{b") > draw_font_width("a^b"));
    check_true("font: an unknown letter is one box", draw_font_width("\xc2\xb5") < draw_font_width("mm")
                                                         && extent_of("\xc2\xb5").count == 4);
}

/* --- scales --- */

static void check_labels(const char *name, const struct draw_axis *axis, const char *expected)
{
    char found[400] = "";
    for (int i = 0; i < axis->tick_count; i++)
        if (axis->labels[i][0])
            snprintf(found + strlen(found), sizeof found - strlen(found), "%s%s", *found ? " " : "", axis->labels[i]);
    if (strcmp(found, expected) != 0)
        printf("%s instead of %s\n", found, expected);
    check_true(name, strcmp(found, expected) == 0);
}

static void test_axis(void)
{
    struct draw_axis axis;
    draw_axis_open(&axis, 0.0, 1.0, false, 5, false);
    check_labels("axis: steps of 0.2", &axis, "0.0 0.2 0.4 0.6 0.8 1.0");
    draw_axis_open(&axis, -3.0, 42.0, false, 5, false);
    check_labels("axis: steps of 10", &axis, "0 10 20 30 40");
    draw_axis_open(&axis, -3.0, 42.0, false, 5, true);
    check_true("axis: widened to its ticks", axis.low == -10.0 && axis.high == 50.0);
    draw_axis_open(&axis, 2.1e8, 2.9e8, false, 4, false);
    check_labels("axis: in millions", &axis, "220 240 260 280");
    check_true("axis: its power", axis.exponent == 6);
    draw_axis_open(&axis, 1e-6, 2e-2, true, 6, false);
    check_labels("axis: decades", &axis, "10^{-6} 10^{-5} 10^{-4} 10^{-3} 10^{-2}");
    check_near("axis: middle of decades", draw_axis_part(&axis, sqrt(1e-6 * 2e-2)), 0.5, 1e-12);
    draw_axis_open(&axis, 0.3, 12.0, true, 6, false);
    check_labels("axis: few decades", &axis, "0.5 1 2 5 10");
    draw_axis_open(&axis, 1.13, 1.19, true, 4, false);
    check_labels("axis: a small part of a decade", &axis, "1.14 1.16 1.18");
    double low = 5.0, high = 5.0;
    draw_axis_spread(&low, &high, false);
    check_true("axis: room around one value", low < 5.0 && high > 5.0);
    char title[60];
    draw_axis_open(&axis, 0.0, 3e-4, false, 4, false);
    draw_axis_title(&axis, "disx", "mm", title, sizeof title);
    check_true("axis: title with power and unit", strcmp(title, "disx (10^{-6} mm)") == 0);
}

/* --- boxes --- */

static void test_views(void)
{
    struct draw_view view;
    draw_view_from((const double[]){0.0, -2.0, 0.0}, &view);
    check_true("view: from the front x is right, z up", view.right[0] == 1.0 && view.up[2] == 1.0);
    draw_view_from((const double[]){0.0, 0.0, 1.0}, &view);
    check_true("view: from the top x is right, y up", view.right[0] == 1.0 && view.up[1] == 1.0);
    draw_view_from((const double[]){1.0, 2.0, -3.0}, &view);
    check_near("view: unit vectors at right angles", fabs(draw_view_part(view.right, view.up)) + fabs(draw_view_part(view.up, view.toward))
               + fabs(draw_view_part(view.up, view.up) - 1.0), 0.0, 1e-14);
}

static void test_boxes(void)
{
    struct draw_view view;
    struct draw_boxes boxes;
    struct draw_canvas canvas;
    const struct draw_colour near = {200, 0, 0}, far = {0, 200, 0};
    const double half[3] = {1.0, 1.0, 1.0};
    draw_canvas_open(&canvas, 40, 40);
    draw_view_from((const double[]){0.0, 0.0, 1.0}, &view);
    draw_boxes_open(&boxes, &view, 40, 40, (const double[]){0.0, 0.0}, 5.0);
    draw_boxes_add(&boxes, (const double[]){0.0, 0.0, 1.0}, half, near);
    draw_boxes_add(&boxes, (const double[]){1.0, 0.0, 0.0}, half, far);
    draw_boxes_onto(&boxes, &canvas, 0, 0);
    /* 5 points a length: the near box covers columns and rows 15 to 24, the far one 20 to 29 */
    check_near("boxes: the nearest is seen", red_at(&canvas, 22, 20), 200.0, 0.5);
    check_near("boxes: the other beside it", canvas.points[20 * 40 + 27].green, 200.0, 0.5);
    check_near("boxes: white outside", red_at(&canvas, 31, 20) + red_at(&canvas, 13, 20) + red_at(&canvas, 20, 26), 765.0, 0.5);
    int covered = 0;
    for (int i = 0; i < 1600; i++)
        covered += canvas.points[i].blue == 0;
    check_true("boxes: exactly their points", covered == 150);
    draw_boxes_close(&boxes);

    draw_boxes_open(&boxes, &view, 40, 40, (const double[]){0.0, 0.0}, 5.0);
    draw_boxes_add(&boxes, (const double[]){-1.5, 0.0, 0.0}, half, near);
    draw_boxes_add(&boxes, (const double[]){1.5, 0.0, 0.0}, half, far);
    draw_boxes_fill_gaps(&boxes, 0.5);
    check_true("boxes: a wide gap stays", boxes.depth[40 * 80 + 40] < -1e30f);
    draw_boxes_fill_gaps(&boxes, 1.1);
    check_true("boxes: a narrow gap is filled from both sides",
               boxes.points[40 * 80 + 37].red > 150 && boxes.points[40 * 80 + 43].green > 150);
    draw_boxes_close(&boxes);
    draw_canvas_close(&canvas);
}

/* --- fronts --- */

static void test_front(void)
{
    double points[7][2] = {{3, 1}, {1, 5}, {2, 5}, {2, 3}, {4, 1}, {1, 6}, {3, 2}};
    check_true("front: three points", tecview_chart_front(points, 7) == 3);
    check_true("front: in order", points[0][0] == 1 && points[0][1] == 5 && points[1][0] == 2 && points[1][1] == 3 && points[2][0] == 3
                                      && points[2][1] == 1);
    double sum = 0.0;
    for (int i = 0; i < 7; i++)
        sum += 10.0 * points[i][0] + points[i][1];
    check_near("front: no point is lost", sum, 10.0 * 16 + 23, 0.0);
    check_true("front: of nothing", tecview_chart_front(points, 0) == 0);
}

static int print_point(const char *path, int x, int y)
{
    static unsigned char data[8000000];
    struct picture picture;
    FILE *stream = fopen(path, "rb");
    size_t count = stream ? fread(data, 1, sizeof data, stream) : 0;
    if (stream)
        fclose(stream);
    const char *problem = read_png(data, count, &picture);
    if (problem)
        printf("bad %s\n", problem);
    else if (x >= 0 && y >= 0 && (unsigned)x < picture.width && (unsigned)y < picture.height) {
        const unsigned char *point = picture.points + 3 * ((size_t)y * picture.width + (size_t)x);
        printf("%ux%u %02x%02x%02x\n", picture.width, picture.height, point[0], point[1], point[2]);
    }
    free(picture.points);
    return problem != NULL;
}

int main(int argument_count, char **arguments)
{
    if (argument_count == 4)
        return print_point(arguments[1], atoi(arguments[2]), atoi(arguments[3]));
    test_packing();
    test_png();
    test_canvas();
    test_colours();
    test_font();
    test_axis();
    test_views();
    test_boxes();
    test_front();
    return check_result();
}
