/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Closed surfaces of triangles from STL files, text or binary. The format keeps three corners for
 * each triangle; corners that are the same are found again here, so that it can be said whether
 * the surface is closed. Normals and attributes of the file are not used. */
#ifndef PARTICLES_STL_H
#define PARTICLES_STL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { STL_MOST_TRIANGLES = 4000000, STL_FAULT = 200 };

/* The largest file that is read, in bytes: text takes about 270 a triangle. */
static const size_t STL_MOST_BYTES = (size_t)1500 << 20;

struct stl {
    double (*vertices)[3]; /* all different */
    size_t n_vertices;
    int32_t (*triangles)[3]; /* corners, as indices of vertices, all three different */
    size_t n_triangles;
    double size;          /* largest extent along an axis */
    double largest;       /* largest coordinate, by amount */
    size_t degenerate;    /* triangles of the file without area; those with two corners at one place are left out */
    size_t surplus_bytes; /* behind the last triangle of a binary file */
};

/* Where a surface is not closed. */
struct stl_gap {
    size_t count;             /* edges that do not have exactly two triangles, one for each direction */
    double from[3], to[3];    /* ends of the first such edge of the file */
    int forward, backward;    /* triangles that run it each way */
};

/* Reads a file's bytes. False when they are no STL file; `fault` (STL_FAULT characters) then says
 * why, and there is nothing to close. Corners nearer than 1e-6 of the size are one. */
bool stl_read(struct stl *stl, const char *bytes, size_t size, char *fault);
void stl_close(struct stl *stl);

/* Whether every edge belongs to exactly two triangles that run it in opposite directions; the gap
 * says what is wrong otherwise. */
bool stl_is_closed(const struct stl *stl, struct stl_gap *gap);

#endif
