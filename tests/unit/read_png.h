/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads back what tools/draw_png.c and draw_deflate.c write, after the standards (ISO/IEC 15948,
 * RFC 1950, 1951) and not after that code. Compressed blocks with codes of their own are refused. */
#ifndef UNIT_READ_PNG_H
#define UNIT_READ_PNG_H

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

struct bit_reader {
    const unsigned char *data;
    size_t count, place; /* bits from here on */
    int bit;
};

static inline unsigned read_bits(struct bit_reader *reader, int count)
{
    unsigned value = 0;
    for (int i = 0; i < count; i++) {
        if (reader->place < reader->count)
            value |= (unsigned)(reader->data[reader->place] >> reader->bit & 1) << i;
        reader->bit = (reader->bit + 1) % 8;
        reader->place += reader->bit == 0;
    }
    return value;
}

static inline unsigned read_code(struct bit_reader *reader, int count)
{
    unsigned code = 0;
    for (int i = 0; i < count; i++)
        code = code << 1 | read_bits(reader, 1);
    return code;
}

/* A symbol of the fixed code: the table of RFC 1951, 3.2.6. */
static inline unsigned read_symbol(struct bit_reader *reader)
{
    unsigned code = read_code(reader, 7);
    if (code <= 0x17)
        return 256 + code;
    code = code << 1 | read_bits(reader, 1);
    if (code >= 0x30 && code <= 0xBF)
        return code - 0x30;
    if (code >= 0xC0 && code <= 0xC7)
        return 280 + code - 0xC0;
    code = code << 1 | read_bits(reader, 1);
    return 144 + code - 0x190;
}

/* Copies a repetition; the tables of RFC 1951, 3.2.5. */
static inline bool copy_repetition(struct bit_reader *reader, unsigned symbol, unsigned char *result, size_t room,
                                   size_t *end)
{
    static const unsigned short lengths[29] = {3,  4,  5,  6,  7,  8,  9,  10, 11,  13,  15,  17,  19,  23, 27,
                                               31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258};
    static const unsigned short distances[30] = {1,   2,   3,   4,   5,   7,    9,    13,   17,   25,
                                                 33,  49,  65,  97,  129, 193,  257,  385,  513,  769,
                                                 1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
    unsigned number = symbol - 257;
    if (number > 28)
        return false;
    int extra = number < 8 || number == 28 ? 0 : (int)(number - 4) / 4;
    size_t length = lengths[number] + read_bits(reader, extra);
    unsigned code = read_code(reader, 5);
    if (code > 29)
        return false;
    size_t distance = distances[code] + read_bits(reader, code < 4 ? 0 : (int)(code - 2) / 2);
    if (distance > *end || length > room - *end)
        return false;
    for (size_t i = 0; i < length; i++, ++*end)
        result[*end] = result[*end - distance];
    return true;
}

/* Unpacks a zlib stream of one fixed block, which must give exactly `room` bytes and end the data. */
static inline bool unpack(const unsigned char *data, size_t count, unsigned char *result, size_t room)
{
    struct bit_reader reader = {data, count, 2, 0};
    uint32_t a = 1, b = 0;
    size_t end = 0;
    if (count < 6 || (data[0] & 15) != 8 || (data[0] * 256 + data[1]) % 31 != 0 || read_bits(&reader, 3) != 3)
        return false;
    for (unsigned symbol = read_symbol(&reader); symbol != 256; symbol = read_symbol(&reader)) {
        if (reader.place >= count || (symbol < 256 && end == room))
            return false;
        if (symbol < 256)
            result[end++] = (unsigned char)symbol;
        else if (!copy_repetition(&reader, symbol, result, room, &end))
            return false;
    }
    for (size_t i = 0; i < end; i++) {
        a = (a + result[i]) % 65521;
        b = (b + a) % 65521;
    }
    const unsigned char *sum = data + reader.place + (reader.bit > 0);
    return end == room && sum + 4 == data + count
           && ((uint32_t)sum[0] << 24 | (uint32_t)sum[1] << 16 | (uint32_t)sum[2] << 8 | sum[3]) == (b << 16 | a);
}

struct picture {
    unsigned width, height;
    unsigned char *points; /* red, green, blue; rows from the top */
};

static inline unsigned read_number(const unsigned char *data)
{
    return (unsigned)data[0] << 24 | (unsigned)data[1] << 16 | (unsigned)data[2] << 8 | data[3];
}

/* CRC-32 bit by bit. */
static inline uint32_t crc_of(const unsigned char *data, size_t count)
{
    uint32_t sum = 0xFFFFFFFFu;
    for (size_t i = 0; i < count; i++) {
        sum ^= data[i];
        for (int bit = 0; bit < 8; bit++)
            sum = sum & 1 ? sum >> 1 ^ 0xEDB88320u : sum >> 1;
    }
    return ~sum;
}

/* Undoes the filters none, left and up of the rows, in place. */
static inline bool undo_filters(unsigned char *rows, struct picture *picture)
{
    size_t width = 3 * (size_t)picture->width;
    for (size_t y = 0; y < picture->height; y++) {
        const unsigned char *row = rows + y * (width + 1);
        unsigned char *result = picture->points + y * width;
        if (row[0] > 2)
            return false;
        for (size_t x = 0; x < width; x++) {
            unsigned before = row[0] == 1 && x >= 3 ? result[x - 3] : row[0] == 2 && y > 0 ? *(result + x - width) : 0;
            result[x] = (unsigned char)(row[x + 1] + before);
        }
    }
    return true;
}

/* Reads a file of the chunks IHDR, IDAT, IEND; NULL, or what is wrong. Free picture->points. */
static inline const char *read_png(const unsigned char *data, size_t count, struct picture *picture)
{
    static const unsigned char head[16] = {0x89, 'P', 'N', 'G', 13, 10, 26, 10, 0, 0, 0, 13, 'I', 'H', 'D', 'R'};
    static const unsigned char kind[5] = {8, 2, 0, 0, 0};
    *picture = (struct picture){0};
    if (count < 57 || memcmp(data, head, 16) != 0 || memcmp(data + 24, kind, 5) != 0)
        return "head";
    picture->width = read_number(data + 16);
    picture->height = read_number(data + 20);
    size_t packed = read_number(data + 33);
    if (packed != count - 57 || memcmp(data + 37, "IDAT", 4) != 0 || memcmp(data + count - 8, "IEND", 4) != 0)
        return "chunks";
    if (read_number(data + 29) != crc_of(data + 12, 17) || read_number(data + 41 + packed) != crc_of(data + 37, packed + 4)
        || read_number(data + count - 4) != crc_of(data + count - 8, 4))
        return "check sums";
    size_t bytes = (3 * (size_t)picture->width + 1) * picture->height;
    unsigned char *rows = malloc(bytes);
    picture->points = malloc(bytes);
    bool done = rows && picture->points && unpack(data + 41, packed, rows, bytes) && undo_filters(rows, picture);
    free(rows);
    return done ? NULL : "packed rows";
}

#endif
