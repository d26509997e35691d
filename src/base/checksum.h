/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A checksum of 64 bits, as fast as memory. Four sums, each over every fourth word of 8 bytes; each step is
 * one to one in the sum and in the word, so that no change of a single word goes unnoticed, and any other
 * change does with a chance of 2^-64. Numbers are taken in this machine's byte order. */
#ifndef BASE_CHECKSUM_H
#define BASE_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>

enum { CHECKSUM_BYTES = 32 }; /* taken at a time */

struct checksum {
    uint64_t sum[4];
};

struct checksum checksum_start(void);

/* Adds `count` bytes. A count that is no multiple of CHECKSUM_BYTES is filled up with zeros. */
void checksum_add(struct checksum *checksum, const void *bytes, size_t count);

uint64_t checksum_value(const struct checksum *checksum);

#endif
