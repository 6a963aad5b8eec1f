/* SPDX-License-Identifier: Apache-2.0 */
/* For laws in rate form with the interface piola_material.h. */
#ifndef PIOLA_STRAIN_H
#define PIOLA_STRAIN_H
#include "piola_material.h"

/* The strain increment of point p in axes that rotate with the material, sym((U_new - U_old) M^-1) with the mean stretch
 * M = (U_new + U_old) / 2: 11 22 33 12 23 13, tensor components. Sums over the steps of a simple tension to the
 * logarithmic strain, with an error of second order in the step. */
static inline void piola_strain_increment(const piola_points *at, int p, double d[6]) {
  static const int full[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
  double change[9], m[9], c[9], l[9];
  for (int k = 0; k < 9; ++k) {
    const double before = at->U_old[full[k] * at->stride + p], after = at->U_new[full[k] * at->stride + p];
    change[k] = after - before;
    m[k] = 0.5 * (after + before);
  }
  /* Cofactors: m is symmetric, and so is its inverse. */
  c[0] = m[4] * m[8] - m[5] * m[5];
  c[1] = c[3] = m[2] * m[5] - m[1] * m[8];
  c[2] = c[6] = m[1] * m[5] - m[2] * m[4];
  c[4] = m[0] * m[8] - m[2] * m[2];
  c[5] = c[7] = m[1] * m[2] - m[0] * m[5];
  c[8] = m[0] * m[4] - m[1] * m[1];
  const double determinant = m[0] * c[0] + m[1] * c[1] + m[2] * c[2];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      l[3 * i + j] =
          (change[3 * i] * c[j] + change[3 * i + 1] * c[3 + j] + change[3 * i + 2] * c[6 + j]) / determinant;
  d[0] = l[0];
  d[1] = l[4];
  d[2] = l[8];
  d[3] = 0.5 * (l[1] + l[3]);
  d[4] = 0.5 * (l[5] + l[7]);
  d[5] = 0.5 * (l[2] + l[6]);
}

#endif
