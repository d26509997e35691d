/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a deck says: plain data, no behaviour, no pointer into a solver. Ids count from 0 here. */
#ifndef DECK_SCENE_H
#define DECK_SCENE_H

#include "deck/scene_rkpm.h"
#include "deck/scene_sph.h"
#include "deck/text.h"
#include "material/law.h"
#include "material/properties.h"
#include "particles/generate.h"
#include "particles/results.h"

#include <stdint.h>

enum scheme { SCHEME_USF, SCHEME_USL, SCHEME_MUSL };
enum rotation { ROTATION_OFF, ROTATION_EXPLICIT, ROTATION_EXACT };

/* Residual stress and transformation strains of a material that is built up (resi, phas, ther). */
struct scene_transformation {
    bool has_residual, has_phase, has_heat;
    double residual[3];       /* along the scan, across it, shear; internal forces take stress less this */
    double phase_densities[2]; /* before and after */
    double expansion, temperature, radius; /* strain is expansion times temperature within the radius */
    bool cools;               /* the zone shrinks instead */
    struct deck_place residual_place, phase_place, heat_place;
};

struct scene_material {
    struct material material;
    bool is_given;
    struct deck_place place;
    struct scene_transformation transformation;
    struct properties properties; /* of what melts and flows (prop) */
    struct deck_place property_places[PROPERTY_COUNT], surface_place, melting_place; /* line 0: not given */
};

struct scene_body {
    int component;
    struct generator generator;
    long first, count;     /* particle ids first ... first + count - 1 */
    bool has_plot_box;     /* points created outside plot_box are left out of the animation file */
    double plot_box[6];
    struct deck_place place, component_place;
};

enum scene_load_kind { LOAD_PARTICLE, LOAD_BODY, LOAD_GRAVITY, LOAD_DENSITY, LOAD_FACE, LOAD_BOX };

struct scene_load {
    enum scene_load_kind kind;
    long target;     /* particle or body */
    int axis, side;  /* LOAD_FACE: 0 1 2, -1 or +1 */
    double value[3]; /* force, acceleration, force per volume, or traction */
    double box[6];   /* LOAD_BOX: x0 x1 y0 y1 z0 z1 */
    struct deck_place place;
};

enum scene_velocity_kind { VELOCITY_PARTICLE, VELOCITY_BODY, VELOCITY_SINE, VELOCITY_ROWS, VELOCITY_BENDING };

/* How ParaView files are written: as text when they are small, else binary; or always one of them. */
enum vtk_format { VTK_AUTO, VTK_TEXT, VTK_BINARY };

/* What becomes of particles that leave the grid, and how velocities go back to particles. */
enum lost_policy { LOST_KEEP, LOST_DROP, LOST_STOP };
enum transfer { TRANSFER_FLIP, TRANSFER_BLEND, TRANSFER_AFFINE };

enum contact_method { CONTACT_NONE, CONTACT_LAGRANGE, CONTACT_OTHER };

/* How particles and grid are connected. */
enum interpolation { INTERPOLATION_LINEAR, INTERPOLATION_GIMP, INTERPOLATION_GIMP_OWN, INTERPOLATION_BIMP, INTERPOLATION_STAGGERED };

struct scene_velocity {
    enum scene_velocity_kind kind;
    long target;
    double value[3];
    struct deck_place place;
};

struct scene_point {
    double position[3];
};

/* Particles that are closed at the start (Ghost), and how they open (open, buil, scan). */
enum opening { OPENING_NONE, OPENING_POINTS, OPENING_LAYERS, OPENING_ALL };
enum scan_order { SCAN_DECK, SCAN_RASTER };

struct scene_ghost {
    long first, last; /* ids */
    bool is_open;
    struct deck_place place;
};

struct scene_building {
    bool has_ghosts, shows_ghosts;
    struct scene_ghost *ghosts;
    size_t n_ghosts, ghosts_capacity;
    enum opening opening;
    long group;      /* OPENING_POINTS: particles at a time */
    long interval;   /* steps from one opening to the next */
    long settling;   /* steps after the last opening; -1: up to endt */
    long until;      /* id of the last particle to open; -1: all */
    int axis;        /* build direction */
    double thickness; /* of a layer; 0: particles at one height are a layer */
    enum scan_order order;
    bool is_serpentine;
    double *angles;  /* of layer 1, 2, ... in turn, degrees */
    size_t n_angles, angles_capacity;
    struct deck_place ghost_place, open_place, build_place, scan_place, until_place, settling_place;
};

/* Grid nodes whose velocity is zero along some axes: in a box, or in an annulus around an axis. */
struct scene_hold {
    bool is_annulus;
    int axis;
    double box[6];    /* x0 x1 y0 y1 z0 z1 */
    double centre[2]; /* of the annulus, in the two other coordinates in the order x y z */
    double radius[2];
    bool holds[3];
    struct deck_place place;
};

struct scene_curve {
    const struct result *result;
    long particle;     /* id; unused when near */
    bool is_near;      /* curx: the particle near a point */
    double point[3];
    struct deck_place place;
};

struct scene {
    char *title;
    uint64_t given[8]; /* per category of words: a bit for each row of its table that the deck used */
    char *job; /* name of the output files */
    long components, bodies_declared, particles_declared, materials_declared;
    double end_time, output_interval, report_interval, step_scale;
    double grid[6]; /* x0 x1 y0 y1 z0 z1 */
    double cell_size;
    long boundary[6]; /* codes of the faces x- x+ y- y+ z- z+ */
    double mass_cutoff, cutoff_cell_size; /* the latter is the cell size when mate was read */
    enum scheme scheme;
    enum rotation rotation;
    enum interpolation interpolation;
    enum lost_policy lost;
    bool writes_lost;
    enum transfer transfer;
    double flip_share;       /* TRANSFER_BLEND: share of flip, the rest is pic */
    bool averages_volume;    /* bbar */
    bool zones_by_body;
    enum contact_method contact;
    double contact_friction;
    long contact_normal;     /* 0 both components', 1 the first's, 2 the second's */
    bool contact_joins;      /* cont ... join: nodes in contact strain both sides with one normal velocity */
    bool is_total;           /* TLmp */
    bool is_small;           /* smal: displacements change neither places nor volumes in the equations */
    bool tracks_deformation; /* UVFp: volume from the deformation gradient */
    double loading_time;     /* QuLo: loads grow up to this time; 0: at once */
    double settling[2];      /* QuLo: least end time, latest end time */
    double bulk[2]; /* artificial viscosity: quadratic, linear */
    double damping; /* mass proportional, 1/time */
    bool kinetic_damping;
    double nodal_damping[2]; /* ndam: force per velocity on each node; the second holds after the last opening */
    double mass_scale;       /* mscl */
    double fixed_step;       /* dtfx; 0: the stable one */
    double least_step;       /* dtmi; 0: a fraction of the first one */
    double light_mass;       /* lite: share of a full cell's mass below which nodes are light; 0: none */
    bool finds_equilibrium;       /* quas: the run goes from equilibrium to equilibrium */
    double equilibrium_tolerance; /* of unbalanced forces, relative */
    long equilibrium_steps;       /* Newton steps, at most */
    bool sorts;
    bool writes_animation, writes_vtk, smooths_pressure, bare_names, bare_headers;
    enum vtk_format vtk_format;
    long digits; /* significant, in the tables */
    long restart_steps;      /* rest: steps from one checkpoint to the next; 0: none */
    double restart_interval; /* time from one to the next; 0: none */

    struct scene_material *materials;
    size_t n_materials, materials_capacity;
    struct scene_body *bodies;
    size_t n_bodies, bodies_capacity;
    long n_particles;
    struct scene_load *loads;
    size_t n_loads, loads_capacity;
    struct scene_velocity *velocities;
    size_t n_velocities, velocities_capacity;
    struct scene_point *detonations;
    size_t n_detonations, detonations_capacity;
    const struct result **results; /* of the animation file, after x y z mat */
    size_t n_results, results_capacity;
    struct scene_curve *curves; /* after engk and engi */
    size_t n_curves, curves_capacity;
    struct scene_building building;
    struct scene_hold *holds;
    size_t n_holds, holds_capacity;
    enum method_name method;
    struct scene_sph sph;
    struct scene_rkpm rkpm;
};

/* The method of a scene; that of reproducing kernel particles by its problem. */
enum method_name scene_method(const struct scene *scene);

/* An empty scene with the defaults of the dialect. */
struct scene *scene_open(void);
void scene_close(struct scene *scene);

#endif
