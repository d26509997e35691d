/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "deck/scene.h"
#include "base/memory.h"

struct scene *scene_open(void)
{
    struct scene *scene = memory_array(1, sizeof *scene, "the scene");
    scene->components = 1;
    scene->step_scale = 0.9;
    scene->scheme = SCHEME_MUSL;
    scene->rotation = ROTATION_EXPLICIT;
    scene->bulk[0] = 1.5;
    scene->bulk[1] = 0.06;
    scene->sorts = true;
    scene->digits = 7;
    scene->flip_share = 1;
    scene->settling[0] = 100;
    scene->settling[1] = 0;
    scene->mass_scale = 1;
    scene->building = (struct scene_building){.settling = -1, .until = -1, .axis = 2};
    scene->sph = (struct scene_sph){.dimension = 3, .smoothing = 1.2, .wide_smoothing = 1.8, .density_diffusion = 0.1,
                                    .corrects_depth = true, .holds_films = true, .opens_expansion = true, .surface_threshold = 0.1, .melt_sound_factor = 1, .seed = 1};
    scene->rkpm = (struct scene_rkpm){.dimension = 2, .beta = 100, .beta_over_spacing = true, .dynamic = {.stabilisation = -1}};
    return scene;
}

void scene_close(struct scene *scene)
{
    if (!scene)
        return;
    for (size_t b = 0; b < scene->n_bodies; b++)
        generator_close(&scene->bodies[b].generator);
    for (size_t i = 0; i < scene->n_materials; i++) {
        properties_close(&scene->materials[i].properties);
        memory_free(scene->materials[i].material.elements);
    }
    memory_free(scene->title);
    memory_free(scene->job);
    memory_free(scene->materials);
    memory_free(scene->bodies);
    memory_free(scene->loads);
    memory_free(scene->velocities);
    memory_free(scene->detonations);
    memory_free(scene->results);
    memory_free(scene->curves);
    memory_free(scene->building.ghosts);
    memory_free(scene->building.angles);
    memory_free(scene->holds);
    memory_free(scene->sph.beam.pieces);
    memory_free(scene->sph.walls);
    memory_free(scene->sph.temperatures);
    memory_free(scene->sph.swellings);
    memory_free(scene->sph.stretches);
    memory_free(scene->rkpm.refinements);
    memory_free(scene->rkpm.refinement_places);
    memory_free(scene->rkpm.levels);
    memory_free(scene->rkpm.file);
    memory_free(scene->rkpm.places);
    memory_free(scene);
}

enum method_name scene_method(const struct scene *scene)
{
    return scene->method == METHOD_RKPM && scene->rkpm.problem == PROBLEM_DYNAMIC ? METHOD_DYNAMIC : scene->method;
}
