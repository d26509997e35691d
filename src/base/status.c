/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/status.h"

#include <stdarg.h>
#include <stdio.h>

static void print(const char *kind, const char *format, va_list arguments)
{
    fflush(stdout);
    fprintf(stderr, "mpm3d: %s: ", kind);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
}

void status_error(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print("error", format, arguments);
    va_end(arguments);
}

void status_warning(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print("warning", format, arguments);
    va_end(arguments);
}
