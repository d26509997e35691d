/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Material model: the mate block, and later the equations of state. */
#include "base/memory.h"
#include "deck/reader.h"

#include <math.h>
#include <string.h>

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
    int best = 99;
    for (const struct law *const *row = law_rows(); *row; row++) {
        int distance = keyword_distance(word, (*row)->name);
        if (distance >= 0 && distance < best) {
            best = distance;
            found = (*row)->name;
        }
    }
    return found;
}

/* Whether the next word can only be the id of a material: a law follows it, or what seems one. */
static bool next_is_material(struct reader *reader)
{
    struct deck_word id, law;
    long integer;
    double real;
    return text_peek(reader->text, &id) && reader_is_integer(&id, &integer) && text_second(reader->text, &law)
        && !reader_is_real(&law, &real);
}

/* Takes the rest of a material that can't be read. */
static void skip_to_next_material(struct reader *reader)
{
    struct deck_word word;
    double real;
    while (text_peek(reader->text, &word) && !next_is_material(reader) && !reader_is_keyword(&word)
           && (!reader_at_line_end(reader) || reader_is_real(&word, &real)))
        text_next(reader->text, &reader->last);
}

/* Fills a material from the parameters of its law; false (and an error) where they don't fit. */
static bool prepare(struct reader *reader, const struct law *law, const struct deck_word *word,
                    const struct value *values, struct material *material)
{
    *material = (struct material){.law = law};
    for (int i = 0; i < argument_count(law->parameters); i++)
        material->parameter[i] = values[i].real;
    const char *wrong = law->prepare(material);
    if (wrong)
        diagnostics_error(reader->diagnostics, word->place, "law '%s': %s", law->name, wrong);
    else if (!(isfinite(material->wave_speed) && material->wave_speed > 0))
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
        reader->in_materials = true;
        bool good = reader_values(reader, law->parameters, law->name, values);
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

/* Reads `id law parameters`; returns the id, or 0 where it is wrong. `has_ended`: the last material
 * was read before. */
static long read_material(struct reader *reader, bool has_ended)
{
    struct scene *scene = reader->scene;
    struct scene_material nowhere = {0}, *entry = &nowhere;
    struct value id = {0};
    struct deck_word next;
    double real;
    char text[40];
    bool good = false;
    text_peek(reader->text, &id.word);
    if (law_find(text_copy(&id.word, text, sizeof text))) {
        diagnostics_error(reader->diagnostics, id.word.place, "expected a material id before '%s'", text);
    } else {
        text_next(reader->text, &id.word);
        reader->last = id.word;
        if (!reader_is_integer(&id.word, &id.integer))
            diagnostics_error(reader->diagnostics, id.word.place, "expected a material id (a whole number), found '%s'",
                              text_show(&id.word, text, sizeof text));
        else if (has_ended && id.integer >= 1 && id.integer <= scene->materials_declared)
            diagnostics_error(reader->diagnostics, id.word.place,
                              "material %ld comes after material %ld, the last by 'nmat', which ends 'mate'", id.integer,
                              scene->materials_declared);
        else
            good = reader_check_id(reader, &id, scene->materials_declared, "material");
    }
    if (good)
        entry = material_at(scene, (size_t)id.integer - 1);
    if (good || (text_peek(reader->text, &next) && !reader_is_real(&next, &real)))
        entry->is_given = read_law(reader, entry);
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
        diagnostics_error(reader->diagnostics, text_behind(&reader->last), "the deck ends here; expected material %zu of %ld",
                          scene->n_materials + 1, scene->materials_declared);
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

const struct keyword material_keywords[] = {
    {.name = "mate", .long_name = "material", .apply = read_materials,
     .doc = "materials: id, law and its parameters, up to the highest id",
     .details = "mate\n  id law parameters...\nThe last id has to be nmat. The laws:"},
    {.name = "seos", .doc = "equation of state of a material", .later = "equations of state"},
    {.name = "deto", .doc = "detonation point", .later = "explosives"},
    {0}};

void reader_finish_materials(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    for (size_t i = 0; i < scene->n_materials && !reader->has_bad_material; i++)
        if (!scene->materials[i].is_given)
            diagnostics_error(reader->diagnostics, reader->materials_place, "material %zu of %ld is not given in 'mate'",
                              i + 1, scene->materials_declared);
}
