/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Why the last step of a run can't be trusted. */
#ifndef BASE_INSTABILITY_H
#define BASE_INSTABILITY_H

#include <stdbool.h>

struct instability {
    bool is_stopped;
    long particle; /* id from 0, or -1 */
    char cause[200];
    char advice[200];
};

#endif
