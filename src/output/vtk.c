/* SPDX-License-Identifier: GPL-3.0-or-later */
#define _POSIX_C_SOURCE 200809L
#include "output/vtk.h"
#include "base/memory.h"
#include "base/methods.h"
#include "base/status.h"
#include "base/tensor.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Small files are text, to be read and compared; others are binary, unless the deck says. */
enum { LARGEST_TEXT = 20000, LARGEST_GRID = 2000000 };

/* --- data arrays: text in place, or base64 behind the tree --- */

struct writer {
    FILE *stream;
    bool is_binary;
    int digits;
    uint64_t offset; /* in the appended data, of the next array */
};

/* A data array: `count` tuples, of which value(context, i, c) is component c. */
struct data_array {
    const char *type; /* Float64, Int64, UInt8 */
    const char *name;
    int components;
    size_t count;
    double (*value)(const void *context, size_t i, int component);
    const void *context;
};

static size_t type_size(const struct data_array *array)
{
    return strcmp(array->type, "UInt8") == 0 ? 1 : 8;
}

static void write_base64(FILE *stream, const unsigned char *bytes, size_t count)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < count; i += 3) {
        unsigned long group = (unsigned long)bytes[i] << 16;
        group |= i + 1 < count ? (unsigned long)bytes[i + 1] << 8 : 0;
        group |= i + 2 < count ? bytes[i + 2] : 0;
        char out[4] = {letters[group >> 18 & 63], letters[group >> 12 & 63], i + 1 < count ? letters[group >> 6 & 63] : '=',
                       i + 2 < count ? letters[group & 63] : '='};
        fwrite(out, 1, 4, stream);
    }
}

/* Puts the low `size` bytes of a number in little-endian order. */
static void put_little_endian(unsigned char *target, uint64_t bits, size_t size)
{
    for (size_t i = 0; i < size; i++)
        target[i] = (unsigned char)(bits >> (8 * i));
}

static void put_value(unsigned char *target, const struct data_array *array, double value)
{
    uint64_t bits = (uint64_t)(int64_t)value;
    if (strcmp(array->type, "Float64") == 0)
        memcpy(&bits, &value, sizeof bits);
    put_little_endian(target, bits, type_size(array));
}

static void write_appended(struct writer *writer, const struct data_array *array)
{
    size_t size = type_size(array), bytes = array->count * (size_t)array->components * size;
    unsigned char *block = memory_array(bytes + 8, 1, "ParaView output");
    put_little_endian(block, bytes, 8);
    for (size_t i = 0; i < array->count; i++)
        for (int c = 0; c < array->components; c++)
            put_value(block + 8 + (i * (size_t)array->components + (size_t)c) * size, array, array->value(array->context, i, c));
    write_base64(writer->stream, block, bytes + 8);
    memory_free(block);
}

static void write_text(struct writer *writer, const struct data_array *array)
{
    bool is_real = strcmp(array->type, "Float64") == 0;
    for (size_t i = 0; i < array->count; i++) {
        for (int c = 0; c < array->components; c++) {
            double value = array->value(array->context, i, c);
            if (is_real)
                fprintf(writer->stream, "%s%.*E", c ? " " : "", writer->digits - 1, value);
            else
                fprintf(writer->stream, "%s%.0f", c ? " " : "", value);
        }
        fputc('\n', writer->stream);
    }
}

/* The element of an array in the tree; its data too when the file is text. */
static void write_array(struct writer *writer, const struct data_array *array)
{
    fprintf(writer->stream, "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" ", array->type, array->name,
            array->components);
    if (writer->is_binary) {
        size_t bytes = array->count * (size_t)array->components * type_size(array) + 8;
        fprintf(writer->stream, "format=\"appended\" offset=\"%" PRIu64 "\"/>\n", writer->offset);
        writer->offset += (bytes + 2) / 3 * 4;
    } else {
        fprintf(writer->stream, "format=\"ascii\">\n");
        write_text(writer, array);
        fprintf(writer->stream, "</DataArray>\n");
    }
}

/* --- particles --- */

struct particle_array {
    const char *name;
    const char *result; /* its value is that of a result, or */
    double (*value)(const struct result_source *source, size_t p);
    double sign;
    unsigned methods; /* METHODS_... that have it; 0: those of the result, or all */
};

/* The particles of a file, in the order of their ids: places in memory. */
struct shown {
    const struct result_source *source;
    int32_t *places;
    size_t count;
};

static struct shown list_shown(const struct result_source *source)
{
    const struct store *store = source->store;
    struct shown shown = {source, memory_array(store->count, sizeof *shown.places, "output"), 0};
    for (size_t id = 0; id < store->count; id++)
        if (result_is_shown(source, (size_t)store->index_of_id[id]))
            shown.places[shown.count++] = store->index_of_id[id];
    return shown;
}

/* What a column of the arrays below is computed from. */
struct particle_context {
    const struct shown *shown;
    const struct particle_array *array;
    double (*value)(const struct result_source *source, size_t p);
};

static double load_x(const struct result_source *s, size_t p)
{
    return store_has(s->store, COLUMN_LOAD) ? s->store->real[COLUMN_LOAD][0][p] : 0;
}

static double load_y(const struct result_source *s, size_t p)
{
    return store_has(s->store, COLUMN_LOAD) ? s->store->real[COLUMN_LOAD][1][p] : 0;
}

static double load_z(const struct result_source *s, size_t p)
{
    return store_has(s->store, COLUMN_LOAD) ? s->store->real[COLUMN_LOAD][2][p] : 0;
}

static double smoothed_pressure(const struct result_source *s, size_t p)
{
    return store_has(s->store, COLUMN_SMOOTHED_PRESSURE) ? s->store->real[COLUMN_SMOOTHED_PRESSURE][0][p] : 0;
}

static double body_number(const struct result_source *s, size_t p)
{
    return s->store->integer[COLUMN_BODY][p] + 1;
}

static double particle_number(const struct result_source *s, size_t p)
{
    return s->store->integer[COLUMN_ID][p] + 1;
}

static const struct particle_array particle_arrays[] = {
    {.name = "id", .value = particle_number, .sign = 1},
    {.name = "body", .value = body_number, .sign = 1},
    {.name = "mat", .result = "mat", .sign = 1},
    {.name = "seqv", .result = "seqv", .sign = 1},
    {.name = "epeff", .result = "epef", .sign = 1},
    {.name = "pressure", .result = "pres", .sign = 1},
    {.name = "Smoothpressure", .value = smoothed_pressure, .sign = 1, .methods = METHODS_MPM},
    {.name = "MeanNormalStress", .result = "pres", .sign = -1},
    {.name = "SmoothMeanNormalStress", .value = smoothed_pressure, .sign = -1, .methods = METHODS_MPM},
    {.name = "vx", .result = "velx", .sign = 1},
    {.name = "vy", .result = "vely", .sign = 1},
    {.name = "vz", .result = "velz", .sign = 1},
    {.name = "disx", .result = "disx", .sign = 1},
    {.name = "disy", .result = "disy", .sign = 1},
    {.name = "disz", .result = "disz", .sign = 1},
    {.name = "fxpx", .value = load_x, .sign = 1, .methods = METHODS_MPM},
    {.name = "fxpy", .value = load_y, .sign = 1, .methods = METHODS_MPM},
    {.name = "fxpz", .value = load_z, .sign = 1, .methods = METHODS_MPM},
    {.name = "vol", .result = "volu", .sign = 1},
    {.name = "celsius_t", .result = "cels", .sign = 1},
    {.name = "damage", .result = "damg", .sign = 1},
    {.name = "stressx", .result = "stsx", .sign = 1},
    {.name = "stressy", .result = "stsy", .sign = 1},
    {.name = "stressz", .result = "stsz", .sign = 1},
    {.name = "stressyz", .result = "styz", .sign = 1},
    {.name = "stressxz", .result = "stxz", .sign = 1},
    {.name = "stressxy", .result = "stxy", .sign = 1},
};

enum { PARTICLE_ARRAYS = sizeof particle_arrays / sizeof particle_arrays[0] };

static bool has_array(const struct scene *scene, const struct particle_array *array)
{
    const unsigned methods = array->result ? result_find(array->result)->methods : array->methods;
    return methods_include(methods, scene_method(scene));
}

/* Whether a result of the deck stands in the table above, under a name that users of MPM3D know. */
static bool is_listed(const struct result *result)
{
    bool is_listed = false;
    for (int i = 0; i < PARTICLE_ARRAYS; i++)
        is_listed = is_listed || (particle_arrays[i].result && result_find(particle_arrays[i].result) == result);
    return is_listed;
}

/* The arrays of a scene: those of the table, and with smoothed particles the deck's other results. Returns how many. */
static int choose_arrays(const struct scene *scene, struct particle_array *chosen)
{
    int n = 0;
    for (int i = 0; i < PARTICLE_ARRAYS; i++)
        if (has_array(scene, &particle_arrays[i]))
            chosen[n++] = particle_arrays[i];
    for (size_t i = 0; i < scene->n_results && scene->method != METHOD_MPM; i++)
        if (!is_listed(scene->results[i]))
            chosen[n++] = (struct particle_array){.name = scene->results[i]->name, .result = scene->results[i]->name, .sign = 1};
    return n;
}

/* Particles in the order of their ids. */
static double particle_value(const void *context, size_t i, int component)
{
    const struct particle_context *c = context;
    (void)component;
    return c->array->sign * c->value(c->shown->source, (size_t)c->shown->places[i]);
}

static double particle_position(const void *context, size_t i, int component)
{
    const struct shown *shown = context;
    return shown->source->store->real[COLUMN_POSITION][component][shown->places[i]];
}

static double own_index(const void *context, size_t i, int component)
{
    (void)context;
    (void)component;
    return (double)i;
}

static double next_index(const void *context, size_t i, int component)
{
    return own_index(context, i, component) + 1;
}

static double vertex_type(const void *context, size_t i, int component)
{
    (void)context;
    (void)i;
    (void)component;
    return 1;
}

/* --- files --- */

/* "folder/jobENDING"; the caller frees it. */
static char *file_name(const struct vtk_series *series, const char *ending)
{
    size_t size = strlen(series->folder) + strlen(series->job) + strlen(ending) + 2;
    char *name = memory_array(size, 1, "a file name");
    snprintf(name, size, "%s%s%s%s", series->folder, *series->folder ? "/" : "", series->job, ending);
    return name;
}

/* Opens a file next to `name`, to be renamed when it is whole. */
static FILE *open_part(const char *name, char **part)
{
    size_t size = strlen(name) + 6;
    *part = memory_array(size, 1, "a file name");
    snprintf(*part, size, "%s.part", name);
    FILE *stream = fopen(*part, "wb");
    if (!stream)
        status_error("cannot create '%s': %s", *part, strerror(errno));
    errno = 0;
    return stream;
}

/* Closes it and gives it its name. */
static bool close_part(FILE *stream, const char *name, char *part)
{
    bool good = false;
    if (stream) {
        const bool had_error = ferror(stream) != 0;
        if (!had_error) /* else it tells why writing failed */
            errno = 0;
        good = fclose(stream) == 0 && !had_error && rename(part, name) == 0;
        if (!good) {
            status_error("cannot write '%s': %s", name, strerror(errno ? errno : EIO));
            remove(part);
        }
    }
    memory_free(part);
    return good;
}

static void write_tree(struct writer *writer, const struct data_array *point_data, int n_point_data,
                       const struct data_array *points, const struct data_array cells[3])
{
    FILE *stream = writer->stream;
    fprintf(stream, "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
                    "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n");
    fprintf(stream, "<Piece NumberOfPoints=\"%zu\" NumberOfCells=\"%zu\">\n<PointData>\n", points->count, cells[1].count);
    for (int i = 0; i < n_point_data; i++)
        write_array(writer, &point_data[i]);
    fprintf(stream, "</PointData>\n<Points>\n");
    write_array(writer, points);
    fprintf(stream, "</Points>\n<Cells>\n");
    for (int i = 0; i < 3; i++)
        write_array(writer, &cells[i]);
    fprintf(stream, "</Cells>\n</Piece>\n</UnstructuredGrid>\n");
    if (writer->is_binary) {
        fprintf(stream, "<AppendedData encoding=\"base64\">\n_");
        for (int i = 0; i < n_point_data; i++)
            write_appended(writer, &point_data[i]);
        write_appended(writer, points);
        for (int i = 0; i < 3; i++)
            write_appended(writer, &cells[i]);
        fprintf(stream, "\n</AppendedData>\n");
    }
    fprintf(stream, "</VTKFile>\n");
}

static bool write_particles(const struct scene *scene, const struct result_source *source, const char *name)
{
    const size_t most = PARTICLE_ARRAYS + scene->n_results;
    struct particle_array *chosen = memory_array(most, sizeof *chosen, "output");
    struct particle_context *contexts = memory_array(most, sizeof *contexts, "output");
    struct data_array *arrays = memory_array(most, sizeof *arrays, "output");
    struct shown shown = list_shown(source);
    const size_t count = shown.count;
    const int n_arrays = choose_arrays(scene, chosen);
    for (int i = 0; i < n_arrays; i++) {
        const struct particle_array *array = &chosen[i];
        contexts[i] = (struct particle_context){&shown, array, array->result ? result_find(array->result)->value : array->value};
        arrays[i] = (struct data_array){"Float64", array->name, 1, count, particle_value, &contexts[i]};
    }
    const struct data_array points = {"Float64", "Points", 3, count, particle_position, &shown};
    const struct data_array cells[3] = {{"Int64", "connectivity", 1, count, own_index, NULL},
                                        {"Int64", "offsets", 1, count, next_index, NULL},
                                        {"UInt8", "types", 1, count, vertex_type, NULL}};
    char *part;
    bool is_binary = scene->vtk_format == VTK_BINARY || (scene->vtk_format == VTK_AUTO && count > LARGEST_TEXT);
    struct writer writer = {open_part(name, &part), is_binary, (int)scene->digits, 0};
    if (writer.stream)
        write_tree(&writer, arrays, n_arrays, &points, cells);
    memory_free(shown.places);
    memory_free(arrays);
    memory_free(contexts);
    memory_free(chosen);
    return close_part(writer.stream, name, part);
}

bool vtk_write_list(const struct vtk_series *series)
{
    char *name = file_name(series, "_anim.pvd"), *part;
    FILE *stream = open_part(name, &part);
    if (stream) {
        fprintf(stream, "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\" "
                        "header_type=\"UInt64\">\n<Collection>\n");
        for (size_t i = 0; i < series->count; i++)
            fprintf(stream, "<DataSet timestep=\"%.9E\" part=\"0\" file=\"%s_anim_%zu.vtu\"/>\n", series->times[i],
                    series->job, i + 1);
        fprintf(stream, "</Collection>\n</VTKFile>\n");
    }
    bool good = close_part(stream, name, part);
    memory_free(name);
    return good;
}

void vtk_open(struct vtk_series *series, const char *folder, const char *job)
{
    *series = (struct vtk_series){.folder = memory_text(folder, strlen(folder)), .job = memory_text(job, strlen(job))};
}

void vtk_close(struct vtk_series *series)
{
    memory_free(series->folder);
    memory_free(series->job);
    memory_free(series->times);
}

double *vtk_resume(struct vtk_series *series, size_t count)
{
    series->times = memory_grow(series->times, &series->capacity, count, sizeof *series->times, "output");
    series->count = count;
    return series->times;
}

bool vtk_write(struct vtk_series *series, const struct scene *scene, const struct result_source *source, double time)
{
    char ending[40];
    series->times = memory_grow(series->times, &series->capacity, series->count + 1, sizeof *series->times, "output");
    series->times[series->count++] = time;
    snprintf(ending, sizeof ending, "_anim_%zu.vtu", series->count);
    char *name = file_name(series, ending);
    bool good = write_particles(scene, source, name);
    memory_free(name);
    return good && vtk_write_list(series);
}

/* --- the background grid --- */

struct grid_context {
    double low[3], size;
    size_t cells[3];
};

static double node_position(const void *context, size_t i, int component)
{
    const struct grid_context *grid = context;
    size_t at[3] = {i % (grid->cells[0] + 1), i / (grid->cells[0] + 1) % (grid->cells[1] + 1),
                    i / ((grid->cells[0] + 1) * (grid->cells[1] + 1))};
    return grid->low[component] + (double)at[component] * grid->size;
}

/* Voxels list x fastest, then y, then z. */
static double cell_node(const void *context, size_t i, int component)
{
    const struct grid_context *grid = context;
    const size_t cell = i / 8, corner = i % 8;
    size_t at[3] = {cell % grid->cells[0], cell / grid->cells[0] % grid->cells[1], cell / (grid->cells[0] * grid->cells[1])};
    (void)component;
    for (int a = 0; a < 3; a++)
        at[a] += corner >> a & 1;
    return (double)(at[0] + (grid->cells[0] + 1) * (at[1] + (grid->cells[1] + 1) * at[2]));
}

static double cell_end(const void *context, size_t i, int component)
{
    (void)context;
    (void)component;
    return 8 * (double)(i + 1);
}

static double voxel_type(const void *context, size_t i, int component)
{
    return 11 * vertex_type(context, i, component);
}

bool vtk_write_grid(const struct vtk_series *series, const struct scene *scene)
{
    struct grid_context grid = {.size = scene->cell_size};
    size_t nodes = 1, cells = 1;
    double all = 1;
    for (int a = 0; a < 3; a++) {
        double number = trunc((scene->grid[2 * a + 1] - scene->grid[2 * a]) / scene->cell_size + 0.5);
        grid.low[a] = scene->grid[2 * a];
        grid.cells[a] = (size_t)number;
        all *= number + 1;
        nodes *= grid.cells[a] + 1;
        cells *= grid.cells[a];
    }
    if (all > LARGEST_GRID) /* nobody looks at that many cells */
        return true;
    const struct data_array points = {"Float64", "Points", 3, nodes, node_position, &grid};
    const struct data_array arrays[3] = {{"Int64", "connectivity", 1, 8 * cells, cell_node, &grid},
                                         {"Int64", "offsets", 1, cells, cell_end, NULL},
                                         {"UInt8", "types", 1, cells, voxel_type, NULL}};
    char *name = file_name(series, "_Grid.vtu"), *part;
    struct writer writer = {open_part(name, &part), scene->vtk_format == VTK_BINARY || cells > LARGEST_TEXT,
                            (int)scene->digits, 0};
    if (writer.stream)
        write_tree(&writer, NULL, 0, &points, arrays);
    bool good = close_part(writer.stream, name, part);
    memory_free(name);
    return good;
}
