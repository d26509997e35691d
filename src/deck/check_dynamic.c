/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What only the whole deck shows of the motion of reproducing kernel particles: words that are missing, nodes, the
 * material, curves, pairs that don't go together. */
#include "deck/commands_dynamic.h"
#include "deck/commands_process.h"

#include <math.h>
#include <string.h>

static const size_t MOST_NODES = 10000000;

static bool was_given(const struct reader *reader, const char *name)
{
    return reader->rkpm_places[keyword_in(rkpm_keywords, name) - rkpm_keywords].line > 0;
}

static struct deck_place place_of(const struct reader *reader, const char *name)
{
    return was_given(reader, name) ? reader->rkpm_places[keyword_in(rkpm_keywords, name) - rkpm_keywords] : reader->scene->rkpm.place;
}

/* Words of problems that mean nothing here. */
static void check_words(struct reader *reader)
{
    static const char *const words[] = {"dime", "node", "basi", "kern", "supp", "grad", "prob", "inte", "mode", "star", "spin", "grav", "wall", "stab", NULL};
    for (const struct keyword *row = rkpm_keywords; row->name; row++) {
        bool is_known = false;
        for (int i = 0; words[i]; i++)
            is_known = is_known || strcmp(row->name, words[i]) == 0;
        if (!is_known && was_given(reader, row->name))
            diagnostics_error(reader->diagnostics, place_of(reader, row->name), "'%s' does not go with 'prob dynamic'", row->name);
    }
}

static void check_missing(struct reader *reader)
{
    static const struct {
        const char *name, *expected;
    } rows[] = {{"node", "node disc x y radius spacing"}, {"supp", "supp a"}, {"inte", "inte dni|snni|nsni"}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (!was_given(reader, rows[i].name))
            diagnostics_lack(reader->diagnostics, reader->scene->rkpm.place, "the block 'rkpm' lacks '%s'; expected '%s'", rows[i].name,
                             rows[i].expected);
    if (!reader_was_given(reader, "mate"))
        diagnostics_lack(reader->diagnostics, reader->scene->rkpm.place, "the deck has no material; expected 'nmat 1' and 'mate 1 law ...'");
    if (!reader_was_given(reader, "endt"))
        diagnostics_lack(reader->diagnostics, reader->scene->rkpm.place, "the deck has no end time; expected 'endt time'");
}

static void check_pairs(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    const struct scene_rkpm *rkpm = &scene->rkpm;
    const struct scene_dynamic *dynamic = &rkpm->dynamic;
    if (rkpm->basis != BASIS_LINEAR)
        diagnostics_error(reader->diagnostics, place_of(reader, "basi"), "'prob dynamic' has linear functions; expected 'basi linear'");
    if (was_given(reader, "inte") && rkpm->integration != INTEGRATION_DNI && rkpm->integration != INTEGRATION_SNNI
        && rkpm->integration != INTEGRATION_NSNI)
        diagnostics_error(reader->diagnostics, place_of(reader, "inte"),
                          "'prob dynamic' integrates at nodes that have no cells; expected 'inte dni', 'inte snni' or 'inte nsni'");
    if (was_given(reader, "grad") && rkpm->integration != INTEGRATION_DNI)
        diagnostics_error(reader->diagnostics, place_of(reader, "grad"), "'grad' is of 'inte dni'; snni and nsni have gradients of their own");
    if (was_given(reader, "stab") && rkpm->integration != INTEGRATION_NSNI)
        diagnostics_error(reader->diagnostics, place_of(reader, "stab"), "'stab' needs 'inte nsni'");
    if (rkpm->dimension == 2 && dynamic->velocity[2] != 0)
        diagnostics_error(reader->diagnostics, place_of(reader, "star"), "with 'dime 2' nothing moves along z; expected 'star vx vy'");
    if (rkpm->dimension == 2 && dynamic->gravity[2] != 0)
        diagnostics_error(reader->diagnostics, place_of(reader, "grav"), "with 'dime 2' nothing moves along z; expected 'grav gx gy'");
    if (dynamic->wall != RKPM_WALL_NONE && dynamic->wall_axis >= rkpm->dimension)
        diagnostics_error(reader->diagnostics, dynamic->wall_place, "with 'dime 2' the wall's axis is x or y, not z");
    if (dynamic->wall == RKPM_WALL_NATURAL && dynamic->mode != KERNEL_SEMI)
        diagnostics_error(reader->diagnostics, dynamic->wall_place, "'wall natural' needs 'mode semi': with shape functions of the start no "
                                                                    "contact shows; expected 'wall spring', or 'mode semi'");
    if (scene->n_materials > 0 && scene->materials[0].material.law == &law_powl && scene->fixed_step == 0)
        diagnostics_error(reader->diagnostics, scene->materials[0].place, "the time step that 'powl' allows is not known before; expected 'dtfx step'");
    if (scene->n_materials > 0 && scene->materials[0].material.n_elements > RKPM_STABILISED_ELEMENTS && rkpm->integration == INTEGRATION_NSNI)
        diagnostics_error(reader->diagnostics, scene->materials[0].place, "'inte nsni' takes at most %d elements; expected fewer, or 'inte snni'",
                          RKPM_STABILISED_ELEMENTS);
    if (scene->n_materials > 1)
        diagnostics_error(reader->diagnostics, scene->materials[1].place, "'prob dynamic' has one body of one material; expected 'nmat 1'");
}

/* Nodes, all of them above the wall. */
static void check_nodes(struct reader *reader)
{
    struct scene *scene = reader->scene;
    const struct scene_rkpm *rkpm = &scene->rkpm;
    const struct scene_dynamic *dynamic = &rkpm->dynamic;
    if (!was_given(reader, "node"))
        return;
    if (!dynamic->has_lattice) {
        diagnostics_error(reader->diagnostics, place_of(reader, "node"), "'prob dynamic' moves a disc, a ball or a brick; expected 'node disc x y radius "
                                                                         "spacing', 'node sphere x y z radius spacing' or 'node brick x0 x1 ... spacing'");
        return;
    }
    if (dynamic->lattice.dimension != rkpm->dimension) {
        diagnostics_error(reader->diagnostics, dynamic->lattice_place, "'node %s' needs 'dime %d'",
                          dynamic->lattice.numbers[0] > 0 ? "brick" : dynamic->lattice.dimension == 2 ? "disc" : "sphere",
                          dynamic->lattice.dimension);
        return;
    }
    const size_t count = lattice_count(&dynamic->lattice, MOST_NODES);
    if (count > MOST_NODES)
        diagnostics_error(reader->diagnostics, dynamic->lattice_place, "these are more than %zu nodes; expected a larger spacing", MOST_NODES);
    else if (!(dynamic->lattice.radius >= 2 * dynamic->lattice.spacing))
        diagnostics_error(reader->diagnostics, dynamic->lattice_place, "the radius is %g spacings; expected 2 or more",
                          dynamic->lattice.radius / dynamic->lattice.spacing);
    scene->n_particles = (long)count;
    double farthest = dynamic->lattice.radius;
    for (int a = 0; a < dynamic->lattice.dimension; a++)
        farthest = fmax(farthest, fabs(dynamic->lattice.centre[a]) + dynamic->lattice.radius);
    reader_check_spacing(reader, dynamic->lattice_place, farthest, dynamic->lattice.spacing);
    const double low = lattice_low(&dynamic->lattice, dynamic->wall_axis);
    if (dynamic->wall != RKPM_WALL_NONE && low < dynamic->wall_position)
        diagnostics_error(reader->diagnostics, dynamic->wall_place, "the wall is at %g, and the body begins at %g; expected a body above the wall",
                          dynamic->wall_position, low);
}

/* How many nodes are open at the start; of several words about a node the last one counts. */
static long count_open(const struct scene *scene)
{
    long count = 0;
    for (long id = 0; id < scene->n_particles; id++) {
        bool is_open = false;
        for (size_t i = 0; i < scene->building.n_ghosts; i++)
            if (id >= scene->building.ghosts[i].first && id <= scene->building.ghosts[i].last)
                is_open = scene->building.ghosts[i].is_open;
        count += is_open;
    }
    return count;
}

/* New nodes join those that have moved, which shape functions of the start don't know of. */
static void check_building(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    const struct scene_building *building = &scene->building;
    reader_check_ghosts(reader);
    if (building->settling >= 0)
        diagnostics_error(reader->diagnostics, building->settling_place, "'open settle' does not go with 'prob dynamic'; expected 'endt'");
    if (!building->has_ghosts)
        return;
    const long open = count_open(scene);
    if (open == scene->n_particles && building->opening != OPENING_NONE)
        diagnostics_error(reader->diagnostics, building->open_place, "'open' opens nothing: no node is closed by 'Ghost'");
    if (open == 0 && scene->n_particles > 0)
        diagnostics_error(reader->diagnostics, building->ghost_place, "no node is open at the start; expected 'GPD id1 id2 1' for the first layer");
    if (scene->rkpm.dynamic.mode != KERNEL_SEMI)
        diagnostics_error(reader->diagnostics, building->ghost_place, "nodes that open join those that have moved; expected 'mode semi'");
    if (scene->rkpm.dynamic.wall == RKPM_WALL_NATURAL)
        diagnostics_error(reader->diagnostics, scene->rkpm.dynamic.wall_place, "'wall natural' does not go with 'Ghost'; expected 'wall spring'");
}

static void check_curves(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    for (size_t i = 0; i < scene->n_curves; i++)
        if (scene->curves[i].particle >= scene->n_particles && scene->n_particles > 0)
            diagnostics_error(reader->diagnostics, scene->curves[i].place, "particle %ld does not exist; expected 1 to %ld", scene->curves[i].particle + 1,
                              scene->n_particles);
}

void reader_finish_dynamic(struct reader *reader)
{
    check_words(reader);
    check_missing(reader);
    if (!reader->has_bad_material)
        reader_finish_materials(reader);
    check_pairs(reader);
    check_nodes(reader);
    check_building(reader);
    check_curves(reader);
}
