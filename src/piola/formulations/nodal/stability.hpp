// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/body.hpp"
#include <string>
#include <vector>

namespace piola::nodal {

/// Follows the step limit 2 / omega of one body, with omega the largest frequency of its forces about the current
/// state: Lanczos' method, which starts from the mode found last. Measured again after 25 steps, after up to 50 while
/// nothing changes, and as soon as a strain has changed by 0.1. The state is left as it was.
class StabilityMonitor {
 public:
  /// Right-hand sides for the measurement at the start, and for later ones per step of calm motion.
  static constexpr double setup_stages = 25, stages_per_step = 0.1;
  /// For estimates: steps that grow by this factor from step() at the start to calm_step() are as many more than those
  /// of calm_step() alone as the short steps before the first measurement in motion are.
  static constexpr double growth_at_start = 1.043;
  /// What all ranks add in a step: sums of the unrest in every fourth step of calm motion and in all before the first
  /// measurement, and those of measurements. In steps that others make shorter the unrest is looked at each time, but
  /// measurements are further apart.
  static constexpr double collectives_per_step = 0.9, more_if_shortened = 0.3;

  /// B dt^2 may take this of the tolerance for the energy. As steps become shorter while B grows from B_0, B dt^2 / 6
  /// ln(B / B_0) comes on top.
  static constexpr double share_of_tolerance = 0.8;
  /// No step is shorter for that than this share of what is stable: a body that was at rest and has just been hit has
  /// all of its energy in few particles, and more to come.
  static constexpr double least_of_limit = 0.2;

  /// Measures from a random start; nothing is measured, then or later, where the case gives the step.
  StabilityMonitor(NodalBody& body, Machine const& machine);

  /// Counts the step dt [s] that was just taken, and measures again what is due. `halvings`: how often it had to be
  /// halved.
  void update(double dt, int halvings);
  /// Step to take [s]: a fraction of the stability limit, smaller the faster strains change.
  double step() const;
  /// Step [s] after the first measurement in motion where strains change slowly.
  double calm_step() const;
  /// Largest frequency that was measured last, and never less than that of the start [1/s].
  double frequency() const;

  /// The largest energy of the body at the measurements so far [J].
  double energy() const { return energy_; }
  /// B = (v.K.v + a.M.a) / 8 [J/s2], which a vibration keeps: Verlet steps let its energy rise and fall by B dt^2.
  double unrest() const { return unrest_; }

  /// Everything that the next step depends on, but for the strains of the last measurement, which are a field. On ranks
  /// collective, and rank 0 has all of it.
  std::vector<double> state() const;
  /// Collective.
  void load(StateReader& reader, std::string const& name);

  /// Whether the case gives the step.
  bool is_given() const { return body_.options().cfl > 0; }
  std::size_t bytes() const { return mode_.size() * sizeof(double); }

 private:
  using Vector = std::vector<double>;  ///< D values per particle of this rank, in the order of slots
  /// An approximate eigenvalue omega^2, and by how much the nearest true one differs at most.
  struct Estimate {
    double square = 0, error = 0;
  };
  /// Of component c of the particle in slot i in a Vector.
  std::size_t place(Index i, int c) const;
  /// f(slot) for the particles of this rank.
  template <class F>
  void each_particle(F const& f) const;
  /// f(place) for the numbers of a Vector that this rank has.
  template <class F>
  void each_number(F const& f) const;
  /// sum m u.u and the largest |u_k|, of all ranks.
  struct Extent {
    double square, most;
  };
  Extent extent(Vector const& u) const;
  /// Step [s] at a fraction of the stability limit.
  double step_at(double fraction) const;
  void measure(int cycles, bool at_start);
  bool should_look(double dt) const;
  void look_at_unrest(double dt);
  double unrest_at_start(Vector const& x, Vector const& rest, double size);
  Estimate iterate(Vector const& x, Vector const& rest, double size);
  Vector accelerations();
  Vector positions() const;
  void put_moved(Vector const& x, double scale, Vector const& mode);
  double product(Vector const& u, Vector const& v) const;
  exec::ExactSums<1> own_product(Vector const& u, Vector const& v) const;

  NodalBody& body_;
  Machine const& machine_;
  Vector mode_;            ///< empty where nothing is measured
  double frequency_ = 0;   ///< 1/s, at the last measurement
  double start_ = 0;       ///< 1/s, at the start
  double steps_ = 0;       ///< since the last measurement
  double caution_ = 1;     ///< share of the step that is left after steps that had to be halved
  double pace_ = 0;        ///< steps between the last two measurements; 0: there was one alone
  double interval_ = 0;    ///< steps to the next measurement while strains change little
  double waited_ = 0;      ///< since the last measurement, in steps of calm motion
  double energy_ = 0;      ///< the largest that was measured [J]
  double unrest_ = 0;      ///< see unrest() [J/s2]
  double lately_ = 0;      ///< the largest unrest since it was last forgotten or kept, and for how long
  double lately_age_ = 0;  ///< that was, in steps of calm motion
};

}  // namespace piola::nodal
