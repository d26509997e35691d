/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/schedule.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Heights and tracks that differ by less than this part of the spacing are one. */
static const double SAME = 1e-3;

struct schedule {
    size_t *openings; /* particles of each one to come */
    size_t n_openings, next;
    size_t left;
    long interval;
};

/* What decides when a particle opens. */
struct place {
    double height, track, along;
    int32_t layer, id;
    bool is_open;
};

/* --- layers --- */

/* The lattice on which a part is built: spacing, and a corner half a spacing beyond its particles. */
struct lattice {
    double spacing, corner[3];
};

/* The side of a particle's cube, or of its square where volumes are areas. */
static double side_of(const struct scene *scene, double volume)
{
    return scene->method == METHOD_RKPM && scene->rkpm.dimension == 2 ? sqrt(volume) : cbrt(volume);
}

/* The closed particles' lattice, by the smallest of them; that of all where none is closed. */
static struct lattice find_lattice(const struct scene *scene, const struct store *store, const struct place *places, size_t count, bool has_closed)
{
    struct lattice lattice = {INFINITY, {INFINITY, INFINITY, INFINITY}};
    for (size_t i = 0; i < count; i++) {
        if (has_closed && places[i].is_open)
            continue;
        lattice.spacing = fmin(lattice.spacing, side_of(scene, store->real[COLUMN_VOLUME][0][i]));
        for (int a = 0; a < 3; a++)
            lattice.corner[a] = fmin(lattice.corner[a], store->real[COLUMN_POSITION][a][i]);
    }
    for (int a = 0; a < 3; a++)
        lattice.corner[a] -= 0.5 * lattice.spacing;
    return lattice;
}

static int by_height(const void *left, const void *right)
{
    const struct place *a = left, *b = right;
    if (a->height != b->height)
        return a->height < b->height ? -1 : 1;
    return a->id < b->id ? -1 : a->id > b->id;
}

/* Layers from the heights: one for each height, or by the thickness from half a spacing below the
 * lowest particle. Sorts the places by height. */
static void find_layers(const struct scene *scene, struct place *places, size_t count, double spacing)
{
    const double thickness = scene->building.thickness;
    int32_t layer = 0;
    qsort(places, count, sizeof *places, by_height);
    for (size_t i = 0; i < count; i++) {
        double above = places[i].height - places[0].height;
        if (thickness > 0)
            layer = (int32_t)floor(fmin((above + 0.5 * spacing) / thickness + SAME, 1e9));
        else if (i > 0 && places[i].height - places[i - 1].height > SAME * spacing)
            layer++;
        places[i].layer = layer;
    }
}

double schedule_angle(const struct scene *scene, int32_t layer)
{
    const struct scene_building *building = &scene->building;
    return building->n_angles > 0 ? fmod(building->angles[(size_t)layer % building->n_angles], 360) : 0;
}

/* --- order inside a layer --- */

/* Lines at the angle of the layer, side by side: a spacing wide, or along the diagonals of a lattice
 * as close as these are. Their order goes with growing y (x where lines run along y). */
static void find_track(const struct scene *scene, const struct store *store, struct place *place, const struct lattice *lattice)
{
    const int first = (scene->building.axis + 1) % 3, second = (scene->building.axis + 2) % 3;
    const double angle = schedule_angle(scene, place->layer) * acos(-1) / 180;
    const double x = store->real[COLUMN_POSITION][first][place->id] - lattice->corner[first];
    const double y = store->real[COLUMN_POSITION][second][place->id] - lattice->corner[second];
    const bool is_diagonal = fabs(fabs(sin(angle)) - fabs(cos(angle))) < 1e-9;
    const double width = is_diagonal ? lattice->spacing * sqrt(0.5) : lattice->spacing;
    const double across = y * cos(angle) - x * sin(angle);
    const bool is_upright = fabs(cos(angle)) < 1e-9, grows = is_upright ? sin(angle) < 0 : cos(angle) > 0;
    place->track = floor((grows ? across : -across) / width + SAME);
    place->along = x * cos(angle) + y * sin(angle);
}

static int by_opening(const void *left, const void *right)
{
    const struct place *a = left, *b = right;
    if (a->is_open != b->is_open)
        return a->is_open ? -1 : 1;
    if (a->height != b->height)
        return a->height < b->height ? -1 : 1;
    if (a->track != b->track)
        return a->track < b->track ? -1 : 1;
    if (a->along != b->along)
        return a->along < b->along ? -1 : 1;
    return a->id < b->id ? -1 : a->id > b->id;
}

/* Turns every other line of a layer, the first one goes forward; the places are sorted. */
static void turn_lines(struct place *places, size_t count)
{
    bool is_turned = false;
    for (size_t i = 0; i < count; i++) {
        if (i == 0 || places[i - 1].is_open || places[i - 1].height != places[i].height)
            is_turned = false;
        else if (places[i - 1].track != places[i].track)
            is_turned = !is_turned;
        if (is_turned)
            places[i].along = -places[i].along;
    }
    qsort(places, count, sizeof *places, by_opening);
}

/* Sorts by state, layer where layers count, track, place along it, id. */
static void sort_places(const struct scene *scene, const struct store *store, struct place *places, size_t count,
                        const struct lattice *lattice)
{
    const bool is_raster = scene->building.order == SCAN_RASTER;
    const bool by_layer = is_raster || scene->building.opening == OPENING_LAYERS;
    for (size_t i = 0; i < count; i++) {
        places[i].height = by_layer && !places[i].is_open ? places[i].layer : 0;
        if (is_raster && !places[i].is_open)
            find_track(scene, store, &places[i], lattice);
    }
    qsort(places, count, sizeof *places, by_opening);
    if (is_raster && scene->building.is_serpentine)
        turn_lines(places, count);
}

/* --- openings --- */

/* Particles from `from` on that open together. */
static size_t together(const struct scene *scene, const struct place *places, size_t from, size_t end)
{
    size_t n = 1;
    if (scene->building.opening == OPENING_ALL)
        return end - from;
    if (scene->building.opening == OPENING_POINTS)
        return end - from < (size_t)scene->building.group ? end - from : (size_t)scene->building.group;
    while (from + n < end && places[from + n].layer == places[from].layer)
        n++;
    return n;
}

/* Places that open at some time end here: `open until` leaves those behind its particle closed. */
static size_t end_of_openings(const struct scene *scene, const struct place *places, size_t first, size_t count)
{
    if (scene->building.opening == OPENING_NONE)
        return first;
    for (size_t i = first; i < count && scene->building.until >= 0; i++)
        if (places[i].id == scene->building.until)
            return i + 1;
    return count;
}

static void plan(struct schedule *schedule, const struct scene *scene, const struct place *places, size_t first, size_t count)
{
    const size_t end = end_of_openings(scene, places, first, count);
    size_t capacity = 0;
    schedule->interval = scene->building.interval;
    schedule->left = end - first;
    for (size_t from = first; from < end; from += schedule->openings[schedule->n_openings - 1]) {
        schedule->openings = memory_grow(schedule->openings, &capacity, schedule->n_openings + 1, sizeof *schedule->openings, "openings");
        schedule->openings[schedule->n_openings++] = together(scene, places, from, end);
    }
}

/* --- the schedule --- */

/* Without Ghost all particles are open; with it those that GPD says so of. */
static void read_states(const struct scene *scene, struct place *places)
{
    for (long id = 0; id < scene->n_particles; id++)
        places[id].is_open = !scene->building.has_ghosts;
    for (size_t i = 0; i < scene->building.n_ghosts; i++)
        for (long id = scene->building.ghosts[i].first; id <= scene->building.ghosts[i].last; id++)
            places[id].is_open = scene->building.ghosts[i].is_open;
}

struct schedule *schedule_open(const struct scene *scene, struct store *store, size_t *n_open)
{
    const size_t count = store->count;
    struct schedule *schedule = memory_array(1, sizeof *schedule, "the schedule");
    struct place *places = memory_array(count, sizeof *places, "the schedule");
    bool has_closed = false;
    read_states(scene, places);
    for (size_t i = 0; i < count; i++) {
        places[i].id = (int32_t)i;
        places[i].height = store->real[COLUMN_POSITION][scene->building.axis][i];
        has_closed = has_closed || !places[i].is_open;
    }
    const struct lattice lattice = find_lattice(scene, store, places, count, has_closed);
    find_layers(scene, places, count, lattice.spacing);
    if (store_has(store, COLUMN_LAYER))
        for (size_t i = 0; i < count; i++)
            store->integer[COLUMN_LAYER][places[i].id] = places[i].layer;
    *n_open = count;
    if (scene->building.has_ghosts) {
        int32_t *order = memory_array(count, sizeof *order, "the schedule");
        sort_places(scene, store, places, count, &lattice);
        *n_open = 0;
        for (size_t i = 0; i < count; i++) {
            *n_open += places[i].is_open;
            order[i] = places[i].id;
        }
        store_reorder(store, order, count);
        plan(schedule, scene, places, *n_open, count);
        memory_free(order);
    }
    memory_free(places);
    return schedule;
}

void schedule_close(struct schedule *schedule)
{
    if (schedule)
        memory_free(schedule->openings);
    memory_free(schedule);
}

long schedule_next_step(const struct schedule *schedule)
{
    return schedule->next < schedule->n_openings ? 1 + (long)schedule->next * schedule->interval : 0;
}

long schedule_last_step(const struct schedule *schedule)
{
    return schedule->n_openings > 0 ? 1 + (long)(schedule->n_openings - 1) * schedule->interval : 0;
}

size_t schedule_due(struct schedule *schedule, long step)
{
    if (schedule_next_step(schedule) != step)
        return 0;
    size_t n = schedule->openings[schedule->next++];
    schedule->left -= n;
    return n;
}

bool schedule_skip(struct schedule *schedule, size_t opened)
{
    while (opened > 0 && schedule->next < schedule->n_openings && schedule->openings[schedule->next] <= opened) {
        opened -= schedule->openings[schedule->next];
        schedule->left -= schedule->openings[schedule->next++];
    }
    return opened == 0;
}

size_t schedule_left(const struct schedule *schedule)
{
    return schedule->left;
}
