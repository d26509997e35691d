/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What only the whole deck of smoothed particles shows: words that need others, materials that lack something, bodies
 * that do not fit together. */
#include "base/memory.h"
#include "deck/commands_sph.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Lattices with spacings that differ less than this, relatively, are the same. */
static const double SAME = 1e-6;
/* Walls whose boxes are nearer than this, in spacings, touch: they are one wall. */
static const double TOUCHING = 1.5;
/* More columns of the beam than this would take longer than all else, and more than 2^31 have no number. */
static const double MOST_COLUMNS = 1e6, FARTHEST_COLUMN = 1e12;

/* Where a word of the block stands; where it is not given, that of the block. */
static struct deck_place place_of(const struct reader *reader, const char *name)
{
    const struct deck_place place = reader->sph_places[keyword_in(sph_keywords, name) - sph_keywords];
    if (place.line > 0)
        return place;
    return reader->scene->sph.place.line > 0 ? reader->scene->sph.place : reader->method_place;
}

static bool was_given(const struct reader *reader, const char *name)
{
    return reader->sph_places[keyword_in(sph_keywords, name) - sph_keywords].line > 0;
}

static const struct scene_material *material_of_body(const struct scene *scene, size_t body)
{
    return &scene->materials[scene->bodies[body].generator.material];
}

static bool is_wall(const struct scene *scene, size_t body)
{
    for (size_t i = 0; i < scene->sph.n_walls; i++)
        if ((size_t)scene->sph.walls[i].body == body)
            return true;
    return false;
}

/* Whether a body is of a material; walls count or do not. */
static bool is_used(const struct scene *scene, size_t material, bool by_walls_too)
{
    for (size_t b = 0; b < scene->n_bodies; b++)
        if ((size_t)scene->bodies[b].generator.material == material && (by_walls_too || !is_wall(scene, b)))
            return true;
    return false;
}

static bool something_melts(const struct scene *scene)
{
    for (size_t i = 0; i < scene->n_materials; i++)
        if (scene->materials[i].properties.melts && is_used(scene, i, false))
            return true;
    return false;
}

/* --- words that need others --- */

static void check_needs_heat(struct reader *reader)
{
    const struct scene_sph *sph = &reader->scene->sph;
    const struct {
        const char *name;
        bool is_used;
    } users[] = {{"radi", sph->radiates},        {"evap", sph->evaporates},   {"powe", sph->volume_heat != 0},
                 {"vhea", sph->heats_by_viscosity}, {"latc", sph->corrects_lattice}, {"beam", sph->beam.is_on}};
    if (sph->heat != HEAT_OFF)
        return;
    for (size_t i = 0; i < sizeof users / sizeof users[0]; i++)
        if (users[i].is_used)
            diagnostics_error(reader->diagnostics, place_of(reader, users[i].name), "'%s' needs heat; expected 'heat enth'", users[i].name);
    for (size_t i = 0; i < sph->n_walls; i++)
        if (sph->walls[i].heat == WALL_TEMPERATURE)
            diagnostics_error(reader->diagnostics, sph->walls[i].place, "'wall ... temp' needs heat; expected 'heat enth'");
}

static void check_needs_melting(struct reader *reader)
{
    const struct scene_sph *sph = &reader->scene->sph;
    const struct {
        const char *name;
        bool is_used;
    } users[] = {{"mref", was_given(reader, "mref") && sph->mass == MASS_AT_SOLIDUS}, {"rela", sph->relaxes_excess},
                 {"mcfa", sph->melt_sound_factor != 1}, {"mush", sph->mush_drag > 0}};
    for (size_t i = 0; i < sizeof users / sizeof users[0]; i++)
        if (users[i].is_used && !something_melts(reader->scene))
            diagnostics_error(reader->diagnostics, place_of(reader, users[i].name),
                              "'%s' needs a body that melts; expected 'prop material melt solidus liquidus latent'", users[i].name);
}

static void check_evaporation(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    bool boils = false;
    for (size_t i = 0; i < scene->n_materials; i++)
        boils = boils || (scene->materials[i].properties.boils && is_used(scene, i, false));
    if (scene->sph.evaporates && !boils)
        diagnostics_error(reader->diagnostics, place_of(reader, "evap"),
                          "'evap' needs a body that boils; expected 'prop material boil Tb heat molar'");
}

static void check_numbers(struct reader *reader)
{
    const struct scene_sph *sph = &reader->scene->sph;
    if (sph->wide_smoothing < sph->smoothing)
        diagnostics_error(reader->diagnostics, place_of(reader, was_given(reader, "hsra") ? "hsra" : "hrat"),
                          "the wide smoothing, hsra %g, is below hrat %g; expected %g or more", sph->wide_smoothing, sph->smoothing,
                          fmax(1.8, sph->smoothing));
}

/* Results that only some scenes have. */
static void check_results(struct reader *reader)
{
    const struct scene_sph *sph = &reader->scene->sph;
    const bool has_heat = sph->heat != HEAT_OFF, melts = has_heat && something_melts(reader->scene);
    const bool has_surface = sph->surface != SURFACE_OFF || sph->has_marangoni || sph->radiates || sph->evaporates;
    const struct {
        const char *name, *needed;
        bool is_there;
    } rows[] = {{"enth", "'heat enth'", has_heat},     {"heat", "'heat enth'", has_heat},    {"thru", "'heat enth'", has_heat},
                {"wflu", "'heat enth'", has_heat},
                {"vish", "'vhea on'", sph->heats_by_viscosity}, {"powh", "'powe'", sph->volume_heat != 0},
                {"kapp", "'csf bala'", has_surface},   {"lasr", "'beam'", sph->beam.is_on},  {"lasi", "'beam'", sph->beam.is_on},
                {"absb", "'beam'", sph->beam.is_on},   {"refl", "'beam'", sph->beam.is_on},  {"tran", "'beam'", sph->beam.is_on},
                {"radi", "'radi'", sph->radiates},     {"evap", "'evap'", sph->evaporates},
                {"pool", "something that melts", melts},
                {"poow", "something that melts", melts}, {"pood", "something that melts", melts}};
    for (size_t i = 0; i < reader->n_uses; i++)
        for (size_t r = 0; r < sizeof rows / sizeof rows[0]; r++)
            if (*reader->uses[i].kind && strcmp(reader->uses[i].name, rows[r].name) == 0 && !rows[r].is_there)
                diagnostics_error(reader->diagnostics, reader->uses[i].place, "result '%s' needs %s", rows[r].name, rows[r].needed);
}

/* --- bodies that words speak of --- */

/* Reports a body that does not exist, or that a word of this name was given for before. */
static void check_body(struct reader *reader, const char *name, long body, struct deck_place place, bool is_again)
{
    const long count = (long)reader->scene->n_bodies;
    if (body >= count && count > 0)
        diagnostics_error(reader->diagnostics, place, "%s: body %ld does not exist; expected 1 to %ld", name, body + 1, count);
    else if (is_again)
        diagnostics_error(reader->diagnostics, place, "%s of body %ld was given before", name, body + 1);
}

/* Rows of lists begin with the body, and none is for a body that has one. */
#define CHECK_BODIES(reader, name, rows, count) \
    for (size_t i = 0; i < (count); i++) { \
        bool is_again = false; \
        for (size_t k = 0; k < i; k++) \
            is_again = is_again || (rows)[k].body == (rows)[i].body; \
        check_body(reader, name, (rows)[i].body, (rows)[i].place, is_again); \
    }

static void check_bodies(struct reader *reader)
{
    const struct scene_sph *sph = &reader->scene->sph;
    CHECK_BODIES(reader, "wall", sph->walls, sph->n_walls)
    CHECK_BODIES(reader, "temp", sph->temperatures, sph->n_temperatures)
    CHECK_BODIES(reader, "swel", sph->swellings, sph->n_swellings)
    CHECK_BODIES(reader, "stre", sph->stretches, sph->n_stretches)
}

/* --- materials --- */

/* A property that does not follow the temperature, as the law has it. */
static void fill_table(struct property_table *table, double value)
{
    size_t capacity = 0;
    table->temperatures = memory_grow(table->temperatures, &capacity, 1, sizeof(double), "properties");
    table->values = memory_grow(table->values, &table->capacity, 1, sizeof(double), "properties");
    table->temperatures[0] = PROPERTIES_ZERO;
    table->values[0] = value;
    table->count = 1;
}

/* What heat needs of a material. Through walls it flows by the conductivity of what is beside them. */
static void check_heat_properties(struct reader *reader, size_t material)
{
    static const struct {
        enum property property;
        bool of_walls;
        const char *expected;
    } needed[] = {{PROPERTY_CAPACITY, true, "capa n T1 c1 ...'"}, {PROPERTY_CONDUCTIVITY, false, "cond n T1 k1 ...', with 0 where none is meant"}};
    const struct scene *scene = reader->scene;
    const struct scene_material *entry = &scene->materials[material];
    const long number = (long)material + 1;
    for (size_t i = 0; i < sizeof needed / sizeof needed[0]; i++)
        if (entry->properties.tables[needed[i].property].count == 0 && is_used(scene, material, needed[i].of_walls))
            diagnostics_lack(reader->diagnostics, entry->place, "material %ld lacks its %s, which 'heat' needs; expected 'prop %ld %s", number,
                             property_row(needed[i].property)->doc, number, needed[i].expected);
}

/* What a material lacks that the surface or the beam needs; those of walls need nothing. */
static void check_surface_properties(struct reader *reader, size_t material)
{
    const struct scene *scene = reader->scene;
    const struct properties *properties = &scene->materials[material].properties;
    const long number = (long)material + 1;
    const bool has_surface = properties->surface.is_given || properties->tables[PROPERTY_SURFACE_TENSION].count > 0;
    const char *user = scene->sph.has_marangoni ? "mara" : scene->sph.surface != SURFACE_OFF ? "csf" : NULL;
    if (!is_used(scene, material, false))
        return;
    if (user && !has_surface)
        diagnostics_error(reader->diagnostics, place_of(reader, user),
                          "'%s' needs the surface tension of material %ld; expected 'prop %ld surf n T1 s1 ...' or 'prop %ld sahu ...'", user,
                          number, number, number);
    if (scene->sph.beam.is_on && scene->sph.beam.absorptivity == 0 && properties->tables[PROPERTY_ABSORPTIVITY].count == 0)
        diagnostics_error(reader->diagnostics, scene->sph.beam.place,
                          "the absorptivity of 'beam' is 0, that of the material, and material %ld has none; expected 'prop %ld abso n T1 a1 ...'",
                          number, number);
}

/* The place of the property that a message of properties_prepare names in brackets. */
static struct deck_place place_of_fault(const struct scene_material *entry, const char *message)
{
    const char *bracket = strchr(message, '(');
    for (int i = 0; i < PROPERTY_COUNT && bracket; i++)
        if (strncmp(bracket + 1, property_row((enum property)i)->name, 4) == 0 && entry->property_places[i].line > 0)
            return entry->property_places[i];
    return entry->melting_place.line > 0 ? entry->melting_place : entry->place;
}

static void prepare_material(struct reader *reader, struct scene_material *entry)
{
    struct property_table *tables = entry->properties.tables;
    if (tables[PROPERTY_DENSITY].count == 0)
        fill_table(&tables[PROPERTY_DENSITY], entry->material.density);
    if (tables[PROPERTY_VISCOSITY].count == 0)
        fill_table(&tables[PROPERTY_VISCOSITY], entry->material.viscosity);
    if (entry->properties.surface.is_given && tables[PROPERTY_SURFACE_TENSION].count > 0)
        diagnostics_error(reader->diagnostics, entry->surface_place, "'prop sahu' and 'prop surf' both give the surface tension; expected one of them");
    const char *wrong = tables[PROPERTY_CAPACITY].count > 0 ? properties_prepare(&entry->properties) : NULL;
    if (wrong)
        diagnostics_error(reader->diagnostics, place_of_fault(entry, wrong), "%s", wrong);
}

/* --- where particles are --- */

struct box {
    double low[3], high[3];
};

/* A visit to the points of a body; also looks for those of curx. */
struct visit {
    struct scene *scene;
    struct box *box;
    double *nearest; /* distance by curve */
    long id;
};

static void visit_point(void *context, const double position[3], double mass)
{
    struct visit *visit = context;
    (void)mass;
    for (int a = 0; a < 3; a++) {
        visit->box->low[a] = fmin(visit->box->low[a], position[a]);
        visit->box->high[a] = fmax(visit->box->high[a], position[a]);
    }
    for (size_t i = 0; i < visit->scene->n_curves; i++) {
        struct scene_curve *curve = &visit->scene->curves[i];
        const double distance = hypot(hypot(position[0] - curve->point[0], position[1] - curve->point[1]), position[2] - curve->point[2]);
        if (!curve->is_near || distance >= visit->nearest[i])
            continue;
        visit->nearest[i] = distance;
        curve->particle = visit->id;
    }
    visit->id++;
}

/* The boxes of all bodies, and the particles of curx. */
static void visit_bodies(struct reader *reader, struct box *boxes, double spacing)
{
    struct scene *scene = reader->scene;
    struct visit visit = {.scene = scene, .nearest = memory_array(scene->n_curves, sizeof(double), "curx")};
    for (size_t i = 0; i < scene->n_curves; i++)
        visit.nearest[i] = DBL_MAX;
    for (size_t b = 0; b < scene->n_bodies; b++) {
        boxes[b] = (struct box){{DBL_MAX, DBL_MAX, DBL_MAX}, {-DBL_MAX, -DBL_MAX, -DBL_MAX}};
        visit.box = &boxes[b];
        scene->bodies[b].generator.row->visit(&scene->bodies[b].generator, visit_point, &visit);
    }
    for (size_t i = 0; i < scene->n_curves; i++)
        if (scene->curves[i].is_near && !(visit.nearest[i] <= 0.5 * spacing))
            diagnostics_error(reader->diagnostics, scene->curves[i].place, "no particle within half a spacing of (%g, %g, %g)",
                              scene->curves[i].point[0], scene->curves[i].point[1], scene->curves[i].point[2]);
    memory_free(visit.nearest);
}

/* Spacing of a body's particles: volumes follow from masses and the density of the law. */
static double spacing_of(const struct scene *scene, size_t body)
{
    const struct generator *generator = &scene->bodies[body].generator;
    if (generator->row->arguments)
        return generator->spacing;
    return generator->n_points > 0 ? cbrt(generator->points[0].mass / material_of_body(scene, body)->material.density) : 0;
}

/* One spacing for all; returns it. */
static double check_spacings(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    double spacing = 0;
    for (size_t b = 0; b < scene->n_bodies; b++) {
        const struct scene_body *body = &scene->bodies[b];
        const double own = spacing_of(scene, b), density = material_of_body(scene, b)->material.density;
        if (body->count == 0)
            continue;
        if (body->generator.row->arguments && fabs(body->generator.density / density - 1) > SAME)
            diagnostics_error(reader->diagnostics, body->place, "the density of this body is %g, that of its material %g; expected the same",
                              body->generator.density, density);
        if (spacing > 0 && fabs(own / spacing - 1) > SAME)
            diagnostics_error(reader->diagnostics, body->place, "the spacing of this body is %g, that of those before it %g; expected one spacing",
                              own, spacing);
        spacing = spacing > 0 ? spacing : own;
    }
    return spacing;
}

static double distance_of(const struct box *one, const struct box *other)
{
    double square = 0;
    for (int a = 0; a < 3; a++) {
        const double gap = fmax(0, fmax(other->low[a] - one->high[a], one->low[a] - other->high[a]));
        square += gap * gap;
    }
    return sqrt(square);
}

/* Walls that face each other through a gap in which every particle feels both. */
static void check_gaps(struct reader *reader, const struct box *boxes, double spacing)
{
    const struct scene_sph *sph = &reader->scene->sph;
    const double support = 2 * sph->smoothing * spacing;
    for (size_t i = 0; i < sph->n_walls; i++)
        for (size_t k = 0; k < i; k++) {
            const double distance = distance_of(&boxes[sph->walls[i].body], &boxes[sph->walls[k].body]);
            if (distance > TOUCHING * spacing && distance < support)
                diagnostics_error(reader->diagnostics, sph->walls[i].place,
                                  "the walls of bodies %ld and %ld are %.4g apart, less than what the kernel reaches, 2 hrat spacings, %.4g; "
                                  "take a smaller spacing",
                                  sph->walls[k].body + 1, sph->walls[i].body + 1, distance, support);
        }
}

static void check_plane(struct reader *reader, const struct box *boxes, double spacing)
{
    const struct scene *scene = reader->scene;
    const struct box *first = NULL;
    for (size_t b = 0; b < scene->n_bodies && scene->sph.dimension == 2; b++) {
        if (scene->bodies[b].count == 0)
            continue;
        first = first ? first : &boxes[b];
        const double off = fmax(fabs(boxes[b].low[2] - first->low[2]), fabs(boxes[b].high[2] - first->low[2]));
        if (off > SAME * spacing)
            diagnostics_error(reader->diagnostics, scene->bodies[b].place,
                              "with 'dime 2' all particles lie in one plane of z; this body is from %g to %g, and others at %g", boxes[b].low[2],
                              boxes[b].high[2], first->low[2]);
    }
}

/* --- the beam --- */

/* Pieces come in the order of time; later ones may lie behind endt, as a restart may have another. */
static void check_path_times(struct reader *reader)
{
    const struct scene_beam *beam = &reader->scene->sph.beam;
    const double end = reader->scene->end_time;
    for (size_t i = 0; i < beam->n_pieces; i++)
        if (beam->pieces[i].times[1] <= 0)
            diagnostics_error(reader->diagnostics, beam->pieces[i].place, "path ends at %g, and the run begins at 0; expected a later end",
                              beam->pieces[i].times[1]);
    if (beam->n_pieces > 0 && beam->pieces[0].times[0] > end)
        diagnostics_error(reader->diagnostics, beam->pieces[0].place,
                          "'beam' is never on: path begins at %g, and the run ends at %g; expected an earlier path, or a later 'endt'",
                          beam->pieces[0].times[0], end);
}

static void check_path_extents(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    const struct scene_beam *beam = &scene->sph.beam;
    for (size_t i = 0; i < beam->n_pieces; i++)
        for (int a = 0; a < (int)scene->sph.dimension - 1; a++) {
            const double low = fmin(beam->pieces[i].from[a], beam->pieces[i].to[a]), high = fmax(beam->pieces[i].from[a], beam->pieces[i].to[a]);
            if (reader->span_place[a].line == 0 || (low >= scene->grid[2 * a] && high <= scene->grid[2 * a + 1]))
                continue;
            diagnostics_error(reader->diagnostics, beam->pieces[i].place,
                              "path goes along %c from %g to %g; the grid is from %g to %g; expected a path inside, or a larger grid", "xyz"[a],
                              low, high, scene->grid[2 * a], scene->grid[2 * a + 1]);
            break;
        }
}

static void check_beam(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    const struct scene_beam *beam = &scene->sph.beam;
    if (beam->n_pieces > 0 && !beam->is_on)
        diagnostics_error(reader->diagnostics, beam->pieces[0].place, "'path' needs a beam; expected 'beam power radius absorptivity'");
    if (!beam->is_on)
        return;
    if (beam->n_pieces == 0)
        diagnostics_error(reader->diagnostics, beam->place, "'beam' is never on; expected 'path t0 t1 x0 y0 z0 x1 y1 z1'");
    if (beam->reading == BEAM_LINE && scene->sph.dimension == 3)
        diagnostics_error(reader->diagnostics, beam->place, "'beam ... line' is of two dimensions; expected 'dime 2', or no 'line'");
    check_path_times(reader);
    check_path_extents(reader);
}

/* The beam's columns are as wide as its cells; there is a number for each, and for how far it is from 0. */
static void check_columns(struct reader *reader, double spacing)
{
    const struct scene *scene = reader->scene;
    const struct scene_beam *beam = &scene->sph.beam;
    const int lateral = (int)scene->sph.dimension - 1;
    if (!beam->is_on || !(spacing > 0))
        return;
    const double cell = (beam->bin > 0 ? beam->bin : 1) * spacing, columns = pow(6 * beam->radius / cell + 2, lateral);
    if (columns > MOST_COLUMNS)
        diagnostics_error(reader->diagnostics, beam->place,
                          "the beam is 6 radii wide, %.3g columns of %.3g; expected at most %.0e: a smaller radius, or larger bins", columns, cell,
                          MOST_COLUMNS);
    for (size_t i = 0; i < beam->n_pieces; i++)
        for (int a = 0; a < lateral; a++)
            if (fmax(fabs(beam->pieces[i].from[a]), fabs(beam->pieces[i].to[a])) > FARTHEST_COLUMN * cell)
                diagnostics_error(reader->diagnostics, beam->pieces[i].place, "path is more than %.0e columns of %.3g away from 0 along %c",
                                  FARTHEST_COLUMN, cell, "xyz"[a]);
}

void reader_finish_sph(struct reader *reader)
{
    struct scene *scene = reader->scene;
    if (reader->has_bad_part || reader->has_bad_material || reader->has_bad_sph)
        return;
    check_numbers(reader);
    check_bodies(reader);
    check_needs_heat(reader);
    check_beam(reader);
    if (diagnostics_errors(reader->diagnostics) > 0)
        return;
    if (!was_given(reader, "mref") && something_melts(scene))
        scene->sph.mass = MASS_AT_SOLIDUS;
    check_needs_melting(reader);
    check_evaporation(reader);
    check_results(reader);
    for (size_t i = 0; i < scene->n_materials; i++) {
        prepare_material(reader, &scene->materials[i]);
        if (scene->sph.heat != HEAT_OFF)
            check_heat_properties(reader, i);
        check_surface_properties(reader, i);
    }
    const double spacing = check_spacings(reader);
    struct box *boxes = memory_array(scene->n_bodies, sizeof *boxes, "bodies");
    visit_bodies(reader, boxes, spacing);
    check_gaps(reader, boxes, spacing);
    check_plane(reader, boxes, spacing);
    check_columns(reader, spacing);
    memory_free(boxes);
}
