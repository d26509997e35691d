/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rkpm/held.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

/* A node nearer to a side than this part of the spacing lies on it. */
static const double ON_SIDE = 1e-9;

void held_open(struct held *held, size_t nodes)
{
    *held = (struct held){.nodes = nodes};
    held->of_node = memory_array(nodes, sizeof *held->of_node, "held nodes");
    for (size_t i = 0; i < nodes; i++)
        held->of_node[i] = -1;
}

void held_close(struct held *held)
{
    memory_free(held->of_node);
    memory_free(held->node);
    memory_free(held->term);
}

/* The row of a node, a new one where it has none. */
static int32_t row_of(struct held *held, size_t node)
{
    if (held->of_node[node] < 0) {
        held->node = memory_grow(held->node, &held->node_capacity, (size_t)held->rows + 1, sizeof *held->node, "held nodes");
        held->node[held->rows] = (int32_t)node;
        held->of_node[node] = held->rows++;
    }
    return held->of_node[node];
}

static void add_term(struct held *held, int32_t row, int32_t node, double value)
{
    held->term = memory_grow(held->term, &held->term_capacity, held->terms + 1, sizeof *held->term, "held nodes");
    held->term[held->terms++] = (struct held_term){row, node, value};
}

/* --- nodes --- */

static bool is_on_side(const struct node_box *box, const bool sides[6], const double x[3])
{
    bool is_on = false;
    for (int a = 0; a < box->dimension; a++) {
        const double high = box->low[a] + box->spacing[a] * (double)(box->numbers[a] - 1), near = ON_SIDE * box->spacing[a];
        is_on = is_on || (sides[2 * a] && fabs(x[a] - box->low[a]) <= near) || (sides[2 * a + 1] && fabs(x[a] - high) <= near);
    }
    return is_on;
}

void held_add_nodes(struct held *held, const struct node_box *box, const bool sides[6], double *const *x, const struct rkpm_shape *shape)
{
    struct rkpm_shape own;
    rkpm_shape_open_copy(&own, shape);
    for (size_t node = 0; node < held->nodes; node++) {
        const double place[3] = {x[0][node], x[1][node], x[2][node]};
        if (!is_on_side(box, sides, place))
            continue;
        const struct shape_row *row = rkpm_shape_at(&own, place, GRADIENT_NONE);
        for (int k = 0; k < row->count; k++)
            add_term(held, row_of(held, node), row->node[k], row->value[k]);
    }
    rkpm_shape_close_copy(&own);
}

void held_give_nodes(const struct held *held, double *const *x, int dimension, held_displacement *displacement, void *context, double *given)
{
    for (int32_t row = 0; row < held->rows; row++) {
        const int32_t node = held->node[row];
        double u[3];
        displacement(context, (const double[3]){x[0][node], x[1][node], x[2][node]}, u);
        memcpy(given + (size_t)row * (size_t)dimension, u, (size_t)dimension * sizeof *u);
    }
}

/* --- hats --- */

/* The hat at a point of a corner of the face's segment that it lies on, and its node; 0 for corners off the face. */
static double hat_at(const struct node_box *box, const struct points *faces, size_t point, int corner, size_t *node)
{
    double hat = 1;
    size_t stride = 1;
    *node = 0;
    for (int a = 0; a < box->dimension; a++) {
        const int up = corner >> a & 1;
        const double place = (faces->x[a][point] - box->low[a]) / box->spacing[a];
        const long cell = (long)fmin(fmax(floor(place), 0), (double)box->numbers[a] - 2);
        hat *= a == faces->axis[point] ? up == (faces->side[point] > 0) : up ? place - (double)cell : 1 - place + (double)cell;
        *node += stride * (size_t)(cell + up);
        stride *= (size_t)box->numbers[a];
    }
    return hat;
}

void held_add_hats(struct held *held, const struct node_box *box, const struct points *faces, const bool *is_held)
{
    for (size_t i = 0; i < faces->count; i++)
        for (int corner = 0; corner < 1 << box->dimension && is_held[i]; corner++) {
            size_t node;
            const double hat = points_weight(faces, i, 0) * hat_at(box, faces, i, corner, &node);
            for (int k = 0; k < faces->neighbours[i] && hat != 0; k++) {
                const size_t pair = i * (size_t)faces->stride + (size_t)k;
                add_term(held, row_of(held, node), faces->neighbour[pair], hat * faces->value[pair]);
            }
        }
}

void held_give_hats(const struct held *held, const struct node_box *box, const struct points *faces, const bool *is_held, held_displacement *displacement,
                    void *context, double *given)
{
    const int d = box->dimension;
    memset(given, 0, (size_t)held->rows * (size_t)d * sizeof *given);
    for (size_t i = 0; i < faces->count; i++)
        for (int corner = 0; corner < 1 << d && is_held[i]; corner++) {
            size_t node;
            double u[3];
            const double hat = points_weight(faces, i, 0) * hat_at(box, faces, i, corner, &node);
            displacement(context, (const double[3]){faces->x[0][i], faces->x[1][i], faces->x[2][i]}, u);
            for (int a = 0; a < d && hat != 0; a++)
                given[(size_t)held->of_node[node] * (size_t)d + (size_t)a] += hat * u[a];
        }
}
