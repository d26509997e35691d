/* SPDX-License-Identifier: GPL-3.0-or-later */
#define _POSIX_C_SOURCE 200809L
#include "output/table.h"
#include "base/checksum.h"
#include "base/memory.h"
#include "base/status.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MARKED_BYTES = 4096, LINE_ROOM = 1 << 16, ZONE_ROOM = 1 << 22 };

bool table_open(struct table *table, const char *folder, const char *name, struct table_style style, enum table_mode mode)
{
    size_t size = strlen(folder) + strlen(name) + 2;
    table->path = memory_array(size, 1, "a file name");
    snprintf(table->path, size, "%s%s%s", folder, *folder ? "/" : "", name);
    table->style = style;
    table->stream = fopen(table->path, mode == TABLE_NEW ? "w+" : "r+");
    if (!table->stream)
        status_error("cannot %s '%s': %s", mode == TABLE_NEW ? "create" : "continue", table->path, strerror(errno));
    return table->stream != NULL;
}

bool table_open_job(struct table *table, const char *folder, const char *job, const char *ending, struct table_style style,
                    enum table_mode mode)
{
    size_t size = strlen(job) + strlen(ending) + 1;
    char *name = memory_array(size, 1, "a file name");
    snprintf(name, size, "%s%s", job, ending);
    bool good = table_open(table, folder, name, style, mode);
    memory_free(name);
    return good;
}

/* Fortran's E format has the point before the first digit: shifts C's by one decade. False when it can't be written. */
static bool write_fortran(FILE *stream, double value, int digits)
{
    char text[64];
    snprintf(text, sizeof text, "%.*e", digits - 1, value);
    char *exponent = strchr(text, 'e');
    if (!exponent) /* not finite: runs stop before this */
        return fprintf(stream, " %*s", digits + 7, text) >= 0;
    int power = atoi(exponent + 1) + (value != 0);
    bool is_negative = text[0] == '-';
    const char *mantissa = text + is_negative;
    char shifted[80];
    const char *form = power > 99 || power < -99 ? "%s0.%c%.*s%+04d" : "%s0.%c%.*sE%+03d";
    snprintf(shifted, sizeof shifted, form, is_negative ? "-" : "", mantissa[0], (int)(exponent - mantissa) - 2,
             mantissa + 2, power);
    return fprintf(stream, "%*s", digits + 8, shifted) >= 0;
}

void table_real(struct table *table, double value)
{
    int digits = table->style.digits;
    bool is_written;
    errno = 0;
    if (table->style.fortran)
        is_written = write_fortran(table->stream, value, digits);
    else
        is_written = fprintf(table->stream, " %*.*E", digits + 7, digits - 1, value) >= 0;
    if (!is_written && !table->failure)
        table->failure = errno;
}

static bool report(const struct table *table)
{
    const int failure = table->failure ? table->failure : errno ? errno : EIO;
    status_error("cannot write '%s': %s", table->path, strerror(failure));
    return false;
}

static void use_buffer(struct table *table, int mode, size_t size)
{
    table->buffer = memory_array(size, 1, "output");
    setvbuf(table->stream, table->buffer, mode, size);
}

void table_by_lines(struct table *table)
{
    use_buffer(table, _IOLBF, LINE_ROOM);
}

void table_by_zones(struct table *table)
{
    use_buffer(table, _IOFBF, ZONE_ROOM);
}

void table_end_line(struct table *table)
{
    errno = 0;
    if (fputc('\n', table->stream) == EOF && !table->failure)
        table->failure = errno;
}

bool table_flush(struct table *table)
{
    errno = 0;
    if (fflush(table->stream) != 0 || ferror(table->stream))
        return report(table);
    return true;
}

/* The last bytes before `length`; false when they can't be read. */
static bool sum_tail(const struct table *table, int64_t length, uint64_t *value)
{
    char bytes[MARKED_BYTES];
    const size_t count = length < MARKED_BYTES ? (size_t)length : MARKED_BYTES;
    struct checksum checksum = checksum_start();
    errno = 0;
    if (count > 0 && pread(fileno(table->stream), bytes, count, (off_t)length - (off_t)count) != (ssize_t)count)
        return false;
    checksum_add(&checksum, bytes, count);
    *value = checksum_value(&checksum);
    return true;
}

/* What is no plain file, as /dev/null, has no length. */
static bool find_length(const struct table *table, int64_t *length)
{
    struct stat found;
    errno = 0;
    if (fstat(fileno(table->stream), &found) != 0)
        return false;
    *length = S_ISREG(found.st_mode) ? (int64_t)found.st_size : 0;
    return true;
}

bool table_set_mark(struct table *table, struct table_mark *mark)
{
    if (!table_flush(table))
        return false;
    if (!find_length(table, &mark->length) || !sum_tail(table, mark->length, &mark->checksum))
        return report(table);
    if (mark->length > 0 && fsync(fileno(table->stream)) != 0)
        return report(table);
    return true;
}

bool table_has_mark(const struct table *table, const struct table_mark *mark)
{
    int64_t length;
    uint64_t checksum;
    if (!find_length(table, &length))
        return report(table);
    if (length >= mark->length && sum_tail(table, mark->length, &checksum) && checksum == mark->checksum)
        return true;
    status_error("cannot continue '%s': it is not the file that the checkpoint goes with%s", table->path,
                 length < mark->length ? ", or was cut off" : "");
    return false;
}

bool table_return_to(struct table *table, const struct table_mark *mark)
{
    int64_t length;
    errno = 0;
    if (!find_length(table, &length) || (length > mark->length && ftruncate(fileno(table->stream), (off_t)mark->length) != 0)
        || fseeko(table->stream, (off_t)mark->length, SEEK_SET) != 0)
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
    memory_free(table->buffer);
    *table = (struct table){0};
    return good;
}
