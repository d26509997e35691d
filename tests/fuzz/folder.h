/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A folder of a target's own, in memory where the machine has such a place; gone when the program ends. */
#ifndef FUZZ_FOLDER_H
#define FUZZ_FOLDER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { FOLDER_PATH = 200, FOLDER_FILES = 16 };

/* The files of a folder as they are to be. */
struct folder {
    char path[FOLDER_PATH];
    struct folder_file {
        char name[64];
        uint8_t *bytes;
        size_t size;
    } files[FOLDER_FILES];
    int count;
};

/* An empty folder, made; the program ends where that is not possible, as in all functions here. */
void folder_make(struct folder *folder);

/* Writes a file, under a path that goes to `path` (FOLDER_PATH characters) unless that is NULL. */
void folder_write(const struct folder *folder, const char *name, const void *bytes, size_t size, char *path);

/* Keeps the files that are there now; folder_restore takes all others away and writes these anew. */
void folder_keep(struct folder *folder);
void folder_restore(const struct folder *folder);

/* Whether the files that are there are those kept, by name and size; `but` is not looked at. */
bool folder_is_kept(const struct folder *folder, const char *but);

/* The kept file of that name. */
const struct folder_file *folder_find(const struct folder *folder, const char *name);

#endif
