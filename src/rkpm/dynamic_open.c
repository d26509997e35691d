/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From the scene to nodes with room for all that their motion needs. */
#include "base/memory.h"
#include "particles/results.h"
#include "rkpm/dynamic.h"

#include <math.h>

/* --- nodes --- */

/* Layers of fixed nodes of a wall, and how far it reaches to each side, in radii of the body. */
enum { WALL_LAYERS = 3, WALL_REACH = 4 };

/* Fixed nodes along an axis beside the wall's: in line with those of the body. */
static long half_wall(const struct scene_dynamic *words)
{
    return (long)ceil(WALL_REACH * words->lattice.radius / words->lattice.spacing);
}

static size_t count_fixed(const struct scene_rkpm *words)
{
    size_t count = WALL_LAYERS;
    if (words->dynamic.wall != RKPM_WALL_NATURAL)
        return 0;
    for (int a = 1; a < words->dimension; a++)
        count *= 2 * (size_t)half_wall(&words->dynamic);
    return count;
}

/* Below the wall's plane, from half a spacing on. */
static void place_fixed(struct dynamic *dynamic)
{
    const struct scene_dynamic *words = &dynamic->words->dynamic;
    struct dynamic_fixed *fixed = &dynamic->fixed;
    const long half = half_wall(words);
    for (size_t i = 0; i < fixed->count; i++) {
        size_t rest = i / WALL_LAYERS;
        for (int a = 0; a < dynamic->dimension; a++) {
            double place = words->wall_position - ((double)(i % WALL_LAYERS) + 0.5) * dynamic->spacing;
            if (a != words->wall_axis) {
                place = words->lattice.centre[a] + ((double)((long)(rest % (size_t)(2 * half)) - half) + 0.5) * dynamic->spacing;
                rest /= (size_t)(2 * half);
            }
            dynamic->rest[a][dynamic->count + i] = place;
            fixed->low[a] = i == 0 ? place : fmin(fixed->low[a], place);
            fixed->high[a] = i == 0 ? place : fmax(fixed->high[a], place);
        }
    }
}

static void create_nodes(struct dynamic *dynamic)
{
    const struct ball_lattice *lattice = &dynamic->words->dynamic.lattice;
    dynamic->count = dynamic->nodes = (size_t)dynamic->scene->n_particles;
    dynamic->fixed.count = count_fixed(dynamic->words);
    dynamic->fixed.shown = (int32_t)dynamic->count;
    dynamic->spacing = lattice->spacing;
    dynamic->volume = lattice_volume(lattice) / (double)dynamic->count;
    dynamic->mass = dynamic->material->density * dynamic->volume;
    const size_t all = dynamic->count + dynamic->fixed.count;
    for (int a = 0; a < 3; a++) {
        double **const arrays[] = {&dynamic->rest[a], &dynamic->coefficient[a], &dynamic->velocity[a], &dynamic->acceleration[a]};
        for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++)
            *arrays[i] = memory_array(all, sizeof(double), "nodes");
    }
    lattice_points(lattice, dynamic->rest);
    place_fixed(dynamic);
    dynamic->volumes = memory_array(all, sizeof(double), "nodes");
    dynamic->slot = memory_array(all, sizeof *dynamic->slot, "nodes");
    dynamic->fixed.is_active = memory_array(all, sizeof *dynamic->fixed.is_active, "nodes");
    for (size_t n = 0; n < all; n++) {
        dynamic->volumes[n] = n < dynamic->count ? dynamic->volume : pow(dynamic->spacing, dynamic->dimension);
        dynamic->slot[n] = (int32_t)n;
    }
}

static void create_store(struct dynamic *dynamic)
{
    static const enum column columns[] = {COLUMN_POSITION, COLUMN_VELOCITY, COLUMN_STRESS, COLUMN_VOLUME, COLUMN_MASS, COLUMN_ENERGY,
                                          COLUMN_DEFORMATION, COLUMN_INITIAL_POSITION, COLUMN_ID, COLUMN_BODY};
    uint64_t wanted = 0;
    for (size_t i = 0; i < sizeof columns / sizeof columns[0]; i++)
        wanted |= column_bit(columns[i]);
    struct store *store = dynamic->store = store_open(dynamic->count + dynamic->fixed.count, wanted);
    store_open_history(store, law_history(dynamic->material));
    for (size_t n = 0; n < store->count; n++) {
        store->integer[COLUMN_ID][n] = store->index_of_id[n] = (int32_t)n;
        store->real[COLUMN_VOLUME][0][n] = dynamic->volumes[n];
        store->real[COLUMN_MASS][0][n] = dynamic->material->density * dynamic->volumes[n];
        for (int a = 0; a < 3; a++)
            store->real[COLUMN_INITIAL_POSITION][a][n] = store->real[COLUMN_POSITION][a][n] = dynamic->rest[a][n];
    }
}

/* Coefficients at rest places give linear fields, and so the velocities of a rigid body. */
static void start_motion(struct dynamic *dynamic)
{
    const struct scene_dynamic *words = &dynamic->words->dynamic;
    const double *centre = words->lattice.centre;
    for (size_t n = 0; n < dynamic->store->count - dynamic->fixed.count; n++) {
        const double arm[3] = {dynamic->rest[0][n] - centre[0], dynamic->rest[1][n] - centre[1], 0};
        const double turning[3] = {-words->spin * arm[1], words->spin * arm[0], 0};
        for (int a = 0; a < dynamic->dimension; a++) {
            dynamic->coefficient[a][n] = dynamic->rest[a][n];
            dynamic->velocity[a][n] = words->velocity[a] + turning[a];
        }
    }
}

/* --- room --- */

/* Numbers of a gradient of stress: the mean, the spring's deviator and that of each element. */
static int gradient_terms(const struct dynamic *dynamic)
{
    return dynamic->words->integration == INTEGRATION_NSNI ? 7 + 6 * dynamic->material->n_elements : 0;
}

static void create_work(struct dynamic *dynamic)
{
    const size_t count = dynamic->store->count, axes = (size_t)dynamic->dimension;
    double **const arrays[] = {&dynamic->trace, &dynamic->volume_before, &dynamic->terms[0], &dynamic->terms[1], &dynamic->wall_force};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++)
        *arrays[i] = memory_array(count, sizeof(double), "nodes");
    for (int a = 0; a < 6; a++)
        dynamic->strain[a] = memory_array(count, sizeof(double), "strains");
    for (int a = 0; a < 3; a++)
        dynamic->spin[a] = memory_array(count, sizeof(double), "strains");
    dynamic->increment = memory_array(count * (size_t)dynamic_lanes(dynamic->dimension), sizeof(double), "nodes");
    dynamic->load = memory_array(count * dynamic_load_terms(dynamic), sizeof(double), "forces");
    dynamic->gradient_terms = gradient_terms(dynamic);
    dynamic->gradient_stress = memory_array(count * axes * (size_t)dynamic->gradient_terms, sizeof(double), "gradients of stress");
}

/* Nodes that rows are expected of: a body half as wide again, and fixed nodes within two supports of it. */
static size_t expected_nodes(const struct dynamic *dynamic)
{
    const struct scene_dynamic *words = &dynamic->words->dynamic;
    double fixed = WALL_LAYERS;
    for (int a = 0; a < dynamic->dimension; a++)
        fixed *= a == words->wall_axis ? 1 : 3 * words->lattice.radius / dynamic->spacing + 4 * dynamic->words->support[a];
    return fixed < (double)dynamic->fixed.count ? dynamic->count + (size_t)fixed : dynamic->store->count;
}

/* There is room for more nodes than those that take part at the start. */
static void open_rows(struct dynamic *dynamic)
{
    const struct scene_rkpm *words = dynamic->words;
    struct rkpm_support support = {words->kernel, {1, 1, 1}};
    for (int a = 0; a < dynamic->dimension; a++) {
        support.radius[a] = words->support[a] * dynamic->spacing;
        for (size_t n = 0; n < dynamic->store->count; n++)
            dynamic->coefficient[a][n] = dynamic->rest[a][n];
    }
    rkpm_nodal_open(&dynamic->nodal, dynamic->dimension, words->integration, words->gradient, expected_nodes(dynamic),
                    dynamic->is_semi ? dynamic->coefficient : dynamic->rest, dynamic->volumes, NULL, &support, !dynamic->is_semi);
}

/* What curves show has to be known in each step. */
static void choose_followed(struct dynamic *dynamic)
{
    for (size_t i = 0; i < dynamic->scene->n_curves; i++) {
        const enum total total = dynamic->scene->curves[i].result->total;
        dynamic->follows_nodes |= total == TOTAL_NONE;
        dynamic->follows_extent |= total == TOTAL_WIDTH || total == TOTAL_TOP || total == TOTAL_BOTTOM;
        dynamic->follows_turning |= total == TOTAL_ANGULAR || total == TOTAL_TURN;
    }
}

struct dynamic *rkpm_dynamic_open(const struct scene *scene, struct timers *timers)
{
    struct dynamic *dynamic = memory_array(1, sizeof *dynamic, "the run");
    dynamic->scene = scene;
    dynamic->words = &scene->rkpm;
    dynamic->material = &scene->materials[0].material;
    dynamic->timers = timers;
    dynamic->dimension = (int)scene->rkpm.dimension;
    dynamic->is_semi = scene->rkpm.dynamic.mode == KERNEL_SEMI;
    const double given = scene->rkpm.dynamic.stabilisation;
    dynamic->stabilisation = given >= 0 ? given : dynamic->material->law->stabilisation;
    choose_followed(dynamic);
    create_nodes(dynamic);
    create_store(dynamic);
    rkpm_dynamic_layers_open(dynamic);
    open_rows(dynamic);
    create_work(dynamic);
    start_motion(dynamic);
    rkpm_dynamic_renew(dynamic);
    rkpm_dynamic_forces(dynamic);
    rkpm_dynamic_sum(dynamic);
    rkpm_dynamic_start(dynamic);
    dynamic->first_time_step = dynamic->time_step = rkpm_dynamic_limit(dynamic);
    return dynamic;
}

void rkpm_dynamic_close(struct dynamic *dynamic)
{
    if (!dynamic)
        return;
    for (int a = 0; a < 3; a++) {
        memory_free(dynamic->rest[a]);
        memory_free(dynamic->coefficient[a]);
        memory_free(dynamic->velocity[a]);
        memory_free(dynamic->acceleration[a]);
        memory_free(dynamic->spin[a]);
    }
    for (int a = 0; a < 6; a++)
        memory_free(dynamic->strain[a]);
    double *const arrays[] = {dynamic->volumes,         dynamic->trace, dynamic->volume_before,
                              dynamic->terms[0],        dynamic->terms[1], dynamic->wall_force, dynamic->increment, dynamic->load,
                              dynamic->gradient_stress};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++)
        memory_free(arrays[i]);
    rkpm_dynamic_layers_close(dynamic);
    rkpm_nodal_close(&dynamic->nodal);
    memory_free(dynamic->slot);
    memory_free(dynamic->fixed.is_active);
    memory_free(dynamic->pairs.first);
    memory_free(dynamic->pairs.node);
    memory_free(dynamic->pairs.place);
    memory_free(dynamic->pairs.gradients);
    memory_free(dynamic->pairs.force);
    store_close(dynamic->store);
    memory_free(dynamic);
}
