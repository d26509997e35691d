/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a run asks of a method: one const row each. The functions know the run and their own solver in it. */
#ifndef METHOD_H
#define METHOD_H

#include "base/instability.h"
#include "deck/scene_sph.h"

#include <stdint.h>
#include <stdio.h>

struct run;
struct checkpoint;

struct method {
    const char *name; /* in decks, after `meth` */
    bool is_static;   /* nothing moves: there are no energies, momenta and curves */
    bool has_grid;    /* a background grid, which the ParaView files show */
    /* Builds the solver of run->scene in run->mpm, run->sph or run->rkpm, and what output sees of it: run->store, run->source.
     * Mistakes that only show now go to run->diagnostics. */
    void (*open)(struct run *run);
    void (*close)(struct run *run);
    /* One step, or what stands for one; then whether it can be trusted. */
    struct instability (*advance)(struct run *run);
    /* Puts time, step and sums into run->course and run->totals; after open, after a step, after a restart. */
    void (*look)(struct run *run);
    /* Whether there is a further step; whether the last step ended the run for another reason than its time (NULL: never). */
    bool (*goes_on)(const struct run *run);
    bool (*has_ended)(const struct run *run);
    /* Brings up to date what output reads of particles and steps don't need (NULL: all is). */
    void (*show)(struct run *run);
    /* Takes particles that are gone out of run->is_shown, where their state does not tell (NULL: it does). */
    void (*hide_lost)(struct run *run);
    /* Where the n-th particle that left the grid, from 0 on, is in run->store; only of scenes that list them. */
    int32_t (*lost_particle)(const struct run *run, int32_t n);
    /* The whole state between two steps, to or from a checkpoint. */
    void (*exchange)(struct run *run, struct checkpoint *checkpoint);
    /* Begins run->errors, and writes the line of the last step; false, after a message, on failure. NULL: there is no such table. */
    void (*start_errors)(struct run *run);
    bool (*write_errors)(struct run *run);
    /* Particles, grid, first step (also for --check); with columns and memory; why it was stopped; the end. */
    void (*print_scene)(const struct run *run, FILE *stream);
    void (*print_start)(const struct run *run, FILE *stream);
    void (*print_instability)(const struct run *run, const struct instability *instability, FILE *stream);
    void (*print_end)(const struct run *run, double seconds, enum status status, FILE *stream);
    /* Warns where a run that came to its end should be doubted; or NULL. */
    void (*print_doubt)(const struct run *run, FILE *stream);
    /* Particles that took part, summed over steps. */
    double (*updates)(const struct run *run);
};

extern const struct method method_mpm, method_sph, method_rkpm, method_dynamic;

/* The row of a scene's method. */
const struct method *method_of(enum method_name name);

#endif
