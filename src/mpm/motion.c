/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Motion of particles by what they gathered from the grid (spec 6 F). */
#include "base/threads.h"
#include "mpm/chunk.h"

#include <math.h>

void motion_work(struct mpm *mpm, const struct chunk *chunk)
{
    double work = 0;
    if (!mpm->has_external_force)
        return;
    for (int32_t j = 0; j < chunk->count; j++) {
        double force[3];
        mpm_external_force(mpm, (size_t)chunk->order[j], force);
        for (int a = 0; a < 3; a++)
            work += force[a] * chunk->workspace->gathered[a][j];
    }
    mpm->block_sums[chunk->block_index].work += work * mpm->time_step;
}

/* Adds the chunk's kinetic energy, momentum and largest velocity to the block's sums. Four
 * partial sums, so that the result does not depend on how wide the processor's vectors are. */
THREADS_INLINE void sum_motion(struct sums *sums, int32_t count, double *const velocity[3],
                                                             const double *mass)
{
    lanes kinetic = {0}, px = {0}, py = {0}, pz = {0};
    double fastest = sums->fastest;
    int32_t j = 0;
    for (; j + LANES <= count; j += LANES) {
        lanes m = *(const lanes *)&mass[j];
        lanes x = *(const lanes *)&velocity[0][j], y = *(const lanes *)&velocity[1][j], z = *(const lanes *)&velocity[2][j];
        kinetic += m * (x * x + y * y + z * z);
        px += m * x;
        py += m * y;
        pz += m * z;
    }
    for (; j < count; j++) {
        double x = velocity[0][j], y = velocity[1][j], z = velocity[2][j];
        kinetic[0] += mass[j] * (x * x + y * y + z * z);
        px[0] += mass[j] * x;
        py[0] += mass[j] * y;
        pz[0] += mass[j] * z;
    }
    for (int a = 0; a < 3; a++)
        for (j = 0; j < count; j++) {
            double speed = fabs(velocity[a][j]);
            fastest = speed > fastest ? speed : fastest;
        }
    sums->kinetic += 0.5 * ((kinetic[0] + kinetic[1]) + (kinetic[2] + kinetic[3]));
    sums->momentum[0] += (px[0] + px[1]) + (px[2] + px[3]);
    sums->momentum[1] += (py[0] + py[1]) + (py[2] + py[3]);
    sums->momentum[2] += (pz[0] + pz[1]) + (pz[2] + pz[3]);
    sums->fastest = fastest;
}

void motion_blend(struct mpm *mpm, const struct chunk *chunk, double *const velocity[3])
{
    const double share = mpm->scene->transfer == TRANSFER_AFFINE ? 0 : mpm->scene->flip_share;
    const double step = mpm->time_step * mpm->momentum_factor;
    for (int a = 0; a < 3; a++) /* the acceleration comes on top afterwards */
        for (int32_t j = 0; j < chunk->count; j++)
            velocity[a][j] = share * velocity[a][j] + (1 - share) * chunk->workspace->gathered[a][j];
    chunk->workspace->acceleration_step = share * step;
}

/* Kinetic energy of the particles' changes of velocity in this step. */
static double change_energy(const struct mpm *mpm, const struct chunk *chunk, const double *mass)
{
    const double step = mpm->time_step * mpm->momentum_factor;
    double energy = 0;
    for (int32_t j = 0; j < chunk->count; j++)
        for (int a = 0; a < 3; a++) {
            const double change = chunk->workspace->gathered[a][j] * step;
            energy += 0.5 * mass[j] * change * change;
        }
    return energy;
}

THREADS_VECTORISED
void motion_accelerate(struct mpm *mpm, const struct chunk *chunk, double *const velocity[3], const double *mass)
{
    const bool blends = mpm->scene->transfer != TRANSFER_FLIP;
    const double step = blends ? chunk->workspace->acceleration_step : mpm->time_step * mpm->momentum_factor;
    for (int a = 0; a < 3; a++) {
        double *restrict v = velocity[a];
        const double *restrict acceleration = chunk->workspace->gathered[a];
        for (int32_t j = 0; j < chunk->count; j++)
            v[j] += acceleration[j] * step;
        chunk_write(chunk, mpm->store->real[COLUMN_VELOCITY][a], v);
    }
    sum_motion(&mpm->block_sums[chunk->block_index], chunk->count, velocity, mass);
    if (mpm->grid->damping > 0)
        mpm->block_sums[chunk->block_index].changed += change_energy(mpm, chunk, mass);
}

/* Cells of the chunk's new positions, counted from the block's corner, into workspace.cell. */
THREADS_INLINE void find_cells(const struct mpm *mpm, const struct chunk *chunk,
                                                             double *const position[3])
{
    const struct cell_frame *frame = &mpm->cells->frame;
    int32_t code[CHUNK_PARTICLES], outside[CHUNK_PARTICLES];
    for (int a = 0; a < 3; a++) {
        const double *restrict x = position[a];
        const double low = frame->low[a], high = frame->high[a], size = frame->size;
        const int32_t last = frame->cells[a] - 1, corner = chunk->block->at[a] * BLOCK_EDGE;
        const int shift = 2 * a;
        for (int32_t j = 0; j < chunk->count; j++) {
            double way = x[j] >= low && x[j] <= high ? (x[j] - low) / size : -1;
            int32_t i = (int32_t)way;
            i = way < 0 ? -1 : i < last ? i : last;
            int32_t in_block = i - corner;
            int32_t is_outside = (in_block < 0) | (in_block >= BLOCK_EDGE);
            code[j] = (a == 0 ? 0 : code[j]) + in_block * (1 << shift);
            outside[j] = (a == 0 ? 0 : outside[j]) | is_outside;
        }
    }
    for (int32_t j = 0; j < chunk->count; j++)
        chunk->workspace->cell[j] = (uint8_t)(outside[j] ? CELL_LEFT_BLOCK : code[j]);
}

THREADS_VECTORISED
void motion_move(struct mpm *mpm, const struct chunk *chunk)
{
    const double step = mpm->time_step;
    double *position[3];
    for (int a = 0; a < 3; a++) {
        double *restrict x = position[a] =
            chunk_read(chunk, mpm->store->real[COLUMN_POSITION][a], chunk->workspace->copy[a]);
        const double *restrict velocity = chunk->workspace->gathered[a];
        for (int32_t j = 0; j < chunk->count; j++)
            x[j] += velocity[j] * step;
        chunk_write(chunk, mpm->store->real[COLUMN_POSITION][a], x);
    }
    if (mpm->place != COLUMN_POSITION || mpm->keeps_cells)
        return;
    find_cells(mpm, chunk, position);
    uint8_t *cell = mpm->cells->cell;
    int changed = 0;
    for (int32_t j = 0; j < chunk->count; j++) {
        changed += cell[chunk->order[j]] != chunk->workspace->cell[j];
        cell[chunk->order[j]] = chunk->workspace->cell[j];
    }
    if (changed > 0) {
        mpm->cells->block_changed[chunk->block_index] = 1;
        mpm->block_sums[chunk->block_index].moved += changed;
    }
}
