/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What only the whole block of rkpm shows: words that are missing or need others, nodes, supports. */
#include "base/memory.h"
#include "deck/commands_dynamic.h"
#include "deck/commands_rkpm.h"

#include <limits.h>
#include <math.h>
#include <string.h>

static const double MOST_NODES = 1e7, LARGEST_SUPPORT = 20;
/* Above this, times the spacing, the trace between boundary nodes is held more than it can follow (spec 4). */
static const double LARGEST_BETA = 1e3;
/* Young's modulus over that of strain along one axis below which linear functions lock: Poisson's ratio 0.483. */
static const double LOCKING_YOUNG = 0.1;
/* Times the spacing, and of elastic with the modulus of strain along one axis for that of Young: below the first a penalty hardly
 * holds; below the second Nitsche's method has a negative system, for where only the outermost nodes move the gradient is at least
 * the value over the spacing. */
static const double SMALLEST_PENALTY = 10, SMALLEST_NITSCHE = 1, GOOD_BETA = 100;
/* Farther from the origin, in spacings, rounding moves nodes; beyond these spacings their squares are no numbers. */
static const double FARTHEST = 1e9, SMALLEST_SPACING = 1e-60, LARGEST_SPACING = 1e60;
/* Values and gradients are kept at all points of integration: 30 bytes or so for each of their neighbours. */
static const double MOST_PAIRS = 4e9, MOST_ENTRIES = 8e9; /* 8 bytes each of a matrix that is factored */
static const double LARGEST_JITTER = 0.45, MOST_STEPS = 1e7;

static bool was_given(const struct reader *reader, const char *name)
{
    return reader->rkpm_places[keyword_in(rkpm_keywords, name) - rkpm_keywords].line > 0;
}

static struct deck_place place_of(const struct reader *reader, const char *name)
{
    return was_given(reader, name) ? reader->rkpm_places[keyword_in(rkpm_keywords, name) - rkpm_keywords] : reader->scene->rkpm.place;
}

/* Words that every problem has. */
static bool check_missing(struct reader *reader)
{
    static const struct {
        const char *name, *expected;
    } rows[] = {{"node", "node box x0 x1 ... nx ..."}, {"supp", "supp a"}, {"prob", "prob approx|helmholtz|poisson|elastic|creep|dynamic"},
                {"func", "func sine|expo|wave|line|patch|beam|load"}};
    bool good = true;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        if (was_given(reader, rows[i].name))
            continue;
        diagnostics_lack(reader->diagnostics, reader->scene->rkpm.place, "the block 'rkpm' lacks '%s'; expected '%s'", rows[i].name,
                         rows[i].expected);
        good = false;
    }
    return good;
}

/* Words that mean nothing to the problem. */
static void check_needs(struct reader *reader)
{
    const struct scene_rkpm *rkpm = &reader->scene->rkpm;
    const bool is_solved = rkpm->problem != PROBLEM_APPROXIMATION, is_creep = rkpm->problem == PROBLEM_CREEP;
    const bool is_elastic = scene_rkpm_has_body(rkpm), has_norms = !is_creep;
    const bool is_gauss = rkpm->integration == INTEGRATION_GAUSS;
    const bool has_beta = rkpm->constraint == CONSTRAINT_PENALTY || rkpm->constraint == CONSTRAINT_NITSCHE;
    const struct {
        const char *name, *needed;
        bool is_there;
    } rows[] = {{"gaus", "'inte gauss' and 'prob helmholtz', 'prob poisson', 'prob elastic' or 'prob creep'", is_solved && is_gauss},
                {"cons", "'prob helmholtz', 'prob poisson', 'prob elastic' or 'prob creep'", is_solved},
                {"grad", "'inte gauss' or 'inte dni', other rules have gradients of their own; leave it out", is_gauss || rkpm->integration == INTEGRATION_DNI || rkpm->gradient == GRADIENT_DIRECT},
                {"gbou", "'inte gauss' and 'cons lagr', 'cons pena' or 'cons nits', or 'prob elastic'",
                 is_solved && is_gauss && (is_elastic || rkpm->constraint != CONSTRAINT_TRANSFORMATION)},
                {"modu", "'prob elastic' or 'prob creep'", is_elastic},
                {"plan", "'prob elastic' or 'prob creep', and 'dime 2'", is_elastic && rkpm->dimension == 2},
                {"forc", "'func beam' or 'func load'", rkpm->function == FUNCTION_BEAM || rkpm->function == FUNCTION_LOAD},
                {"elem", "'prob creep'", is_creep},
                {"rule", "'prob creep'", is_creep},
                {"vrel", "'prob creep'", is_creep},
                {"span", "'prob creep'", is_creep},
                {"from", "'prob creep'", is_creep},
                {"weig", "'prob creep'", is_creep},
                {"refi", "one body after another; leave it out with 'prob creep'", has_norms},
                {"gnor", "norms of an error, which 'prob creep' has not; leave it out", has_norms},
                {"held", "'prob elastic' or 'prob creep'", is_elastic},
                {"inte", "'prob elastic' or 'prob creep'", is_elastic},
                {"vci", "'prob elastic'", is_elastic && !is_creep},
                {"pert", "'prob approx' or 'prob elastic'", is_elastic || !is_solved},
                {"beta", "'cons pena' or 'cons nits'", is_solved && has_beta},
                {"wave", "'prob helmholtz' or 'func wave'", rkpm->problem == PROBLEM_HELMHOLTZ || rkpm->function == FUNCTION_WAVE}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const bool is_wave = strcmp(rows[i].name, "wave") == 0;
        if (was_given(reader, rows[i].name) && !rows[i].is_there)
            diagnostics_error(reader->diagnostics, place_of(reader, rows[i].name), "'%s' needs %s", rows[i].name, rows[i].needed);
        else if (is_wave && rows[i].is_there && !was_given(reader, "wave"))
            diagnostics_error(reader->diagnostics, place_of(reader, rkpm->function == FUNCTION_WAVE ? "func" : "prob"),
                              "the wave number is not given; expected 'wave k'");
    }
}

/* Words of motion in time. */
static void check_dynamic_words(struct reader *reader)
{
    static const char *const words[] = {"mode", "star", "spin", "grav", "wall", "stab", NULL};
    const struct scene_rkpm *rkpm = &reader->scene->rkpm;
    for (int i = 0; words[i]; i++)
        if (was_given(reader, words[i]))
            diagnostics_error(reader->diagnostics, place_of(reader, words[i]), "'%s' needs 'prob dynamic'", words[i]);
    if (rkpm->dynamic.has_lattice)
        diagnostics_error(reader->diagnostics, place_of(reader, "node"), "'node %s' needs 'prob dynamic'; expected 'node box'",
                          rkpm->dynamic.lattice.numbers[0] > 0 ? "brick" : rkpm->dynamic.lattice.dimension == 2 ? "disc" : "sphere");
}

/* Functions are scalars or displacements; beams lie in a plane. */
static void check_function(struct reader *reader)
{
    const struct scene_rkpm *rkpm = &reader->scene->rkpm;
    const bool is_creep = rkpm->problem == PROBLEM_CREEP, is_load = rkpm->function == FUNCTION_LOAD;
    const bool is_elastic = rkpm->problem == PROBLEM_ELASTIC, is_displacement = rkpm->function == FUNCTION_PATCH || rkpm->function == FUNCTION_BEAM;
    if (is_creep != is_load)
        diagnostics_error(reader->diagnostics, place_of(reader, "func"), is_creep ? "'prob creep' needs a load; expected 'func load'"
                                                                                  : "'func load' needs 'prob creep'");
    if (is_creep || is_load)
        return;
    if (is_elastic != is_displacement)
        diagnostics_error(reader->diagnostics, place_of(reader, "func"), is_elastic ? "'prob elastic' needs displacements; expected patch or beam"
                                                                                    : "patch and beam are displacements, which need 'prob elastic'");
    if (rkpm->function == FUNCTION_BEAM && rkpm->dimension != 2)
        diagnostics_error(reader->diagnostics, place_of(reader, "func"), "'func beam' needs 'dime 2'");
}

/* Words that a problem or function can't do without. */
static void check_needed(struct reader *reader)
{
    const struct scene_rkpm *rkpm = &reader->scene->rkpm;
    const bool is_creep = rkpm->problem == PROBLEM_CREEP, has_load = rkpm->function == FUNCTION_BEAM || rkpm->function == FUNCTION_LOAD;
    const struct {
        const char *name, *owner, *message;
        bool is_needed;
    } rows[] = {{"forc", "func", "the load is not given; expected 'forc p'", has_load && !was_given(reader, "weig")},
                {"modu", "prob", "the moduli are not given; expected 'modu young poisson'", is_creep || rkpm->problem == PROBLEM_ELASTIC},
                {"elem", "prob", "without elements nothing relaxes; expected 'elem young time', or 'prob elastic'", is_creep},
                {"span", "prob", "the end is not given; expected 'span end step'", is_creep},
                {"from", "prob", "there is never a load; expected 'from time factor'", is_creep},
                {"held", "prob", "the body is not held; expected 'held' and sides", is_creep}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (rows[i].is_needed && !was_given(reader, rows[i].name))
            diagnostics_error(reader->diagnostics, place_of(reader, rows[i].owner), "%s", rows[i].message);
}

/* Loads follow each other, up to the end; the body has a side to bear them, and boundary terms do not relax. */
static void check_creep(struct reader *reader)
{
    const struct scene_rkpm *rkpm = &reader->scene->rkpm;
    if (rkpm->problem != PROBLEM_CREEP)
        return;
    for (int i = 0; i < rkpm->n_loads; i++)
        if (i > 0 && !(rkpm->loads[i][0] > rkpm->loads[i - 1][0]))
            diagnostics_error(reader->diagnostics, rkpm->load_places[i], "the load changes at %g after it has at %g; expected the order of time",
                              rkpm->loads[i][0], rkpm->loads[i - 1][0]);
        else if (was_given(reader, "span") && rkpm->loads[i][0] > rkpm->end_time)
            diagnostics_error(reader->diagnostics, rkpm->load_places[i], "the load changes at %g, after the end at %g", rkpm->loads[i][0], rkpm->end_time);
    if (rkpm->constraint == CONSTRAINT_PENALTY || rkpm->constraint == CONSTRAINT_NITSCHE)
        diagnostics_error(reader->diagnostics, place_of(reader, "cons"), "terms at the boundary don't relax; with 'prob creep' expected 'cons tran' or 'cons lagr'");
    if (rkpm->held[1])
        diagnostics_error(reader->diagnostics, place_of(reader, "held"), "the load is on side x1, which can't be held");
    if (rkpm->dimension == 1)
        diagnostics_error(reader->diagnostics, place_of(reader, "prob"), "'prob creep' needs 'dime 2' or 'dime 3'");
    if (was_given(reader, "span") && rkpm->end_time / rkpm->time_step > MOST_STEPS)
        diagnostics_error(reader->diagnostics, place_of(reader, "span"), "these are %g steps; expected at most %g", rkpm->end_time / rkpm->time_step, MOST_STEPS);
}

/* Nodal rules are linear; cells of nodes off the lattice are made in a plane. */
static void check_integration(struct reader *reader)
{
    const struct scene_rkpm *rkpm = &reader->scene->rkpm;
    const bool is_gauss = rkpm->integration == INTEGRATION_GAUSS;
    if (!is_gauss && rkpm->basis != BASIS_LINEAR)
        diagnostics_error(reader->diagnostics, place_of(reader, "inte"), "integration at nodes is linear; expected 'basi linear', or 'inte gauss'");
    if (rkpm->integration == INTEGRATION_MSCNI && rkpm->dimension != 2)
        diagnostics_error(reader->diagnostics, place_of(reader, "inte"), "'inte mscni' needs 'dime 2'; expected nsci");
    if (!is_gauss && rkpm->jitter[0] > 0 && rkpm->dimension != 2)
        diagnostics_error(reader->diagnostics, place_of(reader, "pert"), "cells around nodes off the lattice need 'dime 2'; expected 'inte gauss', or no 'pert'");
    if (rkpm->jitter[0] > LARGEST_JITTER)
        diagnostics_error(reader->diagnostics, place_of(reader, "pert"), "nodes moved by up to %g spacings can meet; expected at most %g",
                          rkpm->jitter[0], LARGEST_JITTER);
}

/* Without a held side, or with one that the box lacks, the body floats. */
static void check_held(struct reader *reader)
{
    struct scene_rkpm *rkpm = &reader->scene->rkpm;
    for (int side = 0; side < 6; side++) {
        if (!was_given(reader, "held"))
            rkpm->held[side] = side < 2 * rkpm->dimension;
        else if (rkpm->held[side] && side >= 2 * rkpm->dimension)
            diagnostics_error(reader->diagnostics, place_of(reader, "held"), "the box has no side along %c; 'dime' is %ld", "xyz"[side / 2], rkpm->dimension);
    }
}

/* --- nodes --- */

bool reader_check_spacing(struct reader *reader, struct deck_place place, double farthest, double spacing)
{
    if (!(spacing >= SMALLEST_SPACING && spacing <= LARGEST_SPACING))
        diagnostics_error(reader->diagnostics, place, "the spacing is %g; expected %g to %g, in other units", spacing, SMALLEST_SPACING, LARGEST_SPACING);
    else if (farthest > FARTHEST * spacing)
        diagnostics_error(reader->diagnostics, place, "nodes are %g spacings from the origin, where rounding moves them; expected at most %g",
                          farthest / spacing, FARTHEST);
    else
        return true;
    return false;
}

/* Extents and numbers of the box, as many as dimensions; false after an error. */
static bool check_box(struct reader *reader)
{
    static const char *const expected[] = {"", "x0 x1 nx", "x0 x1 y0 y1 nx ny", "x0 x1 y0 y1 z0 z1 nx ny nz"};
    struct scene_rkpm *rkpm = &reader->scene->rkpm;
    const int axes = (int)rkpm->dimension;
    if (rkpm->n_box != 3 * axes) {
        diagnostics_error(reader->diagnostics, place_of(reader, "node"), "'node box' has %d numbers; with 'dime %d' expected %s", rkpm->n_box,
                          axes, expected[axes]);
        return false;
    }
    bool good = true;
    for (int a = 0; a < axes; a++) {
        const double low = rkpm->box_read[2 * a], high = rkpm->box_read[2 * a + 1], number = rkpm->box_read[2 * axes + a];
        if (!(high > low) || !isfinite(high - low)) {
            diagnostics_error(reader->diagnostics, rkpm->box_places[2 * a + 1], "the box ends at %g along %c, but begins at %g", high, "xyz"[a], low);
            good = false;
        }
        if (!(number >= 2 && number <= MOST_NODES && number == floor(number))) {
            diagnostics_error(reader->diagnostics, rkpm->box_places[2 * axes + a], "the number of nodes along %c must be a whole one from 2 to %g, not %g",
                              "xyz"[a], MOST_NODES, number);
            good = false;
        }
        if (good && !reader_check_spacing(reader, rkpm->box_places[2 * a], fmax(fabs(low), fabs(high)), (high - low) / (number - 1)))
            good = false;
        rkpm->box[2 * a] = low;
        rkpm->box[2 * a + 1] = high;
        rkpm->numbers[a] = good ? (long)number : 2;
    }
    return good;
}

/* A basis of degree n needs n + 1 nodes along each axis, and there is a limit for all. */
static void check_numbers(struct reader *reader, const long numbers[3], struct deck_place place)
{
    const struct scene_rkpm *rkpm = &reader->scene->rkpm;
    const long least = rkpm->basis == BASIS_QUADRATIC ? 3 : 2;
    double nodes = 1;
    for (int a = 0; a < rkpm->dimension; a++) {
        nodes *= (double)numbers[a];
        if (numbers[a] < least)
            diagnostics_error(reader->diagnostics, place, "%ld nodes along %c are too few for the basis; expected %ld or more", numbers[a], "xyz"[a],
                              least);
    }
    if (nodes > MOST_NODES)
        diagnostics_error(reader->diagnostics, place, "these are %g nodes; expected at most %g", nodes, MOST_NODES);
}

/* Numbers of nodes with so many along x; false where the other axes get no whole number of cells. */
static bool refine(const struct scene_rkpm *rkpm, long along_x, long numbers[3])
{
    for (int a = 0; a < rkpm->dimension; a++) {
        const double cells = (double)(along_x - 1) * (double)(rkpm->numbers[a] - 1) / (double)(rkpm->numbers[0] - 1);
        if (cells < 1 || cells > MOST_NODES || fabs(cells - floor(cells + 0.5)) > 1e-9 * cells)
            return false;
        numbers[a] = (long)floor(cells + 0.5) + 1;
    }
    return true;
}

static void make_levels(struct reader *reader)
{
    struct scene_rkpm *rkpm = &reader->scene->rkpm;
    rkpm->n_levels = rkpm->n_refinements > 0 ? rkpm->n_refinements : 1;
    rkpm->levels = memory_array(rkpm->n_levels, sizeof *rkpm->levels, "refi");
    for (int a = 0; a < 3; a++)
        rkpm->levels[0][a] = a < rkpm->dimension ? rkpm->numbers[a] : 1;
    check_numbers(reader, rkpm->numbers, rkpm->box_places[2 * rkpm->dimension]);
    for (size_t i = 0; i < rkpm->n_refinements; i++) {
        long *numbers = rkpm->levels[i];
        numbers[0] = numbers[1] = numbers[2] = 1;
        if (refine(rkpm, rkpm->refinements[i], numbers))
            check_numbers(reader, numbers, rkpm->refinement_places[i]);
        else
            diagnostics_error(reader->diagnostics, rkpm->refinement_places[i],
                              "%ld nodes along x make no whole number of cells, from 1 to %g, along the other axes", rkpm->refinements[i], MOST_NODES);
    }
}

/* Nodes of a file: they are read here; what needs the lattice does not go with them. */
static void check_file(struct reader *reader)
{
    struct scene_rkpm *rkpm = &reader->scene->rkpm;
    const bool has_body = scene_rkpm_has_body(rkpm);
    if (!rkpm->file)
        return;
    const struct deck_place place = place_of(reader, "file");
    if (!has_body)
        diagnostics_error(reader->diagnostics, place, "'file' needs 'prob elastic' or 'prob creep'");
    if (rkpm->n_refinements > 0)
        diagnostics_error(reader->diagnostics, place, "nodes of a file can't be refined; leave 'refi' out");
    if (rkpm->jitter[0] > 0)
        diagnostics_error(reader->diagnostics, place, "nodes of a file stay where they are; leave 'pert' out");
    if (rkpm->constraint == CONSTRAINT_LAGRANGE)
        diagnostics_error(reader->diagnostics, place, "hats need the box's lattice; expected 'cons nits', or 'cons tran' with nodes on held sides");
    if (rkpm->integration != INTEGRATION_GAUSS && rkpm->dimension != 2)
        diagnostics_error(reader->diagnostics, place, "cells around nodes off the lattice need 'dime 2'; expected 'inte gauss', or no 'file'");
    if (reader_nodes_file(reader, place) && rkpm->n_places > MOST_NODES)
        diagnostics_error(reader->diagnostics, place, "these are %g nodes; expected at most %g", (double)rkpm->n_places, MOST_NODES);
}

/* --- the rest --- */

static void check_support(struct reader *reader)
{
    const struct scene_rkpm *rkpm = &reader->scene->rkpm;
    const int order = rkpm->basis == BASIS_QUADRATIC ? 2 : 1;
    if (rkpm->n_support != 1 && rkpm->n_support != rkpm->dimension)
        diagnostics_error(reader->diagnostics, place_of(reader, "supp"), "'supp' has %d numbers; expected 1, or %ld with 'dime %ld'",
                          rkpm->n_support, rkpm->dimension, rkpm->dimension);
    for (int a = 0; a < rkpm->n_support; a++)
        if (rkpm->support[a] <= order)
            diagnostics_error(reader->diagnostics, rkpm->support_places[a],
                              "a support of %g spacings is too small for the basis: the moment matrix is singular at the boundary; expected more than %d",
                              rkpm->support[a], order);
        else if (rkpm->support[a] > LARGEST_SUPPORT)
            diagnostics_error(reader->diagnostics, rkpm->support_places[a], "a support of %g spacings reaches too many nodes; expected at most %g",
                              rkpm->support[a], LARGEST_SUPPORT);
        else if (rkpm->support[a] < order + 0.5)
            diagnostics_warning(reader->diagnostics, rkpm->support_places[a], "a support of %g spacings is small for the basis; take %g or more",
                                rkpm->support[a], order + 0.5);
}

/* The wave is 1 at one end and 0 at the other, which nothing does that fits as a whole number of half waves. */
static void check_wave(struct reader *reader)
{
    const struct scene_rkpm *rkpm = &reader->scene->rkpm;
    for (size_t i = 0; i < rkpm->n_levels && rkpm->function == FUNCTION_WAVE && was_given(reader, "wave"); i++) {
        const double length = rkpm->box[1] - rkpm->box[0], cells = fmax((double)(rkpm->levels[i][0] - 1), 1);
        const double turns = rkpm->wave_number * (rkpm->wave_over_spacing ? cells : length);
        if (fabs(sin(turns)) > 1e-9)
            continue;
        diagnostics_error(reader->diagnostics, place_of(reader, "wave"),
                          "%g half waves fit between the ends of the box: none is 1 at one end and 0 at the other", turns / acos(-1));
        break;
    }
}

/* Young's modulus over that of strain along one axis alone, which tractions of nearly incompressible bodies follow. */
static double relative_young(const struct scene_rkpm *rkpm)
{
    const double nu = rkpm->poisson;
    if (!scene_rkpm_has_body(rkpm) || rkpm->dimension == 1)
        return 1;
    return rkpm->dimension == 2 && rkpm->plane == PLANE_STRESS ? (1 - nu) * (1 + nu) : (1 + nu) * (1 - 2 * nu) / (1 - nu);
}

/* Linear functions can't bend without a change of volume. */
static void check_locking(struct reader *reader)
{
    const struct scene_rkpm *rkpm = &reader->scene->rkpm;
    if (was_given(reader, "modu") && rkpm->basis != BASIS_QUADRATIC && relative_young(rkpm) < LOCKING_YOUNG)
        diagnostics_warning(reader->diagnostics, place_of(reader, "modu"),
                            "Poisson's ratio %g makes a body of linear functions much too stiff (locking); take basi quad", rkpm->poisson);
}

/* The largest spacing of a level. */
static double largest_spacing(const struct scene_rkpm *rkpm, const long numbers[3])
{
    double largest = 0;
    for (int a = 0; a < rkpm->dimension; a++)
        largest = fmax(largest, (rkpm->box[2 * a + 1] - rkpm->box[2 * a]) / fmax((double)(numbers[a] - 1), 1));
    return largest;
}

static void check_beta(struct reader *reader)
{
    const struct scene_rkpm *rkpm = &reader->scene->rkpm;
    const bool is_positive = rkpm->problem == PROBLEM_POISSON || rkpm->problem == PROBLEM_ELASTIC, is_given = was_given(reader, "beta");
    const struct deck_place place = place_of(reader, is_given ? "beta" : "cons");
    const double ratio = relative_young(rkpm);
    double largest = 0, smallest = INFINITY;
    for (size_t i = 0; i < rkpm->n_levels; i++) {
        const double product = ratio * rkpm->beta * (rkpm->beta_over_spacing ? 1 : largest_spacing(rkpm, rkpm->levels[i]));
        largest = fmax(largest, product);
        smallest = fmin(smallest, product);
    }
    if (rkpm->constraint == CONSTRAINT_NITSCHE && is_positive && smallest < SMALLEST_NITSCHE)
        diagnostics_error(reader->diagnostics, place, "beta times the spacing is %.3g: below %g Nitsche's method is unstable; expected about 'beta %.3g /h'",
                          smallest, SMALLEST_NITSCHE, GOOD_BETA / ratio);
    else if (rkpm->constraint == CONSTRAINT_PENALTY && smallest < SMALLEST_PENALTY)
        diagnostics_warning(reader->diagnostics, place, "beta times the spacing is %.3g: below %g the boundary is hardly held; take about 'beta %.3g /h'",
                            smallest, SMALLEST_PENALTY, GOOD_BETA / ratio);
    else if (is_given && largest > LARGEST_BETA)
        diagnostics_warning(reader->diagnostics, place,
                            "beta times the spacing is %g: above %g coarse nodes are held too much at the boundary; take about 'beta %.3g /h'", largest,
                            LARGEST_BETA, GOOD_BETA / ratio);
}

/* What a body keeps: as many points as the rule has, each with the nodes of a support. */
static double pairs_of(const struct scene_rkpm *rkpm, const long numbers[3])
{
    const double along = rkpm->integration == INTEGRATION_GAUSS ? scene_rkpm_gauss(rkpm) : 1;
    double pairs = 1;
    for (int a = 0; a < rkpm->dimension; a++)
        pairs *= along * (double)numbers[a] * fmin(2 * rkpm->support[a], (double)numbers[a]);
    return pairs;
}

/* What a scalar problem keeps: its matrix from the first entry of each row on, with the longest axis the slowest. */
static double entries_of(const struct scene_rkpm *rkpm, const long numbers[3])
{
    double nodes = 1, longest = 1, support = 0;
    for (int a = 0; a < rkpm->dimension; a++) {
        nodes *= (double)numbers[a];
        longest = fmax(longest, (double)numbers[a]);
        support = fmax(support, rkpm->support[a]);
    }
    return nodes * fmin(2 * support * nodes / longest, nodes);
}

/* What would take more room than machines have is refused before its points and rows are counted. */
static void check_room(struct reader *reader)
{
    const struct scene_rkpm *rkpm = &reader->scene->rkpm;
    const bool is_body = scene_rkpm_has_body(rkpm);
    for (size_t i = 0; i < rkpm->n_levels && rkpm->problem != PROBLEM_APPROXIMATION; i++) {
        const double needed = is_body ? pairs_of(rkpm, rkpm->levels[i]) : entries_of(rkpm, rkpm->levels[i]), most = is_body ? MOST_PAIRS : MOST_ENTRIES;
        if (needed > most)
            diagnostics_error(reader->diagnostics, rkpm->n_refinements > 0 ? rkpm->refinement_places[i] : rkpm->box_places[2 * rkpm->dimension],
                              is_body ? "points of integration have %.2g neighbours together; expected at most %g: fewer nodes, a smaller supp or gaus"
                                      : "the matrix has about %.2g entries; expected at most %g: fewer nodes, or a smaller supp",
                              needed, most);
    }
}

void reader_finish_rkpm(struct reader *reader)
{
    struct scene *scene = reader->scene;
    struct scene_rkpm *rkpm = &scene->rkpm;
    if (!scene->title)
        scene->title = memory_text("mpm3d", 5);
    if (!reader_was_given(reader, "rkpm")) {
        diagnostics_error(reader->diagnostics, reader->method_place, "'meth rkpm' needs its block; expected 'rkpm ... ends'");
        return;
    }
    if (reader->has_bad_rkpm)
        return;
    if (rkpm->problem == PROBLEM_DYNAMIC) {
        reader_finish_dynamic(reader);
        if (was_given(reader, "supp"))
            check_support(reader);
        return;
    }
    check_dynamic_words(reader);
    if (!check_missing(reader))
        return;
    check_needs(reader);
    check_function(reader);
    check_needed(reader);
    check_creep(reader);
    check_integration(reader);
    check_held(reader);
    check_support(reader);
    if (!check_box(reader))
        return;
    make_levels(reader);
    check_file(reader);
    check_wave(reader);
    check_beta(reader);
    check_locking(reader);
    check_room(reader);
    const long *last = rkpm->levels[rkpm->n_levels - 1];
    if (diagnostics_errors(reader->diagnostics) == 0)
        scene->n_particles = rkpm->file ? (long)rkpm->n_places : last[0] * last[1] * last[2];
    scene->end_time = scene->output_interval = scene->report_interval = rkpm->problem == PROBLEM_CREEP ? rkpm->end_time : (double)rkpm->n_levels;
}
