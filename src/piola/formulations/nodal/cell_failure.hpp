// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/body.hpp"
#include <vector>

namespace piola::nodal {

/// Cells of a body that fail: finds them after each step, and takes over the gradients that the intact cells around
/// have then. Stress, density and energy of these cells stay. Theory: docs/theory/nodal.md, "Failure".
class CellFailure {
 public:
  /// Keeps references to both. Does nothing for a body whose cells cannot fail.
  CellFailure(NodalBody& body, Backend const& backend);

  /// After a step. Returns whether gradients have changed. Collective.
  bool update();
  /// After the state of the body was loaded. Collective.
  void load();

 private:
  using Changes = std::vector<Refits::Change>;

  double& value(Index slot, int of) const;
  CellCondition condition(Index slot) const;
  double volume_ratio(Index slot) const;
  Changes find() const;
  void find_detached(Index slot, Changes& found) const;
  Changes over_ranks(Changes found) const;
  void put(Refits::Change const& change) const;
  /// Returns the cells that fail by it.
  Changes set(Changes const& changes);
  void put_gradients(Index slot) const;
  void take_over();

  NodalBody& body_;
  Backend const& backend_;
  std::vector<char> near_crack_;  ///< per slot, of local cells: gradients have changed
  std::vector<char> broken_;      ///< per slot, on all ranks alike: the cell is not intact
  std::vector<Index> changed_;    ///< local slots whose gradients the last change has changed
};

}  // namespace piola::nodal
