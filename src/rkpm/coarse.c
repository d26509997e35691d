/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rkpm/coarse.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

/* Spacings of nodes in one of the grid. */
static const double COARSENESS = 4;
enum { CORNERS = 8 };

/* Grid nodes run along the axis with most cells last, as rows of the matrix do. */
static void set_strides(const struct coarse *coarse, int32_t stride[3])
{
    int order[3];
    box_order_axes(coarse->cells, order);
    int32_t product = 1;
    for (int i = 0; i < 3; i++) {
        stride[order[i]] = product;
        product *= (int32_t)coarse->cells[order[i]] + 1;
    }
}

static void set_corners(struct coarse *coarse)
{
    const struct body *body = coarse->body;
    const struct node_box *box = body->box;
    int32_t stride[3] = {0};
    set_strides(coarse, stride);
    for (size_t row = 0; row < body->nodes; row++)
        for (int c = 0; c < coarse->corners; c++) {
            double share = 1;
            int32_t node = 0;
            for (int a = 0; a < body->dimension; a++) {
                const double width = box->spacing[a] * (double)(box->numbers[a] - 1) / (double)coarse->cells[a];
                const double place = (body->x[a][body->node[row]] - box->low[a]) / width;
                const double cell = fmin(fmax(floor(place), 0), (double)coarse->cells[a] - 1);
                share *= c >> a & 1 ? place - cell : 1 - place + cell;
                node += stride[a] * ((int32_t)cell + (c >> a & 1));
            }
            coarse->corner[row * (size_t)coarse->corners + (size_t)c] = node;
            coarse->share[row * (size_t)coarse->corners + (size_t)c] = share;
        }
}

static void find_first(struct coarse *coarse)
{
    const struct sparse *matrix = &coarse->body->matrix;
    const int d = matrix->size, corners = coarse->corners;
    int32_t *lowest = memory_array((size_t)coarse->nodes, sizeof *lowest, "the coarse grid");
    for (int32_t n = 0; n < coarse->nodes; n++)
        lowest[n] = n;
    for (int32_t row = 0; row < matrix->count; row++) {
        int32_t low = coarse->nodes;
        for (size_t k = matrix->first[row]; k < matrix->first[row + 1]; k++)
            for (int c = 0; c < corners; c++) {
                const int32_t other = coarse->corner[matrix->column[k] * corners + c];
                low = other < low ? other : low;
            }
        for (int c = 0; c < corners; c++) {
            const int32_t own = coarse->corner[row * corners + c];
            lowest[own] = low < lowest[own] ? low : lowest[own];
        }
    }
    for (int32_t n = 0; n < coarse->nodes; n++)
        for (int a = 0; a < d; a++)
            coarse->first[n * d + a] = lowest[n] * d;
    memory_free(lowest);
}

void coarse_open(struct coarse *coarse, const struct body *body)
{
    const size_t d = (size_t)body->dimension;
    *coarse = (struct coarse){.body = body, .corners = 1 << body->dimension, .nodes = 1};
    for (int a = 0; a < body->dimension; a++) {
        coarse->cells[a] = (long)fmax(1, floor((double)(body->box->numbers[a] - 1) / COARSENESS + 0.5));
        coarse->nodes *= (int32_t)coarse->cells[a] + 1;
    }
    coarse->corner = memory_array(body->nodes * (size_t)coarse->corners, sizeof *coarse->corner, "the coarse grid");
    coarse->share = memory_array(body->nodes * (size_t)coarse->corners, sizeof(double), "the coarse grid");
    coarse->first = memory_array((size_t)coarse->nodes * d, sizeof *coarse->first, "the coarse grid");
    coarse->unknown = memory_array((size_t)coarse->nodes * d, sizeof(double), "the coarse grid");
    set_corners(coarse);
    find_first(coarse);
}

void coarse_close(struct coarse *coarse)
{
    memory_free(coarse->corner);
    memory_free(coarse->share);
    memory_free(coarse->first);
    memory_free(coarse->unknown);
    envelope_close(&coarse->envelope);
}

/* Sums of a row's blocks over grid nodes, each listed once. */
struct sums {
    int32_t *place;  /* per grid node where it is in the list, plus 1 */
    int32_t *list;
    double *block;
    int32_t count;
};

static void sum_row(const struct coarse *coarse, int32_t row, const bool *is_left_out, struct sums *sums)
{
    const struct sparse *matrix = &coarse->body->matrix;
    const size_t size = (size_t)(matrix->size * matrix->size);
    sums->count = 0;
    for (size_t k = matrix->first[row]; k < matrix->first[row + 1]; k++)
        for (int c = 0; c < coarse->corners && !is_left_out[matrix->column[k]]; c++) {
            const size_t pair = (size_t)matrix->column[k] * (size_t)coarse->corners + (size_t)c;
            int32_t *place = &sums->place[coarse->corner[pair]];
            if (*place == 0) {
                sums->list[sums->count++] = coarse->corner[pair];
                *place = sums->count;
                memset(sums->block + (size_t)(*place - 1) * size, 0, size * sizeof(double));
            }
            for (size_t i = 0; i < size; i++)
                sums->block[(size_t)(*place - 1) * size + i] += coarse->share[pair] * matrix->value[k * size + i];
        }
    for (int32_t i = 0; i < sums->count; i++)
        sums->place[sums->list[i]] = 0;
}

/* The row's share of the lower half of P^T K P. */
static void add_sums(struct coarse *coarse, int32_t row, const struct sums *sums)
{
    const int d = coarse->body->dimension;
    for (int c = 0; c < coarse->corners; c++) {
        const size_t pair = (size_t)row * (size_t)coarse->corners + (size_t)c;
        const int32_t own = coarse->corner[pair];
        for (int32_t i = 0; i < sums->count; i++)
            for (int a = 0; a < d && sums->list[i] <= own; a++)
                for (int b = 0; b < d && (sums->list[i] < own || b <= a); b++)
                    *envelope_at(&coarse->envelope, own * d + a, sums->list[i] * d + b) += coarse->share[pair] * sums->block[(i * d + a) * d + b];
    }
}

void coarse_factor(struct coarse *coarse, const bool *is_left_out)
{
    const size_t nodes = (size_t)coarse->nodes, size = (size_t)(coarse->body->dimension * coarse->body->dimension);
    struct sums sums = {.place = memory_array(nodes, sizeof *sums.place, "the coarse grid"),
                        .list = memory_array(nodes, sizeof *sums.list, "the coarse grid"),
                        .block = memory_array(nodes * size, sizeof(double), "the coarse grid")};
    envelope_open(&coarse->envelope, coarse->nodes * coarse->body->dimension, coarse->first);
    for (int32_t row = 0; row < coarse->body->matrix.count; row++) {
        if (is_left_out[row])
            continue;
        sum_row(coarse, row, is_left_out, &sums);
        add_sums(coarse, row, &sums);
    }
    envelope_factor(&coarse->envelope);
    memory_free(sums.place);
    memory_free(sums.list);
    memory_free(sums.block);
}

void coarse_add(struct coarse *coarse, const bool *is_left_out, const double *r, double *z)
{
    const size_t d = (size_t)coarse->body->dimension, corners = (size_t)coarse->corners, rows = coarse->body->nodes;
    memset(coarse->unknown, 0, (size_t)coarse->nodes * d * sizeof(double));
    for (size_t row = 0; row < rows; row++)
        for (size_t c = 0; c < corners && !is_left_out[row]; c++)
            for (size_t a = 0; a < d; a++)
                coarse->unknown[(size_t)coarse->corner[row * corners + c] * d + a] += coarse->share[row * corners + c] * r[row * d + a];
    envelope_solve(&coarse->envelope, coarse->unknown);
    for (size_t row = 0; row < rows; row++)
        for (size_t c = 0; c < corners && !is_left_out[row]; c++)
            for (size_t a = 0; a < d; a++)
                z[row * d + a] += coarse->share[row * corners + c] * coarse->unknown[(size_t)coarse->corner[row * corners + c] * d + a];
}
