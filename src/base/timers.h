/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wall time by phase. */
#ifndef BASE_TIMERS_H
#define BASE_TIMERS_H

enum phase {
    PHASE_OTHER,
    PHASE_SCATTER,
    PHASE_GRID,
    PHASE_VELOCITY,
    PHASE_STRESS,
    PHASE_SYSTEM,
    PHASE_CELLS,
    PHASE_SORT,
    PHASE_DENSITY,
    PHASE_SURFACE,
    PHASE_FORCES,
    PHASE_HEAT,
    PHASE_MOVE,
    PHASE_SUMS,
    PHASE_OUTPUT,
    PHASE_COUNT
};

struct timers {
    double seconds[PHASE_COUNT];
    double last; /* clock at the last change of phase */
    enum phase phase;
};

/* Starts the clock in PHASE_OTHER. */
void timers_start(struct timers *timers);

/* Time from now on counts for `phase`. */
void timers_enter(struct timers *timers, enum phase phase);

/* Name of a phase for tables. */
const char *timers_name(enum phase phase);

#endif
