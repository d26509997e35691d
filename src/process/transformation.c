/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/transformation.h"
#include "base/memory.h"
#include "process/schedule.h"

#include <math.h>

/* Distances below the radius by less than this part of it count as on the sphere. */
static const double ON_SPHERE = 1e-9;

struct heat {
    int32_t *ids; /* of the hot particles */
    size_t count, capacity;
};

static const struct scene_material *material_of(const struct scene *scene, const struct store *store, size_t p)
{
    return &scene->materials[scene->bodies[store->integer[COLUMN_BODY][p]].generator.material];
}

bool transformation_has_residual(const struct scene *scene)
{
    for (size_t i = 0; i < scene->n_materials; i++)
        if (scene->materials[i].transformation.has_residual)
            return true;
    return false;
}

bool transformation_has_heat(const struct scene *scene)
{
    for (size_t i = 0; i < scene->n_materials; i++)
        if (scene->materials[i].transformation.has_heat)
            return true;
    return false;
}

/* --- residual stress --- */

/* Component of a stress, in the order xx yy zz yz xz xy, of two axes. */
static int component(int i, int j)
{
    return i == j ? i : 6 - i - j;
}

/* A stress along, across and shear in the plane of two axes, turned from the first to the second by
 * an angle in degrees. */
static void rotate(const double local[3], double degrees, int first, int second, double stress[6])
{
    const double angle = degrees * acos(-1) / 180, c = cos(angle), s = sin(angle);
    for (int a = 0; a < 6; a++)
        stress[a] = 0;
    stress[component(first, first)] = local[0] * c * c + local[1] * s * s - 2 * local[2] * s * c;
    stress[component(second, second)] = local[0] * s * s + local[1] * c * c + 2 * local[2] * s * c;
    stress[component(first, second)] = (local[0] - local[1]) * s * c + local[2] * (c * c - s * s);
}

void transformation_set_residual(const struct scene *scene, struct store *store)
{
    const int first = (scene->building.axis + 1) % 3, second = (scene->building.axis + 2) % 3;
    for (size_t p = 0; p < store->count; p++) {
        const struct scene_transformation *t = &material_of(scene, store, p)->transformation;
        double stress[6] = {0};
        if (t->has_residual)
            rotate(t->residual, schedule_angle(scene, store->integer[COLUMN_LAYER][p]), first, second, stress);
        for (int a = 0; a < 6; a++)
            store->real[COLUMN_RESIDUAL][a][p] = stress[a];
    }
}

/* --- volume strains --- */

/* Changes the transformation strain of a particle by `strain` along each axis at fixed total strain;
 * returns the change of its energy. */
static double add_strain(const struct scene *scene, struct store *store, size_t p, double strain)
{
    const struct material *material = &material_of(scene, store, p)->material;
    const double change = 3 * material->bulk_modulus * strain;
    double trace = 0;
    for (int a = 0; a < 3; a++) {
        trace += store->real[COLUMN_STRESS][a][p];
        store->real[COLUMN_STRESS][a][p] -= change;
        for (int i = 0; i < material->n_elements; i++) /* their part relaxes from now on */
            store->history[6 * i + a][p] -= 3 * material->elements[i].bulk * strain;
    }
    if (store_has(store, COLUMN_MEAN_STRESS))
        store->real[COLUMN_MEAN_STRESS][0][p] -= change;
    double energy = store->real[COLUMN_VOLUME][0][p] * strain * (1.5 * change - trace);
    store->real[COLUMN_ENERGY][0][p] += energy;
    return energy;
}

void transformation_set_phase(const struct scene *scene, struct store *store)
{
    for (size_t p = 0; p < store->count; p++) {
        const struct scene_transformation *t = &material_of(scene, store, p)->transformation;
        if (t->has_phase)
            add_strain(scene, store, p, (t->phase_densities[0] - t->phase_densities[1]) / (3 * t->phase_densities[1]));
    }
}

/* --- the hot zone --- */

struct heat *heat_open(void)
{
    return memory_array(1, sizeof(struct heat), "the hot zone");
}

void heat_close(struct heat *heat)
{
    if (heat)
        memory_free(heat->ids);
    memory_free(heat);
}

size_t heat_count(const struct heat *heat)
{
    return heat->count;
}

int32_t *heat_ids(struct heat *heat, size_t count)
{
    heat->ids = memory_grow(heat->ids, &heat->capacity, count, sizeof *heat->ids, "the hot zone");
    heat->count = count;
    return heat->ids;
}

static double heat_strain(const struct scene_transformation *t)
{
    double strain = t->has_heat ? t->expansion * t->temperature : 0;
    return t->cools ? -strain : strain;
}

double heat_switch_off(struct heat *heat, const struct scene *scene, struct store *store)
{
    double energy = 0;
    for (size_t i = 0; i < heat->count; i++) {
        const size_t p = (size_t)store->index_of_id[heat->ids[i]];
        energy += add_strain(scene, store, p, -heat_strain(&material_of(scene, store, p)->transformation));
    }
    heat->count = 0;
    return energy;
}

/* Heats the particles of one cell within the square of the radius. */
static double heat_cell(struct heat *heat, const struct scene *scene, struct store *store, const struct cell_list *cells,
                        const struct cell_block *block, int cell, const double centre[3], double square)
{
    double energy = 0;
    for (int32_t k = block->cell_first[cell]; k < block->cell_first[cell + 1]; k++) {
        const size_t p = (size_t)cells->order[block->first + k];
        const double strain = heat_strain(&material_of(scene, store, p)->transformation);
        double distance = 0;
        for (int a = 0; a < 3; a++)
            distance += pow(store->real[COLUMN_POSITION][a][p] - centre[a], 2);
        if (distance >= square || strain == 0)
            continue;
        heat->ids = memory_grow(heat->ids, &heat->capacity, heat->count + 1, sizeof *heat->ids, "the hot zone");
        heat->ids[heat->count++] = store->integer[COLUMN_ID][p];
        energy += add_strain(scene, store, p, strain);
    }
    return energy;
}

double heat_switch_on(struct heat *heat, const struct scene *scene, struct store *store, const struct cell_list *cells, int32_t p)
{
    const struct cell_frame *frame = &cells->frame;
    const double radius = material_of(scene, store, (size_t)p)->transformation.radius;
    const double square = radius * radius * (1 - ON_SPHERE);
    const int32_t components = scene->contact == CONTACT_NONE ? 1 : (int32_t)scene->components;
    double centre[3], energy = 0;
    int32_t low[3], high[3], cell[3];
    for (int a = 0; a < 3; a++) {
        centre[a] = store->real[COLUMN_POSITION][a][p];
        low[a] = (int32_t)fmin(frame->cells[a], fmax(0, floor((centre[a] - radius - frame->low[a]) / frame->size)));
        high[a] = (int32_t)fmax(-1, fmin(frame->cells[a] - 1, floor((centre[a] + radius - frame->low[a]) / frame->size)));
    }
    for (int32_t component = 0; component < components; component++)
        for (cell[2] = low[2]; cell[2] <= high[2]; cell[2]++)
            for (cell[1] = low[1]; cell[1] <= high[1]; cell[1]++)
                for (cell[0] = low[0]; cell[0] <= high[0]; cell[0]++) {
                    const int32_t at[3] = {cell[0] / BLOCK_EDGE, cell[1] / BLOCK_EDGE, cell[2] / BLOCK_EDGE};
                    const int32_t block = cell_list_find_block(cells, at, component);
                    const int in_block = cell[0] % BLOCK_EDGE + BLOCK_EDGE * (cell[1] % BLOCK_EDGE + BLOCK_EDGE * (cell[2] % BLOCK_EDGE));
                    if (block >= 0)
                        energy += heat_cell(heat, scene, store, cells, &cells->blocks[block], in_block, centre, square);
                }
    return energy;
}
