// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/body.hpp"
#include "piola/formulations/nodal/eulerian_cells.hpp"
#include "piola/formulations/nodal/fragment_contact.hpp"
#include <vector>

namespace piola::nodal {

/// Finds the cells of a body that fail after each step, and changes the gradients of the cells around them. Stress,
/// density and energy of those cells stay. Theory: docs/theory/nodal.md, "Failure".
class CellFailure {
 public:
  /// Keeps references to both. Does nothing for a body whose cells cannot fail.
  CellFailure(NodalBody& body, Backend const& backend);
  CellFailure(CellFailure const&) = delete;
  CellFailure& operator=(CellFailure const&) = delete;

  /// Before the particles move by the step dt [s]: adds to the velocities the impulse of the forces that do not follow
  /// from gradients, those of the contact of pieces and of Eulerian cells.
  void begin_step(double dt) const;
  /// After that: lets cells fail, and adds the second half of the impulse. Returns whether gradients have changed.
  /// `failed`: whether the body has failed to move. Collective.
  bool end_step(double dt, bool failed);
  /// Squares of the largest frequencies of the contact of pieces, and of Eulerian cells [1/s2].
  double contact_frequency2() const { return fragments_.frequency2(); }
  double eulerian_frequency2() const { return eulerian_.frequency2(); }
  /// Lets local cells fail, at the start of a step that crushes them however short it is. Collective.
  void crush(std::vector<Index> const& slots);
  void save(StateWriter& writer, std::string const& name) const;
  /// After the fields of the body were loaded. Collective.
  void load(StateReader& reader, std::string const& name);
  /// Number of particles without surface points: detached ones, and those so near that contact would take their motion
  /// from that of detached ones. On all ranks alike.
  std::int64_t surfaces_lost() const { return lost_count_; }
  bool has_lost_surface(Index slot) const { return !lost_.empty() && lost_[static_cast<std::size_t>(slot)] != 0; }

 private:
  using Changes = std::vector<Refits::Change>;

  double& value(Index slot, int of) const;
  bool needs_gradients(Index slot) const;
  CellCondition next_condition(Index slot) const;
  Changes over_ranks(Changes found) const;
  void put(Refits::Change const& change) const;
  /// Returns the cells that fail by it.
  Changes set(Changes const& changes);
  /// Sets the changes of all ranks, and those that follow. Returns whether there was one. Collective.
  bool propagate(Changes changes);
  void put_gradients(Index slot) const;
  void lose_surfaces(Index detached);
  void take_over();
  void find_contact();

  NodalBody& body_;
  Backend const& backend_;
  FragmentContact fragments_;
  EulerianCells eulerian_;
  std::vector<char> near_crack_;  ///< per slot, of local cells: gradients have changed
  std::vector<char> lost_;        ///< per slot, on all ranks alike
  std::int64_t lost_count_ = 0;
  bool crushed_ = false;        ///< cells have failed at the start of the present step
  std::vector<Index> changed_;  ///< local slots whose gradients have changed since the last step
};

}  // namespace piola::nodal
