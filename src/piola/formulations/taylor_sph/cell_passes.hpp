// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/taylor_sph/sums.hpp"

/// Virtual particles of moving bodies: centre, volume and shape of a cell.
namespace piola::taylor_sph::inline PIOLA_BACKEND {

/// Corners of a cell, or of one per lane.
template <int D>
struct CornerPositions {
  static constexpr int most = 1 << D;
  Vec<D, Lanes> x[most];
  int count;
};

template <int D>
PIOLA_FN CornerPositions<D> load_corners(CellTable const& cells, double const* real, Index i) {
  CornerPositions<D> r;
  r.count = cells.corners;
  for (int k = 0; k < cells.corners; ++k) {
    Lanes x[D];
    load_records(real, Record<D>::stride,
                 cells.corner + (static_cast<std::ptrdiff_t>(i / lane_count) * cells.corners + k) * lane_count, x);
    for (int c = 0; c < D; ++c) r.x[k][c] = x[c];
  }
  return r;
}

/// The edges that span a cell: from the first corner of a simplex, between the middles of opposite faces of a box.
template <int D>
PIOLA_FN void spanning_edges(CornerPositions<D> const& corners, bool simplices, Vec<D, Lanes> (&edge)[D]) {
  for (int a = 0; a < D; ++a) {
    if (simplices) {
      edge[a] = corners.x[a + 1] - corners.x[0];
      continue;
    }
    for (int k = 0; k < corners.count; ++k) {
      double const sign = (k >> a & 1) != 0 ? 2.0 / CornerPositions<D>::most : -2.0 / CornerPositions<D>::most;
      edge[a] = k == 0 ? sign * corners.x[k] : edge[a] + sign * corners.x[k];
    }
  }
}

/// Volume that D edges span [m^D].
template <int D>
PIOLA_FN Lanes spanned(Vec<D, Lanes> const (&e)[D]) {
  if constexpr (D == 1) return e[0][0];
  if constexpr (D == 2) return e[0][0] * e[1][1] - e[0][1] * e[1][0];
  if constexpr (D == 3) return dot(cross(e[0], e[1]), e[2]);
}

/// Largest side of the span of the edges: of a parallelepiped's faces, and for simplices also of the side opposite to
/// the first corner.
template <int D>
PIOLA_FN Lanes largest_side(Vec<D, Lanes> const (&e)[D], bool simplices) {
  Lanes square(1.0);
  if constexpr (D == 2) {
    square = maximum(dot(e[0], e[0]), dot(e[1], e[1]));
    if (simplices) square = maximum(square, dot(e[1] - e[0], e[1] - e[0]));
  }
  if constexpr (D == 3) {
    for (int a = 0; a < 3; ++a) {
      auto const side = cross(e[a], e[(a + 1) % 3]);
      square = maximum(square * (a == 0 ? 0.0 : 1.0), dot(side, side));
    }
    auto const far = cross(e[1] - e[0], e[2] - e[0]);
    if (simplices) square = maximum(square, dot(far, far));
  }
  return square_root(square);
}

/// One-point gradients of a cell, grad f = sum_k f_k g_k, and its volume:
///   sum_k g_k = 0,   sum_k g_k (x) x_k = 1
template <int D>
struct CellGradients {
  Vec<D, Lanes> g[CornerPositions<D>::most];
  Lanes volume;  ///< [m^D]
};

/// The linear gradient for simplices; for boxes that between the centres of opposite faces, in 2D that of the
/// diagonals.
template <int D>
PIOLA_FN CellGradients<D> cell_gradients(CornerPositions<D> const& corners, bool simplices) {
  Vec<D, Lanes> edge[D];
  spanning_edges<D>(corners, simplices, edge);
  Mat<D, Lanes> E;
  for (int a = 0; a < D; ++a)
    for (int c = 0; c < D; ++c) E(a, c) = edge[a][c];
  Mat<D, Lanes> const inverse_edge = inverse(E);
  constexpr double share = 2.0 / CornerPositions<D>::most;
  CellGradients<D> r;
  double factorial = 1;
  for (int c = 2; c <= D && simplices; ++c) factorial *= c;
  r.volume = (1.0 / factorial) * spanned<D>(edge);
  for (int k = 0; k < corners.count; ++k)
    for (int b = 0; b < D; ++b) {
      Lanes sum(0.0);
      for (int a = 0; a < D; ++a) {
        double const sign = simplices ? (k == 0 ? -1.0 : k == a + 1 ? 1.0 : 0.0) : ((k >> a & 1) != 0 ? share : -share);
        sum = sum + sign * inverse_edge(b, a);
      }
      r.g[k][b] = sum;
    }
  return r;
}

/// Length limit of a wave in a step of the adjoint exchange [m]: 2 / sqrt(n lambda), lambda the largest eigenvalue of
/// sum_k g_k (x) g_k, for 3D cells a bound at most 7 % above it.
template <int D>
PIOLA_FN Lanes adjoint_spacing(CellGradients<D> const& cell, int corners) {
  SymMat<D, Lanes> s{};
  for (int k = 0; k < corners; ++k)
    for (int a = 0; a < D; ++a)
      for (int b = a; b < D; ++b) s(a, b) = s(a, b) + cell.g[k][a] * cell.g[k][b];
  if constexpr (D == 1) return 2.0 / square_root(static_cast<double>(corners) * s.c[0]);
  if constexpr (D == 2) {
    Lanes const half = 0.5 * (s(0, 0) - s(1, 1));
    Lanes const largest = 0.5 * (s(0, 0) + s(1, 1)) + square_root(half * half + s(0, 1) * s(0, 1));
    return 2.0 / square_root(static_cast<double>(corners) * largest);
  }
  if constexpr (D == 3) {
    // lambda^8 <= |S^8|, with S over its trace so that no power over- or underflows.
    Lanes const sum = s.c[0] + s.c[1] + s.c[2];
    Mat<D, Lanes> power;
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b) power(a, b) = s(a, b) / sum;
    for (int twice = 0; twice < 3; ++twice) power = power * power;
    Lanes root = square_root(contract(power, power));
    for (int twice = 0; twice < 3; ++twice) root = square_root(root);
    return 2.0 / square_root(static_cast<double>(corners) * sum * root);
  }
}

/// Moves virtual particles to the centres of their cells and measures these; per block: largest strain, smallest
/// quality, spacing and volume.
template <int D>
struct PlaceVirtuals {
  CellTable cells;
  double const* real;
  double* virtual_;
  double* partial;
  static constexpr int results = 4;

  PIOLA_FN void operator()(Range b, Index block) const {
    Lanes strain(0.0), quality(1e300), spacing(1e300), volume(1e300);
    for (Index i = b.first; i < b.last; i += lane_count) {
      CornerPositions<D> const corners = load_corners<D>(cells, real, i);
      Vec<D, Lanes> edge[D];
      spanning_edges<D>(corners, cells.simplices, edge);
      Lanes const box = spanned<D>(edge);
      Lanes shortest(1e300), longest(0.0);
      compare_distances(corners, i, strain, shortest, longest);
      // A wave crosses a cell between its nearest sides; a right-angled simplex counts as the box that contains it.
      Lanes const height = box / largest_side<D>(edge, cells.simplices);
      spacing = minimum(spacing, cells.adjoint
                                     ? adjoint_spacing<D>(cell_gradients<D>(corners, cells.simplices), corners.count)
                                     : minimum(square_root(shortest), height_of_box(height)));
      Lanes edge_power = square_root(longest);
      for (int c = 1; c < D; ++c) edge_power = edge_power * square_root(longest);
      quality = minimum(quality, box / edge_power / load<Lanes>(cells.reference_quality + i));
      Lanes const content = (cells.simplices ? 1.0 / factorial() : 1.0) * box;
      volume = minimum(volume, content);
      place(corners, content, i);
    }
    double* const out = partial + results * block;
    for (int c = 0; c < results; ++c) out[c] = c == 0 ? 0 : 1e300;
    for (int l = 0; l < lane_count; ++l) {
      out[0] = maximum(out[0], lane(strain, l));
      out[1] = minimum(out[1], lane(quality, l));
      out[2] = minimum(out[2], lane(spacing, l));
      out[3] = minimum(out[3], lane(volume, l));
    }
  }

 private:
  static constexpr double factorial() { return D == 3 ? 6 : D; }
  /// The height of a simplex over its largest side is 1/sqrt(D) of the edge of the box of which it is a corner.
  PIOLA_FN Lanes height_of_box(Lanes const& height) const {
    constexpr double root = D == 1 ? 1 : D == 2 ? 1.4142135623730951 : 1.7320508075688772;
    return cells.simplices ? root * height : height;
  }
  PIOLA_FN void compare_distances(CornerPositions<D> const& corners, Index i, Lanes& strain, Lanes& shortest,
                                  Lanes& longest) const {
    int const pairs = corners.count * (corners.count - 1) / 2;
    double const* before = cells.reference_square + static_cast<std::ptrdiff_t>(i) * pairs;
    for (int a = 0; a < corners.count; ++a)
      for (int b = a + 1; b < corners.count; ++b, before += lane_count) {
        Vec<D, Lanes> const edge = corners.x[b] - corners.x[a];
        Lanes const square = dot(edge, edge), change = square / load<Lanes>(before) - 1.0;
        strain = maximum(strain, maximum(change, -change));
        shortest = minimum(shortest, square);
        longest = maximum(longest, square);
      }
  }
  PIOLA_FN void place(CornerPositions<D> const& corners, Lanes const& content, Index i) const {
    Vec<D, Lanes> middle = corners.x[0];
    for (int k = 1; k < corners.count; ++k) middle = middle + corners.x[k];
    for (int l = 0; l < lane_count; ++l) {
      double* const record = virtual_ + (i + l) * Record<D>::stride;
      for (int c = 0; c < D; ++c) record[Record<D>::x + c] = lane(middle[c], l) / corners.count;
      record[Record<D>::volume] = lane(content, l);
    }
  }
};

}  // namespace piola::taylor_sph::inline PIOLA_BACKEND
