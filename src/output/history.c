/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/history.h"

/* "job" + ending, or the reference's bare name. Opens the table. */
static bool open_named(struct table *table, const struct scene *scene, const char *folder, const char *ending,
                       const char *bare, enum table_mode mode)
{
    struct table_style style = {(int)scene->digits, scene->bare_headers};
    bool good = scene->bare_names && bare ? table_open(table, folder, bare, style, mode)
                                          : table_open_job(table, folder, scene->job, ending, style, mode);
    if (good)
        table_by_lines(table);
    return good;
}

/* Totals that are of no particle go by their name alone. */
static void write_curve_name(FILE *stream, const struct scene_curve *curve, bool is_bare)
{
    if (is_bare)
        fprintf(stream, "%-4s%-8ld", curve->result->name, curve->particle + 1);
    else if (curve->result->value)
        fprintf(stream, " \"%s %ld\"", curve->result->name, curve->particle + 1);
    else
        fprintf(stream, " \"%s\"", curve->result->name);
}

static void write_curve_header(struct history *history, const struct scene *scene)
{
    FILE *stream = history->curves.stream;
    fputs(scene->bare_headers ? "Time engk1       engi1       " : "VARIABLES = \"Time\" \"engk\" \"engi\"", stream);
    for (size_t i = 0; i < scene->n_curves; i++)
        write_curve_name(stream, &scene->curves[i], scene->bare_headers);
    table_end_line(&history->curves);
}

static void write_header(struct table *table, const char *names)
{
    fprintf(table->stream, "VARIABLES = %s", names);
    table_end_line(table);
}

bool history_open(struct history *history, const struct scene *scene, const char *folder, enum table_mode mode)
{
    *history = (struct history){0};
    if (!open_named(&history->curves, scene, folder, "_curv.dat", NULL, mode)
        || !open_named(&history->energy, scene, folder, "_energy.dat", "EnergyPlot.dat", mode)
        || !open_named(&history->momentum, scene, folder, "_momentum.dat", "MomentumPlot.dat", mode))
        return false;
    /* the reference leaves an empty table where there is no contact */
    bool has_contact = scene->contact != CONTACT_NONE;
    if ((scene->bare_names || has_contact) && !open_named(&history->contact, scene, folder, "_contact.dat", "ContforcPlot.dat", mode))
        return false;
    if (mode == TABLE_CONTINUED)
        return true;
    write_curve_header(history, scene);
    if (!scene->bare_headers) {
        write_header(&history->energy, "\"Time\" \"total\" \"kinetic\" \"internal\"");
        write_header(&history->momentum, "\"Time\" \"px\" \"py\" \"pz\"");
        if (has_contact)
            write_header(&history->contact, "\"Time\" \"fx\" \"fy\" \"fz\"");
    }
    return true;
}

static double curve_value(const struct scene_curve *curve, const struct result_source *source,
                          const struct history_totals *totals)
{
    if (curve->result->total != TOTAL_NONE)
        return totals->value[curve->result->total];
    return curve->result->value(source, (size_t)source->store->index_of_id[curve->particle]);
}

static void write_line(struct table *table, const double *values, int count)
{
    for (int i = 0; i < count; i++)
        table_real(table, values[i]);
    table_end_line(table);
}

void history_step(struct history *history, const struct scene *scene, const struct result_source *source,
                  const struct history_totals *totals)
{
    const double kinetic = totals->value[TOTAL_KINETIC], internal = totals->value[TOTAL_INTERNAL];
    const double *momentum = &totals->value[TOTAL_MOMENTUM_X];
    table_real(&history->curves, totals->time);
    table_real(&history->curves, kinetic);
    table_real(&history->curves, internal);
    for (size_t i = 0; i < scene->n_curves; i++)
        table_real(&history->curves, curve_value(&scene->curves[i], source, totals));
    table_end_line(&history->curves);
    write_line(&history->energy, (double[]){totals->time, kinetic + internal, kinetic, internal}, 4);
    write_line(&history->momentum, (double[]){totals->time, momentum[0], momentum[1], momentum[2]}, 4);
    if (scene->contact != CONTACT_NONE)
        write_line(&history->contact,
                   (double[]){totals->time, totals->contact[0], totals->contact[1], totals->contact[2]}, 4);
}

bool history_flush(struct history *history)
{
    return table_flush(&history->curves) && table_flush(&history->energy) && table_flush(&history->momentum)
        && (!history->contact.stream || table_flush(&history->contact));
}

bool history_close(struct history *history)
{
    bool curves = table_close(&history->curves);
    bool energy = table_close(&history->energy);
    bool momentum = table_close(&history->momentum);
    bool contact = table_close(&history->contact);
    return curves && energy && momentum && contact;
}
