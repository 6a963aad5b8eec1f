// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/tetrahedra.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace piola::geometry {
namespace {

using Node = std::array<std::int64_t, 3>;

/// The grid of values, one row of cubes beyond the box on each side.
class LevelGrid {
 public:
  LevelGrid(std::function<double(Vec<3> const&)> const& value, Bounds const& box, double edge, int dimension)
      : value_(value), box_(box), dimension_(dimension) {
    for (int c = 0; c < dimension_; ++c) {
      auto const i = static_cast<std::size_t>(c);
      double const length = box.max[c] - box.min[c];
      cubes_[i] = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(length / edge))) + 2;
      step_[c] = length / static_cast<double>(cubes_[i] - 2);
    }
  }

  Triangles run() {
    std::int64_t const layers = dimension_ == 3 ? cubes_[2] : 1;
    below_ = plane(0);
    for (std::int64_t k = 0; k < layers; ++k) {
      above_ = dimension_ == 3 ? plane(k + 1) : below_;
      for (std::int64_t j = 0; j < cubes_[1]; ++j)
        for (std::int64_t i = 0; i < cubes_[0]; ++i) cross_cube({i, j, k});
      below_.swap(above_);
    }
    return std::move(out_);
  }

 private:
  std::size_t in_plane(std::int64_t i, std::int64_t j) const {
    return static_cast<std::size_t>(j * (cubes_[0] + 1) + i);
  }
  Vec<3> place(Node const& n) const {
    Vec<3> X;
    for (int c = 0; c < dimension_; ++c)
      X[c] = box_.min[c] + static_cast<double>(n[static_cast<std::size_t>(c)] - 1) * step_[c];
    return X;
  }
  std::vector<double> plane(std::int64_t k) const {
    std::vector<double> values(in_plane(0, cubes_[1] + 1), 1.0);
    bool const outside = dimension_ == 3 && (k == 0 || k == cubes_[2]);
    if (outside) return values;
    exec_host::parallel_for_chunks(static_cast<Index>(cubes_[1] + 1), static_cast<Index>(values.size()),
                                   [&](Index row) {
                                     if (row == 0 || row == cubes_[1]) return;
                                     for (std::int64_t i = 1; i < cubes_[0]; ++i)
                                       values[in_plane(i, row)] = value_(place({i, row, k}));
                                   });
    return values;
  }

  void cross_cube(Node const& at) {
    std::array<Node, 8> node;
    std::array<double, 8> value{};
    int negative = 0;
    int const corners = dimension_ == 3 ? 8 : 4;
    for (int c = 0; c < corners; ++c) {
      auto const i = static_cast<std::size_t>(c);
      node[i] = {at[0] + (c & 1), at[1] + (c >> 1 & 1), at[2] + (c >> 2 & 1)};
      value[i] = ((c & 4) != 0 ? above_ : below_)[in_plane(node[i][0], node[i][1])];
      negative += value[i] < 0 ? 1 : 0;
    }
    if (negative == 0 || negative == corners) return;
    // From corner 0 to the opposite one along the axes in every order (Kuhn's simplices): neighbours fit.
    static constexpr std::array<std::array<int, 3>, 6> orders{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}}};
    for (auto const& order : orders) {
      if (dimension_ == 2 && order[2] != 2) continue;
      std::vector<std::size_t> simplex{0};
      for (int d = 0; d < dimension_; ++d)
        simplex.push_back(simplex.back() | std::size_t{1} << order[static_cast<std::size_t>(d)]);
      cross_simplex(simplex, node, value);
    }
  }

  void cross_simplex(std::vector<std::size_t> const& simplex, std::array<Node, 8> const& node,
                     std::array<double, 8> const& value) {
    std::vector<std::size_t> in, out;
    for (std::size_t const c : simplex) (value[c] < 0 ? in : out).push_back(c);
    if (in.empty() || out.empty()) return;
    auto const point = [&](std::size_t a, std::size_t b) { return crossing(node[a], value[a], node[b], value[b]); };
    // From a place inside to one outside, to turn faces outwards.
    Vec<3> const outwards = place(node[out[0]]) - place(node[in[0]]);
    if (dimension_ == 2) {
      bool const one = in.size() == 1;
      int const a = point(in[0], out[0]);
      int const b = one ? point(in[0], out[1]) : point(in[1], out[0]);
      add_line(a, b, outwards);
      return;
    }
    if (in.size() == 2) {
      std::array<int, 4> const q{point(in[0], out[0]), point(in[0], out[1]), point(in[1], out[1]),
                                 point(in[1], out[0])};
      add_face({q[0], q[1], q[2]}, outwards);
      add_face({q[0], q[2], q[3]}, outwards);
      return;
    }
    bool const one = in.size() == 1;
    std::size_t const tip = one ? in[0] : out[0];
    auto const& base = one ? out : in;
    auto const cut = [&](std::size_t i) { return one ? point(tip, base[i]) : point(base[i], tip); };
    add_face({cut(0), cut(1), cut(2)}, outwards);
  }

  void add_face(std::array<int, 3> face, Vec<3> const& outwards) {
    auto const X = [&](std::size_t i) { return out_.corner[static_cast<std::size_t>(face[i])]; };
    if (dot(cross(X(1) - X(0), X(2) - X(0)), outwards) < 0) std::swap(face[1], face[2]);
    out_.face.push_back(face);
  }
  void add_line(int a, int b, Vec<3> const& outwards) {
    Vec<3> const along = out_.corner[static_cast<std::size_t>(b)] - out_.corner[static_cast<std::size_t>(a)];
    if (along[1] * outwards[0] - along[0] * outwards[1] < 0) std::swap(a, b);
    out_.face.push_back({a, b, 0});
  }

  /// The corner on an edge of the grid, made once.
  int crossing(Node a, double at_a, Node b, double at_b) {
    if (b < a) {
      std::swap(a, b);
      std::swap(at_a, at_b);
    }
    std::uint64_t key = 0;
    for (std::size_t c = 0; c < 3; ++c) key = key << 20 | static_cast<std::uint64_t>(a[c] & 0xFFFFF);
    for (std::size_t c = 0; c < 3; ++c) key = key << 1 | static_cast<std::uint64_t>(b[c] - a[c]);
    auto const [found, is_new] = number_.try_emplace(key, static_cast<int>(out_.corner.size()));
    if (is_new) {
      // Not so near to a node that triangles vanish.
      double const share = std::clamp(at_a / (at_a - at_b), 1e-3, 1 - 1e-3);
      out_.corner.push_back(place(a) + share * (place(b) - place(a)));
    }
    return found->second;
  }

  std::function<double(Vec<3> const&)> const& value_;
  Bounds box_;
  int dimension_;
  Node cubes_{1, 1, 1};
  Vec<3> step_{{1, 1, 1}};
  std::vector<double> below_, above_;
  std::unordered_map<std::uint64_t, int> number_;
  Triangles out_;
};

}  // namespace

Triangles level_surface(std::function<double(Vec<3> const&)> const& value, Bounds const& box, double edge,
                        int dimension) {
  PIOLA_EXPECTS(value != nullptr);
  PIOLA_EXPECTS(edge > 0);
  PIOLA_EXPECTS(dimension == 2 || dimension == 3);
  return LevelGrid(value, box, edge, dimension).run();
}

void append_pieces(Triangles const& triangles, std::vector<Vec<3>> const& corner, int dimension,
                   std::vector<SurfacePiece>& pieces) {
  PIOLA_EXPECTS(dimension == 2 || dimension == 3);
  PIOLA_EXPECTS(corner.size() == triangles.corner.size());
  for (auto const& face : triangles.face) {
    auto const X = [&](std::size_t i) { return corner[static_cast<std::size_t>(face[i])]; };
    if (dimension == 2) {
      Vec<3> const along = X(1) - X(0);
      pieces.push_back({0.5 * (X(0) + X(1)), {{along[1], -along[0], 0}}, 0});
    } else {
      pieces.push_back({(1.0 / 3) * (X(0) + X(1) + X(2)), 0.5 * cross(X(1) - X(0), X(2) - X(0)), 0});
    }
  }
}

}  // namespace piola::geometry
