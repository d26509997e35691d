/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Smoothed pressure for output: particle pressures averaged over nodes by volume, and back (spec 9.6).
 * It is only computed in steps that are written. */
#include "mpm/mpm.h"

#include <string.h>

void smoothing_start(struct mpm *mpm)
{
    struct store *store = mpm->store;
    if (!mpm->smooths || !mpm->shape->smooths_at_start || mpm->place != COLUMN_POSITION)
        return;
    for (int a = 0; a < 3; a++)
        memcpy(store->real[COLUMN_START_POSITION][a], store->real[COLUMN_POSITION][a], store->count * sizeof(double));
}

void smoothing_finish(struct mpm *mpm)
{
    const enum column place = mpm->place;
    if (!mpm->smooths)
        return;
    if (mpm->shape->smooths_at_start && mpm->place == COLUMN_POSITION)
        mpm->place = COLUMN_START_POSITION;
    mpm_each_block(mpm, mpm->shape->smooth_give);
    if (mpm->shape->smooth_nodes)
        mpm->shape->smooth_nodes(mpm);
    else
        grid_quotient(mpm->grid, NODE_STRAINING);
    mpm_each_block(mpm, mpm->shape->smooth_take);
    mpm->place = place;
    mpm->smooths = false;
}

double smoothing_volume(const struct mpm *mpm, size_t p)
{
    const struct store *store = mpm->store;
    if (mpm->is_total)
        return store->real[COLUMN_MASS][0][p] / mpm->material_of_body[store->integer[COLUMN_BODY][p]]->density;
    return store->real[COLUMN_VOLUME][0][p];
}
