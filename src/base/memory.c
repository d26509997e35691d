/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/memory.h"
#include "base/status.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { ALIGNMENT = 64 };

static void out_of_memory(size_t count, size_t size, const char *purpose)
{
    status_error("not enough memory for %s (%zu elements of %zu bytes)", purpose, count, size);
    exit(STATUS_FILE);
}

void *memory_array(size_t count, size_t size, const char *purpose)
{
    if (count == 0 || size == 0)
        return NULL;
    if (count > (SIZE_MAX / 2 - ALIGNMENT) / size)
        out_of_memory(count, size, purpose);
    size_t bytes = (count * size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    void *array = aligned_alloc(ALIGNMENT, bytes);
    if (!array)
        out_of_memory(count, size, purpose);
    memset(array, 0, bytes);
    return array;
}

void *memory_grow(void *array, size_t *capacity, size_t needed, size_t size, const char *purpose)
{
    if (needed <= *capacity)
        return array;
    size_t grown = *capacity < SIZE_MAX / 4 ? *capacity * 2 : *capacity;
    if (grown < needed)
        grown = needed;
    if (grown < 8)
        grown = 8;
    void *larger = memory_array(grown, size, purpose);
    if (array)
        memcpy(larger, array, *capacity * size);
    memory_free(array);
    *capacity = grown;
    return larger;
}

char *memory_text(const char *text, size_t length)
{
    char *copy = memory_array(length + 1, 1, "a piece of text");
    memcpy(copy, text, length);
    return copy;
}

void memory_free(void *array)
{
    free(array);
}
