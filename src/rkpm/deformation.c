/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rkpm/deformation.h"

#include <string.h>

/* One row a function: with the gradient, from which tractions follow, or with tractions. */
struct deformation_row {
    void (*value)(const struct deformation *deformation, const double x[3], double u[3]);
    void (*gradient)(const struct deformation *deformation, const double x[3], double gradient[3][3]);
    void (*traction)(const struct deformation *deformation, const double x[3], int axis, int side, double traction[3]);
};

/* --- patch: linear, with all strains and a rotation --- */

static const double patch_constant[3] = {0.1, -0.2, 0.3};
static const double patch_gradient[3][3] = {{0.2, 0.3, -0.1}, {0.1, 0.4, 0.2}, {0.3, -0.2, 0.1}};

static void patch(const struct deformation *deformation, const double x[3], double u[3])
{
    for (int a = 0; a < deformation->dimension; a++) {
        u[a] = patch_constant[a];
        for (int b = 0; b < deformation->dimension; b++)
            u[a] += patch_gradient[a][b] * x[b];
    }
}

static void patch_slope(const struct deformation *deformation, const double x[3], double gradient[3][3])
{
    (void)x;
    for (int a = 0; a < deformation->dimension; a++)
        for (int b = 0; b < deformation->dimension; b++)
            gradient[a][b] = patch_gradient[a][b];
}

/* --- beam: a cantilever of length L and depth D, held at x = 0, with a parabolic shear load at its end (3.71), (3.72);
 * y from the middle (Timoshenko and Goodier, Theory of Elasticity, 21) --- */

struct beam {
    double length, depth, stiffness; /* E I */
    double x, y;                     /* from the middle of the held end */
};

static struct beam beam_at(const struct deformation *deformation, const double x[3])
{
    const double depth = deformation->high[1] - deformation->low[1];
    return (struct beam){deformation->high[0] - deformation->low[0], depth, deformation->young * depth * depth * depth / 12,
                         x[0] - deformation->low[0], x[1] - 0.5 * (deformation->low[1] + deformation->high[1])};
}

static void beam(const struct deformation *deformation, const double x[3], double u[3])
{
    const struct beam b = beam_at(deformation, x);
    const double nu = deformation->poisson, factor = deformation->load / (6 * b.stiffness), square = b.depth * b.depth / 4;
    u[0] = -factor * b.y * ((6 * b.length - 3 * b.x) * b.x + (2 + nu) * (b.y * b.y - square));
    u[1] = factor * (3 * nu * b.y * b.y * (b.length - b.x) + (4 + 5 * nu) * square * b.x + (3 * b.length - b.x) * b.x * b.x);
}

static void beam_slope(const struct deformation *deformation, const double x[3], double gradient[3][3])
{
    const struct beam b = beam_at(deformation, x);
    const double nu = deformation->poisson, factor = deformation->load / (6 * b.stiffness), square = b.depth * b.depth / 4;
    gradient[0][0] = -6 * factor * b.y * (b.length - b.x);
    gradient[0][1] = -factor * ((6 * b.length - 3 * b.x) * b.x + (2 + nu) * (3 * b.y * b.y - square));
    gradient[1][0] = factor * (-3 * nu * b.y * b.y + (4 + 5 * nu) * square + (6 * b.length - 3 * b.x) * b.x);
    gradient[1][1] = 6 * factor * nu * b.y * (b.length - b.x);
}

/* --- load: none but at the end --- */

static void rest(const struct deformation *deformation, const double x[3], double u[3])
{
    (void)deformation;
    (void)x;
    (void)u;
}

static void end_load(const struct deformation *deformation, const double x[3], int axis, int side, double traction[3])
{
    double area = 1;
    (void)x;
    for (int a = 1; a < deformation->dimension; a++)
        area *= deformation->high[a] - deformation->low[a];
    if (axis == 0 && side > 0)
        traction[deformation->dimension - 1] = deformation->load / area;
}

static const struct deformation_row rows[] = {
    [FUNCTION_LOAD] = {rest, NULL, end_load},
    [FUNCTION_PATCH] = {patch, patch_slope, NULL},
    [FUNCTION_BEAM] = {beam, beam_slope, NULL},
};

struct deformation deformation_of(const struct scene_rkpm *words)
{
    struct deformation deformation = {.function = words->function, .dimension = (int)words->dimension, .young = words->young,
                                      .poisson = words->poisson, .load = words->beam_load};
    for (int a = 0; a < deformation.dimension; a++) {
        deformation.low[a] = words->box[2 * a];
        deformation.high[a] = words->box[2 * a + 1];
    }
    if (words->plane == PLANE_STRAIN) {
        deformation.young /= 1 - words->poisson * words->poisson;
        deformation.poisson /= 1 - words->poisson;
    }
    deformation.moduli = body_moduli(deformation.dimension, words->plane, words->young, words->poisson);
    return deformation;
}

void deformation_value(const struct deformation *deformation, const double x[3], double u[3])
{
    memset(u, 0, 3 * sizeof *u);
    rows[deformation->function].value(deformation, x, u);
}

void deformation_gradient(const struct deformation *deformation, const double x[3], double gradient[3][3])
{
    memset(gradient, 0, 9 * sizeof **gradient);
    rows[deformation->function].gradient(deformation, x, gradient);
}

void deformation_stress(int dimension, struct moduli moduli, double gradient[3][3], double stress[3][3])
{
    double trace = 0;
    for (int a = 0; a < dimension; a++)
        trace += gradient[a][a];
    memset(stress, 0, 9 * sizeof **stress);
    for (int a = 0; a < dimension; a++)
        for (int b = 0; b < dimension; b++)
            stress[a][b] = (a == b ? moduli.lambda * trace : 0) + moduli.mu * (gradient[a][b] + gradient[b][a]);
}

void deformation_traction(const struct deformation *deformation, const double x[3], int axis, int side, double traction[3])
{
    double gradient[3][3], stress[3][3];
    memset(traction, 0, 3 * sizeof *traction);
    if (rows[deformation->function].traction) {
        rows[deformation->function].traction(deformation, x, axis, side, traction);
        return;
    }
    deformation_gradient(deformation, x, gradient);
    deformation_stress(deformation->dimension, deformation->moduli, gradient, stress);
    for (int a = 0; a < deformation->dimension; a++)
        traction[a] = side * stress[a][axis];
}
