/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads any bytes as a deck. No input may crash, leak, or take long; and what the program
 * understood of a right deck, printed as in the log, has to be a right deck that says the same.
 * Returns whether the deck is right. */
#define _POSIX_C_SOURCE 200809L
#include "deck/diagnostics.h"
#include "deck/echo.h"
#include "deck/reader.h"
#include "fuzz.h"


#include <stdio.h>
#include <stdlib.h>
#include <string.h>



/* The deck as understood, in memory that the caller frees; NULL when it is wrong. */
static char *read_and_echo(const char *bytes, size_t size, FILE *null)
{
    struct diagnostics *diagnostics = diagnostics_open();
    struct deck_text *text = text_open(diagnostics);
    text_refuse_includes(text);
    text_include_memory(text, "fuzz", bytes, size);
    struct scene *scene = reader_read(text, diagnostics);
    char *echo = NULL;
    size_t length = 0;
    if (diagnostics_errors(diagnostics) == 0) {
        FILE *stream = open_memstream(&echo, &length);
        if (!stream)
            abort();
        echo_scene(scene, stream, true);
        fclose(stream);
    }
    diagnostics_print(diagnostics, text, null, true);
    scene_close(scene);
    text_close(text);
    diagnostics_close(diagnostics);
    return echo;
}

/* Takes out what only the first echo has: the words that the deck did not give. */
static void remove_notes(char *echo)
{
    static const char note[] = "   ! default";
    for (char *found = echo; (found = strstr(found, note));)
        memmove(found, found + sizeof note - 1, strlen(found + sizeof note - 1) + 1);
}

bool fuzz_read(const uint8_t *bytes, size_t size)
{
    static FILE *null;
    if (!null)
        null = fopen("/dev/null", "w");
    char *copy = malloc(size + 1);
    if (!null || !copy)
        abort();
    if (size > 0)
        memcpy(copy, bytes, size);
    char *once = read_and_echo(copy, size, null);
    if (once) {
        char *twice = read_and_echo(once, strlen(once), null);
        if (!twice) {
            fprintf(stderr, "the echo of a right deck is wrong:\n%s", once);
            abort();
        }
        remove_notes(once);
        remove_notes(twice);
        if (strcmp(once, twice) != 0) {
            fprintf(stderr, "the echo of the echo differs:\n%s---\n%s", once, twice);
            abort();
        }
        free(twice);
    }
    free(once);
    free(copy);
    return 0;
}
