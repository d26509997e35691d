/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files that hold the state of a run: named arrays one behind the other, between a head (what it is, version,
 * byte order) and an end mark with length and checksum. One function goes over the same list of arrays to write
 * and to read them, so that both agree.
 *
 * A file is written under another name, brought to the disk, and then gets its name at once; the file that had
 * it before is kept as NAME.old. What is read is checked as a whole before anything is taken from it. */
#ifndef BASE_CHECKPOINT_H
#define BASE_CHECKPOINT_H

#include <stdbool.h>
#include <stddef.h>

struct checkpoint;

/* Starts to write `path`. NULL, after a message, when that is not possible. */
struct checkpoint *checkpoint_create(const char *path);

/* Opens `path` to read. NULL, after a message, when it is no whole checkpoint of this version. */
struct checkpoint *checkpoint_open(const char *path);

bool checkpoint_is_reading(const struct checkpoint *checkpoint);
bool checkpoint_is_good(const struct checkpoint *checkpoint); /* up to now */

/* Writes `count` elements of `size` bytes, or reads them: then name, size and count must be those of the file.
 * After a failure, which is reported, nothing happens any more. Returns whether all was good up to now. */
bool checkpoint_item(struct checkpoint *checkpoint, const char *name, void *data, size_t size, size_t count);

/* Writes a number of elements that follow, or reads it: at most `most`, else that is a
 * failure, and 0. */
size_t checkpoint_count(struct checkpoint *checkpoint, const char *name, size_t count, size_t most);

/* Bytes that can still be read; SIZE_MAX where the file is written. */
size_t checkpoint_left(const struct checkpoint *checkpoint);

/* Ends the exchange after a failure: says that item `name` does not fit; or the caller has said why. */
void checkpoint_reject(struct checkpoint *checkpoint, const char *name);
void checkpoint_fail(struct checkpoint *checkpoint);

/* Ends reading or writing: returns whether all of it was good; a file that was written has its name then. */
bool checkpoint_close(struct checkpoint *checkpoint);

#endif
