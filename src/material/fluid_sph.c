/* SPDX-License-Identifier: GPL-3.0-or-later */
/* flui: what smoothed particles are made of. Their pressure follows from the density and the sound speed of the
 * scene; `prop` makes the numbers follow the temperature, and lets them melt. */
#include "material/law.h"

enum { DENSITY, VISCOSITY };

static const char *prepare(struct material *material)
{
    material->density = material->parameter[DENSITY];
    material->viscosity = material->parameter[VISCOSITY];
    return NULL;
}

const struct law law_flui = {
    .name = "flui",
    .methods = METHODS_SPH,
    .doc = "fluid of smoothed particles; `prop` says how it follows the temperature, and where it melts",
    .parameters = (const struct argument[]){{"density", "mass/length^3", ARGUMENT_REAL, LIMIT_POSITIVE},
                                            {"viscosity", "stress*time", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE}, {0}},
    .prepare = prepare,
};
