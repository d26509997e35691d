/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Threads and clocks: OpenMP where the compiler has it, one thread otherwise. */
#ifndef BASE_THREADS_H
#define BASE_THREADS_H

/* Sets how many threads parallel loops may use; 0 keeps the default (all processors). */
void threads_set(int count);

/* How many threads parallel loops may use. */
int threads_available(void);

/* Number of the calling thread, from 0. */
int threads_self(void);

/* Seconds of wall time since some fixed moment. */
double threads_clock(void);

/* Makes threads that wait for each other go to sleep soon. OpenMP's default is to spin for
 * milliseconds, which on a machine with other work to do costs a factor of ten and more. Both
 * runtimes only look at the environment when they are loaded: where it does not say how to wait,
 * the program says so there and starts itself anew. To be called first in main. */
void threads_wait_briefly(char **arguments);

/* Hot loops over small vectors are compiled once for plain processors and once for AVX2, and
 * the faster fitting one is picked when the program is loaded. Products and sums are never
 * contracted (-ffp-contract=off), so both give the same bits. Clang's clones (up to 14 at least)
 * don't link across files: there NATIVE=1 is the way to faster loops. */
#if defined(__x86_64__) && defined(__linux__) && !defined(__clang__) && !defined(NO_CLONES)
#define THREADS_VECTORISED __attribute__((target_clones("avx2", "default")))
#else
#define THREADS_VECTORISED
#endif

/* Helpers of hot loops have to be compiled as part of the clone that calls them. */
#define THREADS_INLINE static inline __attribute__((always_inline))

#endif
