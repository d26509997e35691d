/* SPDX-License-Identifier: GPL-3.0-or-later */
#define _POSIX_C_SOURCE 200809L
#include "restart.h"
#include "base/checkpoint.h"
#include "base/checksum.h"
#include "base/memory.h"
#include "deck/echo.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* --- the deck --- */

enum { MOST_TEXT = 65536, SHOWN_LINE = 100 };

/* A deck as understood: its echo without long lists, and a checksum of it and them. */
struct deck_print {
    char *text;
    size_t length;
    uint64_t checksum;
};

/* Words that may differ: they change nothing of what is computed and written up to any time. */
static bool may_differ(const char *line)
{
    static const char *const words[] = {"endt ", "rptt ", "rest ", "sort "};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (strncmp(line, words[i], 5) == 0)
            return true;
    return false;
}

/* Takes comments, empty lines and words that may differ out of an echo; the title is kept. Returns the length. */
static size_t condense(char *text)
{
    char *target = text;
    for (char *line = text, *next; *line; line = next) {
        size_t length = strcspn(line, "\n");
        next = line + length + (line[length] == '\n');
        if (line != text)
            length = strcspn(line, "!\n");
        while (length > 0 && line[length - 1] == ' ')
            length--;
        if (length == 0 || may_differ(line))
            continue;
        memmove(target, line, length);
        target += length;
        *target++ = '\n';
    }
    *target = '\0';
    return (size_t)(target - text);
}

static void add_lists(struct checksum *checksum, const struct scene *scene)
{
    for (size_t b = 0; b < scene->n_bodies; b++) {
        const struct generator *generator = &scene->bodies[b].generator;
        if (generator->n_points > 0)
            checksum_add(checksum, generator->points, (size_t)generator->n_points * sizeof *generator->points);
    }
    for (size_t i = 0; i < scene->n_loads; i++) {
        const struct scene_load *load = &scene->loads[i];
        checksum_add(checksum, (const long[]){(long)load->kind, load->target, load->axis, load->side}, 4 * sizeof(long));
        checksum_add(checksum, load->value, sizeof load->value);
    }
    for (size_t i = 0; i < scene->n_velocities; i++) {
        const struct scene_velocity *velocity = &scene->velocities[i];
        checksum_add(checksum, (const long[]){(long)velocity->kind, velocity->target}, 2 * sizeof(long));
        checksum_add(checksum, velocity->value, sizeof velocity->value);
    }
}

/* False, after a message, when there is no room for it. The caller frees the text with free. */
static bool print_deck(const struct scene *scene, struct deck_print *print)
{
    size_t length;
    *print = (struct deck_print){0};
    FILE *stream = open_memstream(&print->text, &length);
    if (stream)
        echo_scene(scene, stream, false);
    if (!stream || fclose(stream) != 0) {
        status_error("cannot keep the deck for the checkpoint: %s", strerror(errno));
        return false;
    }
    struct checksum checksum = checksum_start();
    length = condense(print->text);
    checksum_add(&checksum, print->text, length);
    add_lists(&checksum, scene);
    print->checksum = checksum_value(&checksum);
    print->length = length < MOST_TEXT ? length : MOST_TEXT;
    print->text[print->length] = '\0';
    return true;
}

static int shown_length(const char *line)
{
    size_t length = strcspn(line, "\n");
    return length < SHOWN_LINE ? (int)length : SHOWN_LINE;
}

/* Says where two decks part. */
static void report_difference(const char *path, const char *own, const char *stored)
{
    size_t from = 0, i = 0;
    for (; own[i] && own[i] == stored[i]; i++)
        if (own[i] == '\n')
            from = i + 1;
    if (!own[i] && !stored[i])
        status_error("'%s' is a checkpoint of another deck: points, loads or velocities differ", path);
    else
        status_error("'%s' is a checkpoint of another deck: there it says '%.*s', here '%.*s'", path,
                     shown_length(stored + from), stored + from, shown_length(own + from), own + from);
}

/* Writes the deck, or compares it with the one that is read. */
static void exchange_deck(const struct run *run, struct checkpoint *checkpoint, const char *path)
{
    struct deck_print own;
    if (!print_deck(run->scene, &own)) {
        free(own.text);
        checkpoint_fail(checkpoint);
        return;
    }
    uint64_t checksum = own.checksum;
    const size_t length = checkpoint_count(checkpoint, "length of the deck", own.length, MOST_TEXT);
    char *text = memory_array(MOST_TEXT + 1, 1, "the deck");
    memcpy(text, own.text, own.length);
    checkpoint_item(checkpoint, "deck", text, 1, length);
    checkpoint_item(checkpoint, "checksum of the deck", &checksum, sizeof checksum, 1);
    if (checkpoint_is_good(checkpoint) && checksum != own.checksum) {
        text[length] = '\0';
        report_difference(path, own.text, text);
        checkpoint_fail(checkpoint);
    }
    memory_free(text);
    free(own.text);
}

/* --- the output --- */

/* The tables of a run; those that it does not have are without stream. */
static void list_tables(const struct run *run, struct table tables[RUN_TABLES])
{
    const struct history *history = &run->history;
    const struct table list[RUN_TABLES] = {{.path = run->log_path, .stream = run->log}, run->animation, run->lost, run->errors,
                                           history->curves, history->energy, history->momentum, history->contact};
    memcpy(tables, list, sizeof list);
}

/* Whether the numbers that tell how far the output is fit to the steps and to the particles that left. */
static bool are_sound(const struct run *run)
{
    for (int i = 0; i < RUN_TABLES; i++)
        if (run->marks[i].length < 0)
            return false;
    return run->dumps >= 1 && run->dumps <= run->course.step + 1
        && run->known_lost == (run->scene->writes_lost ? run->course.lost : 0);
}

/* A list of no more times than there were dumps, nor than the file can hold. */
static void exchange_series(struct run *run, struct checkpoint *checkpoint)
{
    const size_t dumps = (size_t)run->dumps, room = checkpoint_left(checkpoint) / sizeof(double);
    const size_t count = checkpoint_count(checkpoint, "files of the series", run->vtk.count, dumps < room ? dumps : room);
    checkpoint_item(checkpoint, "times of the series", vtk_resume(&run->vtk, count), sizeof(double), count);
}

static void exchange_output(struct run *run, struct checkpoint *checkpoint)
{
    const struct scene *scene = run->scene;
    checkpoint_item(checkpoint, "next output", &run->next_output, sizeof run->next_output, 1);
    checkpoint_item(checkpoint, "next report", &run->next_report, sizeof run->next_report, 1);
    checkpoint_item(checkpoint, "dumps", &run->dumps, sizeof run->dumps, 1);
    checkpoint_item(checkpoint, "known lost", &run->known_lost, sizeof run->known_lost, 1);
    checkpoint_item(checkpoint, "marks", run->marks, sizeof *run->marks, RUN_TABLES);
    if (checkpoint_is_reading(checkpoint) && checkpoint_is_good(checkpoint) && !are_sound(run))
        checkpoint_reject(checkpoint, "numbers of the output");
    checkpoint_item(checkpoint, "told of floating bodies", &run->has_told_floating, sizeof run->has_told_floating, 1);
    if (scene->writes_animation)
        checkpoint_item(checkpoint, "shown", run->is_shown, 1, run->store->count);
    if (scene->writes_vtk)
        exchange_series(run, checkpoint);
}

/* --- checkpoints --- */

char *restart_path(const struct run *run)
{
    const char *folder = run->options.folder, *job = run->scene->job;
    size_t size = strlen(folder) + strlen(job) + sizeof "/.rest";
    char *path = memory_array(size, 1, "a file name");
    snprintf(path, size, "%s%s%s.rest", folder, *folder ? "/" : "", job);
    return path;
}

static bool mark_tables(struct run *run)
{
    struct table tables[RUN_TABLES];
    list_tables(run, tables);
    for (int i = 0; i < RUN_TABLES; i++)
        if (tables[i].stream && !table_set_mark(&tables[i], &run->marks[i]))
            return false;
    return true;
}

static bool exchange(struct run *run, struct checkpoint *checkpoint, const char *path)
{
    if (!checkpoint)
        return false;
    exchange_deck(run, checkpoint, path);
    run->method->exchange(run, checkpoint);
    run->method->look(run);
    exchange_output(run, checkpoint);
    return checkpoint_close(checkpoint);
}

enum status restart_write(struct run *run)
{
    if (run->course.step == run->checkpoint_step)
        return STATUS_FINISHED;
    if (!mark_tables(run))
        return STATUS_FILE;
    char *path = restart_path(run);
    bool is_written = exchange(run, checkpoint_create(path), path);
    memory_free(path);
    if (is_written)
        run->checkpoint_step = run->course.step;
    return is_written ? STATUS_FINISHED : STATUS_FILE;
}

enum status restart_read(struct run *run)
{
    const char *path = run->options.restart;
    if (!exchange(run, checkpoint_open(path), path))
        return STATUS_FILE;
    run->checkpoint_step = run->course.step;
    return STATUS_FINISHED;
}

enum status restart_continue(struct run *run)
{
    struct table tables[RUN_TABLES];
    list_tables(run, tables);
    for (int i = 0; i < RUN_TABLES; i++)
        if (tables[i].stream && !table_has_mark(&tables[i], &run->marks[i]))
            return STATUS_FILE;
    for (int i = 0; i < RUN_TABLES; i++)
        if (tables[i].stream && !table_return_to(&tables[i], &run->marks[i]))
            return STATUS_FILE;
    fprintf(run->log, "Restarted from '%s' at step %ld, time %.6E\n", run->options.restart, run->course.step, run->course.time);
    return !run->scene->writes_vtk || vtk_write_list(&run->vtk) ? STATUS_FINISHED : STATUS_FILE;
}
