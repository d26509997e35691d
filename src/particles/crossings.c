/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "particles/crossings.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Where a line goes through the surface; turn is +1 or -1, by the side that the triangle shows. */
struct crossing {
    double x;
    int turn;
};

/* The crossings of all lines that are `offset` off the lattice's. Counted first, then filled in:
 * start[line + 2] counts, then start[line + 1] is where the next one goes, at last start[line] where
 * the line's begin. */
struct sweep {
    const struct crossings *lattice;
    double offset[2];
    size_t *start;
    size_t count;
    struct crossing *crossings; /* NULL while they are counted */
};

struct run_list {
    size_t *start;
    struct crossings_run *runs;
    size_t count, capacity;
};

long crossings_above(double place)
{
    return (long)floor(place - 0.5) + 1;
}

long crossings_from(double place)
{
    return (long)ceil(place - 0.5);
}

static size_t line_count(const struct crossings *lattice)
{
    return (size_t)(lattice->to[0] - lattice->from[0]) * (size_t)(lattice->to[1] - lattice->from[1]);
}

/* --- triangles --- */

/* Where the edge p q passes the height z. Both triangles of an edge get the same bits, as it is
 * taken from its lower end: so neighbours leave no line out and count none twice. */
static void pass_edge(const double *p, const double *q, double z, double yx[2])
{
    const double *low = p[2] < q[2] ? p : q, *high = p[2] < q[2] ? q : p;
    double share = (z - low[2]) / (high[2] - low[2]);
    yx[0] = low[1] + share * (high[1] - low[1]);
    yx[1] = low[0] + share * (high[0] - low[0]);
}

/* The segment of a triangle at a height, from its rising edge to its falling one; false where it has
 * none. An edge has its lower end but not its upper one. */
static bool cut_triangle(const double *const v[3], double z, double segment[2][2])
{
    bool is_cut = false;
    for (int c = 0; c < 3; c++) {
        const double *p = v[c], *q = v[(c + 1) % 3];
        if (p[2] <= z && z < q[2])
            pass_edge(p, q, z, segment[0]);
        else if (q[2] <= z && z < p[2])
            pass_edge(p, q, z, segment[1]);
        else
            continue;
        is_cut = true;
    }
    return is_cut;
}

/* Notes the lines of layer k that cross the segment, which has its lower end but not its upper one. */
static void cross_segment(struct sweep *sweep, long k, double segment[2][2])
{
    const struct crossings *lattice = sweep->lattice;
    bool is_rising = segment[0][0] < segment[1][0];
    const double *low = segment[!is_rising], *high = segment[is_rising];
    const double offset = 0.5 + sweep->offset[0];
    long j = (long)floor(fmax(low[0], (double)lattice->from[0]) - offset);
    while ((double)j + offset < low[0] || j < lattice->from[0])
        j++;
    for (; j < lattice->to[0] && (double)j + offset < high[0]; j++) {
        size_t line = (size_t)(k - lattice->from[1]) * (size_t)(lattice->to[0] - lattice->from[0])
                    + (size_t)(j - lattice->from[0]);
        if (!sweep->crossings) {
            sweep->start[line + 2]++;
            sweep->count++;
            continue;
        }
        double share = ((double)j + offset - low[0]) / (high[0] - low[0]);
        sweep->crossings[sweep->start[line + 1]++] =
            (struct crossing){low[1] + share * (high[1] - low[1]), is_rising ? 1 : -1};
    }
}

static void cross_triangle(struct sweep *sweep, const double *const v[3])
{
    const struct crossings *lattice = sweep->lattice;
    double low = fmin(v[0][2], fmin(v[1][2], v[2][2])), high = fmax(v[0][2], fmax(v[1][2], v[2][2]));
    const double offset = 0.5 + sweep->offset[1];
    double segment[2][2];
    long k = (long)floor(fmax(low, (double)lattice->from[1]) - offset);
    while (k < lattice->from[1])
        k++;
    for (; k < lattice->to[1] && (double)k + offset < high; k++)
        if (cut_triangle(v, (double)k + offset, segment))
            cross_segment(sweep, k, segment);
}

static void cross_all(struct sweep *sweep, const struct stl *stl, const double (*vertices)[3])
{
    for (size_t t = 0; t < stl->n_triangles && sweep->count <= CROSSINGS_MOST; t++) {
        const int32_t *corner = stl->triangles[t];
        const double *const v[3] = {vertices[corner[0]], vertices[corner[1]], vertices[corner[2]]};
        cross_triangle(sweep, v);
    }
}

/* --- runs --- */

static int by_x(const void *left, const void *right)
{
    const struct crossing *a = left, *b = right;
    return a->x < b->x ? -1 : a->x > b->x;
}

static void add_run(struct run_list *list, long from, long to)
{
    if (from >= to)
        return;
    list->runs = memory_grow(list->runs, &list->capacity, list->count + 1, sizeof *list->runs, "runs of points");
    list->runs[list->count++] = (struct crossings_run){(int32_t)from, (int32_t)to};
}

/* The points between the crossings of a line; returns those outside that shells of one direction
 * enclose. */
static long add_runs(struct run_list *list, const struct crossing *crossings, size_t count, double margin)
{
    long overlapping = 0, turns = 0;
    for (size_t i = 0; i + 1 < count; i++) {
        long from = crossings_above(crossings[i].x + margin), to = crossings_from(crossings[i + 1].x - margin);
        turns += crossings[i].turn;
        if (i % 2 == 0)
            add_run(list, from, to);
        else if (turns != 0 && from < to)
            overlapping += to - from;
    }
    return overlapping;
}

/* The runs of all lines that are `offset` off the lattice's. False when there are too many crossings. */
static bool find_runs(struct crossings *lattice, const struct stl *stl, const double (*vertices)[3],
                      const double offset[2], double margin, struct run_list *list)
{
    size_t lines = line_count(lattice);
    struct sweep sweep = {.lattice = lattice, .offset = {offset[0], offset[1]}};
    sweep.start = memory_array(lines + 2, sizeof *sweep.start, "crossings");
    cross_all(&sweep, stl, vertices);
    for (size_t line = 0; line < lines; line++)
        sweep.start[line + 2] += sweep.start[line + 1];
    if (sweep.count > CROSSINGS_MOST) {
        memory_free(sweep.start);
        return false;
    }
    sweep.crossings = memory_array(sweep.count + 1, sizeof *sweep.crossings, "crossings");
    cross_all(&sweep, stl, vertices);
    list->start = memory_array(lines + 1, sizeof *list->start, "runs of points");
    lattice->overlapping = 0;
    for (size_t line = 0; line < lines; line++) {
        struct crossing *first = sweep.crossings + sweep.start[line];
        size_t here = sweep.start[line + 1] - sweep.start[line];
        if (here > 1)
            qsort(first, here, sizeof *first, by_x);
        lattice->overlapping += add_runs(list, first, here, margin);
        list->start[line + 1] = list->count;
    }
    memory_free(sweep.start);
    memory_free(sweep.crossings);
    return true;
}

/* Replaces the lattice's runs by those points that are in both. */
static void keep_common(struct crossings *lattice, const struct run_list *other)
{
    size_t lines = line_count(lattice);
    struct run_list common = {.start = memory_array(lines + 1, sizeof *common.start, "runs of points")};
    for (size_t line = 0; line < lines; line++) {
        size_t a = lattice->start[line], b = other->start[line];
        while (a < lattice->start[line + 1] && b < other->start[line + 1]) {
            const struct crossings_run *p = &lattice->runs[a], *q = &other->runs[b];
            add_run(&common, p->from > q->from ? p->from : q->from, p->to < q->to ? p->to : q->to);
            if (p->to < q->to)
                a++;
            else
                b++;
        }
        common.start[line + 1] = common.count;
    }
    memory_free(lattice->start);
    memory_free(lattice->runs);
    lattice->start = common.start;
    lattice->runs = common.runs;
}

/* --- opening --- */

/* The vertices in spacings, and their extents; false when they reach too far. */
static bool place_vertices(const struct stl *stl, const struct crossings_placement *placement,
                           struct crossings *lattice, double (*vertices)[3])
{
    for (int a = 0; a < 3; a++) {
        double low = INFINITY, high = -INFINITY;
        for (size_t v = 0; v < stl->n_vertices; v++) {
            double place = placement->scale * stl->vertices[v][a] + placement->move[a];
            vertices[v][a] = (place - placement->origin[a]) / placement->spacing;
            low = fmin(low, vertices[v][a]);
            high = fmax(high, vertices[v][a]);
        }
        lattice->low[a] = low;
        lattice->high[a] = high;
        if (!(low >= -CROSSINGS_MOST_REACH && high <= CROSSINGS_MOST_REACH))
            return false;
    }
    return true;
}

static bool find_all_runs(struct crossings *lattice, const struct stl *stl, const double (*vertices)[3], double margin)
{
    for (int corner = 0; corner < 4; corner++) {
        const double offset[2] = {corner & 1 ? margin : -margin, corner & 2 ? margin : -margin};
        struct run_list list = {0};
        if (!find_runs(lattice, stl, vertices, offset, margin, &list))
            return false;
        if (corner == 0) {
            lattice->start = list.start;
            lattice->runs = list.runs;
            continue;
        }
        keep_common(lattice, &list);
        memory_free(list.start);
        memory_free(list.runs);
    }
    return true;
}

struct crossings *crossings_open(const struct stl *stl, const struct crossings_placement *placement, const char **fault)
{
    struct crossings *lattice = memory_array(1, sizeof *lattice, "crossings");
    double (*vertices)[3] = memory_array(stl->n_vertices, sizeof *vertices, "vertices");
    /* round-off of numbers of a million at most; and files hold single precision */
    double margin = 1e-9 + ldexp(stl->largest * placement->scale / placement->spacing, -23);
    *fault = NULL;
    if (!place_vertices(stl, placement, lattice, vertices) || !(margin < 0.25)) {
        *fault = "reaches more than a million spacings from the lattice's origin; expected a smaller scale or a nearer origin";
    } else {
        for (int a = 0; a < 2; a++) { /* lines strictly between the extents */
            lattice->from[a] = crossings_above(lattice->low[a + 1]);
            lattice->to[a] = crossings_from(lattice->high[a + 1]);
            if (lattice->to[a] < lattice->from[a])
                lattice->to[a] = lattice->from[a];
        }
        if (line_count(lattice) > CROSSINGS_MOST_LINES)
            *fault = "has more than ten million lattice lines; expected a larger spacing";
        else if (!find_all_runs(lattice, stl, (const double (*)[3])vertices, margin))
            *fault = "is crossed more than twenty million times by lattice lines; expected a larger spacing";
    }
    memory_free(vertices);
    if (!*fault)
        return lattice;
    crossings_close(lattice);
    return NULL;
}

void crossings_close(struct crossings *crossings)
{
    if (!crossings)
        return;
    memory_free(crossings->start);
    memory_free(crossings->runs);
    memory_free(crossings);
}

const struct crossings_run *crossings_runs(const struct crossings *crossings, long j, long k, size_t *count)
{
    long row = crossings->to[0] - crossings->from[0];
    *count = 0;
    if (j < crossings->from[0] || j >= crossings->to[0] || k < crossings->from[1] || k >= crossings->to[1])
        return NULL;
    size_t line = (size_t)(k - crossings->from[1]) * (size_t)row + (size_t)(j - crossings->from[0]);
    *count = crossings->start[line + 1] - crossings->start[line];
    return *count > 0 ? crossings->runs + crossings->start[line] : NULL;
}
