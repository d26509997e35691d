/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/timers.h"
#include "base/threads.h"

static const char *const names[PHASE_COUNT] = {
    [PHASE_OTHER] = "other",
    [PHASE_SCATTER] = "particles to grid",
    [PHASE_GRID] = "grid",
    [PHASE_VELOCITY] = "grid to particles",
    [PHASE_STRESS] = "strain and stress",
    [PHASE_SYSTEM] = "linear systems",
    [PHASE_CELLS] = "cell lists",
    [PHASE_SORT] = "sorting",
    [PHASE_DENSITY] = "density and walls",
    [PHASE_SURFACE] = "surface",
    [PHASE_FORCES] = "forces",
    [PHASE_HEAT] = "heat and beam",
    [PHASE_MOVE] = "motion",
    [PHASE_SUMS] = "sums and checks",
    [PHASE_OUTPUT] = "output",
};

void timers_start(struct timers *timers)
{
    *timers = (struct timers){.last = threads_clock(), .phase = PHASE_OTHER};
}

void timers_enter(struct timers *timers, enum phase phase)
{
    double now = threads_clock();
    timers->seconds[timers->phase] += now - timers->last;
    timers->last = now;
    timers->phase = phase;
}

const char *timers_name(enum phase phase)
{
    return names[phase];
}
