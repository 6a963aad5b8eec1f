// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"
#include "piola/formulations/adaptle/equation_set.hpp"
#include "piola/formulations/adaptle/fields.hpp"
#include "piola/kernels/registry.hpp"
#include "piola/materials/registry.hpp"
#include "piola/neighbours/cell_list.hpp"
#include "piola/neighbours/pair_table_views.hpp"
#include <array>
#include <span>

/// State of an AdapTLE run for its loops: plain data, independent of the instruction set. Particles keep their slots,
/// those of a body contiguous; data for spatial sums are gathered into the order of the cell grid in every step.
namespace piola::adaptle {

enum class Viscosity { compression, monaghan, balsara, morris_monaghan, riemann };
/// Artificial stress between a total-Lagrangian and an Eulerian particle.
enum class MixedStress { both, eulerian_only, none };

/// Laws of contact between bodies, but for surface contact.
enum class ContactLaw {
  none,
  kernel,       ///< U = eps (W(r) / W(dp))^n
  linear,       ///< a spring below dp
  as_published  ///< as kernel, with eps = K V_a V_b
};

/// The radius of a ring for its section and for forces between rings: of rings at the axis that of the middle of their
/// section. spacing: dp.
template <class T>
PIOLA_INLINE_FN T ring_radius(T const& radius, double spacing) {
  T const least(0.25 * spacing);
  return maximum(maximum(radius, -radius), least);
}

/// Index in the lists of reference neighbours: tens of millions of particles have more pairs than an Index can count.
using Offset = std::int64_t;

/// The particle of an image behind the axis, or the particle itself. The image of slot i is slot particles + 1 + i.
PIOLA_INLINE_FN Index source_of(Index slot, Index particles) { return slot > particles ? slot - particles - 1 : slot; }

/// Additions of a case to the law of a point, per slot; null: none.
struct LawFactors {
  double const* initial_pressure = nullptr;  ///< positive in tension [Pa]
  double const* burnt = nullptr;             ///< burnt fraction of an explosive at half time
  double const* toughness = nullptr;         ///< factor on the failure strength
};

/// Results of spatial sums, a record per sorted particle, in the order of the sweep.
struct SpatialResult {
  static constexpr int force = 0,  ///< [N]
      heat = 3,                    ///< of viscosity and artificial stress [W]
      L = 4,                       ///< spatial velocity gradient [1/s]
      compression = 13,            ///< largest |mu_ab| of the viscosity [m/s]
      artificial = 14,             ///< artificial stress's part of the heat, of either sign [W]
      size = 15, stride = 16;
};

/// Correction of kernel and gradient (eqs. 4, 5): gt_ab = K (g S - G W) / S^2. Identity if there is none.
struct Correction {
  double S, G[3], K[9];
};

/// Constants of the particles of one body.
struct BodyConstants {
  MaterialParameters material;
  Index first = 0, last = 0;  ///< slots
  double h = 1;               ///< smoothing length of spatial sums [m]
  double reference_h = 1;     ///< of sums over reference neighbours [m]
  double spacing = 1;         ///< dp [m]
  double rho0 = 1;            ///< [kg/m3]
  double least_rho = 0;       ///< minimum of Eulerian particles: mass spread over the whole kernel [kg/m3]
  bool axisymmetric = false;
  double c = 0;  ///< of the viscosity [m/s]
  double alpha = 1, beta = 2;
  double artificial_stress = 0;    ///< epsilon
  double hourglass = 0;            ///< damping of velocities that gradients do not see
  double hourglass_stiffness = 0;  ///< against displacements that gradients do not see, over the shear modulus
  double sheared_cfl = 0.3;        ///< Courant number of lengths that shear has compressed
  double convert_strain = 0, convert_damage = 1, jacobian_min = 0, jacobian_max = 0, tether = 0;
  double shear_share = 0.5;         ///< speed of shear waves over that of pressure waves
  double bulk_modulus = 0;          ///< at rest [Pa]
  double shear_modulus = 0;         ///< [Pa]
  double yield_stress = unbounded;  ///< at rest [Pa]; infinity: the material does not yield
  double burst_pressure = 0;        ///< of an explosive [Pa]
  double poisson = 0, young = 0;    ///< of the strain across the plane (eq. 19)
  bool adaptive = false;            ///< total-Lagrangian particles may convert
  bool lagrangian = false;          ///< all particles stay total-Lagrangian
  bool releases = false;            ///< failed particles lose shear and tension
  bool deletes = false;             ///< failed total-Lagrangian particles are deleted
};

/// Forces between two bodies: U = eps (W(r) / W(dp))^n, or a linear spring of that stiffness.
struct KernelContactPair {
  double eps = 0;  ///< [J]
  double h = 1, dp = 1;
  double exponent = 4;    ///< n
  bool surfaces = false;  ///< surface contact applies while both particles have a surface
};

/// A rigid shape at half time.
struct RigidPoseAtHalfTime {
  int kind = 0;
  double centre[3], axis[3], half[3], radius, velocity[3];
};

/// Rigid shapes, and their actions on the bodies.
struct RigidTable {
  RigidPoseAtHalfTime const* pose = nullptr;
  int count = 0;
  double* power = nullptr;   ///< per slot: power of moving shapes [W]
  double* action = nullptr;  ///< [block of a body][shape]: force [N] and moment about the origin [N m]
};

/// Loads and supports, 3 values per slot. Null: none.
struct BoundaryTable {
  double const* load = nullptr;           ///< acceleration of loads at half time
  std::int8_t const* held = nullptr;      ///< directions with a prescribed velocity
  double const* held_velocity = nullptr;  ///< at the end of the step
  double* reaction = nullptr;             ///< force of supports in the step [N]
};

/// Descriptions of the particles, and requests to change them.
struct DescriptionTable {
  std::uint8_t const* eulerian = nullptr;  ///< per slot: phi > 0
  Index eulerians = 0;                     ///< their number
  std::int8_t* request = nullptr;          ///< per slot: 0 none, 1 to convert with its neighbours, 2 alone
};

struct SpatialTable {
  Index sources = 0;                   ///< number of sorted particles; the record after the last is a filler, far away
  Index const* slot = nullptr;         ///< of each sorted particle
  Index const* sorted = nullptr;       ///< of each slot
  Index targets = 0;                   ///< number of particles with a list
  Index const* target = nullptr;       ///< sorted numbers
  Index capacity = 0;                  ///< of one list
  Index const* list = nullptr;         ///< [target][capacity]: sorted numbers, padded to whole lanes
  Index const* length = nullptr;       ///< a multiple of the lanes
  std::uint8_t const* near = nullptr;  ///< per slot: whether it takes part; null: all do
  double* record = nullptr;
  int stride = 0;                    ///< of records
  double* result = nullptr;          ///< SpatialResult; zeros after the last; null: no spatial sums
  Index const* result_of = nullptr;  ///< per slot: index of its result, which may be that of the zeros
};

/// Participation in material sums: bits of MaterialTable::part.
struct ReferenceRole {
  static constexpr std::uint8_t kinematic = 1;  ///< its F is needed
  static constexpr std::uint8_t target = 2;     ///< it receives material forces
  static constexpr std::uint8_t mixed = 4;      ///< some neighbour is not total-Lagrangian
};

/// A body on a regular lattice: neighbour data in arrays, and neighbours at offsets common to whole groups of lanes.
/// Components as in MaterialRecord.
struct MaterialRows {
  Index first = 0;            ///< slot of position 0
  double* record = nullptr;   ///< component c of position i: record[c * stride + i]; null: the body has lists
  std::ptrdiff_t stride = 0;  ///< between components
  Index empty = 0;            ///< a position without a particle
  StencilTable stencil;       ///< s without volumes, and W
};

/// Changes of the gradients of a pair along the radius and along the axis.
struct AxisChange {
  double own[2], back[2];  ///< of the particle, and of the neighbour at the particle
};

/// Changes of gradients near the axis (AxisCorrection). Null: none.
struct AxisCorrectionTable {
  Offset const* begin = nullptr;  ///< per slot, one more at the end
  Index const* neighbour = nullptr;
  AxisChange const* change = nullptr;  ///< per pair
};

struct MaterialTable {
  Offset const* begin = nullptr;  ///< per slot, one more at the end: reference neighbours, padded to whole lanes
  Index const* neighbour = nullptr;
  bool used = false;             ///< whether some particle is not fully Eulerian
  double* record = nullptr;      ///< of bodies with lists; a filler after the last, then images
  Index images = 0;              ///< behind the axis
  Index const* image = nullptr;  ///< their particles
  AxisCorrectionTable axis;
  MaterialRows rows;                        ///< of the body of the current loop
  float const* gradient = nullptr;          ///< per pair: -W'(r)/r in the reference configuration, equal from both ends
  double const *s = nullptr, *W = nullptr;  ///< as `gradient`, in double, with plain gradients; W(r), as published
  std::uint8_t const* part = nullptr;       ///< per slot: ReferenceRole
  MaterialRows const* rows_of = nullptr;    ///< per body
};

struct ContactTable {
  Index targets = 0;
  Index const* target = nullptr;  ///< sorted numbers
  Index capacity = 0;
  Index const* list = nullptr;              ///< [target][capacity]: sorted numbers of particles of other bodies
  Index const* length = nullptr;            ///< per target
  KernelContactPair const* pair = nullptr;  ///< [body][body]
  ContactLaw law = ContactLaw::none;
  double published_stiffness = 0;      ///< K of the published law
  double scale = 1;                    ///< of the stiffness of rigid shapes
  std::uint8_t const* lost = nullptr;  ///< per slot: whether its surface is lost (LostSurfaces)

  /// Whether kernel contact acts between two particles, and not surface contact.
  PIOLA_INLINE_FN bool acts(KernelContactPair const& between, Index i, Index j) const {
    return !between.surfaces || lost[i] != 0 || lost[j] != 0;
  }
};

struct Settings {
  Viscosity viscosity = Viscosity::compression;
  EquationSet equations;
  MixedStress mixed_stress = MixedStress::both;
  piola::Kernel const* kernel = nullptr;  ///< of sums over neighbours, one of LaneKernels
  bool corrected = false;                 ///< spatial sums
  bool plane_stress = false, axisymmetric = false, artificial_stress = false;
  int exponent = 4;         ///< n of the artificial stress
  double fallback = 1e300;  ///< C_f
  double cfl = 0.3;
};

/// Results of a step.
struct StepSums {
  double dt = 0;  ///< stable step from the new state [s]
  double contact_power = 0, hourglass_power = 0, rigid_power = 0, held_power = 0, load_power = 0, viscous_power = 0,
         artificial_power = 0;  ///< [W]
  double overlap = 0;
  Index conversion_requests = 0;    ///< number of particles to convert or to delete
  Index axis_crossings = 0;         ///< number of times that a ring was turned back at the axis
  bool neighbour_overflow = false;  ///< whether a particle has more neighbours than can be listed
};

struct System {
  /// fields: owner of the memory of `field`; nullptr: none.
  explicit System(FieldList* fields = nullptr, FieldNeeds const& needs = {}) : field(fields, needs) {}

  bool shared = false;              ///< distributed over several ranks
  bool neighbour_overflow = false;  ///< as in StepSums, for the lists of this rank
  int dimension = 3, bodies = 0;
  Index particles = 0;
  Settings settings;
  BodyConstants const* body = nullptr;
  Range const* part = nullptr;   ///< per body: the local slots
  int const* body_of = nullptr;  ///< per slot
  Fields field;
  Correction* correction = nullptr;  ///< spatial
  double* position = nullptr;        ///< at half time, 3 per slot: input of the cell grid
  double smallest_radius = 0;        ///< particles nearer to the axis are on it at the start [m]
  DescriptionTable description;
  SpatialTable spatial;
  MaterialTable material;
  ContactTable contact;
  RigidTable rigid;
  LawFactors own;
  BoundaryTable boundary;
  double* partial = nullptr;  ///< room for reductions, 16 per block
  FailureSlot* failure = nullptr;

  /// Per body: the local slots.
  std::span<Range const> local() const { return {part, static_cast<std::size_t>(bodies)}; }
  bool is_local(Index slot) const {
    Range const of_body = part[body_of[slot]];
    return slot >= of_body.first && slot < of_body.last;
  }
  /// Axisymmetric bodies: each particle has an image behind the axis, whose slot follows those of all particles and a
  /// filler. source_of(): the particle of an image, or the particle itself.
  Index image_of(Index slot) const { return particles + 1 + slot; }
  Index source_of(Index slot) const { return adaptle::source_of(slot, particles); }
  /// Slots with those of images.
  Index all_slots() const { return settings.axisymmetric ? 2 * particles + 1 : particles; }
  /// Reference position of a local particle or a ghost [m].
  std::array<double, 3> reference_position(Index slot) const { return point_at(field.X, slot, 3); }
};

/// Codes of FailureSlot.
enum FailureCode { not_a_number = 1, negative_density = 2, inverted = 3 };

/// The loops of one instruction set.
struct Backend {
  char const* name;
  int lanes;
  void (*predict)(System&, double dt);     ///< drifts to half time; writes motion records
  void (*deform)(System&);                 ///< F and its rate at half time from reference neighbours
  void (*half_state)(System&, double dt);  ///< densities, pressures, and the records for both kernel types
  void (*correct)(System&);                ///< kernel and gradient corrections at half time
  void (*sweep)(System&);                  ///< forces, heat and velocity gradients
  StepSums (*finish)(System&, double dt);  ///< completes the step
  void (*search)(CellListSearch const&);   ///< lists of spatial neighbours
};

// As for the other formulations (exec/backend_registry.hpp).
Backend const* find_backend(char const* name);
char const* const* backend_names();
Backend const& choose_backend(char const* name);

}  // namespace piola::adaptle
