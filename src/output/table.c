/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/table.h"
#include "base/memory.h"
#include "base/status.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

bool table_open(struct table *table, const char *folder, const char *name, struct table_style style)
{
    size_t size = strlen(folder) + strlen(name) + 2;
    table->path = memory_array(size, 1, "a file name");
    snprintf(table->path, size, "%s%s%s", folder, *folder ? "/" : "", name);
    table->style = style;
    table->stream = fopen(table->path, "w");
    if (!table->stream)
        status_error("cannot create '%s': %s", table->path, strerror(errno));
    return table->stream != NULL;
}

bool table_open_job(struct table *table, const char *folder, const char *job, const char *ending, struct table_style style)
{
    size_t size = strlen(job) + strlen(ending) + 1;
    char *name = memory_array(size, 1, "a file name");
    snprintf(name, size, "%s%s", job, ending);
    bool good = table_open(table, folder, name, style);
    memory_free(name);
    return good;
}

/* Fortran's E format has the point before the first digit: shifts C's by one decade. */
static void write_fortran(FILE *stream, double value, int digits)
{
    char text[64];
    snprintf(text, sizeof text, "%.*e", digits - 1, value);
    char *exponent = strchr(text, 'e');
    if (!exponent) { /* not finite: runs stop before this */
        fprintf(stream, " %*s", digits + 7, text);
        return;
    }
    int power = atoi(exponent + 1) + (value != 0);
    bool is_negative = text[0] == '-';
    const char *mantissa = text + is_negative;
    char shifted[80];
    const char *form = power > 99 || power < -99 ? "%s0.%c%.*s%+04d" : "%s0.%c%.*sE%+03d";
    snprintf(shifted, sizeof shifted, form, is_negative ? "-" : "", mantissa[0], (int)(exponent - mantissa) - 2,
             mantissa + 2, power);
    fprintf(stream, "%*s", digits + 8, shifted);
}

void table_real(struct table *table, double value)
{
    int digits = table->style.digits;
    if (table->style.fortran)
        write_fortran(table->stream, value, digits);
    else
        fprintf(table->stream, " %*.*E", digits + 7, digits - 1, value);
}

static bool report(const struct table *table)
{
    status_error("cannot write '%s': %s", table->path, strerror(errno ? errno : EIO));
    return false;
}

bool table_flush(struct table *table)
{
    errno = 0;
    if (fflush(table->stream) != 0 || ferror(table->stream))
        return report(table);
    return true;
}

bool table_close(struct table *table)
{
    bool good = true;
    if (table->stream) {
        errno = 0;
        bool had_error = ferror(table->stream) != 0;
        if (fclose(table->stream) != 0 || had_error)
            good = report(table);
    }
    memory_free(table->path);
    *table = (struct table){0};
    return good;
}
