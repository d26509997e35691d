/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Builds and frees what a run of smoothed particles owns. */
#include "base/memory.h"
#include "base/scatter.h"
#include "deck/diagnostics.h"
#include "sph/sph.h"

#include <float.h>
#include <math.h>

/* Lists reach so far beyond where pairs act, in spacings. */
static const double SKIN = 0.25;
/* With varying smoothing length: how much longer than at the start it may become. */
static const double LONGEST = 1.5;
/* Fewer particles than this are not worth a second thread. */
enum { SHARED_PARTICLES = 4000 };

/* --- what the scene needs --- */

static bool has_heat(const struct scene_sph *words)
{
    return words->heat != HEAT_OFF;
}

static bool needs_band(const struct scene_sph *words)
{
    return words->surface != SURFACE_OFF || words->has_marangoni || words->radiates || words->evaporates;
}

/* Whether a free surface expands by heat. */
static bool expands_openly(const struct scene_sph *words)
{
    return words->opens_expansion && has_heat(words) && !words->freezes_flow;
}

static bool needs_normals(const struct scene_sph *words)
{
    return needs_band(words) || expands_openly(words) || words->shifting > 0;
}

static uint64_t wanted_columns(const struct scene *scene)
{
    static const enum column always[] = {COLUMN_POSITION, COLUMN_VELOCITY, COLUMN_VOLUME, COLUMN_MASS, COLUMN_DENSITY,
                                         COLUMN_REFERENCE_DENSITY, COLUMN_PRESSURE, COLUMN_EXCESS_OFFSET, COLUMN_SMOOTHING_LENGTH,
                                         COLUMN_VISCOSITY, COLUMN_SHEPARD, COLUMN_ACCELERATION, COLUMN_LISTED_POSITION,
                                         COLUMN_TEMPERATURE, COLUMN_LIQUID, COLUMN_ID, COLUMN_BODY, COLUMN_STATE};
    static const enum column of_heat[] = {COLUMN_ENTHALPY, COLUMN_CONDUCTIVITY, COLUMN_HEAT_RATE};
    static const enum column of_band[] = {COLUMN_WIDE_NORMAL, COLUMN_WIDE_SHEPARD, COLUMN_CURVATURE};
    const struct scene_sph *words = &scene->sph;
    uint64_t wanted = 0;
    for (size_t i = 0; i < sizeof always / sizeof always[0]; i++)
        wanted |= column_bit(always[i]);
    for (size_t i = 0; i < sizeof of_heat / sizeof of_heat[0] && has_heat(words); i++)
        wanted |= column_bit(of_heat[i]);
    for (size_t i = 0; i < sizeof of_band / sizeof of_band[0] && needs_band(words); i++)
        wanted |= column_bit(of_band[i]);
    if (needs_normals(words))
        wanted |= column_bit(COLUMN_NORMAL);
    if (expands_openly(words))
        wanted |= column_bit(COLUMN_OPENED);
    if (words->beam.is_on)
        wanted |= column_bit(COLUMN_LASER_POWER);
    if (words->ejected_above > 0)
        wanted |= column_bit(COLUMN_PARTED);
    if (words->diffuses_gradient)
        wanted |= column_bit(COLUMN_EXCESS_GRADIENT);
    if (scene->writes_vtk)
        wanted |= column_bit(COLUMN_INITIAL_POSITION);
    for (size_t i = 0; i < scene->n_results; i++)
        for (const enum column *c = scene->results[i]->columns; *c != COLUMN_NONE; c++)
            wanted |= column_bit(*c);
    for (size_t i = 0; i < scene->n_curves; i++)
        for (const enum column *c = scene->curves[i].result->columns; *c != COLUMN_NONE; c++)
            wanted |= column_bit(*c);
    return wanted;
}

/* --- bodies --- */

static void create_bodies(struct sph *sph, const struct scene *scene)
{
    const struct scene_sph *words = &scene->sph;
    sph->bodies = memory_array(scene->n_bodies, sizeof *sph->bodies, "bodies");
    sph->body_heat = memory_array(scene->n_bodies, sizeof *sph->body_heat, "bodies");
    sph->material_of_body = memory_array(scene->n_bodies, sizeof *sph->material_of_body, "bodies");
    sph->material_number_of_body = memory_array(scene->n_bodies, sizeof *sph->material_number_of_body, "bodies");
    for (size_t b = 0; b < scene->n_bodies; b++) {
        const int material = scene->bodies[b].generator.material;
        sph->bodies[b].properties = &scene->materials[material].properties;
        sph->material_of_body[b] = &scene->materials[material].material;
        sph->material_number_of_body[b] = material + 1;
    }
    for (size_t i = 0; i < words->n_walls; i++)
        sph->bodies[words->walls[i].body].wall = &words->walls[i];
    for (size_t i = 0; i < words->n_swellings; i++)
        sph->bodies[words->swellings[i].body].swelling = &words->swellings[i];
    for (size_t i = 0; i < scene->n_loads; i++)
        for (int a = 0; a < 3 && scene->loads[i].kind == LOAD_GRAVITY; a++)
            sph->bodies[scene->loads[i].target].gravity[a] = scene->loads[i].value[a];
}

/* --- particles --- */

struct filling {
    struct sph *sph;
    size_t next;
    int32_t body;
    double temperature;
};

static enum sph_state state_at_start(const struct sph_body *body, double temperature)
{
    if (body->wall)
        return SPH_WALL;
    return body->properties->melts && temperature <= body->properties->solidus ? SPH_SOLID : SPH_FLUID;
}

/* Density that sets the mass: of solids at the solidus, where it is said so (spec 3.3). */
static double density_of_mass(const struct sph *sph, const struct sph_body *body, double temperature)
{
    const struct properties *properties = body->properties;
    const bool is_at_solidus = sph->words->mass == MASS_AT_SOLIDUS && properties->melts && temperature < properties->solidus;
    return property_value(&properties->tables[PROPERTY_DENSITY], is_at_solidus ? properties->solidus : temperature);
}

static void fill_particle(void *context, const double position[3], double mass)
{
    struct filling *filling = context;
    struct sph *sph = filling->sph;
    struct store *store = sph->store;
    const struct sph_body *body = &sph->bodies[filling->body];
    const size_t p = filling->next++;
    const double cube = mass / sph->material_of_body[filling->body]->density;
    const double volume = sph->dimension == 2 ? pow(cube, 2.0 / 3) : cube;
    const double density = density_of_mass(sph, body, filling->temperature);
    const enum sph_state state = state_at_start(body, filling->temperature);
    for (int a = 0; a < 3; a++) {
        const bool is_scattered = a < sph->dimension && (state == SPH_FLUID || (state == SPH_SOLID && sph->words->jitters_solids));
        const double jitter = is_scattered ? sph->words->jitter * pow(volume, 1.0 / sph->dimension) : 0;
        store->real[COLUMN_POSITION][a][p] = position[a] + 2 * jitter * scatter((uint64_t)sph->words->seed, p, (uint64_t)a);
        store->real[COLUMN_VELOCITY][a][p] = body->wall ? body->wall->velocity[a] : 0;
    }
    store->real[COLUMN_MASS][0][p] = density * volume;
    store->real[COLUMN_VOLUME][0][p] = volume;
    store->real[COLUMN_DENSITY][0][p] = density;
    store->real[COLUMN_SHEPARD][0][p] = 1;
    store->real[COLUMN_TEMPERATURE][0][p] = filling->temperature;
    store->real[COLUMN_LIQUID][0][p] = properties_liquid(body->properties, filling->temperature);
    if (store_has(store, COLUMN_ENTHALPY))
        store->real[COLUMN_ENTHALPY][0][p] = properties_enthalpy(body->properties, filling->temperature);
    store->integer[COLUMN_ID][p] = store->index_of_id[p] = (int32_t)p;
    store->integer[COLUMN_BODY][p] = filling->body;
    store->integer[COLUMN_STATE][p] = (int32_t)state;
    if (store_has(store, COLUMN_FUSED))
        store->integer[COLUMN_FUSED][p] = body->properties->melts && state == SPH_FLUID && store->real[COLUMN_LIQUID][0][p] >= 0.5;
}

static double temperature_of_body(const struct scene_sph *words, size_t body)
{
    double temperature = column_row(COLUMN_TEMPERATURE)->initial;
    for (size_t i = 0; i < words->n_walls; i++)
        if ((size_t)words->walls[i].body == body && words->walls[i].heat == WALL_TEMPERATURE)
            temperature = words->walls[i].temperature;
    for (size_t i = 0; i < words->n_temperatures; i++)
        if ((size_t)words->temperatures[i].body == body)
            temperature = words->temperatures[i].value;
    return temperature;
}

/* Stretches a body about the middle of its particles. */
static void stretch(struct sph *sph, const struct scene_stretch *row)
{
    const struct scene_body *body = &sph->scene->bodies[row->body];
    for (int a = 0; a < 3; a++) {
        double *x = sph->store->real[COLUMN_POSITION][a] + body->first, middle = 0;
        for (long k = 0; k < body->count; k++)
            middle += x[k] / (double)body->count;
        for (long k = 0; k < body->count; k++)
            x[k] = middle + row->factor[a] * (x[k] - middle);
    }
}

/* Of fluid: solids stay, and walls have velocities of their own. */
static void set_velocity(struct sph *sph, const struct scene_velocity *row)
{
    const struct scene_body *body = row->kind == VELOCITY_BODY ? &sph->scene->bodies[row->target] : NULL;
    const long first = body ? body->first : row->target, count = body ? body->count : 1;
    for (long id = first; id < first + count; id++)
        for (int a = 0; a < sph->dimension && sph->store->integer[COLUMN_STATE][id] == SPH_FLUID; a++)
            sph->store->real[COLUMN_VELOCITY][a][id] = row->value[a];
}

static void create_particles(struct sph *sph)
{
    const struct scene *scene = sph->scene;
    struct store *store = sph->store = store_open((size_t)scene->n_particles, wanted_columns(scene));
    struct filling filling = {.sph = sph};
    for (size_t b = 0; b < scene->n_bodies; b++) {
        filling.body = (int32_t)b;
        filling.temperature = temperature_of_body(sph->words, b);
        scene->bodies[b].generator.row->visit(&scene->bodies[b].generator, fill_particle, &filling);
    }
    for (size_t i = 0; i < sph->words->n_stretches; i++)
        stretch(sph, &sph->words->stretches[i]);
    for (size_t i = 0; i < scene->n_velocities; i++)
        set_velocity(sph, &scene->velocities[i]);
    double volume = DBL_MAX;
    for (size_t p = 0; p < store->count; p++)
        volume = fmin(volume, store->real[COLUMN_VOLUME][0][p]);
    sph->spacing = pow(volume, 1.0 / sph->dimension);
    sph->smoothing = sph->words->smoothing * sph->spacing;
    for (size_t p = 0; p < store->count; p++) {
        store->real[COLUMN_SMOOTHING_LENGTH][0][p] = sph->smoothing;
        for (int a = 0; a < 3 && store_has(store, COLUMN_INITIAL_POSITION); a++)
            store->real[COLUMN_INITIAL_POSITION][a][p] = store->real[COLUMN_POSITION][a][p];
    }
}

void sph_bind(struct sph *sph)
{
    struct store *store = sph->store;
    double **const single[][2] = {
        {&sph->columns.mass, store->real[COLUMN_MASS]},
        {&sph->columns.volume, store->real[COLUMN_VOLUME]},
        {&sph->columns.density, store->real[COLUMN_DENSITY]},
        {&sph->columns.reference, store->real[COLUMN_REFERENCE_DENSITY]},
        {&sph->columns.pressure, store->real[COLUMN_PRESSURE]},
        {&sph->columns.excess_offset, store->real[COLUMN_EXCESS_OFFSET]},
        {&sph->columns.opened, store->real[COLUMN_OPENED]},
        {&sph->columns.smoothing, store->real[COLUMN_SMOOTHING_LENGTH]},
        {&sph->columns.viscosity, store->real[COLUMN_VISCOSITY]},
        {&sph->columns.shepard, store->real[COLUMN_SHEPARD]},
        {&sph->columns.wide_shepard, store->real[COLUMN_WIDE_SHEPARD]},
        {&sph->columns.curvature, store->real[COLUMN_CURVATURE]},
        {&sph->columns.temperature, store->real[COLUMN_TEMPERATURE]},
        {&sph->columns.enthalpy, store->real[COLUMN_ENTHALPY]},
        {&sph->columns.liquid, store->real[COLUMN_LIQUID]},
        {&sph->columns.conductivity, store->real[COLUMN_CONDUCTIVITY]},
        {&sph->columns.heat_rate, store->real[COLUMN_HEAT_RATE]},
        {&sph->columns.laser_power, store->real[COLUMN_LASER_POWER]},
    };
    for (size_t i = 0; i < sizeof single / sizeof single[0]; i++)
        *single[i][0] = *single[i][1];
    for (int a = 0; a < 3; a++) {
        sph->columns.x[a] = store->real[COLUMN_POSITION][a];
        sph->columns.v[a] = store->real[COLUMN_VELOCITY][a];
        sph->columns.a[a] = store->real[COLUMN_ACCELERATION][a];
        sph->columns.excess_gradient[a] = store->real[COLUMN_EXCESS_GRADIENT][a];
        sph->columns.normal[a] = store->real[COLUMN_NORMAL][a];
        sph->columns.wide_normal[a] = store->real[COLUMN_WIDE_NORMAL][a];
    }
    sph->columns.state = store->integer[COLUMN_STATE];
    sph->columns.body = store->integer[COLUMN_BODY];
    sph->columns.fused = store->integer[COLUMN_FUSED];
    sph->columns.parted = sph->words->ejected_above > 0 ? store->integer[COLUMN_PARTED] : NULL;
}

/* --- numbers --- */

static void choose_numbers(struct sph *sph)
{
    const struct scene_sph *words = sph->words;
    sph->kernel = kernel_of(sph->smoothing, sph->dimension);
    sph->wide = kernel_of(words->wide_smoothing * sph->spacing, sph->dimension);
    sph->self_value = kernel_value(&sph->kernel, 0);
    sph->courant = words->courant > 0 ? words->courant : words->integrator == INTEGRATOR_STAGGERED ? 0.4 : 0.1;
    sph->sound_speed = words->sound_speed > 0 ? words->sound_speed : sound_of_scene(sph);
    sph->first_sound = sph->sound_speed;
    sph->needs_normals = needs_normals(words);
    for (size_t p = 0; p < sph->store->count; p++)
        sph->has_fixed = sph->has_fixed || sph->columns.state[p] != SPH_FLUID;
    for (size_t b = 0; b < sph->scene->n_bodies; b++) {
        const struct sph_body *body = &sph->bodies[b];
        sph->has_fixed = sph->has_fixed || body->properties->melts; /* what is liquid now may solidify */
        sph->has_moving_walls = sph->has_moving_walls || (body->wall && sph_wall_moves(body->wall));
    }
}

static void create_work(struct sph *sph)
{
    const size_t count = sph->store->count;
    double **const arrays[] = {&sph->work[0], &sph->work[1], &sph->work[2], &sph->seen[0], &sph->seen[1],
                               &sph->seen[2], &sph->fluid_volume, &sph->excess, &sph->rate};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++)
        *arrays[i] = memory_array(count, sizeof(double), "particles");
    if (sph->has_fixed)
        sph->beside = memory_array(count, sizeof *sph->beside, "walls");
    sph->removed = sph->scene->writes_lost ? memory_array(count, sizeof *sph->removed, "particles that left") : NULL;
    if (!needs_band(sph->words))
        return;
    sph->band = memory_array(count, sizeof *sph->band, "the surface");
    sph->is_kept = memory_array(count, sizeof *sph->is_kept, "the surface");
    sph->ring = memory_array(count, sizeof *sph->ring, "the surface");
    sph->saw_motion = memory_array(count, sizeof *sph->saw_motion, "the surface");
    sph->saw_wide_motion = memory_array(count, sizeof *sph->saw_wide_motion, "the surface");
}

/* Where there is no pressure yet: the density is that of the reference, and gravity alone accelerates. */
static void start_fluid(struct sph *sph)
{
    const struct sph_columns *c = &sph->columns;
    heat_properties(sph);
    for (size_t p = 0; p < sph->store->count; p++) {
        if (c->state[p] != SPH_FLUID)
            continue;
        c->density[p] = c->reference[p];
        c->volume[p] = c->mass[p] / c->density[p];
        for (int a = 0; a < sph->dimension; a++)
            c->a[a][p] = sph->bodies[c->body[p]].gravity[a];
    }
}

void sph_share_always(struct sph *sph)
{
    sph->is_shared = sph->neighbours->is_shared = true;
}

struct sph *sph_open(struct scene *scene, struct timers *timers, struct diagnostics *diagnostics)
{
    struct sph *sph = memory_array(1, sizeof *sph, "the run");
    (void)diagnostics;
    sph->scene = scene;
    sph->words = &scene->sph;
    sph->timers = timers;
    sph->dimension = (int)scene->sph.dimension;
    create_bodies(sph, scene);
    create_particles(sph);
    sph_bind(sph);
    choose_numbers(sph);
    create_work(sph);
    const double longest = sph->words->varies_smoothing ? LONGEST : 1;
    sph->neighbours = neighbours_open(sph->store, sph->dimension, 2 * sph->smoothing * longest,
                                      needs_band(sph->words) ? 2 * sph->words->wide_smoothing * sph->spacing * longest : 0, SKIN * sph->spacing);
    if (scene->sph.is_periodic) {
        sph->period = scene->grid[1] - scene->grid[0];
        neighbours_repeat(sph->neighbours, scene->grid[0], sph->period);
    }
    if (sph->store->count >= SHARED_PARTICLES)
        sph_share_always(sph);
    start_fluid(sph);
    budget_update(sph);
    sph->start_heat = sph->budget.heat;
    sph->first_time_step = sph->time_step = limits_time_step(sph);
    return sph;
}

void sph_close(struct sph *sph)
{
    if (!sph)
        return;
    double *const arrays[] = {sph->work[0], sph->work[1], sph->work[2], sph->seen[0], sph->seen[1],
                              sph->seen[2], sph->fluid_volume, sph->excess, sph->rate};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++)
        memory_free(arrays[i]);
    memory_free(sph->beside);
    memory_free(sph->removed);
    memory_free(sph->clusters);
    memory_free(sph->band);
    memory_free(sph->is_kept);
    memory_free(sph->ring);
    memory_free(sph->saw_motion);
    memory_free(sph->saw_wide_motion);
    heat_free(sph);
    laser_free(sph);
    memory_free(sph->portions);
    memory_free(sph->bodies);
    memory_free(sph->body_heat);
    memory_free(sph->material_of_body);
    memory_free(sph->material_number_of_body);
    neighbours_close(sph->neighbours);
    store_close(sph->store);
    memory_free(sph);
}
