/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rkpm/quadrature.h"

#include <math.h>

/* P_n(x) and its derivative, by Bonnet's recursion. */
static double legendre(int n, double x, double *slope)
{
    double before = 1, value = x;
    for (int k = 2; k <= n; k++) {
        const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
        before = value;
        value = next;
    }
    *slope = n * (x * value - before) / (x * x - 1);
    return value;
}

/* Zeros of P_n by Newton's method from nearby, which converges to the last digits. */
void quadrature_rule(int n, double place[QUADRATURE_MOST], double weight[QUADRATURE_MOST])
{
    const double pi = acos(-1);
    for (int i = 0; i < n; i++) {
        double x = -cos(pi * (i + 0.75) / (n + 0.5)), slope = 1;
        for (int k = 0; k < 50 && n > 1; k++) {
            const double step = legendre(n, x, &slope) / slope;
            x -= step;
            if (fabs(step) < 1e-16)
                break;
        }
        place[i] = n == 1 || 2 * i + 1 == n ? 0 : x;
        legendre(n, place[i], &slope);
        weight[i] = 2 / ((1 - place[i] * place[i]) * slope * slope);
    }
}

/* Who is shown the points, and the rule that makes them along an axis. */
struct visitor {
    quadrature_visit *visit;
    void *context;
    int n;
    double place[QUADRATURE_MOST], weight[QUADRATURE_MOST];
};

/* All points of one cell along the axes that `along` names. */
static void visit_cell(const struct node_box *box, const int *along, int axes, struct quadrature_point *point, const struct visitor *visitor)
{
    const int n = visitor->n;
    int points = 1;
    for (int i = 0; i < axes; i++)
        points *= n;
    for (int p = 0; p < points; p++) {
        point->weight = 1;
        for (int i = 0, rest = p; i < axes; i++, rest /= n) {
            const int a = along[i];
            point->x[a] = box->low[a] + box->spacing[a] * ((double)point->cell[a] + 0.5 + 0.5 * visitor->place[rest % n]);
            point->weight *= 0.5 * box->spacing[a] * visitor->weight[rest % n];
        }
        visitor->visit(visitor->context, point);
    }
}

/* All cells along some axes; the point's cell along others is given. */
static void visit_cells(const struct node_box *box, const int *along, int axes, struct quadrature_point *point, const struct visitor *visitor)
{
    long cells = 1;
    for (int i = 0; i < axes; i++)
        cells *= box->numbers[along[i]] - 1;
    for (long c = 0; c < cells; c++) {
        long rest = c;
        for (int i = 0; i < axes; i++) {
            point->cell[along[i]] = rest % (box->numbers[along[i]] - 1);
            rest /= box->numbers[along[i]] - 1;
        }
        visit_cell(box, along, axes, point, visitor);
    }
}

void quadrature_inside(const struct node_box *box, int n, quadrature_visit *visit, void *context)
{
    static const int along[] = {0, 1, 2};
    struct visitor visitor = {.visit = visit, .context = context, .n = n};
    struct quadrature_point point = {.side = 0};
    quadrature_rule(n, visitor.place, visitor.weight);
    visit_cells(box, along, box->dimension, &point, &visitor);
}

void quadrature_faces(const struct node_box *box, int n, quadrature_visit *visit, void *context)
{
    struct visitor visitor = {.visit = visit, .context = context, .n = n};
    quadrature_rule(n, visitor.place, visitor.weight);
    for (int axis = 0; axis < box->dimension; axis++)
        for (int side = -1; side <= 1; side += 2) {
            struct quadrature_point point = {.axis = axis, .side = side};
            int along[2] = {0}, axes = 0;
            for (int a = 0; a < box->dimension; a++)
                if (a != axis)
                    along[axes++] = a;
            point.cell[axis] = side < 0 ? 0 : box->numbers[axis] - 2;
            point.x[axis] = box->low[axis] + (side < 0 ? 0 : box->spacing[axis] * (double)(box->numbers[axis] - 1));
            visit_cells(box, along, axes, &point, &visitor);
        }
}
