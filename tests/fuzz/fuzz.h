/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What each fuzz target gives: fuzz_deck.c, fuzz_checkpoint.c, fuzz_stl.c. libfuzzer.c calls it with what libFuzzer
 * makes up, replay.c with the files of the kept seeds. */
#ifndef FUZZ_FUZZ_H
#define FUZZ_FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Reads the bytes. No input may crash, leak or take long; what else has to hold is checked, and ends the program
 * where it does not. Returns whether the reader took them, instead of saying what is wrong with them. */
bool fuzz_read(const uint8_t *bytes, size_t size);

#endif
