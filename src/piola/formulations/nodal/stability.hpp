// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/body.hpp"
#include <string>
#include <vector>

namespace piola::nodal {

/// Monitors the step limit 2 / omega of one body, with omega the largest frequency of its forces about the current
/// state. Uses Lanczos' method from the last mode. Repeated after 25 steps, after up to 50 while nothing changes, and
/// as soon as a strain has changed by 0.1. The state is left unchanged.
class StabilityMonitor {
 public:
  /// For estimates: growth factor per step from step() at the start to calm_step() that gives as many additional steps
  /// as the short ones before the first measurement in motion.
  static constexpr double growth_at_start = 1.043;

  /// Fraction of the energy tolerance for B dt^2. As steps become shorter while B grows from B_0, B dt^2 / 6 ln(B /
  /// B_0) is added.
  static constexpr double share_of_tolerance = 0.8;
  /// The energy tolerance reduces no step below this fraction of the stable one: a body at rest that has just been hit
  /// has all of its energy in few particles, and more energy follows.
  static constexpr double least_of_limit = 0.2;

  /// Measures from a random start, unless the case prescribes the step.
  StabilityMonitor(NodalBody& body, Backend const& backend);

  /// Registers the step dt [s] just taken, and repeats due measurements. `halvings`: number of halvings of the step.
  void update(double dt, int halvings);
  /// Gradients have changed since the last measurement: the next one is due after a few steps.
  void expect_change() { gradients_changed_ = 1; }
  /// Squares of the largest frequencies of Eulerian cells, where they exceed that of the last measurement, and of the
  /// contact of pieces, which adds to both [1/s2].
  void set_other_frequencies(double contact2, double eulerian2) {
    contact_frequency2_ = contact2;
    eulerian_frequency2_ = eulerian2;
  }
  /// Next step [s]: a fraction of the stability limit, smaller the faster strains change.
  double step() const;
  /// Step [s] after the first measurement in motion if strains change slowly.
  double calm_step() const;
  /// Largest frequency of the last measurement, and never less than that of the start [1/s].
  double frequency() const;

  /// Largest energy of the body at the measurements so far [J].
  double energy() const { return energy_; }
  /// Energy error indicator B = (v.K.v + a.M.a) / 8 [J/s2], which a vibration conserves: Verlet steps make its energy
  /// oscillate by B dt^2.
  double energy_oscillation() const { return energy_oscillation_; }

  /// State that determines the next step, except the strains of the last measurement, which are a field. Collective;
  /// complete on root.
  std::vector<double> state() const;
  /// Collective.
  void load(StateReader& reader, std::string const& name);

  /// Whether the case prescribes the step.
  bool is_given() const { return body_.options().cfl > 0; }
  std::size_t bytes() const { return mode_.size() * sizeof(double); }

 private:
  using Vector = std::vector<double>;  ///< D values per local particle, in the order of slots
  /// An approximate eigenvalue omega^2, and a bound on its distance from the nearest exact one.
  struct Estimate {
    double square = 0, error = 0;
  };
  /// Step [s] at a fraction of the stability limit.
  double step_at(double fraction) const;
  void measure(int cycles, bool at_start);
  bool should_look(double dt) const;
  void look_at_unrest(double dt);
  double unrest_at_start(Vector const& x, Vector const& rest, double size);
  Estimate iterate(Vector const& x, Vector const& rest, double size);
  Vector accelerations();

  NodalBody& body_;
  Backend const& backend_;
  Vector mode_;                         ///< empty if nothing is measured
  double frequency_ = 0;                ///< 1/s, at the last measurement
  double start_ = 0;                    ///< 1/s, at the start
  double steps_ = 0;                    ///< since the last measurement
  double step_reduction_ = 1;           ///< remaining fraction of the step after halved steps
  double measurement_spacing_ = 0;      ///< steps between the last two measurements; 0: only one so far
  double interval_ = 0;                 ///< steps to the next measurement while strains change little
  double steps_since_measurement_ = 0;  ///< steps since the last measurement, in equivalents of slow steps
  double energy_ = 0;                   ///< largest measured energy [J]
  double energy_oscillation_ = 0;       ///< largest indicator of look_at_unrest() [J/s2]
  double recent_max_ = 0;               ///< largest indicator since its last reset or confirmation
  double recent_max_age_ = 0;           ///< age of that, in equivalents of slow steps
  double gradients_changed_ = 0;        ///< 1: since the last measurement
  /// See set_other_frequencies().
  double contact_frequency2_ = 0, eulerian_frequency2_ = 0;
};

}  // namespace piola::nodal
