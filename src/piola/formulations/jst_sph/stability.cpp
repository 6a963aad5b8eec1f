// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/stability.hpp"
#include "piola/materials/laws.hpp"
#include <algorithm>
#include <cmath>
#include <vector>

namespace piola::jst_sph {
namespace {

constexpr int iterations = 40;

/// Values of the fields that a trial step writes, to be put back.
class Kept {
 public:
  Kept(BodyState const& state, int dimension) : slots_(state.slots.last) {
    for (auto const& [field, components] : {std::pair{state.x, dimension},
                                            {state.v, dimension},
                                            {state.rate, dimension},
                                            {state.F, dimension * dimension},
                                            {state.wave_speed, 1}})
      parts_.push_back({field, components, values_of(field, components)});
  }
  void restore() const {
    for (auto const& part : parts_) put(part.field, part.components, part.values);
  }

 private:
  struct Part {
    FieldRef field;
    int components;
    std::vector<double> values;
  };
  std::vector<double> values_of(FieldRef const& field, int components) const {
    std::vector<double> values;
    for (Index i = 0; i < slots_; ++i)
      for (int c = 0; c < components; ++c) values.push_back(JstBody::value(field, i, c));
    return values;
  }
  void put(FieldRef const& field, int components, std::vector<double> const& values) const {
    std::size_t k = 0;
    for (Index i = 0; i < slots_; ++i)
      for (int c = 0; c < components; ++c) JstBody::set(field, i, c, values[k++]);
  }
  Index slots_;
  std::vector<Part> parts_;
};

/// Same numbers on every machine, without a pattern that a mode could be orthogonal to.
double pseudo_random(std::uint64_t k) {
  k = (k + 0x9e3779b97f4a7c15ULL) * 0xbf58476d1ce4e5b9ULL;
  k = (k ^ (k >> 29)) * 0x94d049bb133111ebULL;
  return static_cast<double>((k ^ (k >> 32)) & 0xffffff) / 0x1000000 - 0.5;
}

/// |K u| / |u| for the dominant u of the linear operator that `state` (a trial copy) puts into its rate.
double dominant_rate(JstBody& body, BodyState trial, Machine const& machine) {
  int const D = trial.dimension;
  Index const n = body.particles();
  std::vector<double> u(static_cast<std::size_t>(n * D));
  for (std::size_t k = 0; k < u.size(); ++k) u[k] = pseudo_random(k);
  double const size = 1e-6 * trial.constants.h_min;  // small: the law is linear, but det F must stay positive
  double rate = 0;
  for (int round = 0; round < iterations; ++round) {
    double most = 0, before = 0, after = 0;
    for (double const value : u) most = std::max(most, std::abs(value));
    if (!(most > 0)) return 0;
    for (Index i = 0; i < n; ++i) {
      auto const X = body.X(i);
      for (int c = 0; c < D; ++c) {
        double& value = u[static_cast<std::size_t>(i * D + c)];
        value *= size / most;
        JstBody::set(trial.v, i, c, value);
        JstBody::set(trial.x, i, c, X[static_cast<std::size_t>(c)]);
        JstBody::set(trial.rate, i, c, 0);
        for (int d = 0; d < D; ++d) JstBody::set(trial.F, i, c * D + d, c == d ? 1 : 0);
        before += body.volume(i) * value * value;
      }
    }
    machine.step(trial, 1.0);
    for (Index i = 0; i < n; ++i)
      for (int c = 0; c < D; ++c) {
        double const value = JstBody::value(trial.rate, i, c);
        u[static_cast<std::size_t>(i * D + c)] = value;
        after += body.volume(i) * value * value;
      }
    rate = std::sqrt(after / before);
  }
  return rate;
}

/// The linear elastic law with the same moduli, times `factor`.
MaterialParameters linearised(MaterialParameters const& material, double factor) {
  MaterialParameters linear;
  linear.law = find_law(LinearElastic::name)->index;
  with_law(material, [&](auto const& law) {
    linear.value[0] = law.rho0;
    linear.value[1] = factor * 9 * law.kappa * law.mu / (3 * law.kappa + law.mu);
    linear.value[2] = (3 * law.kappa - 2 * law.mu) / (2 * (3 * law.kappa + law.mu));
  });
  return linear;
}

}  // namespace

double StabilityLimit::alpha() const {
  double const w2 = frequency * frequency;
  return (-damping + std::sqrt(damping * damping + 4 * w2)) / w2;
}

StabilityLimit stability_limit(JstBody& body, Machine const& machine) {
  BodyState& state = body.state();
  Kept const kept(state, state.dimension);
  FailureSlot failure;
  auto const& k = state.constants;
  StabilityLimit limit;

  BodyState trial = state;
  trial.failure = &failure;
  trial.held_count = trial.loaded_count = 0;
  trial.multipliers = nullptr;
  trial.constants.project = false;
  trial.constants.eps2 = trial.constants.eps4 = 0;
  trial.material = linearised(state.material, 1);
  limit.frequency = std::sqrt(dominant_rate(body, trial, machine)) * k.h_min / k.c_p0;

  if (k.biharmonic != Biharmonic::none) {
    constexpr double almost_no_stress = 1e-9;
    trial.material = linearised(state.material, almost_no_stress);
    trial.constants.kappa_local *= almost_no_stress;
    trial.constants.kappa_filtered *= almost_no_stress;
    trial.constants.eps4 = 1;
    trial.constants.c_p0 = 1;
    double const sigma2 = dominant_rate(body, trial, machine) * k.h_min;  // largest eigenvalue of L* L, times h^4
    limit.damping = k.eps4 * sigma2 + k.eps2 * std::sqrt(sigma2);
  }
  kept.restore();
  return limit;
}

}  // namespace piola::jst_sph
