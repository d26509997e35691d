/* SPDX-License-Identifier: GPL-3.0-or-later */
/* draw_png: see draw_png.h. */
#include "draw_png.h"
#include "base/memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { FILTER_NONE, FILTER_LEFT, FILTER_UP, FILTER_COUNT, POINT_BYTES = 3 };

static void put_number(struct draw_bytes *file, uint32_t number)
{
    const unsigned char bytes[4] = {(unsigned char)(number >> 24), (unsigned char)(number >> 16),
                                    (unsigned char)(number >> 8), (unsigned char)number};
    draw_bytes_add(file, bytes, sizeof bytes);
}

/* CRC-32 with the polynomial of PNG, annex D. */
static uint32_t check_sum(const unsigned char *data, size_t count)
{
    uint32_t table[256];
    for (uint32_t i = 0; i < 256; ++i) {
        table[i] = i;
        for (int bit = 0; bit < 8; ++bit)
            table[i] = table[i] & 1U ? 0xEDB88320U ^ table[i] >> 1 : table[i] >> 1;
    }
    uint32_t sum = 0xFFFFFFFFU;
    for (size_t i = 0; i < count; ++i)
        sum = table[(sum ^ data[i]) & 0xFF] ^ sum >> 8;
    return ~sum;
}

/* A chunk: length, four letters, data, check sum of letters and data. */
static void put_chunk(struct draw_bytes *file, const char *letters, const unsigned char *data,
                      size_t count)
{
    put_number(file, (uint32_t)count);
    const size_t start = file->count;
    draw_bytes_add(file, letters, 4);
    draw_bytes_add(file, data, count);
    put_number(file, check_sum(file->data + start, file->count - start));
}

/* The row as differences to the left or upper neighbour, or as it is. */
static void filter_row(int filter, const unsigned char *row, const unsigned char *above,
                       size_t count, unsigned char *result)
{
    for (size_t i = 0; i < count; ++i) {
        unsigned char before = 0;
        if (filter == FILTER_LEFT && i >= POINT_BYTES)
            before = row[i - POINT_BYTES];
        else if (filter == FILTER_UP && above != NULL)
            before = above[i];
        result[i] = (unsigned char)(row[i] - before);
    }
}

/* Few changes pack well: how many bytes differ from the one a point before. */
static size_t changes(const unsigned char *row, size_t count)
{
    size_t result = 0;
    for (size_t i = POINT_BYTES; i < count; ++i)
        result += row[i] != row[i - POINT_BYTES];
    return result;
}

/* All rows, each behind the number of the filter that suits it best. */
static unsigned char *filtered_rows(const struct draw_canvas *canvas, size_t *count)
{
    const size_t width = (size_t)canvas->width * POINT_BYTES;
    const size_t height = (size_t)canvas->height;
    const unsigned char *points = (const unsigned char *)canvas->points;
    unsigned char *rows = memory_array((width + 1) * height, 1, "the picture");
    unsigned char *trial = memory_array(width, 1, "the picture");
    for (size_t row = 0; row < height; ++row) {
        const unsigned char *above = row > 0 ? points + (row - 1) * width : NULL;
        unsigned char *best = rows + row * (width + 1);
        size_t fewest = SIZE_MAX;
        for (int filter = 0; filter < FILTER_COUNT; ++filter) {
            filter_row(filter, points + row * width, above, width, trial);
            const size_t number = changes(trial, width);
            if (number < fewest) {
                fewest = number;
                best[0] = (unsigned char)filter;
                memcpy(best + 1, trial, width);
            }
        }
    }
    memory_free(trial);
    *count = (width + 1) * height;
    return rows;
}

void draw_png(const struct draw_canvas *canvas, struct draw_bytes *file)
{
    static const unsigned char signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    struct draw_bytes head = {0};
    struct draw_bytes packed = {0};
    size_t count;
    put_number(&head, (uint32_t)canvas->width);
    put_number(&head, (uint32_t)canvas->height);
    draw_bytes_add(&head, (const unsigned char[]){8, 2, 0, 0, 0}, 5);
    unsigned char *rows = filtered_rows(canvas, &count);
    draw_deflate(rows, count, &packed);
    draw_bytes_add(file, signature, sizeof signature);
    put_chunk(file, "IHDR", head.data, head.count);
    put_chunk(file, "IDAT", packed.data, packed.count);
    put_chunk(file, "IEND", NULL, 0);
    memory_free(rows);
    draw_bytes_free(&head);
    draw_bytes_free(&packed);
}
