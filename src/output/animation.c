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
    fputc('\n', table->stream);
}

bool animation_zone(struct table *table, const struct scene *scene, const struct result_source *source,
                    const unsigned char *is_shown, double time)
{
    const struct store *store = source->store;
    size_t rows = 0;
    for (size_t id = 0; id < store->count; id++)
        rows += is_shown[id] != 0;
    if (scene->bare_headers)
        fprintf(table->stream, "ZONE T=\"time %10.3E\"\n", time);
    else
        fprintf(table->stream, "ZONE T=\"time %.3E\" I=%zu, F=POINT, STRANDID=1, SOLUTIONTIME=%.9E\n", time, rows, time);
    for (size_t id = 0; id < store->count; id++)
        if (is_shown[id])
            write_row(table, scene, source, (size_t)store->index_of_id[id]);
    return table_flush(table);
}
