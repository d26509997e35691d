/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mpm/rigid.h"
#include "base/memory.h"
#include "base/symmetric.h"

#include <math.h>
#include <string.h>

enum { MOTIONS = SYMMETRIC_LARGEST };

/* A held direction counts 1 in its own translation; two that are far less than a cell apart, against the size of
 * the part, still hold a rotation. Below this a motion is not held. */
static const double LEAST_HOLD = 1e-10;

struct rigid_part {
    double mass, centre[3], radius; /* root mean square distance from the centre */
    double moment[3], held[MOTIONS][MOTIONS], inertia[MOTIONS][MOTIONS];
    int n_motions;
    double motion[MOTIONS][MOTIONS]; /* per free motion: translation, and rotation times radius; orthonormal by mass */
    double share[MOTIONS];           /* of each in a vector, while it is taken out */
    int32_t body;
};

void rigid_close(struct rigid *rigid)
{
    memory_free(rigid->part_of_node);
    memory_free(rigid->parts);
}

/* --- connected nodes --- */

static int32_t root_of(int32_t *link, int32_t i)
{
    while (link[i] != i) {
        link[i] = link[link[i]];
        i = link[i];
    }
    return i;
}

/* The lower number becomes the root. */
static void join(int32_t *link, int32_t i, int32_t j)
{
    i = root_of(link, i);
    j = root_of(link, j);
    if (i < j)
        link[j] = i;
    else
        link[i] = j;
}

/* Number of the node at corner i of a cell. */
static int32_t corner_node(const struct cell_block *block, int cell, int corner, int32_t b)
{
    int node = 0, neighbour = 13, stride = 1, step = 1;
    for (int a = 0; a < 3; a++) {
        int i = (cell >> (2 * a) & (BLOCK_EDGE - 1)) + (corner >> a & 1);
        neighbour += i == BLOCK_EDGE ? step : 0;
        node += i == BLOCK_EDGE ? 0 : i * stride;
        stride *= BLOCK_EDGE;
        step *= 3;
    }
    int32_t owner = neighbour == 13 ? b : block->neighbour[neighbour];
    return owner < 0 ? -1 : owner * BLOCK_CELLS + node;
}

/* Joins the nodes around each cell with particles; nodes without are left -1. */
static void connect(struct rigid *rigid, const struct mpm *mpm)
{
    const struct cell_list *cells = mpm->cells;
    const int32_t nodes = cells->n_blocks * BLOCK_CELLS;
    int32_t *link = rigid->part_of_node;
    for (int32_t i = 0; i < nodes; i++)
        link[i] = -1;
    for (int32_t b = 0; b < cells->active; b++)
        for (int c = 0; c < BLOCK_CELLS; c++) {
            const struct cell_block *block = &cells->blocks[b];
            if (block->cell_first[c] == block->cell_first[c + 1])
                continue;
            int32_t first = corner_node(block, c, 0, b);
            for (int corner = 0; corner < 8; corner++) {
                int32_t other = corner_node(block, c, corner, b);
                if (other >= 0 && link[other] < 0)
                    link[other] = other;
                if (other >= 0)
                    join(link, first, other);
            }
        }
}

/* Gives the parts numbers in the order of their first nodes, which are the roots. */
static void number_parts(struct rigid *rigid, const struct mpm *mpm)
{
    const int32_t nodes = mpm->cells->n_blocks * BLOCK_CELLS;
    int32_t *link = rigid->part_of_node;
    for (int32_t i = 0; i < nodes; i++)
        link[i] = link[i] < 0 ? -1 : root_of(link, i);
    rigid->n_parts = 0;
    for (int32_t i = 0; i < nodes; i++) /* a root comes before the others and has its number by then */
        if (link[i] >= 0)
            link[i] = link[i] == i ? rigid->n_parts++ : link[link[i]];
}

/* --- motions --- */

/* Displacements along axis a at a place from the centre under the six unit motions. */
static void motions_at(const struct rigid_part *part, const double way[3], int a, double row[MOTIONS])
{
    const int next = (a + 1) % 3, last = (a + 2) % 3;
    const double scale = part->radius > 0 ? 1 / part->radius : 0;
    for (int i = 0; i < 3; i++)
        row[i] = i == a;
    row[3 + a] = 0;
    row[3 + next] = way[last] * scale;
    row[3 + last] = -way[next] * scale;
}

static void place_of(const struct mpm *mpm, int32_t node, double place[3])
{
    const int n = node % BLOCK_CELLS, in_block[3] = {n % 4, n / 4 % 4, n / 16};
    for (int a = 0; a < 3; a++)
        place[a] = (mpm->cells->blocks[node / BLOCK_CELLS].at[a] * BLOCK_EDGE + in_block[a]) * mpm->cells->frame.size;
}

/* A node of a part with its mass; false where there is none. */
struct visit {
    struct rigid_part *part;
    double mass, way[3]; /* from the part's centre */
    uint8_t fixed;
};

static bool visit_node(const struct rigid *rigid, const struct mpm *mpm, int32_t node, struct visit *visit)
{
    const int32_t b = node / BLOCK_CELLS, n = node % BLOCK_CELLS;
    if (rigid->part_of_node[node] < 0 || (rigid->leaves_out && rigid->leaves_out[node]))
        return false;
    visit->part = &rigid->parts[rigid->part_of_node[node]];
    visit->mass = grid_field(mpm->grid, b, NODE_MASS)[n];
    visit->fixed = mpm->grid->fixed[node];
    place_of(mpm, node, visit->way);
    for (int a = 0; a < 3; a++)
        visit->way[a] -= visit->part->centre[a];
    return true;
}

/* Masses, centres and radii. */
static void find_centres(struct rigid *rigid, const struct mpm *mpm)
{
    const int32_t nodes = mpm->cells->n_blocks * BLOCK_CELLS;
    struct visit visit;
    for (int32_t i = 0; i < nodes; i++)
        if (visit_node(rigid, mpm, i, &visit)) {
            visit.part->mass += visit.mass;
            for (int a = 0; a < 3; a++) { /* about the origin: there are no centres yet */
                visit.part->radius += visit.mass * visit.way[a] * visit.way[a];
                visit.part->moment[a] += visit.mass * visit.way[a];
            }
        }
    for (int32_t k = 0; k < rigid->n_parts; k++) {
        struct rigid_part *part = &rigid->parts[k];
        double square = part->mass > 0 ? part->radius / part->mass : 0;
        for (int a = 0; a < 3; a++) {
            part->centre[a] = part->mass > 0 ? part->moment[a] / part->mass : 0;
            square -= part->centre[a] * part->centre[a];
        }
        part->radius = sqrt(fmax(square, 1e-6 * mpm->cells->frame.size * mpm->cells->frame.size));
    }
}

/* Sums of products of motions over held directions, and over free ones by mass. */
static void add_products(struct rigid *rigid, const struct mpm *mpm)
{
    const int32_t nodes = mpm->cells->n_blocks * BLOCK_CELLS;
    struct visit visit;
    for (int32_t i = 0; i < nodes; i++) {
        if (!visit_node(rigid, mpm, i, &visit))
            continue;
        for (int a = 0; a < 3; a++) {
            double row[MOTIONS];
            bool is_held = visit.fixed >> a & 1;
            motions_at(visit.part, visit.way, a, row);
            for (int r = 0; r < MOTIONS; r++)
                for (int c = 0; c < MOTIONS; c++) {
                    visit.part->held[r][c] += is_held ? row[r] * row[c] : 0;
                    visit.part->inertia[r][c] += is_held ? 0 : visit.mass * row[r] * row[c];
                }
        }
    }
}

/* Product of two motions by mass. */
static double inertia_of(const struct rigid_part *part, const double left[MOTIONS], const double right[MOTIONS])
{
    double sum = 0;
    for (int r = 0; r < MOTIONS; r++)
        for (int c = 0; c < MOTIONS; c++)
            sum += left[r] * part->inertia[r][c] * right[c];
    return sum;
}

/* The motions that nothing holds, made orthonormal one after the other. */
static void find_motions(struct rigid_part *part)
{
    double values[MOTIONS], vectors[MOTIONS][MOTIONS];
    symmetric_eigen(MOTIONS, part->held, values, vectors);
    for (int i = 0; i < MOTIONS; i++) {
        double *motion = part->motion[part->n_motions];
        if (values[i] > LEAST_HOLD)
            continue;
        for (int r = 0; r < MOTIONS; r++)
            motion[r] = vectors[r][i];
        double before = inertia_of(part, motion, motion);
        for (int twice = 0; twice < 2; twice++)
            for (int k = 0; k < part->n_motions; k++) {
                double share = inertia_of(part, motion, part->motion[k]);
                for (int r = 0; r < MOTIONS; r++)
                    motion[r] -= share * part->motion[k][r];
            }
        double size = inertia_of(part, motion, motion);
        if (!(size > 1e-12 * before))
            continue;
        for (int r = 0; r < MOTIONS; r++)
            motion[r] /= sqrt(size);
        part->n_motions++;
    }
}

/* A body with a particle in each part. */
static void find_bodies(struct rigid *rigid, const struct mpm *mpm)
{
    const struct cell_list *cells = mpm->cells;
    for (int32_t b = cells->active - 1; b >= 0; b--)
        for (int c = BLOCK_CELLS - 1; c >= 0; c--) {
            const struct cell_block *block = &cells->blocks[b];
            if (block->cell_first[c] == block->cell_first[c + 1])
                continue;
            for (int corner = 0; corner < 8; corner++) {
                int32_t node = corner_node(block, c, corner, b), part = node < 0 ? -1 : rigid->part_of_node[node];
                if (part >= 0)
                    rigid->parts[part].body = mpm->store->integer[COLUMN_BODY][cells->order[block->first + block->cell_first[c]]];
            }
        }
}

void rigid_connect(struct rigid *rigid, const struct mpm *mpm)
{
    const size_t nodes = (size_t)mpm->cells->n_blocks * BLOCK_CELLS;
    rigid->part_of_node = memory_grow(rigid->part_of_node, &rigid->nodes_capacity, nodes, sizeof(int32_t), "rigid motions");
    connect(rigid, mpm);
    number_parts(rigid, mpm);
}

void rigid_find(struct rigid *rigid, const struct mpm *mpm, const uint8_t *leaves_out)
{
    rigid->leaves_out = leaves_out;
    rigid->parts = memory_grow(rigid->parts, &rigid->parts_capacity, (size_t)rigid->n_parts, sizeof *rigid->parts, "rigid motions");
    memset(rigid->parts, 0, (size_t)rigid->n_parts * sizeof *rigid->parts);
    find_centres(rigid, mpm);
    add_products(rigid, mpm);
    find_bodies(rigid, mpm);
    rigid->n_floating = 0;
    for (int32_t k = 0; k < rigid->n_parts; k++) {
        struct rigid_part *part = &rigid->parts[k];
        if (part->mass > 0)
            find_motions(part);
        if (part->n_motions > 0 && rigid->n_floating++ == 0) {
            rigid->motions = part->n_motions;
            rigid->body = part->body;
        }
    }
}

/* --- taking them out --- */

/* Displacements along axis a at a node under the part's free motions. */
static void free_motions_at(const struct visit *visit, int a, double along[MOTIONS])
{
    double row[MOTIONS];
    motions_at(visit->part, visit->way, a, row);
    for (int k = 0; k < visit->part->n_motions; k++) {
        along[k] = 0;
        for (int r = 0; r < MOTIONS; r++)
            along[k] += visit->part->motion[k][r] * row[r];
    }
}

/* Sums motions times the vector, by mass unless it is a force, and subtracts them; returns the length of that. */
static double remove_motions(const struct rigid *rigid, const struct mpm *mpm, double *vector, bool is_force)
{
    const int32_t nodes = mpm->cells->n_blocks * BLOCK_CELLS;
    double removed = 0;
    for (int32_t k = 0; k < rigid->n_parts && rigid->n_floating > 0; k++)
        memset(rigid->parts[k].share, 0, sizeof rigid->parts[k].share);
    for (int pass = 0; pass < 2 && rigid->n_floating > 0; pass++)
        for (int32_t i = 0; i < nodes; i++) {
            struct visit visit;
            if (!visit_node(rigid, mpm, i, &visit) || visit.part->n_motions == 0)
                continue;
            for (int a = 0; a < 3; a++) {
                double along[MOTIONS], part = 0;
                double *value = vector + (size_t)(i / BLOCK_CELLS * 3 + a) * BLOCK_CELLS + i % BLOCK_CELLS;
                if (visit.fixed >> a & 1)
                    continue;
                free_motions_at(&visit, a, along);
                for (int k = 0; k < visit.part->n_motions && pass == 0; k++)
                    visit.part->share[k] += along[k] * (is_force ? 1 : visit.mass) * *value;
                for (int k = 0; k < visit.part->n_motions && pass == 1; k++)
                    part += visit.part->share[k] * along[k] * (is_force ? visit.mass : 1);
                *value -= part;
                removed += part * part;
            }
        }
    return sqrt(removed);
}

double rigid_remove_force(const struct rigid *rigid, const struct mpm *mpm, double *force)
{
    return remove_motions(rigid, mpm, force, true);
}

void rigid_remove_motion(const struct rigid *rigid, const struct mpm *mpm, double *displacement)
{
    remove_motions(rigid, mpm, displacement, false);
}
