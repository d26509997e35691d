/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Problems of RKPM and what they are made of: quadrature, exact solutions, banded systems; patch tests, both orders of axes,
 * values at the boundary, one level after another. */
#include "base/banded.h"
#include "base/memory.h"
#include "random.h"
#include "rkpm_fixture.h"

/* --- quadrature: n points integrate polynomials of degree 2 n - 1 --- */

static void check_quadrature(void)
{
    double worst = 0;
    for (int n = 1; n <= QUADRATURE_MOST; n++) {
        double place[QUADRATURE_MOST], weight[QUADRATURE_MOST];
        quadrature_rule(n, place, weight);
        for (int degree = 0; degree < 2 * n; degree++) {
            double sum = degree % 2 == 0 ? -2.0 / (degree + 1) : 0;
            for (int i = 0; i < n; i++)
                sum += weight[i] * pow(place[i], degree);
            worst = fmax(worst, fabs(sum));
        }
    }
    check_near("n Gauss points integrate degree 2 n - 1, n from 1 to 10", worst, 0, 1e-14);
}

/* x y z^2 over the faces of the box 0 ... 1, 0 ... 2, 0 ... 3: by hand. */
struct face_sum {
    double area, integral, outward[3];
};

static void add_face(void *context, const struct quadrature_point *point)
{
    struct face_sum *sum = context;
    sum->area += point->weight;
    sum->integral += point->weight * point->x[0] * point->x[1] * point->x[2] * point->x[2];
    sum->outward[point->axis] += point->side * point->weight * point->x[point->axis];
}

static void check_faces(void)
{
    const struct node_box box = {3, {3, 4, 5}, {0, 0, 0}, {0.5, 2.0 / 3, 0.75}};
    struct face_sum sum = {0};
    quadrature_faces(&box, 2, add_face, &sum);
    check_near("area of the faces", sum.area, 2 * (2 + 3 + 6), 1e-12);
    check_near("x y z^2 over the faces", sum.integral, 1 * 2 * 9 + 2 * 0.5 * 9 + 9 * 0.5 * 2, 1e-12);
    for (int a = 0; a < 3; a++)
        check_near("normals look outwards: volume by faces", sum.outward[a], 6, 1e-12);
}

/* --- exact solutions: derivatives by differences --- */

static void check_field(enum rkpm_function function, int dimension)
{
    const struct field field = {function, dimension, 1.3, {-0.2, 1.1}};
    const double x[3] = {0.37, 0.81, -0.44}, step = 1e-4;
    double gradient[3], laplacian = 0, worst = 0;
    field_gradient(&field, x, gradient);
    for (int a = 0; a < dimension; a++) {
        double after[3] = {x[0], x[1], x[2]}, before[3] = {x[0], x[1], x[2]};
        after[a] += step;
        before[a] -= step;
        const double up = field_value(&field, after), middle = field_value(&field, x), down = field_value(&field, before);
        worst = fmax(worst, fabs((up - down) / (2 * step) - gradient[a]));
        laplacian += (up - 2 * middle + down) / (step * step);
    }
    check_near("gradient of an exact solution", worst, 0, 1e-7);
    check_near("its div grad", field_laplacian(&field, x), laplacian, 1e-6);
}

/* --- banded systems: A x = b with random A that needs exchanges --- */

static void check_banded(size_t count, size_t width)
{
    struct random random = {count};
    struct banded banded;
    double *matrix = memory_array(count * count, sizeof *matrix, "a test"), *right = memory_array(count, sizeof *right, "a test");
    double *x = memory_array(count, sizeof *x, "a test"), worst = 0;
    banded_open(&banded, count, width);
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < count; j++)
            if (i != j && (i > j ? i - j : j - i) <= width) /* nothing on the diagonal */
                *banded_at(&banded, i, j) = matrix[i * count + j] = random_between(&random, -1, 1);
    for (size_t i = 0; i < count; i++)
        right[i] = x[i] = random_between(&random, -1, 1);
    check_true("a banded system is factored", banded_factor(&banded));
    banded_solve(&banded, x);
    for (size_t i = 0; i < count; i++) {
        double rest = -right[i];
        for (size_t j = 0; j < count; j++)
            rest += matrix[i * count + j] * x[j];
        worst = fmax(worst, fabs(rest));
    }
    check_near("and solved", worst, 0, 1e-10);
    banded_close(&banded);
    banded_open(&banded, count, width);
    check_true("a matrix of zeros is singular", !banded_factor(&banded));
    banded_close(&banded);
    memory_free(matrix);
    memory_free(right);
    memory_free(x);
}

/* --- problems --- */

/* On a uniform grid shape functions of a bilinear basis are zero on faces that their node is not on, so that all methods pass
 * the patch test (spec rkpm 9, no. 10); in one dimension so does the linear basis. */
static void check_patches(void)
{
    static const char *const constraints[] = {"tran", "lagr", "nits"};
    for (size_t i = 0; i < sizeof constraints / sizeof constraints[0]; i++) {
        char block[200];
        snprintf(block, sizeof block, "dime 2 node box 0 1 0 2 6 5 basi bilinear supp 1.75 prob poisson func line cons %s", constraints[i]);
        check_near("patch test, bilinear", result_of(block).h1, 0, 1e-12);
        snprintf(block, sizeof block, "dime 1 node box 0 2 9 supp 1.75 prob poisson func line cons %s", constraints[i]);
        check_near("patch test in one dimension", result_of(block).h1, 0, 1e-12);
    }
}

/* The same problem with x and y exchanged: other unknowns and bands, the same errors. */
static void check_axes(void)
{
    static const char *const rest[] = {"supp 1.75 prob poisson func expo cons lagr", "supp 1.75 prob poisson func expo cons nits",
                                       "supp 2.5 basi quad prob helmholtz wave 3 func sine cons tran"};
    for (size_t i = 0; i < sizeof rest / sizeof rest[0]; i++) {
        char block[200];
        snprintf(block, sizeof block, "dime 2 node box 0 1 0 2 5 11 %s", rest[i]);
        const struct rkpm_result along = result_of(block);
        snprintf(block, sizeof block, "dime 2 node box 0 2 0 1 11 5 %s", rest[i]);
        const struct rkpm_result across = result_of(block);
        check_near("x and y exchanged: the same error", across.l2 / along.l2, 1, 1e-8);
        check_near("and of the gradient", across.h1 / along.h1, 1, 1e-8);
    }
}

/* With boundary values held by transformation the solution has them at boundary nodes. */
static void check_boundary(void)
{
    struct problem problem;
    open_problem(&problem, "dime 3 node box 0 1 0 1 0 1 4 5 6 supp 1.75 prob poisson func expo cons tran");
    solve_problem(&problem);
    const struct store *store = problem.rkpm->store;
    double worst = 0;
    for (size_t n = 0; n < store->count; n++)
        if (box_is_boundary(&problem.rkpm->levels[0].box, n))
            worst = fmax(worst, fabs(store->real[COLUMN_FIELD][0][n] - store->real[COLUMN_EXACT][0][n]));
    check_near("boundary nodes have the values given", worst, 0, 1e-12);
    close_problem(&problem);
}

/* A level has the result that it has alone, and rates are those between levels. */
static void check_levels(void)
{
    struct problem problem;
    open_problem(&problem, "dime 1 node box 0 1 6 refi 11 21 supp 2 prob poisson func sine cons nits grad implicit");
    solve_problem(&problem);
    const struct rkpm_level *levels = problem.rkpm->levels;
    const struct rkpm_result alone = result_of("dime 1 node box 0 1 21 supp 2 prob poisson func sine cons nits grad implicit");
    check_near("a level is what it is alone", levels[1].result.l2, alone.l2, 0);
    check_near("order", levels[1].result.l2_rate, log2(levels[0].result.l2 / levels[1].result.l2), 1e-12);
    check_true("numbers of nodes", levels[0].count == 11 && levels[1].count == 21 && problem.rkpm->store->count == 21);
    close_problem(&problem);
}

/* A beta that can't hold the boundary against the other terms of Nitsche's method. */
static void check_weak(void)
{
    struct problem problem = {.diagnostics = diagnostics_open()};
    static const char deck[] = "mpm3d test\nmeth rkpm\nrkpm\ndime 1 node box 0 1 11 supp 2 prob poisson func sine cons nits beta 1e-3\nends\nendi\n";
    problem.text = text_open(problem.diagnostics);
    text_include_memory(problem.text, "test", deck, sizeof deck - 1);
    problem.scene = reader_read(problem.text, problem.diagnostics);
    timers_start(&problem.timers);
    problem.rkpm = rkpm_open(problem.scene, &problem.timers);
    const struct instability instability = rkpm_advance(problem.rkpm);
    check_true("a beta that is too small stops the run", instability.is_stopped && strstr(instability.cause, "not positive"));
    close_problem(&problem);
}

int main(void)
{
    check_quadrature();
    check_faces();
    for (int function = FUNCTION_SINE; function <= FUNCTION_LINEAR; function++)
        for (int dimension = 1; dimension <= 3; dimension++)
            check_field((enum rkpm_function)function, dimension);
    check_banded(40, 3);
    check_banded(57, 12);
    check_patches();
    check_axes();
    check_boundary();
    check_levels();
    check_weak();
    return check_result();
}
