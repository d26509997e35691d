/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Problems of RKPM from the words of their block, for tests. */
#ifndef UNIT_RKPM_FIXTURE_H
#define UNIT_RKPM_FIXTURE_H

#include "check.h"
#include "rkpm/rkpm.h"
#include "scene_text.h"

struct problem {
    struct diagnostics *diagnostics;
    struct deck_text *text;
    struct scene *scene;
    struct timers timers;
    struct rkpm *rkpm;
};

static inline void open_problem(struct problem *problem, const char *block)
{
    *problem = (struct problem){.diagnostics = diagnostics_open()};
    struct deck_builder deck = {0};
    deck_add(&deck, "mpm3d test\nmeth rkpm\nrkpm\n%s\nends\nendi\n", block);
    problem->text = text_open(problem->diagnostics);
    text_include_memory(problem->text, "test", deck.text, deck.length);
    free(deck.text);
    problem->scene = reader_read(problem->text, problem->diagnostics);
    if (diagnostics_errors(problem->diagnostics) > 0) {
        diagnostics_print(problem->diagnostics, problem->text, stderr, false);
        exit(1);
    }
    timers_start(&problem->timers);
    problem->rkpm = rkpm_open(problem->scene, &problem->timers);
}

static inline void close_problem(struct problem *problem)
{
    rkpm_close(problem->rkpm);
    scene_close(problem->scene);
    text_close(problem->text);
    diagnostics_close(problem->diagnostics);
}

/* All levels of an open problem. */
static inline void solve_problem(struct problem *problem)
{
    for (size_t i = 0; i < problem->rkpm->n_levels; i++)
        check_true("the problem is solved", !rkpm_advance(problem->rkpm).is_stopped);
}

/* What came out of the last level. */
static inline struct rkpm_result result_of(const char *block)
{
    struct problem problem;
    open_problem(&problem, block);
    solve_problem(&problem);
    const struct rkpm_result result = problem.rkpm->levels[problem.rkpm->n_levels - 1].result;
    close_problem(&problem);
    return result;
}

#endif
