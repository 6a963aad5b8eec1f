// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/mechanics/contact/surface_contact.hpp"
#include "piola/mechanics/contact/ties.hpp"
#include <vector>

namespace piola {

/// The ties of a run with surface contact. Tied points are excluded from contact with the body that they are tied to,
/// until the tie fails.
class TieCoupling {
 public:
  TieCoupling(Assembly const& whole, contact::SurfaceContactSystem& system);

  /// Evaluates the forces of the current state: before the first step and after loading a checkpoint. x [m] and masses
  /// [kg] by index into SurfaceContactSystem::ids().
  void start(contact::SurfaceContactSystem& system, std::vector<Vec<3>> const& x, std::vector<double> const& masses);
  void evaluate(contact::SurfaceContactSystem& system, std::vector<Vec<3>> const& x);  ///< also sets the tie forces on
                                                                                       ///< rigid shapes in `system`
  /// Accounts for the energy that contact stores at points whose tie has just failed, as supplied by the ties. Call
  /// after contact has been evaluated.
  void transfer_energy(contact::SurfaceContactSystem const& system);
  std::vector<Index> const& loaded_indices() const { return ties_.loaded_indices(); }
  void add_forces(std::vector<Vec<3>>& forces) const;

  void begin();                             ///< starts a step
  void add_to_energy_balance(double half);  ///< adds the impulses of `half` [s]
  double frequency2() const { return frequency2_; }
  /// As frequency2(), including tied free rigid shapes.
  double settled_frequency2() const;
  double energy() const { return ties_.totals().energy; }
  /// Columns of history.csv.
  void report(Diagnostics& sum) const;
  /// Adds the force of the second body, or rigid shape, on the first one in the step; moment about the origin.
  void add_actions(double scale, std::vector<Action>& all) const;
  void save(StateWriter& writer) const;
  void load(StateReader& reader);
  std::size_t bytes() const { return ties_.bytes(); }

 private:
  bool any() const { return !ties_.rules().empty(); }
  /// Excludes the point of a row from contact, or includes it again.
  void exclude_pair(contact::SurfaceContactSystem& system, std::size_t row, bool out) const;

  contact::Ties ties_;
  std::vector<contact::Ties::Force> impulses_;  ///< in the step, by tie
  std::vector<double> loaded_;                  ///< from a checkpoint, until the state of the bodies is loaded
  double frequency2_ = 0;
  std::vector<double> springs_;  ///< by rigid shape, see Ties::springs_of_shape [1/s2]
  double handed_over_ = 0;       ///< energy supplied to contact so far [J]
};

}  // namespace piola
