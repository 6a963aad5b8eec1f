// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/colour_contact.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/kernels/wendland_c2.hpp"
#include "piola/mechanics/contact/blended_planes.hpp"
#include "piola/mechanics/contact/bounding_box.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace piola::contact {
namespace {

constexpr double support_in_spacings = 2.4, skin_in_spacings = 0.3;
constexpr double soon = 0.5;         // of the colour of touching faces: from here on a contact limits the step
constexpr double in_one_step = 0.1;  // of a spacing

std::size_t number(Index k) { return static_cast<std::size_t>(k); }
double size_of(Vec<3> const& a) { return std::sqrt(dot(a, a)); }

}  // namespace

double ColourKernel::value(double r) const {
  double const h = support / WendlandC2::support;
  return WendlandC2::sigma(dimension) / std::pow(h, dimension) * WendlandC2::w(dimension, r / h);
}

double ColourKernel::slope(double r) const {
  double const h = support / WendlandC2::support;
  if (!(r > 0)) return 0;  // it multiplies the vector of length r
  return WendlandC2::sigma(dimension) / std::pow(h, dimension + 1) * WendlandC2::dw(dimension, r / h) / r;
}

/// By sums over the layer in which a plane at distance z cuts the kernel: Simpson's rule, 64 intervals each.
ColourKernel::Colour ColourKernel::of_half_space(double d) const {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3 && support > 0);
  PIOLA_EXPECTS(d >= 0);
  constexpr int intervals = 64;
  auto const simpson = [](double from, double to, auto const& f) {
    double const h = (to - from) / intervals;
    double sum = f(from) + f(to);
    for (int k = 1; k < intervals; ++k) sum += (k % 2 == 1 ? 4 : 2) * f(from + k * h);
    return sum * h / 3;
  };
  // The kernel's integral over the plane at z.
  auto const over_plane = [&](double z) {
    if (dimension == 1) return value(z);
    double const widest = std::sqrt(std::max(support * support - z * z, 0.0));
    return simpson(0, widest, [&](double s) {
      double const around = dimension == 2 ? 2 : 2 * std::numbers::pi * s;
      return around * value(std::hypot(s, z));
    });
  };
  return {simpson(d, support, over_plane), over_plane(d)};
}

ColourContact::ColourContact(int dimension, std::vector<Body> bodies, std::vector<Pair> pairs)
    : bodies_(std::move(bodies)), pairs_(std::move(pairs)), on_first_(pairs_.size()) {
  for (std::size_t p = 0; p < pairs_.size(); ++p)
    for (auto const& [body, other] : {std::pair{pairs_[p].a, pairs_[p].b}, std::pair{pairs_[p].b, pairs_[p].a}}) {
      PIOLA_EXPECTS(body < bodies_.size() && other < bodies_.size() && body != other);
      Body const &a = bodies_[body], &b = bodies_[other];
      PIOLA_EXPECTS(a.volume.size() == a.at.size() && a.spacing > 0 && a.modulus > 0);
      PairRule const rule = pair_rule(pairs_[p].factor, a.modulus, a.spacing, b.modulus, b.spacing);
      Pass pass{.number = static_cast<Index>(passes_.size()),
                .pair = p,
                .body = body,
                .other = other,
                .late = pairs_[p].late,
                .active = false,
                .kernel = {dimension, support_in_spacings * std::max(a.spacing, b.spacing)},
                .target = {},
                .begin = {},
                .source = {}};
      auto const touching = pass.kernel.of_half_space(0.5 * a.spacing);
      pass.touching = touching.value;
      pass.slope = touching.slope;
      pass.stiffness = rule.stiffness;
      pass.length = rule.length;
      skin_ = std::max(skin_, skin_in_spacings * std::max(a.spacing, b.spacing));
      passes_.push_back(std::move(pass));
    }
  activate();
}

/// Finds the passes that have targets.
void ColourContact::activate() {
  in_active_pass_.assign(bodies_.size(), 0);
  for (Pass& pass : passes_) {
    std::vector<Index> const& own = bodies_[pass.body].at;
    pass.active = !pass.late || std::any_of(own.begin(), own.end(), [&](Index k) { return late_.has(k); });
    if (pass.active) in_active_pass_[pass.body] = in_active_pass_[pass.other] = 1;
  }
}

bool ColourContact::any() const {
  return std::any_of(passes_.begin(), passes_.end(), [](Pass const& pass) { return pass.active; });
}

void ColourContact::add_targets(std::vector<char> const& marked) {
  if (marked.empty() || passes_.empty()) return;
  late_.add(marked);
  activate();
  listed_at_.clear();
}

bool ColourContact::lists_hold(std::vector<Vec<3>> const& x, std::vector<double> const& masses) const {
  if (listed_at_.size() != x.size()) return false;
  double const most = 0.25 * skin_ * skin_;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (in_active_pass_[b] == 0) continue;
    for (Index const k : bodies_[b].at) {
      Vec<3> const moved = x[number(k)] - listed_at_[number(k)];
      if (!(dot(moved, moved) < most) || (masses[number(k)] > 0) != (listed_alive_[number(k)] != 0)) return false;
    }
  }
  return true;
}

void ColourContact::make_lists(std::vector<Vec<3>> const& x, std::vector<double> const& masses) {
  for (Pass& pass : passes_) list(pass, x, masses);
  listed_at_ = x;
  listed_alive_.assign(masses.size(), 0);
  for (std::size_t k = 0; k < masses.size(); ++k) listed_alive_[k] = masses[k] > 0 ? 1 : 0;
}

/// Numbers in the body of its particles that have mass; late: of those among them that are late targets.
std::vector<Index> ColourContact::present(std::size_t body, bool late, std::vector<Vec<3>> const& x,
                                          std::vector<double> const& masses) const {
  std::vector<Index> const& at = bodies_[body].at;
  std::vector<Index> all;
  for (std::size_t k = 0; k < at.size(); ++k) {
    PIOLA_EXPECTS(number(at[k]) < x.size());
    Vec<3> const& y = x[number(at[k])];
    if (!(masses[number(at[k])] > 0) || !std::isfinite(y[0] + y[1] + y[2])) continue;
    if (!late || late_.has(at[k])) all.push_back(static_cast<Index>(k));
  }
  return all;
}

/// Only particles near the box around those of the other body are listed.
void ColourContact::list(Pass& pass, std::vector<Vec<3>> const& x, std::vector<double> const& masses) const {
  double const reach = pass.kernel.support + skin_;
  pass.target.clear();
  pass.source.clear();
  pass.begin.assign(1, 0);
  if (!pass.active) return;
  auto const place = [&](std::size_t body, Index k) -> Vec<3> const& { return x[number(bodies_[body].at[number(k)])]; };
  std::vector<Index> const targets = present(pass.body, pass.late, x, masses);
  BoundingBox around_targets, around_sources;
  for (Index const k : targets) around_targets.add(place(pass.body, k));
  std::vector<std::array<double, 3>> places;
  std::vector<Index> source;
  for (Index const k : present(pass.other, false, x, masses)) {
    Vec<3> const& y = place(pass.other, k);
    if (!around_targets.holds(y, reach)) continue;
    around_sources.add(y);
    places.push_back({y[0], y[1], y[2]});
    source.push_back(k);
  }
  if (places.empty()) return;
  CellGrid const grid(places, reach);
  for (Index const k : targets) {
    Vec<3> const& y = place(pass.body, k);
    if (!around_sources.holds(y, reach)) continue;
    std::size_t const first = pass.source.size();
    grid.visit({y[0], y[1], y[2]}, [&](Index j) {
      Vec<3> const r = y - place(pass.other, source[number(j)]);
      if (dot(r, r) < reach * reach) pass.source.push_back(source[number(j)]);
    });
    if (pass.source.size() == first) continue;
    std::sort(pass.source.begin() + static_cast<std::ptrdiff_t>(first), pass.source.end());
    pass.target.push_back(k);
    pass.begin.push_back(pass.source.size());
  }
}

ColourContact::Seen ColourContact::look(Pass const& pass, std::size_t target, std::vector<Vec<3>> const& x) const {
  Body const& other = bodies_[pass.other];
  Vec<3> const& y = x[number(bodies_[pass.body].at[number(pass.target[target])])];
  Seen seen;
  for (std::size_t s = pass.begin[target]; s < pass.begin[target + 1]; ++s) {
    std::size_t const b = number(pass.source[s]);
    Vec<3> const r = y - x[number(other.at[b])];
    double const distance = size_of(r), V = other.volume[b];
    seen.colour += V * pass.kernel.value(distance);
    Vec<3> const slope = (V * pass.kernel.slope(distance)) * r;
    seen.slope = seen.slope + slope;
    seen.size += size_of(slope);
  }
  seen.size += size_of(seen.slope);
  return seen;
}

void ColourContact::add(Index k, Vec<3> const& f) {
  if (is_pushed_[number(k)] == 0) {
    is_pushed_[number(k)] = 1;
    loaded_indices_.push_back(k);
  }
  forces_[number(k)] = forces_[number(k)] + f;
}

/// E = A psi(g), g = (C_touching - C) / |C'|.
void ColourContact::push(Pass const& pass, std::size_t target, Seen const& seen, std::vector<Vec<3>> const& x,
                         exec::ReproducibleSum& energy) {
  Body const &own = bodies_[pass.body], &other = bodies_[pass.other];
  Index const self = own.at[number(pass.target[target])];
  double const distance = (pass.touching - seen.colour) / pass.slope;
  double const gap = pass.late ? late_.pushing_gap(pass.number, self, distance) : distance;
  if (!(seen.colour > soon * pass.touching)) return;
  double const area = own.volume[number(pass.target[target])] / own.spacing;
  double const in_lengths = std::min(gap, 0.0) / pass.length;
  // Second derivative of the energy by C, times the sizes of the slopes.
  double const bend = area * pass.stiffness * (1 + 3 * in_lengths * in_lengths) / (pass.slope * pass.slope) * seen.size;
  stiffness_[number(self)] += bend * size_of(seen.slope);
  Layer const psi = layer(gap, pass.stiffness, pass.length);
  double const by_colour = -area * psi.slope / pass.slope;
  Vec<3> const& y = x[number(self)];
  for (std::size_t s = pass.begin[target]; s < pass.begin[target + 1]; ++s) {
    std::size_t const b = number(pass.source[s]);
    Vec<3> const r = y - x[number(other.at[b])];
    double const by_distance = pass.kernel.slope(size_of(r));
    if (!(by_distance < 0)) continue;  // in the margin of the list
    Vec<3> const slope = (other.volume[b] * by_distance) * r;
    stiffness_[number(other.at[b])] += bend * size_of(slope);
    if (gap < 0) add(other.at[b], by_colour * slope);
  }
  if (!(gap < 0)) return;
  Vec<3> const f = (-by_colour) * seen.slope;
  add(self, f);
  energy += area * psi.energy;
  totals_.deepest = std::max(totals_.deepest, -distance / (2 * pass.length));
  totals_.touched += 1;
  bool const first = pass.body == pairs_[pass.pair].a;
  double const sign = first ? 1 : -1;
  on_first_[pass.pair].add(sign * f, sign * cross(y, f));
}

void ColourContact::evaluate(std::vector<Vec<3>> const& x, std::vector<double> const& masses) {
  PIOLA_EXPECTS(!any() || masses.size() == x.size());
  if (!any()) return;
  if (forces_.size() != x.size()) {
    forces_.assign(x.size(), {});
    stiffness_.assign(x.size(), 0);
    is_pushed_.assign(x.size(), 0);
  }
  for (Index const k : loaded_indices_) {
    forces_[number(k)] = {};
    is_pushed_[number(k)] = 0;
  }
  loaded_indices_.clear();
  std::fill(stiffness_.begin(), stiffness_.end(), 0.0);
  on_first_.assign(pairs_.size(), {});
  totals_ = {};
  if (!lists_hold(x, masses)) make_lists(x, masses);
  std::vector<Seen> seen;
  exec::ReproducibleSum energy;
  for (Pass const& pass : passes_) {
    seen.resize(pass.target.size());
    exec_host::parallel_for(static_cast<Index>(seen.size()),
                            [&](Index k) { seen[number(k)] = look(pass, number(k), x); });
    for (std::size_t k = 0; k < seen.size(); ++k) push(pass, k, seen[k], x, energy);
  }
  late_.settle();
  totals_.energy = energy.value();
  std::sort(loaded_indices_.begin(), loaded_indices_.end());
  for (std::size_t k = 0; k < masses.size(); ++k)
    if (stiffness_[k] > 0 && masses[k] > 0)
      totals_.frequency2 = std::max(totals_.frequency2, stiffness_[k] / masses[k]);
}

double ColourContact::contact_time_step(std::vector<Vec<3>> const& x, std::vector<Vec<3>> const& v) const {
  PIOLA_EXPECTS(!any() || v.size() == x.size());
  double step = std::numeric_limits<double>::infinity();
  for (Pass const& pass : passes_) {
    double const dp = 2 * pass.length;
    for (std::size_t target = 0; target < pass.target.size(); ++target) {
      Index const self = bodies_[pass.body].at[number(pass.target[target])];
      for (std::size_t s = pass.begin[target]; s < pass.begin[target + 1]; ++s) {
        Index const b = bodies_[pass.other].at[number(pass.source[s])];
        Vec<3> const r = x[number(self)] - x[number(b)];
        double const distance = size_of(r);
        if (!(distance < 1.5 * dp) || !(distance > 0)) continue;
        double const speed = -dot(v[number(self)] - v[number(b)], r) / distance;
        if (speed > 0) step = std::min(step, in_one_step * dp / speed);
      }
    }
  }
  return step;
}

std::size_t ColourContact::bytes() const {
  std::size_t sum = forces_.size() * (3 * sizeof(Vec<3>) + sizeof(double));
  for (Pass const& pass : passes_) sum += pass.source.size() * sizeof(Index);
  return sum;
}

}  // namespace piola::contact
