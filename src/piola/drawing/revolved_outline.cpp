// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/revolved_outline.hpp"
#include "piola/base/contracts.hpp"
#include "piola/drawing/feature_lines.hpp"
#include "piola/drawing/revolution.hpp"
#include "piola/drawing/vector_math.hpp"
#include <algorithm>
#include <cmath>

namespace piola {
namespace {

bool is_closed(Polyline const& line) { return line.size() > 2 && line.front() == line.back(); }

/// The parts of a line beyond the width of the axis. A closed line that touches the axis begins there.
std::vector<Polyline> parts_beside_axis(Polyline line, double width) {
  auto const on_axis = [&](std::size_t k) {
    return std::abs(line[k][0]) <= width && std::abs(line[k + 1][0]) <= width;
  };
  for (std::size_t k = 0; is_closed(line) && k + 1 < line.size(); ++k) {
    if (!on_axis(k)) continue;
    line.pop_back();
    std::rotate(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(k), line.end());
    line.push_back(line.front());
    break;
  }
  for (Point3& p : line)
    if (std::abs(p[0]) <= width) p[0] = 0;
  std::vector<Polyline> parts;
  bool open = false;
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    if (on_axis(k)) {
      open = false;
      continue;
    }
    if (!open) parts.push_back({line[k]});
    parts.back().push_back(line[k + 1]);
    open = true;
  }
  return parts;
}

Polyline rotated(Polyline line, Rotation const& rotate) {
  for (Point3& p : line) p = rotate(p);
  return line;
}

/// The surface that a line is swept to: its sharp circles, and the smooth edges between its facets as those of a mesh.
class SweptLine {
 public:
  SweptLine(Polyline const& line, double degrees)
      : line_(line), degrees_(degrees), angles_(angles_of_sweep(degrees, degrees_per_segment)) {
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      Point3 const along = minus(line[k + 1], line[k]);
      normal_.push_back(unit({along[1], -along[0], 0}));
    }
    for (double const angle : angles_)
      for (Point3 const& p : rotated(line, Rotation::by(angle))) mesh_.X.push_back(p);
    mesh_.count = mesh_.X.size();
    mesh_.outward.assign(mesh_.count, Point3{});
    for (std::size_t j = 0; j < line.size(); ++j) add_circle(j);
    for (std::size_t j = 0; j + 1 < line.size(); ++j) add_meridians(j);
  }
  std::vector<Polyline> const& sharp() const { return sharp_; }
  /// In perspective the viewer is in another direction at each edge.
  std::vector<Polyline> round(Projection const& project) const {
    if (!project.eye.near()) return silhouette(mesh_, project.towards);
    ReferenceMesh seen = mesh_;
    Point3 const eye = plus(project.eye.axis, project.eye.distance, project.towards);
    for (RoundEdge& edge : seen.round) {
      Point3 const away = minus(eye, seen.X[static_cast<std::size_t>(edge.ends[0])]);
      for (Point3& n : edge.normal) n = plus({}, dot(n, unit(away)), project.towards);
    }
    return silhouette(seen, project.towards);
  }

 private:
  Index at(std::size_t angle, std::size_t j) const { return static_cast<Index>(angle * line_.size() + j); }
  Rotation between(double k) const { return Rotation::by(degrees_ * k / static_cast<double>(angles_.size() - 1)); }

  void add_circle(std::size_t j) {
    std::size_t const last = line_.size() - 1;
    if (j == last && is_closed(line_)) return;
    bool const end = j == last || (j == 0 && !is_closed(line_));
    Point3 const& before = normal_[j == 0 ? normal_.size() - 1 : j - 1];
    Point3 const& after = normal_[std::min(j, normal_.size() - 1)];
    if (end || dot(before, after) < cosine_of_edge) {
      Polyline circle;
      for (double const angle : angles_) circle.push_back(Rotation::by(angle)(line_[j]));
      if (line_[j][0] > 0) sharp_.push_back(std::move(circle));
      return;
    }
    for (std::size_t k = 0; k + 1 < angles_.size(); ++k) {
      Rotation const rotate = between(static_cast<double>(k) + 0.5);
      mesh_.round.push_back({{at(k, j), at(k + 1, j)}, {rotate(before), rotate(after)}});
    }
  }
  void add_meridians(std::size_t j) {
    for (std::size_t k = degrees_ < 360 ? 1 : 0; k + 1 < angles_.size(); ++k) {
      double const here = static_cast<double>(k);
      mesh_.round.push_back(
          {{at(k, j), at(k, j + 1)}, {between(here - 0.5)(normal_[j]), between(here + 0.5)(normal_[j])}});
    }
  }

  Polyline const& line_;
  double degrees_;
  std::vector<double> angles_;
  std::vector<Point3> normal_;  ///< of each side of the line
  ReferenceMesh mesh_;
  std::vector<Polyline> sharp_;
};

}  // namespace

std::vector<Polyline> revolved_outline(ReferenceMesh const& mesh, double degrees, Projection const& project) {
  PIOLA_EXPECTS(degrees >= 0 && degrees <= 360);
  std::vector<Polyline> all;
  for (Polyline const& line : mesh.lines)
    for (Polyline const& part : parts_beside_axis(line, width_of_axis(line, mesh.spacing))) {
      if (degrees < 360)
        for (double const angle : {0.0, degrees == 0 ? 180 : degrees})
          all.push_back(rotated(part, Rotation::by(angle)));
      if (degrees == 0) continue;
      SweptLine const swept(part, degrees);
      all.insert(all.end(), swept.sharp().begin(), swept.sharp().end());
      for (Polyline const& seen : swept.round(project)) all.push_back(seen);
    }
  return all;
}

}  // namespace piola
