/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checkpoint files: what is written is read again; any flipped bit and any missing end is noticed. */
#define _POSIX_C_SOURCE 200809L
#include "base/checkpoint.h"
#include "base/checksum.h"
#include "check.h"
#include "random.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { NUMBERS = 11, LETTERS = 5, LARGEST = 4096 };

struct content {
    double numbers[NUMBERS];
    char letters[LETTERS];
    size_t count;
};

static void exchange(struct content *content, struct checkpoint *checkpoint)
{
    checkpoint_item(checkpoint, "numbers", content->numbers, sizeof *content->numbers, NUMBERS);
    content->count = checkpoint_count(checkpoint, "count", content->count, LETTERS);
    checkpoint_item(checkpoint, "letters", content->letters, 1, content->count);
    checkpoint_item(checkpoint, "nothing", NULL, 8, 0);
}

/* Puts a byte into the file, and cuts the file off or fills it up to a length. */
static bool change_file(const char *path, size_t place, char byte, size_t length)
{
    FILE *stream = fopen(path, "r+b");
    bool good = stream && fseek(stream, (long)place, SEEK_SET) == 0 && fputc(byte, stream) != EOF;
    return stream && fclose(stream) == 0 && good && truncate(path, (off_t)length) == 0;
}

static size_t read_file(const char *path, char *bytes)
{
    FILE *stream = fopen(path, "rb");
    size_t count = stream ? fread(bytes, 1, LARGEST, stream) : 0;
    if (stream)
        fclose(stream);
    return count;
}

/* Whether it opens; closed again at once. */
static bool opens(const char *path)
{
    struct checkpoint *checkpoint = checkpoint_open(path);
    if (checkpoint)
        (void)checkpoint_close(checkpoint);
    return checkpoint != NULL;
}

static void check_damage(const char *path, const char *bytes, size_t length)
{
    size_t opened = 0;
    for (size_t bit = 0; bit < 8 * length; bit++) {
        const char byte = bytes[bit / 8];
        opened += !change_file(path, bit / 8, (char)(byte ^ 1 << bit % 8), length) || opens(path);
        opened += !change_file(path, bit / 8, byte, length);
    }
    check_true("each flipped bit is noticed", length > 300 && opened == 0);
    check_true("the whole file is good", opens(path));
    check_true("a byte more is noticed", change_file(path, 0, bytes[0], length + 1) && !opens(path));
    opened = 0;
    for (size_t cut = length; cut-- > 0;)
        opened += !change_file(path, 0, bytes[0], cut) || opens(path);
    check_true("each missing end is noticed", opened == 0);
}

/* Items that are not those of the file. */
static void check_misfits(const char *path)
{
    struct content found;
    double numbers[NUMBERS + 1];
    static const char *const names[] = {"numbers", "figures"};
    for (int i = 0; i < 3; i++) {
        struct checkpoint *checkpoint = checkpoint_open(path);
        bool good = checkpoint_item(checkpoint, names[i == 1], numbers, i == 2 ? 4 : 8, NUMBERS + (i == 0));
        check_true(i == 0 ? "another count is refused" : i == 1 ? "another name is refused" : "another size is refused", !good);
        exchange(&found, checkpoint);
        check_true("and nothing is read any more", !checkpoint_close(checkpoint));
    }
}

static void check_round_trip(const char *path, char *bytes, size_t *length)
{
    struct content content = {.letters = "abcd", .count = 4}, found = {.count = 0};
    struct random random = {1};
    for (int i = 0; i < NUMBERS; i++)
        content.numbers[i] = random_between(&random, -1, 1);
    struct checkpoint *checkpoint = checkpoint_create(path);
    exchange(&content, checkpoint);
    check_true("it is written", checkpoint_close(checkpoint));
    checkpoint = checkpoint_open(path);
    exchange(&found, checkpoint);
    check_true("it is read", checkpoint_close(checkpoint));
    check_true("numbers are the same bits", memcmp(found.numbers, content.numbers, sizeof content.numbers) == 0);
    check_true("a number of elements goes along", found.count == 4 && memcmp(found.letters, "abcd", 4) == 0);
    *length = read_file(path, bytes);
}

static void check_sum_of_parts(void)
{
    unsigned char bytes[256];
    for (int i = 0; i < 256; i++)
        bytes[i] = (unsigned char)(i * i + 3 * i);
    struct checksum whole = checksum_start(), parts = checksum_start();
    checksum_add(&whole, bytes, 256);
    checksum_add(&parts, bytes, 64);
    checksum_add(&parts, bytes + 64, 192);
    check_true("a checksum does not depend on the parts", checksum_value(&whole) == checksum_value(&parts));
}

int main(void)
{
    char path[] = "/tmp/test_checkpoint_XXXXXX", bytes[LARGEST];
    size_t length;
    int file = mkstemp(path);
    if (file < 0 || !freopen("/dev/null", "w", stderr))
        return 1;
    close(file);
    check_sum_of_parts();
    check_round_trip(path, bytes, &length);
    check_misfits(path);
    check_damage(path, bytes, length);
    char old[sizeof path + 4];
    snprintf(old, sizeof old, "%s.old", path);
    check_true("the file before is kept", remove(old) == 0);
    remove(path);
    return check_result();
}
