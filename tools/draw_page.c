/* SPDX-License-Identifier: GPL-3.0-or-later */
/* draw_page: see draw_page.h. */
#define _POSIX_C_SOURCE 200809L

#include "draw_page.h"
#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/* Points of a curve that are nearer than this to the last one drawn are left out. */
static const double invisible = 0.25;

const struct draw_backend *draw_page_backend(const char *path)
{
    static const struct draw_backend *const backends[] = {&draw_raster, &draw_svg};
    const char *suffix = strrchr(path, '.');
    for (size_t i = 0; suffix != NULL && i < sizeof backends / sizeof *backends; ++i)
        if (strcasecmp(suffix + 1, backends[i]->suffix) == 0)
            return backends[i];
    return NULL;
}

void draw_page_open(struct draw_page *page, const struct draw_backend *backend, int width,
                    int height)
{
    *page = (struct draw_page){.backend = backend, .width = width, .height = height};
    backend->open(page);
}

void draw_page_close(struct draw_page *page)
{
    page->backend->close(page);
}

bool draw_page_write(struct draw_page *page, const char *path)
{
    struct draw_bytes file = {0};
    page->backend->file(page, &file);
    FILE *stream = fopen(path, "wb");
    bool done = stream != NULL;
    if (done) {
        done = fwrite(file.data, 1, file.count, stream) == file.count;
        done = fclose(stream) == 0 && done;
    }
    draw_bytes_free(&file);
    return done;
}

void draw_page_line(struct draw_page *page, double x0, double y0, double x1, double y1,
                    const struct draw_pen *pen)
{
    const double points[2][2] = {{x0, y0}, {x1, y1}};
    page->backend->line(page, points, 2, pen);
}

void draw_page_curve(struct draw_page *page, const double (*points)[2], size_t count,
                     const struct draw_pen *pen)
{
    double(*kept)[2] = memory_array(count, sizeof *kept, "a curve");
    size_t kept_count = 0;
    for (size_t i = 0; i < count; ++i)
        if (i == 0 || i == count - 1 ||
            hypot(points[i][0] - kept[kept_count - 1][0], points[i][1] - kept[kept_count - 1][1]) >=
                invisible) {
            kept[kept_count][0] = points[i][0];
            kept[kept_count++][1] = points[i][1];
        }
    if (kept_count > 0)
        page->backend->line(page, (const double(*)[2])kept, kept_count, pen);
    memory_free(kept);
}

void draw_page_fill(struct draw_page *page, const struct draw_box *box, struct draw_colour colour,
                    double opacity)
{
    const double corners[4][2] = {{box->left, box->top},
                                  {box->right, box->top},
                                  {box->right, box->bottom},
                                  {box->left, box->bottom}};
    page->backend->polygon(page, corners, 4, colour, opacity);
}

void draw_page_frame(struct draw_page *page, const struct draw_box *box, const struct draw_pen *pen)
{
    const double corners[5][2] = {{box->left, box->top},
                                  {box->right, box->top},
                                  {box->right, box->bottom},
                                  {box->left, box->bottom},
                                  {box->left, box->top}};
    page->backend->line(page, corners, 5, pen);
}

void draw_page_mark(struct draw_page *page, enum draw_shape shape, const double centre[2],
                    double radius, struct draw_colour colour)
{
    static const struct {
        size_t count;
        double corners[4][2];
    } shapes[DRAW_SHAPE_COUNT] = {
        [DRAW_SQUARE] = {4, {{-0.88, -0.88}, {0.88, -0.88}, {0.88, 0.88}, {-0.88, 0.88}}},
        [DRAW_TRIANGLE] = {3, {{0.0, -1.25}, {1.1, 0.75}, {-1.1, 0.75}}},
        [DRAW_DIAMOND] = {4, {{0.0, -1.25}, {1.25, 0.0}, {0.0, 1.25}, {-1.25, 0.0}}},
    };
    double corners[4][2];
    for (size_t i = 0; i < shapes[shape].count; ++i)
        for (int axis = 0; axis < 2; ++axis)
            corners[i][axis] = centre[axis] + radius * shapes[shape].corners[i][axis];
    if (shape == DRAW_DISC)
        page->backend->disc(page, centre, radius, colour);
    else
        page->backend->polygon(page, (const double(*)[2])corners, shapes[shape].count, colour, 1.0);
}

void draw_page_text(struct draw_page *page, double x, double y, const char *text,
                    const struct draw_text *style)
{
    if (*text != '\0')
        page->backend->text(page, x, y, text, style);
}

void draw_page_clip(struct draw_page *page, const struct draw_box *box)
{
    page->backend->clip(page, box);
}
