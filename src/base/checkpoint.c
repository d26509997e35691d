/* SPDX-License-Identifier: GPL-3.0-or-later */
#define _POSIX_C_SOURCE 200809L
#include "base/checkpoint.h"
#include "base/checksum.h"
#include "base/memory.h"
#include "base/status.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

/* To be raised when the order or the meaning of the arrays changes. */
enum { VERSION_OF_FORMAT = 2 };

enum { NAME = 48, BLOCK = 1 << 20 };

static const char MAGIC[16] = "mpm3d checkpoint", END_MARK[16] = "checkpoint ends.";
static const uint32_t BYTE_ORDER_MARK = 0x01020304;

/* The parts of a file; each a multiple of CHECKSUM_BYTES long, as the arrays with their filling are. */
struct head {
    char magic[16];
    uint32_t version, byte_order;
    uint64_t unused;
};

struct item_head {
    char name[NAME];
    uint64_t size, count;
};

struct tail {
    char end_mark[16];
    uint64_t length; /* of the whole file */
    uint64_t checksum;
};

struct checkpoint {
    char *path, *part; /* its name, and the one under which it is written */
    FILE *stream;
    bool is_reading, is_good;
    uint64_t at; /* bytes from the start */
    struct checksum checksum;
    struct tail tail; /* of a file that is read */
};

/* "path" + ending; the caller frees it. */
static char *with_ending(const char *path, const char *ending)
{
    size_t size = strlen(path) + strlen(ending) + 1;
    char *name = memory_array(size, 1, "a file name");
    snprintf(name, size, "%s%s", path, ending);
    return name;
}

static struct checkpoint *open_stream(const char *path, bool is_reading)
{
    struct checkpoint *checkpoint = memory_array(1, sizeof *checkpoint, "a checkpoint");
    checkpoint->path = memory_text(path, strlen(path));
    checkpoint->part = is_reading ? NULL : with_ending(path, ".part");
    checkpoint->is_reading = is_reading;
    checkpoint->checksum = checksum_start();
    checkpoint->stream = fopen(is_reading ? path : checkpoint->part, is_reading ? "rb" : "wb");
    checkpoint->is_good = true;
    return checkpoint;
}

static void release(struct checkpoint *checkpoint)
{
    if (checkpoint->stream)
        fclose(checkpoint->stream);
    memory_free(checkpoint->path);
    memory_free(checkpoint->part);
    memory_free(checkpoint);
}

/* --- writing --- */

static void report_unwritten(struct checkpoint *checkpoint)
{
    if (checkpoint->is_good)
        status_error("cannot write the checkpoint '%s': %s", checkpoint->path, strerror(errno ? errno : EIO));
    checkpoint->is_good = false;
}

static void write_bytes(struct checkpoint *checkpoint, const void *bytes, size_t count)
{
    static const unsigned char filling[CHECKSUM_BYTES];
    const size_t rest = (CHECKSUM_BYTES - count % CHECKSUM_BYTES) % CHECKSUM_BYTES;
    errno = 0;
    if ((count > 0 && fwrite(bytes, 1, count, checkpoint->stream) != count) || fwrite(filling, 1, rest, checkpoint->stream) != rest)
        report_unwritten(checkpoint);
    checksum_add(&checkpoint->checksum, bytes, count);
    checkpoint->at += count + rest;
}

struct checkpoint *checkpoint_create(const char *path)
{
    struct checkpoint *checkpoint = open_stream(path, false);
    if (!checkpoint->stream) {
        report_unwritten(checkpoint);
        release(checkpoint);
        return NULL;
    }
    struct head head = {.version = VERSION_OF_FORMAT, .byte_order = BYTE_ORDER_MARK};
    memcpy(head.magic, MAGIC, sizeof head.magic);
    write_bytes(checkpoint, &head, sizeof head);
    return checkpoint;
}

/* A new name is on the disk only when its folder is. Where folders can't be opened that is no failure. */
static void sync_folder(const char *path)
{
    const char *slash = strrchr(path, '/');
    char *folder = slash == path ? memory_text("/", 1) : slash ? memory_text(path, (size_t)(slash - path)) : memory_text(".", 1);
    int file = open(folder, O_RDONLY);
    if (file >= 0) {
        (void)fsync(file);
        close(file);
    }
    memory_free(folder);
}

/* Gives the new file its name; the one that had it becomes NAME.old. That comes last: a run may have gone on from
 * NAME.old because NAME was damaged, so at each moment one of the two names is that of a whole checkpoint. */
static bool take_name(const struct checkpoint *checkpoint)
{
    char *old = with_ending(checkpoint->path, ".old"), *kept = with_ending(checkpoint->path, ".kept");
    (void)unlink(kept);
    const bool is_kept = link(checkpoint->path, kept) == 0;
    if (!is_kept && errno != ENOENT)
        (void)rename(checkpoint->path, old); /* on file systems without links */
    const int failure = rename(checkpoint->part, checkpoint->path) == 0 ? 0 : errno;
    if (is_kept && !failure)
        (void)rename(kept, old);
    (void)unlink(kept);
    memory_free(old);
    memory_free(kept);
    errno = failure;
    return !failure;
}

static bool finish(struct checkpoint *checkpoint)
{
    struct tail tail = {.length = checkpoint->at + sizeof tail, .checksum = checksum_value(&checkpoint->checksum)};
    memcpy(tail.end_mark, END_MARK, sizeof tail.end_mark);
    if (checkpoint->is_good)
        write_bytes(checkpoint, &tail, sizeof tail);
    errno = 0;
    if (checkpoint->is_good && (fflush(checkpoint->stream) != 0 || fsync(fileno(checkpoint->stream)) != 0))
        report_unwritten(checkpoint);
    if (fclose(checkpoint->stream) != 0)
        report_unwritten(checkpoint);
    checkpoint->stream = NULL;
    if (checkpoint->is_good && !take_name(checkpoint))
        report_unwritten(checkpoint);
    if (checkpoint->is_good)
        sync_folder(checkpoint->path);
    else
        (void)unlink(checkpoint->part);
    return checkpoint->is_good;
}

/* --- checking --- */

static bool refuse(struct checkpoint *checkpoint, const char *reason)
{
    status_error("'%s' %s", checkpoint->path, reason);
    checkpoint->is_good = false;
    return false;
}

static bool refuse_unread(struct checkpoint *checkpoint)
{
    status_error("cannot read the checkpoint '%s': %s", checkpoint->path, strerror(errno ? errno : EIO));
    checkpoint->is_good = false;
    return false;
}

static bool check_head(struct checkpoint *checkpoint)
{
    struct head head;
    errno = 0;
    const bool is_read = fread(&head, sizeof head, 1, checkpoint->stream) == 1;
    if (!is_read && ferror(checkpoint->stream))
        return refuse_unread(checkpoint);
    if (!is_read || memcmp(head.magic, MAGIC, sizeof MAGIC) != 0)
        return refuse(checkpoint, "is no checkpoint of mpm3d");
    if (head.byte_order != BYTE_ORDER_MARK)
        return refuse(checkpoint, "is damaged, or comes from a machine with another order of bytes");
    if (head.version != VERSION_OF_FORMAT) {
        status_error("'%s' is a checkpoint of version %lu; this program reads version %d", checkpoint->path,
                     (unsigned long)head.version, VERSION_OF_FORMAT);
        return checkpoint->is_good = false;
    }
    checksum_add(&checkpoint->checksum, &head, sizeof head);
    checkpoint->at = sizeof head;
    return true;
}

/* The end of the file: that it is there, and where it should be. */
static bool check_tail(struct checkpoint *checkpoint)
{
    errno = 0;
    if (fseeko(checkpoint->stream, 0, SEEK_END) != 0)
        return refuse_unread(checkpoint);
    const off_t length = ftello(checkpoint->stream);
    if (length < (off_t)(sizeof(struct head) + sizeof(struct tail)))
        return refuse(checkpoint, "is not whole: its end is missing");
    if (fseeko(checkpoint->stream, length - (off_t)sizeof(struct tail), SEEK_SET) != 0
        || fread(&checkpoint->tail, sizeof(struct tail), 1, checkpoint->stream) != 1
        || fseeko(checkpoint->stream, (off_t)sizeof(struct head), SEEK_SET) != 0)
        return refuse_unread(checkpoint);
    if (memcmp(checkpoint->tail.end_mark, END_MARK, sizeof END_MARK) != 0 || checkpoint->tail.length != (uint64_t)length)
        return refuse(checkpoint, "is not whole: its end is missing or damaged");
    return true;
}

/* Goes over the whole file once before anything is taken from it. */
static bool check_content(struct checkpoint *checkpoint)
{
    uint64_t left = checkpoint->tail.length - sizeof(struct head) - sizeof(struct tail);
    char *block = memory_array(left < BLOCK ? (size_t)left : BLOCK, 1, "a checkpoint");
    while (left > 0 && checkpoint->is_good) {
        const size_t count = left < BLOCK ? (size_t)left : BLOCK;
        errno = 0;
        if (fread(block, 1, count, checkpoint->stream) != count)
            refuse_unread(checkpoint);
        checksum_add(&checkpoint->checksum, block, count);
        left -= count;
    }
    memory_free(block);
    if (checkpoint->is_good && checksum_value(&checkpoint->checksum) != checkpoint->tail.checksum)
        return refuse(checkpoint, "is damaged: its checksum is wrong");
    if (checkpoint->is_good && fseeko(checkpoint->stream, (off_t)sizeof(struct head), SEEK_SET) != 0)
        return refuse_unread(checkpoint);
    return checkpoint->is_good;
}

struct checkpoint *checkpoint_open(const char *path)
{
    struct checkpoint *checkpoint = open_stream(path, true);
    if (!checkpoint->stream)
        refuse_unread(checkpoint);
    else if (check_head(checkpoint) && check_tail(checkpoint) && check_content(checkpoint))
        return checkpoint;
    release(checkpoint);
    return NULL;
}

/* --- items --- */

bool checkpoint_is_reading(const struct checkpoint *checkpoint)
{
    return checkpoint->is_reading;
}

bool checkpoint_is_good(const struct checkpoint *checkpoint)
{
    return checkpoint->is_good;
}

void checkpoint_reject(struct checkpoint *checkpoint, const char *name)
{
    if (checkpoint->is_good)
        status_error("the checkpoint '%s' does not fit this deck and program: %s", checkpoint->path, name);
    checkpoint->is_good = false;
}

void checkpoint_fail(struct checkpoint *checkpoint)
{
    checkpoint->is_good = false;
}

size_t checkpoint_left(const struct checkpoint *checkpoint)
{
    if (!checkpoint->is_reading)
        return SIZE_MAX;
    return checkpoint->is_good ? (size_t)(checkpoint->tail.length - sizeof(struct tail) - checkpoint->at) : 0;
}

/* Reads bytes with their filling, not beyond the end mark. */
static void read_bytes(struct checkpoint *checkpoint, void *bytes, size_t count)
{
    unsigned char filling[CHECKSUM_BYTES];
    const size_t rest = (CHECKSUM_BYTES - count % CHECKSUM_BYTES) % CHECKSUM_BYTES;
    errno = 0;
    if (count + rest > checkpoint_left(checkpoint))
        refuse(checkpoint, "is too short");
    else if ((count > 0 && fread(bytes, 1, count, checkpoint->stream) != count) || fread(filling, 1, rest, checkpoint->stream) != rest)
        refuse_unread(checkpoint);
    checkpoint->at += count + rest;
}

static void read_item(struct checkpoint *checkpoint, const struct item_head *expected, void *data)
{
    struct item_head found = {0};
    read_bytes(checkpoint, &found, sizeof found);
    if (!checkpoint->is_good)
        return;
    if (strncmp(found.name, expected->name, NAME) != 0 || found.size != expected->size || found.count != expected->count)
        checkpoint_reject(checkpoint, expected->name);
    else
        read_bytes(checkpoint, data, (size_t)(found.size * found.count));
}

bool checkpoint_item(struct checkpoint *checkpoint, const char *name, void *data, size_t size, size_t count)
{
    struct item_head head = {.size = size, .count = count};
    snprintf(head.name, NAME, "%s", name);
    if (!checkpoint->is_good)
        return false;
    if (checkpoint->is_reading) {
        read_item(checkpoint, &head, data);
    } else {
        write_bytes(checkpoint, &head, sizeof head);
        if (checkpoint->is_good)
            write_bytes(checkpoint, data, size * count);
    }
    return checkpoint->is_good;
}

size_t checkpoint_count(struct checkpoint *checkpoint, const char *name, size_t count, size_t most)
{
    uint64_t number = count;
    checkpoint_item(checkpoint, name, &number, sizeof number, 1);
    if (number > most)
        checkpoint_reject(checkpoint, name);
    return checkpoint->is_good || !checkpoint->is_reading ? (size_t)number : 0;
}

bool checkpoint_close(struct checkpoint *checkpoint)
{
    bool is_good;
    if (checkpoint->is_reading && checkpoint->is_good && checkpoint->at != checkpoint->tail.length - sizeof(struct tail))
        checkpoint_reject(checkpoint, "it holds more");
    is_good = checkpoint->is_reading ? checkpoint->is_good : finish(checkpoint);
    release(checkpoint);
    return is_good;
}
