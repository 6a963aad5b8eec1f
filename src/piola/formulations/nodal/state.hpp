// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"
#include "piola/formulations/nodal/fields.hpp"
#include "piola/formulations/nodal/lattice.hpp"
#include "piola/materials/registry.hpp"
#include "piola/mechanics/prescribed_data.hpp"

namespace piola {
class BlockLaw;
class SurfaceConstraint;
class HaloPlan;
}

/// State of one body for the loops: plain data, independent of the instruction set.
namespace piola::nodal {

struct Constants {
  double rho0;         ///< reference density [kg/m^3]
  double kappa;        ///< bulk modulus [Pa]
  double mu;           ///< shear modulus [Pa]
  double kappa_local;  ///< stiffness of the logarithmic term [Pa]
  double unit_step;    ///< smallest spacing over the p-wave speed at rest [s]
  bool stress_free;    ///< in the missing directions; else they do not stretch
  double shock;        ///< coefficient of the viscous pressure of shocks [Pa s2]
  double least_share;  ///< fraction of its volume ratio at the step's start that a point of a cell must keep
};

/// How the cells of a material fail.
struct FailureConstants {
  double strength = unbounded;  ///< tensile strength [Pa]; infinity: no cracks
  double energy = 0;            ///< of a crack per area [J/m^2]
  double modulus = 0;           ///< stress over strain across a crack [Pa]
  double band = 0;              ///< width of the two rows of cells that a crack breaks [m]
  bool damages = false;         ///< cells of damage 1 soften
  double per_time = 0;          ///< softening of such cells [1/s]
  double per_strain = 0;        ///< and by equivalent plastic strain; 0: by time
};

/// The particles of a body with one material: slots [first, last).
struct MaterialRange {
  MaterialParameters material;
  Constants constants;
  Index first, last;
  FailureConstants failure{};
  BlockLaw const* block = nullptr;  ///< the law, if it works on blocks of points; else null
};

/// Code of a FailureSlot: a law on blocks of points fails. Added to it: the code of the law, 0 if its stress is not a
/// number.
inline constexpr int failure_of_law = 1000;

/// Coefficients of the rates in viscous stresses that laws do not have, see Viscosity.
struct ViscousConstants {
  double fluctuation;  ///< [Pa s]
  double shock;        ///< of hyperelastic laws [Pa s2]
};

/// A particle on mirror planes; a bit for each of their axes.
struct MirroredParticle {
  Index slot;
  int axes;
};

struct BodyState;
class AbsorbingSurface;
class ImplicitPressure;

/// Neighbours of a cloud, a list per particle: the weight s, and the gradients of a pair in both directions.
struct GradientList {
  std::int64_t const* begin = nullptr;  ///< per particle, one more at the end
  Index const* neighbour = nullptr;
  double const* s = nullptr;
  double const* gradient = nullptr;  ///< G_ab [1/m], D per pair, and one more value at the end
  double const* reaction = nullptr;  ///< V_b G_ba [m^(D-1)], the same
  double const* s_back = nullptr;    ///< the weight for b; s unless gradients change
};

/// Supports, loads and mirror planes of a body.
struct BoundaryState {
  PrescribedDirection* held = nullptr;
  Index held_count = 0;
  LoadedParticle* loaded = nullptr;
  Index loaded_count = 0;
  double const* loaded_centroid = nullptr;  ///< [loaded][D]: of the cell, relative to the particle [m]
  double const* loaded_radius = nullptr;  ///< [loaded]: reference radius, 0 on the axis [m]; nullptr: not axisymmetric
  MirroredParticle const* mirrored = nullptr;
  Index mirrored_count = 0;
  SurfaceConstraint* surface = nullptr;  ///< surface places that supports hold; nullptr: none
  void (*kick_surface)(SurfaceConstraint& surface, BodyState& body, bool first, double dt) = nullptr;
  AbsorbingSurface* absorbing = nullptr;  ///< dashpots on non-reflecting patches; nullptr: none
  void (*absorb)(AbsorbingSurface& surface, BodyState& body, double half, bool at_end) = nullptr;
  bool follows = false;  ///< whether some load is a follower load
};

struct BodyState : Fields {
  using Fields::Fields;
  Range slots;          ///< slots that loops work on: the local ones
  Index all_slots = 0;  ///< all slots, from 0 on
  Constants constants{};
  ViscousConstants viscosity{};
  MaterialRange const* materials = nullptr;  ///< in the order of slots; together all particles
  Index material_count = 0;
  Index particles = 0;  ///< the slots after them are empty
  GradientList list;
  LatticeTable lattice;  ///< replaces the lists if particles fill a lattice

  /// Values of a particle that its neighbours read, by the sweep that reads them: for the sums of the motion, records
  /// of X and x, or x on a lattice; for the sums of forces, `stress`, or `resultants` on a lattice.
  FieldRef motion_for_neighbours, stress_for_neighbours;

  BoundaryState boundary;
  ImplicitPressure* implicit_pressure = nullptr;  ///< nullptr: the pressure is explicit
  /// The motion of a step by the pressure of the bulk modulus, and by the velocity that the first kick has left.
  void (*move_by_pressure)(ImplicitPressure& pressure, double dt) = nullptr;
  double time = 0;            ///< at the end of the step [s]
  bool marks = false;         ///< forces at x also store F^T F in C_measured
  bool refits = false;        ///< a step of length 0 takes over gradients that have changed, see FailureLayout
  double* partial = nullptr;  ///< room for the partial results of blocks
  FailureSlot* failure = nullptr;
  HaloPlan* halo = nullptr;       ///< nullptr if not distributed
  Index const* ghosts = nullptr;  ///< ghost slots
  Index ghost_count = 0;
};

/// The loops of one instruction set. Every entry accepts bodies of 1, 2 or 3 dimensions.
struct Backend {
  char const* name;
  int lanes;
  void (*step)(BodyState& body, double dt);         ///< one step of one body
  void (*accelerate)(BodyState& body);              ///< a of the internal forces alone, at x
  void (*update_output_fields)(BodyState& body);    ///< computes F, P and cell, which steps do not
  void (*linearise_pressure)(BodyState& body);      ///< `unit` and `ratio` at x
  void (*change_of_ratio)(BodyState& body);         ///< `ratio`: change by the vectors in x, linearised
  void (*accelerate_by_pressure)(BodyState& body);  ///< a by the pressures in `ratio`, linearised
  double (*largest_change)(BodyState& body);        ///< of a strain since the last measurement of the step
  void (*keep)(BodyState& body);                    ///< saves x, v, a and the least J at the start of a step
  void (*restore)(BodyState& body);                 ///< restores them
  /// Subtracts the gradient of positions at the particles from `offset`. `centroid`: of cells, relative to the
  /// particles [m].
  void (*subtract_gradients)(BodyState& body, FieldRef const& centroid);
};

/// The instruction set of that name, or the best one of this processor for "auto"; nullptr if it is unknown or not
/// usable here.
Backend const* find_backend(char const* name);
/// Names of the instruction sets in this program that this processor can run, best first; ends with nullptr.
char const* const* backend_names();
/// As find_backend; throws InputError if there is none.
Backend const& choose_backend(char const* name);

}  // namespace piola::nodal
