/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Additive manufacturing: closed particles and their opening, scan, transformation strains, held nodes. */
#include "deck/commands_process.h"
#include "base/memory.h"

#include <limits.h>
#include <math.h>
#include <string.h>
#include <strings.h>

#define COUNT(name) {name, NULL, ARGUMENT_INTEGER, LIMIT_COUNT}
#define LENGTH(name) {name, "length", ARGUMENT_REAL, LIMIT_NONE}
#define SIZE(name) {name, "length", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE}
#define FLAG(name) {name, NULL, ARGUMENT_INTEGER, LIMIT_FLAG}

static const struct argument one_count[] = {COUNT("n"), {0}}, one_id[] = {COUNT("id"), {0}};

/* --- closed particles --- */

/* GPD id value, or GPD id1 id2 value: a third number stands on the same line. */
static void read_ghost(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const struct argument third[] = {FLAG("value"), {0}};
    struct scene_building *building = &reader->scene->building;
    struct value last[2] = {values[1]};
    bool is_range = reader_has_more(reader);
    (void)word;
    if (is_range && !reader_values(reader, third, "GPD", last))
        return;
    if (!is_range && !argument_within(LIMIT_FLAG, values[1].real)) {
        diagnostics_error(reader->diagnostics, values[1].word.place, "value of GPD must be %s, not %ld",
                          argument_limit_text(LIMIT_FLAG), values[1].integer);
        return;
    }
    struct scene_ghost ghost = {values[0].integer - 1, is_range ? values[1].integer - 1 : values[0].integer - 1,
                                last[0].integer == 1, values[0].word.place};
    if (ghost.last < ghost.first) {
        diagnostics_error(reader->diagnostics, values[1].word.place, "GPD goes from particle %ld to %ld; expected the lower id first",
                          ghost.first + 1, ghost.last + 1);
        return;
    }
    building->ghosts = memory_grow(building->ghosts, &building->ghosts_capacity, building->n_ghosts + 1, sizeof ghost, "Ghost");
    building->ghosts[building->n_ghosts++] = ghost;
}

const struct keyword ghost_keywords[] = {
    {.name = "GPD", .arguments = (const struct argument[]){COUNT("id"), {"value", NULL, ARGUMENT_INTEGER, LIMIT_NONE}, {0}},
     .apply = read_ghost, .doc = "a particle is closed (0) or open (1) at the start; `GPD id1 id2 value` says so of a range"},
    {0}};

void reader_ghosts(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const char *const showing[] = {"show", NULL};
    struct scene_building *building = &reader->scene->building;
    (void)values;
    if (reader_optional(reader, showing) == 0) {
        building->shows_ghosts = true;
        return;
    }
    if (reader_has_more(reader)) {
        reader_expect(reader, "Ghost", "'show', or lines 'GPD id value' and 'endG'");
        return;
    }
    building->has_ghosts = true;
    building->ghost_place = word->place;
    if (reader->scene->method != METHOD_RKPM) /* its nodes are counted when the whole block is known */
        reader_needs(reader, word, "nbmp");
    reader_block(reader, ghost_keywords, "endG", "Ghost", NULL);
}

/* The number behind `every`. */
static bool read_every(struct reader *reader, const char *owner, long *number)
{
    static const char *const every[] = {"every", NULL};
    struct value value[2];
    if (reader_optional(reader, every) < 0) {
        reader_expect(reader, owner, "'every n', the steps from one opening to the next");
        return false;
    }
    if (!reader_values(reader, one_count, owner, value))
        return false;
    *number = value[0].integer;
    return true;
}

/* What may not stand behind `open all` and the like. */
static void check_end_of_opening(struct reader *reader, const char *kind)
{
    static const char *const words[] = {"every", "settle", "until", NULL};
    int found = reader_optional(reader, words);
    if (found < 0)
        return;
    diagnostics_error(reader->diagnostics, reader->last.place, "'%s' does not belong to 'open %s'%s", words[found], kind,
                      found == 0 ? "" : "; give it an 'open' of its own");
    reader_skip_line(reader);
}

void reader_opening(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const char *const kinds[] = {"point", "group", "layer", "all", "settle", "until", NULL};
    struct scene_building *building = &reader->scene->building;
    struct value value[2];
    int kind = reader_optional(reader, kinds);
    (void)values;
    if (kind >= 0 && kind < 4) {
        if (building->opening != OPENING_NONE)
            diagnostics_error(reader->diagnostics, word->place, "'open' gives a second schedule; expected one of 'open point', "
                                                                "'open group', 'open layer' and 'open all'");
        building->open_place = word->place;
    }
    if (kind < 0) {
        reader_expect(reader, "open", "point, group, layer, all, settle or until");
    } else if (kind == 0 && read_every(reader, "open point", &building->interval)) {
        building->opening = OPENING_POINTS, building->group = 1;
    } else if (kind == 1 && reader_values(reader, one_count, "open group", value)
               && read_every(reader, "open group", &building->interval)) {
        building->opening = OPENING_POINTS, building->group = value[0].integer;
    } else if (kind == 2 && read_every(reader, "open layer", &building->interval)) {
        building->opening = OPENING_LAYERS;
    } else if (kind == 3) {
        building->opening = OPENING_ALL, building->interval = 1;
    } else if (kind == 4) {
        static const struct argument steps[] = {{"steps", NULL, ARGUMENT_INTEGER, LIMIT_NOT_NEGATIVE}, {0}};
        building->settling_place = word->place;
        if (reader_values(reader, steps, "open settle", value))
            building->settling = value[0].integer;
    } else if (kind == 5 && reader_values(reader, one_id, "open until", value)) {
        building->until = value[0].integer - 1;
        building->until_place = value[0].word.place;
    }
    if (kind >= 0 && kind < 4)
        check_end_of_opening(reader, kinds[kind]);
}

void reader_build(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const char *const axes[] = {"x", "y", "z", NULL};
    static const struct argument thickness[] = {{"thickness", "length", ARGUMENT_REAL, LIMIT_POSITIVE}, {0}};
    struct scene_building *building = &reader->scene->building;
    struct value value[2];
    int axis = reader_optional(reader, axes);
    (void)values;
    building->build_place = word->place;
    if (axis < 0) {
        reader_expect(reader, "buil", "the build direction x, y or z");
        return;
    }
    building->axis = axis;
    building->thickness = 0;
    if (reader_has_more(reader) && reader_values(reader, thickness, "buil", value))
        building->thickness = value[0].real;
}

void reader_scan(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const char *const orders[] = {[SCAN_DECK] = "deck", [SCAN_RASTER] = "raster", NULL};
    static const char *const serpentine[] = {"serpentine", NULL};
    static const struct argument angle[] = {{"angle", "degrees", ARGUMENT_REAL, LIMIT_NONE}, {0}};
    struct scene_building *building = &reader->scene->building;
    struct value value[2];
    int order = reader_optional(reader, orders);
    (void)values;
    building->scan_place = word->place;
    if (order >= 0) {
        building->order = (enum scan_order)order;
        building->is_serpentine = order == SCAN_RASTER && reader_optional(reader, serpentine) == 0;
    }
    if (order < 0 && !reader_has_more(reader)) {
        reader_expect(reader, "scan", "angles, deck or raster");
        return;
    }
    if (reader_has_more(reader))
        building->n_angles = 0;
    while (reader_has_more(reader)) {
        if (!reader_values(reader, angle, "scan", value))
            return;
        building->angles = memory_grow(building->angles, &building->angles_capacity, building->n_angles + 1, sizeof(double), "scan");
        building->angles[building->n_angles++] = value[0].real;
    }
}

/* --- transformation strains --- */

/* The entry of the material that a word speaks of, or NULL. */
static struct scene_transformation *transformation_of(struct reader *reader, const struct deck_word *word, const struct value *material)
{
    struct scene *scene = reader->scene;
    if (!reader_needs(reader, word, "mate") || !reader_check_id(reader, material, (long)scene->n_materials, "material"))
        return NULL;
    return &scene->materials[material->integer - 1].transformation;
}

/* Notes that a word is given for a material, which it may be once. */
static void note_given(struct reader *reader, const struct deck_word *word, const char *name, long material, bool *is_given)
{
    if (*is_given)
        diagnostics_error(reader->diagnostics, word->place, "'%s' of material %ld was given before", name, material);
    *is_given = true;
}

const struct argument reader_residual_arguments[] = {COUNT("material"), {"along", "stress", ARGUMENT_REAL, LIMIT_NONE},
    {"across", "stress", ARGUMENT_REAL, LIMIT_NONE}, {"shear", "stress", ARGUMENT_REAL, LIMIT_NONE}, {0}};

void reader_residual(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    struct scene_transformation *entry = transformation_of(reader, word, &values[0]);
    if (!entry)
        return;
    note_given(reader, word, "resi", values[0].integer, &entry->has_residual);
    entry->residual_place = word->place;
    for (int i = 0; i < 3; i++)
        entry->residual[i] = values[1 + i].real;
}

const struct argument reader_phase_arguments[] = {COUNT("material"), {"before", "mass/length^3", ARGUMENT_REAL, LIMIT_POSITIVE},
    {"after", "mass/length^3", ARGUMENT_REAL, LIMIT_POSITIVE}, {0}};

void reader_phase(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    struct scene_transformation *entry = transformation_of(reader, word, &values[0]);
    if (!entry)
        return;
    note_given(reader, word, "phas", values[0].integer, &entry->has_phase);
    entry->phase_place = word->place;
    entry->phase_densities[0] = values[1].real;
    entry->phase_densities[1] = values[2].real;
}

const struct argument reader_heat_arguments[] = {COUNT("material"), {"expansion", "1/temperature", ARGUMENT_REAL, LIMIT_NONE},
    {"difference", "temperature", ARGUMENT_REAL, LIMIT_NONE}, {"radius", "length", ARGUMENT_REAL, LIMIT_POSITIVE}, {0}};

void reader_heat(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const char *const signs[] = {"heat", "cool", NULL};
    int sign = reader_optional(reader, signs);
    if (sign < 0 && reader_has_more(reader))
        reader_expect(reader, "ther", "heat or cool");
    struct scene_transformation *entry = transformation_of(reader, word, &values[0]);
    if (!entry)
        return;
    note_given(reader, word, "ther", values[0].integer, &entry->has_heat);
    entry->heat_place = word->place;
    entry->expansion = values[1].real;
    entry->temperature = values[2].real;
    entry->radius = values[3].real;
    entry->cools = sign == 1;
}

/* --- held nodes --- */

/* The three flags that end a `fixn`. */
static void set_hold(struct reader *reader, struct scene_hold *hold, const struct value *flags)
{
    struct scene *scene = reader->scene;
    for (int a = 0; a < 3; a++)
        hold->holds[a] = flags[a].integer == 1;
    if (!hold->holds[0] && !hold->holds[1] && !hold->holds[2])
        diagnostics_warning(reader->diagnostics, hold->place, "fixn holds nothing: ix, iy and iz are 0");
    scene->holds = memory_grow(scene->holds, &scene->holds_capacity, scene->n_holds + 1, sizeof *hold, "fixn");
    scene->holds[scene->n_holds++] = *hold;
}

static void read_annulus(struct reader *reader, const struct deck_word *word)
{
    static const char *const axes[] = {"x", "y", "z", NULL};
    static const struct argument arguments[] = {LENGTH("a"), LENGTH("b"), SIZE("r0"), SIZE("r1"), FLAG("ix"), FLAG("iy"), FLAG("iz"), {0}};
    struct scene_hold hold = {.is_annulus = true, .axis = reader_optional(reader, axes), .place = word->place};
    struct value values[KEYWORD_ARGUMENTS];
    if (hold.axis < 0) {
        reader_expect(reader, "fixn cyli", "its axis x, y or z");
        return;
    }
    if (!reader_values(reader, arguments, "fixn cyli", values))
        return;
    for (int i = 0; i < 2; i++) {
        hold.centre[i] = values[i].real;
        hold.radius[i] = values[2 + i].real;
    }
    if (hold.radius[1] < hold.radius[0])
        diagnostics_error(reader->diagnostics, values[3].word.place, "r1 of fixn cyli is below r0");
    set_hold(reader, &hold, values + 4);
}

void reader_hold(struct reader *reader, const struct deck_word *word, const struct value *values_unused)
{
    static const char *const annulus[] = {"cyli", NULL};
    static const struct argument arguments[] = {LENGTH("x0"), LENGTH("x1"), LENGTH("y0"), LENGTH("y1"), LENGTH("z0"), LENGTH("z1"),
                                                FLAG("ix"), FLAG("iy"), FLAG("iz"), {0}};
    struct scene_hold hold = {.place = word->place};
    struct value values[KEYWORD_ARGUMENTS];
    (void)values_unused;
    if (reader_optional(reader, annulus) == 0) {
        read_annulus(reader, word);
        return;
    }
    if (!reader_values(reader, arguments, "fixn", values))
        return;
    for (int i = 0; i < 6; i++)
        hold.box[i] = values[i].real;
    for (int a = 0; a < 3; a++)
        if (hold.box[2 * a + 1] < hold.box[2 * a])
            diagnostics_error(reader->diagnostics, values[2 * a + 1].word.place, "%c1 of fixn is below %c0", "xyz"[a], "xyz"[a]);
    set_hold(reader, &hold, values + 6);
}

/* --- checks of the whole deck --- */

void reader_check_ghosts(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    const struct scene_building *building = &scene->building;
    for (size_t i = 0; i < building->n_ghosts; i++) {
        const struct scene_ghost *ghost = &building->ghosts[i];
        if (ghost->last >= scene->n_particles)
            diagnostics_error(reader->diagnostics, ghost->place, "GPD speaks of particle %ld; the deck has %ld", ghost->last + 1,
                              scene->n_particles);
    }
    if (building->until >= scene->n_particles)
        diagnostics_error(reader->diagnostics, building->until_place, "open until: particle %ld does not exist; the deck has %ld",
                          building->until + 1, scene->n_particles);
    if (building->opening != OPENING_NONE && !building->has_ghosts)
        diagnostics_error(reader->diagnostics, building->open_place,
                          "'open' opens nothing: all particles are open; expected 'Ghost' ... 'endG', which closes those that it does not name");
    if (building->opening == OPENING_NONE && building->settling >= 0)
        diagnostics_error(reader->diagnostics, building->settling_place,
                          "'open settle' needs a schedule; expected 'open point', 'open group', 'open layer' or 'open all'");
    if (building->opening == OPENING_NONE && building->until >= 0)
        diagnostics_error(reader->diagnostics, building->until_place,
                          "'open until' needs a schedule; expected 'open point', 'open group', 'open layer' or 'open all'");
}

/* A transformation strain needs a law whose stress is that of the strain rate. */
static void check_strain(struct reader *reader, const struct law *law, const char *word, struct deck_place place)
{
    if (law && (law->needs_eos || !law->rotates))
        diagnostics_error(reader->diagnostics, place, "'%s' does not go with law '%s'; take an elastic or plastic one", word, law->name);
    else if (reader->scene->is_total)
        diagnostics_error(reader->diagnostics, place, "'%s' does not go with 'TLmp'", word);
}

/* What a material's transformation strains can't be combined with. */
static void check_transformation(struct reader *reader, const struct scene_material *entry)
{
    const struct scene *scene = reader->scene;
    const struct scene_transformation *t = &entry->transformation;
    const struct law *law = entry->is_given ? entry->material.law : NULL;
    if (t->has_residual && scene->is_total)
        diagnostics_error(reader->diagnostics, t->residual_place, "'resi' does not go with 'TLmp'");
    if (t->has_phase)
        check_strain(reader, law, "phas", t->phase_place);
    if (t->has_heat)
        check_strain(reader, law, "ther", t->heat_place);
    if (t->has_heat && scene->building.opening != OPENING_POINTS)
        diagnostics_error(reader->diagnostics, t->heat_place,
                          "'ther' heats the place of the particle that opens; expected 'open point' or 'open group'");
}

static void check_scan(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    bool has_residual = false;
    for (size_t i = 0; i < scene->n_materials; i++)
        has_residual = has_residual || scene->materials[i].transformation.has_residual;
    if (scene->building.n_angles > 0 && !has_residual && scene->building.order == SCAN_DECK)
        diagnostics_warning(reader->diagnostics, scene->building.scan_place,
                            "the angles of 'scan' turn nothing: there is no residual stress ('resi') and no 'scan raster'");
    if (scene->building.order == SCAN_RASTER && scene->building.opening != OPENING_POINTS && scene->building.until < 0)
        diagnostics_warning(reader->diagnostics, scene->building.scan_place,
                            "'scan raster' orders nothing: particles do not open by 'open point' or 'open group'");
}

/* Mass scaling changes densities where a law takes them from the mass. */
static void check_mass_scale(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    if (scene->mass_scale == 1)
        return;
    if (scene->is_total)
        diagnostics_error(reader->diagnostics, reader->mass_scale_place, "'mscl' does not go with 'TLmp'");
    for (size_t i = 0; i < scene->n_materials; i++) {
        const struct law *law = scene->materials[i].material.law;
        if (!scene->materials[i].is_given)
            continue;
        for (const enum column *column = law->columns; *column != COLUMN_NONE && !law->needs_eos; column++)
            if (*column == COLUMN_TEMPERATURE)
                diagnostics_error(reader->diagnostics, reader->mass_scale_place,
                                  "'mscl' does not go with law '%s', whose temperature follows the density", law->name);
        if (law->needs_eos)
            diagnostics_error(reader->diagnostics, reader->mass_scale_place,
                              "'mscl' does not go with law '%s', whose pressure follows the density", law->name);
    }
}

/* A box that holds no node: its limits lie between two of them. */
static void check_holds(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    for (size_t i = 0; i < scene->n_holds; i++) {
        const struct scene_hold *hold = &scene->holds[i];
        for (int a = 0; a < 3 && !hold->is_annulus; a++) {
            const double low = scene->grid[2 * a], size = scene->cell_size;
            const double first = fmax(0, ceil((hold->box[2 * a] - low) / size - 1e-6));
            const double last = fmin(floor((scene->grid[2 * a + 1] - low) / size + 0.5), floor((hold->box[2 * a + 1] - low) / size + 1e-6));
            if (first > last) {
                diagnostics_warning(reader->diagnostics, hold->place,
                                    "fixn holds no node: none lies at %c from %g to %g; nodes lie at %g and every %g from there", "xyz"[a],
                                    hold->box[2 * a], hold->box[2 * a + 1], low, size);
                break;
            }
        }
    }
}

/* What follows from densities in the equations of motion; the particles' masses come later. */
static void scale_masses(struct scene *scene)
{
    scene->mass_cutoff *= scene->mass_scale;
    for (size_t i = 0; i < scene->n_materials; i++) {
        scene->materials[i].material.wave_speed /= sqrt(scene->mass_scale);
        scene->materials[i].material.viscous_speed /= sqrt(scene->mass_scale);
    }
}

/* A fixed step beyond the stable one. */
static void check_fixed_step(struct reader *reader)
{
    struct scene *scene = reader->scene;
    double speed = 0;
    for (size_t i = 0; i < scene->n_materials; i++)
        speed = fmax(speed, scene->materials[i].material.wave_speed / sqrt(scene->mass_scale));
    double stable = scene->cell_size / speed, needed = pow(scene->fixed_step / stable, 2) * scene->mass_scale;
    if (scene->fixed_step > stable)
        diagnostics_error(reader->diagnostics, reader->fixed_step_place,
                          "dtfx %g is unstable: a wave crosses a cell in %.4g; take dtfx %.2g, or 'mscl %.3g' or more", scene->fixed_step,
                          stable, 0.5 * stable, 4 * needed);
    else if (scene->fixed_step > 0.9 * stable)
        diagnostics_warning(reader->diagnostics, reader->fixed_step_place,
                            "dtfx %g is close to the time in which a wave crosses a cell, %.4g", scene->fixed_step, stable);
}

void reader_finish_process(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    if (reader->has_bad_part || reader->has_bad_material || diagnostics_errors(reader->diagnostics) > 0)
        return;
    reader_check_ghosts(reader);
    for (size_t i = 0; i < scene->n_materials; i++)
        check_transformation(reader, &scene->materials[i]);
    check_scan(reader);
    check_mass_scale(reader);
    check_holds(reader);
    if (scene->fixed_step > 0 && scene->method == METHOD_MPM)
        check_fixed_step(reader);
    scale_masses(reader->scene);
}
