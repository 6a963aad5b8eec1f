// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/cracks.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/particles/body_range.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace piola {
namespace {

using Vec3 = std::array<double, 3>;

double cross(Vec3 const& a, Vec3 const& b) { return a[0] * b[1] - a[1] * b[0]; }
double dot(Vec3 const& a, Vec3 const& b) { return a[0] * b[0] + a[1] * b[1]; }
Vec3 difference(Vec3 const& a, Vec3 const& b) { return {a[0] - b[0], a[1] - b[1], 0}; }
double distance(Vec3 const& a, Vec3 const& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

std::string point_text(Vec3 const& X) { return "(" + number_text(X[0]) + ", " + number_text(X[1]) + ") m"; }

/// A line between two points of a plane; what is nearer than `tolerance` [m] is on it.
struct Line {
  Vec3 from{}, to{};
  double tolerance = 0;

  double length() const { return distance(from, to); }
  double along(Vec3 const& X) const { return dot(difference(X, from), difference(to, from)) / length(); }
  double across(Vec3 const& X) const { return cross(difference(to, from), difference(X, from)) / length(); }
  bool holds(Vec3 const& X) const {
    double const s = along(X);
    return std::abs(across(X)) <= tolerance && s >= -tolerance && s <= length() + tolerance;
  }
  bool parts(Vec3 const& a, Vec3 const& b) const {
    double const first = across(a), second = across(b);
    return std::min(first, second) < -tolerance && std::max(first, second) > tolerance;
  }
};

bool meet(Line const& a, Line const& b) {
  if (a.holds(b.from) || a.holds(b.to) || b.holds(a.from) || b.holds(a.to)) return true;
  return a.parts(b.from, b.to) && b.parts(a.from, a.to);
}

Vec3 const& place(ParticleSet const& set, std::int64_t id) { return set.X[static_cast<std::size_t>(id)]; }
std::array<int, 3> const& index(ParticleSet const& set, std::int64_t id) {
  return set.lattice_index[static_cast<std::size_t>(id)];
}

bool outermost(Body const& body, std::array<int, 3> const& at, std::size_t axis, bool upper) {
  return at[axis] == (upper ? body.lattice[axis] - 1 : 0);
}

/// Whether a particle is in an outermost layer of the body.
bool on_boundary(Body const& body, std::array<int, 3> const& at) {
  for (std::size_t axis = 0; axis < 2; ++axis)
    if (outermost(body, at, axis, false) || outermost(body, at, axis, true)) return true;
  return false;
}

/// Whether all these particles are in one outermost layer of the body.
bool along_boundary(ParticleSet const& set, Body const& body, std::vector<std::int64_t> const& ids) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    for (bool const upper : {false, true}) {
      if (std::all_of(ids.begin(), ids.end(),
                      [&](std::int64_t id) { return outermost(body, index(set, id), axis, upper); }))
        return true;
    }
  }
  return false;
}

bool neighbours(std::array<int, 3> const& a, std::array<int, 3> const& b) {
  return std::abs(a[0] - b[0]) <= 1 && std::abs(a[1] - b[1]) <= 1;
}

/// An end without a particle, and where the next one is.
std::string end_problem(ParticleSet const& set, Body const& body, std::string const& key, Vec3 const& end) {
  double best = std::numeric_limits<double>::infinity();
  Vec3 nearest{};
  for (std::int64_t id = body.first; id < body.last; ++id) {
    if (distance(place(set, id), end) >= best) continue;
    nearest = place(set, id);
    best = distance(nearest, end);
  }
  return "crack." + key + " is " + point_text(end) + ", where body " + in_quotes(body.name) +
         " has no particle (allowed: the place of one, within 1e-6 of the spacing) - the nearest is at " +
         point_text(nearest);
}

/// Error text for the particles found on a line with a particle at each end; empty if they form a crack.
std::string path_problem(ParticleSet const& set, Body const& body, std::vector<std::int64_t> const& ids,
                         Line const& line) {
  std::string const who = "the crack in body " + in_quotes(body.name);
  auto const gap = std::adjacent_find(ids.begin(), ids.end(), [&](std::int64_t a, std::int64_t b) {
    return !neighbours(index(set, a), index(set, b));
  });
  if (gap != ids.end())
    return who + " has no particle between " + point_text(place(set, *gap)) + " and " +
           point_text(place(set, *(gap + 1))) +
           " (allowed: lines from particle to particle, along a row or across cells from corner to corner, where no "
           "jitter moved them) - turn it, or remove the jitter";
  if (ids.size() < 3)
    return who + " has " + std::to_string(ids.size()) +
           " particles (allowed: 3 or more) - make it longer or the spacing smaller";
  if (along_boundary(set, body, ids)) return who + " lies on the boundary of the body (allowed: inside) - move it";
  for (Crack const& other : set.cracks) {
    if (&set.bodies[static_cast<std::size_t>(other.body)] != &body) continue;
    if (meet(line, {other.from, other.to, line.tolerance}))
      return who + " meets the crack from " + point_text(other.from) + " to " + point_text(other.to) +
             " (allowed: cracks apart from each other) - move one of them";
  }
  return "";
}

/// Appends a copy of a particle to the set, which takes half of its volume.
void split(ParticleSet& set, std::size_t original) {
  set.volume[original] /= 2;
  set.crack_side[original] = 1;
  set.X.push_back(set.X[original]);
  set.lattice_index.push_back(set.lattice_index[original]);
  set.volume.push_back(set.volume[original]);
  set.kernel_volume.push_back(set.kernel_volume[original]);
  set.body.push_back(set.body[original]);
  set.crack_side.push_back(-1);
}

}  // namespace

CrackPath trace_crack(ParticleSet const& set, std::size_t body_number, Vec3 const& from, Vec3 const& to) {
  PIOLA_EXPECTS(body_number < set.bodies.size() && is_range_in(set.bodies[body_number], set));
  PIOLA_EXPECTS(set.lattice_index.size() == set.X.size());
  PIOLA_EXPECTS(set.dimension == 2);
  Body const& body = set.bodies[body_number];
  Line const line{from, to, 1e-6 * std::min(body.spacing[0], body.spacing[1])};
  CrackPath path;
  if (!(line.length() > line.tolerance)) {
    path.problem =
        "the crack in body " + in_quotes(body.name) + " has no length (allowed: two different ends) - move one end";
    return path;
  }
  std::vector<std::pair<double, std::int64_t>> found;
  for (std::int64_t id = body.first; id < body.last; ++id)
    if (line.holds(place(set, id))) found.emplace_back(line.along(place(set, id)), id);
  std::sort(found.begin(), found.end());
  for (auto const& [s, id] : found) path.particles.push_back(id);
  if (found.empty() || found.front().first > line.tolerance)
    path.key = "from";
  else if (found.back().first < line.length() - line.tolerance)
    path.key = "to";
  if (!path.key.empty()) {
    path.problem = end_problem(set, body, path.key, path.key == "from" ? from : to);
    return path;
  }
  path.problem = path_problem(set, body, path.particles, line);
  path.tip_at_from = !on_boundary(body, index(set, path.particles.front()));
  path.tip_at_to = !on_boundary(body, index(set, path.particles.back()));
  return path;
}

void open_crack(ParticleSet& set, std::size_t body_number, Vec3 const& from, Vec3 const& to) {
  PIOLA_EXPECTS(body_number + 1 == set.bodies.size());
  CrackPath const path = trace_crack(set, body_number, from, to);
  if (!path.problem.empty()) throw InputError(path.problem);
  set.crack_side.resize(set.X.size());
  std::size_t const first = path.tip_at_from ? 1 : 0, last = path.particles.size() - (path.tip_at_to ? 1 : 0);
  for (std::size_t k = first; k < last; ++k) split(set, static_cast<std::size_t>(path.particles[k]));
  Body& body = set.bodies[body_number];
  body.last = set.size();
  body.regular = false;  // a lattice point may have two particles now
  set.cracks.push_back({static_cast<int>(body_number), from, to, path.tip_at_from, path.tip_at_to});
}

}  // namespace piola
