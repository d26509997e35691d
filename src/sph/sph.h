/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Smoothed particle hydrodynamics of melting metal (spec am-sph): what a run of it owns, and its steps.
 *
 * A step at time n, with velocities of n - 1/2 (spec 11):
 *   1 neighbours   lists are made anew where particles have moved too far
 *   2 properties   from the temperature: reference density, viscosity, conductivity
 *   3 gradients    of the density excess, for the diffusion of density
 *   4 density      from continuity; Shepard sums and normals; pressure
 *   5 walls        pressure and velocity of walls and solids, from the fluid beside them
 *   6 surface      curvature in the band of the surface
 *   7 forces       pressure, viscosity, gravity, surface tension, Marangoni, recoil
 *   8 heat         conduction, viscous heat, radiation, beam, evaporation
 *   9 advance      velocity, position, enthalpy, temperature; what melts and solidifies
 *
 * Each particle gathers over its own list, so that results do not depend on the number of threads; sums over
 * particles go by portions of fixed size in the order of memory. */
#ifndef SPH_SPH_H
#define SPH_SPH_H

#include "base/instability.h"
#include "base/timers.h"
#include "deck/scene.h"
#include "material/properties.h"
#include "sph/kernel.h"
#include "sph/neighbours.h"
#include "particles/state.h"

struct sph;

/* What a body is to the particles. */
struct sph_body {
    const struct properties *properties;
    const struct scene_wall *wall;         /* or NULL */
    const struct scene_swelling *swelling; /* or NULL */
    double gravity[3];
};

/* The columns that loops go over, by name; they move when particles are sorted (sph_bind). */
struct sph_columns {
    double *x[3], *v[3], *a[3];
    double *mass, *volume, *density, *reference, *pressure, *excess_offset;
    double *opened;                       /* NULL without open expansion */
    double *excess_gradient[3];           /* NULL without diffused gradients */
    double *smoothing;
    double *viscosity, *shepard;
    double *normal[3];                    /* N of spec 6.3 A; NULL without surface forces, radiation, evaporation */
    double *wide_normal[3], *wide_shepard, *curvature;
    double *temperature, *enthalpy, *liquid, *conductivity, *heat_rate, *laser_power; /* NULL without heat (and beam) */
    int32_t *state, *body, *fused; /* the last NULL where nothing asks for it */
    int32_t *parted;               /* NULL without ejec */
};

/* The density at which a particle has no pressure. */
static inline double sph_rest_density(const struct sph_columns *c, size_t p)
{
    return c->reference[p] + c->excess_offset[p] + (c->opened ? c->opened[p] : 0);
}

/* Sums that a step leaves behind; a row of results names each for `curv`. All in the units of the deck; in two
 * dimensions per length across the plane. */
struct sph_budget {
    double kinetic, internal;   /* 1/2 m v^2; elastic energy of compression c0^2 ... */
    double momentum[3];
    double heat;                /* sum of m H */
    double laser_in, absorbed, reflected, transmitted; /* since the start */
    double radiated, evaporated, removed_heat;       /* that went out */
    double through_walls, viscous_heat, volume_heat; /* that came in */
    double removed_mass, evaporated_mass;
    long removed;
    double fastest;             /* largest speed of fluid */
    double hottest, coldest;
    double largest_acceleration;
    double least_density_ratio, most_density_ratio; /* of rho over rho0 */
    double least_reference;     /* rho0 */
    bool is_finite;
};

/* Powers of the step under way; heat_advance adds what they bring to the budget. `through_walls` is what comes in. */
struct sph_powers {
    double laser_in, absorbed, reflected, transmitted;
    double radiated, evaporated, through_walls, viscous_heat, volume_heat;
    double evaporated_mass; /* per time */
};

/* A limit of the time step; the particle with the largest measure sets it (NULL: none does). */
struct sph_limit {
    const char *name;
    double (*measure)(const struct sph *sph, size_t p);
};

struct sph {
    const struct scene *scene;
    const struct scene_sph *words;
    struct store *store;
    struct neighbours *neighbours;
    struct timers *timers;
    struct sph_body *bodies;
    double *body_heat; /* power of the heat that comes in from each body that is a wall of given temperature */
    const struct material **material_of_body;
    int *material_number_of_body;
    struct sph_columns columns;
    int dimension;
    double spacing;             /* of the lattice at the start */
    double period;              /* the scene repeats along x after this length; 0: it does not */
    double smoothing;           /* h at the start */
    struct kernel kernel, wide; /* with h and h_s of the start; pairs with varying h make their own */
    double self_value;          /* W(0) of kernel */
    double sound_speed;
    double first_sound, wanted_sound; /* at the start; what the steps since the last change want (sound.c) */
    double courant;
    bool is_shared;             /* threads share the work: there is enough of it, or a number was asked for */
    bool has_fixed;             /* walls or solids */
    bool has_moving_walls;
    bool needs_normals;         /* for surface forces, radiation, evaporation, open expansion or shifting */

    long step;
    double time;
    double time_step;   /* of the step under way or the next one */
    double taken_step;  /* of the last step */
    double first_time_step, stable_step;
    const struct sph_limit *limiting; /* what limits the time step */
    double updates;     /* particles that took part, summed over steps */
    struct sph_budget budget;
    int32_t *clusters;  /* labels of what belongs together, and a queue; made when first needed */
    int32_t *removed;   /* ids of particles that left the grid, as they left (since the restart: those before are in the
                         * file); NULL where the scene does not list them */
    struct sph_powers powers;
    double start_heat;

    /* The particles of the surface's band, in memory order (surface.c). */
    int32_t *band;
    size_t n_band;
    int32_t *is_kept;   /* per particle: has a normal good enough for a curvature */
    unsigned char *ring;       /* per particle: what of the surface is found there */
    /* Per particle: it or one beside it moved when normals of walls and solids were made last; as seen by the wide kernel. */
    unsigned char *saw_motion, *saw_wide_motion;
    long normals_builds;       /* the builds of neighbours that this was with */
    double *work[3];    /* room for one number a particle */

    /* Made anew in each step, per particle (flow.c). */
    double *seen[3];       /* velocities that pairs see: of walls and solids first their own, for the forces the mirrored ones */
    double *fluid_volume;  /* volume of fluid; 0 for walls and solids */
    unsigned char *beside; /* what moves within reach of walls and solids; NULL without them */
    double *excess;        /* what is diffused: density above the reference that gives pressure; 0 for walls and solids */
    double *rate;          /* of the density */
    struct sph_portion *portions; /* sums of portions of the particles (budget.c) */

    struct sph_heat *heat;   /* what heat.c and laser.c keep; made when first needed */
    struct sph_march *march;
};

/* Builds the run of a scene; what only shows now goes to `diagnostics`. */
struct diagnostics;
struct sph *sph_open(struct scene *scene, struct timers *timers, struct diagnostics *diagnostics);
void sph_close(struct sph *sph);

/* Lets threads share the work of small scenes too, where they only cost. */
void sph_share_always(struct sph *sph);

/* One step. */
void sph_step(struct sph *sph);

/* What is within reach of a particle: nothing that moves, a wall that moves, fluid. */
enum { BESIDE_NOTHING, BESIDE_WALL, BESIDE_FLUID };

static inline bool sph_wall_moves(const struct scene_wall *wall)
{
    return wall->velocity[0] != 0 || wall->velocity[1] != 0 || wall->velocity[2] != 0;
}

/* Whether a particle is fluid, or of a wall that moves. */
static inline bool sph_moves(const struct sph *sph, size_t p)
{
    const int32_t state = sph->columns.state[p];
    return state == SPH_WALL ? sph_wall_moves(sph->bodies[sph->columns.body[p]].wall) : state == SPH_FLUID;
}

/* Of fluid; 0 for all else. */
static inline double sph_square_of_speed(const struct sph *sph, size_t p)
{
    double square = 0;
    for (int a = 0; a < 3 && sph->columns.state[p] == SPH_FLUID; a++)
        square += sph->columns.v[a][p] * sph->columns.v[a][p];
    return square;
}

/* A particle's own part of the kernel's sum (shepard): all of it where it has no neighbour. */
static inline double sph_own_part(const struct sph *sph, size_t p)
{
    const struct sph_columns *c = &sph->columns;
    return c->volume[p] * (sph->words->varies_smoothing ? kernel_of(c->smoothing[p], sph->dimension).value : sph->self_value);
}

/* Points the columns of `sph` at those of the store; after each sorting. */
void sph_bind(struct sph *sph);

/* --- the parts of a step; each works on all particles --- */

/* From temperature (or the start): reference density with its swelling, viscosity, conductivity (heat.c). */
void heat_properties(struct sph *sph);
/* The density without pressure at the temperature of a particle, at a time (for swelling). */
double heat_reference_density(const struct sph *sph, size_t p, double time);

void flow_prepare(struct sph *sph);   /* seen velocities, fluid volumes, excess */
void flow_surroundings(struct sph *sph); /* what walls and solids are beside */
void flow_gradients(struct sph *sph);
void flow_density(struct sph *sph, double time_step);
void flow_walls(struct sph *sph);
void flow_forces(struct sph *sph); /* sets the acceleration */
void flow_advance(struct sph *sph, double half_steps, double time_step); /* velocities by the first, positions by the second */

void surface_find(struct sph *sph);
void surface_forces(struct sph *sph); /* adds to the acceleration */

void heat_flow(struct sph *sph);                     /* sets the heat rate: conduction, viscous heat, radiation, volume heat */
void laser_deposit(struct sph *sph);                 /* sets the laser power; with its budget */
void heat_advance(struct sph *sph, double time_step); /* enthalpy, temperature, liquid fraction, states */
void heat_free(struct sph *sph);

/* The part of a difference in the temperature of particle p that radiation and evaporation take away per time. */
double heat_loss_rate(const struct sph *sph, size_t p);
void laser_free(struct sph *sph);

/* Takes out fluid that left the grid; finds what came off the metal, and takes out of it what is hotter than the deck's
 * limit (remove.c). */
void remove_outsiders(struct sph *sph);
void remove_ejected(struct sph *sph);

/* The sound speed that a scene needs as it stands; changes it slowly to what the last steps need, where the deck says so. */
double sound_of_scene(const struct sph *sph);
void sound_adapt(struct sph *sph);

/* The largest time step that is stable (spec 12), and what limits it. */
double limits_time_step(struct sph *sph);

/* Sums after a step. */
void budget_update(struct sph *sph);

/* Looks at the sums of the last step (and at particles only when something is wrong). */
struct instability sph_check(const struct sph *sph);

/* Writes the whole state between two steps to a checkpoint, or takes it from one into a run of the same deck
 * that was just opened. What does not fit is reported there. */
struct checkpoint;
void sph_exchange(struct sph *sph, struct checkpoint *checkpoint);

/* Energy of heat that is not accounted for, relative to what came in or was there. */
double sph_heat_error(const struct sph *sph);

/* How many particles hang together neither with a solid nor a wall; without those, with the largest piece. */
long sph_detached(struct sph *sph);

/* Extents along the axes of what is at least half liquid of materials that melt, a spacing more than those of its
 * particles' places; 0 where there is none. */
void sph_pool(const struct sph *sph, double extents[3]);

/* What has been melt since the start: `zone` are extents along the axes of where its particles were at the start, and how
 * far below the base that reaches. `roughness`: of its top, along x. Needs the column `fused`; 0 where there is none. */
struct sph_track {
    double zone[3], penetration, roughness;
};
struct sph_track sph_track(const struct sph *sph);

#endif
