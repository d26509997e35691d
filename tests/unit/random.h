/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random numbers of the tests: the same on every machine (splitmix64, Steele, Lea, Flood 2014). */
#ifndef UNIT_RANDOM_H
#define UNIT_RANDOM_H

#include <stdint.h>

struct random {
    uint64_t state;
};

static inline uint64_t random_bits(struct random *random)
{
    uint64_t z = random->state += UINT64_C(0x9E3779B97F4A7C15);
    z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
    return z ^ (z >> 31);
}

/* In low ... high, with 53 random bits. */
static inline double random_between(struct random *random, double low, double high)
{
    return low + (high - low) * (double)(random_bits(random) >> 11) * 0x1p-53;
}

/* In 0 ... count - 1. */
static inline int random_below(struct random *random, int count)
{
    return (int)(random_bits(random) % (uint64_t)count);
}

#endif
