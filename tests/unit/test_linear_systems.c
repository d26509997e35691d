/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The solvers of base/: against matrices whose solutions are known. */
#include "base/bicgstab.h"
#include "base/conjugate.h"
#include "base/envelope.h"
#include "base/incomplete.h"
#include "base/memory.h"
#include "base/symmetric.h"
#include "base/vector.h"
#include "check.h"

#include <stdlib.h>
#include <string.h>

enum { GRID = 12, COUNT = GRID * GRID };

/* The five-point difference matrix of a square; `held` adds 1 to the first diagonal entry, else rows sum to zero. */
static double laplace(int i, int j, bool held)
{
    const int dx = abs(i % GRID - j % GRID), dy = abs(i / GRID - j / GRID);
    if (i == j) {
        int x = i % GRID, y = i / GRID;
        return (x > 0) + (x < GRID - 1) + (y > 0) + (y < GRID - 1) + (held && i == 0);
    }
    return dx + dy == 1 ? -1 : 0;
}

static void apply_held(void *context, const double *x, double *y)
{
    (void)context;
    for (int i = 0; i < COUNT; i++) {
        y[i] = 0;
        for (int j = 0; j < COUNT; j++)
            y[i] += laplace(i, j, true) * x[j];
    }
}

static void apply_free(void *context, const double *x, double *y)
{
    (void)context;
    apply_held(NULL, x, y);
    y[0] -= x[0];
}

static void precondition(void *context, const double *r, double *z)
{
    (void)context;
    for (int i = 0; i < COUNT; i++)
        z[i] = r[i] / laplace(i, i, true);
}

static void fill_solution(double *x, int count)
{
    for (int i = 0; i < count; i++)
        x[i] = sin(0.7 * i) + 0.01 * i;
}

static double largest_difference(const double *a, const double *b, int count)
{
    double largest = 0;
    for (int i = 0; i < count; i++)
        largest = fmax(largest, fabs(a[i] - b[i]));
    return largest;
}

static void test_conjugate(void)
{
    struct conjugate_room room = {0};
    double wanted[COUNT], right[COUNT], x[COUNT];
    struct conjugate_problem problem = {NULL, apply_held, precondition, COUNT};
    fill_solution(wanted, COUNT);
    apply_held(NULL, wanted, right);
    struct conjugate_result result = conjugate_solve(&problem, &room, x, right, 1e-12, 1000);
    check_true("conjugate gradients end", result.ending == CONJUGATE_FOUND && result.iterations <= COUNT);
    check_near("conjugate gradients: solution", largest_difference(x, wanted, COUNT), 0, 1e-9);
    check_near("conjugate gradients: residual left behind", vector_length(right, COUNT), result.residual, 1e-15);
    /* all values may move together: no solution unless the right side sums to zero */
    problem.apply = apply_free;
    apply_free(NULL, wanted, right);
    result = conjugate_solve(&problem, &room, x, right, 1e-12, 1000);
    for (int i = COUNT - 1; i >= 0; i--)
        x[i] += wanted[0] - x[0];
    check_near("conjugate gradients: singular with a solution", largest_difference(x, wanted, COUNT), 0, 1e-9);
    for (int i = 0; i < COUNT; i++)
        right[i] = 1;
    result = conjugate_solve(&problem, &room, x, right, 1e-12, 1000);
    check_true("conjugate gradients: singular without", result.ending == CONJUGATE_SINGULAR && result.iterations < COUNT);
    fill_solution(right, COUNT);
    result = conjugate_solve(&problem, &room, x, right, 1e-12, 3);
    check_true("conjugate gradients: limit", result.ending == CONJUGATE_LIMIT && result.iterations == 3);
    conjugate_close(&room);
}

/* --- not symmetric: diffusion of vectors that turn and are carried along --- */

enum { BLOCK = 2, UNKNOWNS = BLOCK * COUNT };

/* Nodes of the grid that are not farther apart than `reach` share a block; all are there with a reach of the grid. */
static void open_carried(struct sparse *matrix, int reach)
{
    int32_t blocks[COUNT] = {0};
    for (int i = 0; i < COUNT; i++)
        for (int j = 0; j < COUNT; j++)
            blocks[i] += abs(i % GRID - j % GRID) + abs(i / GRID - j / GRID) <= reach;
    sparse_open(matrix, COUNT, BLOCK, blocks);
    size_t k = 0;
    for (int i = 0; i < COUNT; i++)
        for (int j = 0; j < COUNT; j++) {
            if (abs(i % GRID - j % GRID) + abs(i / GRID - j / GRID) > reach)
                continue;
            const double spread = laplace(i, j, true), carried = i - j == 1 ? -0.7 : j - i == 1 ? 0.4 : 0, turn = i == j ? 0.5 : 0;
            matrix->column[k] = j;
            memcpy(matrix->value + 4 * k++, (const double[]){spread + carried, turn, -turn, 2 * spread + carried}, 4 * sizeof(double));
        }
}

struct carried {
    struct sparse matrix;
    struct incomplete factors;
};

static void apply_carried(void *context, const double *x, double *y)
{
    sparse_multiply(&((struct carried *)context)->matrix, x, y);
}

static void precondition_carried(void *context, const double *r, double *z)
{
    incomplete_solve(&((struct carried *)context)->factors, r, z);
}

static void keep(void *context, const double *r, double *z)
{
    (void)context;
    memcpy(z, r, UNKNOWNS * sizeof *z);
}

/* Factors that leave nothing out are those of elimination; rows left out are those of the unit matrix. */
static void test_incomplete(void)
{
    struct carried carried;
    double wanted[UNKNOWNS], x[UNKNOWNS];
    bool left_out[COUNT] = {false};
    open_carried(&carried.matrix, 2 * GRID);
    incomplete_open(&carried.factors, &carried.matrix);
    fill_solution(wanted, UNKNOWNS);
    check_true("pivots stay positive", incomplete_factor(&carried.factors, NULL));
    apply_carried(&carried, wanted, x);
    incomplete_solve(&carried.factors, x, x);
    check_near("with all blocks incomplete factors are complete", largest_difference(x, wanted, UNKNOWNS), 0, 1e-12);
    left_out[3] = left_out[40] = true;
    check_true("and without two rows", incomplete_factor(&carried.factors, left_out));
    wanted[6] = wanted[7] = wanted[80] = wanted[81] = 0;
    apply_carried(&carried, wanted, x);
    memcpy(x + 6, (const double[]){5, 6}, 2 * sizeof *x);
    memcpy(x + 80, (const double[]){7, 8}, 2 * sizeof *x);
    incomplete_solve(&carried.factors, x, x);
    check_true("rows that are left out keep their right side", x[6] == 5 && x[7] == 6 && x[80] == 7 && x[81] == 8);
    memcpy(x + 6, wanted + 6, 2 * sizeof *x);
    memcpy(x + 80, wanted + 80, 2 * sizeof *x);
    check_near("and have no part in the others", largest_difference(x, wanted, UNKNOWNS), 0, 1e-12);
    sparse_block(&carried.matrix, 5, 5)[0] = -1;
    check_true("a negative pivot is refused", !incomplete_factor(&carried.factors, NULL));
    incomplete_close(&carried.factors);
    sparse_close(&carried.matrix);
}

static void test_bicgstab(void)
{
    struct carried carried;
    struct bicgstab_room room = {0};
    double wanted[UNKNOWNS], right[UNKNOWNS], x[UNKNOWNS];
    long iterations[2];
    open_carried(&carried.matrix, 1);
    incomplete_open(&carried.factors, &carried.matrix);
    incomplete_factor(&carried.factors, NULL);
    fill_solution(wanted, UNKNOWNS);
    for (int run = 0; run < 2; run++) {
        const struct bicgstab_problem problem = {&carried, apply_carried, run == 0 ? keep : precondition_carried, UNKNOWNS};
        apply_carried(&carried, wanted, right);
        const double size = vector_length(right, UNKNOWNS);
        const struct bicgstab_result result = bicgstab_solve(&problem, &room, x, right, 1000);
        check_near("stabilised biconjugate gradients: solution", largest_difference(x, wanted, UNKNOWNS), 0, 1e-12);
        check_near("residual, to round-off", result.residual / size, 0, 1e-14);
        check_true("which is what is left of the right side", result.residual == vector_length(right, UNKNOWNS));
        iterations[run] = result.iterations;
    }
    check_true("incomplete factors make them fewer than half", 2 * iterations[1] < iterations[0]);
    const struct bicgstab_problem problem = {&carried, apply_carried, keep, UNKNOWNS};
    apply_carried(&carried, wanted, right);
    check_true("no more iterations than allowed", bicgstab_solve(&problem, &room, x, right, 3).iterations <= 3);
    memset(right, 0, sizeof right);
    const struct bicgstab_result nothing = bicgstab_solve(&problem, &room, x, right, 1000);
    check_true("a right side of zeros needs none", nothing.iterations == 0 && x[0] == 0);
    bicgstab_close(&room);
    incomplete_close(&carried.factors);
    sparse_close(&carried.matrix);
}

static void factor_laplace(struct envelope *envelope, bool held)
{
    int32_t first[COUNT];
    for (int i = 0; i < COUNT; i++)
        first[i] = i < GRID ? 0 : i - GRID;
    envelope_open(envelope, COUNT, first);
    for (int i = 0; i < COUNT; i++)
        for (int j = first[i]; j <= i; j++)
            *envelope_at(envelope, i, j) = laplace(i, j, held);
    envelope_factor(envelope);
}

static void test_envelope(void)
{
    struct envelope envelope = {0};
    double wanted[COUNT], x[COUNT];
    fill_solution(wanted, COUNT);
    factor_laplace(&envelope, true);
    apply_held(NULL, wanted, x);
    envelope_solve(&envelope, x);
    check_near("envelope: solution", largest_difference(x, wanted, COUNT), 0, 1e-11);
    factor_laplace(&envelope, false);
    apply_free(NULL, wanted, x);
    envelope_solve(&envelope, x);
    check_near("envelope: the last unknown of a singular system is held", x[COUNT - 1], 0, 0);
    for (int i = 0; i < COUNT; i++)
        x[i] += wanted[COUNT - 1];
    check_near("envelope: singular system", largest_difference(x, wanted, COUNT), 0, 1e-11);
    envelope_close(&envelope);
}

/* Eigenvalues of the chain matrix 2, -1: 2 - 2 cos(k pi / 7). */
static void test_symmetric(void)
{
    double m[6][6] = {{0}}, values[6], vectors[6][6], worst = 0, apart = 0;
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            m[i][j] = i == j ? 2 : abs(i - j) == 1 ? -1 : 0;
    symmetric_eigen(6, m, values, vectors);
    for (int k = 1; k <= 6; k++) {
        double nearest = 1;
        for (int i = 0; i < 6; i++)
            nearest = fmin(nearest, fabs(values[i] - (2 - 2 * cos(k * acos(-1) / 7))));
        worst = fmax(worst, nearest);
    }
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) {
            double sum = 0;
            for (int k = 0; k < 6; k++)
                sum += vectors[k][i] * vectors[k][j];
            apart = fmax(apart, fabs(sum - (i == j)));
        }
    check_near("eigenvalues", worst, 0, 1e-14);
    check_near("eigenvectors are orthonormal", apart, 0, 1e-14);
}

static void test_vectors(void)
{
    enum { LONG = 100001 };
    double *a = malloc(LONG * sizeof *a), *b = malloc(LONG * sizeof *b), exact = 0;
    for (int i = 0; i < LONG; i++) {
        a[i] = i % 7 - 3;
        b[i] = i % 5;
        exact += a[i] * b[i];
    }
    check_near("product of long vectors of whole numbers", vector_dot(a, b, LONG), exact, 0);
    vector_add(a, 2, b, LONG);
    vector_renew(b, a, -1, LONG);
    check_near("sums of long vectors", b[LONG - 1], (100000 % 7 - 3) + 100000 % 5, 0);
    free(a);
    free(b);
}

int main(void)
{
    test_vectors();
    test_conjugate();
    test_incomplete();
    test_bicgstab();
    test_envelope();
    test_symmetric();
    return check_result();
}
