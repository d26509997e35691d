/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tecview: what the command line asks for. */
#ifndef TOOLS_TECVIEW_H
#define TOOLS_TECVIEW_H

#include "draw_page.h"

#include <stdbool.h>
#include <stddef.h>

struct tecview_condition {
    const char *variable;
    double low, high;
};

/* Texts that are not given are NULL, numbers NaN. */
struct tecview_request {
    const char **paths;
    size_t path_count;

    /* of both commands */
    const char *out, *zone, *title, *unit;
    double range[2]; /* of the values, or of y */
    double size[2];  /* points of the screen, 0 for the command's own */

    /* of points */
    const char *of, *label, *length_unit, *from, *section;
    const char *deform[2]; /* names of three displacements, scale */
    double spacing;
    bool both;
    struct tecview_condition *conditions;
    size_t condition_count;

    /* of curve */
    const char *x, *y, *log, *x_label, *y_label, *legend, *group;
    double x_range[2];
    bool marks, pareto;
};

/* Says "tecview: error: what 'text'" on standard error; false. */
bool tecview_complain(const char *what, const char *text);

/* Opens the page of the request, of the given size unless it has its own. */
bool tecview_open_page(const struct tecview_request *request, int width, int height,
                       struct draw_page *page);

/* Writes the page; false after a message. */
bool tecview_write_page(const struct tecview_request *request, struct draw_page *page);

/* Draws the file's points; false after a message. */
bool tecview_points(const struct tecview_request *request);

/* Draws lines or points of columns against another; false after a message. */
bool tecview_curve(const struct tecview_request *request);

#endif
