// SPDX-License-Identifier: Apache-2.0
#include "piola/base/contracts.hpp"
#include "piola/geometry/mesh_surface.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace piola::geometry {

namespace {

using Shells = std::vector<std::vector<int>>;

/// Per face whether it has to be turned so that it agrees with the first face of its shell.
std::vector<char> turns_to_agree(Surface const& surface, Links const& links) {
  std::vector<char> known(surface.corner.size()), turn(surface.corner.size());
  std::vector<int> waiting;
  for (int first = 0; first < surface.faces(); ++first) {
    if (known[first]) continue;
    known[first] = 1;
    waiting.push_back(first);
    while (!waiting.empty()) {
      int const face = waiting.back();
      waiting.pop_back();
      for (int side = 0; side < 3; ++side) {
        int const other = links.across[3 * face + side];
        if (other < 0 || known[other / 3]) continue;
        bool const opposite = surface.corner[face][side] == surface.corner[other / 3][other % 3];
        known[other / 3] = 1;
        turn[other / 3] = static_cast<char>(turn[face] != static_cast<char>(opposite));
        waiting.push_back(other / 3);
      }
    }
  }
  return turn;
}

void turn_face(Surface& surface, int face) { std::swap(surface.corner[face][1], surface.corner[face][2]); }

double volume_of_shell(Surface const& surface, std::vector<int> const& faces) {
  Vec<3> const origin = surface.middle(faces.front());
  double sum = 0;
  for (int const face : faces) sum += dot(surface.X[surface.corner[face][0]] - origin, surface.twice_area(face));
  return sum / 6;
}

/// How often the faces wind around a place: the sum of their solid angles (van Oosterom and Strackee 1983).
double winding_number(Surface const& surface, std::vector<int> const& faces, Vec<3> const& place) {
  double sum = 0;
  for (int const face : faces) {
    auto const& corner = surface.corner[face];
    Vec<3> const a = surface.X[corner[0]] - place, b = surface.X[corner[1]] - place, c = surface.X[corner[2]] - place;
    double const la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
    sum += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

Bounds bounds_of_shell(Surface const& surface, std::vector<int> const& faces) {
  Bounds box{surface.X[surface.corner[faces.front()][0]], surface.X[surface.corner[faces.front()][0]]};
  for (int const face : faces)
    for (int const corner : surface.corner[face])
      for (int i = 0; i < 3; ++i) {
        box.min[i] = std::min(box.min[i], surface.X[corner][i]);
        box.max[i] = std::max(box.max[i], surface.X[corner][i]);
      }
  return box;
}

bool box_contains(Bounds const& box, Vec<3> const& X) {
  for (int i = 0; i < 3; ++i)
    if (X[i] < box.min[i] || X[i] > box.max[i]) return false;
  return true;
}

/// Per shell, whether it lies inside an odd number of other shells. All shells are outward.
std::vector<char> cavities(Surface const& surface, Shells const& shells) {
  std::vector<Bounds> boxes(shells.size());
  for (std::size_t s = 0; s < shells.size(); ++s) boxes[s] = bounds_of_shell(surface, shells[s]);
  std::vector<char> inside(shells.size());
  for (std::size_t s = 0; s < shells.size(); ++s) {
    Vec<3> const place = surface.X[surface.corner[shells[s].front()][0]];
    for (std::size_t other = 0; other < shells.size(); ++other)
      if (other != s && box_contains(boxes[other], place) && winding_number(surface, shells[other], place) > 0.5)
        inside[s] = static_cast<char>(!inside[s]);
  }
  return inside;
}

}  // namespace

int orient(Surface& surface, Links const& links) {
  PIOLA_EXPECTS(links.across.size() == 3 * surface.corner.size());
  PIOLA_EXPECTS(links.shell.size() == surface.corner.size() && links.shells >= 0);
  auto turn = turns_to_agree(surface, links);
  for (int face = 0; face < surface.faces(); ++face)
    if (turn[face]) turn_face(surface, face);
  Shells shells(links.shells);
  for (int face = 0; face < surface.faces(); ++face) shells[links.shell[face]].push_back(face);
  auto const turn_shell = [&](std::vector<int> const& faces) {
    for (int const face : faces) {
      turn_face(surface, face);
      turn[face] = static_cast<char>(!turn[face]);
    }
  };
  for (auto const& faces : shells)
    if (volume_of_shell(surface, faces) < 0) turn_shell(faces);
  auto const inward = cavities(surface, shells);
  for (std::size_t s = 0; s < shells.size(); ++s)
    if (inward[s]) turn_shell(shells[s]);
  return static_cast<int>(std::count(turn.begin(), turn.end(), 1));
}

}  // namespace piola::geometry
