// SPDX-License-Identifier: Apache-2.0
#include "piola/model/clearance.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/input/contact_capabilities.hpp"
#include "piola/math/array_conversion.hpp"
#include "piola/math/tensor.hpp"
#include "piola/model/region_checks.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace piola {
namespace {

using Vec3 = std::array<double, 3>;

double largest_spacing(Body const& body, int dimension) {
  return *std::max_element(body.spacing.begin(), body.spacing.begin() + dimension);
}

/// The particles of a body at the start, and the box around them. Those without a finite position are left out.
struct BodyPlaces {
  std::vector<Vec3> x;
  Vec3 low, high;

  BodyPlaces() {
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
  }
  BodyPlaces(BodySpec const& spec, ParticleSet const& particles, Body const& body) : BodyPlaces() {
    for (std::int64_t id = body.first; id < body.last; ++id)
      add(start_of(spec, particles.X[static_cast<std::size_t>(id)]));
  }
  void add(Vec3 const& p) {
    if (!std::isfinite(p[0] + p[1] + p[2])) return;
    x.push_back(p);
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], p[c]);
      high[c] = std::max(high[c], p[c]);
    }
  }
  /// Places in a box or within `margin` of it.
  BodyPlaces near(BodyPlaces const& box, double margin) const {
    BodyPlaces some;
    for (Vec3 const& p : x) {
      bool inside = true;
      for (std::size_t c = 0; c < 3; ++c)
        inside = inside && p[c] >= box.low[c] - margin && p[c] <= box.high[c] + margin;
      if (inside) some.add(p);
    }
    return some;
  }
};

/// The nearest two particles, if they are nearer than `reach` [m].
bool find_nearest(BodyPlaces const& a, BodyPlaces const& b, double reach, Clearance& found) {
  BodyPlaces const from = a.near(b, reach), to = b.near(from, reach);
  if (from.x.empty() || to.x.empty()) return false;
  CellGrid const grid(to.x, reach);
  double least2 = reach * reach;
  bool any = false;
  for (Vec3 const& p : from.x)
    grid.visit(p, [&](auto index) {
      Vec3 const& q = to.x[static_cast<std::size_t>(index)];
      double const square = std::pow(p[0] - q[0], 2) + std::pow(p[1] - q[1], 2) + std::pow(p[2] - q[2], 2);
      if (!(square < least2)) return;
      least2 = square;
      found.at = p;
      any = true;
    });
  found.distance = std::sqrt(least2);
  return any;
}

/// How far inside a shape a point is [m]; negative outside.
double depth_in(ShapeSpec const& shape, Vec3 const& x) {
  if (shape.kind == ShapeSpec::Kind::points) return -1;  // point clouds have no known boundary
  if (shape.kind == ShapeSpec::Kind::solid) return -shape.solid->at(vector_of(x)).distance;
  auto const D = static_cast<std::size_t>(shape.dimension);
  double least = std::numeric_limits<double>::infinity(), square = 0;
  auto const axis = static_cast<std::size_t>(shape.axis);
  if (shape.kind == ShapeSpec::Kind::box) {
    for (std::size_t d = 0; d < D; ++d) least = std::min({least, x[d] - shape.min[d], shape.max[d] - x[d]});
    return least;
  }
  bool const cylinder = shape.kind == ShapeSpec::Kind::cylinder;
  for (std::size_t d = 0; d < D; ++d)
    if (!cylinder || d != axis) square += std::pow(x[d] - shape.centre[d], 2);
  double const r = std::sqrt(square), along = x[axis] - shape.centre[axis];
  least = shape.radius - r;
  if (shape.inner_radius > 0) least = std::min(least, r - shape.inner_radius);
  return cylinder ? std::min({least, along, shape.length - along}) : least;
}

/// The reference position of what is at x at the start, by Newton's steps: exact where the body is shifted and turned.
Vec3 reference_of(BodySpec const& body, Vec3 const& x) {
  Vec3 X = x;
  for (int k = 0; k < 4 && body.initial_displacement; ++k) {
    Vec3 const at = start_of(body, X);
    Vec<3> const off{{x[0] - at[0], x[1] - at[1], x[2] - at[2]}};
    double const h = 1e-6 * std::max({std::fabs(X[0]), std::fabs(X[1]), std::fabs(X[2]), 1e-9});
    Mat<3> slope;
    for (std::size_t c = 0; c < 3; ++c) {
      Vec3 beside = X;
      beside[c] += h;
      Vec3 const there = start_of(body, beside);
      for (std::size_t i = 0; i < 3; ++i)
        slope(static_cast<int>(i), static_cast<int>(c)) = (there[i] - at[i]) / (beside[c] - X[c]);
    }
    Vec<3> const step = inverse(slope) * off;
    if (!std::isfinite(step[0] + step[1] + step[2])) return X;
    for (std::size_t c = 0; c < 3; ++c) X[c] += step[static_cast<int>(c)];
  }
  return X;
}

/// Bodies of which one has particles inside the other. Whether they do.
bool report_overlap(CaseSpec const& spec, ParticleSet const& particles, std::size_t a, std::size_t b,
                    Problems& problems) {
  std::string const names = "the bodies " + in_quotes(spec.bodies[a].name) + " and " + in_quotes(spec.bodies[b].name);
  Place const place = place_of(spec.bodies[b].places, "shape");
  for (auto const& [guest, host] : {std::pair{b, a}, std::pair{a, b}}) {
    Overclosure const found = overclosure(spec, particles, guest, host);
    if (found.particles == 0) continue;
    problems.add(place, names + " overlap at the start: " + count_text(found.particles) +
                            (found.particles == 1 ? " particle" : " particles") + " of " +
                            in_quotes(spec.bodies[guest].name) + " up to " + quantity_text(found.depth, "m") +
                            " inside " + in_quotes(spec.bodies[host].name) + " (allowed: none) - move one of them");
    return true;
  }
  return false;
}

/// Bodies whose nearest particles lie on each other, or nearly so.
void report_contact(CaseSpec const& spec, ParticleSet const& particles, Clearance const& pair, Problems& problems) {
  problems.add(place_of(spec.bodies[pair.other].places, "shape"),
               "the bodies " + in_quotes(spec.bodies[pair.body].name) + " and " +
                   in_quotes(spec.bodies[pair.other].name) + " have particles only " +
                   quantity_text(pair.distance, "m") + " apart at the start, at " +
                   point_text(pair.at, particles.dimension) + " (allowed: half a spacing, " +
                   quantity_text(0.5 * pair.spacing, "m") +
                   ", or more; contact would push them off with an energy out of nothing) - leave a gap of one "
                   "spacing; or give boxes that touch placement = \"cell_centred\"");
}

}  // namespace

std::vector<Clearance> close_bodies(CaseSpec const& spec, ParticleSet const& particles, double reach) {
  PIOLA_EXPECTS(reach > 0);
  PIOLA_EXPECTS(spec.bodies.size() == particles.bodies.size());
  std::vector<Clearance> found;
  std::vector<BodyPlaces> clouds;
  for (std::size_t b = 0; b < spec.bodies.size() && spec.bodies.size() > 1; ++b)
    clouds.emplace_back(spec.bodies[b], particles, particles.bodies[b]);
  for (std::size_t a = 0; a < clouds.size(); ++a)
    for (std::size_t b = a + 1; b < clouds.size(); ++b) {
      Clearance pair{.body = a, .other = b};
      pair.spacing = 0.5 * (largest_spacing(particles.bodies[a], particles.dimension) +
                            largest_spacing(particles.bodies[b], particles.dimension));
      if (find_nearest(clouds[a], clouds[b], reach * pair.spacing, pair)) found.push_back(pair);
    }
  return found;
}

std::vector<Clearance> close_shapes(CaseSpec const& spec, ParticleSet const& particles) {
  PIOLA_EXPECTS(spec.bodies.size() == particles.bodies.size());
  constexpr double rounding = 1e-9;
  std::vector<Clearance> found;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b)
    for (std::size_t k = 0; k < spec.rigids.size(); ++k) {
      Clearance pair{.body = b, .other = k};
      pair.spacing = 0.5 * largest_spacing(particles.bodies[b], particles.dimension);
      pair.distance = std::numeric_limits<double>::infinity();
      for (std::int64_t id = particles.bodies[b].first; id < particles.bodies[b].last; ++id) {
        Vec3 const x = start_of(spec.bodies[b], particles.X[static_cast<std::size_t>(id)]);
        double const distance = distance_to(spec.rigids[k], x, particles.dimension);
        if (!(distance < pair.distance)) continue;
        pair.distance = distance;
        pair.at = x;
      }
      if (pair.distance < pair.spacing * (1 - rounding)) found.push_back(pair);
    }
  return found;
}

Overclosure overclosure(CaseSpec const& spec, ParticleSet const& particles, std::size_t guest, std::size_t host) {
  PIOLA_EXPECTS(guest < spec.bodies.size() && host < spec.bodies.size() && guest != host);
  constexpr double rounding = 1e-9;  // of the spacing: particles on the surface are not inside
  Body const &from = particles.bodies[guest], &in = particles.bodies[host];
  double const allowed = rounding * largest_spacing(in, particles.dimension);
  Overclosure found;
  for (std::int64_t id = from.first; id < from.last; ++id) {
    Vec3 const x = start_of(spec.bodies[guest], particles.X[static_cast<std::size_t>(id)]);
    double const depth = depth_in(spec.bodies[host].shape, reference_of(spec.bodies[host], x));
    if (!(depth > allowed)) continue;
    ++found.particles;
    found.depth = std::max(found.depth, depth);
  }
  return found;
}

void add_surface_contact(CaseSpec& spec, ParticleSet const& particles) {
  constexpr double touching = 1.5;  // spacings between particles: less than half a spacing between surfaces
  if (spec.contact && is_given(spec.contact->places, "law")) return;
  auto const keeps_surface = [&](std::size_t b) { return can_lose_surface(spec, b) && has_surface(spec, b); };
  std::size_t able = 0;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) able += keeps_surface(b) ? 1 : 0;
  if (able < 2) return;
  ContactRule const rule = spec.contact ? ContactRule(*spec.contact) : ContactRule();
  for (Clearance const& near : close_bodies(spec, particles, touching)) {
    if (!keeps_surface(near.body) || !keeps_surface(near.other) || !has_own_contact(spec, near.body, near.other))
      continue;
    ContactPairSpec pair;
    pair.between = {spec.bodies[near.body].name, spec.bodies[near.other].name};
    pair.scale = rule.scale;
    pair.friction = rule.friction;
    spec.contact_pairs.push_back(std::move(pair));
  }
}

void check_overlap(CaseSpec const& spec, ParticleSet const& particles, Problems& problems) {
  std::set<std::pair<std::size_t, std::size_t>> overlapping;
  for (std::size_t a = 0; a < spec.bodies.size(); ++a)
    for (std::size_t b = a + 1; b < spec.bodies.size(); ++b)
      if (report_overlap(spec, particles, a, b, problems)) overlapping.insert({a, b});
  if (spec.contact && spec.contact->law == ContactRule::Law::none) return;
  constexpr double half = 0.5 * (1 - 1e-6);  // of a spacing, less round-off
  // Surfaces may touch.
  for (Clearance const& pair : close_bodies(spec, particles, half))
    if (has_own_contact(spec, pair.body, pair.other) && !overlapping.contains({pair.body, pair.other}))
      report_contact(spec, particles, pair, problems);
}

}  // namespace piola
