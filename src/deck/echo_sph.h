/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What echo.h prints of smoothed particles. */
#ifndef DECK_ECHO_SPH_H
#define DECK_ECHO_SPH_H

#include "deck/scene.h"

#include <stdio.h>

/* The block of sph, and prop of all materials. */
void echo_sph(const struct scene *scene, FILE *stream);
void echo_properties(const struct scene *scene, FILE *stream);

#endif
