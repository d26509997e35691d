/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a smoothed particle is (COLUMN_STATE). */
#ifndef PARTICLES_STATE_H
#define PARTICLES_STATE_H

enum sph_state {
    SPH_FLUID,   /* moves; liquid or mushy */
    SPH_SOLID,   /* stays where it is, conducts heat, may melt */
    SPH_WALL,    /* belongs to a body that is a wall */
    SPH_REMOVED  /* takes part in nothing any more */
};

/* How it hangs together with the metal (COLUMN_PARTED). */
enum sph_parted {
    SPH_HOLDS,
    SPH_CAME_OFF, /* not at all */
    SPH_OF_THREAD /* by a thread of single particles */
};

#endif
