/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Constitutive laws. Each law is one file with one const row in the table of laws.c: its
 * parameters with units and limits, the columns it needs, and its functions. Laws work on
 * batches of points of one material, held as structure of arrays. */
#ifndef MATERIAL_LAW_H
#define MATERIAL_LAW_H

#include "base/threads.h"
#include "base/argument.h"
#include "base/methods.h"
#include "particles/columns.h"

enum { LAW_PARAMETERS = 16 };

struct law;
struct eos;

/* An element of a viscoelastic law: a spring and a dashpot in a row. */
struct law_element {
    double strength, time; /* as the deck has them: modulus, or viscosity, and relaxation time */
    double shear, bulk; /* what follows from them; no bulk where pressure does not relax */
};

/* A material of the deck: a law with its numbers, and what follows from them once. */
struct material {
    const struct law *law;
    double parameter[LAW_PARAMETERS]; /* in the order of the law's row */
    double density;                   /* initial density rho0 */
    double shear_modulus;             /* G */
    double bulk_modulus;              /* K */
    double wave_speed;                /* limits the time step (spec 5) */
    double viscous_speed;             /* c of the linear artificial viscosity (spec 3.3) */
    double yield_stress;              /* initial */
    double viscosity;                 /* of the shear part of fluids */
    double detonation_speed;          /* 0: no explosive */
    const struct eos *eos;            /* equation of state, or NULL */
    double eos_constant[8];           /* in the order of its row, after its preparation */
    double eos_number[LAW_PARAMETERS]; /* as the deck has them */
    double initial_energy;            /* E0, per initial volume */
    struct law_element *elements;     /* on the heap; the scene closes them */
    size_t elements_capacity;
    int n_elements;
    unsigned words;                   /* a bit for each of the law's words that the deck has */
};

/* Points of one material in one step. Arrays have `count` entries; pointers of columns that the
 * scene does not have are NULL. */
struct law_batch {
    int count;
    const struct material *material;
    double time_step;
    double time;
    double cell_size;
    double bulk_quadratic, bulk_linear; /* artificial viscosity b1, b2 */
    const double *restrict strain[6];   /* increments, engineering shears */
    const double *restrict spin[3];     /* spin increments w1, w2, w3 (spec 6.2) */
    const double *restrict trace;       /* volume strain increment */
    const double *restrict volume_before;
    double *restrict volume;
    const double *restrict mass;
    double *restrict work;              /* room for one number a point */
    double *restrict terms[2];          /* with equation of state: its terms (eos.h); else room for the law */
    double *restrict stress[6];         /* in: rotated old stress; out: new stress */
    double *restrict energy;            /* internal energy */
    double *restrict viscous_pressure;  /* artificial viscosity pressure q; NULL where it is off and no law has an equation of state */
    double *restrict plastic_strain;
    double *restrict yield_stress;
    double *restrict mean_stress;       /* of laws with equation of state: minus pressure */
    double *restrict equivalent_stress;
    double *restrict temperature;
    double *restrict damage;
    double *restrict failed;
    double *restrict lighting_time;
    double *restrict deformation[9];    /* deformation gradient less 1, already that of this step */
    double *restrict first_stress[9];   /* first Piola-Kirchhoff stress, total Lagrangian only */
    double *const *history;             /* the law's own columns, then six components for each element, from history_from on */
    int history_from;
};

/* A row of the table. */
struct law {
    const char *name; /* the word in the deck */
    const char *doc;
    const struct argument *parameters;
    const struct argument *element; /* behind the parameters their number n, and n times these; NULL: no elements */
    const char *const *words;       /* that may stand behind all numbers, ended by NULL; NULL: none */
    int history;            /* columns of history beside those of elements */
    unsigned methods;       /* METHODS_... that it belongs to */
    enum column columns[8]; /* columns beyond those of every MPM scene, ended by COLUMN_NONE */
    bool follows_time;      /* the stress changes also at rest */
    bool rotates;           /* the old stress is rotated before the update (spec 6.3) */
    bool needs_eos;         /* pressure and energy come from an equation of state (spec 6.7) */
    bool keeps_equivalent;  /* writes the column of the von Mises stress itself */
    double stabilisation;   /* factor of the moduli in what stabilises integration at nodes (spec rkpm 7) */
    double viscous_work;    /* how often the viscous work is counted (spec 6.6; 8.1 john) */
    const char *later;      /* not NULL: known word without its feature; says what is missing */
    /* Derives the fields of a material from its parameters. Returns NULL, or what is wrong. */
    const char *(*prepare)(struct material *material);
    /* Replaces the rotated old stress by the new one. */
    void (*update)(const struct law_batch *batch);
};

/* The row of a name (NUL-ended, four characters count), or NULL. */
const struct law *law_find(const char *name);

/* The rows in the order of the manual, ended by NULL. */
const struct law *const *law_rows(void);

/* Parameters that the elastic laws begin with. */
enum { LAW_DENSITY, LAW_YOUNG, LAW_POISSON };

/* Fills density, moduli and wave speed from rho, E, nu, and the plane wave speed as viscous
 * speed when `has_viscous_speed` (spec 3.3: only elas and neoh have one). */
void law_prepare_elastic(struct material *material, bool has_viscous_speed);

/* The same for Young's modulus and Poisson's ratio that are not parameters; takes the density from these. */
void law_set_elastic(struct material *material, double young, double poisson, bool has_viscous_speed);

/* Columns of a material's history: the law's own, and six for each element. */
static inline int law_history(const struct material *material)
{
    return material->law->history + 6 * material->n_elements;
}

/* Rotation of the old stress by the spin increments, explicit (spec 6.3). */
void law_rotate_explicit(const struct law_batch *batch);

/* Rotation by the orthogonal tensor (1 - W/2)^-1 (1 + W/2) of Hughes and Winget (Int. J. Numer.
 * Meth. Engng 15, 1980): invariants of the stress are kept to round-off. */
void law_rotate_exact(const struct law_batch *batch);

/* Turns the stresses of elements as `rotate` turns the stress. */
void law_rotate_history(const struct law_batch *batch, void (*rotate)(const struct law_batch *batch));

/* Energy of the laws without equation of state, before and after the update (spec 6.5, 6.6):
 * the first keeps the old part of the work, the second adds the new part, the artificial
 * viscosity where the mean stress is negative, and puts the sum into the internal energy. */
void law_energy_before(const struct law_batch *batch);
void law_energy_after(const struct law_batch *batch);

/* The part of the work that takes the old deviator, before it is rotated (spec 6.7). */
void law_eos_work_before(const struct law_batch *batch);

/* The elastic trial stress: rotated old stress plus Hooke's increment of one point. */
THREADS_INLINE void law_elastic_trial(const struct law_batch *batch, int j, double shear, double bulk, double trial[6])
{
    double third = batch->trace[j] / 3;
    double pressure = bulk * batch->trace[j];
    for (int a = 0; a < 3; a++) {
        trial[a] = batch->stress[a][j] + 2 * shear * (batch->strain[a][j] - third) + pressure;
        trial[a + 3] = batch->stress[a + 3][j] + shear * batch->strain[a + 3][j];
    }
}

extern const struct law law_elas, law_pla1, law_pla2, law_john, law_sjc, law_sjcf, law_jcf, law_hiex, law_null, law_dpm, law_neoh, law_maxw, law_fmax, law_oldr, law_powl, law_flui;

#endif
