/* SPDX-License-Identifier: GPL-3.0-or-later */
/* draw_png: a canvas as a PNG file (ISO/IEC 15948): 8 bits each of red, green and blue. */
#ifndef TOOLS_DRAW_PNG_H
#define TOOLS_DRAW_PNG_H

#include "draw_canvas.h"
#include "draw_deflate.h"

/* Adds the file's bytes to *file. */
void draw_png(const struct draw_canvas *canvas, struct draw_bytes *file);

#endif
