/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/methods.h"

#include <stdio.h>
#include <string.h>

static const char *const names[METHOD_COUNT] = {[METHOD_MPM] = "mpm", [METHOD_SPH] = "sph", [METHOD_RKPM] = "rkpm",
                                                 [METHOD_DYNAMIC] = "rkpm, prob dynamic"};

const char *methods_name(enum method_name method)
{
    return names[method];
}

void methods_text(unsigned methods, const char *before, const char *after, const char *between, char *text, size_t size)
{
    text[0] = '\0';
    for (int m = 0; m < METHOD_COUNT; m++)
        if ((methods >> m & 1) && !(m == METHOD_DYNAMIC && (methods & METHODS_PROBLEM))) {
            const size_t length = strlen(text);
            snprintf(text + length, size - length, "%s%s%s%s", length > 0 ? between : "", before, names[m], after);
        }
}
