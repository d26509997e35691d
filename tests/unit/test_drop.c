/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Drops that move under surface tension 10, of radius and density 1, sound speed 40: pressure inside (Laplace) and the
 * frequency and decay of their lowest mode (spec am-sph 16, V11 to V13). Steps are those of a run, put together here by
 * hand, as no deck is needed for them. Drops are cut out of a square or cubic lattice. */
#include "check.h"
#include "surface_fixture.h"

#include <string.h>

static const double TENSION = 10, SOUND = 40, PI = 3.14159265358979323846;

struct drop {
    const char *name;
    int dimension;
    double spacing, viscosity, stretch, start_pressure, end_time;
    bool corrects_depth;
};

/* What is seen of a run: mean pressure in r < 1/2 over its last two fifths; where the moment of x^2 - y^2 crosses zero
 * and its largest size between. */
struct seen {
    double pressure, drift;
    double crossings[32], peaks[32];
    int n_crossings;
};

/* --- a run --- */

static void bind(struct sph *sph)
{
    struct sph_columns *c = &sph->columns;
    double *(*real)[COLUMN_COMPONENTS] = sph->store->real;
    fixture_bind(sph);
    for (int a = 0; a < 3; a++)
        c->v[a] = real[COLUMN_VELOCITY][a];
    c->mass = real[COLUMN_MASS][0];
    c->reference = real[COLUMN_REFERENCE_DENSITY][0];
    c->pressure = real[COLUMN_PRESSURE][0];
    c->excess_offset = real[COLUMN_EXCESS_OFFSET][0];
    c->viscosity = real[COLUMN_VISCOSITY][0];
}

static void add_particles(struct fixture *fixture, const struct drop *drop)
{
    const int most = (int)(1 / drop->spacing) + 1, deep = drop->dimension == 3 ? most : 0;
    const double across = drop->dimension == 2 ? 1 / drop->stretch : 1 / sqrt(drop->stretch), dx = drop->spacing;
    for (int k = -deep; k <= deep; k++)
        for (int j = -most; j <= most; j++)
            for (int i = -most; i <= most; i++) {
                const double x = (i + 0.5) * dx, y = (j + 0.5) * dx, z = deep ? (k + 0.5) * dx : 0;
                if (x * x + y * y + z * z < 1)
                    fixture_add(fixture, x * drop->stretch, y * across, z * across, SPH_FLUID, 0);
            }
}

static void open_drop(struct fixture *fixture, const struct drop *drop)
{
    struct sph *sph = &fixture->sph;
    const uint64_t columns = column_bit(COLUMN_VELOCITY) | column_bit(COLUMN_MASS) | column_bit(COLUMN_REFERENCE_DENSITY)
                           | column_bit(COLUMN_PRESSURE) | column_bit(COLUMN_EXCESS_OFFSET) | column_bit(COLUMN_VISCOSITY);
    fixture_open(fixture, drop->dimension, drop->spacing, 1.2);
    fixture_tension(fixture, TENSION, 0);
    fixture->words.corrects_depth = drop->corrects_depth;
    fixture->words.density_diffusion = 0.1;
    add_particles(fixture, drop);
    fixture->more_columns = columns;
    fixture_start(fixture);
    bind(sph);
    for (int i = 0; i < 3; i++)
        sph->seen[i] = memory_array(fixture->n, sizeof(double), "test");
    sph->fluid_volume = memory_array(fixture->n, sizeof(double), "test");
    sph->excess = memory_array(fixture->n, sizeof(double), "test");
    sph->rate = memory_array(fixture->n, sizeof(double), "test");
    sph->needs_normals = true;
    sph->self_value = kernel_value(&sph->kernel, 0);
    sph->sound_speed = SOUND;
    for (size_t p = 0; p < fixture->n; p++) {
        sph->columns.density[p] = 1 + drop->start_pressure / (SOUND * SOUND);
        sph->columns.mass[p] = sph->columns.density[p] * sph->columns.volume[p];
        sph->columns.reference[p] = 1;
        sph->columns.viscosity[p] = drop->viscosity;
    }
}

static void close_drop(struct fixture *fixture)
{
    struct sph *sph = &fixture->sph;
    for (int i = 0; i < 3; i++)
        memory_free(sph->seen[i]);
    memory_free(sph->fluid_volume);
    memory_free(sph->excess);
    memory_free(sph->rate);
    fixture_close(fixture);
}

/* As sph_step does, without heat. */
static void step_drop(struct sph *sph, double time_step)
{
    const double taken = sph->step > 0 ? time_step : 0;
    if (neighbours_follow(sph->neighbours))
        bind(sph);
    flow_prepare(sph);
    flow_gradients(sph);
    flow_density(sph, taken);
    flow_walls(sph);
    surface_find(sph);
    flow_forces(sph);
    surface_forces(sph);
    flow_advance(sph, 0.5 * (taken + time_step), time_step);
    sph->step++;
    sph->time += time_step;
}

/* Limits of sound, viscosity and capillary waves (spec 12). */
static double time_step_of(const struct sph *sph, const struct drop *drop)
{
    const double h = sph->smoothing;
    return fmin(0.4 * h / (SOUND + 1), fmin(0.05 * h * h / drop->viscosity, 0.25 * sqrt(h * h * h / (2 * PI * TENSION))));
}

/* --- what is seen --- */

static double inner_pressure(const struct sph *sph)
{
    const struct sph_columns *c = &sph->columns;
    double sum = 0;
    size_t n = 0;
    for (size_t p = 0; p < sph->store->count; p++)
        if (c->x[0][p] * c->x[0][p] + c->x[1][p] * c->x[1][p] + c->x[2][p] * c->x[2][p] < 0.25) {
            sum += c->pressure[p];
            n++;
        }
    return sum / (double)n;
}

/* (x^2 - y^2)/(x^2 + y^2), each summed. */
static double elongation(const struct sph *sph)
{
    double *const *x = sph->columns.x, sums[2] = {0};
    for (size_t p = 0; p < sph->store->count; p++)
        for (int a = 0; a < 2; a++)
            sums[a] += x[a][p] * x[a][p];
    return (sums[0] - sums[1]) / (sums[0] + sums[1]);
}

/* Distance of the middle from where it was, in spacings. */
static double drift(const struct sph *sph)
{
    double square = 0;
    for (int a = 0; a < 3; a++) {
        double sum = 0;
        for (size_t p = 0; p < sph->store->count; p++)
            sum += sph->columns.x[a][p] / (double)sph->store->count;
        square += sum * sum;
    }
    return sqrt(square) / sph->spacing;
}

static void look(const struct sph *sph, double time_step, double *last, struct seen *seen)
{
    const double now = elongation(sph);
    if (sph->step > 1 && (now < 0) != (*last < 0) && seen->n_crossings < 31)
        seen->crossings[seen->n_crossings++] = sph->time - time_step * now / (now - *last);
    seen->peaks[seen->n_crossings] = fmax(seen->peaks[seen->n_crossings], fabs(now));
    *last = now;
}

static struct seen run_drop(const struct drop *drop)
{
    struct fixture fixture;
    struct seen seen = {0};
    double last = 0;
    int n = 0;
    open_drop(&fixture, drop);
    struct sph *sph = &fixture.sph;
    const double time_step = time_step_of(sph, drop);
    while (sph->time < drop->end_time) {
        step_drop(sph, time_step);
        if (sph->time > 0.6 * drop->end_time) {
            seen.pressure += inner_pressure(sph);
            n++;
        }
        if (drop->stretch != 1)
            look(sph, time_step, &last, &seen);
    }
    seen.pressure /= n;
    seen.drift = drift(sph);
    close_drop(&fixture);
    return seen;
}

/* --- the tests --- */

/* Exact: sigma/R in two dimensions, 2 sigma/R in three. They start at another pressure, so that it has to be found.
 * Prototypes came to 10.16 with and 10.48 without depth correction (10.38, 10.97 at R/dx = 10), and in three dimensions to 21.0 (spec 6.2). */
static void test_pressure(bool is_long)
{
    static const struct drop drops[] = {
        {"disc, R/dx = 10", 2, 0.1, 0.3, 1, 8, 1, true},
        {"disc, R/dx = 10, without depth correction", 2, 0.1, 0.3, 1, 8, 1, false},
        {"disc, R/dx = 20", 2, 0.05, 0.3, 1, 8, 1, true},
        {"disc, R/dx = 20, without depth correction", 2, 0.05, 0.3, 1, 8, 1, false},
        {"ball, R/dx = 8", 3, 0.125, 0.5, 1, 16, 0.4, true},
    };
    const size_t count = is_long ? sizeof drops / sizeof drops[0] : 2;
    puts("# pressure in drops over the exact one");
    for (size_t i = 0; i < count; i++) {
        const struct drop *drop = &drops[i];
        const struct seen seen = run_drop(drop);
        const double ratio = seen.pressure / ((drop->dimension - 1) * TENSION);
        char name[100];
        snprintf(name, sizeof name, "%s: %.3f", drop->name, ratio);
        check_near(name, ratio, 1, drop->dimension == 3 || !drop->corrects_depth ? 0.1 : 0.05);
        snprintf(name, sizeof name, "%s stays where it is: %.0e spacings", drop->name, seen.drift);
        check_true(name, seen.drift < 0.01);
    }
}

/* omega^2 = 6 sigma/(rho R^3), decay 4 nu/R^2; each crossing is half a period after the one before, and the first peak
 * is that of the start. With this viscosity decay is seen well in five half periods (prototypes: 0.42 for 0.40, spec
 * 4.2); at 0.02 other modes that the start excites hide it that long. */
static void test_oscillation(void)
{
    const struct drop drop = {"disc", 2, 0.05, 0.1, 1.05, 10, 2.3, true};
    const double exact = sqrt(6 * TENSION), rate = 4 * drop.viscosity;
    const struct seen seen = run_drop(&drop);
    puts("# oscillation of a disc");
    check_true("has five half periods", seen.n_crossings >= 6);
    if (seen.n_crossings < 6)
        return;
    const double omega = PI * 5 / (seen.crossings[5] - seen.crossings[0]);
    const double decay = log(seen.peaks[1] / seen.peaks[5]) / (PI * 4 / omega);
    char name[100];
    snprintf(name, sizeof name, "frequency over the exact one: %.3f", omega / exact);
    check_near(name, omega / exact, 1, 0.04);
    snprintf(name, sizeof name, "decay over the exact one: %.2f", decay / rate);
    check_near(name, decay / rate, 1, 0.25);
}

/* The finer drops and the oscillation take half a minute: `test_drop long`. */
int main(int n_arguments, char **arguments)
{
    const bool is_long = n_arguments > 1 && strcmp(arguments[1], "long") == 0;
    test_pressure(is_long);
    if (is_long)
        test_oscillation();
    return check_result();
}
