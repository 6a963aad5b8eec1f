// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/observers/stop_request.hpp"
#include "piola/observers/time_state.hpp"
#include "piola/output/checkpoint.hpp"
#include "piola/output/field_cache.hpp"
#include "piola/output/summary.hpp"
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// Guards check a run from time to time and judge whether its result is reliable. They have read access only.
namespace piola {

/// Energy scale of a run [J], to which energy fractions refer.
class EnergyScale {
 public:
  /// mass [kg], spacing: the smallest [m]; rounding: see roundoff_energy [J].
  EnergyScale(double mass, double spacing, double rounding) : mass_(mass), spacing_(spacing), rounding_(rounding) {}
  void observe(Diagnostics const& now, TimeState const& moment);
  /// The largest of: energy at the start, sum of |external work|, kinetic energy so far. At least the kinetic energy at
  /// 1e-9 of the wave speed and the rounding level of strain energy, because a body at rest has nothing else.
  double value() const;
  /// value() without kinetic energy.
  double without_motion() const;
  double initial() const { return initial_; }
  void save(StateWriter& writer, std::string_view name = "guard_scale") const;
  void load(NamedState& reader, std::string_view name = "guard_scale");

 private:
  double mass_, spacing_, rounding_;
  double begun_ = 0, initial_ = 0, work_ = 0, last_work_ = 0, kinetic_ = 0, floor_ = 0;
};

/// Energy of which a hundredth is above the rounding of strain energy [J]: terms of the size of the moduli, which
/// cancel without strain, have a relative error of 1e-16.
double roundoff_energy(CaseSpec const& spec, ParticleSet const& particles);

/// Input of a guard.
struct GuardInput {
  Formulation const& formulation;
  TimeState const& moment;
  Diagnostics const& now;
  EnergyScale const& scale;
  FieldCache& fields;
  bool last;  ///< of the run
};

class Guard {
 public:
  virtual ~Guard() = default;
  virtual void look(GuardInput const& look) = 0;
  /// Values for the summary; empty if they have no meaning.
  virtual std::optional<GuardNumbers> numbers() const = 0;
  /// Warning for the user; empty if there is none.
  virtual std::string words() const = 0;
  virtual std::optional<StopRequest> stop_request() const { return std::nullopt; }
  virtual void save(StateWriter& writer) const = 0;
  virtual void load(NamedState& reader) = 0;
};

/// A particle with its positions at one time, stored by a guard.
struct Suspect {
  double id = -1, time = 0;
  std::array<double, 3> x{};
  bool known() const { return id >= 0; }
  /// "particle 3 of body 'plate' (X = (1, 2, 0) m, x = (1, 2.5, 0) m)".
  std::string text(ParticleSet const& particles) const;
};
Suspect suspect(FieldCache& fields, std::size_t id, double time);
/// Half the squared speed of each particle [m2/s2]; zero if the formulation has no velocities.
std::vector<double> kinetic_per_mass(FieldCache& fields, ParticleSet const& particles);
/// The particle whose kinetic energy grew most since `before` (see kinetic_per_mass), or is largest if that is empty;
/// empty if the formulation has no velocities.
std::optional<Suspect> most_moved(FieldCache& fields, ParticleSet const& particles, std::vector<double> const& before,
                                  double time);
/// Sets the particle of a failure.
void take_particle(Failure& failure, Suspect const& suspect, ParticleSet const& particles);
/// Total energy minus external work [J], which only an error can raise. If energies belong to times half a step apart,
/// the formulation supplies a sum that does not rise.
double energy_without_work(Diagnostics const& diagnostics);

/// The value of a column that only some formulations have.
std::optional<double> column_of(Diagnostics const& diagnostics, std::string_view name);

/// Whether a body has an initial pressure, whose energy no column contains.
bool starts_under_pressure(CaseSpec const& spec);
/// Whether a support prescribes a velocity.
bool has_driven_support(CaseSpec const& spec);
/// Least transit time of a pressure wave across the spacing of a body [s]; infinity if no law has a wave speed. speed:
/// of the motion, added to that of the waves, per body [m/s]; empty: 0.
double crossing_time(CaseSpec const& spec, ParticleSet const& particles, std::vector<double> const& speed = {});

using Guards = std::vector<std::unique_ptr<Guard>>;
/// The guards of a run, in the order of their reports.
Guards make_guards(CaseSpec const& spec, ParticleSet const& particles);

std::unique_ptr<Guard> make_energy_guard(GuardLimits const& limits, ParticleSet const& particles);
std::unique_ptr<Guard> make_dissipation_guard(GuardLimits const& limits);
std::unique_ptr<Guard> make_jacobian_guard(CaseSpec const& spec, ParticleSet const& particles);
std::unique_ptr<Guard> make_overlap_guard(GuardLimits const& limits);
std::unique_ptr<Guard> make_strain_drift_guard(GuardLimits const& limits, ParticleSet const& particles);
std::unique_ptr<Guard> make_proximity_guard(CaseSpec const& spec, ParticleSet const& particles);
std::unique_ptr<Guard> make_step_guard(CaseSpec const& spec, ParticleSet const& particles);
std::unique_ptr<Guard> make_small_strain_guard(CaseSpec const& spec, ParticleSet const& particles);
std::unique_ptr<Guard> make_following_load_guard(CaseSpec const& spec, ParticleSet const& particles);

}  // namespace piola
