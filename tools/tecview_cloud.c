/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * tecview_cloud: see tecview_cloud.h.
 *
 * A particle stands for the material half way to its neighbours. So a body that is stretched or
 * pressed is drawn without gaps: the box of a point reaches half way to the nearest point ahead and
 * behind along each axis, or as far as on the other side where the body ends.
 */
#define _POSIX_C_SOURCE 200809L

#include "tecview_cloud.h"
#include "base/memory.h"
#include "tecplot_find.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { SAMPLES = 256 };

/* Points further apart than this many spacings are no neighbours: the body ends between them. */
static const double reach = 1.8;

/* Largest stretch that this is increased by. */
static const double most_stretched = 1.6;

/* Neighbours nearer than this part of the spacing do not make a box any smaller. */
static const double smallest_part = 0.4;

/* A neighbour along an axis is at most this far beside it, as a part of the way along, squared. */
static const double widest = 0.4;

/* ---- spacing ---- */

static double squared_distance(const double a[3], const double b[3])
{
    double sum = 0.0;
    for (int i = 0; i < 3; ++i)
        sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

/* The distance of a point from the nearest that is not at the same place; infinite without one. */
static double nearest_distance(const double (*positions)[3], size_t count, size_t point)
{
    double best = HUGE_VAL;
    for (size_t i = 0; i < count; ++i) {
        const double distance = squared_distance(positions[i], positions[point]);
        if (distance < best && distance > 0.0)
            best = distance;
    }
    return sqrt(best);
}

/* The middle one of the nearest distances of some points, spread over the list; 0 for none. */
static double typical_distance(const double (*positions)[3], size_t count)
{
    double distances[SAMPLES];
    size_t found = 0;
    const size_t samples = count < SAMPLES ? count : SAMPLES;
    for (size_t i = 0; i < samples; ++i) {
        const double distance = nearest_distance(positions, count, i * count / samples);
        size_t place = found;
        if (!isfinite(distance))
            continue;
        for (; place > 0 && distances[place - 1] > distance; --place)
            distances[place] = distances[place - 1];
        distances[place] = distance;
        ++found;
    }
    return found > 0 ? distances[found / 2] : 0.0;
}

/* The spacing in the first zone that has points, where the body is not yet deformed. */
static double first_spacing(const struct tecplot_file *file, const size_t columns[3])
{
    size_t number = 0;
    while (number + 1 < file->zone_count && file->zones[number].row_count < 2)
        ++number;
    const struct tecplot_zone *zone = &file->zones[number];
    double(*positions)[3] = memory_array(zone->row_count, sizeof *positions, "the points");
    for (size_t i = 0; i < zone->row_count; ++i)
        for (int axis = 0; axis < 3; ++axis)
            positions[i][axis] = zone->values[i * file->variable_count + columns[axis]];
    const double spacing = typical_distance((const double(*)[3])positions, zone->row_count);
    memory_free(positions);
    return spacing > 0.0 ? spacing : 1.0;
}

/* ---- sizes ---- */

/* Points in boxes of side `side`, found by a hash of the box. */
struct cells {
    const struct tecview_cloud *cloud;
    double side;
    size_t mask;
    size_t *first; /* by hash: one more than the first point, 0 for none */
    size_t *next;  /* by point: likewise the next one */
};

static size_t hash_of(const struct cells *cells, const int64_t cell[3])
{
    const uint64_t mixed = (uint64_t)cell[0] * 0x9E3779B97F4A7C15U ^
                           (uint64_t)cell[1] * 0xC2B2AE3D27D4EB4FU ^
                           (uint64_t)cell[2] * 0x165667B19E3779F9U;
    return (size_t)(mixed >> 20) & cells->mask;
}

static void cell_of(const struct cells *cells, size_t point, int64_t cell[3])
{
    for (int axis = 0; axis < 3; ++axis)
        cell[axis] = (int64_t)fmin(
            fmax(floor(cells->cloud->positions[point][axis] / cells->side), -1e15), 1e15);
}

static void open_cells(const struct tecview_cloud *cloud, double side, struct cells *cells)
{
    *cells = (struct cells){.cloud = cloud, .side = side, .mask = 1023};
    while (cells->mask < 2 * cloud->count)
        cells->mask = 2 * cells->mask + 1;
    cells->first = memory_array(cells->mask + 1, sizeof *cells->first, "the neighbours");
    cells->next = memory_array(cloud->count, sizeof *cells->next, "the neighbours");
    for (size_t i = 0; i < cloud->count; ++i) {
        int64_t cell[3];
        cell_of(cells, i, cell);
        const size_t hash = hash_of(cells, cell);
        cells->next[i] = cells->first[hash];
        cells->first[hash] = i + 1;
    }
}

static void close_cells(struct cells *cells)
{
    memory_free(cells->first);
    memory_free(cells->next);
}

/* The nearest neighbour so far behind and ahead along each axis. */
struct neighbours {
    double squared[3][2]; /* distance */
    double along[3][2];   /* its part along the axis */
};

/* A neighbour counts for the axis that it lies along; one that lies between two axes for none,
 * since where a body is sheared it may be one of the same row. */
static void consider(struct neighbours *found, const double here[3], const double there[3])
{
    int longest = 0;
    double part[3] = {0};
    for (int axis = 0; axis < 3; ++axis) {
        part[axis] = there[axis] - here[axis];
        if (fabs(part[axis]) > fabs(part[longest]))
            longest = axis;
    }
    const double along = part[longest] * part[longest];
    const double squared = part[0] * part[0] + part[1] * part[1] + part[2] * part[2];
    const int side = part[longest] > 0.0;
    if (squared > 0.0 && squared - along < widest * along &&
        squared < found->squared[longest][side]) {
        found->squared[longest][side] = squared;
        found->along[longest][side] = fabs(part[longest]);
    }
}

/* Looks into the cells up to `width` cells away. */
static void search(const struct cells *cells, size_t point, int64_t width, struct neighbours *found)
{
    const struct tecview_cloud *cloud = cells->cloud;
    int64_t centre[3], cell[3];
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side)
            found->squared[axis][side] = found->along[axis][side] = HUGE_VAL;
    cell_of(cells, point, centre);
    for (cell[0] = centre[0] - width; cell[0] <= centre[0] + width; ++cell[0])
        for (cell[1] = centre[1] - width; cell[1] <= centre[1] + width; ++cell[1])
            for (cell[2] = centre[2] - width; cell[2] <= centre[2] + width; ++cell[2])
                for (size_t other = cells->first[hash_of(cells, cell)]; other > 0;
                     other = cells->next[other - 1])
                    consider(found, cloud->positions[point], cloud->positions[other - 1]);
}

static double half_size(const double along[2], double spacing, double longest)
{
    double sum = 0.0;
    int sides = 0;
    for (int side = 0; side < 2; ++side)
        if (along[side] <= longest) {
            sum += along[side];
            ++sides;
        }
    return 0.5 * (sides > 0 ? fmax(sum / sides, smallest_part * spacing) : spacing);
}

/* A body pressed to a part of its size along one axis, its volume kept, is stretched along the two
 * others by one over the root of that part: neighbours are sought that much further away. */
static double longest_way(const struct neighbours *found, double spacing)
{
    double shortest = spacing;
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side)
            shortest = fmin(shortest, found->along[axis][side]);
    return reach * spacing * fmin(sqrt(spacing / shortest), most_stretched);
}

static void find_sizes(struct tecview_cloud *cloud)
{
    struct cells cells;
    open_cells(cloud, reach * cloud->spacing, &cells);
    for (size_t i = 0; i < cloud->count; ++i) {
        struct neighbours found;
        search(&cells, i, 1, &found);
        const double longest = longest_way(&found, cloud->spacing);
        if (longest > reach * cloud->spacing)
            search(&cells, i, 2, &found);
        for (int axis = 0; axis < 3; ++axis)
            cloud->halves[i][axis] = half_size(found.along[axis], cloud->spacing, longest);
    }
    close_cells(&cells);
}

/* ---- points of the file ---- */

struct columns {
    size_t place[3];
    size_t value;
    size_t displacement[3]; /* SIZE_MAX for none along that axis */
};

static bool find_displacements(const struct tecview_request *request,
                               const struct tecplot_file *file, struct columns *columns)
{
    const char *cursor = request->deform[0];
    for (int axis = 0; axis < 3; ++axis)
        columns->displacement[axis] = SIZE_MAX;
    for (int axis = 0; cursor != NULL && axis < 3; ++axis) {
        char name[64];
        const size_t length = strcspn(cursor, ",");
        (void)snprintf(name, sizeof name, "%.*s", (int)(length < 63 ? length : 63), cursor);
        if (strcmp(name, "0") != 0 &&
            !tecplot_find_column("tecview", file, name, &columns->displacement[axis]))
            return false;
        cursor += length;
        if ((*cursor == ',') != (axis < 2))
            return tecview_complain("--deform needs three variables, such as disx,disy,disz, not",
                                    request->deform[0]);
        ++cursor;
    }
    return true;
}

static bool find_columns(const struct tecview_request *request, const struct tecplot_file *file,
                         struct columns *columns)
{
    static const char *const names[3] = {"X", "Y", "Z"};
    for (int axis = 0; axis < 3; ++axis)
        if (!tecplot_find_column("tecview", file, names[axis], &columns->place[axis]))
            return false;
    return tecplot_find_column("tecview", file, request->of, &columns->value) &&
           find_displacements(request, file, columns);
}

/* Whether each row is to be drawn: it meets the conditions and is somewhere. */
static bool choose_rows(const struct tecview_request *request, const struct tecplot_file *file,
                        const struct tecplot_zone *zone, const struct columns *columns,
                        bool *chosen)
{
    for (size_t i = 0; i < zone->row_count; ++i) {
        const double *row = &zone->values[i * file->variable_count];
        chosen[i] = isfinite(row[columns->place[0]]) && isfinite(row[columns->place[1]]) &&
                    isfinite(row[columns->place[2]]);
    }
    for (size_t c = 0; c < request->condition_count; ++c) {
        const struct tecview_condition *condition = &request->conditions[c];
        size_t column;
        if (!tecplot_find_column("tecview", file, condition->variable, &column))
            return false;
        for (size_t i = 0; i < zone->row_count; ++i) {
            const double value = zone->values[i * file->variable_count + column];
            chosen[i] = chosen[i] && value >= condition->low && value <= condition->high;
        }
    }
    return true;
}

static double displacement(const struct columns *columns, const double *row, int axis)
{
    const size_t column = columns->displacement[axis];
    return column == SIZE_MAX || !isfinite(row[column]) ? 0.0 : row[column];
}

/* The scale that shows the largest displacement as a tenth of the body's size: 1, 2 or 5 times a
 * power of ten, and 1 at least. */
static double automatic_scale(const struct tecplot_file *file, const struct tecplot_zone *zone,
                              const struct columns *columns, const bool *chosen)
{
    double largest = 0.0;
    double size = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        double low = HUGE_VAL;
        double high = -HUGE_VAL;
        for (size_t i = 0; i < zone->row_count; ++i) {
            const double *row = &zone->values[i * file->variable_count];
            if (!chosen[i])
                continue;
            low = fmin(low, row[columns->place[axis]]);
            high = fmax(high, row[columns->place[axis]]);
            largest = fmax(largest, fabs(displacement(columns, row, axis)));
        }
        size = fmax(size, high - low);
    }
    if (!(largest > 0.0) || 0.1 * size <= largest)
        return 1.0;
    const double rough = 0.1 * size / largest;
    const double power = pow(10.0, floor(log10(rough)));
    return power * (rough >= 5.0 * power ? 5.0 : rough >= 2.0 * power ? 2.0 : 1.0);
}

static bool find_scale(const struct tecview_request *request, const struct tecplot_file *file,
                       const struct tecplot_zone *zone, const struct columns *columns,
                       const bool *chosen, double *scale)
{
    const char *text = request->deform[1];
    *scale = 1.0;
    if (text == NULL)
        return true;
    if (strcmp(text, "auto") == 0)
        *scale = automatic_scale(file, zone, columns, chosen);
    else if (tecplot_number(text, strlen(text), scale) != NULL || !isfinite(*scale))
        return tecview_complain("--deform: the scale must be a number or auto, not", text);
    return true;
}

/* Counts a value of the row; the smallest and largest are remembered with their places. */
static void take_value(struct tecview_cloud *cloud, const struct columns *columns,
                       const double *row)
{
    const double value = row[columns->value];
    const bool lowest = cloud->count == cloud->nan_count || value < cloud->low;
    const bool highest = cloud->count == cloud->nan_count || value > cloud->high;
    cloud->values[cloud->count] = isfinite(value) ? value : (double)NAN;
    if (!isfinite(value)) {
        ++cloud->nan_count;
        return;
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (lowest)
            cloud->low_place[axis] = row[columns->place[axis]];
        if (highest)
            cloud->high_place[axis] = row[columns->place[axis]];
    }
    cloud->low = lowest ? value : cloud->low;
    cloud->high = highest ? value : cloud->high;
}

static void take_rows(const struct tecplot_file *file, const struct tecplot_zone *zone,
                      const struct columns *columns, const bool *chosen,
                      struct tecview_cloud *cloud)
{
    cloud->positions = memory_array(zone->row_count, sizeof *cloud->positions, "the points");
    cloud->halves = memory_array(zone->row_count, sizeof *cloud->halves, "the points");
    cloud->values = memory_array(zone->row_count, sizeof *cloud->values, "the points");
    for (size_t i = 0; i < zone->row_count; ++i) {
        const double *row = &zone->values[i * file->variable_count];
        if (!chosen[i])
            continue;
        for (int axis = 0; axis < 3; ++axis)
            cloud->positions[cloud->count][axis] =
                row[columns->place[axis]] +
                (cloud->deform_scale - 1.0) * displacement(columns, row, axis);
        take_value(cloud, columns, row);
        ++cloud->count;
    }
}

/* A given spacing is the size of all points; else each has its own. */
static void take_sizes(const struct tecview_request *request, const struct tecplot_file *file,
                       const struct columns *columns, struct tecview_cloud *cloud)
{
    if (isnan(request->spacing)) {
        cloud->spacing = first_spacing(file, columns->place);
        find_sizes(cloud);
        return;
    }
    cloud->spacing = request->spacing;
    for (size_t i = 0; i < cloud->count; ++i)
        for (int axis = 0; axis < 3; ++axis)
            cloud->halves[i][axis] = 0.5 * cloud->spacing;
}

bool tecview_cloud_open(const struct tecview_request *request, const struct tecplot_file *file,
                        const struct tecplot_zone *zone, struct tecview_cloud *cloud)
{
    struct columns columns;
    *cloud = (struct tecview_cloud){0};
    if (!find_columns(request, file, &columns))
        return false;
    bool *chosen = memory_array(zone->row_count, sizeof *chosen, "the points");
    const bool done = choose_rows(request, file, zone, &columns, chosen) &&
                      find_scale(request, file, zone, &columns, chosen, &cloud->deform_scale);
    if (done)
        take_rows(file, zone, &columns, chosen, cloud);
    memory_free(chosen);
    if (!done)
        return false;
    if (cloud->count == 0) {
        fprintf(stderr, "tecview: error: %s: no point to draw: the zone has %zu rows\n",
                request->paths[0], zone->row_count);
        tecview_cloud_close(cloud);
        return false;
    }
    take_sizes(request, file, &columns, cloud);
    return true;
}

void tecview_cloud_close(struct tecview_cloud *cloud)
{
    memory_free(cloud->positions);
    memory_free(cloud->halves);
    memory_free(cloud->values);
}
