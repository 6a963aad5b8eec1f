// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"
#include "piola/exec/parallel.hpp"
#include "piola/formulations/nodal/lattice.hpp"
#include "piola/materials/registry.hpp"
#include "piola/mechanics/held.hpp"
#include "piola/neighbours/tables.hpp"

namespace piola {
class SurfaceHold;
class HaloPlan;
}

/// One body of a nodal run as its loops see it: plain data that crosses between machines.
namespace piola::nodal {

struct Constants {
  double rho0;         ///< reference density [kg/m^3]
  double kappa;        ///< bulk modulus [Pa]
  double mu;           ///< shear modulus [Pa]
  double kappa_local;  ///< stiffness of the logarithmic term [Pa]
  double unit_step;    ///< smallest spacing over the p-wave speed at rest [s]
  bool stress_free;    ///< in the directions that the body does not have; else they do not stretch
  double least_share;  ///< of its volume ratio at the step's start that a point of a cell must keep
};

/// Where values lie in the field `history` of solids in rate form, which is of the end of the last step.
struct SolidPlaces {
  /// Of the cell: pressure, positive in compression [Pa]; specific internal energy [J/kg].
  enum : int { pressure, energy, of_cell };
  /// Of a point of it, counted from point(q, D).
  enum : int {
    S,                   ///< deviatoric Cauchy stress [Pa], 6 values
    plastic_strain = 6,  ///< equivalent plastic strain
    temperature,         ///< [K]
    damage,              ///< 0 to 1
    plastic_work,        ///< per reference volume [J/m^3]
    spread,              ///< tension over that of the cell [Pa]
    F                    ///< deformation gradient, D x D values
  };

  static constexpr int point(int q, int D) { return of_cell + q * (F + D * D); }
};

/// The particles of a body that have one material: slots [first, last).
struct MaterialRange {
  MaterialParameters material;
  Constants constants;
  Index first, last;
};

/// What viscous stresses multiply rates by, see Viscosity.
struct ViscousConstants {
  double fluctuation;                    ///< [Pa s]
  double shock_linear, shock_quadratic;  ///< [Pa s], [Pa s2]
};

/// A particle on mirror planes, and across which axes these are: a bit each.
struct MirroredParticle {
  Index slot;
  int axes;
};

struct BodyState {
  int dimension = 3;
  Range slots;          ///< that loops work on: on several ranks those of this rank
  Index all_slots = 0;  ///< that there are, from 0 on
  Constants constants{};
  ViscousConstants viscosity{};
  MaterialRange const* materials = nullptr;  ///< in the order of slots; together all particles
  Index material_count = 0;
  Index particles = 0;  ///< the slots after them are empty
  ListTable list;
  LatticeTable lattice;  ///< takes the place of lists where particles fill a lattice

  // Reference: volume of the cell; mass; Cholesky factor of the cell's spread times the parity (columns of L: D x D);
  // what derivatives are of the sums: g (values x D) for F, k (terms x second) for H; sums of s P and of s mu.
  FieldRef V, mass, L, g, k, own;
  // Evolved: position, velocity; acceleration by all forces, of the positions.
  FieldRef x, v, a;
  FieldRef mu;      ///< corrections of the gradients
  FieldRef first;   ///< what the first sweep reads of neighbours: X, x, mu; of a lattice x_c mu_J
  FieldRef second;  ///< and the second: rows (Y_i, Z_i)
  FieldRef F, P;    ///< gradient at the centroid; mean stress, three-dimensional: for observers
  FieldRef cell;    ///< energy per volume, mean J, least J: for observers
  FieldRef C_measured,
      change;  ///< F^T F when the step was last measured; largest change of a strain since, least J now
  FieldRef viscous, viscous_kept;  ///< see ViscousHistory, and at the start of the step; without data: no viscosity
  FieldRef kept;                   ///< x, v, a and the least J at the start of the step
  FieldRef history,
      history_kept;  ///< see SolidPlaces, and at the start of the step; without data: no solids in rate form

  HeldDirection* held = nullptr;
  Index held_count = 0;
  LoadedParticle* loaded = nullptr;
  Index loaded_count = 0;
  double const* loaded_centroid = nullptr;  ///< [loaded][D]: of the cell, relative to the particle [m]
  MirroredParticle const* mirrored = nullptr;
  Index mirrored_count = 0;
  SurfaceHold* surface = nullptr;  ///< what supports hold of the surface; nullptr: nothing
  void (*kick_surface)(SurfaceHold& surface, BodyState& body, bool first, double dt) = nullptr;
  bool follows = false;       ///< whether some load turns with the deformed face
  bool marks = false;         ///< forces at x also leave F^T F there in C_measured
  double* partial = nullptr;  ///< room for the partial results of blocks
  FailureSlot* failure = nullptr;
  HaloPlan* halo = nullptr;     ///< of several ranks; nullptr: one rank has all particles
  Index const* told = nullptr;  ///< slots that other ranks tell this one of
  Index told_count = 0;
};

/// What the system of the divergence theorem at set-up needs beside the state's volumes and sums: per particle the
/// inverse of its normal equations (upper triangle, row by row); s V of itself, and its sum with s V of all neighbours;
/// the quadratic found last (values x D).
struct ProjectionFields {
  FieldRef inverse, weights, coefficients;
};

/// The loops of one machine (instruction set). Every entry takes bodies of 1, 2 or 3 dimensions.
struct Machine {
  char const* name;
  int lanes;
  void (*step)(BodyState& body, double dt);   ///< one step of one body
  void (*accelerate)(BodyState& body);        ///< a of the internal forces alone, at x
  void (*observe)(BodyState& body);           ///< the fields for observers, at x
  double (*largest_change)(BodyState& body);  ///< of a strain since the step was measured
  void (*keep)(BodyState& body);              ///< remembers x, v, a and the least J
  void (*restore)(BodyState& body);           ///< and takes them back
  /// a = the matrix of the divergence theorem times x; masses are one.
  void (*project)(BodyState& body, ProjectionFields const& fields);
};

/// The machine of that name, or the best one of this processor for "auto"; nullptr if it is unknown or not usable here.
Machine const* find_machine(char const* name);
/// Names of the machines in this program that this processor can run, best first; ends with nullptr.
char const* const* machine_names();
/// As find_machine; throws InputError if there is none.
Machine const& choose_machine(char const* name);

}  // namespace piola::nodal
