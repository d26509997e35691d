/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a run of smoothed particles says at its start and end. */
#include "summary.h"
#include "account.h"

#include <math.h>

static void count_states(const struct sph *sph, size_t states[4])
{
    for (size_t p = 0; p < sph->store->count; p++)
        states[sph->columns.state[p]]++;
}

void summary_sph_check(const struct run *run, FILE *stream)
{
    const struct sph *sph = run->sph;
    size_t states[4] = {0};
    count_states(sph, states);
    fprintf(stream, "%zu particles in %zu bodies: %zu of fluid, %zu of solid, %zu of walls\n", sph->store->count, sph->scene->n_bodies,
            states[SPH_FLUID], states[SPH_SOLID], states[SPH_WALL]);
    fprintf(stream, "spacing %.6g, smoothing length %.6g, sound speed %.6g\n", sph->spacing, sph->smoothing, sph->sound_speed);
    fprintf(stream, "first time step %.6E, limited by %s, about %.0f steps to the end\n", sph->first_time_step, sph->limiting->name,
            ceil(sph->scene->end_time / sph->first_time_step));
}

void summary_sph_start(const struct run *run, FILE *stream)
{
    const struct sph *sph = run->sph;
    fprintf(stream, "\n");
    summary_sph_check(run, stream);
    account_columns(sph->store, stream);
    const double lists = (double)neighbours_bytes(sph->neighbours) / (double)sph->store->count;
    fprintf(stream, "memory: %.0f bytes per particle and neighbours' lists (at first %.0f)\n",
            (double)store_bytes_per_particle(sph->store) + 9 * sizeof(double), lists);
    fprintf(stream, "kinetic energy %.9E, heat %.9E\n\n", sph->budget.kinetic, sph->budget.heat);
}

void summary_sph_instability(const struct run *run, const struct instability *instability, FILE *stream)
{
    const struct sph *sph = run->sph;
    const struct store *store = sph->store;
    fprintf(stream, "mpm3d: the run is stopped at step %ld, time %.6E: %s\n", sph->step, sph->time, instability->cause);
    if (instability->particle >= 0) {
        const size_t p = (size_t)store->index_of_id[instability->particle];
        fprintf(stream, "       particle %ld of body %d at (%.6g, %.6g, %.6g), velocity (%.6g, %.6g, %.6g), density %.6g, temperature %.6g\n",
                instability->particle + 1, sph->columns.body[p] + 1, sph->columns.x[0][p], sph->columns.x[1][p], sph->columns.x[2][p],
                sph->columns.v[0][p], sph->columns.v[1][p], sph->columns.v[2][p], sph->columns.density[p], sph->columns.temperature[p]);
    }
    fprintf(stream, "       %s; the output up to the step before is kept\n", instability->advice);
}

/* Where heat came from and went, since the start. */
static void print_heat(const struct sph *sph, FILE *stream)
{
    const struct sph_budget *budget = &sph->budget;
    const struct {
        const char *name;
        double value;
    } rows[] = {{"of the beam", budget->laser_in},           {"absorbed", budget->absorbed},
                {"reflected", budget->reflected},            {"transmitted", budget->transmitted},
                {"radiated", budget->radiated},              {"evaporated", budget->evaporated},
                {"out of walls", budget->through_walls},       {"viscous heat", budget->viscous_heat},
                {"volume heat", budget->volume_heat},        {"with removed particles", budget->removed_heat}};
    fprintf(stream, "heat: %.9E at the start, %.9E at the end", sph->start_heat, budget->heat);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (rows[i].value != 0)
            fprintf(stream, "; %s %.6E", rows[i].name, rows[i].value);
    if (budget->evaporated_mass > 0)
        fprintf(stream, "; mass of the vapour %.6E", budget->evaporated_mass);
    fprintf(stream, "; not accounted for: %.1e of it\n", sph_heat_error(sph));
}

void summary_sph_end(const struct run *run, double seconds, enum status status, FILE *stream)
{
    const struct sph *sph = run->sph;
    const struct sph_budget *budget = &sph->budget;
    summary_timers(sph->updates, &run->timers, seconds, stream);
    fprintf(stream, "neighbours listed %ld times; the last time step was limited by %s", sph->neighbours->builds, sph->limiting->name);
    if (sph->words->adapts_sound)
        fprintf(stream, "; the sound speed was %.4g at the start and is %.4g", sph->first_sound, sph->sound_speed);
    fprintf(stream, "\n");
    if (sph->words->heat != HEAT_OFF)
        print_heat(sph, stream);
    fprintf(stream, "%s after %ld steps at time %.6E: ", summary_ending(status), sph->step, sph->time);
    if (budget->removed > 0)
        fprintf(stream, "%ld particles left the grid or came off, and are removed, with mass %.3g", budget->removed, budget->removed_mass);
    else
        fprintf(stream, "no particle lost");
    if (!sph->words->freezes_flow && isfinite(budget->least_density_ratio)) /* some fluid that flows */
        fprintf(stream, ", density within %.2g %% and %.2g %% of its reference", 100 * (budget->least_density_ratio - 1),
                100 * (budget->most_density_ratio - 1));
    fprintf(stream, "\n");
}
