/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Material model: the mate block, and later the equations of state. */
#include "base/memory.h"
#include "deck/commands_sph.h"
#include "deck/number.h"
#include "material/eos.h"

#include <math.h>
#include <string.h>

enum { MOST_ELEMENTS = 10000 };

/* Makes room for material `index`. */
static struct scene_material *material_at(struct scene *scene, size_t index)
{
    scene->materials = memory_grow(scene->materials, &scene->materials_capacity, index + 1, sizeof *scene->materials,
                                   "materials");
    if (index >= scene->n_materials)
        scene->n_materials = index + 1;
    return &scene->materials[index];
}

static const char *nearest_law(const char *word)
{
    const char *found = NULL;
    int best = KEYWORD_FAR;
    for (const struct law *const *row = law_rows(); *row; row++)
        keyword_nearer(word, (*row)->name, &best, &found);
    return found;
}

/* Whether the next word can only be the id of a material: a law follows it, or what seems one. */
static bool next_is_material(struct reader *reader)
{
    struct deck_word id, law;
    long integer;
    double real;
    return text_peek(reader->text, &id) && number_is_integer(&id, &integer) && text_second(reader->text, &law)
        && !number_is_real(&law, &real);
}

/* Takes the rest of a material that can't be read. */
static void skip_to_next_material(struct reader *reader)
{
    struct deck_word word;
    double real;
    while (text_peek(reader->text, &word) && !next_is_material(reader) && !reader_is_keyword(&word)
           && (!reader_at_line_end(reader) || number_is_real(&word, &real)))
        text_next(reader->text, &reader->last);
}

/* Reads the number of elements that stand behind the parameters, and each of them; false, after an error, where one is wrong. */
static bool read_elements(struct reader *reader, struct material *material)
{
    static const struct argument number[] = {{"n", NULL, ARGUMENT_INTEGER, LIMIT_COUNT}, {0}};
    struct value n[2], values[LAW_PARAMETERS];
    char owner[40];
    if (!reader_values(reader, number, material->law->name, n))
        return false;
    if (n[0].integer > MOST_ELEMENTS) {
        diagnostics_error(reader->diagnostics, n[0].word.place, "n of %s must be at most %d, not %ld", material->law->name,
                          MOST_ELEMENTS, n[0].integer);
        return false;
    }
    for (int i = 0; i < n[0].integer; i++) {
        snprintf(owner, sizeof owner, "element %d of %s", i + 1, material->law->name);
        if (!reader_values(reader, material->law->element, owner, values))
            return false;
        material->elements = memory_grow(material->elements, &material->elements_capacity, (size_t)i + 1, sizeof *material->elements,
                                         "elements");
        material->elements[material->n_elements++] = (struct law_element){.strength = values[0].real, .time = values[1].real};
    }
    return true;
}

/* Takes the law's words on the same line; false, after an error, where something else stands there. */
static bool read_words(struct reader *reader, struct material *material)
{
    const struct law *law = material->law;
    char expected[120] = "", owner[60];
    for (int i; (i = reader_optional(reader, law->words)) >= 0;)
        material->words |= 1u << i;
    if (!reader_has_more(reader) || next_is_material(reader))
        return true;
    for (int i = 0; law->words[i]; i++) {
        const size_t length = strlen(expected);
        snprintf(expected + length, sizeof expected - length, "%s%s", i == 0 ? "" : law->words[i + 1] ? ", " : " or ", law->words[i]);
    }
    snprintf(owner, sizeof owner, "the %d element%s of %s", material->n_elements, material->n_elements == 1 ? "" : "s", law->name);
    reader_expect(reader, owner, expected);
    return false;
}

/* Fills a material from the parameters of its law; false (and an error) where they don't fit. */
static bool prepare(struct reader *reader, const struct law *law, const struct deck_word *word,
                    const struct value *values, struct material *material)
{
    for (int i = 0; i < argument_count(law->parameters); i++)
        material->parameter[i] = values[i].real;
    const char *wrong = law->prepare(material);
    if (wrong)
        diagnostics_error(reader->diagnostics, word->place, "law '%s': %s", law->name, wrong);
    else if (law->methods != METHODS_SPH && !(isfinite(material->wave_speed) && material->wave_speed > 0))
        diagnostics_error(reader->diagnostics, word->place, "law '%s': the wave speed that follows is %g", law->name,
                          material->wave_speed);
    else
        return true;
    return false;
}

/* Reads `law parameters` of one material; returns whether they are right. */
static bool read_law(struct reader *reader, struct scene_material *entry)
{
    struct deck_word word;
    struct value values[LAW_PARAMETERS];
    char name[40];
    if (reader_at_line_end(reader) && text_peek(reader->text, &word) && reader_is_keyword(&word)) {
        diagnostics_error(reader->diagnostics, text_behind(&reader->last), "a material lacks its law");
        return false;
    }
    if (!reader_word(reader, &word, "the name of a law"))
        return false;
    const struct law *law = law_find(text_copy(&word, name, sizeof name));
    entry->place = word.place;
    if (law && !law->later) {
        memory_free(entry->material.elements);
        entry->material = (struct material){.law = law};
        reader->in_materials = true;
        bool good = reader_values(reader, law->parameters, law->name, values);
        good = good && (!law->element || read_elements(reader, &entry->material)) && (!law->words || read_words(reader, &entry->material));
        reader->in_materials = false;
        return good && prepare(reader, law, &word, values, &entry->material);
    }
    if (!law)
        reader_unknown(reader, &word, "law", nearest_law(name), "mate");
    else
        diagnostics_error(reader->diagnostics, word.place, "law '%s' is not available in this version: %s", law->name,
                          law->later);
    return false;
}

/* Takes the id of a material; false (and an error) where it is missing or wrong. `has_ended`: the
 * last material was read before. */
static bool take_id(struct reader *reader, bool has_ended, struct value *id)
{
    const long declared = reader->scene->materials_declared;
    char text[40];
    text_peek(reader->text, &id->word);
    if (law_find(text_copy(&id->word, text, sizeof text))) {
        diagnostics_error(reader->diagnostics, id->word.place, "expected a material id before '%s'", text);
        return false;
    }
    text_next(reader->text, &reader->last);
    if (!number_is_integer(&id->word, &id->integer))
        diagnostics_error(reader->diagnostics, id->word.place, "expected a material id (a whole number), found '%s'",
                          text_show(&id->word, text, sizeof text));
    else if (has_ended && id->integer >= 1 && id->integer <= declared)
        diagnostics_error(reader->diagnostics, id->word.place,
                          "material %ld comes after material %ld, the last by 'nmat', which ends 'mate'", id->integer,
                          declared);
    else
        return reader_check_id(reader, id, declared, "material");
    return false;
}

/* Reads `id law parameters`; returns the id, or 0 where it is wrong. */
static long read_material(struct reader *reader, bool has_ended)
{
    struct scene_material nowhere = {0}, *entry = &nowhere;
    struct value id = {0};
    struct deck_word next;
    double real;
    bool good = take_id(reader, has_ended, &id);
    if (good)
        entry = material_at(reader->scene, (size_t)id.integer - 1);
    if (good || (text_peek(reader->text, &next) && !number_is_real(&next, &real)))
        entry->is_given = read_law(reader, entry);
    memory_free(nowhere.material.elements);
    if (good && entry->is_given)
        return id.integer;
    reader->has_bad_material = true;
    skip_to_next_material(reader);
    return good ? id.integer : 0;
}

/* Whether the block ends before its last material; reports that, and goes on behind a command
 * that stands inside the block. */
static bool breaks_off(struct reader *reader)
{
    struct scene *scene = reader->scene;
    struct deck_word word;
    char text[40];
    if (!text_peek(reader->text, &word)) {
        reader->is_cut = true;
        diagnostics_error(reader->diagnostics, text_behind(&reader->last),
                          "the deck ends here; expected material %zu of %ld", scene->n_materials + 1,
                          scene->materials_declared);
        return true;
    }
    const struct keyword *row = keyword_find(text_copy(&word, text, sizeof text), NULL);
    if (!row)
        return false;
    if (!reader->has_bad_material)
        diagnostics_error(reader->diagnostics, word.place, "'%s' inside the block 'mate'; expected material %zu of %ld",
                          text, scene->n_materials + 1, scene->materials_declared);
    reader->has_bad_material = true;
    if (reader->depth == READER_DEPTH)
        return true;
    text_next(reader->text, &word);
    reader->last = word;
    reader_command(reader, row, &word);
    return !next_is_material(reader);
}

/* The mass cutoff is fixed here, with the cell size known at this moment (spec 3.1). */
static void set_mass_cutoff(struct scene *scene)
{
    double sum = 0, size = scene->cell_size;
    for (size_t i = 0; i < scene->n_materials; i++)
        sum += scene->materials[i].material.density;
    scene->cutoff_cell_size = size;
    if (scene->materials_declared > 0)
        scene->mass_cutoff = 1e-5 * sum / (double)scene->materials_declared * size * size * size;
}

static void read_materials(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)values;
    struct scene *scene = reader->scene;
    bool has_ended = false;
    reader_needs(reader, word, "nmat");
    reader->materials_place = word->place;
    reader->depth++;
    while (has_ended || scene->materials_declared == 0 ? next_is_material(reader) : !breaks_off(reader))
        if (read_material(reader, has_ended) >= scene->materials_declared)
            has_ended = true;
    reader->depth--;
    if (scene->materials_declared > 0) /* those that are missing are reported once, not wherever they are used */
        material_at(scene, (size_t)scene->materials_declared - 1);
    set_mass_cutoff(scene);
}

/* What needs this equation of state is not to be reported too. */
static void fail_eos(struct reader *reader, const struct deck_word *word)
{
    (void)word;
    reader->has_bad_material = true;
    reader_skip_numbers(reader);
}

static void set_eos(struct material *material, const struct eos *eos, const struct value *constants)
{
    double numbers[KEYWORD_ARGUMENTS];
    for (int i = 0; i < argument_count(eos->arguments); i++)
        numbers[i] = material->eos_number[i] = constants[i].real;
    material->eos = eos;
    material->initial_energy = eos->energy_argument >= 0 ? numbers[eos->energy_argument] : 0;
    eos->prepare(material, numbers);
    if (material->law == &law_null) /* as in the reference, for every type (spec 3.2, Q) */
        material->eos_constant[0] = material->wave_speed;
}

static void read_eos(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    struct scene *scene = reader->scene;
    struct value constants[KEYWORD_ARGUMENTS];
    const struct eos *eos = eos_find(values[1].integer);
    bool good = reader_needs(reader, word, "mate")
             && reader_check_id(reader, &values[0], (long)scene->n_materials, "material");
    if (!eos)
        diagnostics_error(reader->diagnostics, values[1].word.place,
                          "there is no equation of state of type %ld; expected 1 to 4", values[1].integer);
    if (!good || !eos || !reader_values(reader, eos->arguments, "seos", constants))
        fail_eos(reader, word);
    else if (scene->materials[values[0].integer - 1].is_given) /* otherwise its material is wrong or missing */
        set_eos(&scene->materials[values[0].integer - 1].material, eos, constants);
}

static void read_detonation(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    struct scene *scene = reader->scene;
    (void)word;
    scene->detonations = memory_grow(scene->detonations, &scene->detonations_capacity, scene->n_detonations + 1,
                                     sizeof *scene->detonations, "detonation points");
    scene->detonations[scene->n_detonations++] =
        (struct scene_point){{values[0].real, values[1].real, values[2].real}};
}

const struct keyword material_keywords[] = {
    {.name = "mate", .methods = METHODS_TIMED, .long_name = "material", .apply = read_materials,
     .doc = "materials: id, law and its parameters, up to the highest id",
     .details = "mate\n  id law parameters...\nThe last id has to be nmat. The laws:"},
    {.name = "seos", .methods = METHODS_MPM,
     .arguments = (const struct argument[]){{"material", NULL, ARGUMENT_INTEGER, LIMIT_COUNT},
                                            {"type", NULL, ARGUMENT_INTEGER, LIMIT_COUNT}, {0}},
     .apply = read_eos, .fail = fail_eos, .doc = "equation of state of a material; after its mate",
     .details = "seos material type constants...\nThe types:"},
    {.name = "prop", .methods = METHODS_SPH, .arguments = reader_property_arguments, .apply = reader_property,
     .doc = "a property of a material as a table over the temperature, or what it melts and boils at; after its mate",
     .details = "prop material name n T1 v1 ... Tn vn [extr]   (straight lines between; beyond it constant, or with extr along "
                "its last line)\nprop material sahu|melt|boil ...\nThe names:"},
    {.name = "deto", .methods = METHODS_MPM,
     .arguments = (const struct argument[]){{"x", "length", ARGUMENT_REAL, LIMIT_NONE},
                                            {"y", "length", ARGUMENT_REAL, LIMIT_NONE},
                                            {"z", "length", ARGUMENT_REAL, LIMIT_NONE}, {0}},
     .apply = read_detonation, .doc = "a point where explosives are lit; may be repeated"},
    {0}};

void reader_finish_materials(struct reader *reader)
{
    static const char *const other_method[METHOD_COUNT] = {
        [METHOD_MPM] = "law '%s' goes only with 'meth sph'",
        [METHOD_SPH] = "law '%s' goes only with 'meth mpm'; with 'meth sph' take 'flui'",
        [METHOD_RKPM] = "law '%s' is of no use here: the problem has no material",
        [METHOD_DYNAMIC] = "law '%s' does not go with 'prob dynamic'; take fmax, oldr, powl or neoh"};
    const struct scene *scene = reader->scene;
    for (size_t i = 0; i < scene->n_materials && !reader->has_bad_material; i++) {
        const struct scene_material *entry = &scene->materials[i];
        if (!entry->is_given)
            diagnostics_error(reader->diagnostics, reader->materials_place,
                              "material %zu of %ld is not given in 'mate'", i + 1, scene->materials_declared);
        else if (!methods_include(entry->material.law->methods, scene_method(scene)))
            diagnostics_error(reader->diagnostics, entry->place, other_method[scene_method(scene)], entry->material.law->name);
        else if (entry->material.law->needs_eos && !entry->material.eos)
            diagnostics_error(reader->diagnostics, entry->place,
                              "law '%s' needs an equation of state; expected 'seos %zu ...'",
                              entry->material.law->name, i + 1);
    }
}
