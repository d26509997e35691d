/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ParaView output: one .vtu file of all particles for each output time, and a .pvd that lists them;
 * the .pvd is written whole each time, so that an ended or killed run opens (spec 11). */
#ifndef OUTPUT_VTK_H
#define OUTPUT_VTK_H

#include "deck/scene.h"
#include "output/table.h"

struct vtk_series {
    char *folder, *job;
    double *times;
    size_t count, capacity;
};

/* Starts a series of files job_anim_1.vtu, job_anim_2.vtu ... in `folder`. */
void vtk_open(struct vtk_series *series, const char *folder, const char *job);
void vtk_close(struct vtk_series *series);

/* Writes the next file and the list. False, after a message, when a file could not be written. */
bool vtk_write(struct vtk_series *series, const struct scene *scene, const struct result_source *source, double time);

/* Goes on behind the first `count` files: returns the room for their times. */
double *vtk_resume(struct vtk_series *series, size_t count);

/* Writes the list of the files, as vtk_write does. */
bool vtk_write_list(const struct vtk_series *series);

/* Writes the background grid as job_Grid.vtu: nodes and cells (voxels). */
bool vtk_write_grid(const struct vtk_series *series, const struct scene *scene);

#endif
