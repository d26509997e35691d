/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a deck says of smoothed particles (meth sph): plain data. */
#ifndef DECK_SCENE_SPH_H
#define DECK_SCENE_SPH_H

#include "base/methods.h"
#include "deck/text.h"

#include <stdbool.h>
#include <stddef.h>

/* Pressure force: p_a + p_b, or each divided by the Shepard sum of the other (spec 4.1). */
enum pressure_form { PRESSURE_SYMMETRIC, PRESSURE_SHEPARD };
/* Viscous force of Monaghan and Gingold, or of Morris (spec 4.2). */
enum viscous_form { VISCOSITY_MONAGHAN, VISCOSITY_MORRIS };
enum integrator { INTEGRATOR_STAGGERED, INTEGRATOR_PREDICTED };
/* Surface tension: none, balanced (spec 6.3), or of the dissertation with its corrections (6.1). */
enum surface_form { SURFACE_OFF, SURFACE_BALANCED, SURFACE_THESIS };
/* Heat: none, enthalpy (spec 8.2), or the dissertation's apparent capacity (8.3). */
enum heat_form { HEAT_OFF, HEAT_ENTHALPY, HEAT_APPARENT };
/* Density that sets the mass of particles: at the start's temperature, or at the solidus (spec 3.3). */
enum mass_reference { MASS_AT_START, MASS_AT_SOLIDUS };
/* In two dimensions the power of a beam is that of the slice through its axis, or of a stated thickness (spec 9). */
enum beam_reading { BEAM_SLICE, BEAM_LINE };
/* What a wall does to heat. */
enum wall_heat { WALL_ADIABATIC, WALL_TEMPERATURE };

/* A body that is a wall: its particles stay, or move with a given velocity. */
struct scene_wall {
    long body;
    double velocity[3];
    enum wall_heat heat;
    double temperature;
    bool no_stick; /* negative pressure is cut */
    struct deck_place place;
};

/* A body's temperature at the start. */
struct scene_temperature {
    long body;
    double value;
    struct deck_place place;
};

/* A piece of the beam's path: straight from one point to another between two times. */
struct scene_beam_piece {
    double times[2];
    double from[3], to[3];
    struct deck_place place;
};

struct scene_beam {
    bool is_on;
    double power, radius, absorptivity, depth; /* radius: 1/e^2; depth: alpha, 1/length; 0: 3/dx */
    enum beam_reading reading;
    double thickness;  /* BEAM_LINE */
    double bin;        /* cells of the march, in spacings (1 to 2) */
    struct scene_beam_piece *pieces;
    size_t n_pieces, pieces_capacity;
    struct deck_place place;
};

/* An imposed change of the reference density of a body: it is times 1 + a sin(2 pi f t), 1 + a t sin(2 pi f t), or
 * 1 + a t up to an end. */
enum swelling_form { SWELLING_CYCLE, SWELLING_GROWING, SWELLING_STEADY };

struct scene_swelling {
    long body;
    enum swelling_form form;
    double amplitude, frequency; /* a, f */
    double end;                  /* of a steady one; infinite where it has none */
    struct deck_place place;
};

/* A body that is stretched about its centre at the start. */
struct scene_stretch {
    long body;
    double factor[3];
    struct deck_place place;
};

struct scene_sph {
    long dimension;           /* 2, 3 */
    double smoothing;         /* h over the spacing */
    double wide_smoothing;    /* the same of the surface's geometry */
    double sound_speed;       /* c0; 0: found from the scene */
    bool adapts_sound;
    double density_diffusion; /* delta */
    bool diffuses_gradient;   /* s = 1: with renormalised gradients */
    bool diffuses_reference;  /* the density itself is diffused, not what of it gives pressure */
    enum pressure_form pressure;
    enum viscous_form viscosity;
    enum integrator integrator;
    double courant;           /* 0: that of the integrator */
    double fixed_step;
    enum surface_form surface;
    bool corrects_depth;
    double surface_threshold; /* eps_n */
    bool opens_expansion;     /* particles of a free surface expand into the open, without pushing others */
    bool holds_films;         /* surface tension on films of one or two layers of particles too */
    bool has_marangoni;
    enum heat_form heat;
    bool corrects_lattice;    /* of conduction inside fixed solids */
    bool heats_by_viscosity;
    enum mass_reference mass;
    double melt_sound_factor; /* of the thesis: sound speed of what has just melted */
    bool relaxes_excess;      /* offset of the density of what melts, relaxed (spec 3.3) */
    bool reduces_pressure;    /* reduced pressure: gravity times 1 - rho_ref/rho0 */
    double reference_density;
    double shifting;          /* 0: none; 0.2 */
    bool cuts_tension;
    bool varies_smoothing;    /* h follows the volume (spec 13) */
    bool radiates;
    double emissivity, ambient;
    bool evaporates;
    double ambient_pressure;
    bool is_periodic;         /* the scene repeats along x, between the ends of the grid */
    bool freezes_flow;        /* velocities stay zero: conduction alone */
    double mush_drag;         /* K0; 0: none */
    double jitter;            /* of the start, in spacings */
    long seed;
    bool jitters_solids;
    double ejected_above;     /* what came off the metal and is hotter is removed; 0: nothing */
    bool lets_beam_through;   /* what came off and threads are not hit by the beam */
    double base;              /* height of the surface from which penetration is measured */
    double volume_heat;       /* power per volume everywhere */
    struct scene_beam beam;
    struct scene_wall *walls;
    size_t n_walls, walls_capacity;
    struct scene_temperature *temperatures;
    size_t n_temperatures, temperatures_capacity;
    struct scene_swelling *swellings;
    size_t n_swellings, swellings_capacity;
    struct scene_stretch *stretches;
    size_t n_stretches, stretches_capacity;
    struct deck_place place; /* of the word sph */
};

#endif
