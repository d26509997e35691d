/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A wall of springs (spec rkpm 8; thesis 5.29) at coefficients whose places are nearer than half a spacing, so that the
 * surface of the body, which is that far from its outer nodes, touches the plane. A spring at a place of coefficients acts
 * on that coefficient alone: its work is that of its force. */
#include "rkpm/dynamic.h"

#include <math.h>

/* How deep a coefficient's place is in the wall; not positive: it does not touch. */
static double depth(const struct dynamic *dynamic, size_t node)
{
    const struct scene_dynamic *words = &dynamic->words->dynamic;
    return words->wall_position + 0.5 * dynamic->spacing - dynamic->coefficient[words->wall_axis][node];
}

double rkpm_dynamic_stiffness(const struct dynamic *dynamic)
{
    return dynamic->words->dynamic.wall_modulus * (dynamic->dimension == 2 ? dynamic->spacing : dynamic->spacing * dynamic->spacing);
}

void rkpm_dynamic_wall(struct dynamic *dynamic)
{
    const double k = rkpm_dynamic_stiffness(dynamic);
    for (size_t n = 0; n < dynamic->count && dynamic->words->dynamic.wall == RKPM_WALL_SPRING; n++)
        dynamic->wall_force[n] = k * fmax(depth(dynamic, n), 0);
}
