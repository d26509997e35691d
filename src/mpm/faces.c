/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tractions on the faces of bodies (load face).
 *
 * The outermost layer of a body's particles carries the traction times its initial area, given to the nodes so
 * that a uniform stress of that traction is in equilibrium: a node gets what the stresses of the layers take from
 * it, the sum of their volumes times gradients. Along the face the nodes share by the shape function at the
 * particle.
 *
 * Linear shapes: in the cell of such a particle the outer node plane gets the part that the cell's own particles
 * can balance under uniform stress, (sum of their volumes) / (cell size * sum of loaded areas), and the inner
 * plane the rest. A uniform stress t then satisfies every nodal equation exactly, wherever the face is in its
 * cell. Where the body ends inside the cell on the other side too, the place of the face itself tells the share.
 *
 * gimp and bimp: their functions are hats averaged over a window of half width l, with the slope
 * (hat(r + l) - hat(r - l)) / 2l. The sum over layers at the spacing h, h slope(r) + h slope(r - h) + ..., is the
 * hat at the face itself where windows touch (h = 2l); the mean of the hat at m points inside the face where m
 * layers share a window; and otherwise what closes with the body's own sum. Deep inside it vanishes for
 * spacings of one n-th of a cell, and for touching windows. sgmp has the same sum with l = 1/2: a node's force
 * is the difference of the centres beside it, half a cell away (spec 9.3). The layers are taken where they were
 * at the start: in a stretched body the sum is off by the strain. */
#include "base/memory.h"
#include "mpm/hat.h"
#include "mpm/mpm.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { MOST_NODES = 4 }; /* along an axis, that a point's load reaches */

/* A particle of the face in this step. */
struct face_point {
    int32_t id;
    int32_t block; /* -1: it has no cell any more */
    int cell;
    double area;
    double local[3];
    double half_spacing; /* from the particle to the face, in cells */
    double weight[3][MOST_NODES]; /* per axis and node, from the cell's low corner or (wide shapes) the node below it */
};

struct face_load {
    int axis, side;
    int32_t body;
    int nodes; /* along an axis: 2, or 4 with wide shapes, which begin a node lower */
    bool is_staggered;
    double half_width, middle; /* of wide shapes, in cells: of the window, and from the node to the function's middle */
    double traction[3];
    struct face_point *points;
    size_t n_points;
    double *area_of_id; /* loaded area of each particle of the body, 0 inside */
    long first_id;
};

static double spacing_at(const struct mpm *mpm, const struct scene_body *body, int32_t p)
{
    return body->generator.spacing > 0 ? body->generator.spacing : cbrt(mpm->store->real[COLUMN_VOLUME][0][p]);
}

/* Marks the outermost layer of the body by its particles' areas; returns how many they are. */
static size_t mark_layer(const struct mpm *mpm, struct face_load *face, const struct scene_body *body)
{
    const struct store *store = mpm->store;
    const double *x = store->real[mpm->place][face->axis];
    double outermost = -DBL_MAX;
    size_t count = 0;
    for (long id = body->first; id < body->first + body->count; id++)
        outermost = fmax(outermost, face->side * x[store->index_of_id[id]]);
    for (long id = body->first; id < body->first + body->count; id++) {
        int32_t p = store->index_of_id[id];
        double spacing = spacing_at(mpm, body, p);
        if (face->side * x[p] < outermost - 0.25 * spacing)
            continue;
        face->area_of_id[id - body->first] = spacing * spacing;
        count++;
    }
    return count;
}

/* Fills in the outermost layer of the body. */
static void find_layer(const struct mpm *mpm, struct face_load *face, const struct scene_body *body)
{
    face->first_id = body->first;
    face->area_of_id = memory_array((size_t)body->count, sizeof *face->area_of_id, "loaded faces");
    face->points = memory_array(mark_layer(mpm, face, body), sizeof *face->points, "loaded faces");
    for (long id = body->first; id < body->first + body->count; id++) {
        const double area = face->area_of_id[id - body->first];
        if (area == 0)
            continue;
        double spacing = spacing_at(mpm, body, mpm->store->index_of_id[id]);
        face->points[face->n_points++] = (struct face_point){
            .id = (int32_t)id, .area = area, .half_spacing = 0.5 * spacing / mpm->cells->frame.size};
    }
}

/* The shape functions' widths. */
static void find_shape(const struct mpm *mpm, struct face_load *face)
{
    face->nodes = mpm->shape == &shape_linear ? 2 : MOST_NODES;
    face->half_width = mpm->shape == &shape_gimp ? HAT_FIXED_HALF_WIDTH
                     : mpm->shape == &shape_gimp_own ? mpm->bodies[face->body].half_width : 0.5;
    face->middle = mpm->shape == &shape_bimp ? 0.5 : 0;
    face->is_staggered = mpm->shape == &shape_staggered;
}

void faces_open(struct mpm *mpm)
{
    const struct scene *scene = mpm->scene;
    mpm->faces = memory_array(scene->n_loads, sizeof *mpm->faces, "loaded faces");
    for (size_t i = 0; i < scene->n_loads; i++) {
        const struct scene_load *load = &scene->loads[i];
        if (load->kind != LOAD_FACE)
            continue;
        struct face_load *face = &mpm->faces[mpm->n_faces++];
        *face = (struct face_load){.axis = load->axis, .side = load->side, .body = (int32_t)load->target};
        for (int a = 0; a < 3; a++)
            face->traction[a] = load->value[a];
        find_shape(mpm, face);
        find_layer(mpm, face, &scene->bodies[load->target]);
    }
}

void faces_close(struct mpm *mpm)
{
    for (size_t f = 0; f < mpm->n_faces; f++) {
        memory_free(mpm->faces[f].points);
        memory_free(mpm->faces[f].area_of_id);
    }
    memory_free(mpm->faces);
}

/* Volume and loaded area of the face's body in a cell give the share of the outer plane. */
static double outer_share(const struct mpm *mpm, const struct face_load *face, const struct cell_block *block, int cell)
{
    const struct store *store = mpm->store;
    double volume = 0, area = 0;
    for (int32_t k = block->cell_first[cell]; k < block->cell_first[cell + 1]; k++) {
        int32_t p = mpm->cells->order[block->first + k];
        if (store->integer[COLUMN_BODY][p] != face->body)
            continue;
        volume += smoothing_volume(mpm, (size_t)p);
        area += face->area_of_id[store->integer[COLUMN_ID][p] - face->first_id];
    }
    return volume / (mpm->cells->frame.size * area);
}

/* Linear shapes: weights of the cell's two node planes. */
static void find_linear_weights(const struct mpm *mpm, const struct face_load *face, struct face_point *point)
{
    const double place = point->local[face->axis] + face->side * point->half_spacing;
    const double from_inner = face->side > 0 ? place : 1 - place;
    double outer = outer_share(mpm, face, &mpm->cells->blocks[point->block], point->cell);
    if (from_inner - outer > point->half_spacing) /* the cell is not filled down to its inner plane */
        outer = from_inner;
    for (int a = 0; a < 3; a++) {
        point->weight[a][0] = 1 - point->local[a];
        point->weight[a][1] = point->local[a];
    }
    point->weight[face->axis][face->side > 0] = outer;
    point->weight[face->axis][face->side < 0] = 1 - outer;
}

/* Sum of spacing times slope over a layer at distance r outside the node's middle and all those inside it. */
static double layers_slope(double r, double spacing, double half_width)
{
    double sum = 0;
    for (; r > -1 - half_width; r -= spacing) {
        double weight, slope;
        hat_averaged(r, half_width, &weight, &slope);
        sum += spacing * slope;
    }
    return sum;
}

/* Weight of a node along the face: the shape function's, or with the staggered grid the mean of the two centres'
 * around it. */
static double side_weight(const struct face_load *face, double r)
{
    double weight, slope;
    if (face->is_staggered)
        return 0.5 * (fmax(0, 1 - fabs(r + 0.5)) + fmax(0, 1 - fabs(r - 0.5)));
    hat_averaged(r, face->half_width, &weight, &slope);
    return weight;
}

/* Wide shapes. Points more than a cell apart have no body between them: a cell is as far as they reach. */
static void find_wide_weights(const struct face_load *face, struct face_point *point)
{
    const double spacing = fmin(1, 2 * point->half_spacing);
    double sum = 0;
    for (int a = 0; a < 3; a++)
        for (int n = 0; n < MOST_NODES; n++) {
            double r = point->local[a] - (n - 1 + face->middle);
            if (a != face->axis)
                point->weight[a][n] = side_weight(face, r);
            else
                sum += point->weight[a][n] = layers_slope(face->side * r, spacing, face->half_width);
        }
    for (int n = 0; n < MOST_NODES; n++) /* the whole traction, for spacings too that don't fit the cell */
        point->weight[face->axis][n] /= sum;
}

/* Finds the cell, local coordinates and weights of a point. */
static void locate(const struct mpm *mpm, const struct face_load *face, struct face_point *point)
{
    const struct cell_frame *frame = &mpm->cells->frame;
    int32_t p = mpm->store->index_of_id[point->id];
    int32_t component = mpm->component_of_body[face->body];
    point->block = cell_list_block_of(mpm->cells, p, mpm->store, component);
    if (point->block < 0)
        return;
    const struct cell_block *block = &mpm->cells->blocks[point->block];
    point->cell = mpm->cells->cell[p];
    for (int a = 0; a < 3; a++) {
        int in_block = (point->cell >> (2 * a)) & (BLOCK_EDGE - 1);
        double low = frame->low[a] + (double)(block->at[a] * BLOCK_EDGE + in_block) * frame->size;
        point->local[a] = (mpm->store->real[mpm->place][a][p] - low) / frame->size;
        if (face->is_staggered && a != face->axis)
            point->local[a] += staggered_shift(mpm, a, mpm->store->real[mpm->place][a][p]);
    }
    if (face->nodes == MOST_NODES)
        find_wide_weights(face, point);
    else
        find_linear_weights(mpm, face, point);
}

/* Node n of those that the point reaches, along each axis from the cell's low corner; its weight. */
static double node_weight(const struct face_load *face, const struct face_point *point, int n, int offset[3])
{
    double weight = 1;
    for (int a = 0; a < 3; a++, n /= face->nodes) {
        offset[a] = n % face->nodes - (face->nodes == MOST_NODES);
        weight *= point->weight[a][n % face->nodes];
    }
    return weight;
}

/* The block of a node so far from the low corner of the point's cell, or -1, and its place in the block. */
static int32_t find_node(const struct mpm *mpm, const struct face_point *point, const int offset[3], int *node)
{
    int index = 0, neighbour = 1 + 3 + 9, stride = 1, step = 1;
    for (int a = 0; a < 3; a++) {
        int i = ((point->cell >> (2 * a)) & (BLOCK_EDGE - 1)) + offset[a], blocks = i < 0 ? -1 : i >= BLOCK_EDGE;
        neighbour += blocks * step;
        index += (i - blocks * BLOCK_EDGE) * stride;
        stride *= BLOCK_EDGE;
        step *= 3;
    }
    *node = index;
    return mpm->cells->blocks[point->block].neighbour[neighbour];
}

/* Gives a point's load to the patch of its block. */
static void scatter_point(struct mpm *mpm, const struct face_load *face, const struct face_point *point, int force_field)
{
    const int edge = mpm->grid->layout.edge, row = mpm->grid->layout.row;
    const int corner = grid_patch_corner(point->cell, row, edge, mpm->grid->layout.origin);
    for (int n = 0; n < face->nodes * face->nodes * face->nodes; n++) {
        int offset[3];
        double weight = mpm->load_factor * node_weight(face, point, n, offset) * point->area;
        int node = corner + offset[0] + row * (offset[1] + edge * offset[2]);
        for (int a = 0; a < 3; a++)
            grid_patch(mpm->grid, point->block, force_field + a)[node] += weight * face->traction[a];
    }
}

/* With the staggered grid only faces give to the nodes. */
static void clear_patches(struct mpm *mpm, int force_field)
{
    for (int32_t b = 0; b < mpm->cells->active && mpm->n_faces > 0; b++)
        memset(grid_patch(mpm->grid, b, force_field), 0, 3 * (size_t)mpm->grid->layout.nodes * sizeof(double));
}

void faces_scatter(struct mpm *mpm, int force_field)
{
    if (mpm->centres)
        clear_patches(mpm, force_field);
    for (size_t f = 0; f < mpm->n_faces; f++) {
        struct face_load *face = &mpm->faces[f];
        for (size_t i = 0; i < face->n_points; i++) {
            locate(mpm, face, &face->points[i]);
            if (face->points[i].block >= 0)
                scatter_point(mpm, face, &face->points[i], force_field);
        }
    }
}

/* Adds the power of a point's load with the velocities of the nodes. */
static void add_power(const struct mpm *mpm, const struct face_load *face, const struct face_point *point, double *power)
{
    for (int n = 0; n < face->nodes * face->nodes * face->nodes; n++) {
        int offset[3], node;
        double weight = mpm->load_factor * node_weight(face, point, n, offset) * point->area;
        int32_t block = find_node(mpm, point, offset, &node);
        for (int a = 0; a < 3 && block >= 0; a++)
            *power += weight * face->traction[a] * grid_field(mpm->grid, block, NODE_MOMENTUM + a)[node];
    }
}

double faces_work(const struct mpm *mpm)
{
    double power = 0;
    for (size_t f = 0; f < mpm->n_faces; f++)
        for (size_t i = 0; i < mpm->faces[f].n_points; i++)
            if (mpm->faces[f].points[i].block >= 0)
                add_power(mpm, &mpm->faces[f], &mpm->faces[f].points[i], &power);
    return power * mpm->time_step;
}
