/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies that lie in each other are a mistake of the deck: their material counts twice. */
#include "deck/diagnostics.h"
#include "mpm/mpm.h"

#include <math.h>

/* Particles of two bodies that are nearer than this part of their spacing; touching lattices are a spacing apart. */
static const double NEAR = 0.4;

/* Cells with more particles are left out: nobody lays down so many on purpose without knowing. */
enum { MOST_IN_CELL = 200 };

/* What was found so far: how many particles, and the first pair. */
struct overlap {
    const struct store *store;
    long count;
    int32_t pair[2];
    double distance;
};

static void compare(struct overlap *overlap, int32_t p, int32_t q)
{
    const struct store *store = overlap->store;
    const double spacing = cbrt(fmin(store->real[COLUMN_VOLUME][0][p], store->real[COLUMN_VOLUME][0][q]));
    double square = 0;
    if (store->integer[COLUMN_BODY][p] == store->integer[COLUMN_BODY][q])
        return;
    for (int a = 0; a < 3; a++)
        square += pow(store->real[COLUMN_POSITION][a][p] - store->real[COLUMN_POSITION][a][q], 2);
    if (square >= NEAR * NEAR * spacing * spacing)
        return;
    if (overlap->count++ == 0) {
        overlap->pair[0] = p, overlap->pair[1] = q;
        overlap->distance = sqrt(square);
    }
}

/* Compares the particles of a cell in two blocks at one place, or in one. */
static void compare_cell(struct overlap *overlap, const struct cell_list *cells, const struct cell_block *first,
                         const struct cell_block *second, int cell)
{
    const int32_t *a = cells->order + first->first, *b = cells->order + second->first;
    const int32_t end = first->cell_first[cell + 1], other_end = second->cell_first[cell + 1];
    if (end - first->cell_first[cell] > MOST_IN_CELL || other_end - second->cell_first[cell] > MOST_IN_CELL)
        return;
    for (int32_t i = first->cell_first[cell]; i < end; i++)
        for (int32_t j = first == second ? i + 1 : second->cell_first[cell]; j < other_end; j++)
            compare(overlap, a[i], b[j]);
}

void overlap_warn(const struct mpm *mpm, struct diagnostics *diagnostics)
{
    const struct cell_list *cells = mpm->cells;
    const struct scene *scene = mpm->scene;
    struct overlap overlap = {.store = mpm->store};
    const int32_t components = scene->contact == CONTACT_NONE ? 1 : (int32_t)scene->components;
    for (int32_t b = 0; b < cells->active && scene->n_bodies > 1; b++)
        for (int32_t c = cells->blocks[b].component; c < components; c++) {
            const int32_t other = cell_list_find_block(cells, cells->blocks[b].at, c);
            for (int cell = 0; cell < BLOCK_CELLS && other >= 0 && other < cells->active; cell++)
                compare_cell(&overlap, cells, &cells->blocks[b], &cells->blocks[other], cell);
        }
    if (overlap.count == 0)
        return;
    const int32_t *body = mpm->store->integer[COLUMN_BODY], *id = mpm->store->integer[COLUMN_ID];
    const int32_t p = overlap.pair[0], q = overlap.pair[1];
    diagnostics_warning(diagnostics, scene->bodies[body[p] > body[q] ? body[p] : body[q]].place,
                        "bodies %d and %d overlap: particles %d and %d are %.3g apart (%ld such pairs); move one body, or cut it away "
                        "where the other is ('part solid')",
                        body[p] + 1, body[q] + 1, id[p] + 1, id[q] + 1, overlap.distance, overlap.count);
}
