/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "particles/results.h"
#include "base/tensor.h"
#include "material/law.h"

#include <strings.h>

#define REAL(source, column, component) ((source)->store->real[column][component][p])

static double von_mises(const struct result_source *s, size_t p)
{
    if (store_has(s->store, COLUMN_EQUIVALENT_STRESS))
        return REAL(s, COLUMN_EQUIVALENT_STRESS, 0);
    return tensor_von_mises(REAL(s, COLUMN_STRESS, 0), REAL(s, COLUMN_STRESS, 1), REAL(s, COLUMN_STRESS, 2),
                            REAL(s, COLUMN_STRESS, 3), REAL(s, COLUMN_STRESS, 4), REAL(s, COLUMN_STRESS, 5));
}

static double plastic_strain(const struct result_source *s, size_t p)
{
    return store_has(s->store, COLUMN_PLASTIC_STRAIN) ? REAL(s, COLUMN_PLASTIC_STRAIN, 0) : 0;
}

static double material(const struct result_source *s, size_t p)
{
    return s->body_material_number[s->store->integer[COLUMN_BODY][p]];
}

static double pressure(const struct result_source *s, size_t p)
{
    return store_pressure(s->store, p);
}

static double volume(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_VOLUME, 0);
}

static double kinetic_energy(const struct result_source *s, size_t p)
{
    double x = REAL(s, COLUMN_VELOCITY, 0), y = REAL(s, COLUMN_VELOCITY, 1), z = REAL(s, COLUMN_VELOCITY, 2);
    return 0.5 * REAL(s, COLUMN_MASS, 0) * (x * x + y * y + z * z);
}

static double internal_energy(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_ENERGY, 0);
}

static double velocity_x(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_VELOCITY, 0);
}

static double velocity_y(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_VELOCITY, 1);
}

static double velocity_z(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_VELOCITY, 2);
}

static double temperature(const struct result_source *s, size_t p)
{
    return store_has(s->store, COLUMN_TEMPERATURE) ? REAL(s, COLUMN_TEMPERATURE, 0)
                                                   : column_row(COLUMN_TEMPERATURE)->initial;
}

static double failed(const struct result_source *s, size_t p)
{
    return store_has(s->store, COLUMN_FAILED) ? REAL(s, COLUMN_FAILED, 0) : 0;
}

static double damage(const struct result_source *s, size_t p)
{
    return store_has(s->store, COLUMN_DAMAGE) ? REAL(s, COLUMN_DAMAGE, 0) : 0;
}

static double sound_speed(const struct result_source *s, size_t p)
{
    return s->body_material[s->store->integer[COLUMN_BODY][p]]->viscous_speed;
}

static double stress_xx(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_STRESS, 0);
}

static double stress_yy(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_STRESS, 1);
}

static double stress_zz(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_STRESS, 2);
}

static double stress_yz(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_STRESS, 3);
}

static double stress_xz(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_STRESS, 4);
}

static double stress_xy(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_STRESS, 5);
}

static double displacement_x(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_POSITION, 0) - REAL(s, COLUMN_INITIAL_POSITION, 0);
}

static double displacement_y(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_POSITION, 1) - REAL(s, COLUMN_INITIAL_POSITION, 1);
}

static double displacement_z(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_POSITION, 2) - REAL(s, COLUMN_INITIAL_POSITION, 2);
}

/* Of the stress whose divergence is in balance: with residual stress taken off. */
static double von_mises_total(const struct result_source *s, size_t p)
{
    double stress[6];
    if (!store_has(s->store, COLUMN_RESIDUAL))
        return von_mises(s, p);
    for (int a = 0; a < 6; a++)
        stress[a] = REAL(s, COLUMN_STRESS, a) - REAL(s, COLUMN_RESIDUAL, a);
    return tensor_von_mises(stress[0], stress[1], stress[2], stress[3], stress[4], stress[5]);
}

static double layer(const struct result_source *s, size_t p)
{
    return s->store->integer[COLUMN_LAYER][p] + 1;
}

static double is_open(const struct result_source *s, size_t p)
{
    return !result_is_closed(s, p);
}

static const struct result rows[] = {
    {.name = "seqv", .unit = "stress", .doc = "von Mises stress", .value = von_mises},
    {.name = "seqt", .unit = "stress", .doc = "von Mises stress of the total: with the residual stress of resi taken off",
     .value = von_mises_total},
    {.name = "laye", .doc = "layer of the build", .is_integer = true, .columns = {COLUMN_LAYER}, .value = layer},
    {.name = "ghos", .doc = "1 where the particle is open, 0 where it is closed", .is_integer = true, .value = is_open},
    {.name = "epef", .doc = "effective plastic strain", .value = plastic_strain},
    {.name = "mat", .doc = "material number", .is_integer = true, .value = material},
    {.name = "pres", .unit = "stress", .doc = "pressure, minus the mean stress", .value = pressure},
    {.name = "volu", .unit = "length^3", .doc = "present volume", .value = volume},
    {.name = "vol", .unit = "length^3", .doc = "the same as volu", .value = volume},
    {.name = "engk", .unit = "energy", .doc = "kinetic energy; in a curve of all particles",
     .is_total_in_curves = true, .value = kinetic_energy},
    {.name = "engi", .unit = "energy", .doc = "internal energy; in a curve of all particles",
     .is_total_in_curves = true, .value = internal_energy},
    {.name = "velx", .unit = "length/time", .doc = "velocity along x", .value = velocity_x},
    {.name = "vely", .unit = "length/time", .doc = "velocity along y", .value = velocity_y},
    {.name = "velz", .unit = "length/time", .doc = "velocity along z", .value = velocity_z},
    {.name = "cels", .unit = "temperature", .doc = "temperature", .value = temperature},
    {.name = "fail", .doc = "1 where the material failed", .is_integer = true, .value = failed},
    {.name = "sspd", .unit = "length/time", .doc = "sound speed of the artificial viscosity", .value = sound_speed},
    {.name = "damg", .doc = "damage", .value = damage},
    {.name = "stsx", .unit = "stress", .doc = "stress xx", .value = stress_xx},
    {.name = "stsy", .unit = "stress", .doc = "stress yy", .value = stress_yy},
    {.name = "stsz", .unit = "stress", .doc = "stress zz", .value = stress_zz},
    {.name = "styz", .unit = "stress", .doc = "stress yz", .value = stress_yz},
    {.name = "stxz", .unit = "stress", .doc = "stress xz", .value = stress_xz},
    {.name = "stxy", .unit = "stress", .doc = "stress xy", .value = stress_xy},
    {.name = "disx", .unit = "length", .doc = "displacement along x",
     .columns = {COLUMN_INITIAL_POSITION}, .value = displacement_x},
    {.name = "disy", .unit = "length", .doc = "displacement along y",
     .columns = {COLUMN_INITIAL_POSITION}, .value = displacement_y},
    {.name = "disz", .unit = "length", .doc = "displacement along z",
     .columns = {COLUMN_INITIAL_POSITION}, .value = displacement_z},
};

const struct result *result_rows(int *count)
{
    *count = sizeof rows / sizeof rows[0];
    return rows;
}

const struct result *result_find(const char *name)
{
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (strncasecmp(name, rows[i].name, 4) == 0)
            return &rows[i];
    return NULL;
}
