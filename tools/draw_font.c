/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * draw_font: see draw_font.h.
 *
 * A letter is drawn on a grid on which a capital is 14 high and a small letter 10, with the
 * baseline at 0. Its path has M x y: go there; L x y ...: lines; Q cx cy x y ...: curves with one
 * control point; O cx cy rx ry: a closed round. A point is a line without length.
 */
#include "draw_font.h"

#include <stdlib.h>
#include <string.h>

enum { FIRST = 32, LAST = 126, CURVE_PIECES = 8 };

static const double grid = DRAW_FONT_CAPITAL / 14.0; /* one step of the grid, size 1 */
static const double gap = 3.6;                       /* between letters, steps */

struct letter {
    double width; /* steps of the grid */
    const char *path;
};

static const struct letter letters[LAST - FIRST + 1] = {
    [' ' - FIRST] = {2.4, ""},
    ['!' - FIRST] = {1, "M 0.5 14 L 0.5 4.4 M 0.5 0.1 L 0.5 0"},
    ['"' - FIRST] = {3.4, "M 0 14 L 0 10 M 3.4 14 L 3.4 10"},
    ['#' -
        FIRST] = {9.6, "M 2 0.5 L 4 13.5 M 6 0.5 L 8 13.5 M 0.4 9.2 L 9.6 9.2 M 0 4.8 L 9.2 4.8"},
    ['$' - FIRST] = {8, "M 7.6 11.4 Q 7.2 13.6 4 13.6 Q 0.3 13.6 0.3 10.6 Q 0.3 7.8 4 7.2 Q 8 6.5 "
                        "8 3.6 Q 8 0.4 4 0.4 Q 0.3 0.4 0 3.2 M 4 15.6 L 4 -1.6"},
    ['%' - FIRST] = {12, "O 2.7 10.9 2.7 3.1 O 9.3 3.1 2.7 3.1 M 10 14 L 2 0"},
    ['&' - FIRST] = {10, "M 10 0 L 2.7 9.2 Q 1.7 10.5 1.7 11.5 Q 1.7 14 4.3 14 Q 6.8 14 6.8 11.6 Q "
                         "6.8 9.9 4 8.2 Q 0 6 0 3.4 Q 0 0 3.9 0 Q 8.6 0 9.4 6"},
    ['\'' - FIRST] = {1, "M 0.5 14 L 0.5 10"},
    ['(' - FIRST] = {3.2, "M 3.2 16 Q 0 12 0 6.5 Q 0 1 3.2 -3"},
    [')' - FIRST] = {3.2, "M 0 16 Q 3.2 12 3.2 6.5 Q 3.2 1 0 -3"},
    ['*' - FIRST] = {6, "M 3 14 L 3 8 M 0.4 12.5 L 5.6 9.5 M 5.6 12.5 L 0.4 9.5"},
    ['+' - FIRST] = {8, "M 4 10 L 4 2 M 0 6 L 8 6"},
    [',' - FIRST] = {1.4, "M 1.2 0.3 L 0.2 -2.6"},
    ['-' - FIRST] = {6.4, "M 0 5.8 L 6.4 5.8"},
    ['.' - FIRST] = {1.2, "M 0.6 0.1 L 0.6 0"},
    ['/' - FIRST] = {6, "M 6 15 L 0 -1.5"},
    ['0' - FIRST] = {8, "M 4 14 Q 8 14 8 7 Q 8 0 4 0 Q 0 0 0 7 Q 0 14 4 14"},
    ['1' - FIRST] = {8, "M 1.4 11.2 L 4.6 14 L 4.6 0"},
    ['2' - FIRST] = {8, "M 0.3 10.4 Q 0.4 14 4 14 Q 7.7 14 7.7 10.4 Q 7.7 8.1 5 5.3 L 0 0 L 8 0"},
    ['3' - FIRST] = {8, "M 0.5 11.2 Q 0.9 14 4 14 Q 7.4 14 7.4 10.8 Q 7.4 7.6 4 7.6 L 2.8 7.6 M 4 "
                        "7.6 Q 8 7.6 8 3.8 Q 8 0 4 0 Q 0.4 0 0 3"},
    ['4' - FIRST] = {8.4, "M 6 0 L 6 14 L 0 4.2 L 8.4 4.2"},
    ['5' - FIRST] =
        {8, "M 7.4 14 L 1.4 14 L 0.8 7.6 Q 2 8.8 4 8.8 Q 8 8.8 8 4.5 Q 8 0 4 0 Q 0.5 0 0 2.8"},
    ['6' - FIRST] = {8, "M 7.4 11.8 Q 6.8 14 4.4 14 Q 0 14 0 6.5 L 0 4.5 Q 0 0 4 0 Q 8 0 8 4.4 Q 8 "
                        "8.7 4.2 8.7 Q 0.9 8.7 0 5.4"},
    ['7' - FIRST] = {8, "M 0 14 L 8 14 Q 3.6 7.5 2.8 0"},
    ['8' - FIRST] = {8, "O 4 10.8 3.4 3.2 O 4 3.8 4 3.8"},
    ['9' - FIRST] = {8, "M 0.6 2.2 Q 1.2 0 3.6 0 Q 8 0 8 7.5 L 8 9.5 Q 8 14 4 14 Q 0 14 0 9.6 Q 0 "
                        "5.3 3.8 5.3 Q 7.1 5.3 8 8.6"},
    [':' - FIRST] = {1.2, "M 0.6 0.1 L 0.6 0 M 0.6 8.6 L 0.6 8.5"},
    [';' - FIRST] = {1.4, "M 1.2 0.3 L 0.2 -2.6 M 0.9 8.6 L 0.9 8.5"},
    ['<' - FIRST] = {7.5, "M 7.5 10.5 L 0 6 L 7.5 1.5"},
    ['=' - FIRST] = {8, "M 0 8 L 8 8 M 0 4 L 8 4"},
    ['>' - FIRST] = {7.5, "M 0 10.5 L 7.5 6 L 0 1.5"},
    ['?' - FIRST] = {7.4, "M 0.2 10.8 Q 0.4 14 3.8 14 Q 7.4 14 7.4 10.8 Q 7.4 8.6 5.4 7.3 Q 3.7 "
                          "6.2 3.7 4.2 M 3.7 0.1 L 3.7 0"},
    ['@' - FIRST] = {13, "M 9.3 9 L 9 4 Q 9 2.4 10.5 2.4 Q 13 2.4 13 6.5 Q 13 13 6.7 13 Q 0 13 0 "
                         "5.5 Q 0 -2 6.8 -2 Q 9 -2 10.8 -1 O 6.4 5.7 2.7 3.3"},
    ['A' - FIRST] = {10, "M 0 0 L 5 14 L 10 0 M 1.7 4.7 L 8.3 4.7"},
    ['B' - FIRST] = {9, "M 0 0 L 0 14 L 4.8 14 Q 8.2 14 8.2 10.8 Q 8.2 7.6 4.8 7.6 L 0 7.6 M 4.8 "
                        "7.6 Q 9 7.6 9 3.8 Q 9 0 4.8 0 L 0 0"},
    ['C' - FIRST] = {9.6, "M 9.6 10.2 Q 8.8 14 5.2 14 Q 0 14 0 7 Q 0 0 5.2 0 Q 8.8 0 9.6 3.8"},
    ['D' - FIRST] = {9.6, "M 0 0 L 0 14 L 4 14 Q 9.6 14 9.6 7 Q 9.6 0 4 0 L 0 0"},
    ['E' - FIRST] = {8.2, "M 8 14 L 0 14 L 0 0 L 8.2 0 M 0 7.4 L 7.2 7.4"},
    ['F' - FIRST] = {8, "M 8 14 L 0 14 L 0 0 M 0 7.2 L 7 7.2"},
    ['G' - FIRST] =
        {9.8,
         "M 9.6 10.4 Q 8.6 14 5.2 14 Q 0 14 0 7 Q 0 0 5.4 0 Q 9.8 0 9.8 4.4 L 9.8 6.6 L 5.8 6.6"},
    ['H' - FIRST] = {9.4, "M 0 0 L 0 14 M 9.4 0 L 9.4 14 M 0 7.4 L 9.4 7.4"},
    ['I' - FIRST] = {1, "M 0.5 0 L 0.5 14"},
    ['J' - FIRST] = {6, "M 6 14 L 6 4 Q 6 0 3 0 Q 0 0 0 3.6"},
    ['K' - FIRST] = {9.2, "M 0 0 L 0 14 M 9 14 L 0 5 M 3.4 8.4 L 9.2 0"},
    ['L' - FIRST] = {7.4, "M 0 14 L 0 0 L 7.4 0"},
    ['M' - FIRST] = {11.2, "M 0 0 L 0 14 L 5.6 2 L 11.2 14 L 11.2 0"},
    ['N' - FIRST] = {9.4, "M 0 0 L 0 14 L 9.4 0 L 9.4 14"},
    ['O' - FIRST] = {10.6, "O 5.3 7 5.3 7"},
    ['P' - FIRST] = {9, "M 0 0 L 0 14 L 4.8 14 Q 9 14 9 10.2 Q 9 6.4 4.8 6.4 L 0 6.4"},
    ['Q' - FIRST] = {10.6, "O 5.3 7 5.3 7 M 6.4 3.2 L 10.4 -0.8"},
    ['R' - FIRST] = {9.4,
                     "M 0 0 L 0 14 L 4.8 14 Q 9 14 9 10.2 Q 9 6.4 4.8 6.4 L 0 6.4 M 5 6.4 L 9.4 0"},
    ['S' - FIRST] = {8.8, "M 8.4 10.8 Q 8 14 4.4 14 Q 0.5 14 0.5 10.6 Q 0.5 7.8 4.5 7.2 Q 8.8 6.5 "
                          "8.8 3.6 Q 8.8 0 4.5 0 Q 0.4 0 0 3.6"},
    ['T' - FIRST] = {9.6, "M 0 14 L 9.6 14 M 4.8 14 L 4.8 0"},
    ['U' - FIRST] = {9.4, "M 0 14 L 0 5 Q 0 0 4.7 0 Q 9.4 0 9.4 5 L 9.4 14"},
    ['V' - FIRST] = {9.6, "M 0 14 L 4.8 0 L 9.6 14"},
    ['W' - FIRST] = {14.4, "M 0 14 L 3.6 0 L 7.2 14 L 10.8 0 L 14.4 14"},
    ['X' - FIRST] = {9, "M 0 0 L 9 14 M 0 14 L 9 0"},
    ['Y' - FIRST] = {9.6, "M 0 14 L 4.8 6.4 L 9.6 14 M 4.8 6.4 L 4.8 0"},
    ['Z' - FIRST] = {9, "M 0.3 14 L 8.8 14 L 0 0 L 9 0"},
    ['[' - FIRST] = {3, "M 3 16 L 0 16 L 0 -3 L 3 -3"},
    ['\\' - FIRST] = {6, "M 0 15 L 6 -1.5"},
    [']' - FIRST] = {3, "M 0 16 L 3 16 L 3 -3 L 0 -3"},
    ['^' - FIRST] = {7, "M 0 9 L 3.5 14 L 7 9"},
    ['_' - FIRST] = {8, "M 0 -2 L 8 -2"},
    ['`' - FIRST] = {2, "M 0 14 L 2 11"},
    ['a' - FIRST] = {7.2, "M 0.6 7.8 Q 1.1 10 4 10 Q 7.2 10 7.2 7 L 7.2 0 M 7.2 5.8 L 3.6 5.6 Q 0 "
                          "5.4 0 2.8 Q 0 0 3.2 0 Q 6.4 0 7.2 3.2"},
    ['b' -
        FIRST] = {7.8, "M 0 14 L 0 0 M 0 5.9 Q 0 10 4 10 Q 7.8 10 7.8 5 Q 7.8 0 4 0 Q 0 0 0 4.1"},
    ['c' - FIRST] = {7, "M 7 7 Q 6.4 10 3.9 10 Q 0 10 0 5 Q 0 0 3.9 0 Q 6.4 0 7 3"},
    ['d' - FIRST] =
        {7.8, "M 7.8 14 L 7.8 0 M 7.8 5.9 Q 7.8 10 3.8 10 Q 0 10 0 5 Q 0 0 3.8 0 Q 7.8 0 7.8 4.1"},
    ['e' -
        FIRST] = {7.7, "M 0.1 5.1 L 7.7 5.1 Q 7.7 10 3.9 10 Q 0 10 0 5 Q 0 0 4 0 Q 6.6 0 7.3 2.6"},
    ['f' - FIRST] = {4.4, "M 4.6 14 L 4 14 Q 1.7 14 1.7 11.4 L 1.7 0 M 0 9.7 L 4.3 9.7"},
    ['g' - FIRST] = {7.6, "M 7.6 10 L 7.6 0 Q 7.6 -4 3.8 -4 Q 1 -4 0.4 -2 M 7.6 5.9 Q 7.6 10 3.8 "
                          "10 Q 0 10 0 5 Q 0 0 3.8 0 Q 7.6 0 7.6 4.1"},
    ['h' - FIRST] = {7.2, "M 0 14 L 0 0 M 0 5.6 Q 0 10 3.8 10 Q 7.2 10 7.2 6.4 L 7.2 0"},
    ['i' - FIRST] = {1, "M 0.5 10 L 0.5 0 M 0.5 13.6 L 0.5 13.5"},
    ['j' - FIRST] = {2.2, "M 2 10 L 2 -1.6 Q 2 -4 -0.2 -4 M 2 13.6 L 2 13.5"},
    ['k' - FIRST] = {7, "M 0 14 L 0 0 M 6.7 10 L 0 3.6 M 2.6 6 L 7 0"},
    ['l' - FIRST] = {1, "M 0.5 14 L 0.5 0"},
    ['m' - FIRST] = {11.8, "M 0 10 L 0 0 M 0 6 Q 0 10 3.1 10 Q 5.9 10 5.9 6.6 L 5.9 0 M 5.9 6 Q "
                           "5.9 10 9 10 Q 11.8 10 11.8 6.6 L 11.8 0"},
    ['n' - FIRST] = {7.2, "M 0 10 L 0 0 M 0 5.6 Q 0 10 3.8 10 Q 7.2 10 7.2 6.4 L 7.2 0"},
    ['o' - FIRST] = {8, "O 4 5 4 5"},
    ['p' -
        FIRST] = {7.8, "M 0 10 L 0 -4 M 0 5.9 Q 0 10 4 10 Q 7.8 10 7.8 5 Q 7.8 0 4 0 Q 0 0 0 4.1"},
    ['q' - FIRST] =
        {7.8, "M 7.8 10 L 7.8 -4 M 7.8 5.9 Q 7.8 10 3.8 10 Q 0 10 0 5 Q 0 0 3.8 0 Q 7.8 0 7.8 4.1"},
    ['r' - FIRST] = {4.2, "M 0 10 L 0 0 M 0 5.4 Q 0.4 10 4.4 9.8"},
    ['s' - FIRST] = {7, "M 6.6 7.6 Q 6.2 10 3.5 10 Q 0.4 10 0.4 7.6 Q 0.4 5.6 3.5 5.2 Q 7 4.7 7 "
                        "2.5 Q 7 0 3.6 0 Q 0.4 0 0 2.6"},
    ['t' - FIRST] = {4.6, "M 1.8 13 L 1.8 2.6 Q 1.8 0 4 0 L 4.7 0 M 0 9.7 L 4.6 9.7"},
    ['u' - FIRST] = {7.2, "M 0 10 L 0 3.6 Q 0 0 3.4 0 Q 7.2 0 7.2 4.4 M 7.2 10 L 7.2 0"},
    ['v' - FIRST] = {7.4, "M 0 10 L 3.7 0 L 7.4 10"},
    ['w' - FIRST] = {11.2, "M 0 10 L 2.8 0 L 5.6 10 L 8.4 0 L 11.2 10"},
    ['x' - FIRST] = {7, "M 0 0 L 7 10 M 0 10 L 7 0"},
    ['y' - FIRST] = {7.4, "M 0 10 L 3.7 0 M 7.4 10 L 3.1 -2.4 Q 2.5 -4 0.6 -4"},
    ['z' - FIRST] = {7, "M 0.2 10 L 6.8 10 L 0 0 L 7 0"},
    ['{' - FIRST] = {3.5, "M 3.5 16 Q 1.8 16 1.8 13.5 L 1.8 9 Q 1.8 6.5 0 6.5 Q 1.8 6.5 1.8 4 L "
                          "1.8 -0.5 Q 1.8 -3 3.5 -3"},
    ['|' - FIRST] = {1, "M 0.5 16 L 0.5 -3"},
    ['}' - FIRST] = {3.5, "M 0 16 Q 1.7 16 1.7 13.5 L 1.7 9 Q 1.7 6.5 3.5 6.5 Q 1.7 6.5 1.7 4 L "
                          "1.7 -0.5 Q 1.7 -3 0 -3"},
    ['~' - FIRST] = {8, "M 0 5 Q 0.5 7.5 2.5 6.9 L 5.5 5.6 Q 7.5 5 8 7.5"},
};

/* A character that has no letter is drawn as an empty box, and a character of several bytes once.
 */
static const struct letter unknown = {7, "M 0 0 L 0 14 L 7 14 L 7 0 L 0 0"};

/* The pen on its way through the path of a letter. */
struct pen {
    draw_font_piece *take;
    void *owner;
    double left, baseline, step; /* of the letter: where it starts, and one step of its grid */
    double at[2];
};

static void draw_to(struct pen *pen, double x, double y)
{
    const double from[2] = {pen->left + pen->step * pen->at[0],
                            pen->baseline + pen->step * pen->at[1]};
    const double to[2] = {pen->left + pen->step * x, pen->baseline + pen->step * y};
    pen->take(pen->owner, from, to);
    pen->at[0] = x;
    pen->at[1] = y;
}

/* A curve of the second order to (x, y); its control point pulls it. */
static void curve_to(struct pen *pen, double control_x, double control_y, double x, double y)
{
    const double start_x = pen->at[0];
    const double start_y = pen->at[1];
    for (int i = 1; i <= CURVE_PIECES; ++i) {
        const double t = (double)i / CURVE_PIECES;
        const double a = (1.0 - t) * (1.0 - t);
        const double b = 2.0 * t * (1.0 - t);
        draw_to(pen, a * start_x + b * control_x + t * t * x,
                a * start_y + b * control_y + t * t * y);
    }
}

static void round_at(struct pen *pen, double x, double y, double half_width, double half_height)
{
    const double right = x + half_width;
    const double left = x - half_width;
    const double top = y + half_height;
    const double bottom = y - half_height;
    pen->at[0] = x;
    pen->at[1] = top;
    curve_to(pen, right, top, right, y);
    curve_to(pen, right, bottom, x, bottom);
    curve_to(pen, left, bottom, left, y);
    curve_to(pen, left, top, x, top);
}

/* Does a command of the path with its numbers; a command stays until another letter comes. */
static void do_command(struct pen *pen, char command, const double numbers[4])
{
    if (command == 'M') {
        pen->at[0] = numbers[0];
        pen->at[1] = numbers[1];
    } else if (command == 'L')
        draw_to(pen, numbers[0], numbers[1]);
    else if (command == 'Q')
        curve_to(pen, numbers[0], numbers[1], numbers[2], numbers[3]);
    else
        round_at(pen, numbers[0], numbers[1], numbers[2], numbers[3]);
}

static void draw_letter(struct pen *pen, const char *path)
{
    char command = 'M';
    while (*path != '\0') {
        double numbers[4] = {0};
        if (strchr("MLQO", *path) != NULL)
            command = *path++;
        const int count = command == 'M' || command == 'L' ? 2 : 4;
        for (int i = 0; i < count; ++i) {
            char *end;
            numbers[i] = strtod(path, &end);
            path = end;
        }
        do_command(pen, command, numbers);
        while (*path == ' ')
            ++path;
    }
}

/* The letter of the character at *text, which moves behind it. */
static const struct letter *next_letter(const char **text, const char *end)
{
    const unsigned char byte = (unsigned char)*(*text)++;
    if (byte >= FIRST && byte <= LAST)
        return &letters[byte - FIRST];
    while (*text < end && ((unsigned char)**text & 0xC0) == 0x80)
        ++*text;
    return &unknown;
}

size_t draw_font_run(const char **text, const char **run, int *raised)
{
    const char *start = *text;
    *raised = strncmp(start, "^{", 2) == 0 && strchr(start, '}') != NULL;
    if (*raised) {
        *run = start + 2;
        *text = strchr(start, '}') + 1;
        return (size_t)(*text - 1 - *run);
    }
    const char *end = strstr(*start == '\0' ? start : start + 1, "^{");
    if (end == NULL)
        end = start + strlen(start);
    *run = start;
    *text = end;
    return (size_t)(end - start);
}

/* Draws when `pen` has somebody to take the pieces; the width in any case. */
static double go_through(const char *text, struct pen *pen)
{
    double left = 0.0;
    while (*text != '\0') {
        const char *run;
        int raised;
        const size_t length = draw_font_run(&text, &run, &raised);
        const char *end = run + length;
        pen->step = raised ? grid * DRAW_FONT_RAISED_SIZE : grid;
        pen->baseline = raised ? DRAW_FONT_RAISED_BY : 0.0;
        while (run < end) {
            const struct letter *letter = next_letter(&run, end);
            pen->left = left + 0.5 * gap * pen->step;
            if (pen->take != NULL)
                draw_letter(pen, letter->path);
            left += (letter->width + gap) * pen->step;
        }
    }
    return left;
}

void draw_font_pieces(const char *text, draw_font_piece *take, void *owner)
{
    struct pen pen = {.take = take, .owner = owner};
    (void)go_through(text, &pen);
}

double draw_font_width(const char *text)
{
    struct pen pen = {0};
    return go_through(text, &pen);
}
