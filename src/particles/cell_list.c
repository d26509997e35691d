/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "particles/cell_list.h"
#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

/* Fewer blocks than this are not worth a second thread. */
enum { SHARED_BLOCKS = 32 };

/* A particle that looks for its block. */
struct leaver {
    int32_t particle;
    int32_t block; /* where it goes; -1: nowhere */
    uint8_t cell;  /* in that block; cell_list.cell keeps CELL_LEFT_BLOCK until all blocks are filled */
};

/* A part of the order. */
struct segment {
    int32_t first, count;
};

struct cell_list_rooms {
    int reach;
    int32_t *order_next;
    struct cell_block *blocks_next;
    size_t blocks_capacity, blocks_next_capacity, changed_capacity;
    int32_t *hash; /* block index + 1, or 0 */
    size_t hash_capacity;
    struct leaver *leavers;
    size_t leavers_capacity;
    struct leaver *arrivals; /* leavers by destination */
    size_t arrivals_capacity;
    int32_t *leaving, *arriving; /* per block: particles that go and come */
    int32_t *previous, *renamed; /* per block: its old index, and the new index of an old one */
    int32_t *arrivals_first;     /* per block: its first entry in arrivals */
    struct segment *segments;    /* per block: its part of the old order */
    size_t leaving_capacity, arriving_capacity, previous_capacity, renamed_capacity, first_capacity, segments_capacity;
};

struct cell_list *cell_list_open(struct cell_frame frame, const int32_t *component_of_body, size_t total, int reach)
{
    struct cell_list *list = memory_array(1, sizeof *list, "cell list");
    list->rooms = memory_array(1, sizeof *list->rooms, "cell list");
    list->frame = frame;
    list->component_of_body = component_of_body;
    list->total = list->count = (int32_t)total;
    list->order = memory_array(total, sizeof *list->order, "particle order");
    list->cell = memory_array(total, sizeof *list->cell, "particle cells");
    list->rooms->order_next = memory_array(total, sizeof *list->order, "particle order");
    list->rooms->reach = reach;
    list->shared_blocks = SHARED_BLOCKS;
    return list;
}

void cell_list_close(struct cell_list *list)
{
    if (!list)
        return;
    struct cell_list_rooms *rooms = list->rooms;
    memory_free(rooms->order_next);
    memory_free(rooms->blocks_next);
    memory_free(rooms->hash);
    memory_free(rooms->leavers);
    memory_free(rooms->arrivals);
    memory_free(rooms->leaving);
    memory_free(rooms->arriving);
    memory_free(rooms->previous);
    memory_free(rooms->renamed);
    memory_free(rooms->arrivals_first);
    memory_free(rooms->segments);
    memory_free(rooms);
    memory_free(list->order);
    memory_free(list->cell);
    memory_free(list->block_changed);
    memory_free(list->blocks);
    memory_free(list);
}

/* --- finding blocks --- */

static size_t hash_of(const int32_t at[3], int32_t component)
{
    uint64_t h = (uint32_t)at[0] * UINT64_C(0x9E3779B97F4A7C15);
    h ^= (h >> 32) + (uint32_t)at[1] * UINT64_C(0xC2B2AE3D27D4EB4F);
    h ^= (h >> 29) + (uint32_t)at[2] * UINT64_C(0x165667B19E3779F9);
    h ^= (h >> 31) + (uint32_t)component * UINT64_C(0xD6E8FEB86659FD93);
    return (size_t)(h ^ (h >> 27));
}

/* The place in the hash table of a block or of the gap where it would be. */
static int32_t *hash_place(const struct cell_list *list, const int32_t at[3], int32_t component)
{
    const struct cell_list_rooms *rooms = list->rooms;
    size_t mask = rooms->hash_capacity - 1;
    for (size_t i = hash_of(at, component) & mask;; i = (i + 1) & mask) {
        int32_t entry = rooms->hash[i];
        if (entry == 0)
            return &rooms->hash[i];
        const struct cell_block *block = &list->blocks[entry - 1];
        if (block->at[0] == at[0] && block->at[1] == at[1] && block->at[2] == at[2] && block->component == component)
            return &rooms->hash[i];
    }
}

static int32_t find_block(const struct cell_list *list, const int32_t at[3], int32_t component)
{
    return list->rooms->hash_capacity ? *hash_place(list, at, component) - 1 : -1;
}

static void hash_all(struct cell_list *list)
{
    struct cell_list_rooms *rooms = list->rooms;
    memset(rooms->hash, 0, rooms->hash_capacity * sizeof *rooms->hash);
    for (int32_t b = 0; b < list->n_blocks; b++)
        *hash_place(list, list->blocks[b].at, list->blocks[b].component) = b + 1;
}

/* Adds an empty block and returns its index. */
static int32_t add_block(struct cell_list *list, const int32_t at[3], int32_t component)
{
    struct cell_list_rooms *rooms = list->rooms;
    size_t needed = (size_t)list->n_blocks + 1;
    list->blocks = memory_grow(list->blocks, &rooms->blocks_capacity, needed, sizeof *list->blocks, "cell blocks");
    list->blocks[list->n_blocks] = (struct cell_block){.at = {at[0], at[1], at[2]}, .component = component};
    list->n_blocks++;
    if (rooms->hash_capacity < 4 * needed) {
        size_t capacity = rooms->hash_capacity ? rooms->hash_capacity * 4 : 256;
        memory_free(rooms->hash);
        rooms->hash = memory_array(capacity, sizeof *rooms->hash, "cell blocks");
        rooms->hash_capacity = capacity;
        hash_all(list);
    } else {
        *hash_place(list, at, component) = list->n_blocks;
    }
    return list->n_blocks - 1;
}

/* Finds the block, made where there is none, and the cell of a leaver. */
static void place_leaver(struct cell_list *list, const struct store *store, struct leaver *leaver)
{
    double position[3];
    int32_t cell[3], at[3], p = leaver->particle;
    for (int a = 0; a < 3; a++)
        position[a] = store->real[COLUMN_POSITION][a][p];
    if (!cell_locate(&list->frame, position, cell)) {
        list->cell[p] = leaver->cell = CELL_NONE;
        leaver->block = -1;
        return;
    }
    for (int a = 0; a < 3; a++)
        at[a] = cell[a] / BLOCK_EDGE;
    int32_t component = list->component_of_body[store->integer[COLUMN_BODY][p]];
    leaver->cell = (uint8_t)(cell[0] % BLOCK_EDGE + BLOCK_EDGE * (cell[1] % BLOCK_EDGE)
                             + BLOCK_EDGE * BLOCK_EDGE * (cell[2] % BLOCK_EDGE));
    leaver->block = find_block(list, at, component);
    if (leaver->block < 0)
        leaver->block = add_block(list, at, component);
}

/* Room in the arrays that have one entry a block. */
static void ensure_block_rooms(struct cell_list *list)
{
    struct cell_list_rooms *rooms = list->rooms;
    size_t needed = (size_t)list->n_blocks + 1, size = sizeof(int32_t);
    const char *purpose = "cell blocks";
    rooms->leaving = memory_grow(rooms->leaving, &rooms->leaving_capacity, needed, size, purpose);
    rooms->arriving = memory_grow(rooms->arriving, &rooms->arriving_capacity, needed, size, purpose);
    rooms->previous = memory_grow(rooms->previous, &rooms->previous_capacity, needed, size, purpose);
    rooms->renamed = memory_grow(rooms->renamed, &rooms->renamed_capacity, needed, size, purpose);
    rooms->arrivals_first = memory_grow(rooms->arrivals_first, &rooms->first_capacity, needed, size, purpose);
    rooms->segments = memory_grow(rooms->segments, &rooms->segments_capacity, needed, sizeof *rooms->segments, purpose);
    list->block_changed = memory_grow(list->block_changed, &rooms->changed_capacity, needed, 1, purpose);
}

/* --- the set of blocks --- */

static int by_place(const void *left, const void *right)
{
    const struct cell_block *a = left, *b = right;
    if (a->component != b->component)
        return a->component < b->component ? -1 : 1;
    for (int axis = 2; axis >= 0; axis--)
        if (a->at[axis] != b->at[axis])
            return a->at[axis] < b->at[axis] ? -1 : 1;
    return 0;
}

/* Place of neighbour i of a block; false when it is no place of the grid's nodes. */
static bool neighbour_place(const struct cell_list *list, int32_t b, int i, int32_t at[3])
{
    const int offset[3] = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
    for (int a = 0; a < 3; a++) {
        at[a] = list->blocks[b].at[a] + offset[a];
        if (at[a] < 0 || at[a] > list->frame.cells[a] / BLOCK_EDGE)
            return false;
    }
    return true;
}

/* Adds the blocks around active ones whose nodes their particles reach, and links neighbours. */
static void add_surrounding_blocks(struct cell_list *list)
{
    int low = list->rooms->reach > 0 ? -1 : 0;
    int32_t at[3];
    for (int32_t b = 0; b < list->active; b++)
        for (int i = 0; i < BLOCK_NEIGHBOURS; i++) {
            bool is_reached = i % 3 - 1 >= low && i / 3 % 3 - 1 >= low && i / 9 - 1 >= low;
            if (is_reached && neighbour_place(list, b, i, at) && find_block(list, at, list->blocks[b].component) < 0)
                add_block(list, at, list->blocks[b].component);
        }
    for (int32_t b = 0; b < list->n_blocks; b++)
        for (int i = 0; i < BLOCK_NEIGHBOURS; i++)
            list->blocks[b].neighbour[i] =
                neighbour_place(list, b, i, at) ? find_block(list, at, list->blocks[b].component) : -1;
}

/* Keeps the blocks with particles, sorted by place, and the blocks around them. On return
 * blocks_next holds the old blocks, previous[b] is the old index of block b, and leavers[].block is
 * renumbered. */
static void renumber(struct cell_list *list, size_t n_leavers)
{
    struct cell_list_rooms *rooms = list->rooms;
    size_t old_count = (size_t)list->n_blocks;
    struct cell_block *old = list->blocks;
    struct cell_block *kept = memory_grow(rooms->blocks_next, &rooms->blocks_next_capacity, old_count, sizeof *kept,
                                          "cell blocks");
    int32_t active = 0;
    for (size_t b = 0; b < old_count; b++) {
        rooms->renamed[b] = -1;
        if (old[b].count - rooms->leaving[b] + rooms->arriving[b] <= 0)
            continue;
        kept[active] = old[b];
        kept[active].neighbour[0] = (int32_t)b; /* remembers the old index through the sorting */
        active++;
    }
    qsort(kept, (size_t)active, sizeof *kept, by_place);
    for (int32_t b = 0; b < active; b++) {
        rooms->previous[b] = kept[b].neighbour[0];
        rooms->renamed[kept[b].neighbour[0]] = b;
    }
    for (size_t i = 0; i < n_leavers; i++)
        if (rooms->leavers[i].block >= 0)
            rooms->leavers[i].block = rooms->renamed[rooms->leavers[i].block];
    rooms->blocks_next = old;
    size_t capacity = rooms->blocks_capacity;
    rooms->blocks_capacity = rooms->blocks_next_capacity;
    rooms->blocks_next_capacity = capacity;
    list->blocks = kept;
    list->active = list->n_blocks = active;
    hash_all(list);
    add_surrounding_blocks(list);
    list->version++;
}

/* --- filling --- */

/* Sorts the particles of one cell by id; they come nearly sorted. */
static void sort_by_id(int32_t *particles, int32_t count, const int32_t *id)
{
    static const int32_t gaps[] = {1750, 701, 301, 132, 57, 23, 10, 4, 1};
    for (size_t g = count > 16 ? 0 : 8; g < sizeof gaps / sizeof gaps[0]; g++) {
        int32_t gap = gaps[g];
        for (int32_t i = gap; i < count; i++) {
            int32_t particle = particles[i], j = i;
            for (; j >= gap && id[particles[j - gap]] > id[particle]; j -= gap)
                particles[j] = particles[j - gap];
            particles[j] = particle;
        }
    }
}

/* Lists a block's particles: those of its old part that stay, and those that arrive. */
static void fill_block(struct cell_list *list, const struct store *store, struct segment old,
                       const struct leaver *arrivals, int32_t n_arrivals, struct cell_block *block)
{
    const uint8_t *cell = list->cell;
    int32_t *target = list->rooms->order_next + block->first;
    const int32_t *source = list->order + old.first;
    int32_t next[BLOCK_CELLS + 1] = {0};
    for (int32_t k = 0; k < old.count; k++)
        if (cell[source[k]] < BLOCK_CELLS)
            next[cell[source[k]] + 1]++;
    for (int32_t k = 0; k < n_arrivals; k++)
        next[arrivals[k].cell + 1]++;
    for (int c = 0; c < BLOCK_CELLS; c++)
        next[c + 1] += next[c];
    memcpy(block->cell_first, next, sizeof next);
    for (int32_t k = 0; k < old.count; k++)
        if (cell[source[k]] < BLOCK_CELLS)
            target[next[cell[source[k]]]++] = source[k];
    for (int32_t k = 0; k < n_arrivals; k++)
        target[next[arrivals[k].cell]++] = arrivals[k].particle;
    for (int c = 0; c < BLOCK_CELLS; c++)
        sort_by_id(target + block->cell_first[c], block->cell_first[c + 1] - block->cell_first[c],
                   store->integer[COLUMN_ID]);
}

/* Groups the leavers by destination: those of block b are arrivals_first[b] ... in `arrivals`.
 * Particles without a cell go to the end of the new order. */
static void group_arrivals(struct cell_list *list, size_t n_leavers)
{
    struct cell_list_rooms *rooms = list->rooms;
    int32_t *first = rooms->arrivals_first;
    memset(first, 0, ((size_t)list->active + 1) * sizeof *first);
    for (size_t i = 0; i < n_leavers; i++)
        if (rooms->leavers[i].block >= 0)
            first[rooms->leavers[i].block + 1]++;
    for (int32_t b = 0; b < list->active; b++) {
        first[b + 1] += first[b];
        rooms->arriving[b] = first[b];
    }
    int32_t lost = 0;
    for (size_t i = 0; i < n_leavers; i++) {
        int32_t b = rooms->leavers[i].block;
        if (b >= 0)
            rooms->arrivals[rooms->arriving[b]++] = rooms->leavers[i];
        else
            rooms->order_next[list->in_cells - ++lost] = rooms->leavers[i].particle;
    }
    memcpy(rooms->order_next + list->in_cells, list->order + list->in_cells,
           (size_t)(list->count - list->in_cells) * sizeof *list->order);
    list->in_cells -= lost;
}

/* Notes each block's part of the old order and gives it its part of the new one. */
static void lay_out(struct cell_list *list, bool renumbered)
{
    struct cell_list_rooms *rooms = list->rooms;
    const struct cell_block *old_blocks = renumbered ? rooms->blocks_next : list->blocks;
    int32_t first = 0;
    for (int32_t b = 0; b < list->active; b++) {
        int32_t previous = renumbered ? rooms->previous[b] : b;
        rooms->segments[b] = (struct segment){old_blocks[previous].first, old_blocks[previous].count};
        list->blocks[b].first = first;
        list->blocks[b].count = rooms->segments[b].count - rooms->leaving[previous] + rooms->arrivals_first[b + 1]
                              - rooms->arrivals_first[b];
        first += list->blocks[b].count;
    }
}

/* Writes the new order from the old one, the leavers and what moved inside blocks. */
static void refill(struct cell_list *list, const struct store *store, size_t n_leavers, bool renumbered)
{
    struct cell_list_rooms *rooms = list->rooms;
    ensure_block_rooms(list);
    rooms->arrivals = memory_grow(rooms->arrivals, &rooms->arrivals_capacity, n_leavers, sizeof *rooms->arrivals,
                                  "moving particles");
    group_arrivals(list, n_leavers);
    lay_out(list, renumbered);
#pragma omp parallel for schedule(dynamic, 8) if (list->active >= list->shared_blocks)
    for (int32_t b = 0; b < list->active; b++) {
        const int32_t *first = rooms->arrivals_first;
        if (list->block_changed[renumbered ? rooms->previous[b] : b] || first[b + 1] > first[b])
            fill_block(list, store, rooms->segments[b], rooms->arrivals + first[b], first[b + 1] - first[b],
                       &list->blocks[b]);
        else
            memcpy(rooms->order_next + list->blocks[b].first, list->order + rooms->segments[b].first,
                   (size_t)rooms->segments[b].count * sizeof *list->order);
    }
    for (size_t i = 0; i < n_leavers; i++)
        list->cell[rooms->leavers[i].particle] = rooms->leavers[i].cell;
    int32_t *order = list->order;
    list->order = rooms->order_next;
    rooms->order_next = order;
}

static void clear_changes(struct cell_list *list)
{
    ensure_block_rooms(list);
    memset(list->block_changed, 0, (size_t)list->n_blocks);
}

/* Finds the destination of all leavers and rewrites the lists. `leaving` is filled in. */
static void settle(struct cell_list *list, const struct store *store, size_t n_leavers)
{
    struct cell_list_rooms *rooms = list->rooms;
    bool set_changes = false;
    memset(rooms->arriving, 0, (size_t)list->n_blocks * sizeof *rooms->arriving);
    for (size_t i = 0; i < n_leavers; i++) {
        int32_t known = list->n_blocks;
        place_leaver(list, store, &rooms->leavers[i]);
        int32_t block = rooms->leavers[i].block;
        if (list->n_blocks > known) {
            ensure_block_rooms(list);
            rooms->leaving[block] = rooms->arriving[block] = 0;
            list->block_changed[block] = 1;
        }
        if (block >= 0)
            rooms->arriving[block]++;
        set_changes = set_changes || block >= list->active;
    }
    for (int32_t b = 0; b < list->active; b++)
        set_changes = set_changes || list->blocks[b].count - rooms->leaving[b] + rooms->arriving[b] == 0;
    list->moved += (double)n_leavers;
    if (set_changes)
        renumber(list, n_leavers);
    refill(list, store, n_leavers, set_changes);
    clear_changes(list);
}

void cell_list_build(struct cell_list *list, const struct store *store)
{
    struct cell_list_rooms *rooms = list->rooms;
    rooms->leavers = memory_grow(rooms->leavers, &rooms->leavers_capacity, (size_t)list->count, sizeof *rooms->leavers,
                                 "moving particles");
    list->active = list->n_blocks = 0;
    list->in_cells = list->count;
    if (rooms->hash)
        memset(rooms->hash, 0, rooms->hash_capacity * sizeof *rooms->hash);
    ensure_block_rooms(list);
    for (int32_t p = 0; p < list->count; p++) {
        rooms->leavers[p].particle = p;
        list->cell[p] = CELL_LEFT_BLOCK;
    }
    settle(list, store, (size_t)list->count);
    list->moved = list->count;
}

void cell_list_update(struct cell_list *list, const struct store *store)
{
    struct cell_list_rooms *rooms = list->rooms;
    bool any = false;
    size_t n_leavers = 0;
    memset(rooms->leaving, 0, (size_t)list->n_blocks * sizeof *rooms->leaving);
    for (int32_t b = 0; b < list->active; b++) {
        if (!list->block_changed[b])
            continue;
        any = true;
        const int32_t *particles = list->order + list->blocks[b].first;
        for (int32_t k = 0; k < list->blocks[b].count; k++)
            if (list->cell[particles[k]] == CELL_LEFT_BLOCK) {
                rooms->leavers = memory_grow(rooms->leavers, &rooms->leavers_capacity, n_leavers + 1,
                                             sizeof *rooms->leavers, "moving particles");
                rooms->leavers[n_leavers++].particle = particles[k];
                rooms->leaving[b]++;
            }
    }
    if (any)
        settle(list, store, n_leavers);
}

void cell_list_admit(struct cell_list *list, const struct store *store, int32_t n)
{
    struct cell_list_rooms *rooms = list->rooms;
    const int32_t lost = list->count - list->in_cells;
    rooms->leavers = memory_grow(rooms->leavers, &rooms->leavers_capacity, (size_t)n, sizeof *rooms->leavers, "opening particles");
    for (int32_t i = 0; i < n; i++) {
        rooms->leavers[i].particle = list->count + i;
        list->cell[list->count + i] = CELL_LEFT_BLOCK;
    }
    memmove(list->order + list->in_cells + n, list->order + list->in_cells, (size_t)lost * sizeof *list->order);
    list->in_cells += n;
    list->count += n;
    ensure_block_rooms(list);
    memset(rooms->leaving, 0, (size_t)list->n_blocks * sizeof *rooms->leaving);
    settle(list, store, (size_t)n);
}

void cell_list_sort(struct cell_list *list, struct store *store)
{
    uint8_t *cell = (uint8_t *)(void *)store->scratch;
    for (int32_t k = 0; k < list->count; k++)
        cell[k] = list->cell[list->order[k]];
    memcpy(list->cell, cell, (size_t)list->count);
    store_reorder(store, list->order, (size_t)list->count);
    for (int32_t k = 0; k < list->count; k++)
        list->order[k] = k;
    list->moved = 0;
}

int32_t cell_list_find_block(const struct cell_list *list, const int32_t at[3], int32_t component)
{
    return find_block(list, at, component);
}

int32_t cell_list_block_of(const struct cell_list *list, int32_t p, const struct store *store, int32_t component)
{
    double position[3];
    int32_t cell[3], at[3];
    for (int a = 0; a < 3; a++)
        position[a] = store->real[COLUMN_POSITION][a][p];
    if (p >= list->count || list->cell[p] == CELL_NONE || !cell_locate(&list->frame, position, cell))
        return -1;
    for (int a = 0; a < 3; a++) { /* the one around its place whose cell it is listed in */
        int32_t in_block = list->cell[p] >> (2 * a) & (BLOCK_EDGE - 1);
        at[a] = (cell[a] - in_block + BLOCK_EDGE / 2) / BLOCK_EDGE;
    }
    return find_block(list, at, component);
}

double cell_list_bytes_per_particle(const struct cell_list *list)
{
    const struct cell_list_rooms *rooms = list->rooms;
    double bytes = (2 * sizeof *list->order + sizeof *list->cell) * (double)list->total;
    bytes += (double)(rooms->blocks_capacity + rooms->blocks_next_capacity) * sizeof *list->blocks;
    bytes += (double)rooms->leavers_capacity * sizeof *rooms->leavers + (double)rooms->arrivals_capacity * sizeof *rooms->arrivals;
    return bytes / (double)list->total;
}
