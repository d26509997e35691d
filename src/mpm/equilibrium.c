/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mpm/equilibrium.h"
#include "base/checkpoint.h"
#include "base/conjugate.h"
#include "base/memory.h"
#include "base/vector.h"
#include "mpm/chunk.h"
#include "mpm/multigrid.h"
#include "mpm/rigid.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Linear systems are solved to this part of their right side; the tolerance of the search leaves this to them. */
static const double LINEAR_TOLERANCE = 1e-4, LINEAR_SHARE = 0.3;
/* A Newton step is shortened so that no displacement gradient at a particle exceeds this. */
static const double LARGEST_GRADIENT = 0.1;
/* Forces may grow in between, where slender bodies turn or plastic flow begins, if a step leaves less than this of their
 * work on it and they are not this many times the reference. */
static const double LEAST_DECREASE = 0.8, LARGEST_GROWTH = 100;
/* Steps whose longest way is below this part of a cell are small: particles may be kept in cells that they left. */
static const double SMALL_WAY = 0.05;
/* Forces below this part of those of single particles are their round-off. */
static const double ROUND_OFF = 1e-14;
/* Motion with kinetic damping takes this part of the stable step at most: nodes of small mass want less than dtsc's 0.9. */
static const double DAMPED_SCALE = 0.5;
/* Iterations of a linear system; halvings of a step whose forces grow; small whole steps in which particles
 * may change cells, which lets forces jump; time steps with kinetic damping, and of these between two looks at the forces. */
enum { LINEAR_ITERATIONS = 1000, HALVINGS = 4, CROSSING_STEPS = 4, DAMPED_STEPS = 50000, DAMPED_LOOK = 20 };

/* What a step changes in the particles. */
static const enum column saved[] = {COLUMN_POSITION, COLUMN_STRESS, COLUMN_VOLUME, COLUMN_ENERGY, COLUMN_VISCOUS_PRESSURE,
                                    COLUMN_PLASTIC_STRAIN, COLUMN_YIELD_STRESS, COLUMN_MEAN_STRESS, COLUMN_EQUIVALENT_STRESS,
                                    COLUMN_TEMPERATURE, COLUMN_DAMAGE, COLUMN_FAILED, COLUMN_DEFORMATION};
enum { SAVED = sizeof saved / sizeof saved[0], SAVED_STRESS = 1 };

struct equilibrium {
    struct multigrid multigrid;
    struct conjugate_room room;
    struct rigid rigid;
    struct light_nodes light;
    double *force, *right, *displacement; /* vectors on the nodes: [block][3][64] */
    size_t force_capacity, right_capacity, displacement_capacity;
    double *copy[SAVED][COLUMN_COMPONENTS]; /* the particles before a step */
    double *deviator[6]; /* with laws that are not elastic: the particles' strains in a step, */
    double *softening;   /* and what is left of their shear moduli */
    double reference;
    double limit;    /* the search ends where the forces' length is not above */
    double size;     /* present length of the unbalanced forces */
    double work;     /* of external forces in the step just tried */
    double moved;    /* particles that changed cell in it */
    bool can_soften;  /* some law is not elastic */
    bool is_soft;     /* the next step takes the softened stiffness */
    bool is_singular; /* a linear system of the search had no solution */
    double seconds;
    struct equilibrium_report report;
};

struct equilibrium *equilibrium_open(const struct mpm *mpm)
{
    if (!mpm->scene->finds_equilibrium)
        return NULL;
    struct equilibrium *equilibrium = memory_array(1, sizeof *equilibrium, "equilibrium");
    for (int i = 0; i < SAVED; i++)
        for (int a = 0; a < COLUMN_COMPONENTS && mpm->store->real[saved[i]][a]; a++)
            equilibrium->copy[i][a] = memory_array(mpm->store->count, sizeof(double), "equilibrium");
    for (size_t i = 0; i < mpm->scene->n_materials; i++) {
        const struct law *law = mpm->scene->materials[i].material.law;
        equilibrium->can_soften = equilibrium->can_soften || (law != &law_elas && law != &law_neoh);
    }
    for (int i = 0; i < 6 && equilibrium->can_soften; i++)
        equilibrium->deviator[i] = memory_array(mpm->store->count, sizeof(double), "equilibrium");
    if (equilibrium->can_soften)
        equilibrium->softening = memory_array(mpm->store->count, sizeof(double), "equilibrium");
    return equilibrium;
}

void equilibrium_close(struct equilibrium *equilibrium)
{
    if (!equilibrium)
        return;
    multigrid_close(&equilibrium->multigrid);
    conjugate_close(&equilibrium->room);
    rigid_close(&equilibrium->rigid);
    light_nodes_close(&equilibrium->light);
    memory_free(equilibrium->force);
    memory_free(equilibrium->right);
    memory_free(equilibrium->displacement);
    for (int i = 0; i < SAVED; i++)
        for (int a = 0; a < COLUMN_COMPONENTS; a++)
            memory_free(equilibrium->copy[i][a]);
    for (int i = 0; i < 6; i++)
        memory_free(equilibrium->deviator[i]);
    memory_free(equilibrium->softening);
    memory_free(equilibrium);
}

void equilibrium_exchange(struct mpm *mpm, struct checkpoint *checkpoint)
{
    checkpoint_item(checkpoint, "largest unbalanced forces", &mpm->equilibrium->reference, sizeof mpm->equilibrium->reference, 1);
}

const struct equilibrium_report *equilibrium_report(const struct mpm *mpm)
{
    return &mpm->equilibrium->report;
}

void equilibrium_cost(const struct mpm *mpm, long *applications, double *seconds)
{
    *applications = mpm->equilibrium->multigrid.applications;
    *seconds = mpm->equilibrium->seconds;
}

/* --- forces --- */

static size_t vector_count(const struct mpm *mpm)
{
    return (size_t)mpm->cells->n_blocks * STIFFNESS_VECTOR;
}

static void scatter_all(struct mpm *mpm, int32_t b)
{
    mpm->shape->scatter(mpm, b, true, true);
}

/* Unbalanced forces of a block's nodes, whatever their mass: static forces don't depend on it. */
static void take_force(const struct mpm *mpm, int32_t b, double *force)
{
    const size_t first = (size_t)b * BLOCK_CELLS;
    for (int a = 0; a < 3; a++) {
        const double *from = grid_field(mpm->grid, b, NODE_FORCE + a);
        for (int n = 0; n < BLOCK_CELLS; n++) {
            bool is_part = mpm->equilibrium->rigid.part_of_node[first + (size_t)n] >= 0;
            force[a * BLOCK_CELLS + n] = is_part && !(mpm->grid->fixed[first + (size_t)n] >> a & 1) ? from[n] : 0;
        }
    }
}

/* Finds the unbalanced forces and their length: those of light nodes moved to the ones they follow, and without
 * resultants along free motions; returns the length of these. */
static double renew_forces(struct mpm *mpm)
{
    struct equilibrium *equilibrium = mpm->equilibrium;
    const int32_t blocks = mpm->cells->n_blocks;
    timers_enter(mpm->timers, PHASE_SCATTER);
    mpm_each_block(mpm, scatter_all);
    faces_scatter(mpm, NODE_FORCE - NODE_MASS);
    timers_enter(mpm->timers, PHASE_GRID);
    equilibrium->force = memory_grow(equilibrium->force, &equilibrium->force_capacity, vector_count(mpm), sizeof(double),
                                     "equilibrium");
#pragma omp parallel for schedule(static) if (blocks >= mpm->grid->shared_blocks)
    for (int32_t b = 0; b < blocks; b++)
        grid_collect(mpm->grid, b, NODE_MASS, 7, 0);
    rigid_connect(&equilibrium->rigid, mpm);
    light_nodes_find(&equilibrium->light, mpm, equilibrium->rigid.part_of_node);
    rigid_find(&equilibrium->rigid, mpm, equilibrium->light.is_light);
    for (int32_t b = 0; b < blocks; b++)
        take_force(mpm, b, equilibrium->force + (size_t)b * STIFFNESS_VECTOR);
    light_nodes_lead(&equilibrium->light, mpm->grid->fixed, equilibrium->force);
    double resultant = rigid_remove_force(&equilibrium->rigid, mpm, equilibrium->force);
    equilibrium->size = vector_length(equilibrium->force, vector_count(mpm));
    return resultant;
}

/* Length of all forces that single particles give to nodes. */
static double particle_forces(const struct mpm *mpm)
{
    double sum = 0;
    for (int32_t k = 0; k < mpm->cells->in_cells; k++) {
        double t[3][3];
        mpm_force_stress(mpm, (size_t)mpm->cells->order[k], FORCE_ANY, t);
        for (int i = 0; i < 9; i++)
            sum += t[i / 3][i % 3] * t[i / 3][i % 3];
    }
    return sqrt(sum);
}

/* --- particles before a step --- */

static void save(const struct mpm *mpm)
{
    const size_t bytes = (size_t)mpm->cells->count * sizeof(double);
    for (int i = 0; i < SAVED; i++)
        for (int a = 0; a < COLUMN_COMPONENTS && mpm->equilibrium->copy[i][a]; a++)
            memcpy(mpm->equilibrium->copy[i][a], mpm->store->real[saved[i]][a], bytes);
}

static void find_cells(struct mpm *mpm)
{
    if (mpm->keeps_cells)
        return;
    timers_enter(mpm->timers, PHASE_CELLS);
    cell_list_update(mpm->cells, mpm->store);
    grid_follow(mpm->grid);
}

static void restore(struct mpm *mpm)
{
    const size_t bytes = (size_t)mpm->cells->count * sizeof(double);
    for (int i = 0; i < SAVED; i++)
        for (int a = 0; a < COLUMN_COMPONENTS && mpm->equilibrium->copy[i][a]; a++)
            memcpy(mpm->store->real[saved[i]][a], mpm->equilibrium->copy[i][a], bytes);
    timers_enter(mpm->timers, PHASE_CELLS);
    cell_list_build(mpm->cells, mpm->store);
    grid_follow(mpm->grid);
}

/* --- a Newton step --- */

/* Work of the particles' loads on the way that they just went. */
static void add_work(struct mpm *mpm, int32_t b)
{
    const struct cell_block *block = &mpm->cells->blocks[b];
    double work = 0;
    for (int32_t k = block->first; k < block->first + block->count && mpm->has_external_force; k++) {
        const int32_t p = mpm->cells->order[k];
        double force[3];
        mpm_external_force(mpm, (size_t)p, force);
        for (int a = 0; a < 3; a++)
            work += force[a] * (mpm->store->real[COLUMN_POSITION][a][p] - mpm->equilibrium->copy[0][a][p]);
    }
    mpm->block_sums[b].work = work;
}

/* Strains and moves the particles by `scale` times the nodes' displacements, at no speed. */
static void move(struct mpm *mpm, double scale)
{
    struct equilibrium *equilibrium = mpm->equilibrium;
    const int32_t active = mpm->cells->active;
    for (int32_t b = 0; b < mpm->cells->n_blocks; b++)
        for (int a = 0; a < 3; a++) {
            const double *from = equilibrium->displacement + (size_t)b * STIFFNESS_VECTOR + (size_t)a * BLOCK_CELLS;
            double *velocity = grid_field(mpm->grid, b, NODE_MOMENTUM + a);
            double *straining = grid_field(mpm->grid, b, NODE_STRAINING + a);
            for (int n = 0; n < BLOCK_CELLS; n++)
                velocity[n] = straining[n] = scale * from[n] / mpm->time_step;
        }
    timers_enter(mpm->timers, PHASE_STRESS);
    mpm_clear_sums(mpm);
    mpm_each_block(mpm, mpm->shape->gather_strain);
    equilibrium->work = faces_work(mpm);
    mpm_each_block(mpm, add_work);
    equilibrium->moved = 0;
    mpm->sums.least_volume = DBL_MAX;
    for (int32_t b = 0; b < active; b++) {
        equilibrium->work += mpm->block_sums[b].work;
        equilibrium->moved += mpm->block_sums[b].moved;
        mpm->sums.least_volume = fmin(mpm->sums.least_volume, mpm->block_sums[b].least_volume);
    }
    mpm->cells->moved += equilibrium->moved;
    find_cells(mpm);
}

/* Solves K du = force. */
static enum conjugate_ending find_displacement(struct mpm *mpm)
{
    struct equilibrium *equilibrium = mpm->equilibrium;
    const size_t count = vector_count(mpm);
    const double start = threads_clock();
    timers_enter(mpm->timers, PHASE_SYSTEM);
    equilibrium->right = memory_grow(equilibrium->right, &equilibrium->right_capacity, count, sizeof(double), "equilibrium");
    equilibrium->displacement = memory_grow(equilibrium->displacement, &equilibrium->displacement_capacity, count,
                                            sizeof(double), "equilibrium");
    multigrid_open(&equilibrium->multigrid, mpm, &equilibrium->light, equilibrium->is_soft ? equilibrium->softening : NULL,
                   equilibrium->report.newton_steps > 0);
    memcpy(equilibrium->right, equilibrium->force, count * sizeof(double));
    const struct conjugate_problem problem = {&equilibrium->multigrid, multigrid_apply, multigrid_precondition, count};
    double target = fmax(LINEAR_SHARE * equilibrium->limit, LINEAR_TOLERANCE * equilibrium->size);
    struct conjugate_result result = conjugate_solve(&problem, &equilibrium->room, equilibrium->displacement,
                                                     equilibrium->right, target, LINEAR_ITERATIONS);
    rigid_remove_motion(&equilibrium->rigid, mpm, equilibrium->displacement);
    light_nodes_follow(&equilibrium->light, mpm->grid->fixed, equilibrium->displacement);
    equilibrium->report.iterations += result.iterations;
    equilibrium->seconds += threads_clock() - start;
    return result.ending;
}

/* How much of the step can be taken at once. */
static double largest_scale(const struct mpm *mpm)
{
    const struct equilibrium *equilibrium = mpm->equilibrium;
    double largest = 0;
    for (int32_t b = 0; b < mpm->cells->active; b++)
        largest = fmax(largest, stiffness_strains(mpm, &equilibrium->multigrid.level[0].stiffness, equilibrium->displacement,
                                                  b, equilibrium->can_soften ? equilibrium->deviator : NULL));
    return largest > LARGEST_GRADIENT ? LARGEST_GRADIENT / largest : 1;
}

/* What the law made of each particle's deviatoric strain, of what an elastic one would have: the next step goes on with
 * that part of the shear modulus. */
static void find_softening(struct mpm *mpm, double scale)
{
    static const double LEAST = 0.003, LEAST_STRAIN = 1e-12;
    struct equilibrium *equilibrium = mpm->equilibrium;
    for (int32_t k = 0; k < mpm->cells->in_cells && equilibrium->can_soften; k++) {
        const int32_t p = mpm->cells->order[k];
        const double shear = mpm->material_of_body[mpm->store->integer[COLUMN_BODY][p]]->shear_modulus;
        double answer = 0, square = 0;
        for (int i = 0; i < 6; i++) {
            const double strain = scale * equilibrium->deviator[i][p], count = i < 3 ? 1 : 2;
            answer += count * strain * (mpm->store->real[COLUMN_STRESS][i][p] - equilibrium->copy[SAVED_STRESS][i][p]);
            square += count * strain * strain;
        }
        if (square > LEAST_STRAIN * LEAST_STRAIN)
            equilibrium->softening[p] = fmin(1, fmax(LEAST, answer / (2 * shear * square)));
        else if (equilibrium->report.newton_steps == 1)
            equilibrium->softening[p] = 1;
    }
}

/* Work of the unbalanced forces on the displacements; the blocks may have changed since these were found. */
static double work_of_forces(const struct mpm *mpm)
{
    const struct equilibrium *equilibrium = mpm->equilibrium;
    const struct stiffness *then = &equilibrium->multigrid.level[0].stiffness;
    double work = 0;
    for (int32_t b = 0; b < then->n_blocks; b++) {
        int32_t now = cell_list_find_block(mpm->cells, then->blocks[b].at, 0);
        if (now >= 0)
            work += vector_dot(equilibrium->force + (size_t)now * STIFFNESS_VECTOR,
                               equilibrium->displacement + (size_t)b * STIFFNESS_VECTOR, STIFFNESS_VECTOR);
    }
    return work;
}

/* Largest displacement of a node, in cells. */
static double largest_way(const struct mpm *mpm)
{
    const struct equilibrium *equilibrium = mpm->equilibrium;
    const size_t count = multigrid_count(&equilibrium->multigrid);
    double largest = 0;
    for (size_t i = 0; i < count; i++)
        largest = fmax(largest, fabs(equilibrium->displacement[i]));
    return largest / mpm->cells->frame.size;
}

/* Moves by the displacements found, or by less while the forces grow and so does the energy. Energy that a motion
 * there would lose: the work of the unbalanced forces, whose mean is half the sum of those before and after. */
static bool take_step(struct mpm *mpm, int *crossing)
{
    struct equilibrium *equilibrium = mpm->equilibrium;
    const double before = equilibrium->size, lost = work_of_forces(mpm);
    double scale = largest_scale(mpm);
    save(mpm);
    for (int halvings = 0; halvings <= HALVINGS; halvings++, scale /= 2) {
        move(mpm, scale);
        renew_forces(mpm);
        bool is_sound = isfinite(equilibrium->size) && mpm->sums.least_volume > 0;
        double left = work_of_forces(mpm);
        bool is_less = equilibrium->size < before || equilibrium->size <= equilibrium->limit;
        bool is_flatter = fabs(left) < LEAST_DECREASE * lost && equilibrium->size < LARGEST_GROWTH * equilibrium->reference;
        bool may_grow = equilibrium->moved > 0 && equilibrium->size < equilibrium->reference;
        if (is_sound && (is_less || is_flatter || may_grow)) {
            *crossing += equilibrium->moved > 0 && scale == 1 && largest_way(mpm) < SMALL_WAY;
            find_softening(mpm, scale);
            equilibrium->is_soft = equilibrium->can_soften;
            mpm->external_work += equilibrium->work;
            mpm->removed_energy += 0.5 * scale * (lost + left);
            return true;
        }
        restore(mpm);
    }
    renew_forces(mpm);
    return false;
}

static void say(struct equilibrium_report *report, const char *cause, const char *advice)
{
    snprintf(report->cause, sizeof report->cause, "%s", cause);
    snprintf(report->advice, sizeof report->advice, "%s", advice);
}

/* Finds the cells anew of particles that were kept in theirs. */
static void release_cells(struct mpm *mpm)
{
    struct equilibrium_report *report = &mpm->equilibrium->report;
    const double size = mpm->cells->frame.size;
    if (!mpm->keeps_cells)
        return;
    for (int32_t b = 0; b < mpm->cells->active; b++) {
        const struct cell_block *block = &mpm->cells->blocks[b];
        const struct chunk chunk = {.block = block};
        for (int32_t k = block->first; k < block->first + block->count; k++) {
            const int32_t p = mpm->cells->order[k];
            double most = 0;
            for (int a = 0; a < 3; a++) {
                const double low = chunk_cell_low(mpm, &chunk, mpm->cells->cell[p], a);
                const double local = (mpm->store->real[mpm->place][a][p] - low) / size;
                most = fmax(most, fmax(-local, local - 1));
            }
            report->kept_particles += most > 0;
            report->kept_distance = fmax(report->kept_distance, most);
        }
    }
    mpm->keeps_cells = false;
    timers_enter(mpm->timers, PHASE_CELLS);
    cell_list_build(mpm->cells, mpm->store);
    grid_follow(mpm->grid);
}

/* Newton's method from the present state; the report tells how it ended. */
static void search(struct mpm *mpm)
{
    struct equilibrium *equilibrium = mpm->equilibrium;
    struct equilibrium_report *report = &equilibrium->report;
    int crossing = 0;
    report->state = EQUILIBRIUM_MISSED;
    while (equilibrium->size > equilibrium->limit) {
        if (report->newton_steps == mpm->scene->equilibrium_steps) {
            say(report, "the unbalanced forces fall too slowly",
                equilibrium->moved > 0 ? "particles change cells all the time: try smaller loads or a larger tolerance of quas"
                                       : "try more steps of quas, smaller loads, or QuLo and drda instead of quas");
            return;
        }
        enum conjugate_ending ending = find_displacement(mpm);
        report->newton_steps++;
        mpm->keeps_cells = crossing == CROSSING_STEPS;
        equilibrium->is_singular = ending == CONJUGATE_SINGULAR;
        bool is_taken = take_step(mpm, &crossing);
        if (equilibrium->is_singular && equilibrium->size > equilibrium->limit) {
            say(report, "a force acts on something that has no stiffness",
                "a part that hangs on a node or an edge, or a mode of cells with one particle: hold it, or take more "
                "particles a cell");
            return;
        }
        if (!is_taken && !equilibrium->is_soft) {
            say(report, "the unbalanced forces do not fall any more", "try smaller loads, or a larger tolerance of quas");
            return;
        }
        if (!is_taken) /* an elastic stiffness goes less far, and in a safe direction */
            equilibrium->is_soft = false;
    }
    report->state = EQUILIBRIUM_FOUND;
    release_cells(mpm);
    if (report->kept_distance > SMALL_WAY) {
        report->state = EQUILIBRIUM_MISSED;
        say(report, "forces jump as particles change cells", "try smaller loads, or more particles a cell");
    }
}

/* --- motion with kinetic damping --- */

static void settle(struct mpm *mpm)
{
    struct equilibrium *equilibrium = mpm->equilibrium;
    struct equilibrium_report *report = &equilibrium->report;
    const long step = mpm->step;
    const double time = mpm->time;
    mpm->damps_kinetic = true;
    mpm->step_scale = fmin(mpm->scene->step_scale, DAMPED_SCALE);
    mpm->time_step = mpm->first_time_step * mpm->step_scale / mpm->scene->step_scale;
    while (report->damped_steps < DAMPED_STEPS && report->state != EQUILIBRIUM_FOUND) {
        mpm_step(mpm);
        report->damped_steps++;
        if (mpm_check(mpm).is_stopped)
            break;
        if (report->damped_steps % DAMPED_LOOK == 0 || mpm->sums.kinetic == 0) {
            renew_forces(mpm);
            if (equilibrium->size <= equilibrium->limit)
                report->state = EQUILIBRIUM_FOUND;
        }
    }
    mpm->damps_kinetic = mpm->scene->kinetic_damping;
    mpm->step_scale = mpm->scene->step_scale;
    mpm->step = step;
    mpm->time = time;
    renew_forces(mpm);
    if (report->state != EQUILIBRIUM_FOUND)
        say(report, "neither Newton's method nor kinetic damping leads to an equilibrium",
            "is there one under these loads? try smaller loads, or a larger tolerance of quas");
}

/* --- the whole search --- */

/* No motion, and no viscous pressure from motion. */
static void still(struct mpm *mpm)
{
    static const enum column columns[] = {COLUMN_VELOCITY, COLUMN_AFFINE, COLUMN_VISCOUS_PRESSURE};
    for (size_t i = 0; i < sizeof columns / sizeof columns[0]; i++)
        for (int a = 0; a < COLUMN_COMPONENTS && mpm->store->real[columns[i]][a]; a++)
            memset(mpm->store->real[columns[i]][a], 0, (size_t)mpm->cells->count * sizeof(double));
}

/* Where the largest unbalanced force is. */
static void find_worst(const struct mpm *mpm)
{
    const struct equilibrium *equilibrium = mpm->equilibrium;
    struct equilibrium_report *report = &mpm->equilibrium->report;
    double largest = -1, nearest = DBL_MAX;
    for (int32_t b = 0; b < mpm->cells->n_blocks; b++)
        for (int n = 0; n < BLOCK_CELLS; n++) {
            const double *force = equilibrium->force + (size_t)b * STIFFNESS_VECTOR + n;
            double square = force[0] * force[0] + force[64] * force[64] + force[128] * force[128];
            const int in_block[3] = {n % 4, n / 4 % 4, n / 16};
            if (square <= largest)
                continue;
            largest = square;
            for (int a = 0; a < 3; a++)
                report->worst[a] = mpm->cells->frame.low[a]
                                 + (mpm->cells->blocks[b].at[a] * BLOCK_EDGE + in_block[a]) * mpm->cells->frame.size;
        }
    report->particle = -1;
    for (int32_t k = 0; k < mpm->cells->in_cells; k++) {
        const int32_t p = mpm->cells->order[k];
        double square = 0;
        for (int a = 0; a < 3; a++)
            square += pow(mpm->store->real[COLUMN_POSITION][a][p] - report->worst[a], 2);
        if (square < nearest) {
            nearest = square;
            report->particle = mpm->store->integer[COLUMN_ID][p];
        }
    }
}

/* What is to be balanced, and how well; false when there is no balance. */
static bool start_search(struct mpm *mpm)
{
    struct equilibrium *equilibrium = mpm->equilibrium;
    struct equilibrium_report *report = &equilibrium->report;
    const struct rigid *rigid = &equilibrium->rigid;
    double resultant = renew_forces(mpm);
    equilibrium->reference = fmax(equilibrium->reference, equilibrium->size);
    equilibrium->limit = fmax(mpm->scene->equilibrium_tolerance * equilibrium->reference, ROUND_OFF * particle_forces(mpm));
    report->floating = rigid->n_floating;
    report->floating_motions = rigid->motions;
    report->floating_body = rigid->body;
    if (resultant <= equilibrium->limit)
        return true;
    report->state = EQUILIBRIUM_LOADED;
    equilibrium->size = hypot(equilibrium->size, resultant);
    equilibrium->reference = fmax(equilibrium->reference, resultant);
    snprintf(report->cause, sizeof report->cause, "body %d floats freely and its loads have a resultant of force or moment",
             rigid->body + 1);
    snprintf(report->advice, sizeof report->advice, "hold it (fixed), or let the loads balance each other");
    return false;
}

enum equilibrium_state mpm_equilibrate(struct mpm *mpm)
{
    struct equilibrium *equilibrium = mpm->equilibrium;
    const double step = mpm->time_step;
    equilibrium->report = (struct equilibrium_report){.particle = -1};
    equilibrium->is_singular = equilibrium->is_soft = false;
    mpm->step++;
    mpm->updates += mpm->cells->count;
    mpm->load_factor = 1;
    mpm->moves_last = true;
    /* a power of two, so that displacements come back as they were, and so long that nothing has a rate */
    mpm->time_step = ldexp(1, ilogb(mpm->first_time_step) + 80);
    still(mpm);
    if (start_search(mpm))
        search(mpm);
    release_cells(mpm);
    mpm->moves_last = mpm->scene->scheme != SCHEME_USF;
    mpm->time_step = step;
    if (equilibrium->report.state == EQUILIBRIUM_MISSED && !equilibrium->is_singular)
        settle(mpm);
    still(mpm);
    mpm->time_step = step;
    smoothing_start(mpm);
    smoothing_finish(mpm);
    double least_volume = mpm->sums.least_volume;
    mpm->sums = mpm_total(mpm);
    mpm->sums.least_volume = least_volume;
    mpm->previous_kinetic = mpm->sums.kinetic;
    mpm->unbalanced = mpm->sums.internal + mpm->removed_energy - mpm->start_energy - mpm->external_work;
    mpm_discard_grid(mpm);
    timers_enter(mpm->timers, PHASE_OTHER);
    equilibrium->report.reference = equilibrium->reference;
    equilibrium->report.residual = equilibrium->reference > 0 ? equilibrium->size / equilibrium->reference : 0;
    if (equilibrium->report.state != EQUILIBRIUM_FOUND)
        find_worst(mpm);
    return equilibrium->report.state;
}

struct instability equilibrium_check(const struct mpm *mpm)
{
    const struct equilibrium_report *report = &mpm->equilibrium->report;
    struct instability result = {.particle = -1};
    if (report->state == EQUILIBRIUM_FOUND)
        return mpm_check(mpm);
    result.is_stopped = true;
    result.particle = report->particle;
    snprintf(result.cause, sizeof result.cause, "no equilibrium found: %.140s", report->cause);
    snprintf(result.advice, sizeof result.advice, "%s", report->advice);
    return result;
}
