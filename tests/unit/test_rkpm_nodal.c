/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integration at the nodes: cells, linear fields, derivatives of implicit gradients, the softest mode of a free square, rows
 * that are made anew, any number of threads. */
#include "base/memory.h"
#include "base/threads.h"
#include "check.h"
#include "diagonalise.h"
#include "most_threads.h"
#include "random.h"
#include "rkpm/cells.h"
#include "rkpm/nodal.h"
#include "rkpm/quadrature.h"
#include "rkpm/shape.h"

#include <string.h>

/* --- nodes: side^dimension of them 1/(side - 1) apart, each with its part of a unit box --- */

enum { MOST_NODES = 400 };

struct lattice {
    int dimension, side;
    size_t count;
    double room[3][MOST_NODES], *x[3], volume[MOST_NODES], moment_room[3][MOST_NODES], *moment[3];
};

/* Volumes of boxes that end at the boundary, and their second moments about the node: half of h^3/12 and half of the width there. */
static void set_lattice(struct lattice *lattice, int dimension, int side, double jitter)
{
    const double h = 1.0 / (side - 1);
    struct random random = {5};
    *lattice = (struct lattice){.dimension = dimension, .side = side, .count = 1};
    for (int a = 0; a < dimension; a++)
        lattice->count *= (size_t)side;
    for (size_t i = 0; i < lattice->count; i++) {
        size_t rest = i;
        lattice->volume[i] = 1;
        for (int a = 0; a < dimension; a++, rest /= (size_t)side) {
            const size_t place = rest % (size_t)side;
            const bool is_end = place == 0 || place + 1 == (size_t)side;
            lattice->room[a][i] = h * ((double)place + (is_end ? 0 : jitter * random_between(&random, -1, 1)));
            lattice->volume[i] *= is_end ? h / 2 : h;
        }
        for (int a = 0; a < dimension; a++)
            lattice->moment_room[a][i] = lattice->volume[i] * h * h / 12;
        /* half a box: (1/3) (h/2)^3 over its h/2, as much as (1/12) h^3 over h */
    }
    for (int a = 0; a < 3; a++) {
        lattice->x[a] = lattice->room[a];
        lattice->moment[a] = lattice->moment_room[a];
    }
}

static void open_rows_of(enum kernel_form kernel, struct nodal *nodal, const struct lattice *lattice, enum integration_form rule,
                         enum gradient_form gradient, double support)
{
    const double radius = support / (lattice->side - 1);
    const double *const moment[] = {lattice->moment[0], lattice->moment[1], lattice->moment[2]};
    rkpm_nodal_open(nodal, lattice->dimension, rule, gradient, lattice->count, lattice->x, lattice->volume, moment,
                    &(struct rkpm_support){kernel, {radius, radius, radius}}, true);
}

static void open_rows(struct nodal *nodal, const struct lattice *lattice, enum integration_form rule, enum gradient_form gradient, double support)
{
    open_rows_of(KERNEL_CUBIC, nodal, lattice, rule, gradient, support);
}

static struct node_box box_of(const struct lattice *lattice)
{
    struct node_box box = {.dimension = lattice->dimension, .numbers = {1, 1, 1}};
    for (int a = 0; a < lattice->dimension; a++) {
        box.numbers[a] = lattice->side;
        box.spacing[a] = 1.0 / (lattice->side - 1);
    }
    return box;
}

struct rule {
    const char *name;
    enum integration_form rule;
    enum gradient_form gradient;
};

static const struct rule rules[] = {{"dni", INTEGRATION_DNI, GRADIENT_DIRECT}, {"implicit dni", INTEGRATION_DNI, GRADIENT_IMPLICIT},
                                    {"snni", INTEGRATION_SNNI, GRADIENT_DIRECT}, {"nsni", INTEGRATION_NSNI, GRADIENT_IMPLICIT}};
enum { RULES = sizeof rules / sizeof rules[0] };

/* Those over cells. */
static const struct rule cell_rules[] = {{"scni", INTEGRATION_SCNI, GRADIENT_IMPLICIT}, {"nsni with scni", INTEGRATION_NSNI_SCNI, GRADIENT_IMPLICIT},
                                         {"mscni", INTEGRATION_MSCNI, GRADIENT_IMPLICIT}};
enum { CELL_RULES = sizeof cell_rules / sizeof cell_rules[0] };

/* --- linear fields --- */

/* What a row says to 1 (axis -1) or x_axis: along `along`. */
static double applied(const struct nodal *nodal, size_t node, int row, int along, int axis)
{
    const double *gradient = rkpm_nodal_gradient(nodal, node, row, along);
    const int32_t *neighbour = rkpm_nodal_neighbour(nodal, node);
    double sum = 0;
    for (int k = 0; k < nodal->neighbours[node]; k++)
        sum += gradient[k] * (axis < 0 ? 1 : nodal->x[axis][neighbour[k]]);
    return sum;
}

/* The largest error of the first rows, over the gradient 1, and of those that stabilise, over one per spacing. */
static void check_rows_of_linear(const char *rule, const struct nodal *nodal, int side)
{
    double worst = 0, value = 0;
    char name[100];
    for (size_t i = 0; i < nodal->count; i++) {
        double sum = -1;
        for (int row = 0; row < nodal->rows; row++)
            for (int along = 0; along < nodal->dimension && rkpm_nodal_weight(nodal, i, row) > 0; along++)
                for (int axis = -1; axis < nodal->dimension; axis++) {
                    const double error = applied(nodal, i, row, along, axis) - (row == 0 && along == axis);
                    worst = fmax(worst, fabs(error) * (row == 0 ? 1 : 1.0 / (side - 1)));
                }
        for (int k = 0; k < nodal->neighbours[i]; k++)
            sum += rkpm_nodal_value(nodal, i)[k];
        value = fmax(value, fabs(sum));
    }
    snprintf(name, sizeof name, "%s: gradients of linear fields, dimension %d", rule, nodal->dimension);
    check_near(name, worst, 0, 2e-12);
    check_near("values add up to 1", value, 0, 1e-13);
    check_true("no node has too few neighbours", nodal->enlarged == 0 && nodal->lowered == 0);
}

static void check_linear(const struct rule *rule, int dimension)
{
    struct lattice lattice;
    struct nodal nodal;
    set_lattice(&lattice, dimension, dimension == 3 ? 7 : dimension == 2 ? 11 : 21, 0.25);
    open_rows(&nodal, &lattice, rule->rule, rule->gradient, 2);
    check_rows_of_linear(rule->name, &nodal, lattice.side);
    rkpm_nodal_close(&nodal);
}

/* --- cells --- */

/* The divergence of x_a over a cell is its volume; the faces that lie on the box have the area of its faces. */
static void check_cells(int dimension, double jitter)
{
    struct lattice lattice;
    struct cells cells;
    double volume = 0, closed = 0, divergence = 0, outer = 0;
    set_lattice(&lattice, dimension, 7, jitter);
    const struct node_box box = box_of(&lattice);
    cells_open(&cells, &box, lattice.count, lattice.x);
    for (size_t i = 0; i < cells.count; i++) {
        double sum[3] = {0}, along[3] = {0};
        volume += cells.volume[i];
        for (size_t f = cells.first[i]; f < cells.first[i + 1]; f++)
            for (int a = 0; a < dimension; a++) {
                sum[a] += cells.face[f].area[a];
                along[a] += cells.face[f].area[a] * cells.face[f].middle[a];
                outer += cells.face[f].side != 0 && cells.face[f].axis == a ? cells.face[f].side * cells.face[f].area[a] : 0;
            }
        for (int a = 0; a < dimension; a++) {
            closed = fmax(closed, fabs(sum[a]));
            divergence = fmax(divergence, fabs(along[a] - cells.volume[i]));
        }
    }
    check_near("cells fill the box", volume, 1, 1e-13);
    check_near("they are closed", closed, 0, 1e-14);
    check_near("and have their volume by their faces too", divergence, 0, 1e-14);
    check_near("their faces cover those of the box", outer, 2 * dimension, 1e-13);
    for (size_t i = 0; i < cells.count && jitter == 0; i++) {
        closed = fmax(closed, fabs(cells.volume[i] - lattice.volume[i]));
        for (int a = 0; a < dimension; a++)
            closed = fmax(closed, fabs(cells.moment[a][i] - lattice.moment[a][i]));
    }
    check_near("cells of a lattice are boxes", closed, 0, 1e-14);
    cells_close(&cells);
}

/* Second moments of cells about their nodes, by the midpoints of fine squares that are nearest to the node. */
static void check_cell_moments(void)
{
    struct lattice lattice;
    struct cells cells;
    static double moment[2][MOST_NODES];
    enum { SQUARES = 600 };
    double worst = 0;
    set_lattice(&lattice, 2, 5, 0.3);
    const struct node_box box = box_of(&lattice);
    cells_open(&cells, &box, lattice.count, lattice.x);
    for (int j = 0; j < SQUARES; j++)
        for (int i = 0; i < SQUARES; i++) {
            const double x = (i + 0.5) / SQUARES, y = (j + 0.5) / SQUARES;
            size_t best = 0;
            for (size_t n = 1; n < lattice.count; n++)
                if (hypot(x - lattice.x[0][n], y - lattice.x[1][n]) < hypot(x - lattice.x[0][best], y - lattice.x[1][best]))
                    best = n;
            moment[0][best] += (x - lattice.x[0][best]) * (x - lattice.x[0][best]) / SQUARES / SQUARES;
            moment[1][best] += (y - lattice.x[1][best]) * (y - lattice.x[1][best]) / SQUARES / SQUARES;
        }
    for (size_t n = 0; n < lattice.count; n++)
        for (int a = 0; a < 2; a++)
            worst = fmax(worst, fabs(cells.moment[a][n] - moment[a][n]) / lattice.moment[a][12]); /* of a square, in the middle */
    check_near("second moments of cells, by counting squares", worst, 0, 1e-2);
    cells_close(&cells);
}

/* Gradients over cells; and what makes scni pass patch tests: a node's gradients, summed over the domain, are only those at its
 * boundary, which are 0 where the node doesn't reach it. */
static void check_cell_rows(const struct rule *rule, int dimension)
{
    struct lattice lattice;
    struct cells cells;
    struct nodal nodal;
    static double sum[3][MOST_NODES];
    double worst = 0;
    char name[100];
    set_lattice(&lattice, dimension, dimension == 3 ? 7 : 11, dimension == 2 ? 0.25 : 0);
    const struct node_box box = box_of(&lattice);
    const double radius = 2 * box.spacing[0];
    cells_open(&cells, &box, lattice.count, lattice.x);
    rkpm_nodal_open_cells(&nodal, rule->rule, &cells, lattice.x, &(struct rkpm_support){KERNEL_CUBIC, {radius, radius, radius}});
    check_rows_of_linear(rule->name, &nodal, lattice.side);
    memset(sum, 0, sizeof sum);
    for (size_t i = 0; i < nodal.count; i++)
        for (int a = 0; a < dimension; a++)
            for (int k = 0; k < nodal.neighbours[i]; k++)
                sum[a][rkpm_nodal_neighbour(&nodal, i)[k]] += rkpm_nodal_weight(&nodal, i, 0) * rkpm_nodal_gradient(&nodal, i, 0, a)[k];
    for (size_t i = 0; i < nodal.count; i++) {
        bool is_inside = true;
        for (int a = 0; a < dimension; a++)
            is_inside = is_inside && lattice.x[a][i] > radius && lattice.x[a][i] < 1 - radius;
        for (int a = 0; a < dimension && is_inside; a++)
            worst = fmax(worst, fabs(sum[a][i]));
    }
    snprintf(name, sizeof name, "%s: gradients inside add up to 0, dimension %d", rule->name, dimension);
    check_near(name, worst, 0, 1e-14);
    rkpm_nodal_close(&nodal);
    cells_close(&cells);
}

/* --- against shape functions at points --- */

/* The number of `node` in a row of shape functions; 0 where it is not in it. */
static double found(const struct shape_row *row, const double *numbers, int32_t node)
{
    for (int n = 0; n < row->count; n++)
        if (row->node[n] == node)
            return numbers[n];
    return 0;
}

static void check_against_points(enum kernel_form kernel, int dimension)
{
    struct lattice lattice;
    struct nodal rows[RULES];
    struct rkpm_shape shape;
    const size_t node = dimension == 1 ? 1 : dimension == 2 ? 14 : 60; /* beside the boundary; well inside */
    double direct = 0, implicit = 0, smooth = 0, second = 0;
    set_lattice(&lattice, dimension, dimension == 3 ? 6 : 11, 0.25);
    const double h = 1.0 / (lattice.side - 1), radius = 2 * h, step = 1e-5 * h;
    rkpm_shape_open(&shape, dimension, BASIS_LINEAR, lattice.count, lattice.x, &(struct rkpm_support){kernel, {radius, radius, radius}});
    for (int r = 0; r < RULES; r++)
        open_rows_of(kernel, &rows[r], &lattice, rules[r].rule, rules[r].gradient, 2);
    const double half = 0.5 * pow(lattice.volume[node], 1.0 / dimension);
    for (int a = 0; a < dimension; a++)
        for (int r = 0; r < RULES; r++)
            for (int k = 0; k < rows[r].neighbours[node]; k++) {
                const int32_t other = rkpm_nodal_neighbour(&rows[r], node)[k];
                double x[3] = {lattice.x[0][node], lattice.x[1][node], lattice.x[2][node]}, sides[2];
                const double first = rkpm_nodal_gradient(&rows[r], node, 0, a)[k];
                if (rules[r].rule == INTEGRATION_DNI) {
                    const struct shape_row *row = rkpm_shape_at(&shape, x, rules[r].gradient);
                    double *worst = rules[r].gradient == GRADIENT_DIRECT ? &direct : &implicit;
                    *worst = fmax(*worst, fabs(first - found(row, row->gradient[a], other)) * h);
                    continue;
                }
                for (int j = 0; j < dimension; j++) {
                    const bool is_snni = rules[r].rule == INTEGRATION_SNNI;
                    const double apart = is_snni ? half : step;
                    if (is_snni && j != a)
                        continue;
                    for (int s = 0; s < 2; s++) {
                        x[j] = lattice.x[j][node] + (s == 0 ? -apart : apart);
                        const struct shape_row *row = rkpm_shape_at(&shape, x, is_snni ? GRADIENT_NONE : GRADIENT_IMPLICIT);
                        sides[s] = found(row, is_snni ? row->value : row->gradient[a], other);
                        x[j] = lattice.x[j][node];
                    }
                    const double slope = (sides[1] - sides[0]) / (2 * apart);
                    if (is_snni)
                        smooth = fmax(smooth, fabs(first - slope) * h);
                    else
                        second = fmax(second, fabs(rkpm_nodal_gradient(&rows[r], node, 1 + j, a)[k] - slope) * h * h);
                }
            }
    check_near("dni has the gradients of shape functions", direct, 0, 1e-12);
    check_near("implicit dni too", implicit, 0, 1e-12);
    check_near("snni has differences over a box", smooth, 0, 1e-12);
    check_near("nsni has derivatives of implicit gradients, by differences", second, 0, 1e-8);
    for (int r = 0; r < RULES; r++)
        rkpm_nodal_close(&rows[r]);
    rkpm_shape_close(&shape);
}

/* --- the softest mode of a free square --- */

enum { UNKNOWNS = 242 };

struct stiffness {
    double poisson;
    double k[UNKNOWNS][UNKNOWNS];
};

/* w B^T D B of plane stress, Young's modulus 1. */
static void add_row(struct stiffness *stiffness, double weight, int n, const int32_t *node, const double *dx, const double *dy)
{
    const double nu = stiffness->poisson, direct = weight / (1 - nu * nu), cross = nu * direct, shear = weight / (2 * (1 + nu));
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            double *up = &stiffness->k[2 * node[i]][2 * node[j]], *down = &stiffness->k[2 * node[i] + 1][2 * node[j]];
            up[0] += direct * dx[i] * dx[j] + shear * dy[i] * dy[j];
            up[1] += cross * dx[i] * dy[j] + shear * dy[i] * dx[j];
            down[0] += cross * dy[i] * dx[j] + shear * dx[i] * dy[j];
            down[1] += direct * dy[i] * dy[j] + shear * dx[i] * dx[j];
        }
}

/* Smallest eigenvalue beyond the zero ones; and how many are zero. */
static double softest(struct stiffness *stiffness, int *zeros)
{
    double(*m)[UNKNOWNS] = stiffness->k;
    diagonalise(UNKNOWNS, UNKNOWNS, m[0]);
    double least = INFINITY;
    *zeros = 0;
    for (int i = 0; i < UNKNOWNS; i++)
        if (fabs(m[i][i]) < 1e-10)
            ++*zeros;
        else
            least = fmin(least, m[i][i]);
    return least;
}

struct gauss {
    struct stiffness *stiffness;
    struct rkpm_shape shape;
};

static void add_gauss(void *context, const struct quadrature_point *point)
{
    struct gauss *gauss = context;
    const struct shape_row *row = rkpm_shape_at(&gauss->shape, point->x, GRADIENT_DIRECT);
    add_row(gauss->stiffness, point->weight, row->count, row->node, row->gradient[0], row->gradient[1]);
}

static void check_softest_of(const char *rule, const struct nodal *nodal, struct stiffness *stiffness, double expected)
{
    char name[100];
    int zeros;
    memset(stiffness->k, 0, sizeof stiffness->k);
    for (size_t i = 0; i < nodal->count; i++)
        for (int row = 0; row < nodal->rows; row++)
            if (rkpm_nodal_weight(nodal, i, row) > 0)
                add_row(stiffness, rkpm_nodal_weight(nodal, i, row), nodal->neighbours[i], rkpm_nodal_neighbour(nodal, i),
                        rkpm_nodal_gradient(nodal, i, row, 0), rkpm_nodal_gradient(nodal, i, row, 1));
    const double least = softest(stiffness, &zeros);
    snprintf(name, sizeof name, "softest mode of a free square, %s", rule);
    if (!isnan(expected))
        check_near(name, least, expected, 5e-5);
    check_true("three modes without stiffness", zeros == 3);
}

/* Spec rkpm 3 lists the eigenvalues for Young's modulus 1, an independent prototype. */
static void check_softest(void)
{
    static struct stiffness stiffness;
    static const double expected[RULES] = {1.62e-2, NAN, 1.22e-2, 4.00e-2}, of_cells[CELL_RULES] = {1.16e-2, 3.88e-2, 3.86e-2};
    struct lattice lattice;
    int zeros;
    set_lattice(&lattice, 2, 11, 0);
    struct gauss gauss = {.stiffness = &stiffness};
    const struct node_box box = {2, {11, 11, 1}, {0}, {0.1, 0.1, 0}};
    stiffness.poisson = 0.3;
    rkpm_shape_open(&gauss.shape, 2, BASIS_LINEAR, lattice.count, lattice.x, &(struct rkpm_support){KERNEL_CUBIC, {0.2, 0.2, 0.2}});
    quadrature_inside(&box, 2, add_gauss, &gauss);
    rkpm_shape_close(&gauss.shape);
    check_near("softest mode of a free square, Gauss", softest(&stiffness, &zeros), 3.91e-2, 5e-5);
    check_true("three modes without stiffness, Gauss", zeros == 3);
    for (int r = 0; r < RULES; r++) {
        struct nodal nodal;
        open_rows(&nodal, &lattice, rules[r].rule, rules[r].gradient, 2);
        check_softest_of(rules[r].name, &nodal, &stiffness, expected[r]);
        rkpm_nodal_close(&nodal);
    }
    struct cells cells;
    cells_open(&cells, &box, lattice.count, lattice.x);
    for (int r = 0; r < CELL_RULES; r++) {
        struct nodal nodal;
        rkpm_nodal_open_cells(&nodal, cell_rules[r].rule, &cells, lattice.x, &(struct rkpm_support){KERNEL_CUBIC, {0.2, 0.2, 0.2}});
        check_softest_of(cell_rules[r].name, &nodal, &stiffness, of_cells[r]);
        rkpm_nodal_close(&nodal);
    }
    cells_close(&cells);
}

/* --- rows that are made anew --- */

static bool same_rows(const struct nodal *a, const struct nodal *b)
{
    bool same = a->count == b->count && a->rows == b->rows;
    for (size_t i = 0; i < a->count && same; i++) {
        const size_t n = (size_t)a->neighbours[i];
        same = a->neighbours[i] == b->neighbours[i] && memcmp(rkpm_nodal_neighbour(a, i), rkpm_nodal_neighbour(b, i), n * sizeof(int32_t)) == 0 &&
               memcmp(rkpm_nodal_value(a, i), rkpm_nodal_value(b, i), n * sizeof(double)) == 0;
        for (int row = 0; row < a->rows && same; row++)
            for (int axis = 0; axis < a->dimension && same; axis++)
                same = memcmp(rkpm_nodal_gradient(a, i, row, axis), rkpm_nodal_gradient(b, i, row, axis), n * sizeof(double)) == 0;
    }
    return same;
}

static void check_renewal(const struct rule *rule, int dimension)
{
    struct lattice lattice;
    struct nodal moved, fresh;
    const int threads = threads_available();
    bool same = true;
    char name[100];
    set_lattice(&lattice, dimension, dimension == 3 ? 7 : 20, 0.1);
    open_rows(&moved, &lattice, rule->rule, rule->gradient, 2.5);
    struct random random = {9};
    for (int step = 0; step < 3; step++) {
        for (size_t i = 0; i < lattice.count; i++)
            for (int a = 0; a < dimension; a++)
                lattice.x[a][i] = 0.9 * lattice.x[a][i] + 0.005 * random_between(&random, -1, 1);
        rkpm_nodal_renew(&moved);
        threads_set(step == 0 ? 1 : step == 1 ? 2 : 5);
        open_rows(&fresh, &lattice, rule->rule, rule->gradient, 2.5);
        same = same && same_rows(&moved, &fresh);
        rkpm_nodal_close(&fresh);
        threads_set(threads);
    }
    snprintf(name, sizeof name, "%s: rows made anew, on 1, 2 and 5 threads, dimension %d", rule->name, dimension);
    check_true(name, same);
    rkpm_nodal_close(&moved);
}

/* --- too few neighbours (2.4) --- */

static void check_degradation(void)
{
    struct lattice lattice;
    struct nodal nodal;
    set_lattice(&lattice, 2, 5, 0);
    lattice.x[0][0] = lattice.x[1][0] = -0.3; /* 0.55 from its neighbours along each axis */
    open_rows(&nodal, &lattice, INTEGRATION_DNI, GRADIENT_DIRECT, 1.5);
    check_true("supports grow where nodes are too few", nodal.enlarged == 1 && nodal.lowered == 0 && nodal.reach[0] > 1.2);
    double worst = 0;
    for (int along = 0; along < 2; along++)
        for (int axis = -1; axis < 2; axis++)
            worst = fmax(worst, fabs(applied(&nodal, 0, 0, along, axis) - (along == axis)));
    check_near("and linear fields keep their gradients", worst, 0, 1e-12);
    nodal.grows = false;
    rkpm_nodal_renew(&nodal);
    check_true("supports that don't grow: the order is lowered", nodal.enlarged == 0 && nodal.lowered == 1 && nodal.is_lowered[0]);
    check_true("Shepard's value of a node alone, no gradient", nodal.neighbours[0] == 1 && rkpm_nodal_value(&nodal, 0)[0] == 1 &&
                                                                   rkpm_nodal_gradient(&nodal, 0, 0, 0)[0] == 0);
    rkpm_nodal_close(&nodal);
}

int main(void)
{
    begin_with_threads(5);
    for (int r = 0; r < RULES; r++)
        for (int dimension = 1; dimension <= 3; dimension++) {
            check_linear(&rules[r], dimension);
            check_renewal(&rules[r], dimension);
        }
    for (int dimension = 1; dimension <= 3; dimension++) {
        for (int kernel = KERNEL_CUBIC; kernel <= KERNEL_EXPONENTIAL; kernel++)
            check_against_points((enum kernel_form)kernel, dimension);
        check_cells(dimension, 0);
        for (int r = 0; r < CELL_RULES; r++)
            if (dimension == 2 || cell_rules[r].rule != INTEGRATION_MSCNI)
                check_cell_rows(&cell_rules[r], dimension);
    }
    check_cells(2, 0.3);
    check_cell_moments();
    check_softest();
    check_degradation();
    return check_result();
}
