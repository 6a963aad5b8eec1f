// SPDX-License-Identifier: Apache-2.0
#include "piola/measures/field_samples.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/reproducible_sum.hpp"
#include "piola/math/solve.hpp"
#include <algorithm>
#include <cmath>
#include <numeric>

namespace piola {
namespace {

constexpr double reach = 1.8;          // spacings: the nearest and the diagonal ones in each dimension
constexpr double same_place = 1e-6;    // spacings
constexpr double least_pivots = 1e-9;  // below, the particles near do not span the space

double distance(std::array<double, 3> const& a, std::array<double, 3> const& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// The particles of a sample by their x, to find those that are near.
class NearestSamples {
 public:
  explicit NearestSamples(FieldSample const& sample) : sample_(sample), order_(sample.X.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::sort(order_.begin(), order_.end(),
              [&](std::size_t a, std::size_t b) { return sample.X[a][0] < sample.X[b][0]; });
    for (double const s : sample.spacing) largest_ = std::max(largest_, s);
  }
  /// Calls act(id, distance in spacings) for each particle of the body within reach.
  template <class Do>
  void each(std::array<double, 3> const& X, int body, Do const& act) const {
    double const radius = reach * largest_;
    auto const first = std::lower_bound(order_.begin(), order_.end(), X[0] - radius,
                                        [&](std::size_t id, double x) { return sample_.X[id][0] < x; });
    for (auto at = first; at != order_.end() && sample_.X[*at][0] <= X[0] + radius; ++at) {
      double const r = distance(sample_.X[*at], X) / sample_.spacing[*at];
      if (sample_.body[*at] == body && r < reach) act(*at, r);
    }
  }

 private:
  FieldSample const& sample_;
  std::vector<std::size_t> order_;
  double largest_ = 0;
};

/// Weights of the particles near a place with which their values sum up to that of the fitted linear function there.
std::vector<std::pair<std::size_t, double>> weights_at(std::array<double, 3> const& X, int body,
                                                       FieldSample const& reference, NearestSamples const& near) {
  std::vector<std::pair<std::size_t, double>> list;
  std::optional<std::size_t> here;
  near.each(X, body, [&](std::size_t id, double r) {
    if (r < same_place) here = id;
    double const rest = 1 - r * r / (reach * reach);
    list.emplace_back(id, rest * rest);
  });
  if (here) return {{*here, 1.0}};
  // Normal equations of the fit around X, A c = e_0; directions that the dimension lacks get a pivot of their own.
  double A[16] = {}, c[4] = {1, 0, 0, 0};
  auto const row = [&](std::size_t id) {
    auto const& at = reference.X[id];
    double const s = reference.spacing[id];
    return std::array<double, 4>{1, (at[0] - X[0]) / s, (at[1] - X[1]) / s, (at[2] - X[2]) / s};
  };
  for (auto const& [id, weight] : list) {
    auto const p = row(id);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) A[4 * i + j] += weight * p[i] * p[j];
  }
  for (auto i = static_cast<std::size_t>(reference.dimension) + 1; i < 4; ++i) A[5 * i] += 1;
  if (list.empty() || !(solve_in_place<4>(A, c) > least_pivots)) return {};
  for (auto& [id, weight] : list) {
    auto const p = row(id);
    weight *= std::inner_product(p.begin(), p.end(), c, 0.0);
  }
  return list;
}

}  // namespace

FieldSampler::FieldSampler(std::vector<SampleRequest> sample_requests, ParticleSet const& particles)
    : particles_(particles) {
  for (SampleRequest& sample_request : sample_requests)
    pending_.push_back({.sample_request = std::move(sample_request)});
}

void FieldSampler::observe(Formulation const& formulation, TimeState const& moment) {
  constexpr double ahead = 3;  // steps; a step is rarely three times as long as the one before
  auto const soon = [&](Pending const& pending) {
    return moment.step == 0 || moment.time + ahead * moment.dt >= pending.sample_request.time;
  };
  if (std::none_of(pending_.begin(), pending_.end(), soon)) return;
  FieldCache cache(formulation, particles_);
  std::erase_if(pending_, [&](Pending& pending) {
    return soon(pending) && (!cache.knows(pending.sample_request.field) || take(pending, cache, moment));
  });
}

/// Whether the sample is complete.
bool FieldSampler::take(Pending& pending, FieldCache& cache, TimeState const& moment) {
  auto const now = cache.values(pending.sample_request.field);
  bool const early = moment.time < pending.sample_request.time;
  std::vector<double> values(now.begin(), now.end());
  if (!early && !pending.values.empty() && moment.time > pending.before) {
    double const share = (pending.sample_request.time - pending.before) / (moment.time - pending.before);
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = share * values[k] + (1 - share) * pending.values[k];
  }
  pending.before = moment.time;
  pending.values = std::move(values);
  if (early) return false;
  FieldSample sample{.field = pending.sample_request.field,
                     .time = pending.sample_request.time,
                     .dimension = particles_.dimension,
                     .components = static_cast<std::size_t>(cache.info(pending.sample_request.field).components),
                     .values = std::move(pending.values),
                     .X = particles_.X,
                     .volume = particles_.volume,
                     .spacing = {},
                     .body = particles_.body};
  for (double const v : particles_.kernel_volume) sample.spacing.push_back(std::pow(v, 1.0 / particles_.dimension));
  samples_.push_back(std::move(sample));
  return true;
}

std::optional<double> relative_difference(FieldSample const& f, FieldSample const& reference, Expression const* where) {
  PIOLA_EXPECTS(f.values.size() == f.components * f.X.size());
  PIOLA_EXPECTS(f.volume.size() == f.X.size() && f.body.size() == f.X.size());
  if (f.components != reference.components || f.dimension != reference.dimension) return std::nullopt;
  NearestSamples const near(reference);
  std::size_t const width = f.components;
  exec::ReproducibleSums<2> sums;  // of the difference and of the reference
  for (std::size_t id = 0; id < f.X.size(); ++id) {
    if (where != nullptr && (*where)(f.X[id]) == 0) continue;
    auto const weights = weights_at(f.X[id], f.body[id], reference, near);
    if (weights.empty()) return std::nullopt;
    for (std::size_t c = 0; c < width; ++c) {
      double r = 0;
      for (auto const& [other, weight] : weights) r += weight * reference.values[other * width + c];
      double const d = f.values[id * width + c] - r, volume = width == 6 && c >= 3 ? 2 * f.volume[id] : f.volume[id];
      double const of_component[]{volume * d * d, volume * r * r};
      sums.add(of_component);
    }
  }
  double const value = std::sqrt(sums.value(0) / sums.value(1));
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

}  // namespace piola
