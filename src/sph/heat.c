/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Heat of smoothed particles: conduction, viscous heat, radiation, evaporation; enthalpy, melting and solidification (spec
 * am-sph 8, 3.3, 19.2).
 *
 * Walls of given temperature: a pair of a particle and a particle of the wall sees the temperature that the wall
 * would have at that place if the line from the particle through the wall's surface went on. The surface lies half
 * a spacing before the outermost layer of the wall's particles. */
#include "base/memory.h"
#include "sph/pair.h"

#include <math.h>

/* Particles in a portion of the sums; neighbours in a batch; lanes of partial sums, the same for every processor. */
enum { PORTION = 1024, BATCH = 64, LANES = 4 };

static const double STEFAN_BOLTZMANN = 5.670374e-8;
/* Part of the vapour that does not come back, in the rate of evaporation. */
static const double NET_EVAPORATION = 0.82;
static const double PI = 3.14159265358979323846;
/* The extrapolated temperature of walls is at most so many times as far from that of the surface (spec 8.1). */
static const double LARGEST_RATIO = 1.5;
/* Particles of a wall that lie no farther aside, in spacings, tell where its surface is. */
static const double ASIDE = 0.8;
/* Relaxation of the excess of density of what has melted takes so many times h/c0 (spec 3.3). */
static const double RELAXATION = 20;

/* A particle beside a wall of given temperature: its conductance to it over its own volume and conductivity, and the heat
 * that comes from there. For a solid beside a wall that stays it holds. */
struct contact {
    int32_t particle;
    const struct scene_wall *wall;
    bool holds;
    double conductance, heat;
};

struct sph_heat {
    double lattice_factor;       /* 1/M: of conduction on the lattice of the start */
    struct sph_powers *portions; /* by portion of the particles */
    struct contact *contacts;
    size_t n_contacts, contacts_capacity;
    long builds;                 /* of the neighbours, for which contacts hold */
};

/* The factor by which pairs on an undisturbed lattice conduct too little, inverted (spec 2: M). */
static double inverse_lattice_factor(const struct sph *sph)
{
    const double dx = sph->spacing, volume = pow(dx, sph->dimension);
    const int reach = (int)ceil(2 * sph->smoothing / dx), deep = sph->dimension == 3 ? reach : 0;
    double sum = 0;
    for (int k = -deep; k <= deep; k++)
        for (int j = -reach; j <= reach; j++)
            for (int i = -reach; i <= reach; i++) {
                const double square = dx * dx * (i * i + j * j + k * k);
                if (square < sph->kernel.reach2)
                    sum -= volume * kernel_slope(&sph->kernel, sqrt(square)) * (i * dx) * (i * dx);
            }
    return 1 / sum;
}

static struct sph_heat *heat_of(struct sph *sph)
{
    if (sph->heat)
        return sph->heat;
    sph->heat = memory_array(1, sizeof *sph->heat, "heat");
    sph->heat->portions = memory_array((sph->store->count + PORTION - 1) / PORTION, sizeof *sph->heat->portions, "heat");
    sph->heat->lattice_factor = inverse_lattice_factor(sph);
    return sph->heat;
}

void heat_free(struct sph *sph)
{
    if (!sph->heat)
        return;
    memory_free(sph->heat->portions);
    memory_free(sph->heat->contacts);
    memory_free(sph->heat);
    sph->heat = NULL;
}

/* --- conduction --- */

/* What the loop over neighbours reads. */
struct conduction {
    const double *x[3], *temperature, *conductivity, *volume, *smoothing;
    const int32_t *state, *list;
    const int64_t *first;
    double inverse_reach, slope, lattice_factor;
    double period; /* along x; 0: none */
    double *rate;
};

/* The heat of pairs per conductance of the kernel: 2 k_a k_b/(k_a + k_b) (T_b - T_a) V_a V_b |F| without the factors that
 * are the same for all pairs. The kernel is cut at its end by a largest value, not by a branch, so that batches run in
 * vectors; each product has its factors in an order that a and b share, so that pairs are antisymmetric to the last bit. */
THREADS_INLINE void heat_of_pairs(const struct conduction *job, size_t a, const int32_t *list, int count, int dimension,
                                  bool varies, bool is_general, double *heat)
{
    const double xa = job->x[0][a], ya = job->x[1][a], za = job->x[2][a];
    const double ta = job->temperature[a], ka = job->conductivity[a], va = job->volume[a], ha = varies ? job->smoothing[a] : 0;
    const bool is_solid = is_general && job->state[a] == SPH_SOLID;
    for (int n = 0; n < count; n++) {
        const int32_t b = list[n];
        const double dx = is_general ? pair_shorter(job->x[0][b] - xa, job->period) : job->x[0][b] - xa;
        const double dy = job->x[1][b] - ya, dz = dimension == 3 ? job->x[2][b] - za : 0;
        const double square = dx * dx + dy * dy + dz * dz, kb = job->conductivity[b];
        const double inverse = varies ? 1 / (ha + job->smoothing[b]) : job->inverse_reach;
        const double cut = 1 - sqrt(square) * inverse, a1 = cut > 0 ? cut : 0;
        double weight = (va * job->volume[b]) * (ka * kb / (ka + kb)) * (a1 * a1 * a1);
        if (varies) /* alpha/h^2 over that of the start: 1/h to the power D + 2 */
            weight *= (inverse * inverse) * (inverse * inverse) * (dimension == 3 ? inverse : 1);
        if (is_general)
            weight *= is_solid && job->state[b] == SPH_SOLID ? job->lattice_factor : 1;
        heat[n] = weight * (job->temperature[b] - ta);
    }
}

THREADS_INLINE void conduct(const struct conduction *job, size_t from, size_t to, int dimension, bool varies, bool is_general)
{
    for (size_t a = from; a < to; a++) {
        double heat[BATCH], sums[LANES] = {0};
        const int64_t end = job->conductivity[a] > 0 ? job->first[a + 1] : job->first[a];
        for (int64_t start = job->first[a]; start < end; start += BATCH) {
            const int count = end - start < BATCH ? (int)(end - start) : BATCH;
            heat_of_pairs(job, a, job->list + start, count, dimension, varies, is_general, heat);
            int n = 0;
            for (; n + LANES <= count; n += LANES)
                for (int l = 0; l < LANES; l++)
                    sums[l] += heat[n + l];
            for (; n < count; n++)
                sums[0] += heat[n];
        }
        job->rate[a] = job->slope * ((sums[0] + sums[1]) + (sums[2] + sums[3]));
    }
}

/* The forms of the loop: plain ones of their own, what is rarer through the general ones. */
THREADS_VECTORISED
static void conduct_flat(const struct conduction *job, size_t from, size_t to)
{
    conduct(job, from, to, 2, false, false);
}

THREADS_VECTORISED
static void conduct_solid(const struct conduction *job, size_t from, size_t to)
{
    conduct(job, from, to, 3, false, false);
}

THREADS_VECTORISED
static void conduct_flat_general(const struct conduction *job, size_t from, size_t to)
{
    conduct(job, from, to, 2, false, true);
}

THREADS_VECTORISED
static void conduct_solid_general(const struct conduction *job, size_t from, size_t to)
{
    conduct(job, from, to, 3, false, true);
}

THREADS_VECTORISED
static void conduct_flat_varying(const struct conduction *job, size_t from, size_t to)
{
    conduct(job, from, to, 2, true, true);
}

THREADS_VECTORISED
static void conduct_solid_varying(const struct conduction *job, size_t from, size_t to)
{
    conduct(job, from, to, 3, true, true);
}

static void conduct_portion(const struct sph *sph, const struct conduction *job, size_t from, size_t to)
{
    const bool is_flat = sph->dimension == 2, is_general = sph->words->corrects_lattice || sph->period > 0;
    if (sph->words->varies_smoothing)
        (is_flat ? conduct_flat_varying : conduct_solid_varying)(job, from, to);
    else if (is_general)
        (is_flat ? conduct_flat_general : conduct_solid_general)(job, from, to);
    else
        (is_flat ? conduct_flat : conduct_solid)(job, from, to);
}

static struct conduction conduction_of(const struct sph *sph)
{
    const struct sph_columns *c = &sph->columns;
    struct conduction job = {{c->x[0], c->x[1], c->x[2]}, c->temperature, c->conductivity, c->volume, c->smoothing, c->state,
                             sph->neighbours->near.list, sph->neighbours->near.first, 0.5 * sph->kernel.inverse,
                             -4 * sph->kernel.slope, sph->words->corrects_lattice ? sph->heat->lattice_factor : 1, sph->period, c->heat_rate};
    if (sph->words->varies_smoothing) /* 1/(2h) of each pair is in the loop */
        job.slope *= pow(2 * sph->smoothing, sph->dimension + 2);
    return job;
}

/* --- walls of given temperature --- */

static const struct scene_wall *warm_wall(const struct sph *sph, size_t p)
{
    const struct scene_wall *wall = sph->columns.state[p] == SPH_WALL ? sph->bodies[sph->columns.body[p]].wall : NULL;
    return wall && wall->heat == WALL_TEMPERATURE ? wall : NULL;
}

/* Whether a particle has this wall, or with NULL any such wall, in its list. */
static bool has_warm_wall(const struct sph *sph, size_t p, const struct scene_wall *wall)
{
    const struct neighbour_lists *near = &sph->neighbours->near;
    if (sph->columns.state[p] == SPH_WALL || sph->columns.state[p] == SPH_REMOVED)
        return false;
    for (int64_t n = near->first[p]; n < near->first[p + 1]; n++) {
        const struct scene_wall *found = warm_wall(sph, (size_t)near->list[n]);
        if (found && (!wall || found == wall))
            return true;
    }
    return false;
}

/* Lists the contact of a particle with each such wall. */
static void list_contacts(const struct sph *sph, struct sph_heat *heat, size_t p)
{
    for (size_t i = 0; i < sph->words->n_walls; i++) {
        const struct scene_wall *wall = &sph->words->walls[i];
        if (wall->heat != WALL_TEMPERATURE || !has_warm_wall(sph, p, wall))
            continue;
        heat->contacts = memory_grow(heat->contacts, &heat->contacts_capacity, heat->n_contacts + 1, sizeof *heat->contacts, "walls");
        heat->contacts[heat->n_contacts++] = (struct contact){.particle = (int32_t)p, .wall = wall};
    }
}

/* They hold as long as the lists. */
static void find_contacts(struct sph *sph, struct sph_heat *heat)
{
    bool has_warm = false;
    for (size_t i = 0; i < sph->words->n_walls; i++)
        has_warm = has_warm || sph->words->walls[i].heat == WALL_TEMPERATURE;
    if (!has_warm || heat->builds == sph->neighbours->builds)
        return;
    heat->builds = sph->neighbours->builds;
    heat->n_contacts = 0;
    for (size_t p = 0; p < sph->store->count; p++)
        if (has_warm_wall(sph, p, NULL))
            list_contacts(sph, heat, p);
}

/* A pair within reach of the kernel, in loops that are not hot. */
static bool find_pair(const struct sph *sph, size_t a, size_t b, struct pair *pair)
{
    return pair_of(sph, a, b, sph->dimension, sph->words->varies_smoothing, pair);
}

/* Direction from the wall to particle a: minus the gradient of what the wall fills. False where it has none. */
static bool wall_direction(const struct sph *sph, size_t a, double normal[3])
{
    const struct neighbour_lists *near = &sph->neighbours->near;
    double scale = 0;
    normal[0] = normal[1] = normal[2] = 0;
    for (int64_t n = near->first[a]; n < near->first[a + 1]; n++) {
        const size_t b = (size_t)near->list[n];
        struct pair pair;
        if (!warm_wall(sph, b) || !find_pair(sph, a, b, &pair))
            continue;
        const double weight = -sph->columns.volume[b] * pair.slope;
        scale += weight * sqrt(pair.square);
        for (int i = 0; i < 3; i++)
            normal[i] += weight * pair.d[i];
    }
    const double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    if (!(length > 0.01 * scale))
        return false;
    for (int i = 0; i < 3; i++)
        normal[i] /= length;
    return true;
}

/* Height of particle a above the wall's surface: half a spacing less than above the nearest of the wall's particles
 * below it. */
static double wall_distance(const struct sph *sph, size_t a, const double normal[3])
{
    const struct neighbour_lists *near = &sph->neighbours->near;
    const double aside = ASIDE * sph->spacing;
    double least = INFINITY;
    for (int64_t n = near->first[a]; n < near->first[a + 1]; n++) {
        struct pair pair;
        pair_way(sph, a, (size_t)near->list[n], sph->dimension, &pair);
        const double height = pair_dot(pair.d, normal, 3);
        if (warm_wall(sph, (size_t)near->list[n]) && height > 0 && pair.square - height * height < aside * aside)
            least = fmin(least, height);
    }
    return fmax(isfinite(least) ? least - 0.5 * sph->spacing : 0, 0.5 * sph->spacing);
}

/* Conductance of the contact of particle a with a wall, from the places of now. All walls of given temperature beside it
 * tell where their surface is. */
static void find_conductance(const struct sph *sph, size_t a, struct contact *contact)
{
    const struct neighbour_lists *near = &sph->neighbours->near;
    double normal[3];
    const bool has_direction = wall_direction(sph, a, normal);
    const double distance = has_direction ? wall_distance(sph, a, normal) : 0;
    contact->conductance = 0;
    contact->holds = sph->columns.state[a] == SPH_SOLID && !sph_wall_moves(contact->wall);
    for (int64_t n = near->first[a]; n < near->first[a + 1]; n++) {
        const size_t b = (size_t)near->list[n];
        double ratio = 1;
        struct pair pair;
        if (warm_wall(sph, b) != contact->wall || !find_pair(sph, a, b, &pair))
            continue;
        if (has_direction) {
            const double depth = pair_dot(pair.d, normal, 3) - distance;
            ratio = fmin(fmax(depth, 0.5 * sph->spacing) / distance, LARGEST_RATIO);
        }
        contact->conductance += -2 * sph->columns.volume[b] * (1 + ratio) * pair.slope;
    }
}

/* Heat that flows from a wall of given temperature into particle a. */
static double heat_from_wall(const struct sph *sph, size_t a, struct contact *contact)
{
    const struct sph_columns *c = &sph->columns;
    if (!contact->holds || c->state[a] != SPH_SOLID)
        find_conductance(sph, a, contact);
    const double factor = sph->words->corrects_lattice && c->state[a] == SPH_SOLID ? sph->heat->lattice_factor : 1;
    return factor * c->volume[a] * c->conductivity[a] * contact->conductance * (contact->wall->temperature - c->temperature[a]);
}

static double add_heat_from_walls(struct sph *sph, struct sph_heat *heat)
{
    double sum = 0;
#pragma omp parallel for schedule(static) if (sph->is_shared)
    for (size_t i = 0; i < heat->n_contacts; i++) {
        const size_t p = (size_t)heat->contacts[i].particle;
        heat->contacts[i].heat = sph->columns.state[p] == SPH_REMOVED ? 0 : heat_from_wall(sph, p, &heat->contacts[i]);
    }
    for (size_t i = 0; i < sph->words->n_walls; i++)
        sph->body_heat[sph->words->walls[i].body] = 0;
    for (size_t i = 0; i < heat->n_contacts; i++) {
        const struct contact *contact = &heat->contacts[i];
        sph->columns.heat_rate[contact->particle] += contact->heat;
        sph->body_heat[contact->wall->body] += contact->heat;
        sum += contact->heat;
    }
    return sum;
}

/* --- heat that comes and goes on its own --- */

/* Heat by viscosity in particle a: its half of what pairs dissipate, in the form of the viscous force (spec 4.2).
 * Walls and solids count with mirrored velocities, so that this half is all that they dissipate. */
static double viscous_heat(const struct sph *sph, size_t a)
{
    const struct neighbour_lists *near = &sph->neighbours->near;
    const struct sph_columns *c = &sph->columns;
    const bool is_morris = sph->words->viscosity == VISCOSITY_MORRIS;
    const double least = PAIR_LEAST_SQUARE * sph->smoothing * sph->smoothing, own = c->viscosity[a];
    double sum = 0;
    for (int64_t n = near->first[a]; n < near->first[a + 1]; n++) {
        const size_t b = (size_t)near->list[n];
        double along = 0, speed = 0;
        struct pair pair;
        const double both = own + c->viscosity[b];
        if (!(both > 0) || !find_pair(sph, a, b, &pair))
            continue;
        for (int i = 0; i < sph->dimension; i++) {
            const double u = sph->seen[i][a] - sph->seen[i][b];
            along += u * pair.d[i];
            speed += u * u;
        }
        const double mean = 2 * own * c->viscosity[b] / both;
        const double shear = is_morris ? 2 * speed : 2 * (sph->dimension + 2) * along * along / (pair.square + least);
        sum -= 0.5 * c->volume[a] * c->volume[b] * mean * shear * pair.slope;
    }
    return sum;
}

/* Mass of vapour per area and time over the surface at a temperature (spec 19.2). */
static double vapour_flow(const struct sph *sph, const struct properties *properties, double temperature)
{
    const double pressure = properties_vapour_pressure(properties, temperature, sph->words->ambient_pressure);
    if (!(pressure > 0 && temperature > 0))
        return 0;
    return NET_EVAPORATION * pressure * sqrt(properties->molar_mass / (2 * PI * PROPERTIES_GAS_CONSTANT * temperature));
}

/* Area of the surface that particle p stands for: its volume times the wide normal, which sums up to 1 in depth. */
static double surface_area(const struct sph *sph, size_t p)
{
    double *const *n = sph->columns.wide_normal;
    if (!n[0])
        return 0;
    return sph->columns.volume[p] * sqrt(n[0][p] * n[0][p] + n[1][p] * n[1][p] + (sph->dimension == 3 ? n[2][p] * n[2][p] : 0));
}

/* Before the first step no surface is known: as much of it as a particle may have. */
static double largest_area(const struct sph *sph, size_t p)
{
    return 2 * sph->columns.volume[p] / (sph->words->wide_smoothing * sph->spacing);
}

double heat_loss_rate(const struct sph *sph, size_t p)
{
    const struct scene_sph *words = sph->words;
    const struct sph_columns *c = &sph->columns;
    const struct properties *properties = sph->bodies[c->body[p]].properties;
    const double temperature = c->temperature[p], area = sph->step > 0 ? surface_area(sph, p) : largest_area(sph, p);
    double slope = 0;
    if (!(area > 0 && temperature > 0) || (c->state[p] != SPH_FLUID && c->state[p] != SPH_SOLID))
        return 0;
    if (words->radiates)
        slope += 4 * STEFAN_BOLTZMANN * words->emissivity * temperature * temperature * temperature;
    if (words->evaporates && c->liquid[p] > 0)
        slope += vapour_flow(sph, properties, temperature) * properties->vaporisation_heat * properties->molar_mass
               * properties->vaporisation_heat / (PROPERTIES_GAS_CONSTANT * temperature * temperature);
    return slope * area / (c->mass[p] * properties_least_capacity(properties));
}

/* Adds to the rate of particle p what does not come from conduction, and to the sums. */
static void add_sources(const struct sph *sph, size_t p, struct sph_powers *sums)
{
    const struct scene_sph *words = sph->words;
    const struct sph_columns *c = &sph->columns;
    const struct properties *properties = sph->bodies[c->body[p]].properties;
    const double temperature = c->temperature[p], area = words->radiates || words->evaporates ? surface_area(sph, p) : 0;
    double radiated = 0, evaporated = 0, viscous = 0;
    if (words->radiates && area > 0) {
        const double square = temperature * temperature, ambient = words->ambient * words->ambient;
        radiated = STEFAN_BOLTZMANN * words->emissivity * (square * square - ambient * ambient) * area;
    }
    if (words->evaporates && area > 0 && c->liquid[p] > 0) {
        const double mass = vapour_flow(sph, properties, temperature) * area;
        evaporated = mass * properties->vaporisation_heat;
        sums->evaporated_mass += mass;
    }
    if (words->heats_by_viscosity && !words->freezes_flow && c->state[p] == SPH_FLUID)
        viscous = viscous_heat(sph, p);
    const double by_volume = words->volume_heat * c->volume[p];
    c->heat_rate[p] += viscous + by_volume - radiated - evaporated;
    sums->radiated += radiated;
    sums->evaporated += evaporated;
    sums->viscous_heat += viscous;
    sums->volume_heat += by_volume;
}

/* --- the step --- */

static void sum_portions(struct sph *sph, const struct sph_heat *heat, size_t portions, double through_walls)
{
    struct sph_powers *powers = &sph->powers;
    powers->radiated = powers->evaporated = powers->viscous_heat = powers->volume_heat = powers->evaporated_mass = 0;
    powers->through_walls = through_walls;
    for (size_t k = 0; k < portions; k++) {
        powers->radiated += heat->portions[k].radiated;
        powers->evaporated += heat->portions[k].evaporated;
        powers->viscous_heat += heat->portions[k].viscous_heat;
        powers->volume_heat += heat->portions[k].volume_heat;
        powers->evaporated_mass += heat->portions[k].evaporated_mass;
    }
}

void heat_flow(struct sph *sph)
{
    struct sph_heat *heat = heat_of(sph);
    const struct conduction job = conduction_of(sph);
    const int32_t *state = sph->columns.state;
    const size_t count = sph->store->count, portions = (count + PORTION - 1) / PORTION;
    find_contacts(sph, heat);
#pragma omp parallel for schedule(static) if (sph->is_shared)
    for (size_t k = 0; k < portions; k++) {
        const size_t from = k * PORTION, to = from + PORTION < count ? from + PORTION : count;
        struct sph_powers sums = {0};
        conduct_portion(sph, &job, from, to);
        for (size_t p = from; p < to; p++)
            if (state[p] == SPH_FLUID || state[p] == SPH_SOLID)
                add_sources(sph, p, &sums);
        heat->portions[k] = sums;
    }
    sum_portions(sph, heat, portions, add_heat_from_walls(sph, heat));
}

/* Enthalpy and temperature after a step with the rates of now. */
static void warm(const struct sph *sph, size_t p, double time_step)
{
    const struct sph_columns *c = &sph->columns;
    const struct properties *properties = sph->bodies[c->body[p]].properties;
    const double power = c->heat_rate[p] + (c->laser_power ? c->laser_power[p] : 0);
    const double gain = time_step * power / c->mass[p];
    if (sph->words->heat == HEAT_APPARENT) {
        c->temperature[p] += gain / properties_capacity(properties, c->temperature[p]);
        c->enthalpy[p] = properties_enthalpy(properties, c->temperature[p]);
    } else {
        c->enthalpy[p] += gain;
        c->temperature[p] = properties_temperature(properties, c->enthalpy[p]);
    }
    c->liquid[p] = properties_liquid(properties, c->temperature[p]);
}

/* A particle that melts while it has more mass than its volume holds at that temperature would burst. The offset takes
 * that excess out of the pressure and lets it in slowly; without relaxation, as the dissertation does, all but the
 * part that a sound speed smaller by melt_sound_factor would give (spec 3.3). */
static double offset_of_melt(const struct sph *sph, size_t p, double time)
{
    const struct scene_sph *words = sph->words;
    const double factor = words->melt_sound_factor, kept = words->relaxes_excess ? 0 : factor > 0 ? factor * factor : 1;
    return (1 - kept) * (sph->columns.density[p] - heat_reference_density(sph, p, time));
}

/* What was solid and has some liquid becomes fluid, and the other way round. */
static void change_state(const struct sph *sph, size_t p, double time)
{
    const struct sph_columns *c = &sph->columns;
    const bool is_fluid = c->state[p] == SPH_FLUID;
    if (!sph->bodies[c->body[p]].properties->melts || is_fluid == (c->liquid[p] > 0))
        return;
    c->state[p] = is_fluid ? SPH_SOLID : SPH_FLUID;
    c->excess_offset[p] = is_fluid ? 0 : offset_of_melt(sph, p, time);
    if (c->opened)
        c->opened[p] = 0;
    for (int i = 0; i < 3; i++)
        c->v[i][p] = c->a[i][p] = 0;
}

static void add_to_budget(struct sph *sph, double time_step)
{
    const struct sph_powers *powers = &sph->powers;
    struct sph_budget *budget = &sph->budget;
    budget->laser_in += time_step * powers->laser_in;
    budget->absorbed += time_step * powers->absorbed;
    budget->reflected += time_step * powers->reflected;
    budget->transmitted += time_step * powers->transmitted;
    budget->radiated += time_step * powers->radiated;
    budget->evaporated += time_step * powers->evaporated;
    budget->through_walls += time_step * powers->through_walls;
    budget->viscous_heat += time_step * powers->viscous_heat;
    budget->volume_heat += time_step * powers->volume_heat;
    budget->evaporated_mass += time_step * powers->evaporated_mass;
}

void heat_advance(struct sph *sph, double time_step)
{
    const struct sph_columns *c = &sph->columns;
    const size_t count = sph->store->count;
    const double left = exp(-time_step * sph->sound_speed / (RELAXATION * sph->smoothing));
#pragma omp parallel for schedule(static) if (sph->is_shared)
    for (size_t p = 0; p < count; p++) {
        if (c->state[p] != SPH_FLUID && c->state[p] != SPH_SOLID)
            continue;
        c->excess_offset[p] *= left;
        warm(sph, p, time_step);
        change_state(sph, p, sph->time + time_step);
        if (c->fused && c->liquid[p] >= 0.5)
            c->fused[p] = sph->bodies[c->body[p]].properties->melts;
    }
    add_to_budget(sph, time_step);
}
