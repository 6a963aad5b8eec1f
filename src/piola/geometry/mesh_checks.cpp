// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/mesh_checks.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/geometry/mesh_repair.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <random>
#include <unordered_map>

namespace piola::geometry {

namespace {

std::string length_text(double length, int digits = 4) { return quantity_text(length, "m", digits); }

std::string near_text(Vec<3> const& X) {
  return fmt::format("near ({}, {}, {})", length_text(X[0]), length_text(X[1]), length_text(X[2]));
}

std::string edges_text(std::size_t count) {
  return fmt::format("{} {}", count_text(static_cast<std::int64_t>(count)), count == 1 ? "edge" : "edges");
}

Vec<3> middle_of_side(Surface const& surface, int half) {
  auto const& c = surface.corner[half / 3];
  return 0.5 * (surface.X[c[half % 3]] + surface.X[c[(half + 1) % 3]]);
}

/// The diagonal of the box around each hole, a hole being open edges that hang together; the largest of them.
double longest_hole(Surface const& surface, Links const& links) {
  std::unordered_map<int, int> parent;
  auto const root = [&](int corner) {
    parent.try_emplace(corner, corner);
    while (parent[corner] != corner) corner = parent[corner] = parent[parent[corner]];
    return corner;
  };
  for (int const half : links.open) {
    auto const& c = surface.corner[half / 3];
    int const a = root(c[half % 3]), b = root(c[(half + 1) % 3]);
    parent[std::max(a, b)] = std::min(a, b);
  }
  std::unordered_map<int, Bounds> boxes;
  double longest = 0;
  for (int const half : links.open)
    for (int const corner : {surface.corner[half / 3][half % 3], surface.corner[half / 3][(half + 1) % 3]}) {
      Vec<3> const& X = surface.X[corner];
      Bounds& box = boxes.try_emplace(root(corner), Bounds{X, X}).first->second;
      for (int i = 0; i < 3; ++i) {
        box.min[i] = std::min(box.min[i], X[i]);
        box.max[i] = std::max(box.max[i], X[i]);
      }
      Vec<3> const diagonal = box.max - box.min;
      longest = std::max(longest, std::sqrt(dot(diagonal, diagonal)));
    }
  return longest;
}

/// Links of the surface without needless faces.
Links links_without_needless(Surface surface) {
  remove_needless_faces(surface);
  return link_faces(surface);
}

/// The advice to mend an open surface, if that closes it.
std::string closing_advice(Surface const& surface, Links const& links) {
  if (double const distance = closing_distance(surface, links); distance > 0)
    return fmt::format("set merge = \"{}\" (its corners nearly coincide, and become one), ", length_text(distance, 3));
  Links const mended = links_without_needless(surface);
  return mended.open.empty() && !mended.across.empty() ? "set repair = \"faces\", " : "";
}

void check_open(Surface const& surface, Links const& links, std::string const& name, MeshOptions const& options,
                MeshReport& report) {
  if (links.open.empty()) return;
  bool const allowed = options.repair == MeshOptions::Repair::holes;
  std::string const what =
      fmt::format("{}: {} open {}", name, count_text(report.open), report.open == 1 ? "edge" : "edges");
  std::string const where = fmt::format("the longest hole is {} across, {}", length_text(report.longest_hole),
                                        near_text(middle_of_side(surface, links.open.front())));
  if (!allowed)
    report.problems.push_back(
        fmt::format("{} (allowed: none), {} - {}close the surface in the CAD program, or set "
                    "repair = \"holes\"",
                    what, where, closing_advice(surface, links)));
  else if (report.longest_hole > options.largest_hole)
    report.problems.push_back(
        fmt::format("{}, {} (allowed: {}) - close the surface in the CAD program, or allow larger holes", what, where,
                    length_text(options.largest_hole)));
  else
    report.notes.push_back(fmt::format("{}, {}: rays tell inside from outside", what, where));
}

void check_non_manifold(Surface const& surface, Links const& links, std::string const& name, MeshReport& report) {
  if (links.non_manifold.empty()) return;
  Links const mended = links_without_needless(surface);
  bool const removable = mended.non_manifold.empty() && !mended.across.empty();
  double longest = 0;
  for (int const half : links.non_manifold) longest = std::max(longest, surface.edge_length(half / 3, half % 3));
  report.problems.push_back(fmt::format(
      "{}: {} used by more than two faces (allowed: two), the longest {}, {} - {}remove faces that lie inside "
      "the body or stand twice, or part bodies that touch",
      name, edges_text(links.non_manifold.size()), length_text(longest),
      near_text(middle_of_side(surface, links.non_manifold.front())), removable ? "set repair = \"faces\", or " : ""));
}

void check_turned(Surface const& surface, Links const& links, std::string const& name, MeshOptions const& options,
                  MeshReport& report) {
  if (links.turned.empty()) return;
  bool const tried = options.repair == MeshOptions::Repair::orient || options.repair == MeshOptions::Repair::faces;
  double longest = 0;
  for (int const half : links.turned) longest = std::max(longest, surface.edge_length(half / 3, half % 3));
  report.problems.push_back(fmt::format(
      "{}: {} between faces of opposite orientation (allowed: none), the longest {}, {} - {}", name,
      edges_text(links.turned.size()), length_text(longest), near_text(middle_of_side(surface, links.turned.front())),
      tried ? "turning faces does not help: the surface has only one side"
            : "turn them in the CAD program, or set "
              "repair = \"orient\""));
}

/// Numbers from 0 to 1 that are the same everywhere.
class FixedNumbers {
 public:
  double next() { return static_cast<double>(generator_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 generator_{2005};
};

/// Places inside the box and on both sides of faces, close to them.
std::vector<Vec<3>> places_to_ask(Surface const& surface) {
  constexpr int most = 2000;
  Bounds const box = bounds_of(surface);
  FixedNumbers numbers;
  std::vector<Vec<3>> places;
  for (int n = 0; n < most; ++n) {
    Vec<3> X = box.min;
    for (int i = 0; i < 3; ++i) X[i] += numbers.next() * (box.max[i] - box.min[i]);
    places.push_back(X);
  }
  int const stride = std::max(1, surface.faces() / most);
  for (int face = 0; face < surface.faces(); face += stride) {
    Vec<3> const n = surface.twice_area(face);
    double const length = std::sqrt(dot(n, n));
    if (length == 0) continue;
    double const away = 0.02 * std::sqrt(length);  // a small part of the face's size
    places.push_back(surface.middle(face) + (away / length) * n);
    places.push_back(surface.middle(face) - (away / length) * n);
  }
  return places;
}

/// The thinnest wall: from the centre of a face along its inward normal to a face of about opposite normal.
struct ThinWall {
  double thickness = std::numeric_limits<double>::infinity();
  Vec<3> X{};
};

ThinWall thinnest_wall(Surface const& surface, MeshDistance const& distance) {
  constexpr int most = 20000;
  double const start = 1e-5 * largest_extent(bounds_of(surface));  // beyond the face itself, in single precision
  ThinWall thinnest;
  int const stride = std::max(1, surface.faces() / most);
  for (int face = 0; face < surface.faces(); face += stride) {
    if (surface.is_flat(face)) continue;
    Vec<3> const n = surface.twice_area(face);
    Vec<3> const inward = (-1 / std::sqrt(dot(n, n))) * n;
    auto const hit = distance.ahead(surface.middle(face), inward, start);
    if (!hit || hit->distance >= thinnest.thickness) continue;
    Vec<3> const other = surface.twice_area(hit->face);
    if (dot(other, inward) > 0.5 * std::sqrt(dot(other, other))) thinnest = {hit->distance, surface.middle(face)};
  }
  return thinnest;
}

}  // namespace

void check_links(Surface const& surface, Links const& links, std::string const& name, MeshOptions const& options,
                 MeshReport& report) {
  PIOLA_EXPECTS(links.across.size() == 3 * surface.corner.size());
  report.open = static_cast<std::int64_t>(links.open.size());
  report.non_manifold = static_cast<std::int64_t>(links.non_manifold.size());
  report.turned = static_cast<std::int64_t>(links.turned.size());
  report.longest_hole = longest_hole(surface, links);
  check_open(surface, links, name, options, report);
  check_non_manifold(surface, links, name, report);
  check_turned(surface, links, name, options, report);
  bool const closed = report.open + report.non_manifold + report.turned == 0;
  if (closed && !(report.volume > 0))
    report.problems.push_back(
        fmt::format("{}: the surface is inside out (it encloses {:.3g} m^3) - turn it in the CAD program, or set "
                    "repair = \"orient\"",
                    name, report.volume));
  if (links.shells > 1)
    report.notes.push_back(
        fmt::format("{}: {} separate surfaces; those inside others are cavities", name, count_text(links.shells)));
}

void check_crossing(Surface const& surface, MeshDistance const& distance, std::string const& name, MeshReport& report) {
  double const too_near = 1e-5 * largest_extent(report.bounds);  // for rays in single precision
  auto const places = places_to_ask(surface);
  std::int64_t odd = 0, asked = 0;
  Vec<3> first{};
  double deepest = 0;
  for (Vec<3> const& X : places) {
    double const d = distance.at(X).distance;
    if (std::abs(d) < too_near) continue;
    ++asked;
    if ((d < 0) == distance.inside_by_rays(X)) continue;
    if (odd++ == 0) first = X;
    deepest = std::max(deepest, std::abs(d));
  }
  if (odd > 0)
    report.problems.push_back(fmt::format(
        "{}: the surface passes through itself, or a surface inside another one is turned the wrong way: at {} of {} "
        "places it is unclear what is inside, up to {} deep, {} - unite the parts in the CAD program, or give them as "
        "a "
        "union of meshes",
        name, count_text(odd), count_text(asked), length_text(deepest), near_text(first)));
}

void compare_with_spacing(Surface const& surface, MeshDistance const& distance, std::string const& name, double spacing,
                          MeshReport& report) {
  if (!(spacing > 0)) return;
  constexpr double odd_size = 5000;  // particles across: more than any run has
  constexpr int least_across = 3;    // with fewer, a wall has no inner particles
  double const size = largest_extent(report.bounds), across = size / spacing;
  if (across > odd_size || across < least_across) {
    report.notes.push_back(fmt::format("{}: the mesh is {} wide, which is {} spacings: is the unit right?", name,
                                       length_text(size), number_text(across, 3)));
    return;
  }
  ThinWall const wall = thinnest_wall(surface, distance);
  if (wall.thickness < least_across * spacing)
    report.notes.push_back(fmt::format("{}: a wall is only {} thick, which is {} spacings (good: {} or more), {}", name,
                                       length_text(wall.thickness), number_text(wall.thickness / spacing, 3),
                                       least_across, near_text(wall.X)));
}

}  // namespace piola::geometry
