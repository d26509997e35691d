/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Decks of smoothed particles: what stands in the scene, and that its echo says the same. */
#define _POSIX_C_SOURCE 200809L
#include "base/memory.h"
#include "check.h"
#include "deck/diagnostics.h"
#include "deck/echo.h"
#include "deck/reader.h"

#include <stdlib.h>
#include <string.h>

/* The scene of a deck; ends the test where the deck is wrong. */
static struct scene *read_deck(const char *deck)
{
    struct diagnostics *diagnostics = diagnostics_open();
    struct deck_text *text = text_open(diagnostics);
    text_include_memory(text, "deck", deck, strlen(deck));
    struct scene *scene = reader_read(text, diagnostics);
    if (diagnostics_errors(diagnostics) > 0) {
        diagnostics_print(diagnostics, text, stderr, false);
        exit(2);
    }
    text_close(text);
    diagnostics_close(diagnostics);
    return scene;
}

/* The caller frees it. */
static char *echo_of(const struct scene *scene)
{
    char *echo = NULL;
    size_t length = 0;
    FILE *stream = open_memstream(&echo, &length);
    if (!stream)
        exit(4);
    echo_scene(scene, stream, true);
    if (fclose(stream) != 0)
        exit(4);
    return echo;
}

static void remove_notes(char *echo)
{
    static const char note[] = "   ! default";
    for (char *found = echo; (found = strstr(found, note));)
        memmove(found, found + sizeof note - 1, strlen(found + sizeof note - 1) + 1);
}

/* Reads the echo again and compares the echo of that. */
static struct scene *read_again(const char *name, struct scene *scene)
{
    char *once = echo_of(scene);
    struct scene *again = read_deck(once);
    char *twice = echo_of(again);
    remove_notes(once);
    remove_notes(twice);
    check_true(name, strcmp(once, twice) == 0);
    free(once);
    free(twice);
    scene_close(scene);
    return again;
}

#define HEAD "meth sph nbbo 2 nbmp 50 nmat 1 grid 0 9 0 9 0 9\n"
#define BODIES "part bloc 1 1 2 1 0 4 0 5 3 1\npart bloc 1 1 2 1 0 0 0 5 3 1\n"

static void test_defaults(void)
{
    struct scene *scene = read_again("defaults: echo", read_deck(HEAD "mate 1 flui 2 .1\n" BODIES "endi\n"));
    const struct scene_sph *sph = &scene->sph;
    const struct properties *properties = &scene->materials[0].properties;
    check_true("defaults: method", scene->method == METHOD_SPH);
    check_true("defaults: lengths", sph->dimension == 3 && sph->smoothing == 1.2 && sph->wide_smoothing == 1.8);
    check_true("defaults: flow", sph->density_diffusion == 0.1 && !sph->diffuses_gradient && sph->sound_speed == 0 && sph->courant == 0
                                     && sph->pressure == PRESSURE_SYMMETRIC && sph->viscosity == VISCOSITY_MONAGHAN
                                     && sph->integrator == INTEGRATOR_STAGGERED && sph->shifting == 0 && !sph->cuts_tension
                                     && !sph->reduces_pressure && !sph->varies_smoothing && !sph->is_periodic);
    check_true("defaults: surface", sph->surface == SURFACE_OFF && sph->corrects_depth && sph->holds_films && sph->opens_expansion && sph->surface_threshold == 0.1 && !sph->has_marangoni);
    check_true("defaults: heat", sph->heat == HEAT_OFF && sph->mass == MASS_AT_START && sph->melt_sound_factor == 1 && !sph->relaxes_excess
                                     && !sph->radiates && !sph->evaporates && !sph->beam.is_on && !sph->freezes_flow);
    check_true("defaults: density and viscosity are those of the law",
               property_value(&properties->tables[PROPERTY_DENSITY], 3000) == 2 && property_value(&properties->tables[PROPERTY_VISCOSITY], 3) == 0.1);
    scene_close(scene);
}

static const char full[] =
    HEAD "mate 1 flui 2 .1\n"
    "prop 1 dens 2 100 3 200 2 extr prop 1 capa 1 0 7 prop 1 cond 1 0 4 prop 1 surf 2 0 1 9 .5 prop 1 melt 150 160 40 prop 1 boil 300 5 .1\n" BODIES
    "sph dime 2 hrat 1.5 hsra 2 c0 30 adapt delt .2 grad dens pgra shep visc morr inte thes cfl .05 csf thes dept off film off expa off csfe .3 mara on heat appa\n"
    "latc on vhea on mcfa .2 rela on redu 1.5 shif .3 tens on vsmo on radi .4 290 evap 1e5 froz on mush 9 base -3 jitt .1 5 solids\n"
    "peri on powe 8 wall 2 velo 1 2 3 temp 120 nost\ntemp 1 155 swel 1 cycl .1 2 swel 2 rate -.2 until 3 stre 1 1 2 3\n"
    "beam 150 .5 .3 alpha 4 line .1 bins 1.5\npath 0 1 2 3 4 5 6 7\npath 1 2 5 6 7 5 6 7 ends\n"
    "load grav 1 0 -9 0 endl velo body 1 1 0 0 endv outr kapp curv pool curx pres 2.4 5.6 .5\nendi\n";

static void test_flow(const struct scene_sph *sph)
{
    check_true("words: lengths", sph->dimension == 2 && sph->smoothing == 1.5 && sph->wide_smoothing == 2);
    check_true("words: flow", sph->sound_speed == 30 && sph->adapts_sound && sph->density_diffusion == 0.2 && sph->diffuses_gradient
                                  && sph->diffuses_reference
                                  && sph->pressure == PRESSURE_SHEPARD && sph->viscosity == VISCOSITY_MORRIS
                                  && sph->integrator == INTEGRATOR_PREDICTED && sph->courant == 0.05 && sph->shifting == 0.3
                                  && sph->cuts_tension && sph->varies_smoothing && sph->freezes_flow && sph->is_periodic);
    check_true("words: reduced pressure", sph->reduces_pressure && sph->reference_density == 1.5);
    check_true("words: start", sph->jitter == 0.1 && sph->seed == 5 && sph->jitters_solids && sph->base == -3 && sph->n_temperatures == 1 && sph->temperatures[0].body == 0
                                   && sph->temperatures[0].value == 155 && sph->n_stretches == 1 && sph->stretches[0].factor[2] == 3);
    check_true("words: swelling", sph->n_swellings == 2 && sph->swellings[0].form == SWELLING_CYCLE && sph->swellings[0].amplitude == 0.1
                                      && sph->swellings[0].frequency == 2 && sph->swellings[1].form == SWELLING_STEADY
                                      && sph->swellings[1].amplitude == -0.2 && sph->swellings[1].end == 3);
    const struct scene_wall *wall = sph->walls;
    check_true("words: wall", sph->n_walls == 1 && wall->body == 1 && wall->velocity[2] == 3 && wall->heat == WALL_TEMPERATURE
                                  && wall->temperature == 120 && wall->no_stick);
}

static void test_heat(const struct scene_sph *sph)
{
    const struct scene_beam *beam = &sph->beam;
    check_true("words: surface", sph->surface == SURFACE_THESIS && !sph->corrects_depth && !sph->holds_films && !sph->opens_expansion && sph->surface_threshold == 0.3 && sph->has_marangoni);
    check_true("words: heat", sph->heat == HEAT_APPARENT && sph->corrects_lattice && sph->heats_by_viscosity && sph->volume_heat == 8
                                  && sph->mush_drag == 9);
    check_true("words: melting; masses are those at the solidus",
               sph->mass == MASS_AT_SOLIDUS && sph->melt_sound_factor == 0.2 && sph->relaxes_excess);
    check_true("words: losses", sph->radiates && sph->emissivity == 0.4 && sph->ambient == 290 && sph->evaporates && sph->ambient_pressure == 1e5);
    check_true("words: beam", beam->is_on && beam->power == 150 && beam->radius == 0.5 && beam->absorptivity == 0.3 && beam->depth == 4
                                  && beam->reading == BEAM_LINE && beam->thickness == 0.1 && beam->bin == 1.5);
    check_true("words: path", beam->n_pieces == 2 && beam->pieces[0].times[1] == 1 && beam->pieces[0].from[0] == 2
                                  && beam->pieces[0].to[2] == 7 && beam->pieces[1].from[1] == 6);
}

static void test_words(void)
{
    struct scene *scene = read_again("words: echo", read_deck(full));
    const struct properties *properties = &scene->materials[0].properties;
    test_flow(&scene->sph);
    test_heat(&scene->sph);
    check_true("words: table", property_value(&properties->tables[PROPERTY_DENSITY], 150) == 2.5
                                   && property_value(&properties->tables[PROPERTY_DENSITY], 250) == 1.5);
    check_true("words: melting and boiling", properties->melts && properties->solidus == 150 && properties->liquidus == 160
                                                 && properties->boils && properties->boiling_point == 300 && properties->molar_mass == 0.1);
    check_near("words: enthalpy is ready", properties_enthalpy(properties, 160) - properties_enthalpy(properties, 150), 110, 1e-12);
    check_true("words: the particle near a point", scene->curves[1].is_near && scene->curves[1].particle == 7);
    check_true("words: a total", scene->curves[0].result->total == TOTAL_POOL_LENGTH && !scene->curves[0].result->value);
    scene_close(scene);
}

/* No word of a block hides another; the methods of rows are right where decks depend on them. */
static void test_tables(void)
{
    bool good = true;
    int count;
    for (const struct keyword *row = sph_keywords; row->name; row++)
        good = good && keyword_in(sph_keywords, row->name) == row && strlen(row->name) <= 4 && strlen(row->doc) > 10;
    for (const struct keyword *row = property_keywords; row->name; row++)
        good = good && keyword_in(property_keywords, row->name) == row;
    check_true("tables: no word of sph or prop hides another", good);
    const struct result *rows = result_rows(&count);
    good = true;
    for (int i = 0; i < count; i++)
        good = good && result_find(rows[i].name) == &rows[i] && (rows[i].value || rows[i].total != TOTAL_NONE);
    check_true("tables: every result has a value or a total, and none hides another", good);
    good = true;
    for (const struct law *const *law = law_rows(); *law; law++)
        good = good && (*law)->methods != 0 && (((*law)->methods & METHODS_MPM) == 0 || (*law)->later || (*law)->update);
    check_true("tables: every law has a method, and those of mpm an update", good);
}

int main(void)
{
    test_defaults();
    test_words();
    test_tables();
    return check_result();
}
