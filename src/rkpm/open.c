/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From the scene to levels with room for all that they need. */
#include "base/memory.h"
#include "base/scatter.h"
#include "rkpm/rkpm.h"

#include <math.h>

/* --- nodes --- */

static void create_box(struct rkpm_level *level, const struct scene_rkpm *words, const long numbers[3])
{
    struct node_box *box = &level->box;
    *box = (struct node_box){.dimension = (int)words->dimension};
    level->count = 1;
    for (int a = 0; a < 3; a++) {
        box->numbers[a] = numbers[a];
        level->count *= (size_t)numbers[a];
        if (a >= box->dimension)
            continue;
        box->low[a] = words->box[2 * a];
        box->spacing[a] = (words->box[2 * a + 1] - words->box[2 * a]) / (double)(numbers[a] - 1);
    }
}

/* On the lattice; those inside moved at random by up to `jitter` spacings along each axis. */
static void create_lattice(struct rkpm_level *level, const double jitter[2])
{
    const struct node_box *box = &level->box;
    for (int a = 0; a < 3; a++)
        level->x[a] = memory_array(level->count, sizeof(double), "nodes");
    for (size_t i = 0; i < level->count; i++) {
        size_t rest = i;
        for (int a = 0; a < box->dimension; a++) {
            level->x[a][i] = box->low[a] + box->spacing[a] * (double)(rest % (size_t)box->numbers[a]);
            if (jitter[0] > 0 && !box_is_boundary(box, i))
                level->x[a][i] += 2 * jitter[0] * box->spacing[a] * scatter((uint64_t)jitter[1], i, (uint64_t)a);
            rest /= (size_t)box->numbers[a];
        }
    }
}

/* Those of a file, or the lattice. */
static void create_nodes(struct rkpm_level *level, const struct scene_rkpm *words)
{
    if (!words->file) {
        create_lattice(level, words->jitter);
        return;
    }
    level->count = words->n_places;
    for (int a = 0; a < 3; a++) {
        level->x[a] = memory_array(level->count, sizeof(double), "nodes");
        for (size_t i = 0; i < level->count; i++)
            level->x[a][i] = words->places[i][a];
    }
}

static void open_level(struct rkpm *rkpm, struct rkpm_level *level, const long numbers[3])
{
    const struct scene_rkpm *words = rkpm->words;
    struct rkpm_support support = {words->kernel, {1, 1, 1}};
    double smallest = INFINITY;
    create_box(level, words, numbers);
    create_nodes(level, words);
    for (int a = 0; a < level->box.dimension; a++) {
        support.radius[a] = words->support[a] * level->box.spacing[a];
        smallest = fmin(smallest, level->box.spacing[a]);
    }
    level->beta = words->beta_over_spacing ? words->beta / smallest : words->beta;
    rkpm_shape_open(&level->shape, level->box.dimension, words->basis, level->count, level->x, &support);
    level->coefficient = memory_array(level->count * (scene_rkpm_has_body(rkpm->words) ? (size_t)words->dimension : 1), sizeof(double), "coefficients");
    if (scene_rkpm_has_body(rkpm->words)) {
        rkpm_elastic_open(rkpm, level);
        return;
    }
    if (words->problem != PROBLEM_APPROXIMATION)
        rkpm_system_open(rkpm, level);
    level->shape.enlarged = level->shape.lowered = 0;
}

/* The last level's nodes, as output sees them. */
static void create_store(struct rkpm *rkpm)
{
    static const enum column columns[] = {COLUMN_POSITION, COLUMN_ID, COLUMN_BODY, COLUMN_COEFFICIENT, COLUMN_FIELD, COLUMN_EXACT,
                                          COLUMN_INITIAL_POSITION};
    const struct rkpm_level *level = &rkpm->levels[rkpm->n_levels - 1];
    uint64_t wanted = 0;
    for (size_t i = 0; i < sizeof columns / sizeof columns[0]; i++)
        wanted |= column_bit(columns[i]);
    rkpm_set_field(rkpm, level);
    struct store *store = rkpm->store = store_open(level->count, wanted);
    for (size_t i = 0; i < level->count; i++) {
        const double x[3] = {level->x[0][i], level->x[1][i], level->x[2][i]};
        store->integer[COLUMN_ID][i] = store->index_of_id[i] = (int32_t)i;
        for (int a = 0; a < 3; a++)
            store->real[COLUMN_POSITION][a][i] = store->real[COLUMN_INITIAL_POSITION][a][i] = x[a];
        if (!scene_rkpm_has_body(rkpm->words))
            store->real[COLUMN_EXACT][0][i] = field_value(&rkpm->field, x);
    }
}

/* --- opening and closing --- */

static int or_default(long given, int otherwise)
{
    return given > 0 ? (int)given : otherwise;
}

struct rkpm *rkpm_open(const struct scene *scene, struct timers *timers)
{
    const struct scene_rkpm *words = &scene->rkpm;
    struct rkpm *rkpm = memory_array(1, sizeof *rkpm, "the run");
    rkpm->scene = scene;
    rkpm->words = words;
    rkpm->timers = timers;
    rkpm->field = (struct field){words->function, (int)words->dimension, words->wave_number, {words->box[0], words->box[1]}};
    if (scene_rkpm_has_body(rkpm->words))
        rkpm->deformation = deformation_of(words);
    rkpm->gauss = scene_rkpm_gauss(words);
    rkpm->boundary_gauss = or_default(words->boundary_gauss, 2);
    rkpm->norm_gauss = or_default(words->norm_gauss, words->problem == PROBLEM_HELMHOLTZ ? 5 : 2);
    rkpm->n_levels = words->n_levels;
    timers_enter(timers, PHASE_SYSTEM);
    rkpm->levels = memory_array(rkpm->n_levels, sizeof *rkpm->levels, "problems");
    for (size_t i = 0; i < rkpm->n_levels; i++)
        open_level(rkpm, &rkpm->levels[i], words->levels[i]);
    create_store(rkpm);
    timers_enter(timers, PHASE_OTHER);
    return rkpm;
}

static void close_level(struct rkpm_level *level)
{
    for (int a = 0; a < 3; a++)
        memory_free(level->x[a]);
    rkpm_shape_close(&level->shape);
    memory_free(level->coefficient);
    rkpm_system_close(&level->system);
    rkpm_elastic_close(level);
}

void rkpm_close(struct rkpm *rkpm)
{
    if (!rkpm)
        return;
    for (size_t i = 0; i < rkpm->n_levels; i++)
        close_level(&rkpm->levels[i]);
    creep_close(&rkpm->creep);
    memory_free(rkpm->levels);
    store_close(rkpm->store);
    memory_free(rkpm);
}
