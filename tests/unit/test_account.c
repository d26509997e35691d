/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of memory in job.out against what the system says, and a grid that is a hundred times larger than the body. */
#define _XOPEN_SOURCE 700
#include "account.h"
#include "check.h"
#include "scene_text.h"

#include <sys/resource.h>

/* A flying block of n^3 points, 8 a cell, in a grid with edges `scale` times as long. */
static void open_block(struct test_run *run, int n, double scale)
{
    struct deck_builder deck = {0};
    const double edge = scale * (n / 2 + 12);
    deck_add(&deck, "mpm3d block\nnbco 1\nnbbo 1\nnbmp %d\nnmat 1\ngrid 0 %g 0 %g 0 %g\ndcell 1\ndtscale 0.5\nendt 1\n", n * n * n, edge,
             edge, edge);
    deck_add(&deck, "mate\n1 elas 7.85e-3 210e3 0.3\npart bloc 1\n1 7.85e-3 0.5 5 5 5 %d %d %d\nvelo\nbody 1 10 20 30\nendv\nendi\n", n,
             n, n);
    test_run_open(run, &deck);
}

/* Largest memory of this process so far, bytes. */
static double peak(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * (double)usage.ru_maxrss;
}

static void test_against_system(void)
{
    struct test_run run;
    const double before = peak();
    open_block(&run, 80, 1);
    for (int i = 0; i < 2; i++)
        mpm_step(run.mpm);
    const double grown = peak() - before;
#ifdef NO_CLONES
    (void)grown;
    printf("skip memory against the system's: sanitizers keep memory of their own\n");
#else
    /* pages not touched yet, and rooms of a few kB that the table leaves out */
    check_near("the table's bytes over the system's, 512000 points", account_bytes(run.mpm) / grown, 1, 0.1);
#endif
    test_run_close(&run);
}

static void test_large_grid(void)
{
    struct test_run small, large;
    open_block(&small, 40, 1);
    open_block(&large, 40, 100);
    for (int i = 0; i < 20; i++) {
        mpm_step(small.mpm);
        mpm_step(large.mpm);
    }
    check_true("a grid of a million times the cells takes at most twice the memory",
               account_bytes(large.mpm) <= 2 * account_bytes(small.mpm));
    bool is_same = true;
    for (size_t id = 0; id < small.mpm->store->count; id++)
        for (int a = 0; a < 3; a++)
            is_same = is_same && small.mpm->store->real[COLUMN_POSITION][a][small.mpm->store->index_of_id[id]]
                                     == large.mpm->store->real[COLUMN_POSITION][a][large.mpm->store->index_of_id[id]];
    check_true("and gives the same bits", is_same);
    test_run_close(&small);
    test_run_close(&large);
}

static void test_left_out(void)
{
    struct test_run run;
    char text[8192] = "";
    open_block(&run, 4, 1);
    FILE *stream = fmemopen(text, sizeof text - 1, "w");
    if (!stream)
        exit(4);
    account_print(run.mpm, stream);
    fclose(stream);
    const char *left_out = strstr(text, "left out:");
    check_true("contact is left out", left_out && strstr(left_out, " contact,"));
    check_true("musl is in use", left_out && !strstr(left_out, " musl,") && strstr(text, "\n  musl\n"));
    check_true("no column of temperature", !strstr(text, "  temperature "));
    check_true("the position takes 1536 bytes", strstr(text, "  position                       3         1536\n") != NULL);
    test_run_close(&run);
}

int main(void)
{
    test_against_system();
    test_large_grid();
    test_left_out();
    return check_result();
}
