/* SPDX-License-Identifier: Apache-2.0 */
/* A material law of a user's: rubber by the law neo_hookean of Piola,
 *   W = mu/2 (J^(-2/3) F:F - 3) + kappa/2 (J - 1)^2,   P = dW/dF.
 *
 * Build:  cc -O3 -march=native -shared -fPIC -I PIOLA/include neo_hookean.c -o neo_hookean.so -lm
 * Use:    material = { library = "neo_hookean.so", density = "1100 kg/m^3", mu = "5.9 MPa", kappa = "57 MPa" }
 */
#include "piola_material.h"
#include <math.h>

enum { MU, KAPPA };

static const piola_parameter parameters[] = {{"mu", "Pa", "shear modulus", 1e-300, HUGE_VAL, NAN},
                                             {"kappa", "Pa", "bulk modulus", 1e-300, HUGE_VAL, NAN}};

static int update(const piola_points *at) {
  const double mu = at->parameters[MU], kappa = at->parameters[KAPPA];
  const int n = at->stride;
  for (int p = 0; p < at->count; ++p) {
    double F[9], H[9], square = 0;
    for (int c = 0; c < 9; ++c) F[c] = at->F_new[c * n + p];
    for (int c = 0; c < 9; ++c) square += F[c] * F[c];
    /* H: cofactor of F, the derivative of J = det F. */
    H[0] = F[4] * F[8] - F[5] * F[7];
    H[1] = F[5] * F[6] - F[3] * F[8];
    H[2] = F[3] * F[7] - F[4] * F[6];
    H[3] = F[2] * F[7] - F[1] * F[8];
    H[4] = F[0] * F[8] - F[2] * F[6];
    H[5] = F[1] * F[6] - F[0] * F[7];
    H[6] = F[1] * F[5] - F[2] * F[4];
    H[7] = F[2] * F[3] - F[0] * F[5];
    H[8] = F[0] * F[4] - F[1] * F[3];
    const double J = F[0] * H[0] + F[1] * H[1] + F[2] * H[2];
    if (!(J > 0)) return 1;
    const double shape = 1 / (cbrt(J) * cbrt(J));
    const double pressure = kappa * (J - 1) - mu * shape * square / (3 * J);
    for (int c = 0; c < 9; ++c) at->stress[c * n + p] = mu * shape * F[c] + pressure * H[c];
    at->energy[p] = 0.5 * mu * (shape * square - 3) + 0.5 * kappa * (J - 1) * (J - 1);
  }
  return 0;
}

static const piola_material law = {.interface_version = PIOLA_MATERIAL_INTERFACE,
                                   .name = "neo_hookean",
                                   .about = "compressible neo-Hookean rubber",
                                   .stress = PIOLA_FIRST_PIOLA,
                                   .properties = PIOLA_ELASTIC,
                                   .parameter_count = 2,
                                   .parameters = parameters,
                                   .update = update};

const piola_material *piola_materials(int interface_version, int *count) {
  if (interface_version != PIOLA_MATERIAL_INTERFACE) return 0;
  *count = 1;
  return &law;
}
