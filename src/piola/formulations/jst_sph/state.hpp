// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"
#include "piola/formulations/jst_sph/fields.hpp"
#include "piola/materials/registry.hpp"
#include "piola/mechanics/prescribed_data.hpp"
#include "piola/neighbours/pair_table_views.hpp"

namespace piola {
class HaloPlan;
class DeferredGlobalSum;
}

/// State of one body for the loops: plain data, independent of the instruction set.
namespace piola::jst_sph {

/// The unknowns of the conservation laws; the rest of the geometry follows from them.
enum class Variables {
  pF,           ///< momentum and deformation gradient: H = cof F, J = det F
  pFJ,          ///< and the volume ratio J, eq. (1d): H = cof F
  pFHJ,         ///< and the area map H, eq. (1c)
  displacement  ///< F from positions, eq. (34): classical total-Lagrangian SPH
};

/// Whether the volume ratio is evolved.
constexpr bool evolves_volume(Variables v) { return v == Variables::pFJ || v == Variables::pFHJ; }

/// Form of the biharmonic stabilisation, from the corrected Laplacian L.
enum class Biharmonic {
  none,
  adjoint,  ///< scheme "filtered": D4 = -L* (eps4 c h^3 L p), never feeds energy
  literal   ///< scheme "paper": D4 = -eps4 c h^3 L (L p), eq. (37b)
};

/// A velocity component of a particle that a support holds at rest for the whole run.
struct SupportComponent {
  Index slot;
  std::int32_t component;
  double position;          ///< prescribed position [m]
  double removed;           ///< Verlet: the acceleration by the support at the end of the last step [m/s2]
  double at_start, at_end;  ///< velocity changes by the support in this step, at its start and end positions [m/s]
};

class Multipliers;

/// Time within a step at which multipliers correct the velocity.
struct MultiplierCall {
  enum class When {
    start,       ///< v at t = 0
    stage_1,     ///< Runge-Kutta: v* and, with it, x^(n+1)
    stage_2,     ///< Runge-Kutta: v^(n+1)
    first_kick,  ///< Verlet: the acceleration that leads from v^n to v^(n+1/2)
    second_kick  ///< Verlet: v^(n+1)
  } when;
  double dt;
};

/// Number of passes n of the volumetric filter B = S^n.
inline constexpr int filter_passes = 2;

/// Time integration.
enum class Integrator {
  tvd_rk2,  ///< scheme "paper" and displacement variables: two stages, eq. (43)
  verlet    ///< scheme "filtered": kick, drift, kick: one right-hand side, exact angular momentum
};

struct Constants {
  double rho0;            ///< reference density [kg/m^3]
  double kernel_volume;   ///< volume of a particle in kernel sums [m^D]
  double h_min;           ///< smallest particle spacing [m]
  double c_p0;            ///< p-wave speed at F = I [m/s]
  double eps2, eps4;      ///< harmonic and biharmonic coefficients for p, times (stabilisation speed / c_p0)
  double eps2_J, eps4_J;  ///< as eps2 and eps4, for J
  double kappa_local;     ///< part of the bulk modulus for the local volume ratio [Pa]
  double kappa_filtered;  ///< part for the filtered volume ratio [Pa]; 0: no filter
  double total_volume;    ///< sum of tributary volumes [m^D]
  double centre[3];       ///< origin of arms [m], near the body: keeps sums of moments accurate
  Variables variables;
  bool exact_speed;  ///< p-wave speed from the law's tangent, else the estimate c_p0 / lambda_min
  Biharmonic biharmonic;
  Integrator integrator;
  bool project;   ///< angular and linear momentum projection
  bool mirrored;  ///< mirror planes: no rigid motion is free
};

/// Whether the evolved volume ratio is stabilised, eq. (38).
constexpr bool smooths_volume(Constants const& k) { return k.eps2_J > 0 || k.eps4_J > 0; }

/// Contributions of a step to the energy balance of the body.
struct StepTotals {
  double stabilisation_loss = 0;  ///< J, energy removed by D(p)
  double projection_loss = 0;     ///< J, energy removed by the projection of T
  double damping_loss = 0;        ///< J, energy removed by damping
};

struct BodyState;

/// Supports and loads of a body.
struct BoundaryState {
  SupportComponent* supports = nullptr;
  Index support_count = 0;
  PrescribedDirection* held = nullptr;
  Index held_count = 0;
  Multipliers* multipliers = nullptr;  ///< nullptr: supports hold particles directly
  void (*enforce)(Multipliers& multipliers, BodyState& body, MultiplierCall const& call) = nullptr;
  LoadedParticle* loaded = nullptr;
  Index loaded_count = 0;
};

struct BodyState : Fields {
  using Fields::Fields;
  Range slots;  ///< slots that loops work on: the local ones
  Constants constants{};
  MaterialParameters material;
  bool regular = false;  ///< stencil table, else list table
  StencilTable stencil;
  ListTable list;
  /// Neighbour data of the sweeps, see NeighbourRecords. For the mixed variables `u` is v itself; for displacement it
  /// is the position of the stage.
  FieldRef u, second;

  BoundaryState boundary;
  HaloPlan* halo = nullptr;   ///< if the body is distributed; `slots` are the local ones
  double* partial = nullptr;  ///< room for the partial sums of reductions
  FailureSlot* failure = nullptr;
  StepTotals totals;
  DeferredGlobalSum* external_work = nullptr;  ///< of loads and driven supports [J]
  double largest_wave_speed = 0;               ///< of all particles at the end of the last step [m/s]
  bool trial = false;                          ///< a step that measures the stiffness: supports store no reaction
};

/// The loops of one instruction set. Every entry accepts bodies of 1, 2 or 3 dimensions.
struct Backend {
  char const* name;
  int lanes;
  void (*step)(BodyState& body, double dt);       ///< Algorithm 1, one step of one body
  void (*update_wave_speed)(BodyState& body);     ///< from the current F
  double (*largest_wave_speed)(BodyState& body);  ///< m/s
  void (*update_deformation)(BodyState& body);    ///< displacement variables: F from x
};

/// The instruction set of that name, or the best one of this processor for "auto"; nullptr if it is unknown or not
/// usable here.
Backend const* find_backend(char const* name);
/// Names of the instruction sets in this program that this processor can run, best first; ends with nullptr.
char const* const* backend_names();
/// As find_backend; throws InputError if there is none.
Backend const& choose_backend(char const* name);

}  // namespace piola::jst_sph
