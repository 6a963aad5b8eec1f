// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/output/checkpoint.hpp"
#include "piola/output/field_cache.hpp"
#include "piola/output/summary.hpp"
#include "piola/simulation/moment.hpp"
#include "piola/simulation/objection.hpp"
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// Guards look at a run from time to time and judge whether its answer can be trusted. They see const state only.
namespace piola {

/// The energy that a run has to do with [J]: shares of energy are shares of this.
class EnergyScale {
 public:
  /// mass [kg], spacing: the smallest [m]; rounding: see energy_of_rounding [J].
  EnergyScale(double mass, double spacing, double rounding) : mass_(mass), spacing_(spacing), rounding_(rounding) {}
  void see(Diagnostics const& now, Moment const& moment);
  /// The largest of: energy at the start, sum of the sizes of external work, kinetic energy so far. At least what the
  /// body would have with 1e-9 of its wave speed, and what tells strain energy from rounding, because a body at rest
  /// has nothing else.
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

/// Energies of which a hundredth is above the rounding of strain energy [J]: terms of the size of the moduli, which
/// cancel where nothing is strained, are known to 1e-16 of themselves.
double energy_of_rounding(CaseSpec const& spec, ParticleSet const& particles);

/// What guards look at.
struct Look {
  Formulation const& formulation;
  Moment const& moment;
  Diagnostics const& now;
  EnergyScale const& scale;
  FieldCache& fields;
  bool last;  ///< of the run
};

class Guard {
 public:
  virtual ~Guard() = default;
  virtual void look(Look const& look) = 0;
  /// The numbers for the summary; nothing where they have no meaning.
  virtual std::optional<GuardNumbers> numbers() const = 0;
  /// What the user should know; empty as long as all is well.
  virtual std::string words() const = 0;
  virtual std::optional<Objection> objection() const { return std::nullopt; }
  virtual void save(StateWriter& writer) const = 0;
  virtual void load(NamedState& reader) = 0;
};

/// A particle with its places at one time, as a guard remembers it.
struct Suspect {
  double id = -1, time = 0;
  std::array<double, 3> x{};
  bool known() const { return id >= 0; }
  /// "particle 3 of body 'plate' (X = (1, 2, 0) m, x = (1, 2.5, 0) m)".
  std::string text(ParticleSet const& particles) const;
};
Suspect suspect(FieldCache& fields, std::size_t id, double time);
/// Half the square of each particle's speed [m2/s2]; zero where the formulation has no velocities.
std::vector<double> kinetic_per_mass(FieldCache& fields, ParticleSet const& particles);
/// The particle whose kinetic energy grew most since `before` (see kinetic_per_mass), or is the largest if that is
/// empty; nothing where the formulation has no velocities.
std::optional<Suspect> most_moved(FieldCache& fields, ParticleSet const& particles, std::vector<double> const& before,
                                  double time);
/// Makes it the particle of a failure.
void take_particle(Failure& failure, Suspect const& suspect, ParticleSet const& particles);
/// Total energy minus external work [J], which nothing but an error lets rise. Where energies are those of instants
/// half a step apart, the formulation gives the sum that does not rise.
double energy_without_work(Diagnostics const& diagnostics);

/// The number of a column that only some formulations have.
std::optional<double> column_of(Diagnostics const& diagnostics, std::string_view name);

using Guards = std::vector<std::unique_ptr<Guard>>;
/// The guards of a run, in the order in which they are told of.
Guards make_guards(CaseSpec const& spec, ParticleSet const& particles);

std::unique_ptr<Guard> make_energy_guard(GuardLimits const& limits, ParticleSet const& particles);
std::unique_ptr<Guard> make_dissipation_guard(GuardLimits const& limits);
std::unique_ptr<Guard> make_jacobian_guard(CaseSpec const& spec, ParticleSet const& particles);
std::unique_ptr<Guard> make_overlap_guard(GuardLimits const& limits);
std::unique_ptr<Guard> make_parting_guard(GuardLimits const& limits, ParticleSet const& particles);
std::unique_ptr<Guard> make_stranger_guard(CaseSpec const& spec, ParticleSet const& particles);
std::unique_ptr<Guard> make_step_guard(CaseSpec const& spec, ParticleSet const& particles);
std::unique_ptr<Guard> make_small_strain_guard(CaseSpec const& spec, ParticleSet const& particles);
std::unique_ptr<Guard> make_following_load_guard(CaseSpec const& spec, ParticleSet const& particles);

}  // namespace piola
