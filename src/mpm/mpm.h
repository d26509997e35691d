/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The material point method: what a run of it owns, and its steps (thesis 3.1.4, spec 6). */
#ifndef MPM_MPM_H
#define MPM_MPM_H

#include "base/instability.h"
#include "base/threads.h"
#include "base/timers.h"
#include "deck/scene.h"
#include "mpm/grid.h"

struct diagnostics;
struct workspace;
struct face_load;
struct contact;
struct schedule;
struct heat;
struct equilibrium;
struct checkpoint;

/* Sums over particles, per block and in all. */
struct sums {
    double kinetic, internal;
    double momentum[3];
    double work;          /* of external forces in this step */
    double changed;       /* kinetic energy of the changes of velocity in this step; only with nodal damping */
    double fastest;       /* largest velocity component */
    double least_volume;
    double moved;         /* particles that changed cell */
};

/* What external forces act on particles of a body or material. */
struct body_data {
    double gravity[3];
    double half_width; /* of a particle, in cells: for gimp cp */
};

/* A shape function: its passes over the particles of one block. One const row each. */
struct mpm;
struct shape {
    const char *name;
    int reach; /* cells beyond its own that a particle's support spans on the low side */
    /* With contact, force comes with the normals behind it. */
    void (*scatter)(struct mpm *mpm, int32_t block, bool momentum, bool force);
    void (*gather_velocity)(struct mpm *mpm, int32_t block);
    void (*gather_strain)(struct mpm *mpm, int32_t block);
    /* Only with auxiliary points between particles and nodes, else NULL: makes them, and what is
     * done on them and the nodes in place of the grid's own passes. */
    struct grid *(*open_centres)(const struct mpm *mpm);
    void (*strain_first)(struct mpm *mpm);
    void (*integrate)(struct mpm *mpm, bool with_momentum);
    void (*strain_last)(struct mpm *mpm);
    /* Smoothed pressure (spec 9.6): volume and volume times pressure to the patches, node sums (NULL:
     * the grid's own), and back; with the particles' places at the start of the step, or after it. */
    void (*smooth_give)(struct mpm *mpm, int32_t block);
    void (*smooth_nodes)(struct mpm *mpm);
    void (*smooth_take)(struct mpm *mpm, int32_t block);
    bool smooths_at_start;
};

extern const struct shape shape_linear, shape_gimp, shape_gimp_own, shape_bimp, shape_staggered;

struct mpm {
    const struct scene *scene;
    struct store *store;
    struct cell_list *cells;
    struct grid *grid;
    struct grid *centres; /* auxiliary points of the staggered grid, or NULL */
    const struct shape *shape;
    struct body_data *bodies;
    int32_t *component_of_body;
    const struct material **material_of_body;
    int *material_number_of_body;
    void (*rotate)(const struct law_batch *batch); /* NULL: no rotation */
    enum column place;       /* positions that tell cells and weights: present, or initial ones (TLmp) */
    bool is_total;           /* total Lagrangian: cells stay, forces from the first Piola-Kirchhoff stress */
    int straining_field;     /* node field of the velocities that strain particles: of the scheme */
    bool shares_always;      /* threads share the work however little there is: a number was asked for */
    bool strains_at_once;    /* usl: the velocity pass strains and moves the particles too */
    bool moves_last;         /* particles move where they are strained: in all schemes but usf */
    bool keeps_cells;        /* particles that move stay in their cells' lists, weights go on linearly */
    bool damps_kinetic;      /* velocities go to zero whenever the kinetic energy falls */
    double step_scale;       /* of the scene, or less */
    bool smooths;            /* the next step computes the smoothed pressure */
    bool has_external_force; /* loads, gravity or damping */
    bool has_one_law;        /* all bodies share one material */
    struct equilibrium *equilibrium; /* for quas, or NULL */
    struct contact *contact; /* NULL: all components share one velocity field */
    double contact_force[3]; /* sum over nodes in the last step */
    struct face_load *faces;
    size_t n_faces;
    struct workspace *workspaces; /* one a thread */
    int n_workspaces;
    struct sums *block_sums;
    size_t block_sums_capacity;
    struct timers *timers;
    struct schedule *schedule; /* of particles that open, or NULL */
    struct heat *heat;         /* the hot zone around the last one, or NULL */
    size_t n_open;             /* particles that are open at the start */
    bool *is_material_open;    /* per material: its wave speed limits the step */
    double updates;            /* particles that took part, summed over steps */

    long step;
    double time;
    double time_step;       /* of the step under way, or of the next one */
    double taken_step;      /* of the last step */
    double first_time_step;
    double momentum_factor; /* 1/2 in the first step */
    double load_factor;     /* 1, or less while QuLo's loads grow */
    struct sums sums;       /* after the last step */
    double start_energy;
    double external_work;   /* of all forces since the start */
    double removed_energy;  /* by kinetic damping */
    double unbalanced;      /* energy that is not accounted for, kinetic and internal at one time */
    double energy_supply;   /* largest energy that the start and external forces have given so far */
    long growing_steps;     /* so many steps has the energy been beyond all that was given */
    double previous_kinetic;
    double start_momentum[3];
};

/* Builds the run of a scene: particles, cells, grid. Mistakes that only show now (curx) go to
 * `diagnostics`. */
struct mpm *mpm_open(struct scene *scene, struct timers *timers, struct diagnostics *diagnostics);
void mpm_close(struct mpm *mpm);

/* Lets threads share the work of small scenes too, where they only cost. */
void mpm_share_always(struct mpm *mpm);

/* One step. */
void mpm_step(struct mpm *mpm);

/* The time step that `dtfx` or the wave speeds allow (spec 5), with particles of some speed. */
double mpm_stable_step(const struct mpm *mpm, double fastest);

/* Writes the whole state between two steps to a checkpoint, or takes it from one into a run of the same deck
 * that was just opened. What does not fit is reported there. */
void mpm_exchange(struct mpm *mpm, struct checkpoint *checkpoint);

/* Whether energy is far beyond what the start and external forces gave, and for how long; once a step. */
void mpm_watch_energy(struct mpm *mpm);

/* Looks at the sums of the last step (and at particles only when something is wrong). */
struct instability mpm_check(const struct mpm *mpm);

/* Sums over all particles, without a step: for the start. */
struct sums mpm_total(const struct mpm *mpm);

/* Energy that is not accounted for, relative to the largest energy that took part. */
double mpm_energy_error(const struct mpm *mpm);

/* Whether so much energy came from nowhere that the run should not be trusted, though it came to its end. */
bool mpm_has_gained_energy(const struct mpm *mpm);

/* --- used by the passes --- */

/* Runs `pass` on all active blocks, shared among the threads. A pass writes only to its block's
 * particles, patch and sums. */
typedef void block_pass(struct mpm *mpm, int32_t block);
void mpm_each_block(struct mpm *mpm, block_pass *pass);

/* Clears the blocks' sums before passes add to them. */
void mpm_clear_sums(struct mpm *mpm);

/* Thesis step 9: the deformed grid is given up; particles find their new cells, and their order in memory
 * follows when many have moved. */
void mpm_discard_grid(struct mpm *mpm);

/* Force per particle besides stress (spec 6 C): load, gravity, damping. */
THREADS_INLINE void mpm_external_force(const struct mpm *mpm, size_t p, double force[3])
{
    const struct store *store = mpm->store;
    const double *gravity = mpm->bodies[store->integer[COLUMN_BODY][p]].gravity;
    double mass = store->real[COLUMN_MASS][0][p];
    for (int a = 0; a < 3; a++) {
        double load = store->real[COLUMN_LOAD][0] ? mpm->load_factor * store->real[COLUMN_LOAD][a][p] : 0;
        force[a] = load + mass * (gravity[a] - mpm->scene->damping * store->real[COLUMN_VELOCITY][a][p]);
    }
}

/* Artificial viscosity pressure of a particle; 0 where the scene does without. */
THREADS_INLINE double mpm_viscous_pressure(const struct store *store, size_t p)
{
    return store->real[COLUMN_VISCOUS_PRESSURE][0] ? store->real[COLUMN_VISCOUS_PRESSURE][0][p] : 0;
}

/* What a particle's internal force is made of; a pass may be compiled for the first two, which are most scenes. */
enum force_parts {
    FORCE_STRESS,  /* Cauchy stress */
    FORCE_VISCOUS, /* and artificial viscosity */
    FORCE_ANY      /* residual stress too, or first Piola-Kirchhoff stress: the scene tells */
};

THREADS_INLINE enum force_parts mpm_force_parts(const struct mpm *mpm)
{
    if (mpm->is_total || mpm->store->real[COLUMN_RESIDUAL][0])
        return FORCE_ANY;
    return mpm->store->real[COLUMN_VISCOUS_PRESSURE][0] ? FORCE_VISCOUS : FORCE_STRESS;
}

/* Volume times stress over cell size of a particle, negative: what its gradients are multiplied with
 * in the forces (spec 6 C, 9.2). */
THREADS_INLINE void mpm_force_stress(const struct mpm *mpm, size_t p, enum force_parts parts, double t[3][3])
{
    const struct store *store = mpm->store;
    const double size = mpm->cells->frame.size;
    if (parts == FORCE_ANY && mpm->is_total) {
        double scale = -store->real[COLUMN_MASS][0][p]
                     / (mpm->material_of_body[store->integer[COLUMN_BODY][p]]->density * size);
        for (int a = 0; a < 9; a++)
            t[a / 3][a % 3] = scale * store->real[COLUMN_FIRST_STRESS][a][p];
        return;
    }
    double scale = -store->real[COLUMN_VOLUME][0][p] / size;
    double viscous = parts == FORCE_STRESS ? 0 : parts == FORCE_VISCOUS ? store->real[COLUMN_VISCOUS_PRESSURE][0][p]
                                                                        : mpm_viscous_pressure(store, p);
    t[0][0] = scale * (store->real[COLUMN_STRESS][0][p] - viscous);
    t[1][1] = scale * (store->real[COLUMN_STRESS][1][p] - viscous);
    t[2][2] = scale * (store->real[COLUMN_STRESS][2][p] - viscous);
    t[1][2] = t[2][1] = scale * store->real[COLUMN_STRESS][3][p];
    t[0][2] = t[2][0] = scale * store->real[COLUMN_STRESS][4][p];
    t[0][1] = t[1][0] = scale * store->real[COLUMN_STRESS][5][p];
    if (parts == FORCE_ANY && store->real[COLUMN_RESIDUAL][0]) {
        for (int a = 0; a < 3; a++)
            t[a][a] -= scale * store->real[COLUMN_RESIDUAL][a][p];
        t[1][2] = t[2][1] -= scale * store->real[COLUMN_RESIDUAL][3][p];
        t[0][2] = t[2][0] -= scale * store->real[COLUMN_RESIDUAL][4][p];
        t[0][1] = t[1][0] -= scale * store->real[COLUMN_RESIDUAL][5][p];
    }
}

/* Parts that are built up. Opening finds the layers, and the memory order in which open particles come
 * first; mistakes that only show then go to `diagnostics`. */
void building_open(struct mpm *mpm, struct diagnostics *diagnostics);
void building_close(struct mpm *mpm);
/* What is due at the start of a step (from 1): opens particles and moves the hot zone. Returns whether
 * particles opened. */
bool building_step(struct mpm *mpm, long step);
/* The next step at which something is due; 0 when the build is complete. */
long building_next_step(const struct mpm *mpm);
/* The part of mpm_exchange that is about them; the particles come before. */
void building_exchange(struct mpm *mpm, struct checkpoint *checkpoint);
/* Whether `open settle` ends the run behind a step. */
bool building_has_settled(const struct mpm *mpm, long step);

/* Warns of bodies that lie in each other at the start. */
void overlap_warn(const struct mpm *mpm, struct diagnostics *diagnostics);

/* Face tractions (load face). */
void faces_open(struct mpm *mpm);
void faces_close(struct mpm *mpm);
void faces_scatter(struct mpm *mpm, int force_field); /* adds to field force_field + 0, 1, 2 of the patches */
double faces_work(const struct mpm *mpm); /* after the grid is integrated */

/* Staggered grid: how far from coordinate x along axis a, in cells, the point lies with whose weights a particle
 * there gives to the centres: not 0 near walls, where it gives to one centre whole (spec 9.3). */
double staggered_shift(const struct mpm *mpm, int a, double x);

/* Smoothed pressure (spec 9.6). */
void smoothing_start(struct mpm *mpm);  /* before a step */
void smoothing_finish(struct mpm *mpm); /* after its stress and motion, before cells change */
double smoothing_volume(const struct mpm *mpm, size_t p);

/* Contact between components: after the momentum equation, before velocities are taken. */
void contact_open(struct mpm *mpm);
void contact_close(struct mpm *mpm);
void contact_resolve(struct mpm *mpm);
/* With `cont ... join`: one straining velocity along the normal for both sides of the nodes where the last
 * contact_resolve gave a force; momentum m1 v1 + m2 v2 stays. */
void contact_join(struct mpm *mpm);

/* What all shape functions do with a portion of particles once the grid's values are in the
 * thread's workspace. */
struct chunk;

/* Stress, volume, energy from strain, spin and trace (spec 6.2 to 6.7). */
void stress_update(struct mpm *mpm, const struct chunk *chunk);

/* Work of the external forces over the step's way, from the gathered velocities. */
void motion_work(struct mpm *mpm, const struct chunk *chunk);

/* With xfer pic, apic or blend: mixes the gathered grid velocities into the particles' old ones, so
 * that motion_accelerate completes them. The grid's velocities hold the acceleration already. */
void motion_blend(struct mpm *mpm, const struct chunk *chunk, double *const velocity[3]);

/* New particle velocities from the gathered accelerations, and their sums. */
void motion_accelerate(struct mpm *mpm, const struct chunk *chunk, double *const velocity[3], const double *mass);

/* New positions and cells from the gathered velocities. */
void motion_move(struct mpm *mpm, const struct chunk *chunk);

#endif
