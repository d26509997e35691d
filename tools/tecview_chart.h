/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tecview_chart: a chart of series of points with scales, legend and, if wanted, the Pareto front.
 */
#ifndef TOOLS_TECVIEW_CHART_H
#define TOOLS_TECVIEW_CHART_H

#include "draw_page.h"

#include <stdbool.h>
#include <stddef.h>

enum { TECVIEW_NAME = 96 };

struct tecview_series {
    char name[TECVIEW_NAME];
    double (*points)[2]; /* finite, and > 0 on a logarithmic scale */
    size_t count, capacity;
};

struct tecview_chart {
    const char *title;
    const char *names[2]; /* of x and y; "" for none */
    char units[2][40];    /* likewise */
    bool logarithmic[2];
    double ranges[2][2]; /* NaN: that of the points */
    bool lines, marks, legend, pareto;
    char note[200]; /* below the chart */
    struct tecview_series *series;
    size_t series_count;
};

void tecview_chart_draw(const struct tecview_chart *chart, struct draw_page *page);

/*
 * The points that no other beats or equals in both coordinates at once (less is better), from the
 * smallest x on. Orders `points`; the front comes first. Returns how many are on it.
 */
size_t tecview_chart_front(double (*points)[2], size_t count);

#endif
