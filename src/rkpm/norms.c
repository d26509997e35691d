/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The error of a level against the exact solution. */
#include "rkpm/rkpm.h"

#include <math.h>

struct norms {
    struct rkpm *rkpm;
    struct rkpm_level *level;
    double value, gradient, exact; /* sums of squares */
};

static void add_error(void *context, const struct quadrature_point *point)
{
    struct norms *norms = context;
    const struct shape_row *row = rkpm_row(norms->rkpm, norms->level, point->x, norms->rkpm->words->gradient);
    const double given = field_value(&norms->rkpm->field, point->x);
    double exact[3], error = -given;
    field_gradient(&norms->rkpm->field, point->x, exact);
    for (int i = 0; i < row->count; i++)
        error += row->value[i] * norms->level->coefficient[row->node[i]];
    norms->value += point->weight * error * error;
    norms->exact += point->weight * given * given;
    for (int a = 0; a < norms->level->box.dimension; a++) {
        double slope = -exact[a];
        for (int i = 0; i < row->count; i++)
            slope += row->gradient[a][i] * norms->level->coefficient[row->node[i]];
        norms->gradient += point->weight * slope * slope;
    }
}

/* log(before/now) over log(h before/h now); 0 where there is no level before. */
static double rate(const struct rkpm *rkpm, const struct rkpm_level *level, double before, double now)
{
    if (level == rkpm->levels)
        return 0;
    const double finer = level[-1].box.spacing[0] / level->box.spacing[0];
    return finer == 1 || !(before > 0 && now > 0) ? 0 : log(before / now) / log(finer);
}

static void measure_field(struct rkpm *rkpm, struct rkpm_level *level)
{
    struct norms norms = {.rkpm = rkpm, .level = level};
    quadrature_inside(&level->box, rkpm->norm_gauss, add_error, &norms);
    level->result.l2 = sqrt(norms.value);
    level->result.l2_relative = norms.exact > 0 ? sqrt(norms.value / norms.exact) : 0;
    level->result.h1 = sqrt(norms.value + norms.gradient);
}

void rkpm_measure(struct rkpm *rkpm, struct rkpm_level *level)
{
    struct rkpm_result *result = &level->result;
    scene_rkpm_has_body(rkpm->words) ? rkpm_elastic_measure(rkpm, level) : measure_field(rkpm, level);
    result->l2_rate = rate(rkpm, level, level[level == rkpm->levels ? 0 : -1].result.l2, result->l2);
    result->h1_rate = rate(rkpm, level, level[level == rkpm->levels ? 0 : -1].result.h1, result->h1);
    result->enlarged = level->shape.enlarged;
    result->lowered = level->shape.lowered;
}
