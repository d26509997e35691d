/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rkpm/points.h"
#include "base/memory.h"
#include "base/threads.h"

#include <math.h>
#include <string.h>

/* --- which points there are --- */

struct list {
    struct quadrature_point *point;
    size_t count, capacity;
};

static void add_point(void *context, const struct quadrature_point *point)
{
    struct list *list = context;
    list->point = memory_grow(list->point, &list->capacity, list->count + 1, sizeof *list->point, "points");
    list->point[list->count++] = *point;
}

/* --- shape functions at them --- */

static void set_point(const struct points *points, size_t i, const struct quadrature_point *point, const struct shape_row *row)
{
    const size_t from = i * (size_t)points->stride, n = (size_t)row->count;
    memcpy(points->neighbour + from, row->node, n * sizeof *row->node);
    memcpy(points->value + from, row->value, n * sizeof(double));
    for (int a = 0; a < points->dimension; a++)
        memcpy(points->gradients + from * (size_t)points->dimension + (size_t)(a * points->stride), row->gradient[a], n * sizeof(double));
    for (int a = 0; a < 3; a++)
        points->x[a][i] = point->x[a];
    points->weights[i] = point->weight;
    points->axis[i] = (int8_t)point->axis;
    points->side[i] = (int8_t)point->side;
    points->is_lowered[i] = row->order < 1;
}

/* Fills all points; how many neighbours the one with most has, where that is more than there is room for. */
static int fill(struct points *points, const struct list *list, struct rkpm_shape *shapes, enum gradient_form gradient)
{
    int most = 0;
#pragma omp parallel for schedule(static) if (list->count >= 200)
    for (size_t i = 0; i < list->count; i++) {
        struct rkpm_shape *shape = &shapes[threads_self()];
        const struct shape_row *row = rkpm_shape_at(shape, list->point[i].x, gradient);
        points->neighbours[i] = row->count;
        if (row->count <= points->stride)
            set_point(points, i, &list->point[i], row);
    }
    for (size_t i = 0; i < list->count; i++)
        most = points->neighbours[i] > most ? points->neighbours[i] : most;
    return most > points->stride ? most : 0;
}

static void open_arrays(struct points *points)
{
    const size_t count = points->count, pairs = count * (size_t)points->stride;
    points->neighbours = memory_array(count, sizeof *points->neighbours, "points");
    points->neighbour = memory_array(pairs, sizeof *points->neighbour, "points");
    points->value = memory_array(pairs, sizeof(double), "points");
    points->gradients = memory_array(pairs * (size_t)points->dimension, sizeof(double), "points");
    points->weights = memory_array(count, sizeof(double), "points");
    for (int a = 0; a < 3; a++)
        points->x[a] = memory_array(count, sizeof(double), "points");
    points->axis = memory_array(count, sizeof *points->axis, "points");
    points->side = memory_array(count, sizeof *points->side, "points");
    points->is_lowered = memory_array(count, sizeof *points->is_lowered, "points");
}

static void close_arrays(const struct points *points)
{
    memory_free(points->neighbours);
    memory_free(points->neighbour);
    memory_free(points->value);
    memory_free(points->gradients);
    memory_free(points->weights);
    for (int a = 0; a < 3; a++)
        memory_free(points->x[a]);
    memory_free(points->axis);
    memory_free(points->side);
    memory_free(points->is_lowered);
}

static void note_lowered(struct points *points)
{
    for (size_t i = points->count; i-- > 0;)
        for (int a = 0; a < 3 && points->is_lowered[i]; a++)
            points->bad[a] = points->x[a][i];
}

/* Which pairs are of a node: counting sort. */
static void sort_uses(struct points *points, size_t nodes)
{
    points->first_use = memory_array(nodes + 2, sizeof *points->first_use, "points");
    for (size_t i = 0; i < points->count; i++)
        for (int k = 0; k < points->neighbours[i]; k++)
            points->first_use[points->neighbour[i * (size_t)points->stride + (size_t)k] + 2]++;
    for (size_t n = 0; n < nodes; n++)
        points->first_use[n + 2] += points->first_use[n + 1];
    points->use = memory_array(points->first_use[nodes + 1], sizeof *points->use, "points");
    for (size_t i = 0; i < points->count; i++)
        for (int k = 0; k < points->neighbours[i]; k++) {
            const size_t pair = i * (size_t)points->stride + (size_t)k;
            points->use[points->first_use[points->neighbour[pair] + 1]++] = pair;
        }
}

static void open_points(struct points *points, const struct rkpm_shape *shape, size_t nodes, int guess, const struct list *list,
                        enum gradient_form gradient)
{
    const int threads = threads_available();
    struct rkpm_shape *shapes = memory_array((size_t)threads, sizeof *shapes, "points");
    *points = (struct points){.dimension = shape->dimension, .count = list->count, .rows = 1, .stride = guess, .is_owner = true};
    for (int t = 0; t < threads; t++)
        rkpm_shape_open_copy(&shapes[t], shape);
    open_arrays(points);
    for (int most = fill(points, list, shapes, gradient); most > 0; most = fill(points, list, shapes, gradient)) {
        close_arrays(points);
        points->stride = most;
        open_arrays(points);
        for (int t = 0; t < threads; t++)
            shapes[t].enlarged = shapes[t].lowered = 0;
    }
    for (int t = 0; t < threads; t++) {
        points->enlarged += shapes[t].enlarged;
        points->lowered += shapes[t].lowered;
        rkpm_shape_close_copy(&shapes[t]);
    }
    memory_free(shapes);
    note_lowered(points);
    sort_uses(points, nodes);
}

/* What a point of a lattice of a spacing has at most. */
static int most_neighbours(const struct rkpm_shape *shape, const double spacing[3])
{
    double product = 1;
    for (int a = 0; a < shape->dimension; a++)
        product *= ceil(2 * shape->support.radius[a] / spacing[a]);
    return (int)product;
}

void points_open_gauss(struct points *points, const struct rkpm_shape *shape, const struct node_box *box, size_t nodes, int n, bool on_faces,
                       enum gradient_form gradient)
{
    struct list list = {0};
    if (on_faces)
        quadrature_faces(box, n, add_point, &list);
    else
        quadrature_inside(box, n, add_point, &list);
    open_points(points, shape, nodes, most_neighbours(shape, box->spacing), &list, gradient);
    memory_free(list.point);
}

void points_open_cell_faces(struct points *points, const struct rkpm_shape *shape, const struct cells *cells, enum gradient_form gradient)
{
    struct list list = {0};
    for (size_t f = 0; f < cells->first[cells->count]; f++) {
        const struct cell_face *face = &cells->face[f];
        if (face->side != 0)
            add_point(&list, &(struct quadrature_point){.x = {face->middle[0], face->middle[1], face->middle[2]},
                                                        .weight = fabs(face->area[face->axis]), .axis = face->axis, .side = face->side});
    }
    open_points(points, shape, cells->count, 16, &list, gradient);
    memory_free(list.point);
}

void points_open_nodes(struct points *points, const struct nodal *nodal)
{
    *points = (struct points){.dimension = nodal->dimension, .count = nodal->count, .rows = nodal->rows, .stride = nodal->stride,
                              .neighbours = nodal->neighbours, .neighbour = nodal->neighbour, .value = nodal->value, .gradients = nodal->gradients,
                              .weights = nodal->weights, .x = {nodal->x[0], nodal->x[1], nodal->x[2]}, .is_lowered = nodal->is_lowered,
                              .enlarged = nodal->enlarged, .lowered = nodal->lowered};
    note_lowered(points);
    sort_uses(points, nodal->count);
}

void points_close(struct points *points)
{
    if (points->is_owner)
        close_arrays(points);
    memory_free(points->first_use);
    memory_free(points->use);
}
