/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solving settings: time, schemes, stress rotation, viscosity, damping. */
#include "deck/reader.h"

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

/* Without any scheme switched on, MUSL runs; usf wins over all, musl over usl (spec 2). */
static void switch_scheme(struct reader *reader, const struct value *values, const char *name, enum scheme scheme)
{
    static const int rank[] = {[SCHEME_USF] = 3, [SCHEME_MUSL] = 2, [SCHEME_USL] = 1};
    if (reader_switch(reader, &values[0], name) != 1)
        return;
    if (!reader->has_scheme || rank[scheme] > rank[reader->scene->scheme])
        reader->scene->scheme = scheme;
    reader->has_scheme = true;
}

static void read_musl(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    switch_scheme(reader, values, "musl", SCHEME_MUSL);
}

static void read_usl(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
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

static void read_kinetic_damping(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)word;
    (void)values;
    reader->scene->kinetic_damping = true;
}

const struct keyword solving_keywords[] = {
    {.name = "endt", .long_name = "endtime",
     .arguments = (const struct argument[]){{"time", "time", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE}, {0}},
     .field = offsetof(struct scene, end_time), .apply = read_end_time,
     .doc = "end time; sets the output interval too, so outt has to follow it"},
    {.name = "dtsc", .long_name = "dtscale",
     .arguments = (const struct argument[]){{"factor", NULL, ARGUMENT_REAL, LIMIT_STEP_SCALE}, {0}},
     .field = offsetof(struct scene, step_scale), .doc = "time step as a fraction of the stable one (0.9)"},
    {.name = "musl", .arguments = SWITCH, .apply = read_musl, .doc = "modified update stress last (default)"},
    {.name = "usl", .arguments = SWITCH, .apply = read_usl, .doc = "update stress last"},
    {.name = "usf", .arguments = SWITCH, .apply = read_usf, .doc = "update stress first"},
    {.name = "jaum", .long_name = "jaumann",
     .arguments = (const struct argument[]){{"on|off|exact", NULL, ARGUMENT_WORD, LIMIT_NONE}, {0}},
     .apply = read_rotation,
     .doc = "rotation of the stress: on explicit (default), exact orthogonal (Hughes-Winget), off none"},
    {.name = "bulk",
     .arguments = (const struct argument[]){{"quadratic", NULL, ARGUMENT_REAL, LIMIT_NONE},
                                            {"linear", NULL, ARGUMENT_REAL, LIMIT_NONE}, {0}},
     .field = offsetof(struct scene, bulk), .doc = "artificial bulk viscosity (1.5 0.06)"},
    {.name = "Damp",
     .arguments = (const struct argument[]){{"rate", "1/time", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE}, {0}},
     .field = offsetof(struct scene, damping), .doc = "damping force -rate * mass * velocity on each particle"},
    {.name = "drda", .apply = read_kinetic_damping,
     .doc = "kinetic damping: velocities are set to zero whenever the kinetic energy falls"},
    {.name = "sort", .arguments = SWITCH, .apply = read_sorting,
     .doc = "keep particles in cell order in memory (on); changes speed, never results"},
    {.name = "gimp", .doc = "generalised interpolation", .later = "shape functions other than linear"},
    {.name = "bimp", .doc = "quadratic B-splines", .later = "shape functions other than linear"},
    {.name = "sgmp", .doc = "staggered grid", .later = "the staggered grid"},
    {.name = "TLmp", .doc = "total Lagrangian", .later = "the total Lagrangian formulation"},
    {.name = "UVFp", .doc = "volume from the deformation gradient", .later = "the deformation gradient"},
    {.name = "cont", .long_name = "contact", .doc = "contact", .later = "contact"},
    {0}};
