/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stiffness without its matrix against the sum over particles, and what its levels must keep. */
#include "base/vector.h"
#include "check.h"
#include "mpm/equilibrium.h"
#include "mpm/multigrid.h"
#include "mpm/rigid.h"
#include "random.h"
#include "scene_text.h"

#include <stdlib.h>

enum { POINTS = 300 };

/* Points without order in two materials; 11 x 3 x 5 cells, of which some hold many points and some none. */
static void open_points(struct test_run *run, const char *words, int materials)
{
    struct deck_builder deck = {0};
    struct random random = {7};
    deck_add(&deck, "mpm3d\nnbco 1\nnbbo %d\nnbmp %d\nnmat 2\nspx 0 12\nspy 0 9\nspz 0 9\ndcel 1\n%s\nquas 1e-6\n", materials, POINTS * materials, words);
    deck_add(&deck, "mate\n1 elas 1 100 0.3\n2 elas 1 3000 0.45\n");
    for (int m = 0; m < materials; m++) {
        deck_add(&deck, "part poin 1 %d\n", POINTS);
        for (int i = 0; i < POINTS; i++)
            deck_add(&deck, "%d %d %g %.9f %.9f %.9f\n", m * POINTS + i + 1, m + 1, 0.1 + 0.1 * (i % 3), random_between(&random, 0, 11),
                     random_between(&random, 0, 3), random_between(&random, 0, 5));
    }
    deck_add(&deck, "endi\n");
    test_run_open(run, &deck);
}

/* Place in a vector of component a at a node of the grid. */
static size_t place_of(const struct stiffness *stiffness, const int node[3], int a)
{
    for (int32_t b = 0; b < stiffness->n_blocks; b++) {
        const int32_t *at = stiffness->blocks[b].at;
        if (node[0] / 4 == at[0] && node[1] / 4 == at[1] && node[2] / 4 == at[2])
            return (size_t)b * STIFFNESS_VECTOR + (size_t)(a * 64 + node[0] % 4 + 4 * (node[1] % 4) + 16 * (node[2] % 4));
    }
    return 0;
}

/* Cell, and values and gradients of its corners' shape functions at a particle. */
static void shape_of(const struct mpm *mpm, size_t p, int cell[3], double gradient[8][3])
{
    double local[3];
    for (int a = 0; a < 3; a++) {
        cell[a] = (int)mpm->store->real[COLUMN_POSITION][a][p];
        local[a] = mpm->store->real[COLUMN_POSITION][a][p] - cell[a];
    }
    for (int i = 0; i < 8; i++)
        for (int d = 0; d < 3; d++) {
            gradient[i][d] = 1;
            for (int a = 0; a < 3; a++) {
                double weight = i >> a & 1 ? local[a] : 1 - local[a], slope = i >> a & 1 ? 1 : -1;
                gradient[i][d] *= a == d ? slope : weight;
            }
        }
}

/* g = gradient of x at particle p. */
static void gradient_of(const struct mpm *mpm, const struct stiffness *stiffness, const double *x, size_t p, double g[3][3])
{
    int cell[3];
    double gradient[8][3];
    memset(g, 0, 9 * sizeof(double));
    shape_of(mpm, p, cell, gradient);
    for (int i = 0; i < 8; i++)
        for (int a = 0; a < 3; a++) {
            int node[3] = {cell[0] + (i & 1), cell[1] + (i >> 1 & 1), cell[2] + (i >> 2)};
            for (int d = 0; d < 3; d++)
                g[a][d] += x[place_of(stiffness, node, a)] * gradient[i][d];
        }
}

/* Means over the particles in the cell of p: of volume change by volume, and of the bulk modulus. */
static void cell_means(const struct mpm *mpm, const struct stiffness *stiffness, const double *x, size_t p, double *trace, double *bulk)
{
    double volume = 0;
    *trace = *bulk = 0;
    for (size_t q = 0; q < mpm->store->count; q++) {
        double g[3][3], v = mpm->store->real[COLUMN_VOLUME][0][q];
        bool is_near = true;
        for (int a = 0; a < 3; a++)
            is_near = is_near && (int)mpm->store->real[COLUMN_POSITION][a][q] == (int)mpm->store->real[COLUMN_POSITION][a][p];
        if (!is_near)
            continue;
        gradient_of(mpm, stiffness, x, q, g);
        volume += v;
        *trace += v * (g[0][0] + g[1][1] + g[2][2]);
        *bulk += v * mpm->material_of_body[mpm->store->integer[COLUMN_BODY][q]]->bulk_modulus;
    }
    *trace /= volume;
    *bulk /= volume;
}

/* y = K x, particle by particle. */
static void naive_apply(const struct mpm *mpm, const struct stiffness *stiffness, const double *x, double *y)
{
    memset(y, 0, (size_t)stiffness->n_blocks * STIFFNESS_VECTOR * sizeof *y);
    for (size_t p = 0; p < mpm->store->count; p++) {
        const struct material *material = mpm->material_of_body[mpm->store->integer[COLUMN_BODY][p]];
        double gradient[8][3], g[3][3], volume = mpm->store->real[COLUMN_VOLUME][0][p];
        int cell[3];
        shape_of(mpm, p, cell, gradient);
        gradient_of(mpm, stiffness, x, p, g);
        double trace = g[0][0] + g[1][1] + g[2][2], mean = trace, bulk = material->bulk_modulus;
        if (mpm->scene->averages_volume)
            cell_means(mpm, stiffness, x, p, &mean, &bulk);
        for (int i = 0; i < 8; i++)
            for (int a = 0; a < 3; a++)
                for (int d = 0; d < 3; d++) {
                    int node[3] = {cell[0] + (i & 1), cell[1] + (i >> 1 & 1), cell[2] + (i >> 2)};
                    double stress = material->shear_modulus * (g[a][d] + g[d][a]);
                    if (a == d)
                        stress += bulk * mean - 2 * material->shear_modulus * trace / 3;
                    y[place_of(stiffness, node, a)] += volume * stress * gradient[i][d];
                }
    }
    for (size_t i = 0; i < (size_t)stiffness->n_blocks * STIFFNESS_VECTOR; i++)
        if (!(stiffness->blocks[i / STIFFNESS_VECTOR].free[i % 64] >> i % STIFFNESS_VECTOR / 64 & 1))
            y[i] = 0;
}

static void fill_random(const struct stiffness *stiffness, uint64_t seed, double *x)
{
    struct random random = {seed};
    for (size_t i = 0; i < (size_t)stiffness->n_blocks * STIFFNESS_VECTOR; i++)
        x[i] = stiffness->blocks[i / STIFFNESS_VECTOR].free[i % 64] >> i % STIFFNESS_VECTOR / 64 & 1 ? random_between(&random, -0.5, 0.5) : 0;
}

static void test_against_particles(const char *name, const char *words, int materials)
{
    struct test_run run;
    struct multigrid multigrid = {0};
    const struct light_nodes light = {0}; /* none */
    char text[100];
    open_points(&run, words, materials);
    multigrid_open(&multigrid, run.mpm, &light, NULL, false);
    const struct stiffness *stiffness = &multigrid.level[0].stiffness;
    const size_t count = multigrid_count(&multigrid);
    double *x = calloc(count, sizeof *x), *y = calloc(count, sizeof *y), *z = calloc(count, sizeof *z), *w = calloc(count, sizeof *w);
    fill_random(stiffness, 3, x);
    multigrid_apply(&multigrid, x, y);
    naive_apply(run.mpm, stiffness, x, z);
    double size = vector_length(z, count);
    vector_add(z, -1, y, count);
    snprintf(text, sizeof text, "%s: stiffness is that of the particles", name);
    check_near(text, vector_length(z, count) / size, 0, 1e-13);
    /* a unit displacement answered by its own diagonal block */
    double worst = 0;
    for (size_t i = 0; i < count; i += 37) {
        const size_t b = i / STIFFNESS_VECTOR, n = i % 64, a = i % STIFFNESS_VECTOR / 64;
        if (stiffness->blocks[b].free[n] != 7)
            continue;
        memset(x, 0, count * sizeof *x);
        x[i] = 1;
        stiffness_apply(stiffness, x, y);
        stiffness_jacobi(stiffness, (int32_t)b, y + b * STIFFNESS_VECTOR, 1, 0, z);
        for (size_t k = 0; k < 3; k++)
            worst = fmax(worst, fabs(z[k * 64 + n] - (k == a)));
    }
    snprintf(text, sizeof text, "%s: inverse of the diagonal blocks", name);
    check_near(text, worst, 0, 1e-7); /* blocks of nodes that feel one point are nearly singular */
    fill_random(stiffness, 4, x);
    fill_random(stiffness, 5, y);
    multigrid_precondition(&multigrid, x, z);
    multigrid_precondition(&multigrid, y, w);
    double left = vector_dot(y, z, count), right = vector_dot(x, w, count);
    snprintf(text, sizeof text, "%s: preconditioner is symmetric", name);
    check_near(text, left / right, 1, 1e-9);
    snprintf(text, sizeof text, "%s: preconditioner is positive", name);
    check_true(text, vector_dot(x, z, count) > 0 && multigrid.n_levels > 1);
    free(x), free(y), free(z), free(w);
    multigrid_close(&multigrid);
    test_run_close(&run);
}

/* A field that is linear over the whole body has the same energy on all levels. */
static void test_levels(const char *name, const char *words, int materials)
{
    struct test_run run;
    struct multigrid multigrid = {0};
    const struct light_nodes light = {0}; /* none */
    double energy[2];
    char text[100];
    open_points(&run, words, materials);
    multigrid_open(&multigrid, run.mpm, &light, NULL, false);
    for (int l = 0; l < 2; l++) {
        const struct stiffness *stiffness = &multigrid.level[l].stiffness;
        const size_t count = (size_t)stiffness->n_blocks * STIFFNESS_VECTOR;
        double *x = calloc(count, sizeof *x), *y = calloc(count, sizeof *y);
        for (size_t i = 0; i < count; i++) {
            const struct stiffness_block *block = &stiffness->blocks[i / STIFFNESS_VECTOR];
            const int n = (int)(i % 64), a = (int)(i % STIFFNESS_VECTOR / 64);
            double place[3] = {4 * block->at[0] + n % 4, 4 * block->at[1] + n / 4 % 4, 4 * block->at[2] + n / 16};
            if (block->free[n] >> a & 1)
                x[i] = stiffness->size * ((1 + a) * place[0] - 0.5 * place[1] + 0.3 * a * place[2]);
        }
        stiffness_apply(stiffness, x, y);
        energy[l] = vector_dot(x, y, count);
        free(x), free(y);
    }
    snprintf(text, sizeof text, "%s: energy of a linear field on the coarser level", name);
    check_near(text, energy[1] / energy[0], 1, 1e-12);
    multigrid_close(&multigrid);
    test_run_close(&run);
}

/* Free motions of a block under held faces: x- x+ y- y+ z- z+. */
static void test_rigid(const char *fixed, int expected)
{
    struct test_run run;
    struct deck_builder deck = {0};
    struct rigid rigid = {0};
    char text[100];
    deck_add(&deck, "mpm3d\nnbco 1\nnbbo 1\nnbmp 64\nnmat 1\nspx 0 4\nspy 0 4\nspz 0 4\ndcel 1\nfixe %s\nquas 1e-6\n", fixed);
    deck_add(&deck, "mate\n1 elas 1 100 0.3\npart bloc 1\n1 1 0.5 0 0 0 4 4 4\nendi\n");
    test_run_open(&run, &deck);
    mpm_equilibrate(run.mpm); /* puts masses on the grid */
    rigid_connect(&rigid, run.mpm);
    rigid_find(&rigid, run.mpm, NULL);
    snprintf(text, sizeof text, "free motions with fixe %s", fixed);
    check_near(text, rigid.n_floating > 0 ? rigid.motions : 0, expected, 0);
    const size_t count = (size_t)run.mpm->cells->n_blocks * STIFFNESS_VECTOR;
    double *x = calloc(count, sizeof *x), *y = calloc(count, sizeof *y);
    for (size_t i = 0; i < count; i++) {
        const size_t node = i / STIFFNESS_VECTOR * 64 + i % 64;
        bool is_free = rigid.part_of_node[node] >= 0 && !(run.mpm->grid->fixed[node] >> i % STIFFNESS_VECTOR / 64 & 1);
        x[i] = is_free ? 1 + sin((double)i) : 0;
    }
    double before = vector_length(x, count);
    rigid_remove_motion(&rigid, run.mpm, x);
    memcpy(y, x, count * sizeof *y);
    check_true("something is taken out, or nothing", (vector_length(x, count) < 0.95 * before) == (expected > 0));
    rigid_remove_motion(&rigid, run.mpm, y);
    vector_add(y, -1, x, count);
    check_near("what is left has no free motion", vector_length(y, count) / before, 0, 1e-14);
    free(x), free(y);
    rigid_close(&rigid);
    test_run_close(&run);
}

/* A block whose outermost points lie just inside further cells: nodes there are light. Linear fields go on through
 * them, and their forces are moved by the transpose. */
static void test_light(void)
{
    struct test_run run;
    struct deck_builder deck = {0};
    struct light_nodes light = {0};
    struct rigid rigid = {0};
    deck_add(&deck, "mpm3d\nnbco 1\nnbbo 1\nnbmp 512\nnmat 1\nspx 0 6\nspy 0 6\nspz 0 6\ndcel 1\nquas 1e-6\n");
    deck_add(&deck, "mate\n1 elas 1 100 0.3\npart bloc 1\n1 1 0.5 0.74999 0.74999 0.5 8 8 8\nendi\n");
    test_run_open(&run, &deck);
    mpm_equilibrate(run.mpm); /* puts masses on the grid */
    rigid_connect(&rigid, run.mpm);
    light_nodes_find(&light, run.mpm, rigid.part_of_node);
    check_near("light nodes: two lower faces of 6 x 6 nodes, less their edge", light.count, 2 * 36 - 6, 0);
    const size_t count = (size_t)run.mpm->cells->n_blocks * STIFFNESS_VECTOR;
    double *x = calloc(count, sizeof *x), *y = calloc(count, sizeof *y), *z = calloc(count, sizeof *z), worst = 0;
    for (size_t i = 0; i < count; i++) {
        const struct cell_block *block = &run.mpm->cells->blocks[i / STIFFNESS_VECTOR];
        const int n = (int)(i % 64), a = (int)(i % STIFFNESS_VECTOR / 64);
        const double place[3] = {4 * block->at[0] + n % 4, 4 * block->at[1] + n / 4 % 4, 4 * block->at[2] + n / 16};
        x[i] = y[i] = 1 + (1 + a) * place[0] - 0.5 * place[1] + 0.3 * a * place[2];
        z[i] = sin((double)i);
    }
    light_nodes_clear(&light, y);
    light_nodes_follow(&light, run.mpm->grid->fixed, y);
    for (size_t i = 0; i < count; i++)
        worst = fmax(worst, fabs(y[i] - x[i]));
    check_near("light nodes: linear fields go on", worst, 0, 1e-13);
    double before = vector_dot(y, z, count);
    light_nodes_lead(&light, run.mpm->grid->fixed, z);
    check_near("light nodes: forces do the same work where they are moved", vector_dot(y, z, count) / before, 1, 1e-12);
    free(x), free(y), free(z);
    light_nodes_close(&light);
    rigid_close(&rigid);
    test_run_close(&run);
}

int main(void)
{
    test_light();
    test_against_particles("one material", "fixe 2 0 1 0 0 0", 1);
    test_against_particles("two materials", "fixe 0 0 0 0 0 1", 2);
    test_against_particles("bbar", "bbar", 1);
    test_against_particles("bbar, two materials", "bbar", 2);
    test_levels("one material", "", 1);
    test_levels("two materials", "", 2);
    test_rigid("0 0 0 0 0 0", 6);
    test_rigid("2 0 0 0 0 0", 3);
    test_rigid("2 0 2 0 0 0", 1);
    test_rigid("2 0 2 0 2 0", 0);
    test_rigid("0 0 1 0 0 0", 0);
    return check_result();
}
