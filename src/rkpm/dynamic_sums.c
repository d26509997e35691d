/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums and extremes after a step, and how long the next one may be. */
#include "rkpm/dynamic.h"

#include <float.h>
#include <math.h>

static void sum_motion(const struct dynamic *dynamic, struct dynamic_sums *sums)
{
    double square = 0, total[3] = {0}, weighted[3] = {0};
    for (int a = 0; a < dynamic->dimension; a++)
        for (size_t n = 0; n < dynamic->count; n++) {
            const double v = dynamic->velocity[a][n];
            square += v * v;
            total[a] += v;
            weighted[a] += dynamic->coefficient[a][n];
        }
    sums->kinetic = 0.5 * dynamic->mass * square;
    for (int a = 0; a < 3; a++) {
        sums->momentum[a] = dynamic->mass * total[a];
        sums->centre[a] = weighted[a] / (double)dynamic->count;
    }
}

/* About z through the centre of mass; the angle is that of the best rotation of the places at the start. */
static void sum_turning(const struct dynamic *dynamic, struct dynamic_sums *sums)
{
    const double *start = dynamic->words->dynamic.lattice.centre;
    double angular = 0, across = 0, along = 0;
    for (size_t n = 0; n < dynamic->count; n++) {
        const double x = dynamic->coefficient[0][n] - sums->centre[0], y = dynamic->coefficient[1][n] - sums->centre[1];
        const double x0 = dynamic->rest[0][n] - start[0], y0 = dynamic->rest[1][n] - start[1];
        angular += x * dynamic->velocity[1][n] - y * dynamic->velocity[0][n];
        across += x0 * y - y0 * x;
        along += x0 * x + y0 * y;
    }
    sums->angular = dynamic->mass * angular;
    sums->turn = atan2(across, along);
}

static void sum_nodes(const struct dynamic *dynamic, struct dynamic_sums *sums)
{
    const struct store *store = dynamic->store;
    const double *volume = store->real[COLUMN_VOLUME][0], *energy = store->real[COLUMN_ENERGY][0];
    double least = DBL_MAX, most = -DBL_MAX, internal = 0;
    long worst = -1, not_finite = -1;
    for (size_t n = 0; n < dynamic->count; n++) {
        internal += energy[n];
        most = volume[n] > most ? volume[n] : most;
        if (volume[n] < least) {
            least = volume[n];
            worst = (long)n;
        }
        double sum = volume[n] + energy[n];
        for (int a = 0; a < dynamic->dimension; a++)
            sum += dynamic->coefficient[a][n] + dynamic->velocity[a][n] + dynamic->acceleration[a][n];
        if (!isfinite(sum) && not_finite < 0)
            not_finite = (long)n;
    }
    sums->internal = internal;
    sums->least_ratio = least / dynamic->volume;
    sums->most_ratio = most / dynamic->volume;
    sums->is_finite = not_finite < 0;
    sums->least_node = worst;
    sums->bad_node = not_finite < 0 ? worst : not_finite;
}

static void find_ends(const struct dynamic *dynamic, struct dynamic_sums *sums)
{
    for (int a = 0; a < dynamic->dimension; a++) {
        const double *x = dynamic->store->real[COLUMN_POSITION][a];
        double low = x[0], high = x[0];
        for (size_t n = 1; n < dynamic->count; n++) {
            low = x[n] < low ? x[n] : low;
            high = x[n] > high ? x[n] : high;
        }
        sums->low[a] = low;
        sums->high[a] = high;
    }
}

static void sum_wall(const struct dynamic *dynamic, struct dynamic_sums *sums)
{
    const double stiffness = rkpm_dynamic_stiffness(dynamic);
    sums->wall_force = sums->wall_energy = 0;
    for (size_t n = dynamic->count; n < dynamic->nodes; n++)
        sums->wall_force += dynamic->wall_force[n];
    for (size_t n = 0; n < dynamic->count && dynamic->words->dynamic.wall == RKPM_WALL_SPRING; n++) {
        sums->wall_force += dynamic->wall_force[n];
        sums->wall_energy += 0.5 * dynamic->wall_force[n] * dynamic->wall_force[n] / stiffness;
    }
}

static long count_few(const struct dynamic *dynamic)
{
    long count = 0;
    for (size_t n = 0; n < dynamic->nodes; n++)
        count += (n < dynamic->count || dynamic->fixed.is_active[dynamic->slot[n]]) && (dynamic->nodal.is_lowered[n] || dynamic->nodal.reach[n] > 1);
    return count;
}

void rkpm_dynamic_sum(struct dynamic *dynamic)
{
    struct dynamic_sums *sums = &dynamic->sums;
    sum_motion(dynamic, sums);
    if (dynamic->follows_turning)
        sum_turning(dynamic, sums);
    if (dynamic->follows_extent)
        find_ends(dynamic, sums);
    sum_nodes(dynamic, sums);
    sum_wall(dynamic, sums);
    sums->few_neighbours = count_few(dynamic);
}

/* --- the time step --- */

/* Parts of the time in which a wave crosses the spacing, or a shear spreads over it (spec 7). */
static const double COURANT = 0.5, DIFFUSION = 0.125;
/* Parts of a spacing that a node comes nearer to a wall in a step, of a radian that its springs swing in it; strain of a step. */
static const double APPROACH = 0.25, SWING = 0.5, STRAIN = 0.1;

/* The least stretch of a plane deformation, its smaller singular value. */
static double least_stretch_2(double a, double b, double c, double d)
{
    return 0.5 * fabs(hypot(a + d, c - b) - hypot(a - d, b + c));
}

/* That of any, from the smallest eigenvalue of F^T F by Cardano's formula; it is right to rounding of the largest one. */
static double least_stretch_3(double f[3][3])
{
    static const double THIRD_TURN = 2.0943951023931954923;
    double c[6], square = 0;
    for (int a = 0; a < 3; a++)
        c[a] = f[0][a] * f[0][a] + f[1][a] * f[1][a] + f[2][a] * f[2][a];
    c[3] = f[0][1] * f[0][2] + f[1][1] * f[1][2] + f[2][1] * f[2][2];
    c[4] = f[0][0] * f[0][2] + f[1][0] * f[1][2] + f[2][0] * f[2][2];
    c[5] = f[0][0] * f[0][1] + f[1][0] * f[1][1] + f[2][0] * f[2][1];
    const double mean = (c[0] + c[1] + c[2]) / 3;
    for (int a = 0; a < 3; a++) {
        c[a] -= mean;
        square += c[a] * c[a] + 2 * c[3 + a] * c[3 + a];
    }
    const double p = sqrt(square / 6);
    if (!(p > 0))
        return sqrt(mean);
    const double determinant = c[0] * (c[1] * c[2] - c[3] * c[3]) - c[5] * (c[5] * c[2] - c[3] * c[4]) + c[4] * (c[5] * c[3] - c[1] * c[4]);
    const double angle = acos(fmax(-1, fmin(1, 0.5 * determinant / (p * p * p)))) / 3;
    return sqrt(fmax(mean + 2 * p * cos(angle + THIRD_TURN), 0));
}

static double least_stretch(const struct dynamic *dynamic)
{
    const struct store *store = dynamic->store;
    double least = DBL_MAX;
#pragma omp parallel for schedule(static) reduction(min : least) if (dynamic->count >= DYNAMIC_FEW_NODES)
    for (size_t n = 0; n < dynamic->count; n++) {
        double f[3][3];
        for (int a = 0; a < 9; a++)
            f[a / 3][a % 3] = store->real[COLUMN_DEFORMATION][a][n] + (a % 4 == 0);
        least = fmin(least, dynamic->dimension == 2 ? least_stretch_2(f[0][0], f[0][1], f[1][0], f[1][1]) : least_stretch_3(f));
    }
    return least;
}

/* A wall is met within spacings, however fast nodes come; its springs swing. */
static double wall_limit(const struct dynamic *dynamic)
{
    const struct scene_dynamic *words = &dynamic->words->dynamic;
    double fastest = 0;
    if (words->wall == RKPM_WALL_NONE)
        return DBL_MAX;
    for (size_t n = 0; n < dynamic->count; n++)
        fastest = fmax(fastest, fabs(dynamic->velocity[words->wall_axis][n]));
    const double met = fastest > 0 ? APPROACH * dynamic->spacing / fastest : DBL_MAX;
    return words->wall == RKPM_WALL_SPRING ? fmin(met, SWING * sqrt(dynamic->mass / rkpm_dynamic_stiffness(dynamic))) : met;
}

/* Strains and turns of a step are small, however fast they come: as much of those of the last one as fits in; at the start the spin. */
static double strain_limit(const struct dynamic *dynamic)
{
    const double spin = fabs(dynamic->words->dynamic.spin);
    double most = 0;
    if (dynamic->step == 0)
        return spin > 0 ? STRAIN / spin : DBL_MAX;
    for (int a = 0; a < 6; a++)
        for (size_t n = 0; n < dynamic->count; n++)
            most = fmax(most, fabs(a < 3 ? fmax(fabs(dynamic->strain[a][n]), fabs(dynamic->spin[a][n])) : dynamic->strain[a][n]));
    return most > 0 ? STRAIN / most * dynamic->time_step : DBL_MAX;
}

double rkpm_dynamic_limit(const struct dynamic *dynamic)
{
    const struct material *material = dynamic->material;
    if (dynamic->scene->fixed_step > 0)
        return dynamic->scene->fixed_step;
    const double length = least_stretch(dynamic) * dynamic->spacing, wave = COURANT * length / material->wave_speed;
    const double motion = fmin(wall_limit(dynamic), strain_limit(dynamic)), least = fmin(wave, motion);
    return material->viscosity > 0 ? fmin(least, DIFFUSION * length * length * material->density / material->viscosity) : least;
}
