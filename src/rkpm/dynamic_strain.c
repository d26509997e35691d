/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strain and stress of nodes in a step (spec rkpm 7), and the stress that each row of a node gives to the forces, times its
 * weight. Functions of a node get the dimension as a constant of those that call them, so that their loops are unrolled. */
#include "base/tensor.h"
#include "material/maxwell.h"
#include "rkpm/dynamic.h"

#include <math.h>
#include <string.h>

enum { CHUNK = 64 }; /* nodes at a time */

/* Stresses in the order xx yy zz yz xz xy. */
static const int place[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};

/* Sum over a node's neighbours of increments times a row: the gradient of the motion in the step, d x d by rows. */
THREADS_INLINE void gather(const struct dynamic *dynamic, size_t node, int row, double gradient[3][3], const int d)
{
    const struct nodal *nodal = &dynamic->nodal;
    const int lanes = dynamic_lanes(d), count = nodal->neighbours[node];
    const int32_t *neighbour = rkpm_nodal_neighbour(nodal, node);
    const double *restrict along[3], *restrict increments = dynamic->increment;
    double sum[3][DYNAMIC_MOST_LANES] = {{0}}; /* by axes of the gradient */
    for (int j = 0; j < d; j++)
        along[j] = rkpm_nodal_gradient(nodal, node, row, j);
    for (int k = 0; k < count; k++) {
        const double *restrict increment = increments + (size_t)neighbour[k] * (size_t)lanes;
        for (int j = 0; j < d; j++)
            for (int i = 0; i < lanes; i++)
                sum[j][i] += increment[i] * along[j][k];
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            gradient[i][j] = i < d && j < d ? sum[j][i] : 0;
}

/* Of a gradient that is 1 along axes beyond the dimension. */
THREADS_INLINE void invert(double m[3][3], double inverse[3][3], const int d)
{
    if (d == 3) {
        tensor_inverse(m, tensor_determinant(m), inverse);
        return;
    }
    const double over = 1 / (m[0][0] * m[1][1] - m[0][1] * m[1][0]);
    const double plane[3][3] = {{over * m[1][1], -over * m[0][1], 0}, {-over * m[1][0], over * m[0][0], 0}, {0, 0, 1}};
    memcpy(inverse, plane, sizeof plane);
}

THREADS_INLINE void get_deformation(const struct store *store, size_t slot, double f[3][3])
{
    for (int a = 0; a < 9; a++)
        f[a / 3][a % 3] = store->real[COLUMN_DEFORMATION][a][slot] + (a % 4 == 0);
}

/* The relative gradient less 1 as strain and spin, and the volume after the step. */
THREADS_INLINE void put_strain(struct dynamic *dynamic, size_t slot, double g[3][3])
{
    double *volume = &dynamic->store->real[COLUMN_VOLUME][0][slot];
    for (int a = 0; a < 3; a++)
        dynamic->strain[a][slot] = g[a][a];
    dynamic->strain[3][slot] = g[1][2] + g[2][1];
    dynamic->strain[4][slot] = g[0][2] + g[2][0];
    dynamic->strain[5][slot] = g[0][1] + g[1][0];
    dynamic->spin[0][slot] = 0.5 * (g[2][1] - g[1][2]);
    dynamic->spin[1][slot] = 0.5 * (g[0][2] - g[2][0]);
    dynamic->spin[2][slot] = 0.5 * (g[1][0] - g[0][1]);
    dynamic->trace[slot] = g[0][0] + g[1][1] + g[2][2];
    dynamic->volume_before[slot] = *volume;
    for (int a = 0; a < 3; a++)
        g[a][a] += 1;
    *volume *= tensor_determinant(g);
}

/* Half the work of the loads of a row on the gradient of the motion: they are those of before the step, or of after it. */
THREADS_INLINE double half_work(const struct dynamic *dynamic, size_t node, int row, double step[3][3], const int d)
{
    const double *load = dynamic_load(dynamic, node, row, d);
    double sum = 0;
    for (int i = 0; i < d; i++)
        for (int j = 0; j < d; j++)
            sum += load[j * dynamic_lanes(d) + i] * step[i][j];
    return 0.5 * sum;
}

/* The gradient at the start of the motion, D: F := F + D, f - 1 = D F^-1. */
THREADS_INLINE void strain_rest(struct dynamic *dynamic, size_t slot, double step[3][3], const int d)
{
    struct store *store = dynamic->store;
    double f[3][3], inverse[3][3], g[3][3];
    get_deformation(store, slot, f);
    invert(f, inverse, d);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            g[i][j] = step[i][0] * inverse[0][j] + step[i][1] * inverse[1][j] + step[i][2] * inverse[2][j];
            store->real[COLUMN_DEFORMATION][3 * i + j][slot] += step[i][j];
        }
    put_strain(dynamic, slot, g);
}

/* The gradient at the end of the motion, G: f = (1 - G)^-1, f - 1 = f G, F := f F. */
THREADS_INLINE void strain_now(struct dynamic *dynamic, size_t slot, double step[3][3], const int d)
{
    struct store *store = dynamic->store;
    double f[3][3], rest[3][3], inverse[3][3], g[3][3];
    for (int a = 0; a < 9; a++)
        rest[a / 3][a % 3] = (a % 4 == 0) - step[a / 3][a % 3];
    invert(rest, inverse, d);
    get_deformation(store, slot, f);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            g[i][j] = inverse[i][0] * step[0][j] + inverse[i][1] * step[1][j] + inverse[i][2] * step[2][j];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            store->real[COLUMN_DEFORMATION][3 * i + j][slot] += g[i][0] * f[0][j] + g[i][1] * f[1][j] + g[i][2] * f[2][j];
    put_strain(dynamic, slot, g);
}

THREADS_INLINE void strain_node(struct dynamic *dynamic, size_t node, size_t slot, double step[3][3], const int d)
{
    gather(dynamic, node, 0, step, d);
    dynamic->store->real[COLUMN_ENERGY][0][slot] += half_work(dynamic, node, 0, step, d);
    if (dynamic->is_semi)
        strain_now(dynamic, slot, step, d);
    else
        strain_rest(dynamic, slot, step, d);
}

/* V_0 P = V_0 J sigma F^-T of gradients at the start; V sigma of those at the end of the step. */
THREADS_INLINE void load_node(struct dynamic *dynamic, size_t node, size_t slot, double step[3][3], const int d)
{
    struct store *store = dynamic->store;
    const double volume = store->real[COLUMN_VOLUME][0][slot];
    double f[3][3], inverse[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    double *load = dynamic_load(dynamic, node, 0, d);
    if (!dynamic->is_semi) {
        get_deformation(store, slot, f);
        invert(f, inverse, d);
    }
    for (int i = 0; i < d; i++)
        for (int j = 0; j < d; j++) {
            double sum = 0;
            for (int k = 0; k < d; k++)
                sum += store->real[COLUMN_STRESS][place[i][k]][slot] * inverse[j][k];
            load[j * dynamic_lanes(d) + i] = volume * sum;
        }
    store->real[COLUMN_ENERGY][0][slot] += half_work(dynamic, node, 0, step, d);
}

/* --- gradients of stress --- */

/* Shear moduli of spring and elements, bulk modulus, factors of elements: all with the factor of the stabilisation. */
struct gradient_law {
    double spring, bulk;
    int n_elements;
    double shear[RKPM_STABILISED_ELEMENTS];
    struct maxwell_factors factors[RKPM_STABILISED_ELEMENTS];
};

static struct gradient_law gradient_law_of(const struct dynamic *dynamic)
{
    const struct material *material = dynamic->material;
    const double factor = dynamic->stabilisation;
    struct gradient_law law = {.spring = factor * material->shear_modulus, .bulk = factor * material->bulk_modulus, .n_elements = material->n_elements};
    for (int i = 0; i < law.n_elements; i++) {
        law.shear[i] = factor * material->elements[i].shear;
        law.factors[i] = maxwell_factors(MAXWELL_EXPONENTIAL, dynamic->time_step, material->elements[i].time);
        law.spring -= law.shear[i];
    }
    return law;
}

/* Of a square or cube of a volume. */
THREADS_INLINE double square_of_side(double volume, const int d)
{
    return d == 2 ? volume : cbrt(volume * volume);
}

/* The gradient of stress along an axis goes on by that of the strain, as if strains were small; its weight is the present
 * volume times the second moment of a cell of the volume that gradients are of (spec 7). */
THREADS_INLINE void stabilise(struct dynamic *dynamic, size_t node, size_t slot, int axis, const struct gradient_law *law, const int d)
{
    double step[3][3], deviator[6] = {0}, sum[6];
    double *s = dynamic->gradient_stress + (slot * (size_t)d + (size_t)axis) * (size_t)dynamic->gradient_terms;
    double *load = dynamic_load(dynamic, node, 1 + axis, d);
    gather(dynamic, node, 1 + axis, step, d);
    dynamic->store->real[COLUMN_ENERGY][0][slot] += half_work(dynamic, node, 1 + axis, step, d);
    const double trace = step[0][0] + step[1][1] + step[2][2];
    for (int i = 0; i < 3; i++)
        for (int j = i; j < 3; j++)
            deviator[place[i][j]] = 0.5 * (step[i][j] + step[j][i]) - (i == j ? trace / 3 : 0);
    s[0] += law->bulk * trace;
    for (int a = 0; a < 6; a++) {
        sum[a] = s[1 + a] += 2 * law->spring * deviator[a];
        for (int e = 0; e < law->n_elements; e++) {
            double *element = &s[7 + 6 * e + a];
            *element = law->factors[e].decay * *element + 2 * law->shear[e] * deviator[a];
            sum[a] += *element;
        }
    }
    const double volume = dynamic->store->real[COLUMN_VOLUME][0][slot];
    const double weight = volume * square_of_side(dynamic->is_semi ? volume : dynamic->volume, d) / 12;
    for (int i = 0; i < d; i++)
        for (int j = 0; j < d; j++)
            load[j * dynamic_lanes(d) + i] = weight * (sum[place[i][j]] + (i == j ? s[0] : 0));
    dynamic->store->real[COLUMN_ENERGY][0][slot] += half_work(dynamic, node, 1 + axis, step, d);
}

/* --- nodes by chunks --- */

/* The law for places in the store from ... to - 1. */
static void update_stress(struct dynamic *dynamic, size_t from, size_t to)
{
    struct store *store = dynamic->store;
    struct law_batch batch = {
        .count = (int)(to - from),
        .material = dynamic->material,
        .time_step = dynamic->time_step,
        .time = dynamic->time,
        .cell_size = dynamic->spacing,
        .trace = dynamic->trace + from,
        .volume_before = dynamic->volume_before + from,
        .volume = store->real[COLUMN_VOLUME][0] + from,
        .mass = store->real[COLUMN_MASS][0] + from,
        .terms = {dynamic->terms[0] + from, dynamic->terms[1] + from},
        .history = store->history,
        .history_from = (int)from,
    };
    for (int a = 0; a < 6; a++) {
        batch.strain[a] = dynamic->strain[a] + from;
        batch.stress[a] = store->real[COLUMN_STRESS][a] + from;
    }
    for (int a = 0; a < 3; a++)
        batch.spin[a] = dynamic->spin[a] + from;
    for (int a = 0; a < 9; a++)
        batch.deformation[a] = store->real[COLUMN_DEFORMATION][a] + from;
    dynamic->material->law->update(&batch);
}

/* Nodes from ... to - 1, which stand side by side in the store. */
THREADS_INLINE void strain_chunk(struct dynamic *dynamic, size_t from, size_t to, const struct gradient_law *law, const int d)
{
    const size_t slot = (size_t)dynamic->slot[from];
    double steps[CHUNK][3][3];
    for (size_t k = 0; k < to - from; k++)
        strain_node(dynamic, from + k, slot + k, steps[k], d);
    update_stress(dynamic, slot, slot + to - from);
    for (size_t k = 0; k < to - from; k++) {
        load_node(dynamic, from + k, slot + k, steps[k], d);
        for (int axis = 0; axis < d && dynamic->nodal.rows > 1; axis++)
            stabilise(dynamic, from + k, slot + k, axis, law, d);
    }
}

THREADS_VECTORISED
static void strain_chunk_2(struct dynamic *dynamic, size_t from, size_t to, const struct gradient_law *law)
{
    strain_chunk(dynamic, from, to, law, 2);
}

THREADS_VECTORISED
static void strain_chunk_3(struct dynamic *dynamic, size_t from, size_t to, const struct gradient_law *law)
{
    strain_chunk(dynamic, from, to, law, 3);
}

/* A node of the wall; without the body near it carries nothing. */
static void strain_fixed(struct dynamic *dynamic, size_t node, const struct gradient_law *law)
{
    const int d = dynamic->dimension;
    memset(dynamic_load(dynamic, node, 0, d), 0, dynamic_load_terms(dynamic) * sizeof(double));
    if (dynamic->fixed.is_active[dynamic->slot[node]])
        (d == 2 ? strain_chunk_2 : strain_chunk_3)(dynamic, node, node + 1, law);
}

void rkpm_dynamic_strain(struct dynamic *dynamic)
{
    const size_t count = dynamic->count;
    const struct gradient_law law = dynamic->nodal.rows > 1 ? gradient_law_of(dynamic) : (struct gradient_law){0};
#pragma omp parallel if (dynamic->nodes >= DYNAMIC_FEW_NODES)
    {
#pragma omp for schedule(static) nowait
        for (size_t from = 0; from < count; from += CHUNK)
            (dynamic->dimension == 2 ? strain_chunk_2 : strain_chunk_3)(dynamic, from, from + CHUNK < count ? from + CHUNK : count, &law);
#pragma omp for schedule(static)
        for (size_t node = count; node < dynamic->nodes; node++)
            strain_fixed(dynamic, node, &law);
    }
}
