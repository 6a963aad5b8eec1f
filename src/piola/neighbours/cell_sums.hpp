// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/circle.hpp"
#include "piola/neighbours/particle_cells.hpp"
#include <array>
#include <functional>
#include <span>
#include <vector>

namespace piola {

/// A side of a block: a flat or bilinear piece of surface that crosses an axis. Corners in the order (0, 0), (1, 0),
/// (1, 1), (0, 1) of the two next axes, cyclically; in 2D the first two, along the other axis.
struct BlockSide {
  using Point = std::array<double, 3>;
  std::size_t axis = 0;
  std::array<Point, 4> corner{};
  bool flat = true;  ///< a rectangle across the axis

  static std::size_t corners(std::size_t D) { return D == 3 ? 4 : D; }
  Point middle(std::size_t D) const;
};

/// Adds up sides of blocks for cells, patches and facets.
class CellSums {
 public:
  using Point = BlockSide::Point;
  /// X: of the particles of the body; must outlive the sums. wants_facets: see measure_cells().
  CellSums(int dimension, bool axisymmetric, std::span<Point const> X, std::function<bool(std::size_t)> wants_facets);

  /// A side between the cells of two particles, N from `lower` to `upper`.
  void add_facet(std::size_t lower, std::size_t upper, BlockSide const& side);
  /// A side towards the outside. `like`: its particle, with its patch, or its axis and sense.
  void add_surface(SurfacePatch const& like, BlockSide const& side);
  /// Moves the sums out, with centroids and central moments.
  BodyCells finish();

 private:
  Point from(Point const& origin, Point const& X) const;
  void add_to_cell(std::size_t a, Point const& X, Point const& N, double sign);
  void add_to_section(std::size_t a, Point const& r, Point const& N, double sign);
  void finish_rings();
  /// Length of the circle through X, by which surfaces of axisymmetric bodies are weighted; else 1 [m].
  double weight(Point const& X) const { return axisymmetric_ ? circle(X[0]) : 1; }
  bool wants_facet(std::size_t a, std::size_t b) const {
    return wants_facets_ && (wants_facets_(a) || wants_facets_(b));
  }
  SurfacePatch& patch(SurfacePatch const& like);
  CellFacet& facet(std::size_t a, std::size_t b);

  std::size_t D_;
  bool axisymmetric_;
  std::span<Point const> X_;
  std::function<bool(std::size_t)> wants_facets_;
  BodyCells cells_;
  std::vector<std::vector<Index>> patches_;  ///< of a particle
  std::vector<std::vector<Index>> facets_;   ///< of a particle, towards particles with a higher number
};

}  // namespace piola
