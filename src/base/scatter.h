/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers that look random and depend on their arguments alone: the same on every machine (splitmix64, Steele, Lea, Flood 2014). */
#ifndef BASE_SCATTER_H
#define BASE_SCATTER_H

#include <stdint.h>

/* Between -1/2 and 1/2, for number `index` of a seed and one of three axes. */
static inline double scatter(uint64_t seed, uint64_t index, uint64_t axis)
{
    uint64_t x = seed * UINT64_C(0x9e3779b97f4a7c15) + index * 3 + axis + 1;
    x *= UINT64_C(0x9e3779b97f4a7c15);
    x = (x ^ (x >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    x = (x ^ (x >> 27)) * UINT64_C(0x94d049bb133111eb);
    x ^= x >> 31;
    return (double)(x >> 11) / 9007199254740992.0 - 0.5;
}

#endif
