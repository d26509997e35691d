/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a run says at its start and end: the model, the timer table and the verdict. */
#ifndef SUMMARY_H
#define SUMMARY_H

#include "base/status.h"
#include "mpm/mpm.h"

#include <stdio.h>

/* Counts, memory, energies and the first time step. */
void summary_start(const struct mpm *mpm, FILE *stream);

/* Timer table by phase, cost per particle-step, particles lost, energy and momentum balance. */
void summary_end(const struct mpm *mpm, const struct timers *timers, double seconds, enum status status, FILE *stream);

/* A warning where a run came to its end with energy from nowhere; else nothing. */
void summary_doubt(const struct mpm *mpm, FILE *stream);

/* One line: run time, steps and cost per particle-step. */
void summary_cost(const struct mpm *mpm, const struct timers *timers, double seconds, FILE *stream);

/* Why a run was stopped: step, time, particle, cause, what to try. */
void summary_instability(const struct mpm *mpm, const struct instability *instability, FILE *stream);

/* The same start in a few lines, for --check. */
void summary_check(const struct mpm *mpm, FILE *stream);

/* Of a run with quas: that free motions of bodies are taken out, and how the last equilibrium was found. */
void summary_floating(const struct mpm *mpm, FILE *stream);
void summary_equilibrium(const struct mpm *mpm, FILE *stream);

#endif
