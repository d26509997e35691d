/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Johnson-Cook yield stress and its return, shared by john, sjc, sjcf and jcf (spec 8.1). */
#ifndef MATERIAL_JOHNSON_COOK_H
#define MATERIAL_JOHNSON_COOK_H

#include "material/plastic.h"

/* Constants of a law by where its row has them. */
struct johnson_cook {
    double a, b, n, c, reference_rate;
    double m, room, melt; /* only with temperature */
    bool has_temperature;
};

/* Outcome of the return of one point. */
struct johnson_cook_return {
    double scale;      /* of the trial deviator */
    double equivalent; /* von Mises stress after it */
    double increment;  /* of the plastic strain */
};

/* Returns a trial state to the yield surface: changes the point's plastic strain and yield stress.
 * `thermal` is 1 - T*^m. A new yield stress above the trial stress undoes the increment but stays
 * (spec 8.1, Q). */
struct johnson_cook_return johnson_cook_update(const struct johnson_cook *constants, const struct law_batch *batch,
                                               int j, double equivalent, double shear, double thermal);

/* T* = (T - Troom) / (Tmelt - Troom) of a point. */
THREADS_INLINE double johnson_cook_homologous(const struct johnson_cook *constants, const struct law_batch *batch, int j)
{
    return (batch->temperature[j] - constants->room) / (constants->melt - constants->room);
}

/* Arguments of the rows, in the order of the dialect. */
#define JOHNSON_COOK_ELASTIC                                                                                          \
    {"density", "mass/length^3", ARGUMENT_REAL, LIMIT_POSITIVE}, {"young", "stress", ARGUMENT_REAL, LIMIT_POSITIVE}, \
        {"poisson", NULL, ARGUMENT_REAL, LIMIT_POISSON}
#define JOHNSON_COOK_YIELD                                                                                            \
    {"A", "stress", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE}, {"B", "stress", ARGUMENT_REAL, LIMIT_NOT_NEGATIVE},           \
        {"n", NULL, ARGUMENT_REAL, LIMIT_NOT_NEGATIVE}, {"C", NULL, ARGUMENT_REAL, LIMIT_NOT_NEGATIVE}
#define JOHNSON_COOK_THERMAL                                                                                          \
    {"m", NULL, ARGUMENT_REAL, LIMIT_POSITIVE}, {"Troom", "temperature", ARGUMENT_REAL, LIMIT_NONE},                  \
        {"Tmelt", "temperature", ARGUMENT_REAL, LIMIT_NONE},                                                          \
        {"c_heat", "energy/(mass temperature)", ARGUMENT_REAL, LIMIT_POSITIVE}
#define JOHNSON_COOK_RATE {"rate0", "1/time", ARGUMENT_REAL, LIMIT_POSITIVE}
#define JOHNSON_COOK_FAILURE {"epf", NULL, ARGUMENT_REAL, LIMIT_POSITIVE}

#endif
