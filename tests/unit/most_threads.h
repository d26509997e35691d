/* SPDX-License-Identifier: GPL-3.0-or-later */
/* LLVM's OpenMP loses some memory of its own where a team grows beyond the processors of the machine, which the leak sanitizer
 * reports. Tests on more threads than a machine may have begin with the largest team. */
#ifndef UNIT_MOST_THREADS_H
#define UNIT_MOST_THREADS_H

#include "base/threads.h"

static inline void begin_with_threads(int count)
{
    const int threads = threads_available();
    threads_set(count);
#pragma omp parallel
    {
        (void)threads_self();
    }
    threads_set(threads);
}

#endif
