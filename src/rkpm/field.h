/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exact solutions that problems are made from. */
#ifndef RKPM_FIELD_H
#define RKPM_FIELD_H

#include "deck/scene_rkpm.h"

struct field {
    enum rkpm_function function;
    int dimension;
    double wave_number, ends[2]; /* of the wave: along x */
};

double field_value(const struct field *field, const double x[3]);
void field_gradient(const struct field *field, const double x[3], double gradient[3]);

/* div grad u. */
double field_laplacian(const struct field *field, const double x[3]);

#endif
