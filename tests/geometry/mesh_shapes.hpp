// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/geometry/mesh.hpp"
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <map>
#include <string>
#include <vector>

/// Triangle meshes for tests, and their bytes as STL, OBJ and PLY files.
namespace piola::testing {

struct Shape {
  std::vector<Vec<3>> X;
  std::vector<std::array<int, 3>> face;

  Shape& add(Shape const& other) {
    int const first = static_cast<int>(X.size());
    X.insert(X.end(), other.X.begin(), other.X.end());
    for (auto const& f : other.face) face.push_back({f[0] + first, f[1] + first, f[2] + first});
    return *this;
  }
  Shape& turn() {
    for (auto& f : face) std::swap(f[1], f[2]);
    return *this;
  }
};

inline Shape cuboid(Vec<3> const& min, Vec<3> const& max) {
  Shape s;
  for (int i = 0; i < 8; ++i) {
    Vec<3> X;
    for (int k = 0; k < 3; ++k) X[k] = (i >> k) % 2 == 0 ? min[k] : max[k];
    s.X.push_back(X);
  }
  for (auto const& q : {std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}, std::array{0, 1, 5, 4}, std::array{2, 6, 7, 3},
                        std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}}) {
    s.face.push_back({q[0], q[1], q[2]});
    s.face.push_back({q[0], q[2], q[3]});
  }
  return s;
}

inline Shape unit_cube() { return cuboid({{0, 0, 0}}, {{1, 1, 1}}); }

/// Corners at the origin and at distance one on each axis.
inline Shape corner_tetrahedron() {
  return {{{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

/// The unit sphere as an octahedron refined `levels` times (each face into four): 8 * 4^levels faces.
inline Shape round_ball(int levels) {
  Shape s{{{{1, 0, 0}}, {{-1, 0, 0}}, {{0, 1, 0}}, {{0, -1, 0}}, {{0, 0, 1}}, {{0, 0, -1}}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> known;
    auto const middle = [&](int a, int b) {
      auto const [entry, is_new] = known.try_emplace(std::minmax(a, b), static_cast<int>(s.X.size()));
      if (is_new) {
        Vec<3> const m = s.X[a] + s.X[b];
        s.X.push_back((1 / std::sqrt(dot(m, m))) * m);
      }
      return entry->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (auto const& f : s.face) {
      int const a = middle(f[0], f[1]), b = middle(f[1], f[2]), c = middle(f[2], f[0]);
      finer.insert(finer.end(), {{f[0], a, c}, {f[1], b, a}, {f[2], c, b}, {a, b, c}});
    }
    s.face = finer;
  }
  return s;
}

/// A prism along z with `sides` flat sides, circumscribed radius 1, height 2.
inline Shape pillar(int sides) {
  Shape s{{{{0, 0, 0}}, {{0, 0, 2}}}, {}};
  for (int k = 0; k < sides; ++k) {
    double const angle = 2 * std::numbers::pi * k / sides;
    s.X.push_back({{std::cos(angle), std::sin(angle), 0}});
    s.X.push_back({{std::cos(angle), std::sin(angle), 2}});
  }
  for (int k = 0; k < sides; ++k) {
    int const a = 2 + 2 * k, b = 2 + 2 * ((k + 1) % sides);
    s.face.insert(s.face.end(), {{0, b, a}, {1, a + 1, b + 1}, {a, b, b + 1}, {a, b + 1, a + 1}});
  }
  return s;
}

inline std::string stl_text(Shape const& s, std::string const& name = "part") {
  std::string text = "solid " + name + "\n";
  for (auto const& f : s.face) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (int const c : f) text += fmt::format("vertex {:.9g} {:.9g} {:.9g}\n", s.X[c][0], s.X[c][1], s.X[c][2]);
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid " + name + "\n";
}

inline void append_bits(std::string& bytes, std::uint32_t bits) {
  for (int k = 0; k < 4; ++k) bytes += static_cast<char>(bits >> (8 * k));
}

inline std::string stl_binary(Shape const& s) {
  std::string bytes(80, ' ');
  append_bits(bytes, static_cast<std::uint32_t>(s.face.size()));
  for (auto const& f : s.face) {
    for (int k = 0; k < 3; ++k) append_bits(bytes, 0);
    for (int const c : f)
      for (double const x : s.X[c].c) append_bits(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(x)));
    bytes += std::string(2, '\0');
  }
  return bytes;
}

inline std::string obj_text(Shape const& s) {
  std::string text;
  for (auto const& X : s.X) text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", X[0], X[1], X[2]);
  for (auto const& f : s.face) text += fmt::format("f {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1);
  return text;
}

inline std::string ply_text(Shape const& s) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      s.X.size(), s.face.size());
  for (auto const& X : s.X) text += fmt::format("{:.9g} {:.9g} {:.9g}\n", X[0], X[1], X[2]);
  for (auto const& f : s.face) text += fmt::format("3 {} {} {}\n", f[0], f[1], f[2]);
  return text;
}

/// Solid of a shape, read back from its STL bytes. Null if `report` has errors.
inline geometry::SolidPtr solid_of(Shape const& s, geometry::MeshReport& report,
                                   geometry::MeshOptions const& options = {}) {
  return geometry::mesh_from_bytes(stl_binary(s), "part.stl", options, report);
}

inline std::string all_of(std::vector<std::string> const& texts) {
  std::string text;
  for (std::string const& t : texts) text += t + "\n";
  return text;
}

}  // namespace piola::testing
