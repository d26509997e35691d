/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "particles/stl.h"
#include "base/memory.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Corners as the file has them, three for each triangle. */
struct soup {
    double (*corners)[3];
    size_t count, capacity;
};

/* Beyond this, squares of lengths would leave the range of numbers. */
static const double LARGEST_COORDINATE = 1e30;

static bool add_triangle(struct soup *soup, double corners[3][3], char *fault)
{
    size_t number = soup->count / 3 + 1;
    if (number > STL_MOST_TRIANGLES) {
        snprintf(fault, STL_FAULT, "more than %d triangles; expected a coarser surface", STL_MOST_TRIANGLES);
        return false;
    }
    for (int c = 0; c < 3; c++)
        for (int a = 0; a < 3; a++)
            if (!(fabs(corners[c][a]) <= LARGEST_COORDINATE)) {
                snprintf(fault, STL_FAULT, "triangle %zu has the coordinate %g", number, corners[c][a]);
                return false;
            }
    soup->corners = memory_grow(soup->corners, &soup->capacity, soup->count + 3, sizeof *soup->corners, "triangles");
    memcpy(soup->corners[soup->count], corners, 3 * sizeof *corners);
    soup->count += 3;
    return true;
}

/* --- text --- */

struct scanner {
    const char *at, *end;
    long line;
    char word[64]; /* the last one, cut */
    char *fault;
};

static bool next_word(struct scanner *scanner)
{
    size_t length = 0;
    while (scanner->at < scanner->end && isspace((unsigned char)*scanner->at))
        scanner->line += *scanner->at++ == '\n';
    for (; scanner->at < scanner->end && !isspace((unsigned char)*scanner->at); scanner->at++)
        if (length < sizeof scanner->word - 1)
            scanner->word[length++] = *scanner->at;
    scanner->word[length] = '\0';
    return length > 0;
}

static void skip_line(struct scanner *scanner)
{
    while (scanner->at < scanner->end && *scanner->at != '\n' && *scanner->at != '\r')
        scanner->at++;
}

/* Notes that something else was found. */
static bool expected(const struct scanner *scanner, const char *what)
{
    if (*scanner->word)
        snprintf(scanner->fault, STL_FAULT, "line %ld: expected %s, found '%s'", scanner->line, what, scanner->word);
    else
        snprintf(scanner->fault, STL_FAULT, "line %ld: the file ends here, it is cut; expected %s", scanner->line, what);
    return false;
}

static bool take(struct scanner *scanner, const char *word)
{
    next_word(scanner);
    return strcasecmp(scanner->word, word) == 0 || expected(scanner, word);
}

static bool take_vertex(struct scanner *scanner, double vertex[3])
{
    if (!take(scanner, "vertex"))
        return false;
    for (int a = 0; a < 3; a++) {
        char *rest;
        next_word(scanner);
        vertex[a] = strtod(scanner->word, &rest);
        if (*rest || !*scanner->word)
            return expected(scanner, "a number");
    }
    return true;
}

/* What follows `facet`. */
static bool take_facet(struct scanner *scanner, struct soup *soup)
{
    double corners[3][3];
    if (!take(scanner, "normal"))
        return false;
    for (int i = 0; i < 3; i++) /* not used, and not always a number */
        if (!next_word(scanner))
            return expected(scanner, "a normal");
    if (!take(scanner, "outer") || !take(scanner, "loop"))
        return false;
    for (int c = 0; c < 3; c++)
        if (!take_vertex(scanner, corners[c]))
            return false;
    return take(scanner, "endloop") && take(scanner, "endfacet") && add_triangle(soup, corners, scanner->fault);
}

static bool read_text(const char *bytes, size_t size, struct soup *soup, char *fault)
{
    struct scanner scanner = {.at = bytes, .end = bytes + size, .line = 1, .fault = fault};
    while (next_word(&scanner)) {
        if (strcasecmp(scanner.word, "solid") != 0)
            return expected(&scanner, "solid");
        skip_line(&scanner);
        while (next_word(&scanner) && strcasecmp(scanner.word, "facet") == 0)
            if (!take_facet(&scanner, soup))
                return false;
        if (strcasecmp(scanner.word, "endsolid") != 0)
            return expected(&scanner, "facet or endsolid");
        skip_line(&scanner);
    }
    return true;
}

/* --- binary: 80 bytes, the number of triangles, 50 bytes for each --- */

enum { HEADER = 84, RECORD = 50 };

static uint32_t little_endian(const char *bytes)
{
    const unsigned char *b = (const unsigned char *)bytes;
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static double single(const char *bytes)
{
    uint32_t bits = little_endian(bytes);
    float value;
    memcpy(&value, &bits, sizeof value);
    return (double)value;
}

static bool read_binary(const char *bytes, size_t size, struct soup *soup, size_t *surplus, char *fault)
{
    size_t count = little_endian(bytes + 80), there = (size - HEADER) / RECORD;
    if (count > there) {
        snprintf(fault, STL_FAULT, "the file is cut, or no STL file: its head says %zu triangles, there are bytes for %zu",
                 count, there);
        return false;
    }
    *surplus = size - HEADER - count * RECORD;
    for (size_t t = 0; t < count; t++) {
        double corners[3][3];
        const char *record = bytes + HEADER + t * RECORD + 12; /* behind the normal */
        for (int i = 0; i < 9; i++)
            corners[i / 3][i % 3] = single(record + (size_t)i * 4);
        if (!add_triangle(soup, corners, fault))
            return false;
    }
    return true;
}

/* Binary files may begin with `solid` too: then the size tells, or a zero byte. */
static bool is_text(const char *bytes, size_t size)
{
    if (size >= HEADER && size - HEADER == (size_t)little_endian(bytes + 80) * RECORD)
        return false;
    size_t start = 0;
    while (start < size && isspace((unsigned char)bytes[start]))
        start++;
    return size - start >= 5 && strncasecmp(bytes + start, "solid", 5) == 0
        && !memchr(bytes, 0, size < 1000 ? size : 1000);
}

/* --- corners that are the same --- */

/* Vertices by place: chains of those in one cell, or in cells of the same hash. */
struct place_table {
    double low[3], tolerance, cell;
    size_t mask;
    int32_t *head, *next; /* -1 ends a chain */
};

static size_t hash_place(const struct place_table *table, const int64_t at[3])
{
    uint64_t key = (uint64_t)at[0] << 42 ^ (uint64_t)at[1] << 21 ^ (uint64_t)at[2];
    key *= UINT64_C(0x9E3779B97F4A7C15);
    return (size_t)(key >> 32) & table->mask;
}

static int64_t cell_of(const struct place_table *table, int axis, double x)
{
    return (int64_t)floor((x - table->low[axis]) / table->cell);
}

/* The vertex at a place, or -1. */
static int32_t find_vertex(const struct stl *stl, const struct place_table *table, const double place[3])
{
    int64_t from[3], to[3], at[3];
    for (int a = 0; a < 3; a++) {
        from[a] = cell_of(table, a, place[a] - table->tolerance);
        to[a] = cell_of(table, a, place[a] + table->tolerance);
    }
    for (at[0] = from[0]; at[0] <= to[0]; at[0]++)
        for (at[1] = from[1]; at[1] <= to[1]; at[1]++)
            for (at[2] = from[2]; at[2] <= to[2]; at[2]++)
                for (int32_t v = table->head[hash_place(table, at)]; v >= 0; v = table->next[v]) {
                    const double *vertex = stl->vertices[v];
                    if (fabs(vertex[0] - place[0]) <= table->tolerance && fabs(vertex[1] - place[1]) <= table->tolerance
                        && fabs(vertex[2] - place[2]) <= table->tolerance)
                        return v;
                }
    return -1;
}

static int32_t add_vertex(struct stl *stl, const struct place_table *table, const double place[3])
{
    int32_t v = (int32_t)stl->n_vertices++;
    int64_t at[3];
    for (int a = 0; a < 3; a++) {
        stl->vertices[v][a] = place[a];
        at[a] = cell_of(table, a, place[a]);
    }
    int32_t *head = &table->head[hash_place(table, at)];
    table->next[v] = *head;
    *head = v;
    return v;
}

/* Whether a triangle is thinner than the distance at which two corners are one. */
static bool is_flat(const struct stl *stl, const int32_t corners[3], double tolerance)
{
    const double *a = stl->vertices[corners[0]], *b = stl->vertices[corners[1]], *c = stl->vertices[corners[2]];
    double u[3], v[3], longest = 0;
    for (int i = 0; i < 3; i++) {
        u[i] = b[i] - a[i];
        v[i] = c[i] - a[i];
    }
    longest = fmax(hypot(hypot(u[0], u[1]), u[2]), hypot(hypot(v[0], v[1]), v[2]));
    longest = fmax(longest, hypot(hypot(u[0] - v[0], u[1] - v[1]), u[2] - v[2]));
    double area = hypot(hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2]), u[0] * v[1] - u[1] * v[0]);
    return area <= tolerance * longest;
}

/* Extents of all corners. */
static void measure(struct stl *stl, const struct soup *soup, double low[3])
{
    for (int a = 0; a < 3; a++) {
        double high = low[a] = soup->corners[0][a];
        for (size_t i = 0; i < soup->count; i++) {
            low[a] = fmin(low[a], soup->corners[i][a]);
            high = fmax(high, soup->corners[i][a]);
        }
        stl->size = fmax(stl->size, high - low[a]);
        stl->largest = fmax(stl->largest, fmax(fabs(high), fabs(low[a])));
    }
}

/* Makes vertices of the corners, and triangles of them. */
static void weld(struct stl *stl, const struct soup *soup)
{
    struct place_table table = {.mask = 1};
    measure(stl, soup, table.low);
    if (stl->size == 0)
        return;
    table.tolerance = 1e-6 * stl->size;
    table.cell = 4 * table.tolerance;
    while (table.mask < 2 * soup->count)
        table.mask *= 2;
    table.head = memory_array(table.mask, sizeof *table.head, "triangles");
    table.next = memory_array(soup->count, sizeof *table.next, "triangles");
    memset(table.head, -1, table.mask * sizeof *table.head);
    table.mask--;
    stl->vertices = memory_array(soup->count, sizeof *stl->vertices, "triangles");
    stl->triangles = memory_array(soup->count / 3, sizeof *stl->triangles, "triangles");
    for (size_t t = 0; t < soup->count / 3; t++) {
        int32_t *corner = stl->triangles[stl->n_triangles];
        for (int c = 0; c < 3; c++) {
            const double *place = soup->corners[3 * t + (size_t)c];
            corner[c] = find_vertex(stl, &table, place);
            if (corner[c] < 0)
                corner[c] = add_vertex(stl, &table, place);
        }
        bool is_collapsed = corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0];
        stl->degenerate += is_collapsed || is_flat(stl, corner, table.tolerance);
        stl->n_triangles += !is_collapsed;
    }
    memory_free(table.head);
    memory_free(table.next);
}

bool stl_read(struct stl *stl, const char *bytes, size_t size, char *fault)
{
    struct soup soup = {0};
    bool good = false;
    *stl = (struct stl){0};
    if (is_text(bytes, size))
        good = read_text(bytes, size, &soup, fault);
    else if (size >= HEADER)
        good = read_binary(bytes, size, &soup, &stl->surplus_bytes, fault);
    else
        snprintf(fault, STL_FAULT, "no STL file: neither text that begins with solid, nor as long as a binary head");
    if (good && soup.count > 0)
        weld(stl, &soup);
    if (good && stl->n_triangles == 0) {
        snprintf(fault, STL_FAULT, "no triangle with an area");
        stl_close(stl);
        good = false;
    }
    memory_free(soup.corners);
    return good;
}

void stl_close(struct stl *stl)
{
    memory_free(stl->vertices);
    memory_free(stl->triangles);
    *stl = (struct stl){0};
}

/* --- edges --- */

/* An edge from the vertex of lower number to the other, and how many triangles run it each way. */
struct edge {
    int32_t low, high;
    int32_t forward, backward; /* both 0: the place is free */
};

static struct edge *find_edge(struct edge *edges, size_t mask, int32_t from, int32_t to)
{
    int32_t low = from < to ? from : to, high = from < to ? to : from;
    uint64_t key = ((uint64_t)(uint32_t)low << 32 | (uint32_t)high) * UINT64_C(0x9E3779B97F4A7C15);
    size_t at = (size_t)(key >> 32) & mask;
    while ((edges[at].forward || edges[at].backward) && (edges[at].low != low || edges[at].high != high))
        at = (at + 1) & mask;
    edges[at].low = low;
    edges[at].high = high;
    return &edges[at];
}

/* Notes an edge that is wrong. */
static void note_gap(const struct stl *stl, struct stl_gap *gap, struct edge *edge)
{
    if (edge->forward == 1 && edge->backward == 1)
        return;
    if (gap->count++ == 0) {
        memcpy(gap->from, stl->vertices[edge->low], sizeof gap->from);
        memcpy(gap->to, stl->vertices[edge->high], sizeof gap->to);
        gap->forward = edge->forward;
        gap->backward = edge->backward;
    }
    edge->forward = edge->backward = 1; /* counted once */
}

bool stl_is_closed(const struct stl *stl, struct stl_gap *gap)
{
    size_t mask = 1;
    while (mask < 4 * stl->n_triangles)
        mask *= 2;
    struct edge *edges = memory_array(mask, sizeof *edges, "edges of triangles");
    mask--;
    for (size_t t = 0; t < stl->n_triangles; t++)
        for (int c = 0; c < 3; c++) {
            int32_t from = stl->triangles[t][c], to = stl->triangles[t][(c + 1) % 3];
            struct edge *edge = find_edge(edges, mask, from, to);
            edge->forward += from < to;
            edge->backward += from > to;
        }
    *gap = (struct stl_gap){0};
    for (size_t t = 0; t < stl->n_triangles; t++)
        for (int c = 0; c < 3; c++)
            note_gap(stl, gap, find_edge(edges, mask, stl->triangles[t][c], stl->triangles[t][(c + 1) % 3]));
    memory_free(edges);
    return gap->count == 0;
}
