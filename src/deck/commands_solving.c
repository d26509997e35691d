/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solving settings: time, schemes, stress rotation, viscosity, damping. */
#include "deck/commands_rkpm.h"
#include "deck/commands_sph.h"

#include <stddef.h>
#include <strings.h>

#define SWITCH ((const struct argument[]){{"on|off", NULL, ARGUMENT_WORD, LIMIT_NONE}, {0}})

static void read_end_time(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    if (reader->has_output_interval)
        diagnostics_warning(reader->diagnostics, reader->output_interval_place,
                            "'endt' comes later and sets the output interval again");
    reader->scene->output_interval = values[0].real;
}

/* Without any scheme ever switched on MUSL runs; else usf wins over all, musl over usl (spec 2). */
static void switch_scheme(struct reader *reader, const struct value *values, const char *name, enum scheme scheme)
{
    int on = reader_switch(reader, &values[0], name);
    if (on < 0)
        return;
    reader->scheme_is_on[scheme] = on == 1;
    reader->has_scheme = reader->has_scheme || on == 1;
    if (reader->has_scheme)
        reader->scene->scheme = reader->scheme_is_on[SCHEME_USF]    ? SCHEME_USF
                              : reader->scheme_is_on[SCHEME_MUSL] ? SCHEME_MUSL
                                                                  : SCHEME_USL;
}

static void read_musl(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    switch_scheme(reader, values, "musl", SCHEME_MUSL);
}

static void read_usl(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    reader->last_usl_place = word->place;
    switch_scheme(reader, values, "usl", SCHEME_USL);
}

static void read_usf(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    switch_scheme(reader, values, "usf", SCHEME_USF);
}

static void read_rotation(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    if (values[0].word.length >= 4 && strncasecmp(values[0].word.text, "exac", 4) == 0) {
        reader->scene->rotation = ROTATION_EXACT;
        return;
    }
    char shown[40];
    text_show(&values[0].word, shown, sizeof shown);
    int on = strcasecmp(shown, "on") == 0 ? 1 : strcasecmp(shown, "off") == 0 ? 0 : -1;
    if (on < 0)
        diagnostics_error(reader->diagnostics, values[0].word.place, "jaum must be on, off or exact, not '%s'", shown);
    else
        reader->scene->rotation = on ? ROTATION_EXPLICIT : ROTATION_OFF;
}

static void read_sorting(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    int on = reader_switch(reader, &values[0], "sort");
    if (on >= 0)
        reader->scene->sorts = on == 1;
}

/* Of several interpolations sgmp wins over gimp, gimp over bimp (spec 2). */
static void read_gimp(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const char *const own[] = {"cp", NULL};
    (void)word;
    (void)values;
    bool is_own = reader_optional(reader, own) == 0;
    reader->interpolation_place = word->place;
    if (reader->scene->interpolation == INTERPOLATION_STAGGERED)
        return;
    reader->scene->interpolation = is_own ? INTERPOLATION_GIMP_OWN : INTERPOLATION_GIMP;
}

static void read_bimp(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    (void)values;
    reader->interpolation_place = word->place;
    if (reader->scene->interpolation == INTERPOLATION_LINEAR)
        reader->scene->interpolation = INTERPOLATION_BIMP;
}

static void read_transfer(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const struct argument share[] = {{"share", NULL, ARGUMENT_REAL, LIMIT_FRACTION}, {0}};
    static const char *const names[] = {"flip", "pic", "apic", "blend"};
    struct scene *scene = reader->scene;
    struct value value[2];
    char name[40];
    int found = -1;
    text_copy(&values[0].word, name, sizeof name);
    for (int i = 0; i < 4; i++)
        if (strncasecmp(name, names[i], 4) == 0)
            found = i;
    reader->transfer_place = word->place;
    if (found < 0)
        diagnostics_error(reader->diagnostics, values[0].word.place, "xfer must be flip, pic, apic or blend, not '%s'", name);
    if (found == 3 && !reader_values(reader, share, "xfer blend", value))
        return;
    scene->transfer = found == 0 ? TRANSFER_FLIP : found == 2 ? TRANSFER_AFFINE : TRANSFER_BLEND;
    scene->flip_share = found == 3 ? value[0].real : found == 1 ? 0 : 1;
}

static void read_averaging(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)values;
    reader->averaging_place = word->place;
    reader->scene->averages_volume = true;
}

static void read_lost(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const char *const names[] = {[LOST_KEEP] = "keep", [LOST_DROP] = "drop", [LOST_STOP] = "stop"};
    static const char *const writing[] = {"write", NULL};
    char name[40];
    int found = -1;
    (void)word;
    text_copy(&values[0].word, name, sizeof name);
    for (int i = 0; i < 3; i++)
        if (strncasecmp(name, names[i], 4) == 0)
            found = i;
    if (found < 0)
        diagnostics_error(reader->diagnostics, values[0].word.place, "lost must be keep, drop or stop, not '%s'", name);
    else
        reader->scene->lost = (enum lost_policy)found;
    reader->scene->writes_lost = reader_optional(reader, writing) == 0;
}

static void read_staggered(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)values;
    reader->interpolation_place = word->place;
    reader->scene->interpolation = INTERPOLATION_STAGGERED;
}

static void read_total(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)values;
    reader->total_place = word->place;
    reader->scene->is_total = true;
}

static void read_contact(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    struct scene *scene = reader->scene;
    static const char *const joining[] = {"join", NULL};
    const struct deck_word *method = &values[0].word;
    bool is_lagrange = method->length >= 4 && strncasecmp(method->text, "lagr", 4) == 0;
    bool is_other = method->length >= 4 && strncasecmp(method->text, "othe", 4) == 0;
    char shown[40];
    (void)word;
    if (!is_lagrange && !is_other)
        diagnostics_error(reader->diagnostics, method->place, "the method of contact must be lagr or othe, not '%s'",
                          text_show(method, shown, sizeof shown));
    scene->contact = is_lagrange ? CONTACT_LAGRANGE : CONTACT_OTHER;
    scene->contact_friction = values[1].real;
    scene->contact_normal = values[2].integer;
    scene->contact_joins = reader_optional(reader, joining) == 0;
    reader->contact_place = method->place;
    if (is_other && scene->contact_joins)
        diagnostics_error(reader->diagnostics, method->place, "'join' goes with 'lagr'; 'othe' has no contact");
}

static void read_deformation(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    (void)values;
    reader->scene->tracks_deformation = true;
}

static void read_equilibrium(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const struct argument steps[] = {{"maxit", NULL, ARGUMENT_INTEGER, LIMIT_COUNT}, {0}};
    struct scene *scene = reader->scene;
    struct value value[2];
    scene->finds_equilibrium = true;
    scene->equilibrium_tolerance = values[0].real;
    scene->equilibrium_steps = 50;
    reader->equilibrium_place = word->place;
    if (reader_has_more(reader) && reader_values(reader, steps, "quas", value))
        scene->equilibrium_steps = value[0].integer;
}

static void read_kinetic_damping(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    (void)values;
    reader->scene->kinetic_damping = true;
}

static void read_nodal_damping(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const struct argument second[] = {{"after", "force*time/length", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE}, {0}};
    double *damping = reader->scene->nodal_damping;
    struct value after[2];
    (void)word;
    damping[0] = damping[1] = values[0].real;
    if (reader_has_more(reader) && reader_values(reader, second, "ndam", after))
        damping[1] = after[0].real;
}

static void read_small(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)values;
    reader->small_place = word->place;
    reader->scene->is_small = true;
}

static void note_mass_scale(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)values;
    reader->mass_scale_place = word->place;
}

static void note_fixed_step(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)values;
    reader->fixed_step_place = word->place;
}

static void note_light_mass(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)values;
    reader->light_mass_place = word->place;
}

static void note_method(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)values;
    reader->method_place = word->place;
}

/* What belongs to a method that is not known can't be said to be wrong. */
static void fail_method(struct reader *reader, const struct deck_word *word)
{
    (void)word;
    reader->is_partial = true;
}

_Static_assert(sizeof(enum method_name) == sizeof(int), "choices are stored as int");
static const char *const method_names[] = {[METHOD_MPM] = "mpm", [METHOD_SPH] = "sph", [METHOD_RKPM] = "rkpm", NULL};

const struct keyword solving_keywords[] = {
    {.name = "meth", .long_name = "method",
     .arguments = (const struct argument[]){{"mpm|sph|rkpm", NULL, ARGUMENT_WORD, LIMIT_NONE}, {0}},
     .choice = &(const struct keyword_choice){method_names, offsetof(struct scene, method), false}, .apply = note_method, .fail = fail_method,
     .doc = "material points on a grid (mpm, default), smoothed particles that melt and flow (sph, see there), or reproducing kernel "
            "particles (rkpm, see there)"},
    {.name = "sph", .methods = METHODS_SPH, .apply = reader_sph, .once = true,
     .doc = "block of what smoothed particles need, up to ends",
     .details = "sph\n  word numbers ...\nends\nMaterials are `flui`, with `prop`; gravity is in load. Temperatures in kelvin, as radiation "
                "and evaporation need them. The words:"},
    {.name = "rkpm", .methods = METHODS_RKPM, .apply = reader_rkpm, .once = true,
     .doc = "block of what reproducing kernel particles need, up to ends",
     .details = "rkpm\n  word numbers ...\nends\nThe block says all of a problem: there are no materials, bodies or steps in time. A problem counts 1 in "
                "time. With `prob dynamic` a body\nmoves in time: beside the block there are nmat and mate with one material, endt, and as with other "
                "methods outt, rptt, dtfx, dtmi, curv, rest.\nOf problems job_error.dat has a line for each: numbers of nodes n and of those along x, spacing h along x, L2 norm of the error, "
                "that of its gradient too (H1), rates between problems. The words:"},
    {.name = "endt", .methods = METHODS_TIMED, .long_name = "endtime",
     .arguments = (const struct argument[]){{"time", "time", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE}, {0}},
     .field = offsetof(struct scene, end_time), .apply = read_end_time,
     .doc = "end time; sets the output interval too, so outt has to follow it"},
    {.name = "dtsc", .methods = METHODS_MPM, .long_name = "dtscale",
     .arguments = (const struct argument[]){{"factor", NULL, ARGUMENT_REAL, LIMIT_STEP_SCALE}, {0}},
     .field = offsetof(struct scene, step_scale), .doc = "time step as a fraction of the stable one (0.9)"},
    {.name = "musl", .methods = METHODS_MPM, .arguments = SWITCH, .apply = read_musl, .doc = "modified update stress last (default)"},
    {.name = "usl", .methods = METHODS_MPM, .arguments = SWITCH, .apply = read_usl, .doc = "update stress last"},
    {.name = "usf", .methods = METHODS_MPM, .arguments = SWITCH, .apply = read_usf, .doc = "update stress first"},
    {.name = "jaum", .methods = METHODS_MPM, .long_name = "jaumann",
     .arguments = (const struct argument[]){{"on|off|exact", NULL, ARGUMENT_WORD, LIMIT_NONE}, {0}},
     .apply = read_rotation,
     .doc = "rotation of the stress: on explicit (default), exact orthogonal (Hughes-Winget), off none"},
    {.name = "bulk", .methods = METHODS_MPM,
     .arguments = (const struct argument[]){{"quadratic", NULL, ARGUMENT_REAL, LIMIT_NONE},
                                            {"linear", NULL, ARGUMENT_REAL, LIMIT_NONE}, {0}},
     .field = offsetof(struct scene, bulk), .doc = "artificial bulk viscosity (1.5 0.06)"},
    {.name = "Damp", .methods = METHODS_MPM,
     .arguments = (const struct argument[]){{"rate", "1/time", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE}, {0}},
     .field = offsetof(struct scene, damping), .doc = "damping force -rate * mass * velocity on each particle"},
    {.name = "ndam", .methods = METHODS_MPM, .arguments = (const struct argument[]){{"factor", "force*time/length", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE}, {0}},
     .apply = read_nodal_damping,
     .doc = "damping force -factor * velocity on each grid node, whatever its mass; stable for any factor; `ndam c1 c2`: c2 "
            "from the last opening on"},
    {.name = "mscl", .methods = METHODS_MPM, .arguments = (const struct argument[]){{"factor", NULL, ARGUMENT_REAL, LIMIT_POSITIVE}, {0}},
     .field = offsetof(struct scene, mass_scale), .apply = note_mass_scale,
     .doc = "all masses times a factor, for larger steps where inertia does not matter; weight stays (1)"},
    {.name = "dtfx", .methods = METHODS_TIMED, .arguments = (const struct argument[]){{"step", "time", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE}, {0}},
     .field = offsetof(struct scene, fixed_step), .apply = note_fixed_step, .doc = "fixed time step in place of dtsc, checked against the stable one; 0: none"},
    {.name = "dtmi", .methods = METHODS_TIMED, .arguments = (const struct argument[]){{"step", "time", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE}, {0}},
     .field = offsetof(struct scene, least_step),
     .doc = "the run is stopped as unstable when its time step falls below this one; 0: a millionth of the first one"},
    {.name = "lite", .methods = METHODS_MPM, .arguments = (const struct argument[]){{"share", NULL, ARGUMENT_REAL, LIMIT_NOT_NEGATIVE}, {0}},
     .field = offsetof(struct scene, light_mass), .apply = note_light_mass,
     .doc = "for usl, unstable at nodes of small mass: nodes with less than this share of the mass of a full cell (of the "
            "lightest material) strain and move particles with less of their acceleration; momentum stays (0; 0.01 is a "
            "good one)"},
    {.name = "drda", .methods = METHODS_MPM, .apply = read_kinetic_damping,
     .doc = "kinetic damping: velocities are set to zero whenever the kinetic energy falls"},
    {.name = "quas", .methods = METHODS_MPM, .long_name = "quasistatic",
     .arguments = (const struct argument[]){{"tol", NULL, ARGUMENT_REAL, LIMIT_POSITIVE}, {0}}, .apply = read_equilibrium,
     .doc = "no time steps: the static equilibrium is found directly, with unbalanced forces of tol times those at the start "
            "(1e-6 is a good one); at most maxit Newton steps (`quas tol maxit`, 50), then kinetic damping. endt is not "
            "looked at; each equilibrium counts 1 in time and is written",
     .details = "quas tol [maxit]\nThe forces that tol is measured by are the largest unbalanced ones at the start of any "
                "equilibrium of the run.\nRigid motions that nothing holds are taken out. Linear shapes only, with or without "
                "bbar; laws with an equation of state, contact,\nTLmp, QuLo and velo do not go with it. Plastic flow follows "
                "the way of the search, not that of a slow loading;\nwith kinetic damping it overshoots."},
    {.name = "xfer", .methods = METHODS_MPM, .long_name = "transfer",
     .arguments = (const struct argument[]){{"flip|pic|apic|blend", NULL, ARGUMENT_WORD, LIMIT_NONE}, {0}},
     .apply = read_transfer,
     .doc = "velocities back to particles: their change (flip, default), the grid's (pic), the grid's with gradient "
            "(apic), or `xfer blend a` for a flip + (1 - a) pic"},
    {.name = "bbar", .methods = METHODS_MPM, .apply = read_averaging,
     .doc = "volume change and pressure averaged over the cell, against volumetric locking of linear shapes"},
    {.name = "lost", .methods = METHODS_PARTICLES,
     .arguments = (const struct argument[]){{"keep|drop|stop", NULL, ARGUMENT_WORD, LIMIT_NONE}, {0}},
     .apply = read_lost,
     .doc = "particles that leave the grid: frozen and counted in sums (keep, default), left out (drop), or the end of "
            "the run (stop); with `write` behind it they are listed in job_lost.dat. With meth sph they are left out, also "
            "with keep"},
    {.name = "sort", .methods = METHODS_PARTICLES, .arguments = SWITCH, .apply = read_sorting,
     .doc = "keep particles in cell order in memory (on); changes speed, never results"},
    {.name = "gimp", .methods = METHODS_MPM, .apply = read_gimp,
     .doc = "generalised interpolation; particles half a cell wide, or with `gimp cp` as wide as they are"},
    {.name = "bimp", .methods = METHODS_MPM, .apply = read_bimp, .doc = "quadratic B-spline shape functions"},
    {.name = "sgmp", .methods = METHODS_MPM, .apply = read_staggered, .doc = "staggered grid: stress and strain at cell centres, against locking"},
    {.name = "TLmp", .methods = METHODS_MPM, .apply = read_total, .doc = "total Lagrangian formulation; neoh only, alone or with sgmp"},
    {.name = "smal", .methods = METHODS_MPM, .long_name = "small", .apply = read_small,
     .doc = "small displacements: forces and strains at the initial places, volumes stay; positions only show where particles are"},
    {.name = "UVFp", .methods = METHODS_MPM, .apply = read_deformation, .doc = "particle volume from the deformation gradient"},
    {.name = "cont", .methods = METHODS_MPM, .long_name = "contact",
     .arguments = (const struct argument[]){{"lagr|othe", NULL, ARGUMENT_WORD, LIMIT_NONE},
                                            {"friction", NULL, ARGUMENT_REAL, LIMIT_NOT_NEGATIVE},
                                            {"normal", NULL, ARGUMENT_INTEGER, LIMIT_NORMAL}, {0}},
     .apply = read_contact,
     .doc = "contact of components: by forces on shared nodes (lagr), or none, bodies pass each other (othe); "
            "friction; normal of both (0), the first (1) or the second component (2); with `join` behind it nodes in "
            "contact strain both sides with one velocity along the normal, so that musl and usf gain no energy (usl "
            "always does)"},
    {0}};

static void check_contact(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    if (scene->components < 2)
        diagnostics_error(reader->diagnostics, reader->contact_place,
                          "'cont' needs two components; expected 'nbco 2' or more");
    if (scene->interpolation == INTERPOLATION_STAGGERED)
        diagnostics_error(reader->diagnostics, reader->contact_place,
                          "'cont' does not go with 'sgmp'; take gimp or bimp");
    if (scene->is_total)
        diagnostics_error(reader->diagnostics, reader->contact_place, "'cont' does not go with 'TLmp'");
}

/* Beyond this share of the stable step bars and blocks of particles blow up with usl, whatever the shape function
 * (make stability). */
static const double USL_STEP = 0.55;

/* The default of dtsc stays that of MPM3D-F90, whose decks give the same numbers here. */
static void warn_of_usl(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    if (scene->scheme == SCHEME_USL && !scene->finds_equilibrium && scene->fixed_step == 0 && scene->step_scale > USL_STEP)
        diagnostics_warning(reader->diagnostics, reader->last_usl_place,
                            "'usl' blows up in many scenes when 'dtsc' is above %g, and it is %g here; take dtsc 0.5, or musl", USL_STEP,
                            scene->step_scale);
}

static void check_light_mass(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    if (scene->light_mass > 0 && (scene->scheme != SCHEME_USL || scene->finds_equilibrium))
        diagnostics_error(reader->diagnostics, reader->light_mass_place, "'lite' is only for usl; expected 'usl on'");
}

static void check_small(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    const struct deck_place place = reader->small_place;
    if (scene->interpolation != INTERPOLATION_LINEAR || scene->is_total)
        diagnostics_error(reader->diagnostics, place, "'smal' does not go with 'gimp', 'bimp', 'sgmp' or 'TLmp'");
    if (scene->contact != CONTACT_NONE || scene->tracks_deformation)
        diagnostics_error(reader->diagnostics, place, "'smal' does not go with '%s'", scene->tracks_deformation ? "UVFp" : "cont");
    for (size_t i = 0; i < scene->n_materials; i++) {
        const struct law *law = scene->materials[i].material.law;
        if (scene->materials[i].is_given && (law->needs_eos || !law->rotates))
            diagnostics_error(reader->diagnostics, place, "'smal' does not go with '%s', whose stress follows the volume", law->name);
    }
}

static void check_total(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    if (scene->interpolation != INTERPOLATION_LINEAR && scene->interpolation != INTERPOLATION_STAGGERED)
        diagnostics_error(reader->diagnostics, reader->total_place,
                          "'TLmp' does not go with 'gimp' or 'bimp'; take sgmp or none");
    for (size_t i = 0; i < scene->n_materials; i++)
        if (scene->materials[i].is_given && scene->materials[i].material.law != &law_neoh)
            diagnostics_error(reader->diagnostics, reader->total_place, "'TLmp' does not go with '%s'; only with neoh",
                              scene->materials[i].material.law->name);
}

/* What static equilibrium can't be found with. */
static void check_equilibrium(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    static const char *const shapes[] = {[INTERPOLATION_GIMP] = "gimp", [INTERPOLATION_GIMP_OWN] = "gimp",
                                         [INTERPOLATION_BIMP] = "bimp", [INTERPOLATION_STAGGERED] = "sgmp"};
    const struct deck_place place = reader->equilibrium_place;
    if (scene->contact != CONTACT_NONE)
        diagnostics_error(reader->diagnostics, place, "'quas' does not go with 'cont'");
    if (scene->is_total)
        diagnostics_error(reader->diagnostics, place, "'quas' does not go with 'TLmp'");
    if (scene->interpolation != INTERPOLATION_LINEAR)
        diagnostics_error(reader->diagnostics, place, "'quas' does not go with '%s'; only with linear shapes, with or without bbar",
                          shapes[scene->interpolation]);
    if (scene->loading_time > 0)
        diagnostics_error(reader->diagnostics, place, "'quas' does not go with 'QuLo': loads act in full");
    if (scene->n_velocities > 0)
        diagnostics_error(reader->diagnostics, place, "'quas' does not go with 'velo': nothing moves on its own");
    for (size_t i = 0; i < scene->n_materials; i++) {
        const struct law *law = scene->materials[i].material.law;
        if (scene->materials[i].is_given && (law->needs_eos || law->follows_time))
            diagnostics_error(reader->diagnostics, place,
                              law->needs_eos ? "'quas' does not go with '%s': only with laws that have an elastic stiffness"
                                             : "'quas' does not go with '%s', whose stress follows the time: equilibria have none",
                              law->name);
    }
}

/* Pairs of words that do not go together (spec 10.1: D10, D12), and words that need others. */
void reader_finish_solving(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    if (scene->contact != CONTACT_NONE)
        check_contact(reader);
    if (scene->is_total)
        check_total(reader);
    if (scene->is_small)
        check_small(reader);
    check_light_mass(reader);
    if (scene->method != METHOD_MPM)
        return;
    warn_of_usl(reader);
    if (scene->finds_equilibrium)
        check_equilibrium(reader);
    if (scene->transfer == TRANSFER_AFFINE && scene->interpolation != INTERPOLATION_LINEAR)
        diagnostics_error(reader->diagnostics, reader->transfer_place, "'xfer apic' does not go with 'gimp', 'bimp' or 'sgmp'");
    if (scene->averages_volume && (scene->interpolation != INTERPOLATION_LINEAR || scene->is_total))
        diagnostics_error(reader->diagnostics, reader->averaging_place,
                          "'bbar' does not go with 'gimp', 'bimp', 'sgmp' or 'TLmp'");
    if (diagnostics_errors(reader->diagnostics) > 0 || scene->contact != CONTACT_NONE)
        return;
    for (size_t b = 1; b < scene->n_bodies; b++)
        if (scene->bodies[b].component != scene->bodies[0].component) {
            diagnostics_warning(reader->diagnostics, scene->bodies[b].component_place,
                                "this deck has several components and no 'cont': where they touch they stick");
            break;
        }
}
