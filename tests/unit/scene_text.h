/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A run from the text of a deck, inside a test. */
#ifndef UNIT_SCENE_TEXT_H
#define UNIT_SCENE_TEXT_H

#include "deck/diagnostics.h"
#include "deck/reader.h"
#include "mpm/mpm.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* A deck that grows line by line. */
struct deck_builder {
    char *text;
    size_t length, capacity;
};

__attribute__((format(printf, 2, 3))) static inline void deck_add(struct deck_builder *deck, const char *format, ...)
{
    va_list arguments;
    char line[1024];
    va_start(arguments, format);
    int length = vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    if (deck->length + (size_t)length + 1 > deck->capacity) {
        deck->capacity = 2 * deck->capacity + 4096;
        deck->text = realloc(deck->text, deck->capacity);
        if (!deck->text)
            exit(4);
    }
    memcpy(deck->text + deck->length, line, (size_t)length + 1);
    deck->length += (size_t)length;
}

/* What a run in a test owns. */
struct test_run {
    struct diagnostics *diagnostics;
    struct deck_text *text;
    struct scene *scene;
    struct timers timers;
    struct mpm *mpm;
};

/* Reads the deck (and frees it) and opens the run; ends the test with its messages when it is wrong. */
static inline void test_run_open(struct test_run *run, struct deck_builder *deck)
{
    memset(run, 0, sizeof *run);
    run->diagnostics = diagnostics_open();
    run->text = text_open(run->diagnostics);
    text_include_memory(run->text, "test", deck->text, deck->length);
    free(deck->text);
    *deck = (struct deck_builder){0};
    run->scene = reader_read(run->text, run->diagnostics);
    timers_start(&run->timers);
    if (diagnostics_errors(run->diagnostics) == 0)
        run->mpm = mpm_open(run->scene, &run->timers, run->diagnostics);
    if (diagnostics_errors(run->diagnostics) > 0) {
        diagnostics_print(run->diagnostics, run->text, stderr, false);
        exit(2);
    }
}

static inline void test_run_close(struct test_run *run)
{
    mpm_close(run->mpm);
    scene_close(run->scene);
    text_close(run->text);
    diagnostics_close(run->diagnostics);
}

#endif
