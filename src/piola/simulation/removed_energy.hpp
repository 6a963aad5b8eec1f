// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

namespace piola {

/// Energy that the stops of a dynamic relaxation have removed, over the steps of the run. The removed energy tends to
/// the fall of the potential energy from the start to rest, so that its growth shows how far rest is, also where fast
/// vibrations cause the stops and slow motion hardly gets on.
class RemovedEnergy {
 public:
  /// Adds the energy [J] that a stop removes.
  void add(double energy) { total_ += energy; }
  /// Ends a step.
  void end_step();
  /// Square root of the energy that is still to be removed, relative to the energy removed so far: the remaining
  /// displacement relative to the present one, in the norm of the energy. The remainder is extrapolated from the
  /// energies of the last two fifths of the run, and is at least that of the last fifth. Infinite if there are too few
  /// steps.
  double left() const;

  /// State for checkpoints: the values of load().
  std::vector<double> state() const;
  void load(std::vector<double> const& state);
  static constexpr int state_size() { return 4 + most_marks; }

 private:
  static constexpr int most_marks = 96;
  std::vector<double> marks_;  ///< the total [J] after each `spacing_` steps
  double total_ = 0;           ///< [J]
  double spacing_ = 1, steps_ = 0;
};

}  // namespace piola
