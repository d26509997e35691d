/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Loading: the load and velo blocks. */
#include "base/memory.h"
#include "deck/commands_process.h"

#include <stddef.h>
#include <string.h>
#include <strings.h>

#define ID(name) {name, NULL, ARGUMENT_INTEGER, LIMIT_COUNT}
#define VECTOR(a, b, c, unit)                                                                                        \
    {a, unit, ARGUMENT_REAL, LIMIT_NONE}, {b, unit, ARGUMENT_REAL, LIMIT_NONE}, {c, unit, ARGUMENT_REAL, LIMIT_NONE}, \
    {0}

/* Whether the body or particle that `word` speaks of exists, as far as can be said now. */
static bool check_target(struct reader *reader, const struct deck_word *word, const struct value *id, bool is_body)
{
    const struct scene *scene = reader->scene;
    if (reader_is_missing(reader, "nbbo") || !reader_needs(reader, word, is_body ? "part" : "nbmp"))
        return false;
    return is_body ? reader_check_id(reader, id, (long)scene->n_bodies, "body")
                   : reader_check_id(reader, id, scene->particles_declared, "particle");
}

/* Adds a load whose target is values[id] and whose vector starts at values[id + 1]. */
static void add_load(struct reader *reader, const struct deck_word *word, enum scene_load_kind kind,
                     const struct value *values, int id, struct scene_load load)
{
    struct scene *scene = reader->scene;
    bool is_body = kind == LOAD_BODY || kind == LOAD_GRAVITY || kind == LOAD_FACE;
    if (!check_target(reader, word, &values[id], is_body))
        return;
    load.kind = kind;
    load.target = values[id].integer - 1;
    load.place = values[id].word.place;
    for (int a = 0; a < 3; a++)
        load.value[a] = values[id + 1 + a].real;
    scene->loads = memory_grow(scene->loads, &scene->loads_capacity, scene->n_loads + 1, sizeof load, "loads");
    scene->loads[scene->n_loads++] = load;
}

static void load_particle(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    add_load(reader, word, LOAD_PARTICLE, values, 0, (struct scene_load){0});
}

static void load_density(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    add_load(reader, word, LOAD_DENSITY, values, 0, (struct scene_load){0});
}

static void load_body(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    add_load(reader, word, LOAD_BODY, values, 0, (struct scene_load){0});
}

static void load_gravity(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    add_load(reader, word, LOAD_GRAVITY, values, 0, (struct scene_load){0});
}

static void load_face(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const char *const sides[] = {"x-", "x+", "y-", "y+", "z-", "z+"};
    for (int i = 0; i < 6; i++)
        if (values[0].word.length == 2 && strncasecmp(values[0].word.text, sides[i], 2) == 0) {
            add_load(reader, word, LOAD_FACE, values, 1, (struct scene_load){.axis = i / 2, .side = i % 2 ? 1 : -1});
            return;
        }
    char shown[40];
    diagnostics_error(reader->diagnostics, values[0].word.place, "a face must be x-, x+, y-, y+, z- or z+, not '%s'",
                      text_show(&values[0].word, shown, sizeof shown));
}

static void load_box(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    struct scene *scene = reader->scene;
    struct scene_load load = {.kind = LOAD_BOX, .place = word->place};
    for (int i = 0; i < 6; i++)
        load.box[i] = values[i].real;
    for (int a = 0; a < 3; a++) {
        load.value[a] = values[6 + a].real;
        if (load.box[2 * a + 1] < load.box[2 * a])
            diagnostics_error(reader->diagnostics, values[2 * a + 1].word.place, "%c1 of load box is below %c0", "xyz"[a], "xyz"[a]);
    }
    scene->loads = memory_grow(scene->loads, &scene->loads_capacity, scene->n_loads + 1, sizeof load, "loads");
    scene->loads[scene->n_loads++] = load;
}

#define EDGE(name) {name, "length", ARGUMENT_REAL, LIMIT_NONE}

const struct keyword load_keywords[] = {
    {.name = "part", .methods = METHODS_MPM, .arguments = (const struct argument[]){ID("particle"), VECTOR("fx", "fy", "fz", "force")},
     .apply = load_particle, .doc = "force on a particle"},
    {.name = "body", .methods = METHODS_MPM, .arguments = (const struct argument[]){ID("body"), VECTOR("fx", "fy", "fz", "force")},
     .apply = load_body, .doc = "the same force on each particle of a body"},
    {.name = "grav", .arguments = (const struct argument[]){ID("body"), VECTOR("gx", "gy", "gz", "length/time^2")},
     .apply = load_gravity, .doc = "acceleration of a body"},
    {.name = "node", .methods = METHODS_MPM, .arguments = (const struct argument[]){ID("particle"), VECTOR("fx", "fy", "fz", "force/length^3")},
     .apply = load_density, .doc = "force per volume on a particle, times its initial volume"},
    {.name = "box", .methods = METHODS_MPM,
     .arguments = (const struct argument[]){EDGE("x0"), EDGE("x1"), EDGE("y0"), EDGE("y1"), EDGE("z0"), EDGE("z1"),
                                            VECTOR("fx", "fy", "fz", "force/length^3")},
     .apply = load_box, .doc = "force per volume on all particles that start in a box, its limits included, times their initial volume"},
    {.name = "face", .methods = METHODS_MPM,
     .arguments = (const struct argument[]){{"face", NULL, ARGUMENT_WORD, LIMIT_NONE}, ID("body"),
                                            VECTOR("tx", "ty", "tz", "force/length^2")},
     .apply = load_face,
     .doc = "traction per initial area on the outermost particle layer of a body on side x- x+ y- y+ z- z+"},
    {0}};

static void add_velocity(struct reader *reader, const struct deck_word *word, enum scene_velocity_kind kind,
                         const struct value *values)
{
    struct scene *scene = reader->scene;
    if (!check_target(reader, word, &values[0], kind == VELOCITY_BODY))
        return;
    struct scene_velocity velocity = {kind, values[0].integer - 1, {values[1].real, values[2].real, values[3].real},
                                      values[0].word.place};
    scene->velocities = memory_grow(scene->velocities, &scene->velocities_capacity, scene->n_velocities + 1,
                                    sizeof velocity, "velocities");
    scene->velocities[scene->n_velocities++] = velocity;
}

static void velocity_particle(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    add_velocity(reader, word, VELOCITY_PARTICLE, values);
}

static void velocity_body(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    add_velocity(reader, word, VELOCITY_BODY, values);
}

/* A field that is a formula of the particle; its number is kept as the first component. */
static void add_field(struct reader *reader, enum scene_velocity_kind kind, const struct value *value)
{
    struct scene *scene = reader->scene;
    struct scene_velocity velocity = {kind, 0, {value->real, 0, 0}, value->word.place};
    scene->velocities = memory_grow(scene->velocities, &scene->velocities_capacity, scene->n_velocities + 1,
                                    sizeof velocity, "velocities");
    scene->velocities[scene->n_velocities++] = velocity;
}

static void velocity_sine(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    add_field(reader, VELOCITY_SINE, &values[0]);
}

static void velocity_rows(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    if (values[1].integer == 1)
        add_field(reader, VELOCITY_ROWS, &values[0]);
}

static void velocity_bending(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    add_field(reader, VELOCITY_BENDING, &values[0]);
}

const struct keyword velocity_keywords[] = {
    {.name = "node", .arguments = (const struct argument[]){ID("particle"), VECTOR("vx", "vy", "vz", "length/time")},
     .apply = velocity_particle, .doc = "velocity of a particle; with meth sph of fluid only"},
    {.name = "body", .arguments = (const struct argument[]){ID("body"), VECTOR("vx", "vy", "vz", "length/time")},
     .apply = velocity_body, .doc = "velocity of all particles of a body; with meth sph of fluid only"},
    {.name = "vsin", .methods = METHODS_MPM, .arguments = (const struct argument[]){{"v0", "length/time", ARGUMENT_REAL, LIMIT_NONE}, {0}},
     .apply = velocity_sine, .doc = "v0 sin(pi y / 6) along x for all particles"},
    {.name = "ksin", .methods = METHODS_MPM, .arguments = (const struct argument[]){{"v0", "length/time", ARGUMENT_REAL, LIMIT_NONE}, ID("body"), {0}},
     .apply = velocity_rows, .doc = "body 1: half a sine wave along x for particles 1 to 1280 in rows of 320"},
    {.name = "nuli", .methods = METHODS_MPM, .arguments = (const struct argument[]){{"y", "length", ARGUMENT_REAL, LIMIT_NONE}, {0}},
     .apply = velocity_bending, .doc = "first bending mode along y for particles 1 to 49152 in rows of 384"},
    {0}};

static void read_block(struct reader *reader, const struct deck_word *word, const struct keyword *table,
                       const char *end, const char *owner)
{
    reader_needs(reader, word, "nbbo");
    reader_block(reader, table, end, owner, NULL);
}

static void read_loads(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)values;
    read_block(reader, word, load_keywords, "endl", "load");
}

static void read_velocities(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)values;
    read_block(reader, word, velocity_keywords, "endv", "velo");
}

const struct keyword loading_keywords[] = {
    {.name = "load", .methods = METHODS_PARTICLES, .apply = read_loads, .doc = "block of forces, gravity and tractions, up to endl",
     .details = "load\n  kind target x y z ...\nendl\nA later line for the same target replaces an earlier one; "
                "tractions add up. The kinds:"},
    {.name = "velo", .methods = METHODS_PARTICLES, .apply = read_velocities, .doc = "block of initial velocities, up to endv",
     .details = "velo\n  kind target vx vy vz ...\nendv\nThe kinds:"},
    {.name = "QuLo", .methods = METHODS_MPM, .arguments = (const struct argument[]){{"time", "time", ARGUMENT_REAL, LIMIT_POSITIVE}, {0}},
     .field = offsetof(struct scene, loading_time),
     .doc = "loads (not gravity) grow up to this time; the run goes on until it is at rest (see quli)"},
    {.name = "quli", .methods = METHODS_MPM,
     .arguments = (const struct argument[]){{"least", "time", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE},
                                            {"latest", "time", ARGUMENT_REAL, LIMIT_POSITIVE}, {0}},
     .field = offsetof(struct scene, settling),
     .doc = "with QuLo: the run ends between these times, when the kinetic energy is below 0.5 % (100, and ten times "
            "the larger of it and endt)"},
    {.name = "resi", .methods = METHODS_MPM, .arguments = reader_residual_arguments, .apply = reader_residual,
     .doc = "residual stress of a material in the plane of a layer, along the scan, across it, shear; internal forces take "
            "stress less this one, so that with negative numbers a free part contracts"},
    {.name = "phas", .methods = METHODS_MPM, .arguments = reader_phase_arguments, .apply = reader_phase,
     .doc = "phase transformation: volume strain (before - after)/after of a material, from its opening on"},
    {.name = "ther", .methods = METHODS_MPM, .arguments = reader_heat_arguments, .apply = reader_heat,
     .doc = "hot sphere around the particle that opened last: strain expansion times difference within the radius; `heat` "
            "(default) or `cool` behind it"},
    {0}};

static void check_particle(struct reader *reader, long particle, struct deck_place place)
{
    if (particle >= reader->scene->n_particles)
        diagnostics_error(reader->diagnostics, place, "particle %ld does not exist; the deck has %ld", particle + 1,
                          reader->scene->n_particles);
}

/* Only contact looks at components (spec 3.3). */
static void unknown_component(struct reader *reader, const struct scene_body *body)
{
    const long last = reader->scene->components;
    if (reader->scene->contact != CONTACT_NONE)
        diagnostics_error(reader->diagnostics, body->component_place, "component %d does not exist; expected 1 to %ld",
                          body->component + 1, last);
    else
        diagnostics_warning(reader->diagnostics, body->component_place,
                            "component %d is above nbco, which is %ld; without 'cont' it has no meaning",
                            body->component + 1, last);
}

/* Particle targets were checked against nbmp; the deck may have created fewer. Components could
 * not be checked, as nbco may come last. */
void reader_finish_targets(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    for (size_t b = 0; b < scene->n_bodies; b++)
        if (scene->bodies[b].component >= scene->components)
            unknown_component(reader, &scene->bodies[b]);
    if (reader->has_bad_part || scene->n_particles == 0)
        return;
    for (size_t i = 0; i < scene->n_loads; i++)
        if (scene->loads[i].kind == LOAD_PARTICLE || scene->loads[i].kind == LOAD_DENSITY)
            check_particle(reader, scene->loads[i].target, scene->loads[i].place);
    for (size_t i = 0; i < scene->n_velocities; i++) {
        static const long needed[] = {[VELOCITY_ROWS] = 1280, [VELOCITY_BENDING] = 49152};
        const struct scene_velocity *velocity = &scene->velocities[i];
        bool is_field = velocity->kind == VELOCITY_ROWS || velocity->kind == VELOCITY_BENDING;
        if (velocity->kind == VELOCITY_PARTICLE || is_field)
            check_particle(reader, is_field ? needed[velocity->kind] - 1 : velocity->target, velocity->place);
    }
    for (size_t i = 0; i < scene->n_curves; i++)
        if (!scene->curves[i].is_near)
            check_particle(reader, scene->curves[i].particle, scene->curves[i].place);
}
