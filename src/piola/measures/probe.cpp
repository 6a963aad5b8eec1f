// SPDX-License-Identifier: Apache-2.0
#include "piola/measures/probe.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/exec/reproducible_sum.hpp"
#include "piola/input/probe_kinds.hpp"
#include "piola/measures/fragments.hpp"
#include "piola/measures/rim_and_hole.hpp"
#include "piola/measures/stress_intensity.hpp"
#include "piola/model/case_particles.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>
#include <numeric>

namespace piola {
namespace {

using Point = std::array<double, 3>;

Body const& find_body(ParticleSet const& particles, ProbeSpec const& spec) {
  if (Body const* const body = body_named(particles, spec.body)) return *body;
  throw InputError(
      fmt::format("probe '{}': there is no body '{}' - give the name of a [[body]]", spec.name, spec.body));
}

std::vector<std::int64_t> ahead(ParticleSet const& particles, Body const& body, ProbeSpec const& spec) {
  auto ids = particles_ahead(particles, body, spec);
  if (ids.empty()) {
    throw InputError(
        fmt::format("probe '{}': no particle of body '{}' is {} m to {} m ahead of the tip - change from and to",
                    spec.name, body.name, spec.from, spec.to));
  }
  return ids;
}

/// The selected particles of a probe.
std::vector<std::int64_t> selected(ParticleSet const& particles, Body const& body, ProbeSpec const& spec) {
  if (spec.kind == ProbeSpec::Kind::point) return {nearest_particle(particles, body, spec.at)};
  if (spec.kind == ProbeSpec::Kind::stress_intensity) return ahead(particles, body, spec);
  auto ids = select_particles(particles, body, spec.where ? &*spec.where : nullptr);
  if (ids.empty()) {
    throw InputError(fmt::format("probe '{}': where = \"{}\" selects no particle of body '{}' - widen the region",
                                 spec.name, spec.where ? spec.where->text() : "", body.name));
  }
  return ids;
}

std::vector<FieldQuantity> quantities_of(ProbeSpec const& spec) {
  std::vector<FieldQuantity> list;
  if (!info_of(spec.kind).quantities.empty()) return list;
  for (std::string const& name : spec.quantities) {
    auto quantity = find_quantity(name);
    if (!quantity)
      throw InputError(
          fmt::format("probe '{}': '{}' is not a known quantity - see docs/user/output.md", spec.name, name));
    list.push_back(*std::move(quantity));
  }
  return list;
}

/// Which of the numbers of a kind the probe gives; all of them if it names none.
std::vector<std::size_t> own_of(ProbeSpec const& spec) {
  auto const own = info_of(spec.kind).quantities;
  std::vector<std::size_t> list;
  for (std::size_t k = 0; k < own.size(); ++k) {
    auto const& asked = spec.quantities;
    if (asked.empty() || std::find(asked.begin(), asked.end(), own[k].name) != asked.end()) list.push_back(k);
  }
  return list;
}

/// Smallest and largest value, in any order: NaN is skipped.
struct Extrema {
  double low = std::numeric_limits<double>::quiet_NaN(), high = low;
  void observe(double value) { add({value, value}); }
  void add(Extrema const& other) {
    low = std::fmin(low, other.low);
    high = std::fmax(high, other.high);
  }
};

}  // namespace

Probe::Probe(ProbeSpec const& spec, ParticleSet const& particles)
    : kind_(spec.kind),
      name_(spec.name),
      axis_(static_cast<std::size_t>(spec.axis)),
      quantities_(quantities_of(spec)),
      own_(own_of(spec)),
      field_(spec.field),
      reference_(spec.reference),
      direction_(spec.direction) {
  PIOLA_EXPECTS(spec.axis >= 0 && spec.axis < 3);
  Body const& body = find_body(particles, spec);
  ids_ = selected(particles, body, spec);
  for (std::int64_t id : ids_) weight_.push_back(particles.volume[static_cast<std::size_t>(id)]);
  if (kind_ >= ProbeSpec::Kind::spacing) measured_.emplace(spec, particles, body, ids_);
  if (kind_ != ProbeSpec::Kind::stress_intensity) return;
  Point const& tip = particles.X[static_cast<std::size_t>(nearest_particle(particles, body, spec.at))];
  for (std::int64_t id : ids_) {
    Point const& X = particles.X[static_cast<std::size_t>(id)];
    distance_.push_back(std::hypot(X[0] - tip[0], X[1] - tip[1]));
  }
}

void Probe::share(std::optional<std::vector<std::int64_t>> const& owned) {
  if (!owned) return;
  std::vector<std::size_t> places(owned->size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) { return (*owned)[a] < (*owned)[b]; });
  Probe const whole = *this;
  ids_.clear();
  weight_.clear();
  for (std::size_t k = 0; k < whole.ids_.size(); ++k) {
    auto const found = std::lower_bound(places.begin(), places.end(), whole.ids_[k],
                                        [&](std::size_t at, std::int64_t id) { return (*owned)[at] < id; });
    if (found == places.end() || (*owned)[*found] != whole.ids_[k]) continue;
    ids_.push_back(whole.ids_[k]);
    weight_.push_back(whole.weight_[k]);
    place_.push_back(*found);
    if (kind_ == ProbeSpec::Kind::stress_intensity) order_.push_back(k);
  }
  ids_.shrink_to_fit();
  weight_.shrink_to_fit();
}

std::vector<HistoryColumn> Probe::columns() const {
  std::vector<HistoryColumn> list;
  for (std::size_t const k : own_) {
    HistoryName const& own = info_of(kind_).quantities[k];
    list.push_back({fmt::format("{}.{}", name_, own.name), std::string(own.unit)});
  }
  for (FieldQuantity const& q : quantities_) list.push_back({fmt::format("{}.{}", name_, q.name), q.unit});
  return list;
}

std::vector<double> Probe::evaluate(FieldCache& cache, double time) {
  std::vector<double> out;
  if (!own_.empty()) {
    auto const values = own_values(cache, time);
    for (std::size_t const k : own_) out.push_back(values[k]);
  }
  for (FieldQuantity const& q : quantities_) {
    bool const known = cache.knows(q.field);
    out.push_back(known ? reduce(component_values(cache, q.field, q.component))
                        : std::numeric_limits<double>::quiet_NaN());
  }
  return out;
}

std::vector<double> Probe::own_values(FieldCache& cache, double time) {
  switch (kind_) {
    case ProbeSpec::Kind::twist: return {twist(cache)};
    case ProbeSpec::Kind::extent: return {extent(cache)};
    case ProbeSpec::Kind::error: return {relative_error(cache, time)};
    case ProbeSpec::Kind::stress_intensity: return {intensity(cache)};
    case ProbeSpec::Kind::spacing: return spacing_values(*measured_, cache);
    case ProbeSpec::Kind::fragment: return fragment_values(*measured_, cache);
    case ProbeSpec::Kind::rim: return rim_values(*measured_, cache);
    case ProbeSpec::Kind::hole: return hole_values(*measured_, cache);
    default: return {};
  }
}

/// Extrema of value(k) over the particles of all ranks. Signs of zeros are removed, so that the order does not matter.
std::array<double, 2> Probe::extrema(auto const& value) const {
  Extrema all;
  for (std::size_t k = 0; k < ids_.size(); ++k) all.observe(value(k));
  comm::allreduce_sum(all);
  return {all.low + 0.0, all.high + 0.0};
}

double Probe::reduce(std::vector<double> const& values) const {
  auto const value = [&](std::size_t k) { return values[place(k)]; };
  if (kind_ == ProbeSpec::Kind::point) {
    double of_owner = ids_.empty() ? 0 : value(0);
    comm::allreduce_or({&of_owner, 1});
    return of_owner;
  }
  if (kind_ == ProbeSpec::Kind::minimum) return extrema(value)[0];
  if (kind_ == ProbeSpec::Kind::maximum) return extrema(value)[1];
  exec::ReproducibleSums<2> sums;
  for (std::size_t k = 0; k < ids_.size(); ++k) {
    double const of_particle[]{weight_[k] * value(k), weight_[k]};
    sums.add(of_particle);
  }
  comm::allreduce_sum(sums);
  return sums.value(0) / sums.value(1);
}

/// Angle that turns the reference positions best onto the current ones, seen along the axis, about the centroids:
/// atan2(sum V X x x, sum V X . x) with both positions projected on the plane across the axis. Right-handed.
double Probe::twist(FieldCache& cache) {
  auto const x = cache.values("Position");
  auto const reference = [&](std::size_t k, std::size_t c) {
    return cache.particles().X[static_cast<std::size_t>(ids_[k])][c];
  };
  auto const current = [&](std::size_t k, std::size_t c) { return x[place(k) * 3 + c]; };
  exec::ReproducibleSums<7> means;
  for (std::size_t k = 0; k < ids_.size(); ++k) {
    double of_particle[7]{weight_[k]};
    for (std::size_t c = 0; c < 3; ++c) {
      of_particle[1 + c] = weight_[k] * reference(k, c);
      of_particle[4 + c] = weight_[k] * current(k, c);
    }
    means.add(of_particle);
  }
  comm::allreduce_sum(means);
  Point X0, x0;
  for (int c = 0; c < 3; ++c) {
    X0[static_cast<std::size_t>(c)] = means.value(1 + c) / means.value(0);
    x0[static_cast<std::size_t>(c)] = means.value(4 + c) / means.value(0);
  }
  std::size_t const i = (axis_ + 1) % 3, j = (axis_ + 2) % 3;
  exec::ReproducibleSums<2> products;  // cross and dot
  for (std::size_t k = 0; k < ids_.size(); ++k) {
    double const Xi = reference(k, i) - X0[i], Xj = reference(k, j) - X0[j];
    double const xi = current(k, i) - x0[i], xj = current(k, j) - x0[j];
    double const of_particle[]{weight_[k] * (Xi * xj - Xj * xi), weight_[k] * (Xi * xi + Xj * xj)};
    products.add(of_particle);
  }
  comm::allreduce_sum(products);
  constexpr double turn = 2 * std::numbers::pi;
  double const angle = std::atan2(products.value(0), products.value(1));
  double const unwrapped = angle + turn * std::round((last_angle_ - angle) / turn);
  if (std::isfinite(unwrapped)) last_angle_ = unwrapped;
  return unwrapped;
}

double Probe::extent(FieldCache& cache) const {
  auto const x = cache.values("Position");
  auto const [low, high] = extrema([&](std::size_t k) { return x[place(k) * 3 + axis_]; });
  return high - low;
}

/// sqrt(sum V |f - r|^2 / sum V |r|^2) with the Frobenius norm: the shear components of a symmetric tensor count twice.
double Probe::relative_error(FieldCache& cache, double time) const {
  if (!cache.knows(field_)) return std::numeric_limits<double>::quiet_NaN();
  auto const f = cache.values(field_);
  std::size_t const width = reference_.size();
  exec::ReproducibleSums<2> sums;  // of the difference and of the reference
  for (std::size_t k = 0; k < ids_.size(); ++k) {
    auto const id = static_cast<std::size_t>(ids_[k]);
    for (std::size_t c = 0; c < width; ++c) {
      double const r = reference_[c](cache.particles().X[id], time), d = f[place(k) * width + c] - r;
      double const weight = width == 6 && c >= 3 ? 2 * weight_[k] : weight_[k];
      double const of_component[]{weight * d * d, weight * r * r};
      sums.add(of_component);
    }
  }
  comm::allreduce_sum(sums);
  return sums.value(0) == 0 ? 0 : std::sqrt(sums.value(0) / sums.value(1));
}

/// From the stress across the ligament, n.sigma n with n normal to the direction ahead.
double Probe::intensity(FieldCache& cache) const {
  if (!cache.knows("CauchyStress")) return std::numeric_limits<double>::quiet_NaN();
  auto const sigma = cache.values("CauchyStress");  // XX YY ZZ XY YZ XZ
  double const nx = -direction_[1], ny = direction_[0];
  std::vector<double> stress(distance_.size(), 0);
  for (std::size_t k = 0; k < ids_.size(); ++k) {
    double const* const s = &sigma[place(k) * 6];
    stress[order_.empty() ? k : order_[k]] = s[0] * nx * nx + s[1] * ny * ny + 2 * s[3] * nx * ny;
  }
  comm::allreduce_or(stress);
  return stress_intensity(distance_, stress);
}

}  // namespace piola
