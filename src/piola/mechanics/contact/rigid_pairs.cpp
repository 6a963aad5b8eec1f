// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/rigid_pairs.hpp"
#include "piola/base/contracts.hpp"
#include "piola/mechanics/contact/state_vector.hpp"
#include "piola/mechanics/contact/surface_contact.hpp"
#include "piola/mechanics/rigid_mass.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace piola::contact {
namespace {

using Kind = RigidSurface::Kind;

constexpr double closing_share = 0.1;  // of a spacing in a step
constexpr double resolved = 0.05;      // of 1/omega: the energy error of an impact falls with its square
/// Sine of the slope below which the deepest point of the rim of a cylinder's end goes over into its middle.
constexpr double upright = 0.02;

/// Area that a shape pushes with [m2]; in 2D a length.
double size_of(RigidShape const& shape, int dimension) {
  double const volume = volume_of(shape, dimension);
  return std::pow(volume, (dimension - 1.0) / dimension);
}

int points_of(Kind kind, int dimension) {
  if (kind == Kind::sphere) return 1;
  if (kind == Kind::cylinder) return 2;
  return dimension == 3 ? 4 : 2;  // corners of a face
}

bool has_inside(RigidShape const& shape) { return shape.kind == Kind::box || shape.kind == Kind::cylinder; }

}  // namespace

RigidPairs::RigidPairs(std::vector<RigidShape> const& shapes, int dimension, Setting const& setting)
    : setting_(setting), samples_(shapes.size()), loads_(shapes.size()), frequency2_(shapes.size()) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  PIOLA_EXPECTS(setting.stiffness >= 0 && setting.spacing >= 0);
  for (std::size_t a = 0; a < shapes.size(); ++a)
    for (std::size_t b = 0; b < shapes.size(); ++b) {
      RigidShape const &one = shapes[a], &other = shapes[b];
      if (a == b || !(one.free || other.free)) continue;
      if (has_inside(one) && has_inside(other)) {  // each in turn
        if (samples_[a].empty()) samples_[a] = samples_of(one, dimension);
        pairs_.push_back({a, b, 0.5 * setting.stiffness, 0.5, true});
        continue;
      }
      // The points are those of the sphere, else those that stand before the plane; of two spheres of the first.
      bool const points = one.kind == Kind::sphere || (other.kind == Kind::plane && one.kind != Kind::plane);
      if (!points || (other.kind == Kind::sphere && b < a)) continue;
      double const area = std::min(size_of(one, dimension), size_of(other, dimension)) / points_of(one.kind, dimension);
      pairs_.push_back({a, b, setting.stiffness * area, area, false});
    }
}

std::vector<RigidPairs::ContactPoint> RigidPairs::touches(Pair const& pair,
                                                          std::vector<RigidSurface> const& shapes) const {
  RigidSurface const &a = shapes[pair.a], &b = shapes[pair.b];
  if (pair.sampled) return sampled_touches(samples_[pair.a], a, b);
  if (a.kind == Kind::sphere) {
    Distance const d = distance_from(b, a.centre);
    double const gap = d.value - a.radius;
    return {{a.centre - (a.radius + 0.5 * gap) * d.normal, d.normal, gap}};
  }
  std::vector<ContactPoint> all;
  auto const add = [&](Vec<3> const& y) { all.push_back({y, b.axis, distance_from(b, y).value}); };
  if (a.kind == Kind::cylinder) {
    double const along = dot(b.axis, a.axis);
    Vec<3> const across = b.axis - along * a.axis;
    double const sine2 = square_of(across), length = std::sqrt(sine2 + upright * upright);
    for (double const end : {-1.0, 1.0}) {
      // Its gap is -radius (length - upright) from that of the middle of the end: an energy with smooth slopes.
      Vec<3> const middle = a.centre + (end * a.half_lengths[0]) * a.axis;
      all.push_back({middle - (a.radius / length) * across, b.axis,
                     distance_from(b, middle).value - a.radius * (length - upright)});
    }
    return all;
  }
  for (int corner = 0; corner < (a.dimension == 3 ? 8 : 4); ++corner) {
    Vec<3> r;
    for (int c = 0; c < a.dimension; ++c) r[c] = (corner >> c & 1 ? 1 : -1) * a.half_lengths[c];
    add(a.centre + a.turn * r);
  }
  return all;
}

/// Empty for a distant body; else the points that are near enough for this step and the next.
std::vector<RigidPairs::ContactPoint> RigidPairs::sampled_touches(std::vector<SurfaceSample> const& samples,
                                                                  RigidSurface const& a, RigidSurface const& b) const {
  Vec<3> const between = a.centre - b.centre;
  double const apart = std::sqrt(square_of(between)), gap = apart - reach_of(a) - reach_of(b);
  if (gap > setting_.spacing) {
    Vec<3> const n = (1 / apart) * between;
    return {{b.centre + reach_of(b) * n, n, gap, 0}};
  }
  std::vector<ContactPoint> all;
  for (SurfaceSample const& sample : samples) {
    Vec<3> const y = a.centre + a.turn * sample.arm;
    Distance const d = distance_from(b, y);
    all.push_back({y, d.normal, d.value, sample.area});
  }
  return all;
}

void RigidPairs::add(std::size_t shape, Vec<3> const& arm, Vec<3> const& force) {
  loads_[shape] = {loads_[shape].force + force, loads_[shape].moment + cross(arm, force)};
}

/// Friction on shape a.
Vec<3> RigidPairs::apply_friction(std::size_t pair, std::size_t point, ContactPoint const& touch, double normal_force,
                                  std::vector<RigidSurface> const& shapes) {
  Pair const& p = pairs_[pair];
  RigidSurface const &a = shapes[p.a], &b = shapes[p.b];
  auto const last = std::lower_bound(last_stuck_.begin(), last_stuck_.end(), StickState{pair, point, {}, {}});
  bool const known = last != last_stuck_.end() && last->pair == pair && last->point == point;
  Vec<3> const jump = moved_from(last_[p.a], a, touch.y) - moved_from(last_[p.b], b, touch.y);
  Spring const before = known ? Spring{b.turn * last->stretch, last->force} : Spring{};
  FrictionState const now = update_friction(known ? &before : nullptr, jump, touch.normal, touch.weight * p.stiffness,
                                            setting_.friction, normal_force, touch.weight * p.area, dt_);
  totals_.friction_work += now.work;
  totals_.spring_energy += now.energy;
  stuck_.push_back({pair, point, transpose(b.turn) * now.spring.stretch, now.spring.force});
  return now.spring.force;
}

void RigidPairs::push(std::size_t pair, std::size_t point, ContactPoint const& touch,
                      std::vector<RigidSurface> const& shapes) {
  Pair const& p = pairs_[pair];
  RigidSurface const &a = shapes[p.a], &b = shapes[p.b];
  double const length = 0.5 * setting_.spacing;
  if (!(touch.gap < near * setting_.spacing)) return;
  double const over = std::min(touch.gap, 0.0) / length;
  double const stiffness = touch.weight * p.stiffness * (1 + 3 * over * over);
  for (std::size_t const shape : {p.a, p.b}) {
    RigidSurface const& s = shapes[shape];
    frequency2_[shape] +=
        stiffness * (setting_.friction.any() ? s.mobility(touch.y) : s.mobility(touch.y, touch.normal));
  }
  if (!(touch.gap < 0)) return;
  Layer const psi = layer(touch.gap, touch.weight * p.stiffness, length);
  totals_.energy += psi.energy;
  totals_.deepest = std::max(totals_.deepest, -touch.gap / setting_.spacing);
  totals_.touched += 1;
  Vec<3> f = (-psi.slope) * touch.normal;
  if (setting_.friction.any()) f = f + apply_friction(pair, point, touch, -psi.slope, shapes);
  add(p.a, touch.y - a.centre, f);
  add(p.b, touch.y - b.centre, -1.0 * f);
}

void RigidPairs::start(std::vector<RigidSurface> const& shapes) {
  PIOLA_EXPECTS(shapes.size() == loads_.size());
  remember(shapes);
  evaluate(shapes, 0);
}

void RigidPairs::remember(std::vector<RigidSurface> const& shapes) {
  last_.clear();
  for (RigidSurface const& shape : shapes) last_.push_back(pose_of(shape));
}

void RigidPairs::evaluate(std::vector<RigidSurface> const& shapes, double dt) {
  PIOLA_EXPECTS(pairs_.empty() || last_.size() == shapes.size());
  dt_ = dt;
  std::swap(stuck_, last_stuck_);
  stuck_.clear();
  totals_ = {};
  std::fill(loads_.begin(), loads_.end(), Load{});
  std::fill(frequency2_.begin(), frequency2_.end(), 0.0);
  for (std::size_t pair = 0; pair < pairs_.size(); ++pair) {
    std::vector<ContactPoint> const all = touches(pairs_[pair], shapes);
    for (std::size_t point = 0; point < all.size(); ++point) push(pair, point, all[point], shapes);
  }
  remember(shapes);
}

double RigidPairs::frequency2(std::vector<double>& of_shapes) const {
  PIOLA_EXPECTS(of_shapes.size() == frequency2_.size());
  for (std::size_t k = 0; k < of_shapes.size(); ++k) of_shapes[k] += frequency2_[k];
  double largest = 0;
  for (Pair const& p : pairs_)
    if (frequency2_[p.a] > 0 || frequency2_[p.b] > 0) largest = std::max(largest, of_shapes[p.a] + of_shapes[p.b]);
  return largest;
}

double RigidPairs::contact_time_step(std::vector<RigidSurface> const& shapes) const {
  PIOLA_EXPECTS(shapes.size() == loads_.size());
  double step = std::numeric_limits<double>::infinity();
  for (Pair const& p : pairs_)
    if (double const omega2 = frequency2_[p.a] + frequency2_[p.b]; omega2 > 0)
      step = std::min(step, resolved / std::sqrt(omega2));
  for (Pair const& p : pairs_)
    for (ContactPoint const& touch : touches(p, shapes)) {
      double const speed = dot(shapes[p.b].velocity_at(touch.y) - shapes[p.a].velocity_at(touch.y), touch.normal);
      double const way = closing_share * setting_.spacing + 0.5 * std::max(touch.gap, 0.0);
      if (speed > 0) step = std::min(step, way / speed);
    }
  return step;
}

std::vector<double> RigidPairs::state() const {
  std::vector<double> all{totals_.energy, totals_.spring_energy, totals_.friction_work, totals_.deepest,
                          totals_.touched};
  for (Load const& load : loads_) {
    put(all, load.force);
    put(all, load.moment);
  }
  all.insert(all.end(), frequency2_.begin(), frequency2_.end());
  for (StickState const& s : stuck_) {
    all.push_back(static_cast<double>(s.pair));
    all.push_back(static_cast<double>(s.point));
    put(all, s.stretch);
    put(all, s.force);
  }
  return all;
}

void RigidPairs::restore(std::vector<RigidSurface> const& shapes, std::vector<double> const& state) {
  PIOLA_EXPECTS(shapes.size() == loads_.size());
  remember(shapes);
  StateVector from(state);
  totals_ = {from.next(), from.next(), from.next(), from.next(), from.next()};
  for (Load& load : loads_) {
    from.take(load.force);
    from.take(load.moment);
  }
  for (double& f : frequency2_) f = from.next();
  stuck_.clear();
  while (from.any()) {
    StickState s{from.count(), from.count(), {}, {}};
    from.take(s.stretch);
    from.take(s.force);
    stuck_.push_back(s);
  }
}

}  // namespace piola::contact
