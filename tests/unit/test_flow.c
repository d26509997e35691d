/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists of neighbours against all pairs, momentum of the forces between particles, channel flow, threads. */
#include "base/memory.h"
#include "base/threads.h"
#include "check.h"
#include "random.h"
#include "sph/sph.h"

#include <stdlib.h>
#include <string.h>

/* --- lists --- */

/* Particles anywhere in a box, some of them in one place; one flies far away. */
static struct store *scatter(size_t count, int dimension)
{
    struct store *store = store_open(count, column_bit(COLUMN_POSITION) | column_bit(COLUMN_LISTED_POSITION) | column_bit(COLUMN_ID)
                                                | column_bit(COLUMN_STATE));
    struct random random = {7};
    for (size_t p = 0; p < count; p++) {
        for (int a = 0; a < dimension; a++)
            store->real[COLUMN_POSITION][a][p] = p % 50 == 1 ? 2 : 10 * random_between(&random, 0, 1);
        store->integer[COLUMN_ID][p] = store->index_of_id[p] = (int32_t)p;
        store->integer[COLUMN_STATE][p] = p % 97 == 3 ? SPH_REMOVED : SPH_FLUID;
    }
    store->real[COLUMN_POSITION][1][count - 1] = 1e7;
    return store;
}

static bool is_near(const struct store *store, size_t p, size_t q, double reach, double period)
{
    double square = 0;
    for (int a = 0; a < 3; a++) {
        double d = fabs(store->real[COLUMN_POSITION][a][p] - store->real[COLUMN_POSITION][a][q]);
        if (a == 0 && period > 0)
            d = fmin(d, period - d);
        square += d * d;
    }
    return square < reach * reach;
}

/* Every pair that is near is listed once from both sides, and no particle that is gone. */
static bool are_complete(const struct neighbours *neighbours, const struct neighbour_lists *lists, double period)
{
    const struct store *store = neighbours->store;
    for (size_t p = 0; p < store->count; p++)
        for (size_t q = 0; q < store->count; q++) {
            long listed = 0;
            for (int64_t n = lists->first[p]; n < lists->first[p + 1]; n++)
                listed += lists->list[n] == (int32_t)q;
            const bool are_there = store->integer[COLUMN_STATE][p] != SPH_REMOVED && store->integer[COLUMN_STATE][q] != SPH_REMOVED;
            if (listed != (p != q && are_there && is_near(store, p, q, lists->reach + neighbours->skin, period)))
                return false;
        }
    return true;
}

static void test_lists(int dimension, double period, const char *name)
{
    struct store *store = scatter(600, dimension);
    struct neighbours *neighbours = neighbours_open(store, dimension, 0.7, 1.1, 0.1);
    if (period > 0)
        neighbours_repeat(neighbours, 0, period);
    bool is_good = neighbours_follow(neighbours);
    is_good = is_good && are_complete(neighbours, &neighbours->near, period) && are_complete(neighbours, &neighbours->wide, period);
    check_true(name, is_good);
    for (size_t p = 0; p < store->count; p++)
        store->real[COLUMN_POSITION][0][p] += 0.049;
    check_true("lists hold within half the skin", !neighbours_follow(neighbours));
    store->real[COLUMN_POSITION][0][5] += 0.002;
    check_true("and are made anew beyond it", neighbours_follow(neighbours) && are_complete(neighbours, &neighbours->near, period));
    neighbours_restore(neighbours);
    check_true("made again without sorting they are the same", are_complete(neighbours, &neighbours->near, period));
    neighbours_close(neighbours);
    store_close(store);
}

/* --- scenes --- */

static void set_table(struct property_table *table, double value)
{
    table->count = table->capacity = 1;
    table->temperatures = memory_array(1, sizeof(double), "a test");
    table->values = memory_array(1, sizeof(double), "a test");
    table->values[0] = value;
}

static void add_block(struct scene *scene, const double corner[2], long nx, long ny, double spacing)
{
    struct scene_body *body = &scene->bodies[scene->n_bodies];
    body->generator = (struct generator){.row = generator_find("bloc"), .density = 1000, .spacing = spacing,
                                         .number = {corner[0], corner[1], 0, (double)nx, (double)ny, 1}};
    body->first = scene->n_particles;
    body->count = nx * ny;
    scene->n_particles += body->count;
    scene->n_bodies++;
}

/* Water between two plates, `cells` particles across 1 mm, periodic along x; or a free piece of it. */
static struct scene *channel(int cells, double smoothing, bool has_walls, enum viscous_form form)
{
    struct scene *scene = scene_open();
    const double dx = 1e-3 / cells;
    const long along = 12, layers = 4;
    scene->method = METHOD_SPH;
    scene->materials = memory_array(1, sizeof *scene->materials, "a test");
    scene->n_materials = 1;
    scene->materials[0].material.density = 1000;
    set_table(&scene->materials[0].properties.tables[PROPERTY_DENSITY], 1000);
    set_table(&scene->materials[0].properties.tables[PROPERTY_VISCOSITY], 1e-3);
    scene->bodies = memory_array(3, sizeof *scene->bodies, "a test");
    scene->sph.dimension = 2;
    scene->sph.smoothing = smoothing;
    scene->sph.wide_smoothing = 1.8;
    scene->sph.sound_speed = 5e-3;
    scene->sph.density_diffusion = 0.1;
    scene->sph.viscosity = form;
    scene->end_time = 1e9;
    for (int a = 0; a < 6; a++)
        scene->grid[a] = a % 2 ? 1 : -1;
    add_block(scene, (double[]){0, 0}, along, cells, dx);
    scene->loads = memory_array(1, sizeof *scene->loads, "a test");
    if (!has_walls)
        return scene;
    add_block(scene, (double[]){0, -(double)layers * dx}, along, layers, dx);
    add_block(scene, (double[]){0, 1e-3}, along, layers, dx);
    scene->sph.walls = memory_array(2, sizeof *scene->sph.walls, "a test");
    scene->sph.n_walls = 2;
    scene->sph.walls[0].body = 1;
    scene->sph.walls[1].body = 2;
    scene->sph.is_periodic = true;
    scene->grid[0] = 0, scene->grid[1] = (double)along * dx;
    scene->n_loads = 1;
    scene->loads[0].kind = LOAD_GRAVITY;
    scene->loads[0].value[0] = 1e-3;
    return scene;
}

/* Largest speed along x after two times h^2/nu, over g h^2/(8 nu) = 1.25e-4 (less than one in 1e8 of it is missing then). */
static double channel_speed(double smoothing, enum viscous_form form)
{
    struct scene *scene = channel(16, smoothing, true, form);
    struct timers timers;
    timers_start(&timers);
    struct sph *sph = sph_open(scene, &timers, NULL);
    while (sph->time < 2)
        sph_step(sph);
    const double speed = sph->budget.fastest / 1.25e-4;
    sph_close(sph);
    scene_close(scene);
    return speed;
}

/* On a lattice the middle rows lie half a spacing beside the middle: 1 - 1/256 of the largest speed; the factors are those of the
 * lattice (spec 2: 1/0.9974 and 1/0.8859 at h/dx 1.5) and of the plates (spec 16 V09b: Morris within 2 %, Monaghan within 12 %). */
static void test_channel(void)
{
    check_near("channel, Morris, h/dx 1.5: speed over the exact one", channel_speed(1.5, VISCOSITY_MORRIS), 1, 0.02);
    check_near("channel, Morris, h/dx 1.2", channel_speed(1.2, VISCOSITY_MORRIS), 1, 0.045);
    check_near("channel, Monaghan, h/dx 1.5", channel_speed(1.5, VISCOSITY_MONAGHAN), 1.06, 0.06);
}

/* A free piece that moves wildly: the sum of m a over the sum of |m a|. */
static double momentum_left(enum viscous_form form, enum pressure_form pressure)
{
    struct scene *scene = channel(16, 1.2, false, form);
    struct timers timers;
    timers_start(&timers);
    scene->sph.jitter = 0.2;
    scene->sph.pressure = pressure;
    struct sph *sph = sph_open(scene, &timers, NULL);
    struct random random = {3};
    for (size_t p = 0; p < sph->store->count; p++) {
        sph->columns.density[p] = 1000 + 10 * random_between(&random, 0, 1);
        for (int a = 0; a < 2; a++)
            sph->columns.v[a][p] = 1e-4 * random_between(&random, 0, 1);
    }
    sph_step(sph);
    double sum[2] = {0, 0}, sizes = 0;
    for (size_t p = 0; p < sph->store->count; p++)
        for (int a = 0; a < 2; a++) {
            sum[a] += sph->columns.mass[p] * sph->columns.a[a][p];
            sizes += sph->columns.mass[p] * fabs(sph->columns.a[a][p]);
        }
    sph_close(sph);
    scene_close(scene);
    return (fabs(sum[0]) + fabs(sum[1])) / sizes;
}

static void test_momentum(void)
{
    check_near("momentum, Monaghan's viscosity", momentum_left(VISCOSITY_MONAGHAN, PRESSURE_SYMMETRIC), 0, 1e-13);
    check_near("momentum, Morris's viscosity", momentum_left(VISCOSITY_MORRIS, PRESSURE_SYMMETRIC), 0, 1e-13);
    check_near("momentum, pressure over Shepard sums", momentum_left(VISCOSITY_MORRIS, PRESSURE_SHEPARD), 0, 1e-13);
}

/* Two fluids at rest, one twice as heavy as the other, without pressure: the largest rate of a density by its diffusion. */
static double rate_at_rest(bool diffuses_reference)
{
    struct scene *scene = channel(16, 1.2, false, VISCOSITY_MORRIS);
    struct timers timers;
    timers_start(&timers);
    scene->sph.diffuses_reference = diffuses_reference;
    struct sph *sph = sph_open(scene, &timers, NULL);
    sph_step(sph);
    for (size_t p = 0; p < sph->store->count; p++)
        sph->columns.density[p] = sph->columns.reference[p] = sph->columns.x[1][p] > 5e-4 ? 2000 : 1000;
    flow_prepare(sph);
    flow_density(sph, 0);
    double most = 0;
    for (size_t p = 0; p < sph->store->count; p++)
        most = fmax(most, fabs(sph->rate[p]));
    sph_close(sph);
    scene_close(scene);
    return most;
}

static void test_diffusion(void)
{
    check_true("diffusion does not mix the densities of two fluids", rate_at_rest(false) == 0);
    check_true("but does where it acts on the density itself", rate_at_rest(true) > 1);
}

/* Positions after some steps on a number of threads, by id. */
static double *positions(int threads, size_t *count)
{
    struct scene *scene = channel(16, 1.2, true, VISCOSITY_MORRIS);
    struct timers timers;
    timers_start(&timers);
    scene->sph.jitter = 0.1;
    scene->sph.diffuses_gradient = true;
    threads_set(threads);
    struct sph *sph = sph_open(scene, &timers, NULL);
    sph_share_always(sph);
    for (int i = 0; i < 200; i++)
        sph_step(sph);
    *count = sph->store->count;
    double *values = memory_array(2 * *count, sizeof *values, "a test");
    for (size_t id = 0; id < *count; id++)
        for (int a = 0; a < 2; a++)
            values[2 * id + (size_t)a] = sph->columns.x[a][sph->store->index_of_id[id]];
    sph_close(sph);
    scene_close(scene);
    return values;
}

static void test_threads(void)
{
    size_t count;
    double *one = positions(1, &count), *three = positions(3, &count);
    check_true("one and three threads give the same bits", memcmp(one, three, 2 * count * sizeof *one) == 0);
    memory_free(one);
    memory_free(three);
}

int main(void)
{
    test_lists(2, 0, "lists in the plane");
    test_lists(3, 0, "lists in space");
    test_lists(2, 10, "lists in a plane that repeats");
    test_lists(3, 10, "lists in a space that repeats");
    test_momentum();
    test_channel();
    test_diffusion();
    test_threads();
    return check_result();
}
