/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Residual stress and transformation strains of particles that are built up (thesis 4.2, 4.3). */
#ifndef PROCESS_TRANSFORMATION_H
#define PROCESS_TRANSFORMATION_H

#include "deck/scene.h"
#include "particles/cell_list.h"

/* Whether some material has a residual stress, or a hot zone. */
bool transformation_has_residual(const struct scene *scene);
bool transformation_has_heat(const struct scene *scene);

/* Fills the column of the residual stress: that of the material, turned by the scan angle of the
 * particle's layer in the layer's plane. A true rotation: at 45 degrees -500, -200, 0 becomes -350,
 * -350 and a shear of -150 (thesis table 4-2 has +150, which is the tensor of a scan at -45). */
void transformation_set_residual(const struct scene *scene, struct store *store);

/* Stress and energy of particles whose phase has changed while nothing has moved yet: volume strain
 * (before - after)/after (thesis 4.12), stress of the total strain less this one. */
void transformation_set_phase(const struct scene *scene, struct store *store);

/* The zone that is hot at present. */
struct heat;
struct heat *heat_open(void);
void heat_close(struct heat *heat);

/* Takes the strain of the hot zone off its particles; returns the change of their energy. */
double heat_switch_off(struct heat *heat, const struct scene *scene, struct store *store);

/* Gives the strain to all particles nearer than the radius to the particle at place p in memory
 * (strictly; the round-off of a lattice does not count), each by its own material; the radius is that
 * of p's material. Returns the change of energy. */
double heat_switch_on(struct heat *heat, const struct scene *scene, struct store *store, const struct cell_list *cells, int32_t p);

/* Particles in the zone; 0 when it is off. */
size_t heat_count(const struct heat *heat);

/* Sets their number; returns the room for their ids, where those of fewer stay as they are. */
int32_t *heat_ids(struct heat *heat, size_t count);

#endif
