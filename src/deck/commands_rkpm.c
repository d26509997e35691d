/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The block of rkpm: nodes, shape functions, the problem and how its boundary is held. */
#include "deck/commands_rkpm.h"
#include "base/memory.h"
#include "deck/commands_dynamic.h"

#include <stddef.h>
#include <string.h>

#define NUMBER(name, unit, limit) {name, unit, ARGUMENT_REAL, limit}
#define WORD(name) ((const struct argument[]){{name, NULL, ARGUMENT_WORD, LIMIT_NONE}, {0}})
#define LIST(...) ((const struct argument[]){__VA_ARGS__, {0}})
#define POINTS LIST({"n", NULL, ARGUMENT_INTEGER, LIMIT_GAUSS})
#define FIELD(name) offsetof(struct scene, rkpm.name)
#define CHOICE(names, name) &(const struct keyword_choice){names, FIELD(name), false}

_Static_assert(sizeof(enum basis_form) == sizeof(int), "choices are stored as int");
static const char *const bases[] = {[BASIS_LINEAR] = "linear", [BASIS_BILINEAR] = "bilinear", [BASIS_QUADRATIC] = "quad", NULL};
static const char *const kernels[] = {[KERNEL_CUBIC] = "cubic", [KERNEL_QUINTIC] = "quintic", [KERNEL_EXPONENTIAL] = "exponential", NULL};
static const char *const gradients[] = {[GRADIENT_DIRECT] = "direct", [GRADIENT_IMPLICIT] = "implicit", NULL};
static const char *const problems[] = {[PROBLEM_APPROXIMATION] = "approx", [PROBLEM_HELMHOLTZ] = "helmholtz",
                                       [PROBLEM_POISSON] = "poisson", [PROBLEM_ELASTIC] = "elastic", [PROBLEM_CREEP] = "creep",
                                       [PROBLEM_DYNAMIC] = "dynamic", NULL};
static const char *const functions[] = {[FUNCTION_SINE] = "sine", [FUNCTION_EXPONENTIAL] = "expo",
                                        [FUNCTION_WAVE] = "wave", [FUNCTION_LINEAR] = "line", [FUNCTION_PATCH] = "patch",
                                        [FUNCTION_BEAM] = "beam", [FUNCTION_LOAD] = "load", NULL};
static const char *const constraints[] = {[CONSTRAINT_TRANSFORMATION] = "tran", [CONSTRAINT_LAGRANGE] = "lagr",
                                          [CONSTRAINT_PENALTY] = "pena", [CONSTRAINT_NITSCHE] = "nits", NULL};

static const char *const integrations[] = {[INTEGRATION_GAUSS] = "gauss", [INTEGRATION_DNI] = "dni", [INTEGRATION_SNNI] = "snni",
                                           [INTEGRATION_NSNI] = "nsni", [INTEGRATION_SCNI] = "scni", [INTEGRATION_NSNI_SCNI] = "nsci",
                                           [INTEGRATION_MSCNI] = "mscni", NULL};
static const char *const planes[] = {[PLANE_STRESS] = "stress", [PLANE_STRAIN] = "strain", NULL};
static const char *const rules[] = {[MAXWELL_EXPONENTIAL] = "exponential", [MAXWELL_MIDPOINT] = "midpoint", NULL};
static const char *const off_on[] = {"off", "on", NULL};

/* Reads the next word as a number of `argument`; false after an error, or at the end of the line. */
static bool read_next(struct reader *reader, const struct argument *argument, const char *owner, struct value *value)
{
    return reader_has_more(reader) && reader_values(reader, argument, owner, value);
}

static void read_support(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const struct argument more[] = {NUMBER("a", "spacings", LIMIT_POSITIVE), {0}};
    struct scene_rkpm *rkpm = &reader->scene->rkpm;
    struct value value = values[0];
    (void)word;
    rkpm->n_support = 0;
    do {
        rkpm->support_places[rkpm->n_support] = value.word.place;
        rkpm->support[rkpm->n_support++] = value.real;
    } while (rkpm->n_support < 3 && read_next(reader, more, "supp", &value));
    for (int a = rkpm->n_support; a < 3 && rkpm->n_support == 1; a++)
        rkpm->support[a] = rkpm->support[0];
}

/* How many numbers there are is looked at when the dimension is known. */
static void read_nodes(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const char *const kinds[] = {"box", "disc", "sphere", "brick", NULL};
    static const struct argument number[] = {NUMBER("number", NULL, LIMIT_NONE), {0}};
    struct scene_rkpm *rkpm = &reader->scene->rkpm;
    struct value value;
    (void)values;
    rkpm->n_box = 0;
    rkpm->dynamic.has_lattice = false;
    const int kind = reader_optional(reader, kinds);
    if (kind < 0) {
        reader_expect(reader, "node", "'box x0 x1 ... nx ...', 'disc x y radius spacing', 'sphere x y z radius spacing' or 'brick x0 x1 ... spacing'");
        return;
    }
    if (kind == 3) {
        reader_brick(reader, word->place);
        return;
    }
    if (kind > 0) {
        reader_lattice(reader, kind + 1, word->place);
        return;
    }
    while (rkpm->n_box < RKPM_BOX && read_next(reader, number, "node box", &value)) {
        rkpm->box_places[rkpm->n_box] = value.word.place;
        rkpm->box_read[rkpm->n_box++] = value.real;
    }
}

static void read_refinements(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const struct argument more[] = {{"nx", NULL, ARGUMENT_INTEGER, LIMIT_COUNT}, {0}};
    struct scene_rkpm *rkpm = &reader->scene->rkpm;
    struct value value = values[0];
    (void)word;
    rkpm->n_refinements = 0;
    do {
        rkpm->refinements = memory_grow(rkpm->refinements, &rkpm->refinements_capacity, rkpm->n_refinements + 1,
                                        sizeof *rkpm->refinements, "refi");
        rkpm->refinement_places = memory_grow(rkpm->refinement_places, &rkpm->refinement_places_capacity, rkpm->n_refinements + 1,
                                              sizeof *rkpm->refinement_places, "refi");
        rkpm->refinement_places[rkpm->n_refinements] = value.word.place;
        rkpm->refinements[rkpm->n_refinements++] = value.integer;
    } while (read_next(reader, more, "refi", &value));
}

/* The file is read when the box and the dimension are known. */
static void read_file(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    struct scene_rkpm *rkpm = &reader->scene->rkpm;
    (void)word;
    memory_free(rkpm->file);
    rkpm->file = text_path(reader->text, &values[0].word);
}

static void read_held(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const char *const names[] = {"x0", "x1", "y0", "y1", "z0", "z1", NULL};
    struct scene_rkpm *rkpm = &reader->scene->rkpm;
    (void)word;
    (void)values;
    memset(rkpm->held, 0, sizeof rkpm->held);
    int side = reader_optional(reader, names);
    if (side < 0)
        reader_expect(reader, "held", "sides of the box: x0, x1, y0, y1, z0, z1");
    for (; side >= 0; side = reader_optional(reader, names))
        rkpm->held[side] = true;
}

static void add_element(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    struct scene_rkpm *rkpm = &reader->scene->rkpm;
    if (rkpm->n_elements == RKPM_ELEMENTS) {
        diagnostics_error(reader->diagnostics, word->place, "there are more than %d elements; expected at most so many, with relaxation times a decade or so apart", RKPM_ELEMENTS);
        return;
    }
    rkpm->elements[rkpm->n_elements][0] = values[0].real;
    rkpm->elements[rkpm->n_elements++][1] = values[1].real;
}

static void add_load(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    struct scene_rkpm *rkpm = &reader->scene->rkpm;
    if (rkpm->n_loads == RKPM_LOADS) {
        diagnostics_error(reader->diagnostics, word->place, "the load changes more than %d times; expected at most so many 'from'", RKPM_LOADS);
        return;
    }
    rkpm->load_places[rkpm->n_loads] = values[0].word.place;
    rkpm->loads[rkpm->n_loads][0] = values[0].real;
    rkpm->loads[rkpm->n_loads++][1] = values[1].real;
}

/* A wave number that follows the spacing makes each level another problem: no order can be measured. */
static void read_wave(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const char *const names[] = {"/h", NULL};
    (void)word;
    (void)values;
    reader->scene->rkpm.wave_over_spacing = reader_optional(reader, names) == 0;
}

static void read_beta(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const char *const names[] = {"/h", NULL};
    (void)word;
    (void)values;
    reader->scene->rkpm.beta_over_spacing = reader_optional(reader, names) == 0;
}

const struct keyword rkpm_keywords[] = {
    {.name = "dime", .long_name = "dimension", .arguments = LIST({"d", NULL, ARGUMENT_INTEGER, LIMIT_AXES}), .field = FIELD(dimension),
     .doc = "dimensions (2)"},
    {.name = "node", .apply = read_nodes,
     .doc = "`node box x0 x1 [y0 y1 [z0 z1]] nx [ny [nz]]`: a box and the numbers of nodes along its axes, those on its boundary "
            "included; as many axes as dimensions. Of dynamic `node disc x y radius spacing` or `node sphere x y z radius spacing`: the points "
            "inside of a square or cubic lattice whose centre is between points; or `node brick x0 x1 y0 y1 [z0 z1] spacing`: a box of whole "
            "numbers of spacings, the points half a spacing inside of it"},
    {.name = "refi", .long_name = "refine", .arguments = LIST({"nx", NULL, ARGUMENT_INTEGER, LIMIT_COUNT}), .apply = read_refinements,
     .doc = "the problem is solved with each of these numbers of nodes along x, one after another, and those along the other axes in "
            "proportion; the results are those of the last one. Without it once, as `node` says"},
    {.name = "basi", .long_name = "basis", .arguments = WORD("linear|bilinear|quad"), .choice = CHOICE(bases, basis),
     .doc = "what shape functions reproduce: monomials up to degree 1 (linear, default) or 2 (quad), or products of linear ones (bilinear)"},
    {.name = "kern", .long_name = "kernel", .arguments = WORD("cubic|quintic|exponential"), .choice = CHOICE(kernels, kernel),
     .doc = "what shape functions are made of: the cubic B-spline (default), the quintic one, which is smoother and narrower, or exp(-(z/0.4)^2) less what "
            "it is at the end of the support, z = 1 (exponential)"},
    {.name = "supp", .long_name = "support", .arguments = LIST(NUMBER("a", "spacings", LIMIT_POSITIVE)), .apply = read_support,
     .doc = "support radius over the spacing, one for all axes or one for each; more than 1, with quad more than 2. 1.75 and 2.5 are "
            "good ones"},
    {.name = "grad", .long_name = "gradient", .arguments = WORD("direct|implicit"), .choice = CHOICE(gradients, gradient),
     .doc = "gradients of shape functions: their own (direct, default), or those that reproduce gradients of the basis (implicit); with inte gauss and dni"},
    {.name = "prob", .long_name = "problem", .arguments = WORD("approx|helmholtz|poisson|elastic|creep|dynamic"), .choice = CHOICE(problems, problem),
     .doc = "the function itself, from its values at the nodes (approx); div grad u + k^2 u = f (helmholtz); div grad u = f (poisson): f and "
            "the values at the boundary are those of the function; displacements of an elastic body (elastic): those at held sides and the "
            "tractions on the others are those of the function; those of a viscoelastic body in time (creep), under a load that changes by "
            "steps; a body that moves in time (dynamic): with mate, endt and curv. Words that are of dynamic alone: mode, star, spin, "
            "grav, wall, stab. Its nodes may open layer by layer: Ghost, open, build"},
    {.name = "func", .long_name = "function", .arguments = WORD("sine|expo|wave|line|patch|beam|load"), .choice = CHOICE(functions, function),
     .doc = "exact solution: sin x sin y sin z (sine), exp(x y z) (expo), sin k(x1 - x)/sin k(x1 - x0) with the wave number and ends of the box "
            "(wave), 1 + x + 2 y + 3 z (line); y and z as far as there are dimensions. Of elastic: linear displacements (patch); in two "
            "dimensions Timoshenko's cantilever (beam), held at the low end along x and loaded along y at the high one. Of creep: no "
            "displacement at held sides, and a load on the high side along x (load)"},
    {.name = "modu", .long_name = "moduli", .arguments = LIST(NUMBER("young", "stress", LIMIT_POSITIVE), NUMBER("poisson", NULL, LIMIT_POISSON)),
     .field = FIELD(young), .doc = "Young's modulus and Poisson's ratio of elastic; of creep those at long times"},
    {.name = "elem", .long_name = "element", .arguments = LIST(NUMBER("young", "stress", LIMIT_POSITIVE), NUMBER("time", "time", LIMIT_POSITIVE)),
     .apply = add_element, .doc = "an element of creep: its Young's modulus, which comes on top, and its relaxation time; as many as there are, up to 8"},
    {.name = "rule", .arguments = WORD("exponential|midpoint"), .choice = CHOICE(rules, rule),
     .doc = "the rule of elements' steps in creep: exact where strains grow linearly (exponential, default), or the midpoint's, which needs "
            "steps shorter than relaxation times"},
    {.name = "vrel", .long_name = "vrelaxation", .arguments = WORD("off|on"), .choice = &(const struct keyword_choice){off_on, FIELD(relaxes_volume), true},
     .doc = "on: in creep pressure relaxes as well, else it stays that of all moduli together (off, default)"},
    {.name = "span", .arguments = LIST(NUMBER("end", "time", LIMIT_POSITIVE), NUMBER("step", "time", LIMIT_POSITIVE)), .field = FIELD(end_time),
     .doc = "creep goes on to an end, in steps of this length, or a little less where the load changes"},
    {.name = "from", .arguments = LIST(NUMBER("time", "time", LIMIT_NOT_NEGATIVE), NUMBER("factor", NULL, LIMIT_NONE)), .apply = add_load,
     .doc = "from this moment on the load of creep is that of `forc` times the factor: a jump, in a step of no length. In the order of time"},
    {.name = "plan", .long_name = "plane", .arguments = WORD("stress|strain"), .choice = CHOICE(planes, plane),
     .doc = "of elastic in two dimensions: no stress (stress, default) or no strain (strain) across the plane"},
    {.name = "forc", .long_name = "force", .arguments = LIST(NUMBER("p", "force/length", LIMIT_NONE)), .field = FIELD(beam_load),
     .doc = "load of func beam along y at its end, per thickness; of func load along the last axis on the high side along x, spread evenly"},
    {.name = "weig", .long_name = "weight", .arguments = LIST(NUMBER("wx", "force/length^3", LIMIT_NONE), NUMBER("wy", "force/length^3", LIMIT_NONE)),
     .apply = reader_rkpm_weight, .doc = "`weig wx wy [wz]`: force per volume of creep; it comes and goes with the load, times the factor of `from`"},
    {.name = "held", .apply = read_held,
     .doc = "`held x0 x1 y0 y1 z0 z1`: sides of the box where displacements of elastic are given, as many as there are; the others bear tractions. Without it all"},
    {.name = "pert", .long_name = "perturb", .arguments = LIST(NUMBER("s", "spacings", LIMIT_NOT_NEGATIVE), NUMBER("seed", NULL, LIMIT_NOT_NEGATIVE)),
     .field = FIELD(jitter), .doc = "nodes inside the box are moved at random by up to s spacings along each axis, up to 0.45"},
    {.name = "file", .arguments = WORD("name"), .apply = read_file,
     .doc = "nodes of elastic and creep from a file instead of the box's lattice, a line of coordinates each: `node box` still says where the body "
            "ends, what cells Gauss points have, and the spacing"},
    {.name = "inte", .long_name = "integration", .arguments = WORD("gauss|dni|snni|nsni|scni|nsci|mscni"), .choice = CHOICE(integrations, integration),
     .doc = "where elastic is integrated: Gauss points of cells between nodes (gauss, default); at the nodes, with a linear basis: directly "
            "(dni), with gradients smoothed over boxes (snni) or over cells that fit together (scni), with gradients of gradients beside dni "
            "(nsni) or scni (nsci), with triangles of cells beside scni (mscni, two dimensions). nsci is the best at nodes"},
    {.name = "vci", .arguments = WORD("off|on"), .choice = &(const struct keyword_choice){off_on, FIELD(is_consistent), true},
     .doc = "on: gradients of test functions are corrected so that integration passes patch tests; the matrix is not symmetric then"},
    {.name = "wave", .arguments = LIST(NUMBER("k", "1/length", LIMIT_POSITIVE)), .field = FIELD(wave_number), .apply = read_wave,
     .doc = "wave number k of helmholtz and of func wave; with `/h` behind it over the spacing along x, another problem for each of refi"},
    {.name = "gaus", .long_name = "gauss", .arguments = POINTS, .field = FIELD(gauss),
     .doc = "Gauss points per cell and axis of helmholtz, poisson and elastic (2; 5 with quad)"},
    {.name = "gbou", .long_name = "gboundary", .arguments = POINTS, .field = FIELD(boundary_gauss),
     .doc = "Gauss points per axis of a boundary segment, of lagr, pena and nits (2)"},
    {.name = "gnor", .long_name = "gnorm", .arguments = POINTS, .field = FIELD(norm_gauss),
     .doc = "Gauss points per cell and axis of the norms of the error (2; 5 with helmholtz)"},
    {.name = "cons", .long_name = "constraint", .arguments = WORD("tran|lagr|pena|nits"), .choice = CHOICE(constraints, constraint),
     .doc = "how values at the boundary are held: exactly at its nodes, by transformation of coefficients (tran, default), by Lagrange "
            "multipliers (lagr), by a penalty (pena), by Nitsche's method (nits)"},
    {.name = "beta", .arguments = LIST(NUMBER("beta", NULL, LIMIT_POSITIVE)), .field = FIELD(beta), .apply = read_beta,
     .doc = "factor of pena and nits, of elastic in Young's moduli; with `/h` behind it over the smallest spacing (100 /h)"},
    {.name = "mode", .arguments = WORD("lagrangian|semi"), .choice = CHOICE(reader_kernel_modes, dynamic.mode),
     .doc = "shape functions of the nodes' places at the start (lagrangian, default), or of those of now (semi), made anew in each step"},
    {.name = "star", .long_name = "start", .arguments = LIST(NUMBER("vx", "length/time", LIMIT_NONE), NUMBER("vy", "length/time", LIMIT_NONE)),
     .apply = reader_start_velocity, .doc = "velocity at the start, `star vx vy [vz]`"},
    {.name = "spin", .arguments = LIST(NUMBER("omega", "1/time", LIMIT_NONE)), .field = FIELD(dynamic.spin),
     .doc = "angular velocity at the start about z through the centre of the nodes"},
    {.name = "grav", .long_name = "gravity", .arguments = LIST(NUMBER("gx", "length/time^2", LIMIT_NONE), NUMBER("gy", "length/time^2", LIMIT_NONE)),
     .apply = reader_rkpm_gravity, .doc = "gravity, `grav gx gy [gz]`"},
    {.name = "wall", .apply = reader_rkpm_wall,
     .doc = "`wall spring axis position modulus [free|stick]`: a plane below the body, with a spring at each node that is nearer than half a "
            "spacing; its pressure is modulus times depth; nodes slide, or stick while they touch. `wall natural axis position [keep]`, with "
            "mode semi: three layers of nodes that don't move, which take part in the approximation and carry stress; they let a body go when "
            "they pull at it and it moves away (keep: they don't)"},
    {.name = "stab", .long_name = "stabilisation", .arguments = LIST(NUMBER("factor", NULL, LIMIT_NOT_NEGATIVE)), .field = FIELD(dynamic.stabilisation),
     .doc = "factor of the moduli in what stabilises nsni (1; 0.1 with oldr and powl)"},
    {0}};

_Static_assert(sizeof rkpm_keywords / sizeof *rkpm_keywords <= READER_WORDS, "reader.rkpm_places has room for all words of rkpm");

void reader_rkpm(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)values;
    reader->scene->rkpm.place = word->place;
    reader->has_bad_rkpm = !reader_block(reader, rkpm_keywords, "ends", "rkpm", reader->rkpm_places);
}
