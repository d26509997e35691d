/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "account.h"
#include "mpm/chunk.h"
#include "process/transformation.h"

/* --- what is in use --- */

static bool always(const struct mpm *mpm) { return mpm != NULL; }
static bool uses_usf(const struct mpm *mpm) { return mpm->scene->scheme == SCHEME_USF; }
static bool uses_usl(const struct mpm *mpm) { return mpm->scene->scheme == SCHEME_USL; }
static bool uses_musl(const struct mpm *mpm) { return mpm->scene->scheme == SCHEME_MUSL; }
static bool uses_linear(const struct mpm *mpm) { return mpm->shape == &shape_linear; }
static bool uses_gimp(const struct mpm *mpm) { return mpm->shape == &shape_gimp || mpm->shape == &shape_gimp_own; }
static bool uses_bimp(const struct mpm *mpm) { return mpm->shape == &shape_bimp; }
static bool uses_centres(const struct mpm *mpm) { return mpm->centres != NULL; }
static bool uses_total(const struct mpm *mpm) { return mpm->is_total; }
static bool uses_small(const struct mpm *mpm) { return mpm->scene->is_small; }
static bool uses_rotation(const struct mpm *mpm) { return mpm->rotate != NULL; }
static bool uses_blending(const struct mpm *mpm) { return mpm->scene->transfer != TRANSFER_FLIP; }
static bool uses_bbar(const struct mpm *mpm) { return mpm->scene->averages_volume; }
static bool uses_viscosity(const struct mpm *mpm) { return mpm->scene->bulk[0] != 0 || mpm->scene->bulk[1] != 0; }
static bool uses_contact(const struct mpm *mpm) { return mpm->contact != NULL; }
static bool uses_loads(const struct mpm *mpm) { return mpm->has_external_force; }
static bool uses_faces(const struct mpm *mpm) { return mpm->n_faces > 0; }
static bool uses_nodal_damping(const struct mpm *mpm) { return mpm->grid->may_damp; }
static bool uses_kinetic_damping(const struct mpm *mpm) { return mpm->damps_kinetic; }
static bool uses_light(const struct mpm *mpm) { return mpm->scene->light_mass > 0; }
static bool uses_schedule(const struct mpm *mpm) { return mpm->schedule != NULL; }
static bool uses_residual(const struct mpm *mpm) { return transformation_has_residual(mpm->scene); }
static bool uses_heat(const struct mpm *mpm) { return mpm->heat != NULL; }
static bool uses_equilibrium(const struct mpm *mpm) { return mpm->equilibrium != NULL; }
static bool uses_smoothing(const struct mpm *mpm) { return store_has(mpm->store, COLUMN_SMOOTHED_PRESSURE); }
static bool uses_curves(const struct mpm *mpm) { return mpm->scene->n_curves > 0; }
static bool uses_animation(const struct mpm *mpm) { return mpm->scene->writes_animation; }
static bool uses_vtk(const struct mpm *mpm) { return mpm->scene->writes_vtk; }
static bool uses_checkpoints(const struct mpm *mpm)
{
    return mpm->scene->restart_steps > 0 || mpm->scene->restart_interval > 0;
}

/* --- memory --- */

static double particle_bytes(const struct mpm *mpm)
{
    return (double)store_bytes_per_particle(mpm->store) * (double)mpm->store->count;
}

static double list_bytes(const struct mpm *mpm)
{
    return cell_list_bytes_per_particle(mpm->cells) * (double)mpm->store->count;
}

static double node_bytes(const struct mpm *mpm)
{
    return (double)grid_bytes(mpm->grid);
}

static double centre_bytes(const struct mpm *mpm)
{
    return (double)grid_bytes(mpm->centres);
}

static double room_bytes(const struct mpm *mpm)
{
    const double history = (double)mpm->store->n_history * (CHUNK_ROOM * sizeof(double) + sizeof(double *));
    return (double)mpm->n_workspaces * ((double)sizeof *mpm->workspaces + history);
}

static const struct account_row {
    const char *name;
    bool (*is_used)(const struct mpm *mpm);
    double (*bytes)(const struct mpm *mpm); /* NULL: code, with next to no memory of its own beside columns */
} rows[] = {
    {"particles (columns, index)", always, particle_bytes},
    {"lists of particles by cell", always, list_bytes},
    {"grid nodes and patches", always, node_bytes},
    {"rooms of threads", always, room_bytes},
    {"staggered centres (sgmp)", uses_centres, centre_bytes},
    {"usf", uses_usf, NULL},
    {"usl", uses_usl, NULL},
    {"musl", uses_musl, NULL},
    {"linear shapes", uses_linear, NULL},
    {"gimp", uses_gimp, NULL},
    {"bimp", uses_bimp, NULL},
    {"total Lagrangian", uses_total, NULL},
    {"small displacements", uses_small, NULL},
    {"rotation of stress (jaum)", uses_rotation, NULL},
    {"blended velocities (xfer)", uses_blending, NULL},
    {"bbar", uses_bbar, NULL},
    {"artificial viscosity (bulk)", uses_viscosity, NULL},
    {"contact", uses_contact, NULL},
    {"loads, gravity, Damp", uses_loads, NULL},
    {"tractions on faces", uses_faces, NULL},
    {"nodal damping", uses_nodal_damping, NULL},
    {"kinetic damping", uses_kinetic_damping, NULL},
    {"light nodes (lite)", uses_light, NULL},
    {"openings", uses_schedule, NULL},
    {"residual stress", uses_residual, NULL},
    {"hot zone", uses_heat, NULL},
    {"static equilibrium", uses_equilibrium, NULL},
    {"smoothed pressure", uses_smoothing, NULL},
    {"curves", uses_curves, NULL},
    {"animation", uses_animation, NULL},
    {"ParaView files", uses_vtk, NULL},
    {"checkpoints", uses_checkpoints, NULL},
};

enum { ROWS = sizeof rows / sizeof rows[0] };

double account_bytes(const struct mpm *mpm)
{
    double bytes = 0;
    for (int i = 0; i < ROWS; i++)
        if (rows[i].bytes && rows[i].is_used(mpm))
            bytes += rows[i].bytes(mpm);
    return bytes;
}

void account_columns(const struct store *store, FILE *stream)
{
    fprintf(stream, "columns in use             numbers        bytes\n");
    for (int c = COLUMN_NONE + 1; c < COLUMN_COUNT; c++) {
        const struct column_row *row = column_row((enum column)c);
        const size_t size = row->is_integer ? sizeof(int32_t) : sizeof(double);
        if (store_has(store, (enum column)c))
            fprintf(stream, "  %-24s %7d %12zu\n", row->name, row->components, (size_t)row->components * size * store->count);
    }
    if (store->n_history > 0)
        fprintf(stream, "  %-24s %7d %12zu\n", "history", store->n_history, (size_t)store->n_history * sizeof(double) * store->count);
}

void account_print(const struct mpm *mpm, FILE *stream)
{
    account_columns(mpm->store, stream);
    fprintf(stream, "parts in use                              bytes\n");
    for (int i = 0; i < ROWS; i++) {
        if (!rows[i].is_used(mpm))
            continue;
        if (rows[i].bytes)
            fprintf(stream, "  %-32s %12.0f\n", rows[i].name, rows[i].bytes(mpm));
        else
            fprintf(stream, "  %s\n", rows[i].name);
    }
    fprintf(stream, "left out:");
    const char *comma = " ";
    for (int i = 0; i < ROWS; i++)
        if (!rows[i].is_used(mpm)) {
            fprintf(stream, "%s%s", comma, rows[i].name);
            comma = ", ";
        }
    fprintf(stream, "\nmemory: %.0f bytes per particle, %.0f of them for the grid\n", account_bytes(mpm) / (double)mpm->store->count,
            node_bytes(mpm) / (double)mpm->store->count);
}
