/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tractions on the faces of bodies (load face).
 *
 * The outermost layer of a body's particles carries the traction times its initial area. In the
 * cell of such a particle the outer node plane gets the part that the cell's own particles can
 * balance under uniform stress, (sum of their volumes) / (cell size * sum of loaded areas), and the
 * inner plane the rest; along the face the nodes share by the shape function at the particle. A
 * uniform stress t then satisfies every nodal equation exactly, wherever the face is in its cell. Where
 * the body ends inside the cell on the other side too, the place of the face itself tells the share. */
#include "base/memory.h"
#include "mpm/mpm.h"

#include <float.h>
#include <math.h>

/* A particle of the face in this step. */
struct face_point {
    int32_t id;
    int32_t block; /* -1: it has no cell any more */
    int cell;
    double area;
    double outer; /* share of the outer node plane */
    double local[3];
    double half_spacing; /* from the particle to the face, in cells */
};

struct face_load {
    int axis, side;
    int32_t body;
    double traction[3];
    struct face_point *points;
    size_t n_points;
    double *area_of_id; /* loaded area of each particle of the body, 0 inside */
    long first_id;
};

/* Fills in the outermost layer of the body: its particles and their areas. */
static void find_layer(const struct mpm *mpm, struct face_load *face, const struct scene_body *body)
{
    const struct store *store = mpm->store;
    const double *x = store->real[COLUMN_POSITION][face->axis];
    double outermost = -DBL_MAX;
    for (long id = body->first; id < body->first + body->count; id++)
        outermost = fmax(outermost, face->side * x[store->index_of_id[id]]);
    face->points = memory_array((size_t)body->count, sizeof *face->points, "loaded faces");
    face->area_of_id = memory_array((size_t)body->count, sizeof *face->area_of_id, "loaded faces");
    face->first_id = body->first;
    for (long id = body->first; id < body->first + body->count; id++) {
        int32_t p = store->index_of_id[id];
        double spacing = body->generator.spacing > 0 ? body->generator.spacing : cbrt(store->real[COLUMN_VOLUME][0][p]);
        if (face->side * x[p] < outermost - 0.25 * spacing)
            continue;
        face->points[face->n_points++] = (struct face_point){
            .id = (int32_t)id, .area = spacing * spacing, .half_spacing = 0.5 * spacing / mpm->cells->frame.size};
        face->area_of_id[id - body->first] = spacing * spacing;
    }
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
        volume += store->real[COLUMN_VOLUME][0][p];
        area += face->area_of_id[store->integer[COLUMN_ID][p] - face->first_id];
    }
    return volume / (mpm->cells->frame.size * area);
}

/* Finds the cell, local coordinates and share of a point. */
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
        point->local[a] = (mpm->store->real[COLUMN_POSITION][a][p] - low) / frame->size;
    }
    double place = point->local[face->axis] + face->side * point->half_spacing;
    double from_inner = face->side > 0 ? place : 1 - place;
    point->outer = outer_share(mpm, face, block, point->cell);
    if (from_inner - point->outer > point->half_spacing) /* the cell is not filled down to its inner plane */
        point->outer = from_inner;
}

/* Weight of corner i of the point's cell. */
static double corner_weight(const struct face_load *face, const struct face_point *point, int corner)
{
    double weight = 1;
    for (int a = 0; a < 3; a++) {
        int is_high = corner >> a & 1;
        double along = is_high ? point->local[a] : 1 - point->local[a];
        double across = is_high == (face->side > 0) ? point->outer : 1 - point->outer;
        weight *= a == face->axis ? across : along;
    }
    return weight;
}

/* The node at a corner of the point's cell: its block, and its place in the block. */
static int32_t corner_node(const struct mpm *mpm, const struct face_point *point, int corner, int *node)
{
    int index = 0, neighbour = 1 + 3 + 9, stride = 1, step = 1;
    for (int a = 0; a < 3; a++) {
        int i = ((point->cell >> (2 * a)) & (BLOCK_EDGE - 1)) + (corner >> a & 1);
        neighbour += i == BLOCK_EDGE ? step : 0;
        index += i == BLOCK_EDGE ? 0 : i * stride;
        stride *= BLOCK_EDGE;
        step *= 3;
    }
    *node = index;
    return mpm->cells->blocks[point->block].neighbour[neighbour];
}

void faces_scatter(struct mpm *mpm, int force_field)
{
    for (size_t f = 0; f < mpm->n_faces; f++) {
        struct face_load *face = &mpm->faces[f];
        for (size_t i = 0; i < face->n_points; i++) {
            struct face_point *point = &face->points[i];
            locate(mpm, face, point);
            if (point->block < 0)
                continue;
            const int edge = mpm->grid->layout.edge, row = mpm->grid->layout.row;
            for (int corner = 0; corner < 8; corner++) {
                int node = grid_patch_corner(point->cell, row, edge, mpm->grid->layout.origin) + (corner & 1)
                         + row * ((corner >> 1 & 1) + edge * (corner >> 2));
                double weight = mpm->load_factor * corner_weight(face, point, corner) * point->area;
                for (int a = 0; a < 3; a++)
                    grid_patch(mpm->grid, point->block, force_field + a)[node] += weight * face->traction[a];
            }
        }
    }
}

double faces_work(const struct mpm *mpm)
{
    double work = 0;
    for (size_t f = 0; f < mpm->n_faces; f++) {
        const struct face_load *face = &mpm->faces[f];
        for (size_t i = 0; i < face->n_points; i++) {
            const struct face_point *point = &face->points[i];
            for (int corner = 0; corner < 8 && point->block >= 0; corner++) {
                int node;
                int32_t block = corner_node(mpm, point, corner, &node);
                double weight = mpm->load_factor * corner_weight(face, point, corner) * point->area;
                for (int a = 0; a < 3; a++)
                    work += weight * face->traction[a] * grid_field(mpm->grid, block, NODE_MOMENTUM + a)[node];
            }
        }
    }
    return work * mpm->time_step;
}
