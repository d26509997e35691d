/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shape functions of RKPM: values against hand-made ones, reproduction, too few nodes, the search for nodes. */
#include "base/memory.h"
#include "check.h"
#include "random.h"
#include "rkpm/shape.h"

/* --- nodes --- */

struct cloud {
    int dimension;
    size_t count;
    double *x[3];
};

static struct cloud open_cloud(int dimension, size_t count)
{
    struct cloud cloud = {.dimension = dimension, .count = count};
    for (int a = 0; a < 3; a++)
        cloud.x[a] = memory_array(count, sizeof(double), "nodes of a test");
    return cloud;
}

static void close_cloud(struct cloud *cloud)
{
    for (int a = 0; a < 3; a++)
        memory_free(cloud->x[a]);
}

/* side^dimension nodes at 0, 1, 2, ..., each moved at random up to `jitter`. */
static struct cloud lattice(int dimension, int side, double jitter)
{
    size_t count = 1;
    for (int a = 0; a < dimension; a++)
        count *= (size_t)side;
    struct cloud cloud = open_cloud(dimension, count);
    struct random random = {7};
    for (size_t i = 0; i < count; i++) {
        size_t rest = i;
        for (int a = 0; a < dimension; a++, rest /= (size_t)side)
            cloud.x[a][i] = (double)(rest % (size_t)side) + jitter * random_between(&random, -1, 1);
    }
    return cloud;
}

static struct rkpm_shape shape_of(const struct cloud *cloud, enum kernel_form kernel, enum basis_form form, double radius)
{
    struct rkpm_shape shape;
    rkpm_shape_open(&shape, cloud->dimension, form, cloud->count, cloud->x, &(struct rkpm_support){kernel, {radius, radius, radius}});
    return shape;
}

/* Value (axis -1) or derivative of node's shape function in a row; 0 where it is not in it. */
static double in_row(const struct rkpm_shape *shape, int32_t node, int axis)
{
    for (int n = 0; n < shape->row.count; n++)
        if (shape->row.node[n] == node)
            return axis < 0 ? shape->row.value[n] : shape->row.gradient[axis][n];
    return 0;
}

/* --- S1 to S4: hand-made rows of nodes at 0, 1, ... 10 --- */

struct expected_row {
    const char *name;
    enum kernel_form kernel;
    enum basis_form form;
    enum gradient_form gradient; /* NONE: values */
    double support, x, tolerance;
    int first, count;
    double numbers[4];
};

static void check_rows(void)
{
    /* S1: the kernels themselves, whose sum and first moment are right there; S2 to S4: spec rkpm 11.1, an independent prototype; the
     * other kernels: moments in closed form, derivatives by differences, by a program of its own. */
    static const struct expected_row rows[] = {
        {"S1 linear, a = 2", KERNEL_CUBIC, BASIS_LINEAR, GRADIENT_NONE, 2, 5.25, 1e-12, 4, 4, {27 / 384.0, 235 / 384.0, 121 / 384.0, 1 / 384.0}},
        {"S2 beside the boundary", KERNEL_CUBIC, BASIS_LINEAR, GRADIENT_NONE, 2, 0.5, 1e-9, 0, 3, {0.5178571429, 0.4642857143, 0.0178571429}},
        {"S3 linear, a = 2.5", KERNEL_CUBIC, BASIS_LINEAR, GRADIENT_NONE, 2.5, 0.3, 1e-8, 0, 3, {0.70668547, 0.28662907, 0.00668547}},
        {"S3 derivatives", KERNEL_CUBIC, BASIS_LINEAR, GRADIENT_DIRECT, 2.5, 0.3, 1e-8, 0, 3, {-0.86259937, 0.72519874, 0.13740063}},
        {"S4 quadratic, a = 3", KERNEL_CUBIC, BASIS_QUADRATIC, GRADIENT_NONE, 3, 0.3, 1e-7, 0, 4, {0.60089028, 0.49232916, -0.08732916, -0.00589028}},
        {"S4 derivatives", KERNEL_CUBIC, BASIS_QUADRATIC, GRADIENT_DIRECT, 3, 0.3, 1e-7, 0, 4, {-1.13934923, 1.21804768, -0.01804768, -0.06065077}},
        {"S4 implicit derivatives", KERNEL_CUBIC, BASIS_QUADRATIC, GRADIENT_IMPLICIT, 3, 0.3, 1e-7, 0, 4, {-1.1814228, 1.3442684, -0.1442684, -0.0185772}},
        {"quintic", KERNEL_QUINTIC, BASIS_LINEAR, GRADIENT_NONE, 2.5, 0.3, 1e-11, 0, 3, {0.704045802018, 0.291908395964, 0.004045802018}},
        {"quintic, derivatives", KERNEL_QUINTIC, BASIS_LINEAR, GRADIENT_DIRECT, 2.5, 0.3, 2e-6, 0, 3, {-0.952594, 0.905188, 0.047406}},
        {"exponential", KERNEL_EXPONENTIAL, BASIS_LINEAR, GRADIENT_NONE, 2.5, 0.3, 1e-11, 0, 3, {0.708176695528, 0.283646608943, 0.008176695528}},
        {"exponential, derivatives", KERNEL_EXPONENTIAL, BASIS_LINEAR, GRADIENT_DIRECT, 2.5, 0.3, 2e-6, 0, 3, {-0.8806715, 0.761343, 0.1193285}}};
    struct cloud cloud = lattice(1, 11, 0);
    for (size_t r = 0; r < sizeof rows / sizeof rows[0]; r++) {
        const struct expected_row *row = &rows[r];
        struct rkpm_shape shape = shape_of(&cloud, row->kernel, row->form, row->support);
        rkpm_shape_at(&shape, (const double[3]){row->x, 0, 0}, row->gradient);
        for (int i = 0; i < row->count; i++)
            check_near(row->name, in_row(&shape, row->first + i, row->gradient == GRADIENT_NONE ? -1 : 0), row->numbers[i], row->tolerance);
        check_true("no other node", shape.row.count == row->count);
        rkpm_shape_close(&shape);
    }
    close_cloud(&cloud);
}

/* --- S5: monomials and their derivatives --- */

static double monomial(const int exponent[3], const double x[3])
{
    return pow(x[0], exponent[0]) * pow(x[1], exponent[1]) * pow(x[2], exponent[2]);
}

static double monomial_slope(const int exponent[3], const double x[3], int axis)
{
    const int lower[3] = {exponent[0] - (axis == 0), exponent[1] - (axis == 1), exponent[2] - (axis == 2)};
    return exponent[axis] == 0 ? 0 : exponent[axis] * monomial(lower, x);
}

/* The largest error in the values and derivatives of the monomials of the basis at a point, over their size. */
static double reproduction_error(struct rkpm_shape *shape, const struct cloud *cloud, const double point[3], enum gradient_form gradient)
{
    const struct basis *basis = &shape->basis[shape->top];
    const struct shape_row *row = rkpm_shape_at(shape, point, gradient);
    double worst = 0;
    for (int m = 0; m < basis->count; m++) {
        const int *exponent = basis->exponent[m];
        double sum = -monomial(exponent, point), size = 1;
        double slope[3] = {-monomial_slope(exponent, point, 0), -monomial_slope(exponent, point, 1), -monomial_slope(exponent, point, 2)};
        for (int n = 0; n < row->count; n++) {
            const double node[3] = {cloud->x[0][row->node[n]], cloud->x[1][row->node[n]], cloud->x[2][row->node[n]]};
            const double value = monomial(exponent, node);
            sum += row->value[n] * value;
            for (int a = 0; a < cloud->dimension; a++)
                slope[a] += row->gradient[a][n] * value;
            size = fmax(size, fabs(value));
        }
        worst = fmax(worst, fabs(sum) / size);
        for (int a = 0; a < cloud->dimension; a++)
            worst = fmax(worst, fabs(slope[a]) / size);
    }
    return worst;
}

static void check_reproduction(int dimension, enum kernel_form kernel, enum basis_form form, double radius, double jitter, int points)
{
    char name[100];
    double worst[2] = {0};
    const int side = dimension == 3 ? 7 : 11;
    struct cloud cloud = lattice(dimension, side, jitter);
    struct rkpm_shape shape = shape_of(&cloud, kernel, form, radius);
    struct random random = {3};
    for (int i = 0; i < points; i++) {
        double point[3] = {0};
        for (int a = 0; a < dimension; a++)
            point[a] = dimension == 1 ? (side - 1) * (double)i / (points - 1) : random_between(&random, 0, side - 1);
        worst[0] = fmax(worst[0], reproduction_error(&shape, &cloud, point, GRADIENT_DIRECT));
        worst[1] = fmax(worst[1], reproduction_error(&shape, &cloud, point, GRADIENT_IMPLICIT));
    }
    snprintf(name, sizeof name, "S5 reproduction, dimension %d, kernel %d, form %d, support %g, jitter %g", dimension, (int)kernel, (int)form, radius, jitter);
    check_near(name, worst[0], 0, 1e-12);
    snprintf(name, sizeof name, "S5 the same with implicit gradients, dimension %d, kernel %d, form %d", dimension, (int)kernel, (int)form);
    check_near(name, worst[1], 0, 1e-12);
    check_true("no point has too few nodes", shape.enlarged == 0 && shape.lowered == 0);
    rkpm_shape_close(&shape);
    close_cloud(&cloud);
}

/* Direct gradients are those of the values. */
static void check_differences(enum kernel_form kernel)
{
    struct cloud cloud = lattice(2, 9, 0.2);
    struct rkpm_shape shape = shape_of(&cloud, kernel, BASIS_QUADRATIC, 3);
    const double step = 1e-5, middle[3] = {3.3, 4.6, 0};
    for (int a = 0; a < 2; a++) {
        double difference = 0, after[81], before[81];
        double *const sides[] = {after, before};
        for (int s = 0; s < 2; s++) {
            double point[3] = {middle[0], middle[1], 0};
            point[a] += s == 0 ? step : -step;
            rkpm_shape_at(&shape, point, GRADIENT_NONE);
            for (int i = 0; i < 81; i++)
                sides[s][i] = in_row(&shape, i, -1);
        }
        rkpm_shape_at(&shape, middle, GRADIENT_DIRECT);
        for (int i = 0; i < 81; i++)
            difference = fmax(difference, fabs((after[i] - before[i]) / (2 * step) - in_row(&shape, i, a)));
        check_near("direct gradient, by differences", difference, 0, 1e-8);
    }
    rkpm_shape_close(&shape);
    close_cloud(&cloud);
}

/* --- too few nodes (2.4) --- */

static void check_degradation(void)
{
    struct cloud cloud = lattice(2, 9, 0);
    struct rkpm_shape shape = shape_of(&cloud, KERNEL_CUBIC, BASIS_QUADRATIC, 2);
    rkpm_shape_at(&shape, (const double[3]){0}, GRADIENT_DIRECT);
    check_true("quadratic with a = 2 is singular at a corner: the support is enlarged once",
               shape.enlarged == 1 && shape.lowered == 0 && shape.row.reach == 1.2 && shape.row.order == 2);
    check_near("and what is reproduced stays", reproduction_error(&shape, &cloud, (const double[3]){0}, GRADIENT_DIRECT), 0, 1e-12);
    rkpm_shape_close(&shape);
    shape = shape_of(&cloud, KERNEL_CUBIC, BASIS_QUADRATIC, 1.1);
    rkpm_shape_at(&shape, (const double[3]){0}, GRADIENT_DIRECT);
    check_true("with a = 1.1 three enlargements are not enough: order 1", shape.lowered == 1 && shape.row.order == 1);
    rkpm_shape_close(&shape);
    shape = shape_of(&cloud, KERNEL_CUBIC, BASIS_LINEAR, 0.5);
    rkpm_shape_at(&shape, (const double[3]){0.1, 0, 0}, GRADIENT_DIRECT);
    check_true("with a = 0.5 order 0, without gradient",
               shape.row.order == 0 && shape.row.count == 1 && shape.row.value[0] == 1 && shape.row.gradient[0][0] == 0);
    rkpm_shape_at(&shape, (const double[3]){-50, 3, 0}, GRADIENT_DIRECT);
    check_true("far away no node", shape.row.order == -1 && shape.row.count == 0);
    rkpm_shape_close(&shape);
    close_cloud(&cloud);
}

/* --- the search (2.5) --- */

static bool same_nodes(struct rkpm_shape *shape, const struct cloud *cloud, const double point[3], double radius)
{
    bool good = true;
    for (size_t i = 0; i < cloud->count; i++) {
        double kernel = 1;
        for (int a = 0; a < cloud->dimension; a++)
            kernel *= rkpm_kernel(KERNEL_CUBIC, fabs(point[a] - cloud->x[a][i]) / (radius * shape->row.reach));
        int found = 0;
        for (int n = 0; n < shape->row.count; n++)
            found += shape->row.node[n] == (int32_t)i;
        good = good && found == (kernel > 1e-14);
    }
    return good;
}

static void check_search(int dimension)
{
    char name[60];
    bool good = true;
    struct cloud cloud = open_cloud(dimension, 500);
    const double radius = dimension == 3 ? 0.3 : 0.2;
    struct random random = {11};
    for (size_t i = 0; i < cloud.count; i++)
        for (int a = 0; a < dimension; a++)
            cloud.x[a][i] = random_between(&random, 0, 1);
    struct rkpm_shape shape = shape_of(&cloud, KERNEL_CUBIC, BASIS_LINEAR, radius);
    for (int i = 0; i < 500; i++) {
        double point[3] = {0};
        for (int a = 0; a < dimension; a++)
            point[a] = random_between(&random, 0, 1);
        rkpm_shape_at(&shape, point, GRADIENT_NONE);
        good = good && same_nodes(&shape, &cloud, point, radius);
    }
    snprintf(name, sizeof name, "nodes near 500 random points, dimension %d", dimension);
    check_true(name, good);
    rkpm_shape_close(&shape);
    close_cloud(&cloud);
}

int main(void)
{
    check_rows();
    check_reproduction(1, KERNEL_CUBIC, BASIS_LINEAR, 2.5, 0, 1001);
    check_reproduction(1, KERNEL_CUBIC, BASIS_QUADRATIC, 3, 0, 1001);
    check_reproduction(2, KERNEL_CUBIC, BASIS_LINEAR, 2, 0.2, 300);
    check_reproduction(2, KERNEL_CUBIC, BASIS_BILINEAR, 2.5, 0.2, 300);
    check_reproduction(2, KERNEL_CUBIC, BASIS_QUADRATIC, 3, 0.2, 300);
    check_reproduction(3, KERNEL_CUBIC, BASIS_LINEAR, 2, 0.1, 100);
    check_reproduction(3, KERNEL_CUBIC, BASIS_BILINEAR, 2.5, 0.1, 100);
    check_reproduction(3, KERNEL_CUBIC, BASIS_QUADRATIC, 3, 0.1, 100);
    check_reproduction(1, KERNEL_QUINTIC, BASIS_QUADRATIC, 3, 0, 1001);
    check_reproduction(2, KERNEL_EXPONENTIAL, BASIS_LINEAR, 2, 0.2, 300);
    check_reproduction(3, KERNEL_QUINTIC, BASIS_LINEAR, 2.5, 0.1, 100);
    for (int kernel = KERNEL_CUBIC; kernel <= KERNEL_EXPONENTIAL; kernel++)
        check_differences((enum kernel_form)kernel);
    check_degradation();
    for (int dimension = 1; dimension <= 3; dimension++)
        check_search(dimension);
    return check_result();
}
