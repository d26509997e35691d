/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rkpm/cells.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

/* Bisectors with nodes up to so many spacings away bound most cells; an edge shorter than this part of the spacing is none. */
static const double REACH = 3, LEAST_EDGE = 1e-9;
enum { CORNERS = 64 };

/* --- polygons --- */

/* Edge i runs from corner i to the next one; cut: by which face of the box it is, 2 axis + (side > 0), or -1. */
struct polygon {
    int count;
    double x[CORNERS][2];
    int cut[CORNERS];
};

static struct polygon whole_box(const double low[2], const double high[2])
{
    return (struct polygon){4, {{low[0], low[1]}, {high[0], low[1]}, {high[0], high[1]}, {low[0], high[1]}}, {2, 1, 3, 0}};
}

/* What of the polygon is nearer to the node than to another one. */
static void clip(struct polygon *polygon, const double node[2], const double other[2])
{
    const double normal[2] = {other[0] - node[0], other[1] - node[1]};
    const double limit = 0.5 * (normal[0] * (node[0] + other[0]) + normal[1] * (node[1] + other[1]));
    struct polygon kept = {0};
    for (int i = 0; i < polygon->count && kept.count < CORNERS - 2; i++) {
        const double *p = polygon->x[i], *q = polygon->x[(i + 1) % polygon->count];
        const double before = normal[0] * p[0] + normal[1] * p[1] - limit, after = normal[0] * q[0] + normal[1] * q[1] - limit;
        if (before <= 0) {
            memcpy(kept.x[kept.count], p, sizeof kept.x[0]);
            kept.cut[kept.count++] = polygon->cut[i];
        }
        if ((before <= 0) == (after <= 0))
            continue;
        const double share = before / (before - after);
        for (int a = 0; a < 2; a++)
            kept.x[kept.count][a] = p[a] + share * (q[a] - p[a]);
        kept.cut[kept.count++] = before <= 0 ? -1 : polygon->cut[i]; /* the cut begins here, or the edge goes on */
    }
    *polygon = kept;
}

/* Cut by the bisectors with all nodes within a number of reaches. */
static struct polygon cut_within(const struct search *search, const struct node_box *box, const double low[2], const double high[2],
                                 double *const x[3], size_t node, double reaches)
{
    const double middle[3] = {x[0][node], x[1][node], 0};
    struct polygon polygon = whole_box(low, high);
    int from[3], to[3], cell[3] = {0};
    int32_t first, end;
    search_range(search, middle, reaches, from, to);
    cell[0] = from[0];
    for (cell[1] = from[1]; cell[1] <= to[1]; cell[1]++) {
        search_span(search, cell, to[0], &first, &end);
        for (int32_t k = first; k < end; k++) {
            const int32_t other = search->node[k];
            const double place[2] = {search->place[0][k], search->place[1][k]};
            if ((size_t)other != node && fabs(place[0] - middle[0]) <= reaches * REACH * box->spacing[0] &&
                fabs(place[1] - middle[1]) <= reaches * REACH * box->spacing[1])
                clip(&polygon, middle, place);
        }
    }
    return polygon;
}

static double farthest_corner(const struct polygon *polygon, const double middle[2])
{
    double farthest = 0;
    for (int i = 0; i < polygon->count; i++)
        farthest = fmax(farthest, hypot(polygon->x[i][0] - middle[0], polygon->x[i][1] - middle[1]));
    return farthest;
}

/* A node as far as twice the farthest corner could still cut it: beside holes between nodes more of them are looked at. */
static struct polygon cell_polygon(const struct search *search, const struct node_box *box, const double low[2], const double high[2],
                                   double *const x[3], size_t node)
{
    const double middle[2] = {x[0][node], x[1][node]}, reach = REACH * fmin(box->spacing[0], box->spacing[1]);
    const double whole = hypot(high[0] - low[0], high[1] - low[1]);
    for (double reaches = 1;; reaches *= 2) {
        const struct polygon polygon = cut_within(search, box, low, high, x, node, reaches);
        if (2 * farthest_corner(&polygon, middle) <= reaches * reach || reaches * reach >= whole)
            return polygon;
    }
}

/* --- faces, volumes and moments --- */

static void add_face(struct cells *cells, size_t node, const struct cell_face *face)
{
    const size_t count = cells->first[node + 1];
    cells->face = memory_grow(cells->face, &cells->face_capacity, count + 1, sizeof *cells->face, "cells");
    cells->face[count] = *face;
    cells->first[node + 1] = count + 1;
    if ((int)(count + 1 - cells->first[node]) > cells->most)
        cells->most = (int)(count + 1 - cells->first[node]);
}

/* Sums over the triangles between the node and the edges: over one of corners at 0, p and q the integral of x^2 is
 * area (p^2 + p q + q^2)/6. */
static void add_polygon(struct cells *cells, size_t node, const double middle[2], const struct polygon *polygon, double least)
{
    for (int i = 0; i < polygon->count; i++) {
        const double *p = polygon->x[i], *q = polygon->x[(i + 1) % polygon->count];
        const double from[2] = {p[0] - middle[0], p[1] - middle[1]}, to[2] = {q[0] - middle[0], q[1] - middle[1]};
        const double triangle = 0.5 * (from[0] * to[1] - from[1] * to[0]);
        const int cut = polygon->cut[i];
        cells->volume[node] += triangle;
        for (int a = 0; a < 2; a++)
            cells->moment[a][node] += triangle * (from[a] * from[a] + from[a] * to[a] + to[a] * to[a]) / 6;
        if (hypot(q[0] - p[0], q[1] - p[1]) < least)
            continue;
        add_face(cells, node,
                 &(struct cell_face){.middle = {0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])}, .area = {q[1] - p[1], p[0] - q[0]}, .corner = {p[0], p[1]},
                                     .axis = cut < 0 ? 0 : cut / 2, .side = cut < 0 ? 0 : cut % 2 == 0 ? -1 : 1});
    }
}

static void open_polygons(struct cells *cells, const struct node_box *box, double *const x[3])
{
    const double reach[3] = {REACH * box->spacing[0], REACH * box->spacing[1], 1};
    const double least = LEAST_EDGE * fmin(box->spacing[0], box->spacing[1]);
    double high[2];
    struct search search;
    for (int a = 0; a < 2; a++)
        high[a] = box->low[a] + box->spacing[a] * (double)(box->numbers[a] - 1);
    search_open(&search, 2, cells->count, x, reach);
    for (size_t node = 0; node < cells->count; node++) {
        const double middle[2] = {x[0][node], x[1][node]};
        const struct polygon polygon = cell_polygon(&search, box, box->low, high, x, node);
        cells->first[node + 1] = cells->first[node];
        add_polygon(cells, node, middle, &polygon, least);
    }
    search_close(&search);
}

/* Boxes from the middle between nodes to the next one. */
static void open_boxes(struct cells *cells, const struct node_box *box, double *const x[3])
{
    for (size_t node = 0; node < cells->count; node++) {
        double low[3] = {0}, high[3] = {0};
        bool is_end[3][2] = {{false}};
        size_t rest = node;
        cells->volume[node] = 1;
        for (int a = 0; a < cells->dimension; a++, rest /= (size_t)box->numbers[a - 1]) {
            const long place = (long)(rest % (size_t)box->numbers[a]);
            is_end[a][0] = place == 0;
            is_end[a][1] = place + 1 == box->numbers[a];
            low[a] = is_end[a][0] ? 0 : -0.5 * box->spacing[a];
            high[a] = is_end[a][1] ? 0 : 0.5 * box->spacing[a];
            cells->volume[node] *= high[a] - low[a];
        }
        cells->first[node + 1] = cells->first[node];
        for (int a = 0; a < cells->dimension; a++) {
            const double width = high[a] - low[a];
            cells->moment[a][node] = cells->volume[node] / width * (high[a] * high[a] * high[a] - low[a] * low[a] * low[a]) / 3;
            for (int side = 0; side < 2; side++) {
                struct cell_face face = {.axis = a, .side = is_end[a][side] ? 2 * side - 1 : 0};
                for (int b = 0; b < cells->dimension; b++)
                    face.middle[b] = x[b][node] + (b != a ? 0.5 * (low[b] + high[b]) : side == 0 ? low[b] : high[b]);
                face.area[a] = (2 * side - 1) * cells->volume[node] / width;
                add_face(cells, node, &face);
            }
        }
    }
}

void cells_open(struct cells *cells, const struct node_box *box, size_t count, double *const x[3])
{
    *cells = (struct cells){.dimension = box->dimension, .count = count};
    cells->volume = memory_array(count, sizeof(double), "cells");
    for (int a = 0; a < box->dimension; a++)
        cells->moment[a] = memory_array(count, sizeof(double), "cells");
    cells->first = memory_array(count + 1, sizeof *cells->first, "cells");
    if (box->dimension == 2)
        open_polygons(cells, box, x);
    else
        open_boxes(cells, box, x);
}

void cells_close(struct cells *cells)
{
    memory_free(cells->volume);
    for (int a = 0; a < 3; a++)
        memory_free(cells->moment[a]);
    memory_free(cells->first);
    memory_free(cells->face);
}
