/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * draw_deflate: see draw_deflate.h.
 *
 * A repetition is looked for among the last places that began with the same three bytes.
 */
#include "draw_deflate.h"
#include "base/memory.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

enum {
    SHORTEST = 3,
    LONGEST = 258,
    FARTHEST = 32768,
    HASH_BITS = 15,
    HASH_SIZE = 1 << HASH_BITS,
    TRIES = 24,      /* earlier places that are compared */
    GOOD_ENOUGH = 64 /* a repetition of this length ends the search */
};

struct packer {
    const unsigned char *data;
    size_t count;
    struct draw_bytes *packed;
    uint32_t bits; /* not yet given out, the first one lowest */
    int bit_count;
    size_t *newest; /* by hash: one more than the last place, 0 for none */
    size_t *older;  /* by place modulo FARTHEST: likewise the place before it of that hash */
};

void draw_bytes_add(struct draw_bytes *bytes, const void *data, size_t count)
{
    bytes->data = memory_grow(bytes->data, &bytes->capacity, bytes->count + count, 1, "a file");
    if (count > 0)
        memcpy(bytes->data + bytes->count, data, count);
    bytes->count += count;
}

void draw_bytes_free(struct draw_bytes *bytes)
{
    memory_free(bytes->data);
    *bytes = (struct draw_bytes){0};
}

static void put_bits(struct packer *packer, uint32_t bits, int count)
{
    packer->bits |= bits << packer->bit_count;
    packer->bit_count += count;
    while (packer->bit_count >= 8) {
        const unsigned char byte = (unsigned char)(packer->bits & 0xFF);
        draw_bytes_add(packer->packed, &byte, 1);
        packer->bits >>= 8;
        packer->bit_count -= 8;
    }
}

/* A Huffman code stands with its highest bit first. */
static void put_code(struct packer *packer, uint32_t code, int length)
{
    uint32_t reversed = 0;
    for (int i = 0; i < length; ++i)
        reversed |= ((code >> i) & 1U) << (length - 1 - i);
    put_bits(packer, reversed, length);
}

/* The fixed code of a byte, the end (256) or a length (257..285); RFC 1951, 3.2.6. */
static void put_symbol(struct packer *packer, uint32_t symbol)
{
    if (symbol < 144)
        put_code(packer, 0x30 + symbol, 8);
    else if (symbol < 256)
        put_code(packer, 0x190 + symbol - 144, 9);
    else if (symbol < 280)
        put_code(packer, symbol - 256, 7);
    else
        put_code(packer, 0xC0 + symbol - 280, 8);
}

/* Lengths and distances share a rule: after the first few, 2^p symbols for each doubling. */
static void put_length(struct packer *packer, uint32_t length)
{
    uint32_t rest = length - SHORTEST;
    uint32_t extra = 0;
    if (length == LONGEST) {
        put_symbol(packer, 285);
        return;
    }
    while (rest >> extra >= 8)
        ++extra;
    put_symbol(packer, 257 + 4 * extra + (rest >> extra));
    put_bits(packer, rest & ((1U << extra) - 1), (int)extra);
}

static void put_distance(struct packer *packer, uint32_t distance)
{
    const uint32_t rest = distance - 1;
    uint32_t extra = 0;
    while (rest >> extra >= 4)
        ++extra;
    put_code(packer, 2 * extra + (rest >> extra), 5);
    put_bits(packer, rest & ((1U << extra) - 1), (int)extra);
}

static uint32_t hash_at(const struct packer *packer, size_t place)
{
    const unsigned char *d = packer->data + place;
    return ((uint32_t)d[0] * 506832829U + (uint32_t)d[1] * 2654435761U + (uint32_t)d[2] * 40503U) >>
               16 &
           (HASH_SIZE - 1);
}

static void remember(struct packer *packer, size_t place)
{
    if (place + SHORTEST > packer->count)
        return;
    const uint32_t hash = hash_at(packer, place);
    packer->older[place % FARTHEST] = packer->newest[hash];
    packer->newest[hash] = place + 1;
}

static size_t common_length(const struct packer *packer, size_t one, size_t other)
{
    size_t length = 0;
    const size_t longest = packer->count - other < LONGEST ? packer->count - other : LONGEST;
    while (length < longest && packer->data[one + length] == packer->data[other + length])
        ++length;
    return length;
}

/* The longest repetition at `place`: its length, 0 for none, and how far back it is. */
static size_t find_repetition(const struct packer *packer, size_t place, size_t *distance)
{
    size_t best = SHORTEST - 1;
    if (place + SHORTEST > packer->count)
        return 0;
    size_t candidate = packer->newest[hash_at(packer, place)];
    for (int tries = 0; candidate > 0 && tries < TRIES && best < GOOD_ENOUGH; ++tries) {
        const size_t earlier = candidate - 1;
        if (place - earlier > FARTHEST - 1)
            break;
        const size_t length = common_length(packer, earlier, place);
        if (length > best) {
            best = length;
            *distance = place - earlier;
        }
        candidate = packer->older[earlier % FARTHEST];
    }
    return best >= SHORTEST ? best : 0;
}

static void pack(struct packer *packer)
{
    put_bits(packer, 1, 1); /* the last block */
    put_bits(packer, 1, 2); /* with the fixed codes */
    for (size_t place = 0; place < packer->count;) {
        size_t distance = 0;
        const size_t length = find_repetition(packer, place, &distance);
        const size_t step = length > 0 ? length : 1;
        if (length > 0) {
            put_length(packer, (uint32_t)length);
            put_distance(packer, (uint32_t)distance);
        } else
            put_symbol(packer, packer->data[place]);
        for (size_t i = 0; i < step; ++i)
            remember(packer, place + i);
        place += step;
    }
    put_symbol(packer, 256);
    put_bits(packer, 0, 7); /* to the end of the byte */
}

/* Adler-32, RFC 1950. */
static uint32_t check_sum(const unsigned char *data, size_t count)
{
    uint32_t a = 1;
    uint32_t b = 0;
    for (size_t i = 0; i < count; ++i) {
        a = (a + data[i]) % 65521;
        b = (b + a) % 65521;
    }
    return b << 16 | a;
}

void draw_deflate(const unsigned char *data, size_t count, struct draw_bytes *packed)
{
    static const unsigned char head[2] = {0x78, 0x01};
    struct packer packer = {.data = data, .count = count, .packed = packed};
    packer.newest = memory_array(HASH_SIZE, sizeof *packer.newest, "packing");
    packer.older = memory_array(FARTHEST, sizeof *packer.older, "packing");
    draw_bytes_add(packed, head, sizeof head);
    pack(&packer);
    const uint32_t sum = check_sum(data, count);
    const unsigned char end[4] = {(unsigned char)(sum >> 24), (unsigned char)(sum >> 16),
                                  (unsigned char)(sum >> 8), (unsigned char)sum};
    draw_bytes_add(packed, end, sizeof end);
    memory_free(packer.newest);
    memory_free(packer.older);
}
