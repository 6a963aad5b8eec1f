// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"
#include "piola/exec/parallel.hpp"
#include "piola/materials/registry.hpp"
#include "piola/neighbours/tables.hpp"

/// One body of a nodal run as its loops see it: plain data that crosses between machines.
namespace piola::nodal {

/// A direction in which the velocity of a particle is prescribed. The directions of one particle are orthonormal.
struct HeldDirection {
  Index slot;
  double direction[3];   ///< unit vector
  double mass;           ///< of the particle [kg]
  double before, after;  ///< prescribed velocity at the ends of the step [m/s]
  double impulse;        ///< of the reaction in this step [N s]
  double work;           ///< of the reaction in this step [J]
};

/// A particle on which a load acts.
struct LoadedParticle {
  Index slot;
  double mass;                 ///< [kg]
  double before[3], after[3];  ///< acceleration by the loads at the ends of the step [m/s2]
  double work;                 ///< in this step [J]
};

struct Constants {
  double rho0;         ///< reference density [kg/m^3]
  double kappa;        ///< bulk modulus [Pa]
  double kappa_local;  ///< stiffness of the logarithmic term [Pa]
  double unit_step;    ///< smallest spacing over the p-wave speed at rest [s]
};

struct BodyState {
  int dimension = 3;
  Range slots;
  Constants constants{};
  MaterialParameters material;
  ListTable list;

  // Reference: volume of the cell; mass; Cholesky factor of the cell's spread times the parity (columns of L: D x D);
  // what derivatives are of the sums: g (values x D) for F, k (terms x second) for H; sums of s P and of s mu.
  FieldRef V, mass, L, g, k, own;
  // Evolved: position, velocity; acceleration by all forces, of the positions.
  FieldRef x, v, a;
  FieldRef first;               ///< what the first sweep reads of neighbours: X, x, mu
  FieldRef second;              ///< and the second: rows (Y_i, Z_i)
  FieldRef F, P;                ///< gradient at the centroid; mean stress, three-dimensional: for observers
  FieldRef cell;                ///< energy per volume, mean J, least J: for observers
  FieldRef C_measured, change;  ///< F^T F when the step was last measured; largest change of a strain since
  FieldRef kept;                ///< x, v, a at the start of the step

  HeldDirection* held = nullptr;
  Index held_count = 0;
  LoadedParticle* loaded = nullptr;
  Index loaded_count = 0;
  double* partial = nullptr;  ///< room for the partial results of blocks
  FailureSlot* failure = nullptr;
};

/// The loops of one machine (instruction set). Every entry takes bodies of 1, 2 or 3 dimensions.
struct Machine {
  char const* name;
  int lanes;
  void (*step)(BodyState& body, double dt);   ///< one step of one body
  void (*accelerate)(BodyState& body);        ///< a of the internal forces alone, at x
  void (*observe)(BodyState& body);           ///< the fields for observers, at x
  double (*largest_change)(BodyState& body);  ///< of a strain since the step was measured
  void (*keep)(BodyState& body);              ///< remembers x, v and a
  void (*restore)(BodyState& body);           ///< and takes them back
};

/// The machine of that name, or the best one of this processor for "auto"; nullptr if it is unknown or not usable here.
Machine const* find_machine(char const* name);
/// Names of the machines in this program that this processor can run, best first; ends with nullptr.
char const* const* machine_names();

}  // namespace piola::nodal
