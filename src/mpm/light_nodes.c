/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mpm/light_nodes.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

/* A node is light below this part of the mass of a full cell. */
static const double LIGHT_PART = 1e-4;

enum { HEAVY = 0, LIGHT = 1, FOLLOWS = 2 };

void light_nodes_close(struct light_nodes *light)
{
    memory_free(light->nodes);
    memory_free(light->is_light);
}

/* The node `way` further along each axis (at most two), or -1. */
static int32_t node_at(const struct cell_list *cells, int32_t node, const int way[3])
{
    int32_t b = node / BLOCK_CELLS;
    int place = node % BLOCK_CELLS, result = 0, neighbour = 0;
    for (int a = 0, stride = 1, step = 1; a < 3; a++, stride *= BLOCK_EDGE, step *= 3) {
        int i = place / stride % BLOCK_EDGE + way[a] + BLOCK_EDGE; /* counted from the block before */
        neighbour += i / BLOCK_EDGE * step;
        result += i % BLOCK_EDGE * stride;
    }
    b = cells->blocks[b].neighbour[neighbour];
    return b < 0 ? -1 : b * BLOCK_CELLS + result;
}

/* Mass below which a node is light. With several materials the least density counts, so that nothing of a heavier
 * one makes a lighter one's nodes light. */
static double light_mass(const struct mpm *mpm)
{
    double least = mpm->material_of_body[0]->density;
    for (size_t b = 1; b < mpm->scene->n_bodies; b++)
        least = fmin(least, mpm->material_of_body[b]->density);
    return LIGHT_PART * least * pow(mpm->cells->frame.size, 3);
}

static double mass_at(const struct mpm *mpm, int32_t node)
{
    return grid_field(mpm->grid, node / BLOCK_CELLS, NODE_MASS)[node % BLOCK_CELLS];
}

/* Whether a node can lead: it has particles around and is not light, or follows already. */
static bool can_lead(const struct light_nodes *light, const int32_t *part_of_node, int32_t node)
{
    return node >= 0 && part_of_node[node] >= 0 && light->is_light[node] != LIGHT;
}

/* Two nodes in a line, u = 2 u1 - u2: of the six lines the one whose leading nodes have most mass. */
static bool follow_line(const struct light_nodes *light, const struct mpm *mpm, const int32_t *part_of_node,
                        struct light_node *light_node)
{
    double most = -1;
    for (int i = 0; i < 6; i++) {
        int one[3] = {0}, two[3] = {0};
        one[i / 2] = i % 2 ? 1 : -1;
        two[i / 2] = 2 * one[i / 2];
        int32_t first = node_at(mpm->cells, light_node->node, one), second = node_at(mpm->cells, light_node->node, two);
        if (!can_lead(light, part_of_node, first) || !can_lead(light, part_of_node, second))
            continue;
        double mass = fmin(mass_at(mpm, first), mass_at(mpm, second));
        if (mass <= most)
            continue;
        most = mass;
        *light_node = (struct light_node){light_node->node, {first, second, second}, {2, -1, 0}};
    }
    return most >= 0;
}

/* The other corners of a square, u = u1 + u2 - u12. */
static bool follow_square(const struct light_nodes *light, const struct mpm *mpm, const int32_t *part_of_node,
                          struct light_node *light_node)
{
    double most = -1;
    for (int i = 0; i < 12; i++) {
        const int a = i / 4, b = (a + 1) % 3;
        int one[3] = {0}, two[3] = {0}, both[3] = {0};
        both[a] = one[a] = i & 1 ? 1 : -1;
        both[b] = two[b] = i & 2 ? 1 : -1;
        int32_t first = node_at(mpm->cells, light_node->node, one), second = node_at(mpm->cells, light_node->node, two);
        int32_t third = node_at(mpm->cells, light_node->node, both);
        if (!can_lead(light, part_of_node, first) || !can_lead(light, part_of_node, second) || !can_lead(light, part_of_node, third))
            continue;
        double mass = fmin(mass_at(mpm, third), fmin(mass_at(mpm, first), mass_at(mpm, second)));
        if (mass <= most)
            continue;
        most = mass;
        *light_node = (struct light_node){light_node->node, {first, second, third}, {1, 1, -1}};
    }
    return most >= 0;
}

/* Light nodes that can follow the ones known so far; returns their number. */
static int32_t add_followers(struct light_nodes *light, const struct mpm *mpm, const int32_t *part_of_node)
{
    const int32_t nodes = mpm->cells->n_blocks * BLOCK_CELLS, before = light->count;
    for (int32_t i = 0; i < nodes; i++) {
        struct light_node light_node = {.node = i};
        if (light->is_light[i] != LIGHT)
            continue;
        if (follow_line(light, mpm, part_of_node, &light_node) || follow_square(light, mpm, part_of_node, &light_node)) {
            light->nodes = memory_grow(light->nodes, &light->nodes_capacity, (size_t)light->count + 1, sizeof light_node, "light nodes");
            light->nodes[light->count++] = light_node;
        }
    }
    for (int32_t k = before; k < light->count; k++)
        light->is_light[light->nodes[k].node] = FOLLOWS;
    return light->count - before;
}

void light_nodes_find(struct light_nodes *light, const struct mpm *mpm, const int32_t *part_of_node)
{
    const int32_t nodes = mpm->cells->n_blocks * BLOCK_CELLS;
    const double least = light_mass(mpm);
    light->is_light = memory_grow(light->is_light, &light->light_capacity, (size_t)nodes, 1, "light nodes");
    light->count = 0;
    for (int32_t i = 0; i < nodes; i++)
        light->is_light[i] = part_of_node[i] >= 0 && mass_at(mpm, i) < least ? LIGHT : HEAVY;
    while (add_followers(light, mpm, part_of_node) > 0)
        ;
    for (int32_t i = 0; i < nodes; i++) /* one that can follow nobody stays on its own */
        light->is_light[i] = light->is_light[i] == FOLLOWS;
}

/* --- vectors --- */

static double *value_at(double *vector, int32_t node, int axis)
{
    return vector + (size_t)(node / BLOCK_CELLS * 3 + axis) * BLOCK_CELLS + node % BLOCK_CELLS;
}

void light_nodes_follow(const struct light_nodes *light, const uint8_t *fixed, double *displacement)
{
    for (int32_t k = 0; k < light->count; k++) {
        const struct light_node *node = &light->nodes[k];
        for (int a = 0; a < 3; a++) {
            double sum = 0;
            for (int i = 0; i < 3; i++)
                sum += node->weight[i] * *value_at(displacement, node->leader[i], a);
            *value_at(displacement, node->node, a) = fixed[node->node] >> a & 1 ? 0 : sum;
        }
    }
}

void light_nodes_lead(const struct light_nodes *light, const uint8_t *fixed, double *force)
{
    for (int32_t k = light->count - 1; k >= 0; k--) {
        const struct light_node *node = &light->nodes[k];
        for (int a = 0; a < 3; a++) {
            double *own = value_at(force, node->node, a);
            for (int i = 0; i < 3; i++)
                if (!(fixed[node->node] >> a & 1) && !(fixed[node->leader[i]] >> a & 1))
                    *value_at(force, node->leader[i], a) += node->weight[i] * *own;
            *own = 0;
        }
    }
}

void light_nodes_clear(const struct light_nodes *light, double *vector)
{
    for (int32_t k = 0; k < light->count; k++)
        for (int a = 0; a < 3; a++)
            *value_at(vector, light->nodes[k].node, a) = 0;
}
