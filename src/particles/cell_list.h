/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which particles are in which cell: blocks of 4 x 4 x 4 cells, only where there are particles.
 * Inside a block particles are listed by cell, inside a cell by id. That order does not depend on
 * where particles lie in memory or on the number of threads, and all loops follow it. */
#ifndef PARTICLES_CELL_LIST_H
#define PARTICLES_CELL_LIST_H

#include "particles/columns.h"

enum { BLOCK_EDGE = 4, BLOCK_CELLS = 64, BLOCK_NEIGHBOURS = 27 };

/* Values of cell_list.cell besides 0 ... 63. */
enum { CELL_LEFT_BLOCK = 254, CELL_NONE = 255 };

/* A regular grid of cells. */
struct cell_frame {
    double low[3], high[3];
    double size;
    int32_t cells[3];
};

struct cell_block {
    int32_t at[3];      /* block coordinates: cell coordinates / 4 */
    int32_t component;  /* particles of different components are in different blocks */
    int32_t first;      /* its particles are order[first] ... order[first + count - 1] */
    int32_t count;
    int32_t cell_first[BLOCK_CELLS + 1]; /* per cell, from first */
    int32_t neighbour[BLOCK_NEIGHBOURS]; /* (dx+1) + 3 (dy+1) + 9 (dz+1); -1 where there is none */
};

struct cell_list {
    struct cell_frame frame;
    const int32_t *component_of_body;
    int32_t total;          /* particles in all */
    int32_t count;          /* those that take part: places 0 ... count - 1 in memory; the others are closed */
    int32_t in_cells;       /* particles that have a cell; the others are order[in_cells ...] */
    int32_t *order;
    uint8_t *cell;          /* per particle in memory: its cell in its block, or one of the values above */
    uint8_t *block_changed; /* per block: some of its particles has a new value in `cell` */
    struct cell_block *blocks;
    int32_t active;         /* blocks 0 ... active - 1 hold particles, sorted by place */
    int32_t n_blocks;       /* the others only hold nodes that particles of active blocks reach */
    int32_t shared_blocks;  /* fewer blocks than this are not worth a second thread */
    long version;           /* counts changes of the set of blocks */
    double moved;           /* particles that changed cell since the last sorting in memory */
    struct cell_list_rooms *rooms; /* private */
};

/* Makes an empty list in which all particles take part. `reach` says how many cells beyond its own a particle's support spans on
 * the low side; on the high side it is one more. */
struct cell_list *cell_list_open(struct cell_frame frame, const int32_t *component_of_body, size_t total, int reach);
void cell_list_close(struct cell_list *list);

/* Finds the cells of all particles that take part anew. */
void cell_list_build(struct cell_list *list, const struct store *store);

/* Brings the lists up to date after `cell` and `block_changed` were set for particles that moved.
 * Particles marked CELL_LEFT_BLOCK are looked up; those outside the frame get CELL_NONE. */
void cell_list_update(struct cell_list *list, const struct store *store);

/* The closed particles at places count ... count + n - 1 take part from now on. */
void cell_list_admit(struct cell_list *list, const struct store *store, int32_t n);

/* Moves the particles that take part in memory into the order of the list. */
void cell_list_sort(struct cell_list *list, struct store *store);

/* Block of the particle at place p in memory; -1 when it has no cell or is closed. It may have left its
 * listed cell by less than two cells. */
int32_t cell_list_block_of(const struct cell_list *list, int32_t p, const struct store *store, int32_t component);

/* Block at a place, or -1. */
int32_t cell_list_find_block(const struct cell_list *list, const int32_t at[3], int32_t component);

/* Bytes of the list per particle at present. */
double cell_list_bytes_per_particle(const struct cell_list *list);

/* Cell coordinates of a position; false outside the closed frame. A point on an upper face is in
 * the last cell. */
static inline bool cell_locate(const struct cell_frame *frame, const double position[3], int32_t cell[3])
{
    for (int a = 0; a < 3; a++) {
        if (!(position[a] >= frame->low[a] && position[a] <= frame->high[a]))
            return false;
        int32_t i = (int32_t)((position[a] - frame->low[a]) / frame->size);
        cell[a] = i < frame->cells[a] ? i : frame->cells[a] - 1;
    }
    return true;
}

#endif
