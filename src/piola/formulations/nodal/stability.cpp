// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/stability.hpp"
#include <algorithm>
#include <cmath>

namespace piola::nodal {
namespace {

constexpr int first_rounds = 100;  ///< power iterations from a random start
constexpr int later_rounds = 5;    ///< and from the mode of the last measurement
constexpr double interval = 25;    ///< steps between measurements
constexpr double change = 0.1;     ///< or this change of a strain
/// Iterations come from below: this much is added.
constexpr double lift = 1.03;
/// Random part that every measurement adds to its start, so that a mode that has grown elsewhere is found.
constexpr double fresh = 0.05;
/// Shares of the limit that are stable: in vibration and steady motion, and where strains change by 0.1 within few
/// steps, as in impacts: the frequency then rises between measurements.
constexpr double calm_share = 0.85, brisk_share = 0.75, violent_share = 0.6;
constexpr double brisk_pace = 20, violent_pace = 8;

/// Same numbers on every machine, without a pattern that a mode could be orthogonal to.
double pseudo_random(std::uint64_t k) {
  k = (k + 0x9e3779b97f4a7c15ULL) * 0xbf58476d1ce4e5b9ULL;
  k = (k ^ (k >> 29)) * 0x94d049bb133111ebULL;
  return static_cast<double>((k ^ (k >> 32)) & 0xffffff) / 0x1000000 - 0.5;
}

double largest(std::vector<double> const& u) {
  double most = 0;
  for (double const value : u) most = std::max(most, std::abs(value));
  return most;
}

}  // namespace

StabilityMonitor::StabilityMonitor(NodalBody& body, Machine const& machine) : body_(body), machine_(machine) {
  if (body.options().cfl > 0) return;
  mode_.resize(static_cast<std::size_t>(body.particles() * body.state().dimension));
  measure(first_rounds);
  start_ = frequency_;
}

std::vector<double> StabilityMonitor::positions() const {
  int const D = body_.state().dimension;
  std::vector<double> x(mode_.size());
  for (std::size_t k = 0; k < x.size(); ++k)
    x[k] = value_at(body_.state().x, static_cast<Index>(k) / D, static_cast<int>(k) % D);
  return x;
}

void StabilityMonitor::put_positions(std::vector<double> const& x) {
  int const D = body_.state().dimension;
  for (std::size_t k = 0; k < x.size(); ++k)
    value_at(body_.state().x, static_cast<Index>(k) / D, static_cast<int>(k) % D) = x[k];
}

/// Of the internal forces at the positions that the body has now.
std::vector<double> StabilityMonitor::accelerations() {
  int const D = body_.state().dimension;
  FailureSlot failure;
  BodyState trial = body_.state();
  trial.failure = &failure;
  machine_.accelerate(trial);
  std::vector<double> a(mode_.size());
  for (std::size_t k = 0; k < a.size(); ++k)
    a[k] = value_at(trial.a, static_cast<Index>(k) / D, static_cast<int>(k) % D);
  return a;
}

/// Square root of sum m u.u
double StabilityMonitor::size_of(std::vector<double> const& u) const {
  int const D = body_.state().dimension;
  double sum = 0;
  for (std::size_t k = 0; k < u.size(); ++k) sum += body_.mass(static_cast<Index>(k) / D) * u[k] * u[k];
  return std::sqrt(sum);
}

void StabilityMonitor::measure(int rounds) {
  machine_.keep(body_.state());
  machine_.observe(body_.state());
  body_.mark_measured();
  double const most = largest(mode_);
  for (std::size_t k = 0; k < mode_.size(); ++k)
    mode_[k] = most > 0 ? mode_[k] / most + fresh * pseudo_random(k) : pseudo_random(k);
  auto const x = positions();
  auto const rest = accelerations();
  auto const spacing = body_.body().spacing;
  // Small against what changes the tangent, large against round-off.
  double const size = 1e-6 * *std::min_element(spacing.begin(), spacing.begin() + body_.state().dimension);
  for (int round = 0; round < rounds; ++round) {
    double const scale = size / largest(mode_);
    auto moved = x;
    for (std::size_t k = 0; k < mode_.size(); ++k) moved[k] += mode_[k] *= scale;
    put_positions(moved);
    double const before = size_of(mode_);
    mode_ = accelerations();
    for (std::size_t k = 0; k < mode_.size(); ++k) mode_[k] -= rest[k];
    double const ratio = size_of(mode_) / before;
    if (!(ratio > 0) || !std::isfinite(ratio)) break;
    frequency_ = std::sqrt(ratio);
  }
  machine_.restore(body_.state());
  steps_ = 0;
}

void StabilityMonitor::update() {
  if (body_.options().cfl > 0) return;
  ++steps_;
  if (steps_ < interval && machine_.largest_change(body_.state()) < change) return;
  pace_ = steps_;
  measure(later_rounds);
}

double StabilityMonitor::frequency() const { return lift * std::max(frequency_, start_); }

double StabilityMonitor::step() const {
  if (body_.options().cfl > 0) return body_.options().cfl * body_.state().constants.unit_step;
  double const share = pace_ == 0 || pace_ >= brisk_pace ? calm_share
                       : pace_ >= violent_pace           ? brisk_share
                                                         : violent_share;
  return share * 2 / frequency();
}

std::vector<double> StabilityMonitor::state() const {
  std::vector<double> s{frequency_, start_, steps_, pace_};
  s.insert(s.end(), mode_.begin(), mode_.end());
  return s;
}

void StabilityMonitor::restore(std::vector<double> const& state) {
  frequency_ = state[0];
  start_ = state[1];
  steps_ = state[2];
  pace_ = state[3];
  std::copy(state.begin() + 4, state.end(), mode_.begin());
}

}  // namespace piola::nodal
