/* SPDX-License-Identifier: Apache-2.0 */
/* Interface of a material law in a shared library, for C, C++ and Fortran (iso_c_binding).
 *
 * A case names the library:  material = { library = "./my_law.so", density = "1100 kg/m^3", ... }
 * The library exports one function, piola_materials(). docs/user/user-materials.md explains all with examples;
 * `piola test-material my_law.so` checks a library.
 *
 * Conventions: SI units. X are reference and x current coordinates, F = dx/dX = R U with the rotation R and the stretch
 * U. Stresses are positive in tension. The law works on blocks of points: component c of point p of an array is at
 * array[c * stride + p], 0 <= p < count, so that loops over p can be vectorised by the compiler.
 */
#ifndef PIOLA_MATERIAL_H
#define PIOLA_MATERIAL_H

#ifdef __cplusplus
extern "C" {
#endif

/* Version of this interface. Piola refuses libraries of another version. */
#define PIOLA_MATERIAL_INTERFACE 1

/* Measures of stress. */
enum {
  /* First Piola stress P, force per reference area: 9 components, row by row: P11 P12 P13 P21 ... P33.
   * The work per reference volume is P : dF. */
  PIOLA_FIRST_PIOLA = 1,
  /* Cauchy stress in axes that rotate with the material, R^T sigma R: 6 components 11 22 33 12 23 13.
   * A law in rate form is then objective by itself. U_old and U_new are given. */
  PIOLA_COROTATED_CAUCHY = 2
};

/* Properties of a law, added together. */
enum {
  /* Stress and energy follow from F_new alone. The law has no history, and sets the energy. */
  PIOLA_ELASTIC = 1,
  /* The material yields: Piola's resistance to uneven volume changes within a cell of particles then yields, too. */
  PIOLA_YIELDS = 2,
  /* update() must not be called by several threads at a time. */
  PIOLA_ONE_THREAD = 4
};

/* A parameter of the law: a key of the table `material` of a case. The density is a key of its own. */
typedef struct piola_parameter {
  const char *name;    /* letters, digits, _ */
  const char *unit;    /* SI, such as "Pa", "1/s"; "1": a pure number */
  const char *meaning; /* for messages and the manual */
  double least, most;  /* allowed values */
  double preset;       /* default; NaN: the case must give it */
} piola_parameter;

/* A number that the law keeps at each point from step to step. */
typedef struct piola_history {
  const char *name; /* of the field in results */
  const char *unit;
  double start; /* value at the start of a run */
} piola_history;

/* A block of points, one step. */
typedef struct piola_points {
  int count, stride;
  double time;              /* at the end of the step [s] */
  double dt;                /* length of the step [s]; 0: no time passes (start of a run, trial displacements) */
  double density;           /* in the reference configuration [kg/m^3] */
  const double *parameters; /* in the order of the description, SI */
  const double *F_old;      /* deformation gradient at the start of the step, 9 components, row by row */
  const double *F_new;      /* and at its end */
  const double *U_old;      /* stretch at the start of the step, 11 22 33 12 23 13; NULL with PIOLA_FIRST_PIOLA */
  const double *U_new;      /* and at its end */
  double *stress;           /* in: at the start of the step; out: at its end */
  double *energy;           /* per reference volume [J/m^3]. In: internal energy at the start, work of the stress;
                               out: the stored energy of elastic laws; Piola ignores it for all other laws */
  double *history;          /* in: at the start of the step; out: at its end */
  double *sound_speed;      /* out, optional: speed of pressure waves now [m/s]; preset with that at rest */
} piola_points;

typedef struct piola_material {
  int interface_version; /* PIOLA_MATERIAL_INTERFACE */
  const char *name;      /* letters, digits, _ */
  const char *about;     /* one line */
  int stress;            /* PIOLA_FIRST_PIOLA or PIOLA_COROTATED_CAUCHY */
  int properties;        /* sum of PIOLA_ELASTIC, PIOLA_YIELDS, PIOLA_ONE_THREAD; or 0 */
  int parameter_count;
  const piola_parameter *parameters;
  int history_count;
  const piola_history *history;
  /* Optional (NULL): whether parameters go together. Returns 0 if so; else writes a sentence of at most size - 1
   * characters and a 0. */
  int (*check)(const double *parameters, char *message, int size);
  /* Optional (NULL): sets history_count values at the start of a run that depend on parameters. */
  void (*start)(const double *parameters, double *history);
  /* Advances the points by one step. Returns 0; or a number > 0 that says why not, which Piola reports after it has
   * tried shorter steps. Must not keep anything between calls. */
  int (*update)(const piola_points *points);
} piola_material;

/* A library exports its laws, which must stay as they are. `interface_version` is that of Piola. */
const piola_material *piola_materials(int interface_version, int *count);

#ifdef __cplusplus
}
#endif
#endif
