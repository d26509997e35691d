/* SPDX-License-Identifier: GPL-3.0-or-later */
#define _POSIX_C_SOURCE 200809L
#include "base/threads.h"

#include <time.h>
#ifdef _OPENMP
#include <omp.h>
#endif

void threads_set(int count)
{
#ifdef _OPENMP
    if (count > 0)
        omp_set_num_threads(count);
#else
    (void)count;
#endif
}

int threads_available(void)
{
#ifdef _OPENMP
    return omp_get_max_threads();
#else
    return 1;
#endif
}

int threads_self(void)
{
#ifdef _OPENMP
    return omp_get_thread_num();
#else
    return 0;
#endif
}

double threads_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
