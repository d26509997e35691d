/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eigenvalues of small symmetric matrices. */
#ifndef BASE_SYMMETRIC_H
#define BASE_SYMMETRIC_H

enum { SYMMETRIC_LARGEST = 6 };

/* Eigenvalues of the upper left n x n part (n <= 6) of a symmetric matrix, which is destroyed, and their
 * vectors as columns, by plane rotations (Jacobi, J. reine angew. Math. 30, 1846). */
void symmetric_eigen(int n, double matrix[SYMMETRIC_LARGEST][SYMMETRIC_LARGEST], double values[SYMMETRIC_LARGEST],
                     double vectors[SYMMETRIC_LARGEST][SYMMETRIC_LARGEST]);

#endif
