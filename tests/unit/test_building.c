/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Closed particles: the order in which they open against formulas on the integer places of a lattice, which
 * ones are open after which step, their layers, and what they bring along. */
#include "check.h"
#include "particles/results.h"
#include "scene_text.h"

enum { EDGE = 20, LAYERS = 10, MOST = EDGE * EDGE * LAYERS };
static const double SPACING = 0.095, PI = 3.14159265358979323846;

/* A point of the lattice: place along the two axes of the plane and along the build direction. */
struct point {
    int place[3];
    int id; /* from 0 */
};

/* A disc with a round opening and a web across it (two D-shaped holes), the ids running backwards, so that no
 * order follows from them. Coordinate `axis` is the build direction, the next two lie in the plane. */
static int make_part(struct point *points)
{
    int count = 0;
    for (int k = LAYERS - 1; k >= 0; k--)
        for (int j = EDGE - 1; j >= 0; j--)
            for (int i = EDGE - 1; i >= 0; i--) {
                int a = 2 * i + 1 - EDGE, b = 2 * j + 1 - EDGE, d = a * a + b * b;
                if (d >= EDGE * EDGE || (25 * d < 9 * EDGE * EDGE && 5 * abs(a) > EDGE))
                    continue;
                points[count] = (struct point){{i, j, k}, count};
                count++;
            }
    return count;
}

static void part_deck(struct deck_builder *deck, const struct point *points, int count, int axis, const char *words)
{
    const double mass = 4.5e-3 * SPACING * SPACING * SPACING, cell = 2 * SPACING;
    deck_add(deck, "mpm3d part\nnbco 1\nnbbo 1\nnbmp %d\nnmat 1\n", count);
    deck_add(deck, "grid -1 %.17g -1 %.17g -1 %.17g\ndcel %.17g\n", 16 * cell - 1, 16 * cell - 1, 16 * cell - 1, cell);
    deck_add(deck, "endt 1\njaum off\nmate\n1 elas 4.5e-3 115000 0.34\npart poin 1 %d\n", count);
    for (int p = 0; p < count; p++) {
        double x[3];
        for (int a = 0; a < 3; a++)
            x[(axis + 1 + a) % 3] = -0.5123 + (points[p].place[a] + 0.5) * SPACING;
        deck_add(deck, "%d 1 %.6e %.6f %.6f %.6f\n", p + 1, mass, x[0], x[1], x[2]); /* digits as a program writes them */
    }
    deck_add(deck, "Ghost\nendG\n%s\nendi\n", words);
}

/* Line and place along it of a point, as a list of scan tracks on the lattice gives them. */
static void track_of(const struct point *point, double angle, double *track, double *along)
{
    const int i = point->place[0], j = point->place[1];
    const double x = i + 0.5, y = j + 0.5, t = angle * PI / 180;
    *along = angle == 0 ? i : angle == 90 ? j : angle == 45 ? i + j : x * cos(t) + y * sin(t);
    *track = angle == 0 || angle == 180 ? j : fabs(angle) == 90 || angle == 270 ? i : angle == 45 ? j - i : angle == 135 ? i + j
           : angle == -45 ? i + j : floor((cos(t) > 0 ? 1 : -1) * (y * cos(t) - x * sin(t)) + 1e-9);
    if (angle == 180)
        *along = -i;
    if (angle == 270 || angle == -90)
        *along = -j;
}

struct key {
    double layer, track, along;
    int id;
};

static int by_key(const void *left, const void *right)
{
    const struct key *a = left, *b = right;
    if (a->layer != b->layer)
        return a->layer < b->layer ? -1 : 1;
    if (a->track != b->track)
        return a->track < b->track ? -1 : 1;
    if (fabs(a->along - b->along) > 1e-9)
        return a->along < b->along ? -1 : 1;
    return a->id - b->id;
}

struct scan {
    double angles[3];
    int n_angles, rows; /* rows: lattice heights in a layer */
    bool is_serpentine;
};

static void expected_order(const struct point *points, int count, const struct scan *scan, struct key *keys)
{
    bool is_turned = false;
    for (int p = 0; p < count; p++) {
        int layer = points[p].place[2] / scan->rows;
        keys[p] = (struct key){.layer = layer, .id = p};
        track_of(&points[p], scan->angles[layer % scan->n_angles], &keys[p].track, &keys[p].along);
    }
    qsort(keys, (size_t)count, sizeof *keys, by_key);
    for (int p = 0; p < count && scan->is_serpentine; p++) {
        if (p == 0 || keys[p].layer != keys[p - 1].layer)
            is_turned = false;
        else if (keys[p].track != keys[p - 1].track)
            is_turned = !is_turned;
        keys[p].along *= is_turned ? -1 : 1;
    }
    qsort(keys, (size_t)count, sizeof *keys, by_key);
}

/* The memory order of a run that has just opened is that of the openings. */
static void test_order(const char *name, int axis, const struct scan *scan, const char *words)
{
    static struct point points[MOST];
    static struct key keys[MOST];
    struct deck_builder deck = {0};
    struct test_run run;
    int count = make_part(points), wrong = 0, wrong_layers = 0;
    part_deck(&deck, points, count, axis, words);
    test_run_open(&run, &deck);
    expected_order(points, count, scan, keys);
    for (int k = 0; k < count; k++) {
        wrong += run.mpm->store->integer[COLUMN_ID][k] != keys[k].id;
        wrong_layers += run.mpm->store->integer[COLUMN_LAYER][k] != (int)keys[k].layer;
    }
    printf("   %s: %d points, %d out of order, %d in a wrong layer\n", name, count, wrong, wrong_layers);
    check_true(name, wrong == 0 && wrong_layers == 0 && run.mpm->cells->count == 0);
    test_run_close(&run);
}

static void test_orders(void)
{
    const struct scan coupled = {{0, 45, 90}, 3, 1, false}, serpentine = {{0, 45, 90}, 3, 1, true}, thick = {{0, 45, 90}, 3, 2, false};
    const double angles[] = {0, 45, 90, 30, 135, 180, 270, -45, -90};
    char name[80], words[160];
    for (size_t i = 0; i < sizeof angles / sizeof angles[0]; i++) {
        const struct scan scan = {{angles[i]}, 1, 1, false}, turned = {{angles[i]}, 1, 1, true};
        snprintf(words, sizeof words, "open point every 1\nscan raster %g\noutr laye", angles[i]);
        snprintf(name, sizeof name, "raster at %g degrees", angles[i]);
        test_order(name, 2, &scan, words);
        snprintf(words, sizeof words, "open point every 1\nscan raster serpentine %g\noutr laye", angles[i]);
        snprintf(name, sizeof name, "serpentine at %g degrees", angles[i]);
        test_order(name, 2, &turned, words);
    }
    for (int axis = 0; axis < 3; axis++) {
        snprintf(words, sizeof words, "buil %c\nopen group 7 every 3\nscan raster 0 45 90\noutr laye", "xyz"[axis]);
        snprintf(name, sizeof name, "0 45 90 in turn along %c", "xyz"[axis]);
        test_order(name, axis, &coupled, words);
        snprintf(words, sizeof words, "buil %c\nopen all\nscan raster serpentine 0 45 90\noutr laye", "xyz"[axis]);
        snprintf(name, sizeof name, "serpentine 0 45 90 along %c", "xyz"[axis]);
        test_order(name, axis, &serpentine, words);
        snprintf(words, sizeof words, "buil %c %.17g\nopen point every 1\nscan raster 0 45 90\noutr laye", "xyz"[axis], 2 * SPACING);
        snprintf(name, sizeof name, "layers of two heights along %c", "xyz"[axis]);
        test_order(name, axis, &thick, words);
    }
    /* more than a turn is the same angle */
    const struct scan thirty = {{30}, 1, 1, false};
    test_order("raster at 390 degrees", 2, &thirty, "open point every 1\nscan raster 390\noutr laye");
}

/* --- which particles are open when --- */

enum { BLOCK = 27 };

static void block_deck(struct deck_builder *deck, const char *words)
{
    deck_add(deck, "mpm3d block\nnbco 1\nnbbo 1\nnbmp %d\nnmat 1\ngrid -0.4 1 -0.4 1 -0.4 1\ndcel 0.2\n", BLOCK);
    deck_add(deck, "endt 1\ndtfx 1e-6\nmate\n1 elas 4.5e-3 115000 0.34\npart bloc 1\n1 4.5e-3 0.1 0 0 0 3 3 3\n%s\nendi\n", words);
}

static bool is_open(const struct test_run *run, int id)
{
    const struct result_source source = {run->mpm->store, run->mpm->material_of_body, run->mpm->material_number_of_body,
                                         &run->mpm->cells->count, false, NULL};
    return !result_is_closed(&source, (size_t)run->mpm->store->index_of_id[id]);
}

/* order[0 ... count-1] are ids from 1 in the order of their opening; openings[s - 1] of them open in step s. */
static void test_openings(const char *name, const char *words, const int *order, const int *openings, int steps)
{
    struct deck_builder deck = {0};
    struct test_run run;
    bool opens[BLOCK] = {false}, good = true;
    int opened = 0;
    block_deck(&deck, words);
    test_run_open(&run, &deck);
    for (int step = 0; step <= steps; step++) {
        for (int n = step > 0 ? openings[step - 1] : openings[steps]; n > 0; n--)
            opens[order[opened++] - 1] = true;
        if (step > 0)
            mpm_step(run.mpm);
        for (int id = 0; id < BLOCK; id++)
            good = good && is_open(&run, id) == opens[id];
        good = good && run.mpm->cells->in_cells == opened;
    }
    check_true(name, good);
    test_run_close(&run);
}

/* The last entry of `openings` are those that are open at the start. */
static void test_schedules(void)
{
    int by_id[BLOCK], columns[BLOCK];
    for (int p = 0; p < BLOCK; p++) {
        by_id[p] = p + 1;
        columns[p] = p / 9 * 9 + p % 3 * 3 + p / 3 % 3 + 1; /* along y, x growing */
    }
    test_openings("open point every 2", "Ghost endG\nopen point every 2", by_id, (int[]){1, 0, 1, 0, 1, 0, 1, 0}, 7);
    test_openings("open group 5 every 3", "Ghost endG\nopen group 5 every 3", by_id,
                  (int[]){5, 0, 0, 5, 0, 0, 5, 0, 0, 5, 0, 0, 5, 0, 0, 2, 0, 0, 0}, 18);
    test_openings("open layer every 2", "Ghost endG\nopen layer every 2", by_id, (int[]){9, 0, 9, 0, 9, 0, 0}, 6);
    test_openings("open all", "Ghost endG\nopen all", by_id, (int[]){27, 0, 0}, 2);
    test_openings("layers of one and a half heights", "Ghost endG\nbuil z 0.15\nopen layer every 1", by_id, (int[]){9, 18, 0, 0}, 3);
    test_openings("open until in a group", "Ghost endG\nopen group 5 every 1\nopen until 12", by_id, (int[]){5, 5, 2, 0, 0, 0}, 5);
    test_openings("open until in a layer", "Ghost endG\nopen layer every 1\nopen until 12", by_id, (int[]){9, 3, 0, 0}, 3);
    test_openings("some open at the start", "Ghost\nGPD 1 12 1\nGPD 3 5 0\nGPD 4 1\nendG\nopen group 2 every 1\nopen until 14",
                  (int[]){1, 2, 4, 6, 7, 8, 9, 10, 11, 12, 3, 5, 13, 14}, (int[]){2, 2, 0, 0, 10}, 4);
    test_openings("closed for ever", "Ghost\nGPD 1 5 1\nendG", by_id, (int[]){0, 0, 5}, 2);
    test_openings("raster along y", "Ghost endG\nopen group 4 every 1\nscan raster 90", columns, (int[]){4, 4, 4, 4, 4, 4, 3, 0, 0}, 8);
    test_openings("raster angles do not change a layer", "Ghost endG\nopen layer every 1\nscan raster 90", columns,
                  (int[]){9, 9, 9, 0, 0}, 4);
    /* planes of one x: ids 1 4 7 10 ... */
    int planes[BLOCK];
    for (int p = 0; p < BLOCK; p++)
        planes[p] = p % 9 * 3 + p / 9 + 1;
    test_openings("layers along x", "Ghost endG\nbuil x\nopen layer every 1", planes, (int[]){9, 9, 9, 0, 0}, 4);
}

/* `open settle n` ends the run n steps after the last opening. */
static void test_settling(void)
{
    struct deck_builder deck = {0};
    struct test_run run;
    block_deck(&deck, "Ghost endG\nopen layer every 4\nopen settle 3");
    test_run_open(&run, &deck);
    check_true("last opening in step 9, end behind step 12", !building_has_settled(run.mpm, 11) && building_has_settled(run.mpm, 12));
    test_run_close(&run);
}

/* --- what comes along --- */

/* Velocities of closed particles wait until they open: kinetic damping leaves them alone, the step heeds them,
 * their momentum and energy are no error of the balance. */
static void test_waiting(void)
{
    struct deck_builder deck = {0};
    struct test_run run;
    block_deck(&deck, "dtfx 0\ndtsc 0.5\ndrda\nGhost\nGPD 1 9 1\nendG\nopen layer every 3\nvelo\nbody 1 0 0 40\nendv");
    test_run_open(&run, &deck);
    const double speed = 40, wave = sqrt(115000 * (1 - 0.34) / ((1 + 0.34) * (1 - 2 * 0.34)) / 4.5e-3);
    double momentum = run.mpm->sums.momentum[2];
    for (int step = 0; step < 3; step++)
        mpm_step(run.mpm);
    check_near("closed particles keep their velocity", run.mpm->store->real[COLUMN_VELOCITY][2][run.mpm->store->index_of_id[26]], speed, 0);
    for (int a = 0; a < 3; a++)
        for (int p = 0; p < run.mpm->cells->count; p++) /* at rest, then a layer comes with its speed */
            run.mpm->store->real[COLUMN_VELOCITY][a][p] = 0;
    run.mpm->sums = mpm_total(run.mpm);
    const double before = run.mpm->time, start = run.mpm->start_momentum[2];
    mpm_step(run.mpm);
    check_near("the step heeds the speed of what opens", run.mpm->time - before, 0.5 * 0.2 / (wave + speed), 1e-15);
    check_near("momentum that opens is no change", run.mpm->start_momentum[2] - start, momentum, 1e-12 * momentum);
    test_run_close(&run);
}

/* Without a particle that is open at the start the first step is that of the materials. */
static void test_first_step(void)
{
    struct deck_builder deck = {0};
    struct test_run run;
    block_deck(&deck, "dtfx 0\ndtsc 0.5\nGhost endG\nopen point every 2");
    test_run_open(&run, &deck);
    const double wave = sqrt(115000 * (1 - 0.34) / ((1 + 0.34) * (1 - 2 * 0.34)) / 4.5e-3);
    check_near("first step with all particles closed", run.mpm->first_time_step, 0.5 * 0.2 / wave, 1e-18);
    for (int step = 0; step < 10; step++)
        mpm_step(run.mpm);
    check_true("such a run goes on", !mpm_check(run.mpm).is_stopped);
    test_run_close(&run);
}

/* A stiffer material limits the step from its opening on. */
static void test_stiffer(void)
{
    struct deck_builder deck = {0};
    struct test_run run;
    deck_add(&deck, "mpm3d two\nnbco 1\nnbbo 2\nnbmp 54\nnmat 2\ngrid -0.4 1 -0.4 1 -0.4 1\ndcel 0.2\nendt 1\ndtsc 0.5\nmate\n");
    deck_add(&deck, "1 elas 4.5e-3 1000 0\n2 elas 4.5e-3 4000 0\npart bloc 1\n1 4.5e-3 0.1 0 0 0 3 3 3\n");
    deck_add(&deck, "part bloc 1\n2 4.5e-3 0.1 0.3 0 0 3 3 3\nGhost\nGPD 1 27 1\nendG\nopen group 14 every 1\nendi\n");
    test_run_open(&run, &deck);
    const double soft = 0.5 * 0.2 / sqrt(1000 / 4.5e-3);
    check_near("first step of the soft material", run.mpm->time_step, soft, 1e-18);
    mpm_step(run.mpm);
    check_near("half of it once the stiff one opens", run.mpm->time, soft / 2, 1e-18);
    test_run_close(&run);
}

int main(void)
{
    test_orders();
    test_schedules();
    test_settling();
    test_waiting();
    test_first_step();
    test_stiffer();
    return check_result();
}
