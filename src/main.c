/* SPDX-License-Identifier: GPL-3.0-or-later */
/* mpm3d: the command line, and a run from its deck to its end. */
#define _XOPEN_SOURCE 700
#include "base/threads.h"
#include "deck/help.h"
#include "run.h"
#include "version.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_THREADS = 1024 };

/* The only thing that changes behind the program's back. */
static volatile sig_atomic_t interrupted;

/* The first signal ends the run after its step, a second one at once. */
static void interrupt(int signal_number)
{
    (void)signal_number;
    if (interrupted)
        _exit(STATUS_INTERRUPTED);
    interrupted = 1;
}

static void catch_signals(void)
{
    struct sigaction action = {.sa_handler = interrupt, .sa_flags = SA_RESTART};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

static void print_usage(FILE *stream)
{
    fputs("usage: mpm3d [options] DECK\n"
          "  DECK             a deck such as job.mpm; - is standard input\n"
          "  --check          read the deck and build the scene, do not run\n"
          "  -o DIR           write the output files to DIR, made where it is missing\n"
          "  --restart FILE   go on from the checkpoint FILE (job.rest) of the same deck, with the output\n"
          "                   files beside it, or in DIR of -o; other endt, rptt, rest, sort may be given\n"
          "  --error FILE     compare the last state with the last zone of the animation file FILE: errors of the\n"
          "                   results that both have, beside the run time\n"
          "  --threads N      use N threads (default: all processors, one for small scenes)\n"
          "  --quiet          no progress line and no summary\n"
          "  --help [WORD]    this text and all words, or one word, law, generator or result\n"
          "  --manual         the manual of all words, as Markdown\n"
          "  --version        version\n"
          "Exit status: 0 finished, 1 wrong usage, 2 the deck is wrong, 3 the run went unstable,\n"
          "4 a file could not be read or written, 130 interrupted.\n",
          stream);
}

static enum status wrong_usage(const char *what, const char *word)
{
    status_error("%s '%s'", what, word);
    print_usage(stderr);
    return STATUS_USAGE;
}

static enum status print_help(const char *word)
{
    if (word)
        return help_word(word, stdout) ? STATUS_FINISHED : STATUS_USAGE;
    print_usage(stdout);
    help_words(stdout);
    return STATUS_FINISHED;
}

static enum status run_deck(const struct run_options *options)
{
    struct run run;
    signal(SIGXFSZ, SIG_IGN); /* a file that grows too large is a failure to write as any other */
    if (!options->only_check)
        catch_signals();
    enum status status = run_open(&run, options);
    if (status == STATUS_FINISHED && options->only_check) {
        run.method->print_scene(&run, stdout);
        return run_close(&run, status);
    }
    while (status == STATUS_FINISHED && run_goes_on(&run)) {
        status = run_step(&run);
        if (status == STATUS_FINISHED && interrupted)
            status = run_interrupt(&run);
    }
    return run_close(&run, status);
}

static bool set_thread_count(const char *text)
{
    char *end;
    long count = strtol(text, &end, 10);
    if (*end || end == text || count < 1 || count > MOST_THREADS)
        return false;
    threads_set((int)count);
    return true;
}

int main(int count, char **arguments)
{
    struct run_options options = {0};
    threads_wait_briefly(arguments);
    for (int i = 1; i < count; i++) {
        const char *word = arguments[i];
        const char *value = i + 1 < count ? arguments[i + 1] : NULL;
        if (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0)
            return print_help(value);
        if (strcmp(word, "--version") == 0)
            return printf("mpm3d %s\n", VERSION) < 0 ? STATUS_FILE : STATUS_FINISHED;
        if (strcmp(word, "--manual") == 0) {
            help_manual(stdout);
            return fflush(stdout) == 0 ? STATUS_FINISHED : STATUS_FILE;
        }
        if (strcmp(word, "--check") == 0)
            options.only_check = true;
        else if (strcmp(word, "--quiet") == 0 || strcmp(word, "-q") == 0)
            options.quiet = true;
        else if ((strcmp(word, "-o") == 0 || strcmp(word, "--threads") == 0 || strcmp(word, "--restart") == 0
                  || strcmp(word, "--error") == 0) && !value)
            return (int)wrong_usage("a value has to follow", word);
        else if (strcmp(word, "-o") == 0)
            options.folder = arguments[++i];
        else if (strcmp(word, "--restart") == 0)
            options.restart = arguments[++i];
        else if (strcmp(word, "--error") == 0)
            options.reference = arguments[++i];
        else if (strcmp(word, "--threads") == 0 && !set_thread_count(arguments[++i]))
            return (int)wrong_usage("not a number of threads from 1 to 1024:", value);
        else if (strcmp(word, "--threads") == 0)
            options.has_threads = true;
        else if (word[0] == '-' && word[1])
            return (int)wrong_usage("unknown option", word);
        else if (options.deck)
            return (int)wrong_usage("more than one deck:", word);
        else
            options.deck = word;
    }
    if (!options.deck) {
        status_error("no deck given");
        print_usage(stderr);
        return STATUS_USAGE;
    }
    return (int)run_deck(&options);
}
