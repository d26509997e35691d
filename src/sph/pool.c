/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How large the melt pool is. */
#include "sph/sph.h"

#include <float.h>
#include <math.h>

static bool is_molten(const struct sph *sph, size_t p)
{
    const struct sph_columns *c = &sph->columns;
    return c->state[p] == SPH_FLUID && c->liquid[p] >= 0.5 && sph->bodies[c->body[p]].properties->melts;
}

void sph_pool(const struct sph *sph, double extents[3])
{
    double low[3] = {DBL_MAX, DBL_MAX, DBL_MAX}, high[3] = {-DBL_MAX, -DBL_MAX, -DBL_MAX};
    for (size_t p = 0; p < sph->store->count; p++)
        for (int a = 0; a < 3 && is_molten(sph, p); a++) {
            low[a] = fmin(low[a], sph->columns.x[a][p]);
            high[a] = fmax(high[a], sph->columns.x[a][p]);
        }
    for (int a = 0; a < 3; a++)
        extents[a] = high[a] >= low[a] ? high[a] - low[a] + sph->spacing : 0;
}
