/* SPDX-License-Identifier: GPL-3.0-or-later */
/* prop: how a material of smoothed particles follows the temperature. */
#include "base/memory.h"
#include "deck/commands_sph.h"

#include <string.h>
#include <strings.h>

enum { MOST_ROWS = 10000 };

const struct argument reader_property_arguments[] = {{"material", NULL, ARGUMENT_INTEGER, LIMIT_COUNT},
                                                     {"name", NULL, ARGUMENT_WORD, LIMIT_NONE}, {0}};

/* --- tables --- */

static bool value_is_good(const struct property_row *row, enum property property, double value)
{
    if (property == PROPERTY_ABSORPTIVITY)
        return argument_within(LIMIT_FRACTION, value);
    return argument_within(row->is_positive ? LIMIT_POSITIVE : LIMIT_NOT_NEGATIVE, value);
}

/* Reads a row `T v` of a table; false, after an error, where it is none. */
static bool read_row(struct reader *reader, enum property property, struct property_table *table)
{
    static const struct argument arguments[] = {{"temperature", "temperature", ARGUMENT_REAL, LIMIT_NONE},
                                                {"value", NULL, ARGUMENT_REAL, LIMIT_NONE}, {0}};
    const struct property_row *row = property_row(property);
    struct value values[3];
    char owner[20];
    snprintf(owner, sizeof owner, "prop %s", row->name);
    if (!reader_values(reader, arguments, owner, values))
        return false;
    const double temperature = values[0].real, value = values[1].real;
    if (table->count > 0 && temperature <= table->temperatures[table->count - 1]) {
        diagnostics_error(reader->diagnostics, values[0].word.place, "temperatures of %s have to increase; %g comes after %g", owner,
                          temperature, table->temperatures[table->count - 1]);
        return false;
    }
    if (!value_is_good(row, property, value)) {
        diagnostics_error(reader->diagnostics, values[1].word.place, "the %s of %s must be %s, not %g", row->doc, owner,
                          argument_limit_text(property == PROPERTY_ABSORPTIVITY ? LIMIT_FRACTION
                                              : row->is_positive                ? LIMIT_POSITIVE
                                                                                : LIMIT_NOT_NEGATIVE),
                          value);
        return false;
    }
    size_t capacity = table->capacity;
    table->temperatures = memory_grow(table->temperatures, &capacity, table->count + 1, sizeof(double), "prop");
    table->values = memory_grow(table->values, &table->capacity, table->count + 1, sizeof(double), "prop");
    table->temperatures[table->count] = temperature;
    table->values[table->count++] = value;
    return true;
}

static void note_once(struct reader *reader, const struct deck_word *name, long material, struct deck_place *place)
{
    char shown[40];
    if (place->line > 0)
        diagnostics_error(reader->diagnostics, name->place, "'%s' of material %ld was given before", text_show(name, shown, sizeof shown),
                          material);
    *place = name->place;
}

static void read_table(struct reader *reader, const struct deck_word *name, enum property property, struct scene_material *entry)
{
    static const struct argument count[] = {{"n", NULL, ARGUMENT_INTEGER, LIMIT_COUNT}, {0}};
    static const char *const ways_on[] = {"extr", NULL};
    struct property_table *table = &entry->properties.tables[property];
    struct value n[2];
    if (!reader_values(reader, count, "prop", n)) {
        reader_skip_numbers(reader);
        return;
    }
    if (n[0].integer > MOST_ROWS) {
        diagnostics_error(reader->diagnostics, n[0].word.place, "n of prop must be at most %d, not %ld", MOST_ROWS, n[0].integer);
        reader_skip_numbers(reader);
        return;
    }
    memory_free(table->temperatures);
    memory_free(table->values);
    *table = (struct property_table){0};
    for (long i = 0; i < n[0].integer; i++)
        if (!read_row(reader, property, table)) {
            reader_skip_numbers(reader);
            break;
        }
    table->goes_on = reader_optional(reader, ways_on) == 0;
    if (table->goes_on && table->count == 1)
        diagnostics_error(reader->diagnostics, name->place, "'extr' needs a line to go on along; expected a table of two rows or more");
}

/* --- melting, boiling, surface tension by formula --- */

static void set_surface(struct scene_material *entry, const struct value *v)
{
    entry->properties.surface = (struct surface_formula){true, v[0].real, v[1].real, v[2].real, v[3].real, v[4].real, v[5].real, v[6].real};
}

static void read_melting(struct reader *reader, struct scene_material *entry, const struct value *v)
{
    struct properties *properties = &entry->properties;
    properties->melts = true;
    properties->solidus = v[0].real;
    properties->liquidus = v[1].real;
    properties->latent_heat = v[2].real;
    if (properties->liquidus <= properties->solidus)
        diagnostics_error(reader->diagnostics, v[1].word.place,
                          "the liquidus, %g, has to be above the solidus, %g; a metal that melts at one temperature has some kelvin between",
                          properties->liquidus, properties->solidus);
}

static void set_boiling(struct scene_material *entry, const struct value *v)
{
    entry->properties.boils = true;
    entry->properties.boiling_point = v[0].real;
    entry->properties.vaporisation_heat = v[1].real;
    entry->properties.molar_mass = v[2].real;
}

#define TEMPERATURE(name) {name, "temperature", ARGUMENT_REAL, LIMIT_POSITIVE}

const struct keyword property_keywords[] = {
    {.name = "sahu",
     .arguments = (const struct argument[]){{"tension", "force/length", ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"slope", "force/(length*temperature)", ARGUMENT_REAL, LIMIT_NONE}, TEMPERATURE("Tm"),
                                            {"excess", "amount/length^2", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE},
                                            {"entropy", NULL, ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"activity", NULL, ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"segregation", "energy/amount", ARGUMENT_REAL, LIMIT_NONE}, {0}},
     .doc = "surface tension with a surface-active element (Sahoo, DebRoy and McNallan 1988), in place of surf: that of the pure "
            "metal at Tm and how much less a kelvin, excess at saturation, entropy factor, activity in weight percent, heat of "
            "segregation"},
    {.name = "melt",
     .arguments = (const struct argument[]){TEMPERATURE("solidus"), TEMPERATURE("liquidus"),
                                            {"latent", "energy/mass", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE}, {0}},
     .doc = "melts between two temperatures; below the first it is solid and stays where it is"},
    {.name = "boil",
     .arguments = (const struct argument[]){TEMPERATURE("Tb"), {"heat", "energy/mass", ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"molar", "mass/amount", ARGUMENT_REAL, LIMIT_POSITIVE}, {0}},
     .doc = "boiling point, heat of vaporisation and molar mass, for evaporation"},
    {0}};

/* Reads what stands behind `sahu`, `melt` or `boil`. */
static void read_row_of_numbers(struct reader *reader, const struct deck_word *name, const struct keyword *row, long material,
                                struct scene_material *entry)
{
    struct value values[KEYWORD_ARGUMENTS];
    char owner[20];
    snprintf(owner, sizeof owner, "prop %s", row->name);
    if (!reader_values(reader, row->arguments, owner, values))
        return;
    if (strcmp(row->name, "sahu") == 0) {
        note_once(reader, name, material, &entry->surface_place);
        set_surface(entry, values);
    } else if (strcmp(row->name, "melt") == 0) {
        note_once(reader, name, material, &entry->melting_place);
        read_melting(reader, entry, values);
    } else {
        set_boiling(entry, values);
    }
}

static void unknown_name(struct reader *reader, const struct deck_word *name, const char *text)
{
    int best = KEYWORD_FAR;
    const char *nearest = NULL;
    for (int i = 0; i < PROPERTY_COUNT; i++)
        keyword_nearer(text, property_row((enum property)i)->name, &best, &nearest);
    for (const struct keyword *row = property_keywords; row->name; row++)
        keyword_nearer(text, row->name, &best, &nearest);
    reader_unknown(reader, name, "property", nearest, "prop");
    reader_skip_numbers(reader);
}

void reader_property(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    struct scene *scene = reader->scene;
    struct scene_material nowhere = {0}, *entry = &nowhere; /* of a wrong material: read as far as can be */
    char text[40];
    if (reader_needs(reader, word, "mate") && reader_check_id(reader, &values[0], (long)scene->n_materials, "material"))
        entry = &scene->materials[values[0].integer - 1];
    const struct keyword *row = keyword_in(property_keywords, text_copy(&values[1].word, text, sizeof text));
    int property = 0;
    while (property < PROPERTY_COUNT && strncasecmp(text, property_row((enum property)property)->name, 4) != 0)
        property++;
    entry->properties.is_given = true;
    if (row) {
        read_row_of_numbers(reader, &values[1].word, row, values[0].integer, entry);
    } else if (property < PROPERTY_COUNT) {
        note_once(reader, &values[1].word, values[0].integer, &entry->property_places[property]);
        read_table(reader, &values[1].word, (enum property)property, entry);
    } else {
        unknown_name(reader, &values[1].word, text);
    }
    properties_close(&nowhere.properties);
}
