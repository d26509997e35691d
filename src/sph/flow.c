/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Flow of the fluid: density, pressure, walls, forces between particles (spec am-sph 3 to 5). */
#include "sph/pair.h"
#include "sph/sph.h"

#include <math.h>
#include <string.h>

/* Matrices of gradients with a smaller determinant are singular: there is no neighbour on some side. */
static const double LEAST_DETERMINANT = 0.05;
/* Particles with more of their surroundings filled are away from the surface. */
static const double INSIDE = 0.95;
/* Shifting moves no farther in a step, in spacings. */
static const double LARGEST_SHIFT = 0.05;

/* Particles of a state tell all within their reach; threads that meet write the same. */
static void tell_neighbours(struct sph *sph, int32_t state, unsigned char what)
{
    const struct neighbour_lists *near = &sph->neighbours->near;
    const size_t count = sph->store->count;
#pragma omp parallel for schedule(dynamic, 512) if (sph->is_shared)
    for (size_t a = 0; a < count; a++) {
        if (sph->columns.state[a] != state || !sph_moves(sph, a))
            continue;
        for (int64_t n = near->first[a]; n < near->first[a + 1]; n++) {
            unsigned char *told = &sph->beside[near->list[n]], known;
#pragma omp atomic read
            known = *told;
            if (known == what)
                continue;
#pragma omp atomic write
            *told = what;
        }
    }
}

void flow_surroundings(struct sph *sph)
{
    if (!sph->has_fixed)
        return;
    memset(sph->beside, BESIDE_NOTHING, sph->store->count);
    if (sph->has_moving_walls)
        tell_neighbours(sph, SPH_WALL, BESIDE_WALL);
    tell_neighbours(sph, SPH_FLUID, BESIDE_FLUID);
}

void flow_prepare(struct sph *sph)
{
    const struct sph_columns *c = &sph->columns;
    const double ahead = sph->words->integrator == INTEGRATOR_PREDICTED ? 0.5 * sph->taken_step : 0;
    const bool keeps_reference = sph->words->diffuses_reference;
    const size_t count = sph->store->count;
#pragma omp parallel for schedule(static) if (sph->is_shared)
    for (size_t p = 0; p < count; p++) {
        const bool is_fluid = c->state[p] == SPH_FLUID;
        for (int a = 0; a < 3; a++)
            sph->seen[a][p] = is_fluid ? c->v[a][p] + ahead * c->a[a][p] : c->v[a][p];
        sph->fluid_volume[p] = is_fluid ? c->volume[p] : 0;
        sph->excess[p] = is_fluid ? c->density[p] - (keeps_reference ? 0 : sph_rest_density(c, p)) : 0;
    }
}

/* --- gradients of the excess --- */

/* Solves m g = r for a symmetric matrix xx yy zz yz xz xy; g is 0 where it is singular. */
static void solve(const double m[6], const double r[3], int dimension, double g[3])
{
    if (dimension == 2) {
        const double determinant = m[0] * m[1] - m[5] * m[5];
        const double scale = determinant < LEAST_DETERMINANT ? 0 : 1 / determinant;
        g[0] = scale * (m[1] * r[0] - m[5] * r[1]);
        g[1] = scale * (m[0] * r[1] - m[5] * r[0]);
        g[2] = 0;
        return;
    }
    const double c0 = m[1] * m[2] - m[3] * m[3], c1 = m[3] * m[4] - m[5] * m[2], c2 = m[5] * m[3] - m[1] * m[4];
    const double determinant = m[0] * c0 + m[5] * c1 + m[4] * c2;
    const double scale = determinant < LEAST_DETERMINANT ? 0 : 1 / determinant;
    g[0] = scale * (c0 * r[0] + c1 * r[1] + c2 * r[2]);
    g[1] = scale * (c1 * r[0] + (m[0] * m[2] - m[4] * m[4]) * r[1] + (m[4] * m[5] - m[0] * m[3]) * r[2]);
    g[2] = scale * (c2 * r[0] + (m[4] * m[5] - m[0] * m[3]) * r[1] + (m[0] * m[1] - m[5] * m[5]) * r[2]);
}

THREADS_INLINE void gradient_of(const struct sph *sph, size_t a, int dimension, bool varies)
{
    const struct neighbour_lists *near = &sph->neighbours->near;
    double matrix[6] = {0}, right[3] = {0}, gradient[3];
    for (int64_t n = near->first[a]; n < near->first[a + 1]; n++) {
        const size_t b = (size_t)near->list[n];
        struct pair pair;
        if (!pair_of(sph, a, b, dimension, varies, &pair))
            continue;
        const double weight = sph->fluid_volume[b] * pair.slope, change = weight * (sph->excess[b] - sph->excess[a]);
        for (int i = 0; i < dimension; i++)
            right[i] += change * pair.d[i];
        matrix[0] -= weight * pair.d[0] * pair.d[0];
        matrix[1] -= weight * pair.d[1] * pair.d[1];
        matrix[5] -= weight * pair.d[0] * pair.d[1];
        if (dimension == 3) {
            matrix[2] -= weight * pair.d[2] * pair.d[2];
            matrix[3] -= weight * pair.d[1] * pair.d[2];
            matrix[4] -= weight * pair.d[0] * pair.d[2];
        }
    }
    solve(matrix, right, dimension, gradient);
    for (int i = 0; i < 3; i++)
        sph->columns.excess_gradient[i][a] = gradient[i];
}

THREADS_INLINE void all_gradients(const struct sph *sph, int dimension, bool varies)
{
    const size_t count = sph->store->count;
#pragma omp parallel for schedule(dynamic, 512) if (sph->is_shared)
    for (size_t p = 0; p < count; p++)
        if (sph->columns.state[p] == SPH_FLUID)
            gradient_of(sph, p, dimension, varies);
}

void flow_gradients(struct sph *sph)
{
    if (sph->words->diffuses_gradient)
        RUN_FORM(all_gradients, sph);
}

/* --- density --- */

/* Continuity with diffusion (3.14, 3.15 as corrected), Shepard sum and normal of particle a. */
THREADS_INLINE void rate_of(const struct sph *sph, size_t a, int dimension, bool varies)
{
    const struct neighbour_lists *near = &sph->neighbours->near;
    const struct sph_columns *c = &sph->columns;
    const bool with_gradient = sph->words->diffuses_gradient, is_adjoint = sph->words->pressure == PRESSURE_SHEPARD;
    const double self = varies ? kernel_of(c->smoothing[a], dimension).value : sph->self_value;
    double divergence = 0, diffusion = 0, filled = c->volume[a] * self, normal[3] = {0};
    for (int64_t n = near->first[a]; n < near->first[a + 1]; n++) {
        const size_t b = (size_t)near->list[n];
        struct pair pair;
        if (!pair_of(sph, a, b, dimension, varies, &pair))
            continue;
        const double volume = c->volume[b], slope = volume * pair.slope;
        double u[3] = {0};
        for (int i = 0; i < dimension; i++) {
            u[i] = sph->seen[i][a] - sph->seen[i][b];
            normal[i] += slope * pair.d[i];
        }
        filled += volume * pair.value;
        divergence += slope * pair_dot(u, pair.d, dimension) / (is_adjoint ? c->shepard[b] : 1);
        double change = 2 * (sph->excess[b] - sph->excess[a]);
        if (with_gradient)
            for (int i = 0; i < dimension; i++)
                change += (c->excess_gradient[i][a] + c->excess_gradient[i][b]) * pair.d[i];
        diffusion -= sph->fluid_volume[b] * change * pair.slope;
    }
    sph->rate[a] = c->density[a] * divergence
                 + sph->words->density_diffusion * (varies ? c->smoothing[a] : sph->smoothing) * sph->sound_speed * diffusion;
    sph->work[0][a] = filled;
    for (int i = 0; i < 3 && sph->needs_normals; i++)
        c->normal[i][a] = 2 * normal[i];
}

THREADS_INLINE void all_rates(const struct sph *sph, int dimension, bool varies)
{
    const size_t count = sph->store->count;
#pragma omp parallel for schedule(dynamic, 512) if (sph->is_shared)
    for (size_t p = 0; p < count; p++)
        if (sph->columns.state[p] == SPH_FLUID)
            rate_of(sph, p, dimension, varies);
}

/* A density from the continuity equation. What flies alone has no pressure, whatever the way there has left it; what
 * came off the metal tears where it would be pulled. */
static double density_of(const struct sph *sph, size_t p, double density)
{
    const struct sph_columns *c = &sph->columns;
    const double rest = sph_rest_density(c, p);
    if (c->shepard[p] <= sph_own_part(sph, p))
        return rest;
    return c->parted && c->parted[p] == SPH_CAME_OFF && density < rest ? rest : density;
}

void flow_density(struct sph *sph, double time_step)
{
    const struct sph_columns *c = &sph->columns;
    const double square = sph->sound_speed * sph->sound_speed;
    const size_t count = sph->store->count;
    RUN_FORM(all_rates, sph);
#pragma omp parallel for schedule(static) if (sph->is_shared)
    for (size_t p = 0; p < count; p++) {
        if (c->state[p] != SPH_FLUID)
            continue;
        c->shepard[p] = sph->work[0][p];
        c->density[p] = density_of(sph, p, c->density[p] + time_step * sph->rate[p]);
        c->volume[p] = c->mass[p] / c->density[p];
        c->pressure[p] = square * (c->density[p] - sph_rest_density(c, p));
        if (sph->words->varies_smoothing)
            c->smoothing[p] = sph->smoothing * pow(c->volume[p] / pow(sph->spacing, sph->dimension), 1.0 / sph->dimension);
    }
}

/* --- walls --- */

/* The acceleration that a column of fluid hangs on: gravity, or what of it reduced pressure leaves. */
THREADS_INLINE double weight_factor(const struct sph *sph, size_t p)
{
    return sph->words->reduces_pressure ? 1 - sph->words->reference_density / sph->columns.reference[p] : 1;
}

/* Pressure, mirrored velocity and viscosity of a particle of a wall or solid, from the fluid around it (spec 5). */
THREADS_INLINE void mirror(const struct sph *sph, size_t w, int dimension, bool varies)
{
    const struct neighbour_lists *near = &sph->neighbours->near;
    const struct sph_columns *c = &sph->columns;
    const int64_t end = sph->beside[w] == BESIDE_FLUID ? near->first[w + 1] : near->first[w];
    double sum = 0, pressure = 0, viscosity = 0, velocity[3] = {0};
    for (int64_t n = near->first[w]; n < end; n++) {
        const size_t b = (size_t)near->list[n];
        struct pair pair;
        if (c->state[b] != SPH_FLUID || !pair_of(sph, w, b, dimension, varies, &pair))
            continue;
        const double *gravity = sph->bodies[c->body[b]].gravity;
        sum += pair.value;
        pressure += (c->pressure[b] + c->density[b] * weight_factor(sph, b) * pair_dot(gravity, pair.d, dimension)) * pair.value;
        viscosity += c->viscosity[b] * pair.value;
        for (int i = 0; i < dimension; i++)
            velocity[i] += sph->seen[i][b] * pair.value;
    }
    const struct scene_wall *wall = sph->bodies[c->body[w]].wall;
    const double scale = sum > 0 ? 1 / sum : 0;
    pressure *= scale;
    c->pressure[w] = wall && wall->no_stick && pressure < 0 ? 0 : pressure;
    c->viscosity[w] = viscosity * scale;
    for (int i = 0; i < 3; i++)
        sph->work[i][w] = sum > 0 ? 2 * c->v[i][w] - velocity[i] * scale : c->v[i][w];
}

THREADS_INLINE void mirror_all(const struct sph *sph, int dimension, bool varies)
{
    const size_t count = sph->store->count;
#pragma omp parallel for schedule(dynamic, 512) if (sph->is_shared)
    for (size_t p = 0; p < count; p++)
        if (sph->columns.state[p] == SPH_WALL || sph->columns.state[p] == SPH_SOLID)
            mirror(sph, p, dimension, varies);
}

void flow_walls(struct sph *sph)
{
    const size_t count = sph->store->count;
    if (!sph->has_fixed)
        return;
    RUN_FORM(mirror_all, sph);
#pragma omp parallel for schedule(static) if (sph->is_shared)
    for (size_t p = 0; p < count; p++)
        for (int i = 0; i < 3 && (sph->columns.state[p] == SPH_WALL || sph->columns.state[p] == SPH_SOLID); i++)
            sph->seen[i][p] = sph->work[i][p];
}

/* --- forces --- */

/* Acceleration of particle a by pressure, viscosity and gravity (spec 4). */
THREADS_INLINE void force_on(const struct sph *sph, size_t a, int dimension, bool varies)
{
    const struct neighbour_lists *near = &sph->neighbours->near;
    const struct sph_columns *c = &sph->columns;
    const bool is_symmetric = sph->words->pressure == PRESSURE_SYMMETRIC, is_morris = sph->words->viscosity == VISCOSITY_MORRIS;
    const double least = PAIR_LEAST_SQUARE * sph->smoothing * sph->smoothing, own_shepard = c->shepard[a], viscosity = c->viscosity[a];
    const bool cuts = sph->words->cuts_tension && c->pressure[a] < 0 && own_shepard > INSIDE;
    const double own_pressure = cuts ? -c->pressure[a] : c->pressure[a];
    double force[3] = {0};
    for (int64_t n = near->first[a]; n < near->first[a + 1]; n++) {
        const size_t b = (size_t)near->list[n];
        struct pair pair;
        if (!pair_of(sph, a, b, dimension, varies, &pair))
            continue;
        const double slope = c->volume[b] * pair.slope;
        const double both = viscosity + c->viscosity[b], mean = both > 0 ? 2 * viscosity * c->viscosity[b] / both : 0;
        double pressure = is_symmetric ? own_pressure + c->pressure[b]
                                       : c->pressure[b] / own_shepard + own_pressure / c->shepard[b];
        double u[3] = {0};
        for (int i = 0; i < dimension; i++)
            u[i] = sph->seen[i][a] - sph->seen[i][b];
        if (is_morris)
            for (int i = 0; i < dimension; i++)
                force[i] += 2 * mean * slope * u[i];
        else
            pressure -= mean * (2 * (dimension + 2)) * pair_dot(u, pair.d, dimension) / (pair.square + least);
        for (int i = 0; i < dimension; i++)
            force[i] -= pressure * slope * pair.d[i];
    }
    const double *gravity = sph->bodies[c->body[a]].gravity;
    for (int i = 0; i < 3; i++)
        c->a[i][a] = force[i] / c->density[a] + weight_factor(sph, a) * gravity[i];
}

THREADS_INLINE void all_forces(const struct sph *sph, int dimension, bool varies)
{
    const size_t count = sph->store->count;
#pragma omp parallel for schedule(dynamic, 512) if (sph->is_shared)
    for (size_t p = 0; p < count; p++)
        if (sph->columns.state[p] == SPH_FLUID)
            force_on(sph, p, dimension, varies);
}

void flow_forces(struct sph *sph)
{
    RUN_FORM(all_forces, sph);
}

/* --- motion --- */

/* Away from the crowd, inside the fluid only (spec 19.1). */
static double shift_of(const struct sph *sph, size_t p, int axis, double time_step)
{
    const double most = LARGEST_SHIFT * sph->spacing;
    const double way = -sph->words->shifting * sph->smoothing * time_step * sph->budget.fastest * sph->columns.normal[axis][p];
    return way > most ? most : way < -most ? -most : way;
}

/* What the drag of the mush leaves of a velocity: exp(-K dt), K = K0 (1 - s)^2/(s^3 + 1e-3) (spec 10). */
static double left_by_mush(const struct sph *sph, size_t p, double time_step)
{
    const double s = sph->columns.liquid[p];
    return exp(-time_step * sph->words->mush_drag * (1 - s) * (1 - s) / (s * s * s + 1e-3));
}

void flow_advance(struct sph *sph, double half_steps, double time_step)
{
    const struct sph_columns *c = &sph->columns;
    const size_t count = sph->store->count;
    const bool shifts = sph->words->shifting > 0, stays = sph->words->freezes_flow;
#pragma omp parallel for schedule(static) if (sph->is_shared)
    for (size_t p = 0; p < count; p++) {
        if (c->state[p] != SPH_FLUID) {
            for (int i = 0; i < sph->dimension && c->state[p] == SPH_WALL; i++)
                c->x[i][p] += time_step * c->v[i][p];
            continue;
        }
        const bool is_inside = shifts && c->shepard[p] > INSIDE;
        const double left = sph->words->mush_drag > 0 ? left_by_mush(sph, p, time_step) : 1;
        for (int i = 0; i < sph->dimension && !stays; i++) {
            c->v[i][p] = left * (c->v[i][p] + half_steps * c->a[i][p]);
            c->x[i][p] += time_step * c->v[i][p] + (is_inside ? shift_of(sph, p, i, time_step) : 0);
        }
    }
}
