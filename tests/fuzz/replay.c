/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gives files to a fuzz target, without libFuzzer: fuzz_replay FILE... prints `ok FILE` for each that is read within a
 * second, else `FAIL FILE: why`. A file whose name begins with good_ has to be taken, one with bad_ refused. A crash
 * ends the program. */
#define _POSIX_C_SOURCE 200809L
#include "fuzz.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { LARGEST = 1 << 20 };

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static bool begins_with(const char *path, const char *start)
{
    const char *slash = strrchr(path, '/');
    return strncmp(slash ? slash + 1 : path, start, strlen(start)) == 0;
}

static int replay(const char *path, uint8_t *bytes)
{
    FILE *stream = fopen(path, "rb");
    if (!stream) {
        printf("FAIL %s: it can't be read\n", path);
        return 1;
    }
    size_t size = fread(bytes, 1, LARGEST, stream);
    fclose(stream);
    double start = seconds();
    const bool is_taken = fuzz_read(bytes, size);
    double spent = seconds() - start;
    if (begins_with(path, is_taken ? "bad_" : "good_")) {
        printf("FAIL %s: it is %s\n", path, is_taken ? "taken" : "refused");
        return 1;
    }
    if (spent > 1) {
        printf("FAIL %s: it took %.1f s\n", path, spent);
        return 1;
    }
    printf("ok %s\n", path);
    return 0;
}

int main(int count, char **arguments)
{
    int failed = 0;
    uint8_t *bytes = malloc(LARGEST);
    if (!bytes)
        return 4;
    for (int i = 1; i < count; i++)
        failed += replay(arguments[i], bytes);
    printf("%d passed, %d failed\n", count - 1 - failed, failed);
    free(bytes);
    return failed > 0;
}
