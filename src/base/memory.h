/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checked memory: no function here ever returns NULL for a nonzero size.
 * When memory runs out the program says what it was for and ends with STATUS_FILE. */
#ifndef BASE_MEMORY_H
#define BASE_MEMORY_H

#include <stddef.h>

/* A zeroed array of `count` elements of `size` bytes on a 64-byte boundary; NULL when count is 0.
 * `purpose` names it in the message when memory runs out. Free with memory_free. */
void *memory_array(size_t count, size_t size, const char *purpose);

/* Makes room for at least `needed` elements in an array that memory_array made, keeping its
 * contents; *capacity is the present and new room. Growth is geometric. Returns the array. */
void *memory_grow(void *array, size_t *capacity, size_t needed, size_t size, const char *purpose);

/* A copy of the first `length` characters of `text`, ended by NUL. */
char *memory_text(const char *text, size_t length);

/* Frees what the functions above made; NULL is accepted. */
void memory_free(void *array);

#endif
