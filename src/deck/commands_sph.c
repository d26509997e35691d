/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The block of sph: how smoothed particles move, their surface, heat, beam and walls. */
#include "deck/commands_sph.h"
#include "base/memory.h"

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

#define NUMBER(name, unit, limit) {name, unit, ARGUMENT_REAL, limit}
#define BODY {"body", NULL, ARGUMENT_INTEGER, LIMIT_COUNT}
#define VELOCITY(name) NUMBER(name, "length/time", LIMIT_NONE)
#define LENGTH(name) NUMBER(name, "length", LIMIT_NONE)
#define WORD(name) ((const struct argument[]){{name, NULL, ARGUMENT_WORD, LIMIT_NONE}, {0}})
#define LIST(...) ((const struct argument[]){__VA_ARGS__, {0}})
#define FIELD(name) offsetof(struct scene, sph.name)
#define CHOICE(names, name) &(const struct keyword_choice){names, FIELD(name), false}
#define SWITCH(name) .arguments = WORD("off|on"), .choice = &(const struct keyword_choice){switches, FIELD(name), true}

_Static_assert(sizeof(enum surface_form) == sizeof(int), "choices are stored as int");
static const char *const switches[] = {"off", "on", NULL};
static const char *const pressures[] = {[PRESSURE_SYMMETRIC] = "sym", [PRESSURE_SHEPARD] = "shep", NULL};
static const char *const viscosities[] = {[VISCOSITY_MONAGHAN] = "mg", [VISCOSITY_MORRIS] = "morr", NULL};
static const char *const integrators[] = {[INTEGRATOR_STAGGERED] = "stag", [INTEGRATOR_PREDICTED] = "thes", NULL};
static const char *const surfaces[] = {[SURFACE_OFF] = "off", [SURFACE_BALANCED] = "bala", [SURFACE_THESIS] = "thes", NULL};
static const char *const heats[] = {[HEAT_OFF] = "off", [HEAT_ENTHALPY] = "enth", [HEAT_APPARENT] = "appa", NULL};
static const char *const masses[] = {[MASS_AT_START] = "start", [MASS_AT_SOLIDUS] = "solidus", NULL};

/* --- words with words behind them --- */

static void read_sound(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const struct argument speed[] = {NUMBER("speed", "length/time", LIMIT_POSITIVE), {0}};
    static const char *const automatic[] = {"auto", NULL}, *const adaptive[] = {"adap", NULL};
    struct value value[2];
    (void)word;
    (void)values;
    if (reader_optional(reader, automatic) == 0)
        reader->scene->sph.sound_speed = 0;
    else if (reader_values(reader, speed, "c0", value))
        reader->scene->sph.sound_speed = value[0].real;
    reader->scene->sph.adapts_sound = reader_optional(reader, adaptive) == 0;
}

static void read_diffusion(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const char *const names[] = {"grad", "dens", NULL};
    struct scene_sph *sph = &reader->scene->sph;
    (void)word;
    (void)values;
    sph->diffuses_gradient = sph->diffuses_reference = false;
    for (int name; (name = reader_optional(reader, names)) >= 0;)
        *(name == 0 ? &sph->diffuses_gradient : &sph->diffuses_reference) = true;
}

static void switch_on_reduction(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    (void)values;
    reader->scene->sph.reduces_pressure = true;
}

static void read_radiation(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    struct scene_sph *sph = &reader->scene->sph;
    (void)word;
    sph->radiates = true;
    sph->emissivity = values[0].real;
    sph->ambient = values[1].real;
}

static void read_evaporation(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    (void)values;
    reader->scene->sph.evaporates = true;
}

static void read_ejected(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const char *const names[] = {"thru", NULL};
    (void)word;
    (void)values;
    reader->scene->sph.lets_beam_through = reader_optional(reader, names) == 0;
}

static void read_jitter(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const char *const names[] = {"soli", NULL};
    (void)word;
    reader->scene->sph.jitter = values[0].real;
    reader->scene->sph.seed = values[1].integer;
    reader->scene->sph.jitters_solids = reader_optional(reader, names) == 0;
}

/* --- walls and bodies --- */

/* The words behind `wall BODY`; false after an error. */
static bool read_wall_words(struct reader *reader, struct scene_wall *wall)
{
    static const char *const names[] = {"velo", "temp", "adia", "nost", NULL};
    static const struct argument velocity[] = {VELOCITY("vx"), VELOCITY("vy"), VELOCITY("vz"), {0}};
    static const struct argument temperature[] = {NUMBER("T", "temperature", LIMIT_NOT_NEGATIVE), {0}};
    struct value values[KEYWORD_ARGUMENTS];
    while (!reader_at_line_end(reader)) {
        const int name = reader_optional(reader, names);
        if (name < 0) {
            reader_expect(reader, "wall", "velo, temp, adia or nost");
            return false;
        }
        if (name == 0 && !reader_values(reader, velocity, "wall velo", values))
            return false;
        for (int a = 0; a < 3 && name == 0; a++)
            wall->velocity[a] = values[a].real;
        if (name == 1 && !reader_values(reader, temperature, "wall temp", values))
            return false;
        if (name == 1)
            wall->temperature = values[0].real;
        if (name == 1 || name == 2)
            wall->heat = name == 1 ? WALL_TEMPERATURE : WALL_ADIABATIC;
        wall->no_stick = wall->no_stick || name == 3;
    }
    return true;
}

static void read_wall(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    struct scene_sph *sph = &reader->scene->sph;
    struct scene_wall wall = {.body = values[0].integer - 1, .place = values[0].word.place};
    (void)word;
    if (!read_wall_words(reader, &wall))
        return;
    sph->walls = memory_grow(sph->walls, &sph->walls_capacity, sph->n_walls + 1, sizeof wall, "wall");
    sph->walls[sph->n_walls++] = wall;
}

static void read_temperature(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    struct scene_sph *sph = &reader->scene->sph;
    (void)word;
    sph->temperatures = memory_grow(sph->temperatures, &sph->temperatures_capacity, sph->n_temperatures + 1,
                                    sizeof *sph->temperatures, "temp");
    sph->temperatures[sph->n_temperatures++] =
        (struct scene_temperature){values[0].integer - 1, values[1].real, values[0].word.place};
}

static void read_swelling(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const char *const forms[] = {[SWELLING_CYCLE] = "cycl", [SWELLING_GROWING] = "grow", [SWELLING_STEADY] = "rate", NULL};
    static const char *const until[] = {"unti", NULL};
    static const struct argument cycle[] = {NUMBER("amplitude", NULL, LIMIT_BELOW_ONE), NUMBER("frequency", "1/time", LIMIT_POSITIVE), {0}};
    static const struct argument growing[] = {NUMBER("rate", "1/time", LIMIT_NONE), NUMBER("frequency", "1/time", LIMIT_POSITIVE), {0}};
    static const struct argument rate[] = {NUMBER("rate", "1/time", LIMIT_NONE), {0}};
    static const struct argument end[] = {NUMBER("end", "time", LIMIT_NOT_NEGATIVE), {0}};
    static const struct {
        const struct argument *arguments;
        const char *name;
    } rows[] = {[SWELLING_CYCLE] = {cycle, "swel cycl"}, [SWELLING_GROWING] = {growing, "swel grow"}, [SWELLING_STEADY] = {rate, "swel rate"}};
    struct scene_sph *sph = &reader->scene->sph;
    struct value numbers[3] = {{0}}, last[2];
    const int form = reader_optional(reader, forms);
    (void)word;
    if (form < 0) {
        reader_expect(reader, "swel", "'cycl amplitude frequency', 'grow rate frequency' or 'rate r'");
        return;
    }
    if (!reader_values(reader, rows[form].arguments, rows[form].name, numbers))
        return;
    struct scene_swelling swelling = {values[0].integer - 1, (enum swelling_form)form, numbers[0].real,
                                      form == SWELLING_STEADY ? 0 : numbers[1].real, INFINITY, values[0].word.place};
    if (form == SWELLING_STEADY && reader_optional(reader, until) == 0) {
        if (!reader_values(reader, end, "swel rate unti", last))
            return;
        swelling.end = last[0].real;
    }
    sph->swellings = memory_grow(sph->swellings, &sph->swellings_capacity, sph->n_swellings + 1, sizeof *sph->swellings, "swel");
    sph->swellings[sph->n_swellings++] = swelling;
}

static void read_stretch(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    struct scene_sph *sph = &reader->scene->sph;
    (void)word;
    sph->stretches = memory_grow(sph->stretches, &sph->stretches_capacity, sph->n_stretches + 1, sizeof *sph->stretches, "stre");
    sph->stretches[sph->n_stretches++] = (struct scene_stretch){
        values[0].integer - 1, {values[1].real, values[2].real, values[3].real}, values[0].word.place};
}

/* --- the beam --- */

static bool read_beam_words(struct reader *reader, struct scene_beam *beam)
{
    static const char *const names[] = {"alpha", "slic", "line", "bins", NULL};
    static const struct argument depth[] = {NUMBER("alpha", "1/length", LIMIT_POSITIVE), {0}};
    static const struct argument thickness[] = {NUMBER("thickness", "length", LIMIT_POSITIVE), {0}};
    static const struct argument bins[] = {NUMBER("bins", NULL, LIMIT_AT_LEAST_ONE), {0}};
    struct value value[2];
    while (!reader_at_line_end(reader)) {
        const int name = reader_optional(reader, names);
        if (name < 0) {
            reader_expect(reader, "beam", "alpha, slic, line or bins");
            return false;
        }
        if (name == 1) {
            beam->reading = BEAM_SLICE;
            continue;
        }
        if (!reader_values(reader, name == 0 ? depth : name == 2 ? thickness : bins, "beam", value))
            return false;
        if (name == 3 && value[0].real > 2) {
            diagnostics_error(reader->diagnostics, value[0].word.place, "bins of beam must be 1 to 2, not %g", value[0].real);
            return false;
        }
        *(name == 0 ? &beam->depth : name == 2 ? &beam->thickness : &beam->bin) = value[0].real;
        if (name == 2)
            beam->reading = BEAM_LINE;
    }
    return true;
}

static void read_beam(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    struct scene_beam *beam = &reader->scene->sph.beam;
    if (beam->is_on)
        diagnostics_error(reader->diagnostics, word->place, "'beam' was given before");
    beam->is_on = true;
    beam->place = word->place;
    beam->power = values[0].real;
    beam->radius = values[1].real;
    beam->absorptivity = values[2].real;
    beam->bin = 1;
    read_beam_words(reader, beam);
}

static void read_path(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    struct scene_beam *beam = &reader->scene->sph.beam;
    struct scene_beam_piece piece = {.times = {values[0].real, values[1].real}, .place = word->place};
    for (int a = 0; a < 3; a++) {
        piece.from[a] = values[2 + a].real;
        piece.to[a] = values[5 + a].real;
    }
    if (piece.times[1] <= piece.times[0])
        diagnostics_error(reader->diagnostics, values[1].word.place, "path ends at %g, but begins at %g; expected a later end", piece.times[1],
                          piece.times[0]);
    else if (beam->n_pieces > 0 && piece.times[0] < beam->pieces[beam->n_pieces - 1].times[1])
        diagnostics_error(reader->diagnostics, values[0].word.place,
                          "path begins at %g, before the piece before it ends at %g; there is one beam, and pieces come in the order of time",
                          piece.times[0], beam->pieces[beam->n_pieces - 1].times[1]);
    beam->pieces = memory_grow(beam->pieces, &beam->pieces_capacity, beam->n_pieces + 1, sizeof piece, "path");
    beam->pieces[beam->n_pieces++] = piece;
}

const struct keyword sph_keywords[] = {
    {.name = "dime", .long_name = "dimension", .arguments = LIST({"d", NULL, ARGUMENT_INTEGER, LIMIT_DIMENSION}),
     .field = FIELD(dimension), .doc = "dimensions; in 2 all particles lie in one plane of z (3)"},
    {.name = "hrat", .long_name = "hratio", .arguments = LIST(NUMBER("ratio", NULL, LIMIT_AT_LEAST_ONE)), .field = FIELD(smoothing),
     .doc = "smoothing length h over the spacing (1.2; 1.5 is more accurate, and slower)"},
    {.name = "hsra", .long_name = "hsratio", .arguments = LIST(NUMBER("ratio", NULL, LIMIT_AT_LEAST_ONE)), .field = FIELD(wide_smoothing),
     .doc = "the same of the wide kernel of normals and curvature (1.8)"},
    {.name = "c0", .apply = read_sound,
     .doc = "`c0 speed`: sound speed, ten times the fastest flow or more; `c0 auto`: found from the scene at its start (default). With "
            "`adapt` behind it changes by and by to what the flow needs: densities within a hundredth of their reference"},
    {.name = "delt", .long_name = "delta", .arguments = LIST(NUMBER("delta", NULL, LIMIT_NOT_NEGATIVE)), .field = FIELD(density_diffusion),
     .apply = read_diffusion,
     .doc = "diffusion of density (0.1); with `grad` behind it gradients are kept, which gravity needs; with `dens` it acts on the density "
            "itself, not on what of it gives pressure, to show what comes of it"},
    {.name = "pgra", .long_name = "pgradient", .arguments = WORD("sym|shep"), .choice = CHOICE(pressures, pressure),
     .doc = "pressure force: of sums (sym, default), or each divided by the other's Shepard sum (shep, of the dissertation)"},
    {.name = "visc", .long_name = "viscosity", .arguments = WORD("mg|morr"), .choice = CHOICE(viscosities, viscosity),
     .doc = "viscous force of Monaghan and Gingold (mg, default: free surfaces) or of Morris (morr: channels, layers)"},
    {.name = "inte", .long_name = "integrator", .arguments = WORD("stag|thes"), .choice = CHOICE(integrators, integrator),
     .doc = "time integration: staggered (stag, default), or that of the dissertation (thes)"},
    {.name = "cfl", .arguments = LIST(NUMBER("factor", NULL, LIMIT_NOT_NEGATIVE)), .field = FIELD(courant),
     .doc = "time step over h/(c0 + u); 0: 0.4, with inte thes 0.1 (0). For a fixed step see dtfx"},
    {.name = "csf", .arguments = WORD("off|bala|thes"), .choice = CHOICE(surfaces, surface),
     .doc = "surface tension: none (off, default), balanced with the pressure force (bala), that of the dissertation (thes)"},
    {.name = "dept", .long_name = "depth", SWITCH(corrects_depth), .doc = "curvature corrected for its depth below the surface (on)"},
    {.name = "csfe", .long_name = "csfeps", .arguments = LIST(NUMBER("eps", NULL, LIMIT_POSITIVE)), .field = FIELD(surface_threshold),
     .doc = "normals times h_s below this make no curvature (0.1)"},
    {.name = "expa", .long_name = "expansion", SWITCH(opens_expansion),
     .doc = "what a particle of a free surface expands or shrinks by heat goes into the open; else it pushes those below, and hot "
            "layers come off (on)"},
    {.name = "film", .long_name = "films", SWITCH(holds_films),
     .doc = "surface tension acts on films of one or two layers of particles too, whose curvature is uncertain (on)"},
    {.name = "mara", .long_name = "marangoni", SWITCH(has_marangoni), .doc = "force along the surface where its tension changes (off)"},
    {.name = "heat", .arguments = WORD("off|enth|appa"), .choice = CHOICE(heats, heat),
     .doc = "heat: none (off, default), by enthalpy (enth), by apparent capacity as in the dissertation (appa); the materials "
            "need capa and cond of prop"},
    {.name = "latc", .long_name = "lattice", SWITCH(corrects_lattice), .doc = "conduction inside solids times a factor that makes it exact on their lattice (off)"},
    {.name = "vhea", .long_name = "vheat", SWITCH(heats_by_viscosity), .doc = "viscosity heats (off)"},
    {.name = "mref", .long_name = "massref", .arguments = WORD("start|solidus"), .choice = CHOICE(masses, mass),
     .doc = "masses of solids from the density at the start, or at the solidus, so that they melt without pressure (solidus where "
            "something melts)"},
    {.name = "mcfa", .long_name = "mcfactor", .arguments = LIST(NUMBER("factor", NULL, LIMIT_POSITIVE)), .field = FIELD(melt_sound_factor),
     .doc = "of the dissertation: sound speed of what has just melted, times this (1; 0.2 there)"},
    {.name = "rela", .long_name = "relax", SWITCH(relaxes_excess), .doc = "pressure of what has just melted starts at 0 and comes by and by (off)"},
    {.name = "redu", .long_name = "reduced", .arguments = LIST(NUMBER("density", "mass/length^3", LIMIT_POSITIVE)),
     .field = FIELD(reference_density), .apply = switch_on_reduction,
     .doc = "pressure without that of a fluid of this density at rest: gravity times 1 - density/rho0, for buoyancy"},
    {.name = "shif", .long_name = "shift", .arguments = LIST(NUMBER("factor", NULL, LIMIT_NOT_NEGATIVE)), .field = FIELD(shifting),
     .doc = "particles away from the surface are shifted to even distances (0; 0.2 is a good one)"},
    {.name = "tens", .long_name = "tension", SWITCH(cuts_tension), .doc = "against clumping under negative pressure; loses momentum (off)"},
    {.name = "vsmo", .long_name = "vsmoothing", SWITCH(varies_smoothing), .doc = "h follows the volume of each particle (off)"},
    {.name = "radi", .long_name = "radiation",
     .arguments = LIST(NUMBER("emissivity", NULL, LIMIT_FRACTION), NUMBER("ambient", "temperature", LIMIT_NOT_NEGATIVE)), .apply = read_radiation,
     .doc = "the free surface radiates into surroundings of this temperature; temperatures are in kelvin then"},
    {.name = "evap", .long_name = "evaporation", .arguments = LIST(NUMBER("pressure", "stress", LIMIT_POSITIVE)),
     .field = FIELD(ambient_pressure), .apply = read_evaporation,
     .doc = "liquid evaporates under this pressure of the surroundings: heat is lost, and the recoil presses on the surface"},
    {.name = "froz", .long_name = "frozen", SWITCH(freezes_flow), .doc = "velocities stay zero: conduction alone (off)"},
    {.name = "mush", .arguments = LIST(NUMBER("drag", "1/time", LIMIT_NOT_NEGATIVE)), .field = FIELD(mush_drag),
     .doc = "drag of the mush K0 (1 - s)^2/(s^3 + 0.001), s liquid fraction; 0: none (0)"},
    {.name = "ejec", .long_name = "ejected", .arguments = LIST(NUMBER("T", "temperature", LIMIT_NOT_NEGATIVE)), .field = FIELD(ejected_above),
     .apply = read_ejected,
     .doc = "what came off the metal tears where it would be pulled, and is removed when it is hotter than this, with its heat; with `thru` behind it the beam goes through what came off and through threads of single particles, which in a "
            "slice would shade all that is below, and get as hot as nothing that conducts; 0: nothing of this (0; 6000 in the dissertation)"},
    {.name = "base", .arguments = LIST(LENGTH("height")), .field = FIELD(base),
     .doc = "height of the surface below which penetration (curv pene) is measured (0)"},
    {.name = "jitt", .long_name = "jitter",
     .arguments = LIST(NUMBER("amplitude", "spacings", LIMIT_FRACTION), {"seed", NULL, ARGUMENT_INTEGER, LIMIT_COUNT}), .apply = read_jitter,
     .doc = "fluid starts at random up to so far from its lattice (0); with `solids` behind it solids too, which makes melts differ by "
            "the seed"},
    {.name = "peri", .long_name = "periodic", SWITCH(is_periodic), .doc = "the scene repeats along x, between the ends of the grid (off)"},
    {.name = "powe", .long_name = "power", .arguments = LIST(NUMBER("power", "power/length^3", LIMIT_NONE)), .field = FIELD(volume_heat),
     .doc = "heat that all of the metal is given, per volume (0)"},
    {.name = "wall", .arguments = LIST(BODY), .apply = read_wall,
     .doc = "a body is a wall: `wall body [velo vx vy vz] [temp T | adia] [nost]`; it moves with a velocity, has a temperature or lets "
            "no heat through (adia, default); nost: fluid comes off it"},
    {.name = "temp", .long_name = "temperature", .arguments = LIST(BODY, NUMBER("T", "temperature", LIMIT_NOT_NEGATIVE)), .apply = read_temperature,
     .doc = "temperature of a body at the start (293)"},
    {.name = "swel", .long_name = "swelling", .arguments = LIST(BODY), .apply = read_swelling,
     .doc = "density of a body without pressure changes, times 1 + a sin(2 pi f t): `swel body cycl a f`; 1 + r t sin(2 pi f t): `swel body "
            "grow r f`; 1 + r t: `swel body rate r`, with `until t` behind it up to this time"},
    {.name = "stre", .long_name = "stretch",
     .arguments = LIST(BODY, NUMBER("sx", NULL, LIMIT_POSITIVE), NUMBER("sy", NULL, LIMIT_POSITIVE), NUMBER("sz", NULL, LIMIT_POSITIVE)),
     .apply = read_stretch, .doc = "a body is stretched about its middle at the start"},
    {.name = "beam",
     .arguments = LIST(NUMBER("power", "power", LIMIT_NOT_NEGATIVE), NUMBER("radius", "length", LIMIT_POSITIVE),
                       NUMBER("absorptivity", NULL, LIMIT_FRACTION)),
     .apply = read_beam,
     .doc = "Gaussian beam along the last axis, downwards; radius where it has 1/e^2; absorptivity 0: that of prop. Behind them `alpha a` "
            "absorbed per length (3 a spacing); `slic` (default) or `line thickness`: what two dimensions have of it; `bins b`: cells of "
            "its march, 1 to 2 spacings (1)"},
    {.name = "path",
     .arguments = LIST(NUMBER("t0", "time", LIMIT_NONE), NUMBER("t1", "time", LIMIT_NONE), LENGTH("x0"), LENGTH("y0"), LENGTH("z0"),
                       LENGTH("x1"), LENGTH("y1"), LENGTH("z1")),
     .apply = read_path, .doc = "the beam is on between two times and goes from one point to another; may be repeated"},
    {0}};

_Static_assert(sizeof sph_keywords / sizeof *sph_keywords <= READER_WORDS, "reader.sph_places has room for all words of sph");

void reader_sph(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)values;
    reader->scene->sph.place = word->place;
    reader->has_bad_sph = !reader_block(reader, sph_keywords, "ends", "sph", reader->sph_places);
}
