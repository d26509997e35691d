/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a run of moving reproducing kernel particles says at its start and end. */
#include "account.h"
#include "rkpm/dynamic.h"
#include "summary.h"

#include <math.h>

void summary_dynamic_check(const struct run *run, FILE *stream)
{
    const struct dynamic *dynamic = run->dynamic;
    const struct nodal *nodal = &dynamic->nodal;
    double pairs = 0;
    for (size_t n = 0; n < nodal->count; n++)
        pairs += nodal->neighbours[n];
    fprintf(stream, "%zu nodes, spacing %.6g, volume of each %.6g; %.1f neighbours on the average\n", dynamic->count, dynamic->spacing,
            dynamic->volume, pairs / (double)nodal->count);
    fprintf(stream, "first time step %.6E, about %.0f steps to the end\n", dynamic->first_time_step,
            ceil(dynamic->scene->end_time / dynamic->first_time_step));
}

void summary_dynamic_start(const struct run *run, FILE *stream)
{
    fprintf(stream, "\n");
    summary_dynamic_check(run, stream);
    account_columns(run->dynamic->store, stream);
    fprintf(stream, "kinetic energy %.9E\n\n", run->dynamic->sums.kinetic);
}

void summary_dynamic_instability(const struct run *run, const struct instability *instability, FILE *stream)
{
    const struct dynamic *dynamic = run->dynamic;
    const struct store *store = dynamic->store;
    fprintf(stream, "mpm3d: the run is stopped at step %ld, time %.6E: %s\n", dynamic->step, dynamic->time, instability->cause);
    if (instability->particle >= 0) {
        const size_t n = (size_t)instability->particle;
        fprintf(stream, "       node %d, law %s, at (%.6g, %.6g, %.6g), velocity (%.6g, %.6g, %.6g)\n", store->integer[COLUMN_ID][n] + 1,
                dynamic->material->law->name, store->real[COLUMN_POSITION][0][n], store->real[COLUMN_POSITION][1][n],
                store->real[COLUMN_POSITION][2][n], store->real[COLUMN_VELOCITY][0][n], store->real[COLUMN_VELOCITY][1][n],
                store->real[COLUMN_VELOCITY][2][n]);
    }
    fprintf(stream, "       %s; the output up to the step before is kept\n", instability->advice);
}

void summary_dynamic_end(const struct run *run, double seconds, enum status status, FILE *stream)
{
    const struct dynamic *dynamic = run->dynamic;
    const struct dynamic_sums *sums = &dynamic->sums;
    summary_timers(dynamic->updates, &run->timers, seconds, stream);
    fprintf(stream, "volumes are %.4g to %.4g of those at the start; %ld points had too few neighbours in the last step\n", sums->least_ratio,
            sums->most_ratio, sums->few_neighbours);
    fprintf(stream, "%s at step %ld, time %.6E: kinetic energy %.9E, internal energy %.9E, of the wall %.9E\n", summary_ending(status), dynamic->step,
            dynamic->time, sums->kinetic, sums->internal, sums->wall_energy);
}
