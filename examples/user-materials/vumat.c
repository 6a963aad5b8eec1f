/* SPDX-License-Identifier: Apache-2.0 */
/* Runs a VUMAT subroutine of Abaqus/Explicit as a material law of Piola. The subroutine is compiled as it is:
 *
 *   gfortran -O3 -c -fPIC -I PIOLA/examples/user-materials my_vumat.f      (finds vaba_param.inc here)
 *   cc -O3 -shared -fPIC -I PIOLA/include -DVUMAT_PROPS=5 -DVUMAT_STATES=2 vumat.c my_vumat.o -o my_vumat.so -lgfortran
 *
 * Case: material = { library = "my_vumat.so", density = ..., prop1 = ..., prop2 = ... }, props(k) in SI, without units.
 * State variables are the fields state1, state2, ... of results.
 *
 * What it does as documented for solid elements (ndir = 3, nshr = 3): Cauchy stress, strain increment and state in axes
 * that rotate with the material; stretches, deformation gradients, density now, specific internal energy. What it does
 * not: temperatures are VUMAT_TEMPERATURE, field variables are none, coordMp and relSpinInc are 0, charLength is
 * VUMAT_LENGTH, cmname is VUMAT_NAME. In the first call stepTime = totalTime = 0 with dt = 1, for an elastic answer.
 * Subroutines with SAVE or COMMON need -DVUMAT_PROPERTIES=6.
 */
#include "piola_strain.h"
#include <math.h>
#include <stddef.h>
#include <string.h>

#ifndef VUMAT_PROPS
#error "say how many props the subroutine reads: -DVUMAT_PROPS=5"
#endif
#ifndef VUMAT_STATES
#error "say how many state variables it has: -DVUMAT_STATES=2"
#endif
#ifndef VUMAT_NAME
#define VUMAT_NAME "vumat"
#endif
#ifndef VUMAT_TEMPERATURE
#define VUMAT_TEMPERATURE 293.15
#endif
#ifndef VUMAT_LENGTH
#define VUMAT_LENGTH 1
#endif
#ifndef VUMAT_PROPERTIES
#define VUMAT_PROPERTIES PIOLA_YIELDS
#endif

enum { BLOCK = 64, STATES = VUMAT_STATES > 0 ? VUMAT_STATES : 1, PROPS = VUMAT_PROPS > 0 ? VUMAT_PROPS : 1 };

void vumat_(const int *nblock, const int *ndir, const int *nshr, const int *nstatev, const int *nfieldv,
            const int *nprops, const int *lanneal, const double *stepTime, const double *totalTime, const double *dt,
            const char *cmname, const double *coordMp, const double *charLength, const double *props,
            const double *density, const double *strainInc, const double *relSpinInc, const double *tempOld,
            const double *stretchOld, const double *defgradOld, const double *fieldOld, const double *stressOld,
            const double *stateOld, const double *enerInternOld, const double *enerInelasOld, const double *tempNew,
            const double *stretchNew, const double *defgradNew, const double *fieldNew, double *stressNew,
            double *stateNew, double *enerInternNew, double *enerInelasNew, size_t cmname_length);

/* The arrays of a call, component after component. */
typedef struct work {
  double coordinates[3 * BLOCK], length[BLOCK], density[BLOCK], strain[6 * BLOCK], spin[3 * BLOCK], temperature[BLOCK],
      stretch_old[6 * BLOCK], stretch_new[6 * BLOCK], gradient_old[9 * BLOCK], gradient_new[9 * BLOCK], field[BLOCK],
      stress_old[6 * BLOCK], stress_new[6 * BLOCK], state_old[STATES * BLOCK], state_new[STATES * BLOCK],
      energy_old[BLOCK], energy_new[BLOCK], inelastic_old[BLOCK], inelastic_new[BLOCK];
} work;

/* Points first to first + n - 1 of the block. */
static void take(const piola_points *at, int first, int n, work *w) {
  static const int of_gradient[9] = {0, 4, 8, 1, 5, 6, 3, 7, 2}; /* 11 22 33 12 23 31 21 32 13 */
  memset(w, 0, sizeof *w);
  for (int k = 0; k < n; ++k) {
    const int p = first + k, s = at->stride;
    double d[6], J = 0;
    piola_strain_increment(at, p, d);
    for (int c = 0; c < 6; ++c) {
      w->strain[c * n + k] = d[c];
      w->stretch_old[c * n + k] = at->U_old[c * s + p];
      w->stretch_new[c * n + k] = at->U_new[c * s + p];
      w->stress_old[c * n + k] = at->stress[c * s + p];
    }
    for (int c = 0; c < 9; ++c) {
      w->gradient_old[c * n + k] = at->F_old[of_gradient[c] * s + p];
      w->gradient_new[c * n + k] = at->F_new[of_gradient[c] * s + p];
    }
    for (int c = 0; c < VUMAT_STATES; ++c) w->state_old[c * n + k] = at->history[c * s + p];
    const double *u = at->U_new + p;
    J = u[0] * (u[s] * u[2 * s] - u[4 * s] * u[4 * s]) - u[3 * s] * (u[3 * s] * u[2 * s] - u[4 * s] * u[5 * s]) +
        u[5 * s] * (u[3 * s] * u[4 * s] - u[s] * u[5 * s]);
    w->density[k] = at->density / J;
    w->length[k] = VUMAT_LENGTH;
    w->temperature[k] = VUMAT_TEMPERATURE;
    w->energy_old[k] = at->energy[p] / at->density;
  }
}

static int update(const piola_points *at) {
  static const int three = 3, none = 0, states = VUMAT_STATES, props = VUMAT_PROPS;
  const double dt = at->dt > 0 ? at->dt : 1, time = at->dt > 0 ? at->time : 0;
  char name[80];
  work w;
  memset(name, ' ', sizeof name);
  memcpy(name, VUMAT_NAME, strlen(VUMAT_NAME));
  for (int first = 0; first < at->count; first += BLOCK) {
    const int n = at->count - first < BLOCK ? at->count - first : BLOCK;
    take(at, first, n, &w);
    vumat_(&n, &three, &three, &states, &none, &props, &none, &time, &time, &dt, name, w.coordinates, w.length,
           at->parameters, w.density, w.strain, w.spin, w.temperature, w.stretch_old, w.gradient_old, w.field,
           w.stress_old, w.state_old, w.energy_old, w.inelastic_old, w.temperature, w.stretch_new, w.gradient_new,
           w.field, w.stress_new, w.state_new, w.energy_new, w.inelastic_new, sizeof name);
    for (int k = 0; k < n; ++k) {
      for (int c = 0; c < 6; ++c) at->stress[c * at->stride + first + k] = w.stress_new[c * n + k];
      for (int c = 0; c < VUMAT_STATES; ++c) at->history[c * at->stride + first + k] = w.state_new[c * n + k];
    }
  }
  return 0;
}

const piola_material *piola_materials(int interface_version, int *count) {
  static char names[PROPS][16], state_names[STATES][16];
  static piola_parameter parameters[PROPS];
  static piola_history history[STATES];
  static piola_material law = {.interface_version = PIOLA_MATERIAL_INTERFACE,
                               .name = VUMAT_NAME,
                               .about = "a VUMAT subroutine",
                               .stress = PIOLA_COROTATED_CAUCHY,
                               .properties = VUMAT_PROPERTIES,
                               .parameter_count = VUMAT_PROPS,
                               .parameters = parameters,
                               .history_count = VUMAT_STATES,
                               .history = history,
                               .update = update};
  for (int k = 0; k < VUMAT_PROPS; ++k) {
    char *end = names[k] + strlen(strcpy(names[k], "prop"));
    if (k + 1 >= 10) *end++ = (char)('0' + (k + 1) / 10);
    *end++ = (char)('0' + (k + 1) % 10);
    *end = 0;
    parameters[k] = (piola_parameter){names[k], "1", "props of the subroutine, SI", -HUGE_VAL, HUGE_VAL, NAN};
  }
  for (int k = 0; k < VUMAT_STATES; ++k) {
    char *end = state_names[k] + strlen(strcpy(state_names[k], "state"));
    if (k + 1 >= 100) *end++ = (char)('0' + (k + 1) / 100);
    if (k + 1 >= 10) *end++ = (char)('0' + (k + 1) / 10 % 10);
    *end++ = (char)('0' + (k + 1) % 10);
    *end = 0;
    history[k] = (piola_history){state_names[k], "1", 0};
  }
  *count = 1;
  return interface_version == PIOLA_MATERIAL_INTERFACE ? &law : NULL;
}
