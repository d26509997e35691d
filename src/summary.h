/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a run says at its start and end: the model, the timer table and the verdict. */
#ifndef SUMMARY_H
#define SUMMARY_H

#include "base/status.h"
#include "base/timers.h"
#include "mpm/mpm.h"
#include "run.h"
#include "sph/sph.h"

#include <stdio.h>

/* --- of all methods --- */

/* How a run ended, in words. */
const char *summary_ending(enum status status);

/* Timer table by phase, cost per particle-step: `updates` of particles in all. */
void summary_timers(double updates, const struct timers *timers, double seconds, FILE *stream);

/* One line: run time, steps and cost per particle-step. */
void summary_cost(const struct run_course *course, double updates, const struct timers *timers, double seconds, FILE *stream);

/* --- of the material point method (summary.c) of smoothed particles (summary_sph.c), of nodes in motion (summary_dynamic.c), of problems on nodes (summary_rkpm.c) --- */

/* Counts, memory, energies and the first time step. */
void summary_start(const struct run *run, FILE *stream);

/* Timer table by phase, cost per particle-step, particles lost, energy and momentum balance. */
void summary_end(const struct run *run, double seconds, enum status status, FILE *stream);

/* A warning where a run came to its end with energy from nowhere; else nothing. */
void summary_doubt(const struct run *run, FILE *stream);

/* Why a run was stopped: step, time, particle, cause, what to try. */
void summary_instability(const struct run *run, const struct instability *instability, FILE *stream);

/* The same start in a few lines, for --check. */
void summary_check(const struct run *run, FILE *stream);

/* Of a run with quas: that free motions of bodies are taken out, and how the last equilibrium was found. */
void summary_floating(const struct mpm *mpm, FILE *stream);
void summary_equilibrium(const struct mpm *mpm, FILE *stream);

void summary_sph_check(const struct run *run, FILE *stream);
void summary_sph_start(const struct run *run, FILE *stream);
void summary_sph_instability(const struct run *run, const struct instability *instability, FILE *stream);
void summary_sph_end(const struct run *run, double seconds, enum status status, FILE *stream);

void summary_dynamic_check(const struct run *run, FILE *stream);
void summary_dynamic_start(const struct run *run, FILE *stream);
void summary_dynamic_instability(const struct run *run, const struct instability *instability, FILE *stream);
void summary_dynamic_end(const struct run *run, double seconds, enum status status, FILE *stream);
void summary_rkpm_check(const struct run *run, FILE *stream);
void summary_rkpm_start(const struct run *run, FILE *stream);
void summary_rkpm_instability(const struct run *run, const struct instability *instability, FILE *stream);
void summary_rkpm_end(const struct run *run, double seconds, enum status status, FILE *stream);

#endif
