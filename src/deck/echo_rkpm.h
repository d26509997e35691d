/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What echo.h prints of reproducing kernel particles: the block rkpm. */
#ifndef DECK_ECHO_RKPM_H
#define DECK_ECHO_RKPM_H

#include "deck/scene.h"

#include <stdio.h>

void echo_rkpm(const struct scene *scene, FILE *stream);

#endif
