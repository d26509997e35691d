/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Material model: the mate block, and later the equations of state. */
#include "base/memory.h"
#include "deck/reader.h"

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

/* Reads `law parameters` of one material. */
static void read_law(struct reader *reader, struct scene_material *entry)
{
    struct deck_word word;
    struct value values[LAW_PARAMETERS];
    char name[40];
    if (!reader_word(reader, &word, "the name of a law"))
        return;
    const struct law *law = law_find(text_copy(&word, name, sizeof name));
    if (!law || law->later) {
        if (!law)
            reader_unknown(reader, &word, "law", nearest_law(name));
        else
            diagnostics_error(reader->diagnostics, word.place, "law '%s' is not available in this version: %s",
                              law->name, law->later);
        reader_skip_line(reader);
        return;
    }
    entry->place = word.place;
    if (!reader_values(reader, law->parameters, law->name, values))
        return;
    entry->material = (struct material){.law = law};
    for (int i = 0; i < argument_count(law->parameters); i++)
        entry->material.parameter[i] = values[i].real;
    const char *wrong = law->prepare(&entry->material);
    if (wrong)
        diagnostics_error(reader->diagnostics, word.place, "law '%s': %s", law->name, wrong);
    entry->is_given = true;
}

/* The mass cutoff is fixed here, with the cell size known at this moment (spec 3.1). */
static void set_mass_cutoff(struct scene *scene)
{
    double sum = 0, size = scene->cell_size;
    for (size_t i = 0; i < scene->n_materials; i++)
        sum += scene->materials[i].material.density;
    if (scene->materials_declared > 0)
        scene->mass_cutoff = 1e-5 * sum / (double)scene->materials_declared * size * size * size;
}

/* Skips lines until one begins with a material id or a command of the deck. */
static void skip_to_next_material(struct reader *reader)
{
    struct deck_word word;
    char text[40];
    long id;
    for (reader_skip_line(reader); text_peek(reader->text, &word); reader_skip_line(reader)) {
        if (reader_is_integer(&word, &id) || keyword_find(text_copy(&word, text, sizeof text), NULL))
            return;
        text_next(reader->text, &reader->last);
    }
}

static void read_materials(struct reader *reader, const struct deck_word *word, const struct value *values)
{
    (void)values;
    struct scene *scene = reader->scene;
    struct value id = {0};
    char text[40];
    if (!reader->has_materials_declared) {
        diagnostics_error(reader->diagnostics, word->place, "'mate' needs 'nmat' before it");
        return;
    }
    do {
        int errors = diagnostics_errors(reader->diagnostics);
        if (text_peek(reader->text, &id.word) && keyword_find(text_copy(&id.word, text, sizeof text), NULL)) {
            if (scene->n_materials == 0 || scene->materials[scene->n_materials - 1].is_given)
                diagnostics_error(reader->diagnostics, id.word.place,
                                  "'%s' inside the block 'mate'; expected material %zu of %ld", text,
                                  scene->n_materials + 1, scene->materials_declared);
            return;
        }
        if (!reader_word(reader, &id.word, "a material id"))
            return;
        reader->last = id.word;
        if (!reader_is_integer(&id.word, &id.integer)) {
            diagnostics_error(reader->diagnostics, id.word.place, "expected a material id (a whole number), found '%s'",
                              text_copy(&id.word, text, sizeof text));
            id.integer = 0;
        } else if (reader_check_id(reader, &id, scene->materials_declared, "material")) {
            read_law(reader, material_at(scene, (size_t)id.integer - 1));
        }
        if (diagnostics_errors(reader->diagnostics) > errors)
            skip_to_next_material(reader);
    } while (id.integer < scene->materials_declared);
    set_mass_cutoff(scene);
}

const struct keyword material_keywords[] = {
    {.name = "mate", .long_name = "material", .apply = read_materials,
     .doc = "materials: id, law and its parameters, up to the highest id",
     .details = "mate\n  id law parameters...\nThe last id has to be nmat. The laws:"},
    {.name = "seos", .doc = "equation of state of a material", .later = "equations of state"},
    {.name = "deto", .doc = "detonation point", .later = "explosives"},
    {0}};

void reader_finish_materials(struct reader *reader, struct deck_place end)
{
    const struct scene *scene = reader->scene;
    for (size_t i = 0; i < scene->n_materials; i++)
        if (!scene->materials[i].is_given)
            diagnostics_error(reader->diagnostics, end, "material %zu is not given in 'mate'", i + 1);
}
