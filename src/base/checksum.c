/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/checksum.h"

#include <string.h>

static const uint64_t FACTOR = UINT64_C(0x9E3779B185EBCA87); /* odd: multiplying is one to one */

struct checksum checksum_start(void)
{
    return (struct checksum){.sum = {1, 2, 3, 4}};
}

static void add_words(struct checksum *checksum, const unsigned char *bytes)
{
    uint64_t word[4];
    memcpy(word, bytes, sizeof word);
    for (int i = 0; i < 4; i++) {
        uint64_t sum = (checksum->sum[i] ^ word[i]) * FACTOR;
        checksum->sum[i] = sum << 31 | sum >> 33;
    }
}

void checksum_add(struct checksum *checksum, const void *bytes, size_t count)
{
    const unsigned char *from = bytes;
    size_t i = 0;
    for (; i + CHECKSUM_BYTES <= count; i += CHECKSUM_BYTES)
        add_words(checksum, from + i);
    if (i < count) {
        unsigned char last[CHECKSUM_BYTES] = {0};
        memcpy(last, from + i, count - i);
        add_words(checksum, last);
    }
}

uint64_t checksum_value(const struct checksum *checksum)
{
    uint64_t value = 0;
    for (int i = 0; i < 4; i++) {
        value = (value ^ checksum->sum[i]) * FACTOR;
        value ^= value >> 32;
    }
    return value;
}
