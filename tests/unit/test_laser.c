/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The beam through slabs of layers (spec am-sph V21), and what its march has to keep: every watt, the same bits on any number
 * of threads, the energy of pulses. Numbers named `reference` are those of the reference set: P A (1 - e^-1) e^-k. */
#include "base/threads.h"
#include "check.h"
#include "sph_fixture.h"

enum { LAYERS = 8, WIDE = 90 }; /* the slab is wider than the beam's 6 radii of 13.5 spacings */

static const double SPACING = 4e-6, RADIUS = 54e-6, POWER = 150, ABSORPTIVITY = 0.35, DEPTH = 2.5e5;

static const double reference[LAYERS] = {33.1863293, 12.2085683, 4.49128128, 1.65225005, 0.607828824, 0.223607728, 0.0822606861, 0.0302620152};

static void give_beam(struct fixture *fixture, double middle)
{
    fixture->words.beam.is_on = true;
    fixture->words.beam.power = POWER;
    fixture->words.beam.radius = RADIUS;
    fixture->words.beam.absorptivity = ABSORPTIVITY;
    fixture->words.beam.depth = DEPTH;
    fixture->words.beam.bin = 1;
    fixture->words.beam.n_pieces = 1;
    fixture->piece = (struct scene_beam_piece){.times = {0, 1}, .from = {middle, middle}, .to = {middle, middle}};
}

/* A slab with its lower corner at 0, the beam in its middle. */
static struct fixture *open_slab(int dimension, int layers)
{
    const int deep = dimension == 3 ? WIDE : layers;
    struct fixture *fixture = fixture_open(dimension, SPACING, 1.2, (size_t)(WIDE * deep * (dimension == 3 ? layers : 1)));
    fixture_plain_material(&fixture->materials[0], 7000, 700, 20);
    properties_prepare(&fixture->materials[0]);
    fixture_block(fixture, 0, SPH_SOLID, (int[]){0, 0, 0}, (int[]){WIDE, deep, dimension == 3 ? layers : 1}, 293);
    give_beam(fixture, 0.5 * WIDE * SPACING);
    return fixture;
}

static double sum_of_particles(const struct fixture *fixture)
{
    double sum = 0;
    for (size_t p = 0; p < fixture->sph.store->count; p++)
        sum += fixture->sph.columns.laser_power[p];
    return sum;
}

/* Everything that is a balance: of the columns, and of the particles with them. */
static void check_balance(const char *name, const struct fixture *fixture)
{
    const struct sph_powers *powers = &fixture->sph.powers;
    char text[100];
    snprintf(text, sizeof text, "%s: absorbed, reflected and transmitted make up the beam", name);
    check_near(text, (powers->absorbed + powers->reflected + powers->transmitted) / powers->laser_in, 1, 1e-12);
    snprintf(text, sizeof text, "%s: particles have what was absorbed", name);
    check_near(text, sum_of_particles(fixture) / powers->absorbed, 1, 1e-12);
}

/* Layers of a slab take what Beer's law leaves them; `scale` is the whole power over 150. */
static void test_layers(const char *name, int dimension, enum beam_reading reading, double scale)
{
    struct fixture *fixture = open_slab(dimension, LAYERS);
    const struct sph_powers *powers = &fixture->sph.powers;
    double layers[LAYERS] = {0}, worst = 0;
    char text[100];
    fixture->words.beam.reading = reading;
    fixture->words.beam.thickness = 50e-6;
    laser_deposit(&fixture->sph);
    for (size_t p = 0; p < fixture->sph.store->count; p++)
        layers[LAYERS - 1 - (int)(fixture->sph.columns.x[dimension - 1][p] / SPACING)] += fixture->sph.columns.laser_power[p];
    for (int k = 0; k < LAYERS; k++)
        worst = fmax(worst, fabs(layers[k] / (scale * reference[k]) - 1));
    snprintf(text, sizeof text, "%s: power of layers", name);
    check_near(text, worst, 0, 1e-6);
    snprintf(text, sizeof text, "%s: absorbed", name);
    check_near(text, powers->absorbed / (scale * 52.4823882), 1, 1e-8);
    snprintf(text, sizeof text, "%s: transmitted", name);
    check_near(text, powers->transmitted / (scale * 0.017611788), 1, 1e-6);
    snprintf(text, sizeof text, "%s: reflected", name);
    check_near(text, powers->reflected / (scale * 97.5), 1, 1e-9);
    check_balance(name, fixture);
    fixture_close(fixture);
}

/* Within one radius lie 1 - e^-2 of the power: 86.47 % (reference). */
static void test_profile(void)
{
    struct fixture *fixture = open_slab(3, LAYERS);
    const struct sph_columns *c = &fixture->sph.columns;
    const double middle = 0.5 * WIDE * SPACING;
    double sum = 0;
    laser_deposit(&fixture->sph);
    for (size_t p = 0; p < fixture->sph.store->count; p++)
        if (hypot(c->x[0][p] - middle, c->x[1][p] - middle) < RADIUS)
            sum += c->laser_power[p];
    check_near("profile: part within one radius", sum / fixture->sph.powers.absorbed, 0.864664717, 0.01);
    fixture_close(fixture);
}

/* Particles at any place, some with holes between, one far above, one removed, one that is a wall. */
static struct fixture *open_heap(int dimension)
{
    struct fixture *fixture = fixture_open(dimension, SPACING, 1.2, 4003);
    unsigned state = 7;
    const double wide = 60 * SPACING;
    fixture_plain_material(&fixture->materials[0], 7000, 700, 20);
    fixture_table(&fixture->materials[0], PROPERTY_ABSORPTIVITY, 2, (double[]){300, 0.2, 1300, 0.6});
    properties_prepare(&fixture->materials[0]);
    for (int i = 0; i < 4003; i++) {
        double x[3];
        for (int a = 0; a < 3; a++) {
            state = state * 1664525u + 1013904223u;
            x[a] = (double)(state >> 8) / (1 << 24) * (a == dimension - 1 ? 0.2 : 1) * wide;
        }
        if (i == 4000)
            x[dimension - 1] = 1e3;
        fixture_particle(fixture, 0, i == 4001 ? SPH_REMOVED : i == 4002 ? SPH_WALL : SPH_FLUID, x, 300 + i % 1000);
    }
    give_beam(fixture, 0.4 * wide);
    return fixture;
}

static void test_heap(int dimension, double bin)
{
    struct fixture *fixture[2];
    char name[60];
    snprintf(name, sizeof name, "heap %dD, cells of %g", dimension, bin);
    for (int i = 0; i < 2; i++) {
        fixture[i] = open_heap(dimension);
        fixture[i]->words.beam.bin = bin;
        threads_set(i == 0 ? 1 : 3);
        laser_deposit(&fixture[i]->sph);
        threads_set(0);
    }
    check_balance(name, fixture[0]);
    const double *one = fixture[0]->sph.columns.laser_power, *three = fixture[1]->sph.columns.laser_power;
    char text[100];
    snprintf(text, sizeof text, "%s: the same bits on three threads", name);
    check_true(text, memcmp(one, three, 4003 * sizeof *one) == 0
                         && memcmp(&fixture[0]->sph.powers, &fixture[1]->sph.powers, sizeof fixture[0]->sph.powers) == 0);
    snprintf(text, sizeof text, "%s: nothing for what is removed or a wall", name);
    check_true(text, one[4001] == 0 && one[4002] == 0 && fixture[0]->sph.powers.absorbed > 0);
    fixture_close(fixture[0]);
    fixture_close(fixture[1]);
}

/* Without an absorptivity of the beam, that of the surface at its temperature counts: here 0.2 + 0.4 (T - 300)/1000. */
static void test_absorptivity(void)
{
    struct fixture *fixture = open_slab(2, LAYERS);
    fixture_table(&fixture->materials[0], PROPERTY_ABSORPTIVITY, 2, (double[]){300, 0.2, 1300, 0.6});
    fixture->words.beam.absorptivity = 0;
    for (size_t p = 0; p < fixture->sph.store->count; p++)
        fixture->sph.columns.temperature[p] = fixture->sph.columns.x[1][p] > (LAYERS - 1) * SPACING ? 800 : 300;
    laser_deposit(&fixture->sph);
    check_near("absorptivity: of the surface", fixture->sph.powers.reflected / fixture->sph.powers.laser_in, 0.6, 1e-9);
    fixture_close(fixture);
}

/* What came off is not hit where the deck says so: the layer below the one that is off has what is the top's without. */
static void test_through(void)
{
    static int32_t parted[WIDE * LAYERS];
    struct fixture *fixture = open_slab(2, LAYERS);
    struct sph_columns *c = &fixture->sph.columns;
    double top[2] = {0};
    fixture->words.lets_beam_through = true;
    for (int i = 0; i < 2; i++) {
        laser_deposit(&fixture->sph);
        for (size_t p = 0; p < fixture->sph.store->count; p++) {
            const int layer = LAYERS - 1 - (int)(c->x[1][p] / SPACING);
            top[i] += layer == i ? c->laser_power[p] : 0;
            parted[p] = layer > 0 ? SPH_HOLDS : c->x[0][p] > 0.5 * WIDE * SPACING ? SPH_CAME_OFF : SPH_OF_THREAD;
        }
        c->parted = parted;
    }
    check_near("through: the next layer has it", top[1] / top[0], 1, 1e-12);
    check_balance("through", fixture);
    fixture_close(fixture);
}

/* A beam beside the slab goes by: half of it at an edge. */
static void test_beside(void)
{
    struct fixture *fixture = open_slab(3, LAYERS);
    struct sph_powers *powers = &fixture->sph.powers;
    fixture->piece.from[0] = fixture->piece.to[0] = 0;
    laser_deposit(&fixture->sph);
    check_near("beside: half of it goes by at an edge", (powers->absorbed + powers->reflected) / POWER, 0.5 * (1 - 0.017611788 / POWER), 1e-3);
    check_balance("beside", fixture);
    fixture->piece.from[0] = fixture->piece.to[0] = -1;
    laser_deposit(&fixture->sph);
    check_true("beside: all of it far away", powers->transmitted == POWER && powers->laser_in == POWER && powers->absorbed == 0 && sum_of_particles(fixture) == 0);
    fixture_close(fixture);
}

/* A pulse brings its energy, whatever the steps; the beam moves along its path. */
static void test_pulse(void)
{
    struct fixture *fixture = open_slab(2, LAYERS);
    struct sph *sph = &fixture->sph;
    const double line = 775721.101 / ABSORPTIVITY; /* W/m of the slice through the beam: reference line_power_slice_2d over A */
    double first = 0, last = 0;
    fixture->piece.times[0] = 1e-9;
    fixture->piece.times[1] = 2e-7;
    fixture->piece.from[0] = 30 * SPACING;
    fixture->piece.to[0] = 60 * SPACING;
    fixture_list(fixture);
    for (int i = 0; i < 40; i++) {
        double place = 0, sum = 0;
        fixture_heat_step(fixture, 7e-9);
        for (size_t p = 0; p < sph->store->count; p++) {
            place += sph->columns.laser_power[p] * sph->columns.x[0][p];
            sum += sph->columns.laser_power[p];
        }
        if (sum > 0)
            last = place / sum;
        if (sum > 0 && first == 0)
            first = place / sum;
    }
    check_near("pulse: energy", sph->budget.laser_in / (line * 1.99e-7), 1, 1e-8);
    /* in the middles of the first and last part of a step: 1e-9 .. 7e-9 and 196e-9 .. 200e-9 of the path of 199e-9 */
    check_near("pulse: where it begins", first / SPACING, 30 + 30 * 3.0 / 199, 0.01);
    check_near("pulse: where it ends", last / SPACING, 60 - 30 * 2.0 / 199, 0.01);
    check_near("pulse: heat is what was absorbed", fixture_heat(fixture) / sph->budget.absorbed, 1, 1e-10);
    fixture_close(fixture);
}

int main(void)
{
    test_layers("slab 3D", 3, BEAM_SLICE, 1);
    test_layers("slab 2D, slice", 2, BEAM_SLICE, 775721.101 / (POWER * ABSORPTIVITY));
    test_layers("slab 2D, line", 2, BEAM_LINE, 1 / 50e-6);
    test_profile();
    for (int dimension = 2; dimension <= 3; dimension++) {
        test_heap(dimension, 1);
        test_heap(dimension, 1.7);
    }
    test_absorptivity();
    test_through();
    test_beside();
    test_pulse();
    return check_result();
}
