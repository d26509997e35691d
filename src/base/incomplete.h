/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Incomplete factors L U of sparse matrices, without fill: L and U have blocks where the matrix has some (Meijerink and van der
 * Vorst, Math. Comp. 31, 1977). Rows follow each other on one thread, so that results do not depend on how many there are. */
#ifndef BASE_INCOMPLETE_H
#define BASE_INCOMPLETE_H

#include "base/sparse.h"

#include <stdbool.h>

struct incomplete {
    const struct sparse *matrix; /* whose blocks the factors have */
    double *value;               /* as the matrix's; blocks on the diagonal are inverted */
    size_t *diagonal;            /* per row: its block on the diagonal */
    size_t *place;               /* per column where the row that is worked on has its block, plus 1; else 0 */
};

/* Room for the factors of a matrix, each row of which has a block on the diagonal; it has to stay where it is. */
void incomplete_open(struct incomplete *incomplete, const struct sparse *matrix);
void incomplete_close(struct incomplete *incomplete);

/* Takes the matrix's numbers; rows and columns that `is_left_out` says (NULL: none) become those of the unit matrix. False
 * where a block on the diagonal loses its positive pivots. */
bool incomplete_factor(struct incomplete *incomplete, const bool *is_left_out);

/* z = (L U)^-1 r; r and z may be the same. */
void incomplete_solve(const struct incomplete *incomplete, const double *r, double *z);

#endif
