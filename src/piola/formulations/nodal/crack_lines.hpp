// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/fields.hpp"
#include "piola/formulations/nodal/local_fits.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <vector>

namespace piola::nodal {

/// Conditions of the cells of a body, and which lines between particles cracks cross. All lengths in spacings. Theory:
/// docs/theory/nodal.md, "Failure".
class CrackLines {
 public:
  /// Keeps a reference to X, which must outlive this. With mirror planes X has the images, too.
  explicit CrackLines(Points const& X);

  CellCondition condition(std::size_t a) const { return condition_[a]; }
  /// Whether a cell has not broken.
  bool is_intact(std::size_t a) const { return condition_[a] <= CellCondition::opening; }
  /// Whether some cell opens or has broken.
  bool any() const { return any_; }
  void set(std::size_t a, CellCondition condition);
  /// Whether the facet of cell a with a neighbour is surface, where the fit of a holds: an intact cell has such facets
  /// with cells that have broken, a broken one with detached cells.
  bool is_face(std::size_t a, std::size_t neighbour) const {
    return condition_[neighbour] > (is_intact(a) ? CellCondition::opening : CellCondition::broken);
  }
  /// The particles that cracks hide from the fit of a particle a.
  class View {
   public:
    View(CrackLines const& lines, std::size_t a);
    /// Whether the fit must not use b: one of the two is detached, or the line between them is longer than that of
    /// nearest neighbours and passes a particle whose cell opens or has broken. Opening cells see past opening ones.
    bool hides(std::size_t b) const;

   private:
    CrackLines const& lines_;
    std::size_t a_;
    std::vector<std::size_t> hiding_;  ///< particles around a that hide others
  };
  /// Calls f(a) for the particles nearer to another one than `reach`, at most the largest support radius.
  template <class F>
  void each_near(std::size_t of, double reach, F const& f) const {
    grid_.visit(X_[of], [&](Index other) {
      auto const a = static_cast<std::size_t>(other);
      if (square_of_distance(X_, of, a) < reach * reach) f(a);
    });
  }

 private:
  Points const& X_;
  std::vector<CellCondition> condition_;
  CellGrid grid_;
  bool any_ = false;
};

}  // namespace piola::nodal
