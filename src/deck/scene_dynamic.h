/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a deck says of the motion of reproducing kernel particles in time: the words of the block rkpm that go with
 * `prob dynamic`. */
#ifndef DECK_SCENE_DYNAMIC_H
#define DECK_SCENE_DYNAMIC_H

#include "deck/text.h"
#include "particles/lattice.h"

#include <stdbool.h>

/* Shape functions of the places at the start, or of those of now. */
enum kernel_mode { KERNEL_LAGRANGIAN, KERNEL_SEMI };

enum { RKPM_STABILISED_ELEMENTS = 16 }; /* most elements of a law with nsni */

enum rkpm_wall { RKPM_WALL_NONE, RKPM_WALL_SPRING, RKPM_WALL_NATURAL };

struct scene_dynamic {
    struct ball_lattice lattice;
    bool has_lattice;
    struct deck_place lattice_place;
    enum kernel_mode mode;
    double velocity[3], spin; /* at the start; about z through the centre */
    double gravity[3];
    double stabilisation;     /* of nsni: factor of the moduli; negative: the law's own */
    enum rkpm_wall wall;
    int wall_axis;
    double wall_position;
    double wall_modulus;      /* of springs: pressure over depth */
    bool wall_sticks, wall_releases;
    struct deck_place wall_place;
};

#endif
