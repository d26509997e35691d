/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/animation.h"

void animation_header(struct table *table, const struct scene *scene)
{
    fprintf(table->stream, "TITLE = \"%-60.60s\"\n", scene->title);
    if (!scene->bare_headers) {
        fprintf(table->stream, "VARIABLES = \"X\" \"Y\" \"Z\" \"mat\"");
        for (size_t i = 0; i < scene->n_results; i++)
            fprintf(table->stream, " \"%s\"", scene->results[i]->name);
    } else {
        fprintf(table->stream, "VARIABLES= \"X\"   \"Y\"   \"Z\"   \"mat \"");
        for (size_t i = 0; i < scene->n_results; i++)
            fprintf(table->stream, " \"%-4s\"", scene->results[i]->name);
    }
    fputc('\n', table->stream);
}

static void write_row(struct table *table, const struct scene *scene, const struct result_source *source, size_t p)
{
    const struct store *store = source->store;
    for (int a = 0; a < 3; a++)
        table_real(table, store->real[COLUMN_POSITION][a][p]);
    fprintf(table->stream, " %2d", source->body_material_number[store->integer[COLUMN_BODY][p]]);
    for (size_t i = 0; i < scene->n_results; i++) {
        double value = scene->results[i]->value(source, p);
        if (scene->results[i]->is_integer)
            fprintf(table->stream, " %2d", (int)value);
        else
            table_real(table, value);
    }
    table_end_line(table);
}

/* The zone of the particles with ids first ... last - 1. */
static void write_zone(struct table *table, const struct scene *scene, const struct result_source *source,
                       const unsigned char *is_shown, double time, long first, long last, long body)
{
    size_t rows = 0;
    for (long id = first; id < last; id++)
        rows += is_shown[id] && result_is_shown(source, (size_t)source->store->index_of_id[id]);
    fprintf(table->stream, scene->bare_headers ? "ZONE T=\"time %10.3E" : "ZONE T=\"time %.3E", time);
    if (body > 0)
        fprintf(table->stream, " body %ld", body);
    if (!scene->bare_headers)
        fprintf(table->stream, "\" I=%zu, F=POINT, STRANDID=%ld, SOLUTIONTIME=%.9E\n", rows, body > 0 ? body : 1, time);
    else
        fprintf(table->stream, "\"\n");
    for (long id = first; id < last; id++)
        if (is_shown[id] && result_is_shown(source, (size_t)source->store->index_of_id[id]))
            write_row(table, scene, source, (size_t)source->store->index_of_id[id]);
}

bool animation_zone(struct table *table, const struct scene *scene, const struct result_source *source,
                    const unsigned char *is_shown, double time)
{
    for (size_t b = 0; b < scene->n_bodies && scene->zones_by_body; b++) {
        const struct scene_body *body = &scene->bodies[b];
        write_zone(table, scene, source, is_shown, time, body->first, body->first + body->count, (long)b + 1);
    }
    if (!scene->zones_by_body)
        write_zone(table, scene, source, is_shown, time, 0, (long)source->store->count, 0);
    return table_flush(table);
}
