/* SPDX-License-Identifier: GPL-3.0-or-later */
/* powl: power law fluid with equation of state (spec rkpm 6.3): sigma = -p + 2 K gd^(n-1) D, gd = sqrt(2 D:D). */
#include "material/finite.h"

#include <math.h>

enum { DENSITY, SOUND_SPEED, CONSISTENCY, EXPONENT };

/* Where the fluid hardly shears its viscosity is that of this rate. */
static const double LEAST_RATE = 1e-6;

static const char *prepare(struct material *material)
{
    material->density = material->parameter[DENSITY];
    material->bulk_modulus = material->density * material->parameter[SOUND_SPEED] * material->parameter[SOUND_SPEED];
    material->wave_speed = material->viscous_speed = material->parameter[SOUND_SPEED];
    material->viscosity = material->parameter[CONSISTENCY];
    return NULL;
}

static void update(const struct law_batch *batch)
{
    const double *parameter = batch->material->parameter;
    for (int j = 0; j < batch->count; j++) {
        double g[3][3], rate[6];
        finite_gradient(batch, j, g);
        const double swelling = finite_swelling(g);
        const double pressure = finite_pressure(parameter[DENSITY], parameter[SOUND_SPEED], finite_volume(batch, j, swelling));
        finite_rate(g, swelling, batch->time_step, rate);
        double square = 0;
        for (int a = 0; a < 6; a++)
            square += (a < 3 ? 2 : 4) * rate[a] * rate[a];
        const double viscosity = parameter[CONSISTENCY] * pow(fmax(sqrt(square), LEAST_RATE), parameter[EXPONENT] - 1);
        for (int a = 0; a < 6; a++)
            batch->stress[a][j] = 2 * viscosity * rate[a] - (a < 3 ? pressure : 0);
    }
}

const struct law law_powl = {
    .name = "powl",
    .methods = METHODS_MPM | METHODS_DYNAMIC,
    .doc = "power law fluid with equation of state p = density sound^2/7 ((rho/density)^7 - 1): its viscosity is K times the shear rate to "
           "the power of n - 1; below a rate of 1e-6 it is that of 1e-6. `meth mpm` does not limit the time step by it: keep dtfx below about cell^2 density/(8 "
           "viscosity), of the largest one",
    .parameters = (const struct argument[]){{"density", "mass/length^3", ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"sound", "length/time", ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"K", "stress time^n", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE},
                                            {"n", NULL, ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {0}},
    .history = 1,
    .columns = {COLUMN_NONE},
    .follows_time = true,
    .stabilisation = 0.1,
    .viscous_work = 1,
    .prepare = prepare,
    .update = update,
};
