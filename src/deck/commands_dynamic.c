/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Words of the block rkpm that go with `prob dynamic`: nodes of a disc, ball or brick, how they start, gravity, a wall; weight of creep. */
#include "deck/commands_dynamic.h"

#include <math.h>

#define NUMBER(name, unit, limit) {name, unit, ARGUMENT_REAL, limit}

const char *const reader_kernel_modes[] = {[KERNEL_LAGRANGIAN] = "lagrangian", [KERNEL_SEMI] = "semi", NULL};

void reader_lattice(struct reader *reader, int dimension, struct deck_place place)
{
    static const struct argument plane[] = {NUMBER("x", "length", LIMIT_NONE), NUMBER("y", "length", LIMIT_NONE),
                                            NUMBER("radius", "length", LIMIT_POSITIVE), NUMBER("spacing", "length", LIMIT_POSITIVE), {0}};
    static const struct argument space[] = {NUMBER("x", "length", LIMIT_NONE),          NUMBER("y", "length", LIMIT_NONE),
                                            NUMBER("z", "length", LIMIT_NONE),          NUMBER("radius", "length", LIMIT_POSITIVE),
                                            NUMBER("spacing", "length", LIMIT_POSITIVE), {0}};
    struct scene_dynamic *dynamic = &reader->scene->rkpm.dynamic;
    struct value values[6];
    if (!reader_values(reader, dimension == 2 ? plane : space, dimension == 2 ? "node disc" : "node sphere", values))
        return;
    dynamic->has_lattice = true;
    dynamic->lattice_place = place;
    dynamic->lattice = (struct ball_lattice){.dimension = dimension};
    for (int a = 0; a < dimension; a++)
        dynamic->lattice.centre[a] = values[a].real;
    dynamic->lattice.radius = values[dimension].real;
    dynamic->lattice.spacing = values[dimension + 1].real;
}

/* Whole numbers of spacings from low to high along an axis; false after an error. */
static bool set_side(struct reader *reader, struct ball_lattice *lattice, int axis, double low, double high, struct deck_place place)
{
    static const double ROUNDING = 1e-6, MOST = 1e7;
    const double number = floor((high - low) / lattice->spacing + 0.5);
    if (!(high > low) || number > MOST || fabs((high - low) / lattice->spacing - number) > ROUNDING * number) {
        diagnostics_error(reader->diagnostics, place, "from %g to %g along %c are %g spacings; expected a whole number up to %g", low, high,
                          "xyz"[axis], (high - low) / lattice->spacing, MOST);
        return false;
    }
    lattice->numbers[axis] = (long)number;
    lattice->centre[axis] = 0.5 * (low + high);
    lattice->radius = fmax(lattice->radius, 0.5 * (high - low));
    return true;
}

void reader_brick(struct reader *reader, struct deck_place place)
{
    static const struct argument number[] = {NUMBER("number", "length", LIMIT_NONE), {0}};
    struct scene_dynamic *dynamic = &reader->scene->rkpm.dynamic;
    struct value values[8] = {{0}};
    int n = 0;
    while (n < 7 && reader_has_more(reader) && reader_values(reader, number, "node brick", &values[n]))
        n++;
    if (n != 5 && n != 7) {
        diagnostics_error(reader->diagnostics, place, "'node brick' has %d numbers; expected x0 x1 y0 y1 spacing or x0 x1 y0 y1 z0 z1 spacing", n);
        return;
    }
    const double spacing = values[n - 1].real;
    if (!(spacing > 0)) {
        diagnostics_error(reader->diagnostics, values[n - 1].word.place, "the spacing must be greater than 0, not %g", spacing);
        return;
    }
    struct ball_lattice lattice = {.dimension = n / 2, .spacing = spacing};
    dynamic->has_lattice = true;
    dynamic->lattice_place = place;
    for (int a = 0; a < n / 2; a++)
        dynamic->has_lattice = set_side(reader, &lattice, a, values[2 * a].real, values[2 * a + 1].real, values[2 * a + 1].word.place) && dynamic->has_lattice;
    dynamic->lattice = lattice;
}

/* The third component of a vector may be left out. */
static void read_vector(struct reader *reader, const struct value *values, const char *owner, double vector[3])
{
    static const struct argument last[] = {NUMBER("z", NULL, LIMIT_NONE), {0}};
    struct value value;
    vector[0] = values[0].real;
    vector[1] = values[1].real;
    vector[2] = reader_has_more(reader) && reader_values(reader, last, owner, &value) ? value.real : 0;
}

void reader_start_velocity(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    read_vector(reader, values, "star", reader->scene->rkpm.dynamic.velocity);
}

void reader_rkpm_weight(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    read_vector(reader, values, "weig", reader->scene->rkpm.weight);
}

void reader_rkpm_gravity(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    read_vector(reader, values, "grav", reader->scene->rkpm.dynamic.gravity);
}

static void read_spring(struct reader *reader)
{
    static const char *const holds[] = {"free", "stick", NULL};
    static const struct argument numbers[] = {NUMBER("modulus", "stress/length", LIMIT_POSITIVE), {0}};
    struct scene_dynamic *dynamic = &reader->scene->rkpm.dynamic;
    struct value value[2];
    if (!reader_values(reader, numbers, "wall spring", value))
        return;
    dynamic->wall_modulus = value[0].real;
    dynamic->wall_sticks = reader_optional(reader, holds) == 1;
    dynamic->wall = RKPM_WALL_SPRING;
}

static void read_natural(struct reader *reader)
{
    static const char *const keeps[] = {"keep", NULL};
    struct scene_dynamic *dynamic = &reader->scene->rkpm.dynamic;
    dynamic->wall_releases = reader_optional(reader, keeps) < 0;
    dynamic->wall = RKPM_WALL_NATURAL;
}

void reader_rkpm_wall(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    static const char *const kinds[] = {"spring", "natural", NULL};
    static const struct argument place[] = {{"axis", NULL, ARGUMENT_WORD, LIMIT_NONE}, NUMBER("position", "length", LIMIT_NONE), {0}};
    struct scene_dynamic *dynamic = &reader->scene->rkpm.dynamic;
    struct value value[3];
    (void)values;
    const int kind = reader_optional(reader, kinds);
    if (kind < 0) {
        reader_expect(reader, "wall", "spring or natural");
        return;
    }
    if (!reader_values(reader, place, "wall", value))
        return;
    const int axis = reader_axis(reader, &value[0]);
    if (axis < 0) {
        reader_skip_line(reader);
        return;
    }
    dynamic->wall_place = word->place;
    dynamic->wall_axis = axis;
    dynamic->wall_position = value[1].real;
    if (kind == 0)
        read_spring(reader);
    else
        read_natural(reader);
}
