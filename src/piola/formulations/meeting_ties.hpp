// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/mechanics/contact/system.hpp"
#include "piola/mechanics/contact/ties.hpp"
#include <vector>

namespace piola {

/// The ties of a run beside its contact: points that are held are not pushed by the body that they are held to, until
/// they fail.
class MeetingTies {
 public:
  MeetingTies(Assembly const& whole, contact::System& system);

  /// Forces of the state as it is: before the first step, and after a checkpoint has been read. x [m] and masses [kg]
  /// by index into System::ids().
  void look(contact::System& system, std::vector<Vec<3>> const& x, std::vector<double> const& masses);
  void evaluate(contact::System& system, std::vector<Vec<3>> const& x);  ///< tells rigid shapes in the system, too
  /// After contact has been evaluated, too: what it stores at points that have just failed comes from the ties.
  void hand_over(contact::System const& system);
  std::vector<Index> const& pushed() const { return ties_.pushed(); }
  void add_forces(std::vector<Vec<3>>& forces) const;

  void begin();            ///< of a step
  void book(double half);  ///< impulses of `half` [s]
  double frequency2() const { return frequency2_; }
  /// The same with free rigid shapes that are tied.
  double settled_frequency2() const;
  double energy() const { return ties_.totals().energy; }
  /// Columns of history.csv.
  void report(Diagnostics& sum) const;
  /// What the second body, or rigid shape, did to the first one in the step; the moment about the origin.
  void add_actions(double scale, std::vector<Action>& all) const;
  void save(StateWriter& writer) const;
  void load(StateReader& reader);
  std::size_t bytes() const { return ties_.bytes(); }

 private:
  bool any() const { return !ties_.rules().empty(); }
  /// Whether contact leaves the point of a row out.
  void leave_out(contact::System& system, std::size_t row, bool out) const;

  contact::Ties ties_;
  std::vector<contact::Ties::Force> impulses_;  ///< of the step, by tie
  std::vector<double> loaded_;                  ///< of a checkpoint, until the state of the bodies is read
  double frequency2_ = 0;
  std::vector<double> springs_;  ///< by rigid shape, see Ties::springs_of_shape [1/s2]
  double handed_over_ = 0;       ///< to contact so far [J]
};

}  // namespace piola
