/* SPDX-License-Identifier: GPL-3.0-or-later */
#define _XOPEN_SOURCE 700
#include "folder.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_FOLDERS = 8, LARGEST = 1 << 20 };

/* What is to be taken away at the end. */
static struct {
    char path[MOST_FOLDERS][FOLDER_PATH];
    int count;
} made;

static void fail(const char *what, const char *path)
{
    fprintf(stderr, "fuzz: cannot %s '%s'\n", what, path);
    exit(4);
}

static void join(char path[FOLDER_PATH], const char *folder, const char *name)
{
    if (snprintf(path, FOLDER_PATH, "%s/%s", folder, name) >= FOLDER_PATH)
        fail("name", name);
}

/* Calls `visit` for the path of each file. */
static void each_file(const char *folder, void (*visit)(void *context, const char *path, const char *name), void *context)
{
    DIR *files = opendir(folder);
    char path[FOLDER_PATH];
    for (struct dirent *entry; files && (entry = readdir(files));)
        if (entry->d_name[0] != '.') {
            join(path, folder, entry->d_name);
            visit(context, path, entry->d_name);
        }
    if (files)
        closedir(files);
}

static void take_away(void *context, const char *path, const char *name)
{
    const struct folder *folder = context;
    if (!folder || !folder_find(folder, name))
        (void)remove(path);
}

static void remove_folders(void)
{
    for (int i = 0; i < made.count; i++) {
        each_file(made.path[i], take_away, NULL);
        (void)rmdir(made.path[i]);
    }
}

void folder_make(struct folder *folder)
{
    static const char *const places[] = {"/dev/shm", "/tmp"};
    bool is_made = false;
    *folder = (struct folder){.count = 0};
    for (int i = 0; i < 2 && !is_made; i++) {
        join(folder->path, places[i], "mpm3d_fuzz_XXXXXX");
        is_made = access(places[i], W_OK) == 0 && mkdtemp(folder->path);
    }
    if (!is_made || made.count == MOST_FOLDERS)
        fail("make the folder", folder->path);
    if (made.count == 0 && atexit(remove_folders) != 0)
        fail("look after", folder->path);
    memcpy(made.path[made.count++], folder->path, FOLDER_PATH);
}

void folder_write(const struct folder *folder, const char *name, const void *bytes, size_t size, char *path)
{
    char own[FOLDER_PATH];
    join(own, folder->path, name);
    FILE *stream = fopen(own, "wb");
    if (!stream || (size > 0 && fwrite(bytes, 1, size, stream) != size) || fclose(stream) != 0)
        fail("write", own);
    if (path)
        memcpy(path, own, FOLDER_PATH);
}

static void keep_file(void *context, const char *path, const char *name)
{
    struct folder *folder = context;
    struct folder_file *file = &folder->files[folder->count];
    FILE *stream = fopen(path, "rb");
    if (folder->count == FOLDER_FILES || strlen(name) >= sizeof file->name || !stream || !(file->bytes = malloc(LARGEST)))
        fail("keep", path);
    memcpy(file->name, name, strlen(name) + 1);
    file->size = fread(file->bytes, 1, LARGEST, stream);
    if (file->size == LARGEST || fclose(stream) != 0)
        fail("keep", path);
    uint8_t *fitting = realloc(file->bytes, file->size + 1);
    file->bytes = fitting ? fitting : file->bytes;
    folder->count++;
}

void folder_keep(struct folder *folder)
{
    each_file(folder->path, keep_file, folder);
}

void folder_restore(const struct folder *folder)
{
    each_file(folder->path, take_away, (void *)(uintptr_t)folder);
    for (int i = 0; i < folder->count; i++)
        folder_write(folder, folder->files[i].name, folder->files[i].bytes, folder->files[i].size, NULL);
}

const struct folder_file *folder_find(const struct folder *folder, const char *name)
{
    for (int i = 0; i < folder->count; i++)
        if (strcmp(folder->files[i].name, name) == 0)
            return &folder->files[i];
    return NULL;
}

/* Counts the files, and those that are as kept. */
struct comparison {
    const struct folder *folder;
    const char *but;
    int count, kept;
};

static void compare(void *context, const char *path, const char *name)
{
    struct comparison *comparison = context;
    const struct folder_file *file = folder_find(comparison->folder, name);
    struct stat found;
    comparison->count++;
    comparison->kept += strcmp(name, comparison->but) == 0
                     || (file && stat(path, &found) == 0 && (uintmax_t)found.st_size == file->size);
}

bool folder_is_kept(const struct folder *folder, const char *but)
{
    struct comparison comparison = {folder, but, 0, 0};
    each_file(folder->path, compare, &comparison);
    return comparison.count == folder->count && comparison.kept == folder->count;
}
