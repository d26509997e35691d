/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cell list against brute force: particles move at random, by little, by much, all to one
 * place, out of the frame; after every update the whole list is checked against cells found anew
 * from the positions, with what cell_list.h promises. */
#include "base/threads.h"
#include "check.h"
#include "particles/cell_list.h"
#include "random.h"

#include <stdlib.h>
#include <string.h>

enum { BODIES = 3, UPDATES = 200, MOTIONS = 6, MOST_PARTICLES = 300, MOST_BLOCKS = 27 * MOST_PARTICLES };

struct place {
    int32_t at[3], component, block;
};

struct world {
    struct cell_frame frame;
    struct store *store;
    struct cell_list *list;
    int32_t component_of_body[BODIES];
    int reach;
    bool is_frozen[MOST_PARTICLES];         /* by id: was outside once */
    double position_of_id[MOST_PARTICLES][3]; /* what the store must hold, wherever it keeps it */
    struct random random;
    long version;
    int32_t blocks_before;
    struct place before[MOST_BLOCKS], places[MOST_BLOCKS]; /* of the blocks at the last check, and now */
    const char *wrong; /* the first thing that was found wrong, or NULL */
};

static void expect(struct world *world, bool good, const char *what)
{
    if (!good && !world->wrong)
        world->wrong = what;
}

/* --- brute force --- */

/* Cell coordinates counted by comparing with the cell faces; the upper face belongs to the last
 * cell. False outside. */
static bool locate(const struct cell_frame *frame, const double position[3], int32_t cell[3])
{
    for (int a = 0; a < 3; a++) {
        double way = (position[a] - frame->low[a]) / frame->size;
        if (position[a] < frame->low[a] || position[a] > frame->high[a])
            return false;
        for (cell[a] = 0; cell[a] + 1 < frame->cells[a] && way >= cell[a] + 1; cell[a]++)
            ;
    }
    return true;
}

static void position_at(const struct world *world, int32_t p, double position[3])
{
    for (int a = 0; a < 3; a++)
        position[a] = world->store->real[COLUMN_POSITION][a][p];
}

/* Place in its block of a cell. */
static int code_of(const int32_t cell[3])
{
    return cell[0] % BLOCK_EDGE + BLOCK_EDGE * (cell[1] % BLOCK_EDGE + BLOCK_EDGE * (cell[2] % BLOCK_EDGE));
}

/* --- checks --- */

static void check_particle(struct world *world, const struct cell_block *block, int slot, int32_t p)
{
    double position[3];
    int32_t cell[3] = {0};
    position_at(world, p, position);
    expect(world, locate(&world->frame, position, cell), "a listed particle is outside the frame");
    for (int a = 0; a < 3; a++)
        expect(world, cell[a] / BLOCK_EDGE == block->at[a], "a particle is in the wrong block");
    expect(world, code_of(cell) == slot && world->list->cell[p] == slot, "a particle is in the wrong cell");
    int32_t component = world->component_of_body[world->store->integer[COLUMN_BODY][p]];
    expect(world, component == block->component, "a particle is in a block of another component");
    expect(world, cell_list_block_of(world->list, p, world->store, component) == block - world->list->blocks,
           "block_of finds another block");
}

/* Cells of one block: consistent, and ids ascending in each. */
static void check_block(struct world *world, const struct cell_block *block)
{
    const int32_t *order = world->list->order + block->first, *id = world->store->integer[COLUMN_ID];
    expect(world, block->count > 0, "an active block is empty");
    const int32_t *first = block->cell_first;
    expect(world, first[0] == 0 && first[BLOCK_CELLS] == block->count, "cell_first has wrong ends");
    for (int c = 0; c < BLOCK_CELLS; c++) {
        expect(world, first[c] <= first[c + 1], "cell_first falls");
        for (int32_t k = first[c]; k < first[c + 1] && !world->wrong; k++) {
            check_particle(world, block, c, order[k]);
            expect(world, k == first[c] || id[order[k - 1]] < id[order[k]], "ids of a cell are not ascending");
        }
    }
}

/* Whether block a comes before block b: by component, then z, y, x. */
static bool comes_before(const struct cell_block *a, const struct cell_block *b)
{
    if (a->component != b->component)
        return a->component < b->component;
    for (int axis = 2; axis >= 0; axis--)
        if (a->at[axis] != b->at[axis])
            return a->at[axis] < b->at[axis];
    return false;
}

static void check_blocks(struct world *world)
{
    const struct cell_list *list = world->list;
    int32_t first = 0;
    expect(world, list->active <= list->n_blocks, "more active blocks than blocks");
    for (int32_t b = 0; b < list->active && !world->wrong; b++) {
        expect(world, list->blocks[b].first == first, "blocks do not follow each other in the order");
        expect(world, b == 0 || comes_before(&list->blocks[b - 1], &list->blocks[b]), "blocks are not sorted by place");
        expect(world, list->block_changed[b] == 0, "block_changed was not cleared");
        check_block(world, &list->blocks[b]);
        first += list->blocks[b].count;
    }
    expect(world, first == list->in_cells, "the blocks do not hold all particles that have a cell");
}

static int by_place(const void *left, const void *right)
{
    const struct place *a = left, *b = right;
    for (int axis = 0; axis < 3; axis++)
        if (a->at[axis] != b->at[axis])
            return a->at[axis] < b->at[axis] ? -1 : 1;
    return (a->component > b->component) - (a->component < b->component);
}

/* Sorts the places of all blocks; says whether they differ. */
static bool list_places(struct world *world)
{
    const struct cell_list *list = world->list;
    bool differ = true;
    for (int32_t b = 0; b < list->n_blocks; b++) {
        const struct cell_block *block = &list->blocks[b];
        world->places[b] = (struct place){{block->at[0], block->at[1], block->at[2]}, block->component, b};
    }
    qsort(world->places, (size_t)list->n_blocks, sizeof world->places[0], by_place);
    for (int32_t b = 1; b < list->n_blocks; b++)
        differ = differ && by_place(&world->places[b - 1], &world->places[b]) != 0;
    return differ;
}

static int32_t block_at(const struct world *world, const int32_t at[3], int32_t component)
{
    const struct place wanted = {{at[0], at[1], at[2]}, component, 0};
    const struct place *found =
        bsearch(&wanted, world->places, (size_t)world->list->n_blocks, sizeof wanted, by_place);
    return found ? found->block : -1;
}

/* A neighbour is named where there is one. Blocks that hold nodes which particles reach have to be
 * there: those above an active one up to the last node of the frame, with `reach` those below too. */
static void check_neighbours(struct world *world)
{
    const struct cell_list *list = world->list;
    expect(world, list_places(world), "a block is listed twice");
    for (int32_t b = 0; b < list->n_blocks; b++)
        for (int i = 0; i < BLOCK_NEIGHBOURS; i++) {
            const int offset[3] = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
            int32_t at[3];
            bool is_needed = b < list->active;
            for (int a = 0; a < 3; a++) {
                at[a] = list->blocks[b].at[a] + offset[a];
                is_needed = is_needed && at[a] >= 0 && at[a] * BLOCK_EDGE <= world->frame.cells[a]
                         && (offset[a] >= 0 || world->reach > 0);
            }
            int32_t found = block_at(world, at, list->blocks[b].component);
            expect(world, list->blocks[b].neighbour[i] == found, "a neighbour is wrong");
            expect(world, found >= 0 || !is_needed, "a neighbour is missing");
        }
}

/* Every particle is listed once; those without a cell are the ones that were outside. */
static void check_order(struct world *world)
{
    const struct cell_list *list = world->list;
    static int seen[MOST_PARTICLES];
    memset(seen, 0, sizeof seen);
    for (int32_t k = 0; k < list->count; k++) {
        int32_t p = list->order[k], id = world->store->integer[COLUMN_ID][p];
        expect(world, p >= 0 && p < list->count && seen[p]++ == 0, "a particle is not listed exactly once");
        expect(world, world->is_frozen[id] == (k >= list->in_cells), "a particle has wrongly a cell or none");
        expect(world, world->is_frozen[id] == (list->cell[p] == CELL_NONE), "a lost particle is not marked");
        if (world->is_frozen[id])
            expect(world, cell_list_block_of(list, p, world->store, 0) == -1, "a lost particle has a block");
        expect(world, world->store->index_of_id[id] == p, "the index of an id is wrong");
        for (int a = 0; a < 3; a++)
            expect(world, world->store->real[COLUMN_POSITION][a][p] == world->position_of_id[id][a],
                   "a position went to another particle");
    }
}

/* The version stays only while the blocks do. */
static void check_version(struct world *world)
{
    const struct cell_list *list = world->list;
    bool same = list->n_blocks == world->blocks_before;
    for (int32_t b = 0; b < list->n_blocks; b++) {
        same = same && memcmp(world->before[b].at, list->blocks[b].at, sizeof list->blocks[b].at) == 0
            && world->before[b].component == list->blocks[b].component;
        memcpy(world->before[b].at, list->blocks[b].at, sizeof list->blocks[b].at);
        world->before[b].component = list->blocks[b].component;
    }
    expect(world, same || list->version != world->version, "the blocks changed, the version did not");
    world->version = list->version;
    world->blocks_before = list->n_blocks;
}

static void check_all(struct world *world)
{
    check_order(world);
    check_blocks(world);
    if (world->list->version != world->version || random_below(&world->random, 10) == 0)
        check_neighbours(world);
    check_version(world);
}

/* --- motions --- */

/* A coordinate anywhere in the frame, at times on one of its faces or on a cell face. */
static double anywhere(struct world *world, int axis)
{
    const struct cell_frame *frame = &world->frame;
    int kind = random_below(&world->random, 8);
    if (kind == 0)
        return frame->low[axis];
    if (kind == 1)
        return frame->high[axis];
    if (kind == 2)
        return frame->low[axis] + random_below(&world->random, frame->cells[axis]) * frame->size;
    return random_between(&world->random, frame->low[axis], frame->high[axis]);
}

static double inside(const struct world *world, int axis, double x)
{
    return fmin(fmax(x, world->frame.low[axis]), world->frame.high[axis]);
}

/* New position of a particle by one of the kinds of motion. */
static void move_particle(struct world *world, int motion, const double shift[3], const double target[3], double x[3])
{
    double size = world->frame.size;
    bool goes = random_below(&world->random, 10) == 0;
    for (int a = 0; a < 3; a++) {
        double step = random_between(&world->random, -0.2, 0.2) * size;
        switch (motion) {
        case 0: x[a] = inside(world, a, x[a] + step); break;                       /* trembles */
        case 1: x[a] = inside(world, a, x[a] + shift[a] + 0.1 * step); break;      /* all go together */
        case 2: x[a] = goes ? anywhere(world, a) : x[a]; break;                    /* a few jump */
        case 3: x[a] = anywhere(world, a); break;                                  /* all jump */
        case 4: x[a] = goes ? inside(world, a, target[a] + 0.1 * step) : x[a]; break; /* a few gather */
        default: x[a] = inside(world, a, target[a] + 0.1 * step); break;           /* all gather */
        }
    }
    if (random_below(&world->random, 1500) == 0) { /* leaves the frame */
        int axis = random_below(&world->random, 3);
        bool up = random_below(&world->random, 2) == 1;
        x[axis] = up ? world->frame.high[axis] + 0.3 * size : world->frame.low[axis] - 1e-9;
    }
}

/* Moves all particles; those that have no cell any more must stay without, wherever they come. */
static void move_all(struct world *world, int motion)
{
    double shift[3], target[3];
    for (int a = 0; a < 3; a++) {
        shift[a] = random_between(&world->random, -3, 3) * world->frame.size;
        target[a] = random_between(&world->random, world->frame.low[a], world->frame.high[a]);
    }
    for (int32_t p = 0; p < world->list->count; p++) {
        int32_t id = world->store->integer[COLUMN_ID][p];
        double x[3];
        position_at(world, p, x);
        move_particle(world, motion, shift, target, x);
        for (int a = 0; a < 3; a++)
            world->store->real[COLUMN_POSITION][a][p] = world->position_of_id[id][a] = x[a];
    }
}

/* Tells the list what moved, as the method's last pass does: a cell in the same block by its
 * number, any other place by CELL_LEFT_BLOCK. At times a block is named changed that is not. */
static void announce(struct world *world)
{
    struct cell_list *list = world->list;
    for (int32_t b = 0; b < list->active; b++)
        for (int32_t k = 0; k < list->blocks[b].count; k++) {
            int32_t p = list->order[list->blocks[b].first + k], cell[3];
            double position[3];
            position_at(world, p, position);
            bool is_in = locate(&world->frame, position, cell), stays = is_in;
            for (int a = 0; a < 3 && stays; a++)
                stays = cell[a] / BLOCK_EDGE == list->blocks[b].at[a];
            uint8_t now = (uint8_t)(stays ? code_of(cell) : CELL_LEFT_BLOCK);
            if (now != list->cell[p] || random_below(&world->random, 50) == 0)
                list->block_changed[b] = 1;
            list->cell[p] = now;
            if (!is_in)
                world->is_frozen[world->store->integer[COLUMN_ID][p]] = true;
        }
}

/* --- runs --- */

static void create(struct world *world, const int32_t cells[3], int count, int reach, uint64_t seed)
{
    static const int32_t components[BODIES] = {0, 1, 0};
    static const enum column columns[] = {COLUMN_POSITION, COLUMN_ID, COLUMN_BODY};
    uint64_t wanted = 0;
    memset(world, 0, sizeof *world);
    world->random.state = seed;
    world->reach = reach;
    world->version = -1;
    world->frame = (struct cell_frame){.size = 0.3};
    for (int a = 0; a < 3; a++) {
        world->frame.cells[a] = cells[a];
        world->frame.low[a] = 0.7 - a;
        world->frame.high[a] = world->frame.low[a] + cells[a] * world->frame.size;
    }
    memcpy(world->component_of_body, components, sizeof components);
    for (int c = 0; c < 3; c++)
        wanted |= column_bit(columns[c]);
    world->store = store_open((size_t)count, wanted);
    for (int p = 0; p < count; p++) {
        bool is_out = random_below(&world->random, 50) == 0;
        for (int a = 0; a < 3; a++)
            world->position_of_id[p][a] = is_out && a == 1 ? world->frame.low[1] - 1 : anywhere(world, a);
        for (int a = 0; a < 3; a++)
            world->store->real[COLUMN_POSITION][a][p] = world->position_of_id[p][a];
        world->is_frozen[p] = is_out;
        world->store->integer[COLUMN_ID][p] = world->store->index_of_id[p] = p;
        world->store->integer[COLUMN_BODY][p] = random_below(&world->random, BODIES);
    }
}

/* Building anew takes back the particles that are in the frame again. */
static void build_anew(struct world *world)
{
    int32_t cell[3];
    cell_list_build(world->list, world->store);
    for (int32_t id = 0; id < world->list->count; id++)
        world->is_frozen[id] = !locate(&world->frame, world->position_of_id[id], cell);
}

static void run(const char *name, const int32_t cells[3], int count, int reach, bool sorts, uint64_t seed)
{
    static struct world world;
    int32_t most = 0, least = INT32_MAX;
    create(&world, cells, count, reach, seed);
    world.list = cell_list_open(world.frame, world.component_of_body, (size_t)count, reach);
    cell_list_build(world.list, world.store);
    check_all(&world);
    int update = 0;
    for (; update < UPDATES && !world.wrong; update++) {
        move_all(&world, random_below(&world.random, MOTIONS));
        announce(&world);
        cell_list_update(world.list, world.store);
        if (sorts && random_below(&world.random, 3) == 0) {
            cell_list_sort(world.list, world.store);
            for (int32_t k = 0; k < world.list->count; k++)
                expect(&world, world.list->order[k] == k, "the memory is not in the order of the list");
        }
        if (update == UPDATES / 2)
            build_anew(&world);
        check_all(&world);
        most = world.list->active > most ? world.list->active : most;
        least = world.list->active < least ? world.list->active : least;
    }
    printf("   update %d: %s; %d to %d active blocks, %d of %d particles have left\n", update,
           world.wrong ? world.wrong : "good", least, most, count - world.list->in_cells, count);
    check_true(name, !world.wrong);
    cell_list_close(world.list);
    store_close(world.store);
}

int main(void)
{
    static const struct {
        const char *name;
        int32_t cells[3];
        int count;
    } frames[] = {
        {"13 x 9 x 6", {13, 9, 6}, 300},     {"1 x 1 x 23", {1, 1, 23}, 120},  {"1 x 23 x 1", {1, 23, 1}, 120},
        {"23 x 1 x 1", {23, 1, 1}, 120},     {"one cell", {1, 1, 1}, 40},      {"one block", {4, 4, 4}, 100},
        {"5 x 5 x 5", {5, 5, 5}, 100},       {"one particle", {9, 9, 9}, 1},   {"1 x 16 x 17", {1, 16, 17}, 200},
        {"large, sparse", {300, 200, 250}, 25},
    };
    char name[80];
    for (size_t i = 0; i < sizeof frames / sizeof frames[0]; i++)
        for (int reach = 0; reach < 2; reach++)
            for (int sorts = 0; sorts < 2; sorts++) {
                uint64_t seed = 100 * i + 10 * (uint64_t)reach + (uint64_t)sorts;
                const char *sorting = sorts ? "on" : "off";
                snprintf(name, sizeof name, "cells: %s, reach %d, sort %s", frames[i].name, reach, sorting);
                run(name, frames[i].cells, frames[i].count, reach, sorts, seed);
                threads_set(1); /* waiting for other threads takes longer than all the work here */
            }
    return check_result();
}
