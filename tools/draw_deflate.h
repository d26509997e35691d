/* SPDX-License-Identifier: GPL-3.0-or-later */
/* draw_deflate: a zlib stream (RFC 1950, 1951), packed with repetitions and the fixed codes. */
#ifndef TOOLS_DRAW_DEFLATE_H
#define TOOLS_DRAW_DEFLATE_H

#include <stddef.h>

struct draw_bytes {
    unsigned char *data;
    size_t count;
    size_t capacity;
};

/* Adds bytes at the end. */
void draw_bytes_add(struct draw_bytes *bytes, const void *data, size_t count);
void draw_bytes_free(struct draw_bytes *bytes);

/* Adds the zlib stream of `count` bytes to *packed. */
void draw_deflate(const unsigned char *data, size_t count, struct draw_bytes *packed);

#endif
