/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Goes on from files that are almost checkpoints. Each is made of a true one, of a run of one of the small decks below
 * that was just written, so that kept inputs do not grow old with the format:
 *
 *   first byte    the deck: '0', '1', ...
 *   second byte   e: what follows are edits, a line each; p: patches of bytes; both get the right length and checksum
 *                 at the end; r: patches, and the end stays as it was
 *   an edit       KIND:ITEM:INDEX:VALUE, such as `real:position:3:nan`, `int32:known lost:0:99`, `count:shown::7`
 *   a patch       two bytes, place in the file, low byte first; a byte, number; and so many bytes; 0: the file ends there
 *
 * What is refused must not have changed a file of the run; what is taken goes on for some steps. Returns whether it was
 * taken. */
#define _POSIX_C_SOURCE 200809L
#include "base/checksum.h"
#include "folder.h"
#include "fuzz.h"
#include "restart.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAME = 48, ITEMS = 128, GROWTH = 512, LARGEST = 1 << 17, HEAD = 32, ITEM_HEAD = 64, TAIL = 32 };

/* --- decks --- */

static const char of_bodies[] =
    "mpm3d two bodies that meet, and points that have left the grid\n"
    "nbco 2\nnbbo 3\nnbmp 8\nnmat 2\ngrid 0 4 0 4 0 4\ndcel 1\nfixed 2 0 0 0 0 0\n"
    "mate\n1 elas 1e-3 100 0.3\n2 john 2e-3 200 0.3 1 0.1 0.5 0.01 0.6 1e-3 1000 300 800\n"
    "part bloc 1\n1 1e-3 0.5 1 1 1 2 2 1\npart bloc 2\n2 2e-3 0.5 2 1 1 1 2 1\n"
    "part poin 1 2\n7 1 1e-3 -1 1 1\n8 1 1e-3 2 9 9\n"
    "cont lagr 0.2 0\nvelo\nbody 1 1 0 0\nendv\nlost keep write\nendt 1\noutt 0.5\n"
    "tecp\noutr seqv\noutr epef\noutr fail\ncurv velx 1\nendi\n";

static const char of_openings[] =
    "mpm3d a part that opens point by point, with heat around the last one\n"
    "nbco 1\nnbbo 1\nnbmp 8\nnmat 1\ngrid 0 2 0 2 0 2\ndcel 0.5\nfixed 0 0 0 0 1 0\n"
    "mate\n1 elas 1e-3 100 0.3\npart bloc 1\n1 1e-3 0.25 0.5 0.5 0 2 2 2\n"
    "Ghost\nGPD 1 2 1\nendG\nbuil z\nscan raster serpentine 0 45\nopen point every 1\nopen settle 2\n"
    "resi 1 -5 -2 0\nther 1 1e-5 100 0.3\nfixn -9 9 -9 9 0 0 1 1 1\n"
    "endt 1\noutt 1e-9\npara ascii\noutr seqv\noutr laye\noutr ghos\ncurv seqv 1\nendi\n";

static const char of_equilibria[] =
    "mpm3d a part in balance after each opening\n"
    "nbco 1\nnbbo 1\nnbmp 12\nnmat 1\ngrid 0 1 0 1 0 2\ndcel 0.5\nmate\n1 elas 1e-3 100 0.3\n"
    "part bloc 1\n1 1e-3 0.25 0.25 0.25 0 2 2 3\nGhost\nendG\nresi 1 -5 -2 0\nscan 0 45\n"
    "fixn -9 9 -9 9 0 0 1 1 1\nopen layer every 3\nquas 1e-6\nendt 1\noutt 1\noutr seqv\noutr disz\ncurv seqv 1\nendi\n";

static const char of_liquid[] =
    "mpm3d liquid that flies out of the grid, with heat and surface tension\n"
    "meth sph\nnbbo 1\nnbmp 12\nnmat 1\ngrid 0 1 0 1 -1 1\nsph\ndime 2\nc0 10\ncsf bala\nheat enth\nends\n"
    "mate\n1 flui 1 1e-3\nprop 1 capa 1 293 1\nprop 1 cond 1 293 1e-3\nprop 1 surf 1 293 1e-3\n"
    "part bloc 1\n1 1 0.1 0.6 0.3 0 4 3 1\nvelo\nbody 1 5 0 0\nendv\nlost keep write\nendt 1\noutt 0.5\n"
    "tecp\noutr pres\ncurv remo\nendi\n";

static const struct {
    const char *text;
    int steps, steps_more; /* up to the checkpoint, and from it; equilibria with other particles than theirs take seconds */
} decks[] = {{of_bodies, 2, 2}, {of_openings, 4, 2}, {of_equilibria, 1, 0}, {of_liquid, 6, 6}};

enum { DECKS = sizeof decks / sizeof decks[0] };

/* --- the checkpoint of a deck --- */

/* An array of the file. */
struct item {
    char name[NAME];
    uint64_t size, count;
    uint8_t *bytes;
    size_t length;
    int copies;
};

/* A run up to its checkpoint, and what that holds. */
struct original {
    struct folder folder;
    char deck[FOLDER_PATH], checkpoint[FOLDER_PATH];
    uint8_t head[HEAD];
    struct item items[ITEMS];
    size_t n_items;
    uint8_t *file;
    size_t size;
};

static void demand(bool holds, const char *what)
{
    if (holds)
        return;
    fprintf(stderr, "fuzz: %s\n", what);
    abort();
}

static size_t padded(size_t length)
{
    return (length + CHECKSUM_BYTES - 1) / CHECKSUM_BYTES * CHECKSUM_BYTES;
}

/* Cuts the file into its items. */
static void take_apart(struct original *original)
{
    const uint8_t *at = original->file + HEAD, *end = original->file + original->size - TAIL;
    memcpy(original->head, original->file, HEAD);
    while (at < end) {
        struct item *item = &original->items[original->n_items++];
        demand(original->n_items < ITEMS && end - at >= ITEM_HEAD, "the format of checkpoints is another one");
        memcpy(item->name, at, NAME);
        memcpy(&item->size, at + NAME, sizeof item->size);
        memcpy(&item->count, at + NAME + sizeof item->size, sizeof item->count);
        item->length = (size_t)(item->size * item->count);
        item->copies = 1;
        demand(item->length <= (size_t)(end - at) - ITEM_HEAD, "the format of checkpoints is another one");
        item->bytes = original->file + (at + ITEM_HEAD - original->file);
        at += ITEM_HEAD + padded(item->length);
    }
}

static void run_to_checkpoint(const struct original *original, int steps)
{
    struct run run;
    const struct run_options options = {.deck = original->deck, .folder = original->folder.path, .quiet = true};
    enum status status = run_open(&run, &options);
    for (int i = 0; i < steps && status == STATUS_FINISHED; i++)
        status = run_step(&run);
    demand(status == STATUS_FINISHED && run_goes_on(&run) && restart_write(&run) == STATUS_FINISHED, "a deck does not run");
    (void)run_close(&run, STATUS_INTERRUPTED);
}

/* --- files made of it --- */

/* Bytes of a file under way. */
struct buffer {
    uint8_t *bytes;
    size_t size;
};

static void add_bytes(struct buffer *buffer, const void *bytes, size_t count)
{
    if (count == 0 || buffer->size + padded(count) + TAIL > LARGEST)
        return;
    memcpy(buffer->bytes + buffer->size, bytes, count);
    memset(buffer->bytes + buffer->size + count, 0, padded(count) - count);
    buffer->size += padded(count);
}

/* Puts the items together to a file that lacks its end. */
static void put_together(const struct original *original, const struct item *items, struct buffer *buffer)
{
    buffer->size = 0;
    add_bytes(buffer, original->head, HEAD);
    for (size_t i = 0; i < original->n_items; i++)
        for (int copy = 0; copy < items[i].copies; copy++) {
            uint8_t head[ITEM_HEAD];
            memcpy(head, items[i].name, NAME);
            memcpy(head + NAME, &items[i].size, sizeof items[i].size);
            memcpy(head + NAME + sizeof items[i].size, &items[i].count, sizeof items[i].count);
            add_bytes(buffer, head, ITEM_HEAD);
            add_bytes(buffer, items[i].bytes, items[i].length);
        }
}

/* An end mark as in the original, with the length and the checksum of what is there. */
static void add_tail(const struct original *original, struct buffer *buffer)
{
    struct checksum checksum = checksum_start();
    checksum_add(&checksum, buffer->bytes, buffer->size);
    const uint64_t numbers[2] = {buffer->size + TAIL, checksum_value(&checksum)};
    memcpy(buffer->bytes + buffer->size, original->file + original->size - TAIL, TAIL - sizeof numbers);
    memcpy(buffer->bytes + buffer->size + TAIL - sizeof numbers, numbers, sizeof numbers);
    buffer->size += TAIL;
}

/* --- edits --- */

enum edit_kind { EDIT_REAL, EDIT_SINGLE, EDIT_INTEGER, EDIT_COUNT, EDIT_SIZE, EDIT_NAME, EDIT_LENGTH, EDIT_COPIES };

static const struct {
    const char *name;
    enum edit_kind kind;
    size_t size; /* of a number */
} edits[] = {{"real", EDIT_REAL, 8}, {"single", EDIT_SINGLE, 4}, {"int64", EDIT_INTEGER, 8}, {"int32", EDIT_INTEGER, 4},
             {"byte", EDIT_INTEGER, 1}, {"count", EDIT_COUNT, 0}, {"size", EDIT_SIZE, 0}, {"name", EDIT_NAME, 0},
             {"length", EDIT_LENGTH, 0}, {"copies", EDIT_COPIES, 0}};

/* Sets a number of an item, or of those of the same name behind it. */
static void set_number(struct item *item, const struct item *end, enum edit_kind kind, size_t size, long long index, const char *value)
{
    const char *name = item->name;
    const double real = strtod(value, NULL);
    const float single = strtof(value, NULL);
    const long long integer = strtoll(value, NULL, 10);
    const void *bytes = kind == EDIT_REAL ? (const void *)&real : kind == EDIT_SINGLE ? (const void *)&single : (const void *)&integer;
    for (; item < end && index >= 0 && strncmp(item->name, name, NAME) == 0; item++) {
        const long long count = (long long)(item->length / size);
        if (index < count) {
            memcpy(item->bytes + (size_t)index * size, bytes, size); /* an integer's low bytes come first */
            return;
        }
        index -= count;
    }
}

/* Another length of what an item holds, with zeros behind it. */
static void set_length(struct item *item, long long length)
{
    if (length < 0 || length > (long long)item->length + GROWTH)
        return;
    for (size_t i = item->length; i < (size_t)length; i++)
        item->bytes[i] = 0;
    item->length = (size_t)length;
}

static void edit_item(struct item *item, const struct item *end, size_t e, long long index, const char *value)
{
    const long long number = strtoll(value, NULL, 10);
    switch (edits[e].kind) {
    case EDIT_COUNT: item->count = (uint64_t)number; break;
    case EDIT_SIZE: item->size = (uint64_t)number; break;
    case EDIT_NAME: strncpy(item->name, value, NAME); break;
    case EDIT_LENGTH: set_length(item, number); break;
    case EDIT_COPIES: item->copies = number >= 0 && number <= 3 ? (int)number : 1; break;
    default: set_number(item, end, edits[e].kind, edits[e].size, index, value);
    }
}

/* Does what a line says; one that is no edit does nothing. */
static void edit(struct item *items, size_t n_items, char *line)
{
    char *word[4] = {line};
    for (int i = 1; i < 4; i++) {
        char *colon = strchr(word[i - 1], ':');
        if (!colon)
            return;
        *colon = '\0';
        word[i] = colon + 1;
    }
    for (size_t e = 0; e < sizeof edits / sizeof edits[0]; e++)
        for (size_t i = 0; strcmp(edits[e].name, word[0]) == 0 && i < n_items; i++)
            if (strncmp(items[i].name, word[1], NAME) == 0) {
                edit_item(&items[i], items + n_items, e, strtoll(word[2], NULL, 10), word[3]);
                return;
            }
}

static void edit_all(const struct original *original, const uint8_t *bytes, size_t size, struct buffer *buffer)
{
    struct item items[ITEMS];
    uint8_t *room = malloc(original->size + original->n_items * GROWTH), *at = room;
    char *text = malloc(size + 1);
    demand(room && text, "no memory");
    for (size_t i = 0; i < original->n_items; i++) {
        items[i] = original->items[i];
        items[i].bytes = at;
        memcpy(at, original->items[i].bytes, items[i].length);
        at += items[i].length + GROWTH;
    }
    memcpy(text, bytes, size);
    text[size] = '\0';
    for (char *line = text, *next; line; line = next) {
        next = strchr(line, '\n');
        if (next)
            *next++ = '\0';
        edit(items, original->n_items, line);
    }
    put_together(original, items, buffer);
    free(text);
    free(room);
}

/* --- patches --- */

static void patch_all(const uint8_t *bytes, size_t size, struct buffer *buffer)
{
    while (size >= 3) {
        const size_t place = (size_t)bytes[0] | (size_t)bytes[1] << 8, count = bytes[2];
        bytes += 3;
        size -= 3;
        if (count == 0 && place < buffer->size)
            buffer->size = place;
        if (count > size)
            return;
        if (place + count <= buffer->size)
            memcpy(buffer->bytes + place, bytes, count);
        bytes += count;
        size -= count;
    }
}

static void copy_original(const struct original *original, size_t size, struct buffer *buffer)
{
    memcpy(buffer->bytes, original->file, size);
    buffer->size = size;
}

/* The file that an input describes. */
static void make_file(const struct original *original, const uint8_t *bytes, size_t size, struct buffer *buffer)
{
    const uint8_t form = bytes[1];
    if (form == 'e') {
        edit_all(original, bytes + 2, size - 2, buffer);
    } else {
        copy_original(original, original->size - (form == 'r' ? 0 : TAIL), buffer);
        patch_all(bytes + 2, size - 2, buffer);
    }
    if (form != 'r')
        add_tail(original, buffer);
}

/* --- going on --- */

static bool go_on(const struct original *original, int steps)
{
    struct run run;
    const struct run_options options = {.deck = original->deck, .folder = original->folder.path, .restart = original->checkpoint,
                                        .quiet = true};
    enum status status = run_open(&run, &options);
    const bool is_taken = status == STATUS_FINISHED;
    for (int i = 0; i < steps && status == STATUS_FINISHED && run_goes_on(&run); i++)
        status = run_step(&run);
    (void)run_close(&run, status);
    return is_taken;
}

/* Writes the file that goes with a deck, with what the original is checked by: nothing edited gives it again. */
static void prepare(struct original *original, size_t deck, struct buffer *buffer)
{
    folder_make(&original->folder);
    folder_write(&original->folder, "job.mpm", decks[deck].text, strlen(decks[deck].text), original->deck);
    run_to_checkpoint(original, decks[deck].steps);
    folder_keep(&original->folder);
    const struct folder_file *file = folder_find(&original->folder, "job.rest");
    demand(file && file->size > HEAD + TAIL && file->size < LARGEST, "a checkpoint of another size was expected");
    original->file = file->bytes;
    original->size = file->size;
    folder_write(&original->folder, "job.rest", file->bytes, file->size, original->checkpoint);
    take_apart(original);
    edit_all(original, (const uint8_t *)"", 0, buffer);
    add_tail(original, buffer);
    demand(buffer->size == original->size && memcmp(buffer->bytes, original->file, original->size) == 0 && go_on(original, decks[deck].steps_more),
           "the format of checkpoints is another one");
    folder_restore(&original->folder);
}

bool fuzz_read(const uint8_t *bytes, size_t size)
{
    static struct original originals[DECKS];
    static struct buffer buffer;
    if (!buffer.bytes) {
        buffer.bytes = malloc(LARGEST);
        demand(buffer.bytes != NULL, "no memory");
    }
    if (size < 2)
        return false;
    const size_t deck = (size_t)(bytes[0] - '0') % DECKS;
    struct original *original = &originals[deck];
    if (!original->file)
        prepare(original, deck, &buffer);
    make_file(original, bytes, size, &buffer);
    folder_write(&original->folder, "job.rest", buffer.bytes, buffer.size, NULL);
    const bool is_taken = go_on(original, decks[deck].steps_more);
    if (is_taken)
        folder_restore(&original->folder);
    else
        demand(folder_is_kept(&original->folder, "job.rest"), "a file was changed though the checkpoint was refused");
    return is_taken;
}
