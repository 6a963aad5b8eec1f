// SPDX-License-Identifier: Apache-2.0
#include "piola/measures/probe.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/exec/reproducible_sum.hpp"
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
#include <utility>

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
  if (spec.kind == ProbeKind::point) return {nearest_particle(particles, body, spec.at)};
  if (spec.kind == ProbeKind::stress_intensity) return ahead(particles, body, spec);
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

/// Extrema of value(k) over the particles of all ranks. Signs of zeros are removed, so that the order does not matter.
template <class Value>
std::array<double, 2> extrema(ProbeParticles const& p, Value const& value) {
  Extrema all;
  for (std::size_t k = 0; k < p.size(); ++k) all.observe(value(k));
  comm::allreduce_sum(all);
  return {all.low + 0.0, all.high + 0.0};
}

/// The number that a probe of a field takes of its values.
double reduce(ProbeKind kind, ProbeParticles const& p, std::vector<double> const& values) {
  auto const value = [&](std::size_t k) { return values[p.at(k)]; };
  if (kind == ProbeKind::point) {
    double of_owner = p.ids.empty() ? 0 : value(0);
    comm::allreduce_or({&of_owner, 1});
    return of_owner;
  }
  if (kind == ProbeKind::minimum) return extrema(p, value)[0];
  if (kind == ProbeKind::maximum) return extrema(p, value)[1];
  exec::ReproducibleSums<2> sums;
  for (std::size_t k = 0; k < p.size(); ++k) {
    double const of_particle[]{p.volume[k] * value(k), p.volume[k]};
    sums.add(of_particle);
  }
  comm::allreduce_sum(sums);
  return sums.value(0) / sums.value(1);
}

/// Angle that turns the reference positions best onto the current ones, seen along the axis, about the centroids:
/// atan2(sum V X x x, sum V X . x) with both positions projected on the plane across the axis. Right-handed.
double twist(std::size_t axis, ProbeParticles const& p, FieldCache& cache, double& last_angle) {
  auto const x = cache.values("Position");
  auto const reference = [&](std::size_t k, std::size_t c) {
    return cache.particles().X[static_cast<std::size_t>(p.ids[k])][c];
  };
  auto const current = [&](std::size_t k, std::size_t c) { return x[p.at(k) * 3 + c]; };
  exec::ReproducibleSums<7> means;
  for (std::size_t k = 0; k < p.size(); ++k) {
    double of_particle[7]{p.volume[k]};
    for (std::size_t c = 0; c < 3; ++c) {
      of_particle[1 + c] = p.volume[k] * reference(k, c);
      of_particle[4 + c] = p.volume[k] * current(k, c);
    }
    means.add(of_particle);
  }
  comm::allreduce_sum(means);
  Point X0, x0;
  for (int c = 0; c < 3; ++c) {
    X0[static_cast<std::size_t>(c)] = means.value(1 + c) / means.value(0);
    x0[static_cast<std::size_t>(c)] = means.value(4 + c) / means.value(0);
  }
  std::size_t const i = (axis + 1) % 3, j = (axis + 2) % 3;
  exec::ReproducibleSums<2> products;  // cross and dot
  for (std::size_t k = 0; k < p.size(); ++k) {
    double const Xi = reference(k, i) - X0[i], Xj = reference(k, j) - X0[j];
    double const xi = current(k, i) - x0[i], xj = current(k, j) - x0[j];
    double const of_particle[]{p.volume[k] * (Xi * xj - Xj * xi), p.volume[k] * (Xi * xi + Xj * xj)};
    products.add(of_particle);
  }
  comm::allreduce_sum(products);
  constexpr double turn = 2 * std::numbers::pi;
  double const angle = std::atan2(products.value(0), products.value(1));
  double const unwrapped = angle + turn * std::round((last_angle - angle) / turn);
  if (std::isfinite(unwrapped)) last_angle = unwrapped;
  return unwrapped;
}

double extent(std::size_t axis, ProbeParticles const& p, FieldCache& cache) {
  auto const x = cache.values("Position");
  auto const [low, high] = extrema(p, [&](std::size_t k) { return x[p.at(k) * 3 + axis]; });
  return high - low;
}

/// sqrt(sum V |f - r|^2 / sum V |r|^2) with the Frobenius norm: the shear components of a symmetric tensor count twice.
double relative_error(ProbeSpec const& spec, ProbeParticles const& p, FieldCache& cache, double time) {
  if (!cache.knows(spec.field)) return std::numeric_limits<double>::quiet_NaN();
  auto const f = cache.values(spec.field);
  std::size_t const width = spec.reference.size();
  exec::ReproducibleSums<2> sums;  // of the difference and of the reference
  for (std::size_t k = 0; k < p.size(); ++k) {
    auto const id = static_cast<std::size_t>(p.ids[k]);
    for (std::size_t c = 0; c < width; ++c) {
      double const r = spec.reference[c](cache.particles().X[id], time), d = f[p.at(k) * width + c] - r;
      double const weight = width == 6 && c >= 3 ? 2 * p.volume[k] : p.volume[k];
      double const of_component[]{weight * d * d, weight * r * r};
      sums.add(of_component);
    }
  }
  comm::allreduce_sum(sums);
  return sums.value(0) == 0 ? 0 : std::sqrt(sums.value(0) / sums.value(1));
}

/// From the stress across the ligament, n.sigma n with n normal to the direction ahead.
double intensity(ProbeSpec const& spec, std::vector<double> const& distance, ProbeParticles const& p,
                 FieldCache& cache) {
  if (!cache.knows("CauchyStress")) return std::numeric_limits<double>::quiet_NaN();
  auto const sigma = cache.values("CauchyStress");  // XX YY ZZ XY YZ XZ
  double const nx = -spec.direction[1], ny = spec.direction[0];
  std::vector<double> stress(distance.size(), 0);
  for (std::size_t k = 0; k < p.size(); ++k) {
    double const* const s = &sigma[p.at(k) * 6];
    stress[p.order.empty() ? k : p.order[k]] = s[0] * nx * nx + s[1] * ny * ny + 2 * s[3] * nx * ny;
  }
  comm::allreduce_or(stress);
  return stress_intensity(distance, stress);
}

}  // namespace

Probe::Probe(ProbeSpec const& spec, ParticleSet const& particles)
    : spec_(spec), quantities_(quantities_of(spec)), own_(own_of(spec)) {
  PIOLA_EXPECTS(spec.axis >= 0 && spec.axis < 3);
  Body const& body = find_body(particles, spec);
  particles_.ids = selected(particles, body, spec);
  for (std::int64_t id : ids()) particles_.volume.push_back(particles.volume[static_cast<std::size_t>(id)]);
  if (!is_reducible()) measured_.emplace(spec, particles, body, ids());
  if (spec.kind != ProbeKind::stress_intensity) return;
  Point const& tip = particles.X[static_cast<std::size_t>(nearest_particle(particles, body, spec.at))];
  for (std::int64_t id : ids()) {
    Point const& X = particles.X[static_cast<std::size_t>(id)];
    distance_.push_back(std::hypot(X[0] - tip[0], X[1] - tip[1]));
  }
}

void Probe::share(std::optional<std::vector<std::int64_t>> const& owned) {
  if (!owned) return;
  std::vector<std::size_t> places(owned->size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) { return (*owned)[a] < (*owned)[b]; });
  ProbeParticles const whole = std::exchange(particles_, {});
  for (std::size_t k = 0; k < whole.size(); ++k) {
    auto const found = std::lower_bound(places.begin(), places.end(), whole.ids[k],
                                        [&](std::size_t at, std::int64_t id) { return (*owned)[at] < id; });
    if (found == places.end() || (*owned)[*found] != whole.ids[k]) continue;
    particles_.ids.push_back(whole.ids[k]);
    particles_.volume.push_back(whole.volume[k]);
    particles_.place.push_back(*found);
    particles_.order.push_back(k);
  }
  particles_.ids.shrink_to_fit();
  particles_.volume.shrink_to_fit();
}

std::vector<HistoryColumn> Probe::columns() const {
  std::vector<HistoryColumn> list;
  for (std::size_t const k : own_) {
    HistoryName const& own = info_of(spec_.kind).quantities[k];
    list.push_back({fmt::format("{}.{}", spec_.name, own.name), std::string(own.unit)});
  }
  for (FieldQuantity const& q : quantities_) list.push_back({fmt::format("{}.{}", spec_.name, q.name), q.unit});
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
    out.push_back(known ? reduce(spec_.kind, particles_, component_values(cache, q.field, q.component))
                        : std::numeric_limits<double>::quiet_NaN());
  }
  return out;
}

std::vector<double> Probe::own_values(FieldCache& cache, double time) {
  auto const axis = static_cast<std::size_t>(spec_.axis);
  switch (spec_.kind) {
    case ProbeKind::twist: return {twist(axis, particles_, cache, last_angle_)};
    case ProbeKind::extent: return {extent(axis, particles_, cache)};
    case ProbeKind::error: return {relative_error(spec_, particles_, cache, time)};
    case ProbeKind::stress_intensity: return {intensity(spec_, distance_, particles_, cache)};
    case ProbeKind::spacing: return spacing_values(*measured_, cache);
    case ProbeKind::fragment: return fragment_values(*measured_, cache);
    case ProbeKind::rim: return rim_values(*measured_, cache);
    case ProbeKind::hole: return hole_values(*measured_, cache);
    default: return {};
  }
}

}  // namespace piola
