/* SPDX-License-Identifier: Apache-2.0 */
/* A material law of a user's: metal with Voce hardening, in rate form.
 *   Flow stress  sigma_y = yield_stress + saturation (1 - exp(-rate p))  of the plastic strain p,
 * radial return of the Cauchy stress in axes that rotate with the material.
 *
 * Build:  cc -O3 -march=native -shared -fPIC -I PIOLA/include voce.c -o voce.so -lm
 */
#include "piola_strain.h"
#include <math.h>

enum { YOUNG, POISSON, YIELD, SATURATION, RATE };
enum { PLASTIC_STRAIN };

static const piola_parameter parameters[] = {
    {"youngs_modulus", "Pa", "Young's modulus", 1e-300, HUGE_VAL, NAN},
    {"poissons_ratio", "1", "Poisson's ratio", -0.99, 0.499, NAN},
    {"yield_stress", "Pa", "flow stress at the plastic strain 0", 0, HUGE_VAL, NAN},
    {"saturation", "Pa", "largest increase of the flow stress", 0, HUGE_VAL, 0},
    {"hardening_rate", "1", "plastic strain at which 63 % of it are reached, inverted", 0, HUGE_VAL, 0}};
static const piola_history history[] = {{"plastic_strain", "1", 0}};

static double flow_stress(const double *c, double p) {
  return c[YIELD] + c[SATURATION] * (1 - exp(-c[RATE] * p));
}

/* The plastic strain of a step, from  mises - 3 mu x = flow_stress(p + x), by Newton's method. */
static double plastic_increment(const double *c, double mises, double mu, double p) {
  double x = 0;
  for (int k = 0; k < 50; ++k) {
    const double rest = mises - 3 * mu * x - flow_stress(c, p + x);
    const double slope = 3 * mu + c[SATURATION] * c[RATE] * exp(-c[RATE] * (p + x));
    x += rest / slope;
    if (fabs(rest) <= 1e-12 * mises) break;
  }
  return x;
}

static int update(const piola_points *at) {
  const double *c = at->parameters, mu = c[YOUNG] / (2 * (1 + c[POISSON])),
               kappa = c[YOUNG] / (3 * (1 - 2 * c[POISSON]));
  const int n = at->stride;
  for (int p = 0; p < at->count; ++p) {
    double d[6], s[6], square = 0;
    piola_strain_increment(at, p, d);
    const double volume = d[0] + d[1] + d[2];
    double mean = (at->stress[p] + at->stress[n + p] + at->stress[2 * n + p]) / 3;
    for (int k = 0; k < 6; ++k) {
      s[k] = at->stress[k * n + p] + 2 * mu * d[k];
      if (k < 3) s[k] -= mean + 2 * mu * volume / 3;
      square += (k < 3 ? 1 : 2) * s[k] * s[k];
    }
    mean += kappa * volume;
    double *plastic = at->history + PLASTIC_STRAIN * n + p;
    const double mises = sqrt(1.5 * square);
    double share = 1;
    if (mises > flow_stress(c, *plastic)) {
      const double x = plastic_increment(c, mises, mu, *plastic);
      share = 1 - 3 * mu * x / mises;
      *plastic += x;
    }
    for (int k = 0; k < 6; ++k) at->stress[k * n + p] = share * s[k] + (k < 3 ? mean : 0);
  }
  return 0;
}

static const piola_material law = {.interface_version = PIOLA_MATERIAL_INTERFACE,
                                   .name = "voce",
                                   .about = "isotropic metal with Voce hardening",
                                   .stress = PIOLA_COROTATED_CAUCHY,
                                   .properties = PIOLA_YIELDS,
                                   .parameter_count = 5,
                                   .parameters = parameters,
                                   .history_count = 1,
                                   .history = history,
                                   .update = update};

const piola_material *piola_materials(int interface_version, int *count) {
  if (interface_version != PIOLA_MATERIAL_INTERFACE) return 0;
  *count = 1;
  return &law;
}
