/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What hangs together with the metal and what does not (sph/remove.c), on places made by hand: a plate of solid
 * with melt on it, a row of single particles up from there with a block on its end, and a drop far above. */
#include "check.h"
#include "sph_fixture.h"

#include <stdlib.h>

static const double SPACING = 0.01;

static struct fixture *open_scene(int32_t *parted)
{
    enum { PLATE = 12 * 4, MELT = 12 * 4, THREAD = 6, BLOCK = 5 * 5, DROP = 4 * 4 };
    struct fixture *fixture = fixture_open(2, SPACING, 1.2, PLATE + MELT + THREAD + BLOCK + DROP);
    fixture->words.wide_smoothing = 1.8;
    fixture->words.ejected_above = 6000;
    fixture_plain_material(&fixture->materials[0], 7000, 700, 30);
    fixture_block(fixture, 0, SPH_SOLID, (int[3]){0, 0, 0}, (int[3]){12, 4, 1}, 300);
    fixture_block(fixture, 0, SPH_FLUID, (int[3]){0, 4, 0}, (int[3]){12, 8, 1}, 2000);
    fixture_block(fixture, 0, SPH_FLUID, (int[3]){6, 8, 0}, (int[3]){7, 14, 1}, 2100);
    fixture_block(fixture, 0, SPH_FLUID, (int[3]){4, 14, 0}, (int[3]){9, 19, 1}, 2200);
    fixture_block(fixture, 0, SPH_FLUID, (int[3]){4, 30, 0}, (int[3]){8, 34, 1}, 7000);
    fixture_list(fixture);
    fixture->sph.columns.parted = parted;
    fixture->sph.budget.fastest = 1;
    return fixture;
}

/* How many particles of one temperature are left and have a mark. */
static int count_of(const struct fixture *fixture, double temperature, enum sph_parted mark)
{
    const struct sph_columns *c = &fixture->sph.columns;
    int count = 0;
    for (size_t p = 0; p < fixture->sph.store->count; p++)
        count += c->temperature[p] == temperature && c->state[p] != SPH_REMOVED && c->parted[p] == (int32_t)mark;
    return count;
}

static void test_marks(void)
{
    int32_t parted[143] = {0};
    struct fixture *fixture = open_scene(parted);
    remove_ejected(&fixture->sph);
    check_true("a plate holds", count_of(fixture, 300, SPH_HOLDS) == 48);
    check_true("melt holds but for its two sharp corners", count_of(fixture, 2000, SPH_HOLDS) == 46 && count_of(fixture, 2000, SPH_OF_THREAD) == 2);
    check_true("a row of single ones is a thread", count_of(fixture, 2100, SPH_OF_THREAD) > 0);
    check_true("a block at the end of a thread came off", count_of(fixture, 2200, SPH_CAME_OFF) == 25);
    check_true("a hot drop that came off is removed", count_of(fixture, 7000, SPH_CAME_OFF) == 0 && fixture->sph.budget.removed == 16);
    memory_free(fixture->sph.clusters);
    fixture_close(fixture);
}

int main(void)
{
    test_marks();
    return check_result();
}
