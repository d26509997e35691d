/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Builds and frees what a run owns. */
#include "base/memory.h"
#include "base/threads.h"
#include "deck/diagnostics.h"
#include "mpm/chunk.h"
#include "mpm/equilibrium.h"
#include "process/transformation.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* --- particles --- */

/* Laws with an equation of state compute artificial viscosity with the pressure, and keep it, be it zero. */
static bool wants_viscosity(const struct scene *scene)
{
    bool wants = scene->bulk[0] != 0 || scene->bulk[1] != 0;
    for (size_t i = 0; i < scene->n_materials; i++)
        wants = wants || scene->materials[i].material.law->needs_eos;
    return wants;
}

static uint64_t wanted_columns(const struct scene *scene)
{
    uint64_t wanted = 0;
    static const enum column always[] = {COLUMN_POSITION, COLUMN_VELOCITY, COLUMN_STRESS, COLUMN_VOLUME, COLUMN_MASS,
                                         COLUMN_ENERGY, COLUMN_ID, COLUMN_BODY};
    for (size_t i = 0; i < sizeof always / sizeof always[0]; i++)
        wanted |= column_bit(always[i]);
    if (wants_viscosity(scene))
        wanted |= column_bit(COLUMN_VISCOUS_PRESSURE);
    for (size_t i = 0; i < scene->n_materials; i++)
        for (const enum column *c = scene->materials[i].material.law->columns; *c != COLUMN_NONE; c++)
            wanted |= column_bit(*c);
    for (size_t i = 0; i < scene->n_results; i++)
        for (const enum column *c = scene->results[i]->columns; *c != COLUMN_NONE; c++)
            wanted |= column_bit(*c);
    for (size_t i = 0; i < scene->n_curves; i++)
        for (const enum column *c = scene->curves[i].result->columns; *c != COLUMN_NONE; c++)
            wanted |= column_bit(*c);
    for (size_t i = 0; i < scene->n_loads; i++)
        if (scene->loads[i].kind != LOAD_GRAVITY && scene->loads[i].kind != LOAD_FACE)
            wanted |= column_bit(COLUMN_LOAD);
    if (scene->is_small)
        wanted |= column_bit(COLUMN_INITIAL_POSITION);
    if (scene->tracks_deformation || scene->is_total)
        wanted |= column_bit(COLUMN_DEFORMATION);
    if (scene->smooths_pressure && scene->writes_vtk)
        wanted |= column_bit(COLUMN_SMOOTHED_PRESSURE) | column_bit(COLUMN_START_POSITION);
    if (scene->transfer == TRANSFER_AFFINE)
        wanted |= column_bit(COLUMN_AFFINE);
    if (scene->writes_vtk)
        wanted |= column_bit(COLUMN_INITIAL_POSITION);
    if (transformation_has_residual(scene))
        wanted |= column_bit(COLUMN_RESIDUAL) | column_bit(COLUMN_LAYER);
    if (scene->is_total)
        wanted |= column_bit(COLUMN_FIRST_STRESS) | column_bit(COLUMN_INITIAL_POSITION);
    return wanted;
}

/* Columns of history: those of the material that has most. */
static int most_history(const struct scene *scene)
{
    int most = 0;
    for (size_t i = 0; i < scene->n_materials; i++) {
        const int history = law_history(&scene->materials[i].material);
        most = history > most ? history : most;
    }
    return most;
}

/* Where a generator's points go. */
struct filling {
    const struct scene *scene;
    struct store *store;
    size_t next;
    int32_t body;
    const struct material *material;
};

/* Programmed burn: distance to the nearest detonation point over the detonation speed; it takes no
 * notice of obstacles (spec 9.7). */
static double lighting_time(const struct filling *filling, const double position[3])
{
    const struct scene *scene = filling->scene;
    double earliest = column_row(COLUMN_LIGHTING_TIME)->initial;
    for (size_t i = 0; i < scene->n_detonations && filling->material->detonation_speed > 0; i++) {
        double square = 0;
        for (int a = 0; a < 3; a++)
            square += pow(position[a] - scene->detonations[i].position[a], 2);
        earliest = fmin(earliest, sqrt(square) / filling->material->detonation_speed);
    }
    return earliest;
}

static void fill_particle(void *context, const double position[3], double mass)
{
    struct filling *filling = context;
    struct store *store = filling->store;
    size_t p = filling->next++;
    for (int a = 0; a < 3; a++) {
        store->real[COLUMN_POSITION][a][p] = position[a];
        if (store_has(store, COLUMN_INITIAL_POSITION))
            store->real[COLUMN_INITIAL_POSITION][a][p] = position[a];
    }
    store->real[COLUMN_MASS][0][p] = mass * filling->scene->mass_scale;
    store->real[COLUMN_VOLUME][0][p] = mass / filling->material->density;
    if (store_has(store, COLUMN_YIELD_STRESS))
        store->real[COLUMN_YIELD_STRESS][0][p] = filling->material->yield_stress;
    store->real[COLUMN_ENERGY][0][p] = filling->material->initial_energy * store->real[COLUMN_VOLUME][0][p];
    if (store_has(store, COLUMN_LIGHTING_TIME))
        store->real[COLUMN_LIGHTING_TIME][0][p] = lighting_time(filling, position);
    store->integer[COLUMN_ID][p] = store->index_of_id[p] = (int32_t)p;
    store->integer[COLUMN_BODY][p] = filling->body;
}

static void create_particles(struct mpm *mpm)
{
    const struct scene *scene = mpm->scene;
    mpm->store = store_open((size_t)scene->n_particles, wanted_columns(scene));
    store_open_history(mpm->store, most_history(scene));
    struct filling filling = {.scene = scene, .store = mpm->store};
    for (size_t b = 0; b < scene->n_bodies; b++) {
        filling.body = (int32_t)b;
        filling.material = mpm->material_of_body[b];
        scene->bodies[b].generator.row->visit(&scene->bodies[b].generator, fill_particle, &filling);
    }
}

static void set_velocity(struct store *store, long id, const double velocity[3])
{
    for (int a = 0; a < 3; a++)
        store->real[COLUMN_VELOCITY][a][id] = velocity[a];
}

/* pi as the reference has it in its built-in fields: in single precision (spec 3.5). */
static const double PI_SINGLE = (double)3.1415926535f;

/* v0 sin(pi y / 6) along x for all particles. */
static void set_sine(struct mpm *mpm, double v0)
{
    for (size_t id = 0; id < mpm->store->count; id++) {
        double velocity[3] = {v0 * sin(PI_SINGLE * mpm->store->real[COLUMN_POSITION][1][id] / 6), 0, 0};
        set_velocity(mpm->store, (long)id, velocity);
    }
}

/* Half a sine wave along 4 rows of 320 particles. */
static void set_rows(struct mpm *mpm, double v0)
{
    for (long id = 0; id < 4 * 320; id++) {
        double velocity[3] = {v0 * sin(PI_SINGLE * ((double)(id % 320) * 0.003125 + 0.0015625)), 0, 0};
        set_velocity(mpm->store, id, velocity);
    }
}

/* First bending mode of a certain free plate, 128 rows of 384 particles (spec 3.5). */
static void set_bending(struct mpm *mpm, double y)
{
    const double q = 78.83, c1 = cosh(0.06 * q) - cos(0.06 * q), c2 = sinh(0.06 * q) - sin(0.06 * q), a = y / (2 * c2);
    const double w = q * q * sqrt(318e9 * 0.01 * 0.01 / (12 * 1845 * (1 - 0.054 * 0.054)));
    for (long id = 0; id < 128 * 384; id++) {
        double x = (double)(id % 384) * 0.00015625 + 0.000078125;
        double mode = c1 * (sinh(q * x) + sin(q * x)) - c2 * (cosh(q * x) + cos(q * x));
        set_velocity(mpm->store, id, (double[]){0, a * w * mode, 0});
    }
}

static void apply_velocities(struct mpm *mpm)
{
    const struct scene *scene = mpm->scene;
    for (size_t i = 0; i < scene->n_velocities; i++) {
        const struct scene_velocity *velocity = &scene->velocities[i];
        if (velocity->kind == VELOCITY_SINE)
            set_sine(mpm, velocity->value[0]);
        if (velocity->kind == VELOCITY_ROWS)
            set_rows(mpm, velocity->value[0]);
        if (velocity->kind == VELOCITY_BENDING)
            set_bending(mpm, velocity->value[0]);
        if (velocity->kind != VELOCITY_PARTICLE && velocity->kind != VELOCITY_BODY)
            continue;
        const struct scene_body *body = velocity->kind == VELOCITY_BODY ? &scene->bodies[velocity->target] : NULL;
        long first = body ? body->first : velocity->target, count = body ? body->count : 1;
        for (long id = first; id < first + count; id++)
            set_velocity(mpm->store, id, velocity->value);
    }
}

/* Limits count in, give or take the round-off of a lattice. */
static bool is_in_box(const struct store *store, long id, const double box[6])
{
    for (int a = 0; a < 3; a++) {
        const double x = store->real[COLUMN_POSITION][a][id], tolerance = 1e-9 * fmax(fabs(box[2 * a]), fabs(box[2 * a + 1]));
        if (x < box[2 * a] - tolerance || x > box[2 * a + 1] + tolerance)
            return false;
    }
    return true;
}

static void apply_loads(struct mpm *mpm)
{
    const struct scene *scene = mpm->scene;
    mpm->has_external_force = scene->damping > 0;
    for (size_t i = 0; i < scene->n_loads; i++) {
        const struct scene_load *load = &scene->loads[i];
        if (load->kind == LOAD_FACE)
            continue;
        mpm->has_external_force = true;
        if (load->kind == LOAD_GRAVITY) {
            for (int a = 0; a < 3; a++) /* weight is that of the true mass */
                mpm->bodies[load->target].gravity[a] = load->value[a] / scene->mass_scale;
            continue;
        }
        const struct scene_body *body = load->kind == LOAD_BODY ? &scene->bodies[load->target] : NULL;
        const bool is_box = load->kind == LOAD_BOX;
        long first = is_box ? 0 : body ? body->first : load->target, count = is_box ? scene->n_particles : body ? body->count : 1;
        for (long id = first; id < first + count; id++) {
            double scale = is_box || load->kind == LOAD_DENSITY ? mpm->store->real[COLUMN_VOLUME][0][id] : 1;
            for (int a = 0; a < 3 && (!is_box || is_in_box(mpm->store, id, load->box)); a++)
                mpm->store->real[COLUMN_LOAD][a][id] = scale * load->value[a];
        }
    }
}

/* --- bodies, cells, grid --- */

static void create_bodies(struct mpm *mpm)
{
    const struct scene *scene = mpm->scene;
    mpm->bodies = memory_array(scene->n_bodies, sizeof *mpm->bodies, "bodies");
    mpm->component_of_body = memory_array(scene->n_bodies, sizeof *mpm->component_of_body, "bodies");
    mpm->material_of_body = memory_array(scene->n_bodies, sizeof *mpm->material_of_body, "bodies");
    mpm->material_number_of_body = memory_array(scene->n_bodies, sizeof *mpm->material_number_of_body, "bodies");
    mpm->has_one_law = true;
    for (size_t b = 0; b < scene->n_bodies; b++) {
        int material = scene->bodies[b].generator.material;
        mpm->material_of_body[b] = &scene->materials[material].material;
        mpm->material_number_of_body[b] = material + 1;
        mpm->component_of_body[b] = scene->contact == CONTACT_NONE ? 0 : scene->bodies[b].component;
        double spacing = scene->bodies[b].generator.spacing;
        mpm->bodies[b].half_width = spacing > 0 ? fmin(0.5, 0.5 * spacing / scene->cell_size) : 0.25;
        mpm->has_one_law = mpm->has_one_law && mpm->material_of_body[b] == mpm->material_of_body[0];
    }
}

static struct cell_frame frame_of(const struct scene *scene)
{
    struct cell_frame frame = {.size = scene->cell_size};
    for (int a = 0; a < 3; a++) {
        double span = scene->grid[2 * a + 1] - scene->grid[2 * a];
        frame.low[a] = scene->grid[2 * a];
        frame.cells[a] = (int32_t)(span / scene->cell_size + 0.5);
        frame.high[a] = frame.low[a] + (double)frame.cells[a] * scene->cell_size;
    }
    return frame;
}

/* Nodes below this mass are light. */
static double light_mass(const struct scene *scene)
{
    double least = INFINITY;
    for (size_t i = 0; i < scene->n_materials; i++)
        least = fmin(least, scene->materials[i].material.density);
    return scene->light_mass > 0 ? scene->light_mass * least * scene->mass_scale * pow(scene->cell_size, 3) : 0;
}

static void create_cells(struct mpm *mpm)
{
    const struct scene *scene = mpm->scene;
    mpm->cells = cell_list_open(frame_of(scene), mpm->component_of_body, mpm->store->count, mpm->shape->reach);
    mpm->cells->count = (int32_t)mpm->n_open;
    cell_list_build(mpm->cells, mpm->store);
    if (scene->sorts)
        cell_list_sort(mpm->cells, mpm->store);
    const struct grid_form form = {
        .low = mpm->shape->reach,
        .high = 1 + mpm->shape->reach,
        .fields = mpm->contact ? NODE_FIELDS_CONTACT : NODE_FIELDS,
        .patch_fields = mpm->contact ? PATCH_FIELDS_CONTACT : PATCH_FIELDS,
        .boundary_layers = mpm->shape->reach > 0 ? 2 : 1,
    };
    mpm->grid = grid_open(mpm->cells, form, scene->boundary, scene->mass_cutoff);
    grid_hold(mpm->grid, scene->holds, scene->n_holds);
    mpm->grid->light_mass = light_mass(scene);
    mpm->grid->damping = scene->nodal_damping[0];
    mpm->grid->may_damp = scene->nodal_damping[0] > 0 || scene->nodal_damping[1] > 0;
    grid_follow(mpm->grid);
    if (mpm->shape->open_centres) {
        mpm->centres = mpm->shape->open_centres(mpm);
        grid_follow(mpm->centres);
    }
}

/* Bodies that lie outside the grid altogether take part in nothing: probably a mistake. */
static void warn_of_outsiders(const struct mpm *mpm, struct diagnostics *diagnostics)
{
    const struct scene *scene = mpm->scene;
    const struct store *store = mpm->store;
    if (scene->lost == LOST_DROP) /* left out on purpose */
        return;
    for (size_t b = 0; b < scene->n_bodies && mpm->cells->in_cells < mpm->cells->count; b++) {
        const struct scene_body *body = &scene->bodies[b];
        long outside = 0;
        for (long id = body->first; id < body->first + body->count; id++)
            outside += store->index_of_id[id] < mpm->cells->count && mpm->cells->cell[store->index_of_id[id]] == CELL_NONE;
        if (outside > 0)
            diagnostics_warning(diagnostics, body->place, "%ld of the %ld particles of this body lie outside the grid", outside,
                                body->count);
    }
}

/* Nearer to a face of cells than this part of a cell lies on it. */
static const double ON_FACE = 1e-9;

static bool is_on_face(const struct mpm *mpm, size_t p)
{
    const struct cell_frame *frame = &mpm->cells->frame;
    for (int a = 0; a < 3; a++) {
        const double x = (mpm->store->real[COLUMN_POSITION][a][p] - frame->low[a]) / frame->size;
        if (fabs(x - nearbyint(x)) < ON_FACE && x > ON_FACE && x < frame->cells[a] - ON_FACE)
            return true;
    }
    return false;
}

/* Gradients of linear shapes jump at faces: a body laid down on them strains one-sidedly, and flips with each
 * move. */
static void warn_of_faces(const struct mpm *mpm, struct diagnostics *diagnostics)
{
    const struct scene *scene = mpm->scene;
    if (scene->interpolation != INTERPOLATION_LINEAR || mpm->place != COLUMN_POSITION || scene->finds_equilibrium)
        return;
    for (size_t b = 0; b < scene->n_bodies; b++) {
        const struct scene_body *body = &scene->bodies[b];
        long on_faces = 0;
        for (long id = body->first; id < body->first + body->count; id++)
            on_faces += is_on_face(mpm, (size_t)mpm->store->index_of_id[id]);
        if (2 * on_faces > body->count)
            diagnostics_warning(diagnostics, body->place,
                                "%ld of the %ld particles of this body lie on faces of cells, where linear shapes jump: their stress "
                                "will be wrong; move the body or the grid, or take gimp or bimp",
                                on_faces, body->count);
    }
}

/* The particles of the curx curves: for each body the first one within a quarter cell, later
 * bodies win (spec 3.6). */
static void find_near_particles(struct mpm *mpm, struct scene *scene, struct diagnostics *diagnostics)
{
    const struct store *store = mpm->store;
    for (size_t i = 0; i < scene->n_curves; i++) {
        struct scene_curve *curve = &scene->curves[i];
        if (!curve->is_near)
            continue;
        curve->particle = -1;
        for (size_t b = scene->n_bodies; b-- > 0 && curve->particle < 0;)
            for (long id = scene->bodies[b].first; id < scene->bodies[b].first + scene->bodies[b].count; id++) {
                double farthest = 0;
                for (int a = 0; a < 3; a++)
                    farthest = fmax(farthest, fabs(store->real[COLUMN_POSITION][a][store->index_of_id[id]] - curve->point[a]));
                if (farthest <= scene->cell_size / 4) {
                    curve->particle = id;
                    break;
                }
            }
        if (curve->particle < 0)
            diagnostics_error(diagnostics, curve->place, "no particle within a quarter cell of (%g, %g, %g)",
                              curve->point[0], curve->point[1], curve->point[2]);
    }
}

static void create_workspaces(struct mpm *mpm)
{
    const size_t history = (size_t)mpm->store->n_history;
    mpm->n_workspaces = threads_available();
    mpm->workspaces = memory_array((size_t)mpm->n_workspaces, sizeof *mpm->workspaces, "threads");
    for (int i = 0; i < mpm->n_workspaces; i++) {
        mpm->workspaces[i].history = memory_array(history, sizeof(double *), "threads");
        mpm->workspaces[i].history_copy = memory_array(history * CHUNK_ROOM, sizeof(double), "threads");
    }
}

static void close_workspaces(struct mpm *mpm)
{
    for (int i = 0; i < mpm->n_workspaces; i++) {
        memory_free(mpm->workspaces[i].history);
        memory_free(mpm->workspaces[i].history_copy);
    }
    memory_free(mpm->workspaces);
}

static void start_sums(struct mpm *mpm)
{
    mpm->sums = mpm_total(mpm);
    mpm->start_energy = mpm->sums.kinetic + mpm->sums.internal;
    mpm->previous_kinetic = mpm->sums.kinetic;
    for (int a = 0; a < 3; a++)
        mpm->start_momentum[a] = mpm->sums.momentum[a];
    mpm->time_step = mpm->first_time_step = mpm_stable_step(mpm, 0); /* without the particles' speed (spec 5) */
}

struct mpm *mpm_open(struct scene *scene, struct timers *timers, struct diagnostics *diagnostics)
{
    static void (*const rotations[])(const struct law_batch *) = {
        [ROTATION_OFF] = NULL, [ROTATION_EXPLICIT] = law_rotate_explicit, [ROTATION_EXACT] = law_rotate_exact};
    struct mpm *mpm = memory_array(1, sizeof *mpm, "the run");
    mpm->scene = scene;
    mpm->timers = timers;
    static const struct shape *const shapes[] = {[INTERPOLATION_LINEAR] = &shape_linear, [INTERPOLATION_GIMP] = &shape_gimp,
                                                 [INTERPOLATION_GIMP_OWN] = &shape_gimp_own, [INTERPOLATION_BIMP] = &shape_bimp,
                                                 [INTERPOLATION_STAGGERED] = &shape_staggered};
    mpm->shape = shapes[scene->interpolation];
    mpm->load_factor = 1;
    mpm->is_total = scene->is_total;
    mpm->place = scene->is_total || scene->is_small ? COLUMN_INITIAL_POSITION : COLUMN_POSITION;
    mpm->straining_field = scene->scheme == SCHEME_USL ? NODE_MOMENTUM : NODE_STRAINING;
    mpm->strains_at_once = scene->scheme == SCHEME_USL && scene->transfer == TRANSFER_FLIP && mpm->shape == &shape_linear;
    mpm->step_scale = scene->step_scale;
    mpm->moves_last = scene->scheme != SCHEME_USF;
    mpm->damps_kinetic = scene->kinetic_damping;
    mpm->rotate = scene->is_small ? NULL : rotations[scene->rotation];
    contact_open(mpm);
    create_bodies(mpm);
    create_particles(mpm);
    apply_velocities(mpm);
    apply_loads(mpm);
    building_open(mpm, diagnostics);
    find_near_particles(mpm, scene, diagnostics);
    create_cells(mpm);
    warn_of_outsiders(mpm, diagnostics);
    warn_of_faces(mpm, diagnostics);
    overlap_warn(mpm, diagnostics);
    faces_open(mpm);
    create_workspaces(mpm);
    start_sums(mpm);
    mpm->equilibrium = equilibrium_open(mpm);
    return mpm;
}

void mpm_share_always(struct mpm *mpm)
{
    mpm->shares_always = true;
    mpm->cells->shared_blocks = 1;
    mpm->grid->shared_blocks = 1;
    if (mpm->centres)
        mpm->centres->shared_blocks = 1;
}

void mpm_close(struct mpm *mpm)
{
    if (!mpm)
        return;
    building_close(mpm);
    faces_close(mpm);
    contact_close(mpm);
    equilibrium_close(mpm->equilibrium);
    grid_close(mpm->grid);
    grid_close(mpm->centres);
    cell_list_close(mpm->cells);
    store_close(mpm->store);
    memory_free(mpm->bodies);
    memory_free(mpm->component_of_body);
    memory_free(mpm->material_of_body);
    memory_free(mpm->material_number_of_body);
    close_workspaces(mpm);
    memory_free(mpm->block_sums);
    memory_free(mpm);
}
