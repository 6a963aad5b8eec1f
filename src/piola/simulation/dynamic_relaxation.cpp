// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/dynamic_relaxation.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/exec/reproducible_sum.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>
#include <utility>

namespace piola {
namespace {

/// A time to a peak is dropped after this multiple of itself: the first swing, of a load that grows or of a body that
/// falls, need not be a vibration.
constexpr double remembered = 20;
/// Largest remaining fraction of the displacement at rest.
constexpr double most_left = 0.01;
/// Steps over which stops are counted.
constexpr double window_steps = 1000;
/// From rest to a peak after one step and back to it.
constexpr double steps_of_short_stop = 3;

}  // namespace

Relaxation::Relaxation(RunSpec const& run, ParticleSet const& particles, double mass)
    : rate_(run.damping),
      relax_(run.relax),
      minimises_(run.minimises()),
      limit_(run.relax_tolerance),
      particles_(particles),
      mass_(mass) {
  PIOLA_EXPECTS(mass >= 0 && run.damping >= 0);
}

void Relaxation::start(Formulation& formulation) const {
  if (relax_) formulation.damp(0);
}

bool Relaxation::after_step(Formulation& formulation, double dt) {
  PIOLA_EXPECTS(dt > 0);
  if (rate_ > 0) formulation.damp(std::exp(-rate_ * dt));
  if (!relax_) return false;
  removed_.end_step();
  if (++swing_.window > window_steps) {
    rest_.short_stops = std::lround(swing_.in_window);
    swing_.window = swing_.in_window = 0;
  }
  if (swing_.backwards > 0) {
    stop(formulation);
    return false;
  }
  double const before = kinetic_;
  kinetic_ = formulation.kinetic_energy();
  if (from_rest_) {
    from_rest_ = false;
    if (is_at_rest(formulation, std::sqrt(2 * kinetic_) / dt)) stop(formulation);
  } else if (kinetic_ < before) {
    formulation.damp(-1);
    swing_.backwards = 1;
    removed_.add(before);
    return false;
  }
  swing_.time += dt;
  swing_.steps += 1;
  return rest_.reached;
}

bool Relaxation::descend(Formulation& formulation, double time, double dt) {
  PIOLA_EXPECTS(minimises_ && dt > 0);
  Descent const descent = formulation.descend(time, dt);
  removed_.add(descent.released);
  removed_.end_step();
  if (descent.released > 0) ++rest_.stops;
  return is_at_rest(formulation, descent.unbalanced);
}

/// Before the first stop the bodies may be about to be loaded. A swing between two small residuals shows the slow
/// motion that was hidden behind a fast one.
bool Relaxation::is_at_rest(Formulation const& formulation, double unbalanced) {
  largest_ = std::max(largest_, unbalanced);
  rest_.residual = largest_ > 0 ? unbalanced / largest_ : 0;
  bool const before = std::exchange(swing_.calm, rest_.residual <= limit_ ? 1.0 : 0.0) > 0;
  if (rest_.stops == 0 || rest_.residual > limit_ || (!before && unbalanced > 0)) return false;
  double const quarter = 2 * swing_.slowest / std::numbers::pi;
  double const missing = unbalanced * quarter * quarter / std::sqrt(mass_);
  rest_.left = removed_.left();
  if (missing > 0) rest_.left = std::max(rest_.left, missing / displacement(formulation));
  rest_.reached = rest_.left <= most_left;
  return rest_.reached;
}

/// Root mean square over all particles, at least the rounding error for a body of this size [m].
double Relaxation::displacement(Formulation const& formulation) const {
  auto const fields = formulation.observables().fields();
  if (std::ranges::find(fields, "Displacement", &FieldInfo::name) == fields.end())
    return std::numeric_limits<double>::infinity();
  constexpr double rounding = 1e-9;
  auto const& X = particles_.X;
  FieldCache own(formulation, particles_, FieldCache::Of::local);
  std::span<double const> const u = own.values("Displacement");
  exec::ReproducibleSums<3> sums;
  for (std::size_t k = 0; k < u.size() / 3; ++k) {
    auto const i = own.local_particles() ? static_cast<std::size_t>((*own.local_particles())[k]) : k;
    double of_one[]{particles_.volume[i], 0, 0};
    for (std::size_t c = 0; c < 3; ++c) {
      of_one[1] += particles_.volume[i] * u[3 * k + c] * u[3 * k + c];
      of_one[2] += particles_.volume[i] * (X[i][c] - X[0][c]) * (X[i][c] - X[0][c]);
    }
    sums.add(of_one);
  }
  comm::allreduce_sum(sums);
  return std::sqrt(std::max(sums.value(1), rounding * rounding * sums.value(2)) / sums.value(0));
}

void Relaxation::stop(Formulation& formulation) {
  formulation.damp(0);
  ++rest_.stops;
  if (swing_.steps == 1) ++swing_.in_window;
  swing_.slowest = std::max(swing_.time, swing_.slowest - swing_.time / remembered);
  swing_.time = swing_.steps = swing_.backwards = 0;
  from_rest_ = true;
  kinetic_ = 0;
}

std::string Relaxation::text() const {
  std::string text = fmt::format("forces out of balance are {:.2g} of the largest (run.relax_tolerance is {})",
                                 rest_.residual, limit_);
  if (rest_.left > 0)
    text +=
        fmt::format(", what is left of the displacement is about {:.2g} of it (allowed: {})", rest_.left, most_left);
  return text;
}

std::string Relaxation::slow_text() const {
  if (2 * steps_of_short_stop * static_cast<double>(rest_.short_stops) <= window_steps) return "";
  return fmt::format(
      "relax: {} of the last 1000 steps were stops, one step after the stop before - slow motion hardly gets on so: "
      "try "
      "a smaller run.cfl, or run.damping instead",
      rest_.short_stops);
}

StopRequest Relaxation::objection_at_end() const {
  StopRequest o;
  o.failure.what = "relaxation is not at rest at run.end";
  o.failure.values = {{"forces out of balance, of the largest", rest_.residual},
                      {"allowed by run.relax_tolerance", limit_},
                      {"stops", static_cast<double>(rest_.stops)}};
  if (rest_.left > 0)
    o.failure.values.insert(o.failure.values.end(),
                            {{"displacement that is left, of the one reached", rest_.left}, {"allowed", most_left}});
  o.causes =
      "give the run more time ('piola resume' goes on with a later run.end), and check that supports hold every body";
  return o;
}

void Relaxation::save(StateWriter& writer) const {
  writer.put("relaxation", std::array{rest_.reached ? 1.0 : 0.0, rest_.residual, static_cast<double>(rest_.stops),
                                      from_rest_ ? 1.0 : 0.0, kinetic_, largest_});
  writer.put("relaxation_energy", removed_.state());
  writer.put("relaxation_swing",
             std::array{swing_.time, swing_.steps, swing_.slowest, swing_.backwards, swing_.window, swing_.in_window,
                        swing_.calm, rest_.left, static_cast<double>(rest_.short_stops)});
}

void Relaxation::load(NamedState& reader, TimeState const&) {
  std::array<double, 6> v{};
  reader.get("relaxation", v);
  rest_ = {.reached = v[0] != 0, .residual = v[1], .stops = std::lround(v[2])};
  from_rest_ = v[3] != 0;
  kinetic_ = v[4];
  largest_ = v[5];
  if (!reader.has("relaxation_energy")) return;  // checkpoints of older versions have none
  std::vector<double> energy(RemovedEnergy::state_size());
  reader.get("relaxation_energy", energy);
  removed_.load(energy);
  std::array<double, 9> w{};
  reader.get("relaxation_swing", w);
  swing_ = {w[0], w[1], w[2], w[3], w[4], w[5], w[6]};
  rest_.left = w[7];
  rest_.short_stops = std::lround(w[8]);
}

}  // namespace piola
