// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/stability.hpp"
#include <algorithm>
#include <cmath>

namespace piola::nodal {
namespace {

constexpr int first_rounds = 100;  ///< power iterations from a random start
constexpr int later_rounds = 5;    ///< and from the mode of the last measurement
constexpr double interval = 25;    ///< steps between measurements
/// Or this change of a strain, but not within fewer steps unless it is much.
constexpr double change = 0.1, fewest = 4, much = 0.3;
/// Iterations come from below: this much is added.
constexpr double lift = 1.03;
/// Random part that every measurement adds to its start, so that a mode that has grown elsewhere is found.
constexpr double fresh = 0.05;
/// Shares of the limit that are stable: in vibration and steady motion, and where strains change by 0.1 within few
/// steps, as in impacts: the frequency then rises between measurements.
constexpr double calm_share = 0.85, brisk_share = 0.75, violent_share = 0.45;
constexpr double brisk_pace = 20, violent_pace = 8;
/// Energy differs from what Verlet steps keep, exactly in vibrations, by dt^2/8 sum m a^2. Steps are shortened where
/// that would be more than this share of it, but not below the least share of the limit. At the start accelerations are
/// not yet what they will be.
constexpr double wobble = 3e-4, least_share = 0.25, first_share = 0.35;
/// Where a cell is crushed the steps that had to be halved say more than the last measurement: each makes the next ones
/// shorter, down to a share, and steps that went well make them longer again.
constexpr double halved = 0.6, least_caution = 0.2, recovery = 1.004;

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

/// sum m a^2 of what moves freely.
double StabilityMonitor::square_of_accelerations() const {
  auto const& state = body_.state();
  int const D = state.dimension;
  double sum = 0;
  for (Index i = 0; i < body_.particles(); ++i)
    for (int c = 0; c < D; ++c) sum += body_.mass(i) * value_at(state.a, i, c) * value_at(state.a, i, c);
  for (Index n = 0; n < state.held_count; ++n) {
    HeldDirection const& h = state.held[n];
    double along = 0;
    for (int c = 0; c < D; ++c) along += value_at(state.a, h.slot, c) * h.direction[c];
    sum -= h.mass * along * along;
  }
  return sum;
}

void StabilityMonitor::measure(int rounds) {
  machine_.keep(body_.state());
  machine_.observe(body_.state());
  double const energy = body_.kinetic_energy() + body_.strain_energy();
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
  double const square = square_of_accelerations();
  accurate_ = square > 0 ? std::sqrt(8 * wobble * energy / square) : 0;
}

void StabilityMonitor::update(int halvings) {
  if (body_.options().cfl > 0) return;
  ++steps_;
  caution_ = halvings > 0 ? std::max(least_caution, halved * caution_) : std::min(1.0, recovery * caution_);
  double const moved = machine_.largest_change(body_.state());
  if (steps_ < interval && moved < (steps_ < fewest ? much : change)) return;
  pace_ = steps_;
  measure(later_rounds);
}

double StabilityMonitor::frequency() const { return lift * std::max(frequency_, start_); }

double StabilityMonitor::step() const {
  if (body_.options().cfl > 0) return body_.options().cfl * body_.state().constants.unit_step;
  double const share = pace_ == 0              ? first_share
                       : pace_ >= brisk_pace   ? calm_share
                       : pace_ >= violent_pace ? brisk_share
                                               : violent_share;
  // Viscous forces of the step before take from the limit: sqrt(1 + xi^2) - xi with their share xi of critical damping.
  auto const& s = body_.state();
  double const xi = 0.5 * frequency() * s.viscosity.fluctuation / (s.constants.kappa_local + 4 * s.constants.mu / 3);
  double const limit = (std::sqrt(1 + xi * xi) - xi) * 2 / frequency(), stable = caution_ * share * limit;
  return accurate_ > 0 ? std::min(stable, std::max(accurate_, least_share * caution_ * limit)) : stable;
}

std::vector<double> StabilityMonitor::state() const {
  std::vector<double> s{frequency_, start_, steps_, pace_, caution_, accurate_};
  s.insert(s.end(), mode_.begin(), mode_.end());
  return s;
}

void StabilityMonitor::restore(std::vector<double> const& state) {
  frequency_ = state[0];
  start_ = state[1];
  steps_ = state[2];
  pace_ = state[3];
  caution_ = state[4];
  accurate_ = state[5];
  std::copy(state.begin() + 6, state.end(), mode_.begin());
}

}  // namespace piola::nodal
