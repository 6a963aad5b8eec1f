// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/stability.hpp"
#include "piola/materials/laws.hpp"
#include "piola/mechanics/modes.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace piola::jst_sph {
namespace {

constexpr int first_rounds = 40;  ///< power iterations from a random start
constexpr int later_rounds = 3;   ///< and from the mode of the last measurement
constexpr int interval = 50;      ///< steps between measurements: they cost 4 right-hand sides
constexpr int haste = 10;         ///< or these, when the largest wave speed has changed by `change`
constexpr double change = 0.2;
/// A measured frequency counts at least as this share of the one that follows from the wave speed: it may be out of
/// date within a few steps of a violent deformation.
constexpr double trust = 0.65;

/// Values of the fields that a trial step writes, to be put back.
class Kept {
 public:
  Kept(BodyState const& state, int D) : slots_(state.slots.last) {
    for (auto const& [field, components] : {std::pair{state.x, D},
                                            {state.v, D},
                                            {state.rate, D},
                                            {state.F, D * D},
                                            {state.wave_speed, 1},
                                            {state.volume_ratio, 1},
                                            {state.filtered_ratio, 1},
                                            {state.filtered_pressure, 1},
                                            {state.filter_input, 1},
                                            {state.hourglass_force, D},
                                            {state.hourglass_stress, D * D}})
      if (field.data != nullptr) parts_.push_back({field, components, values_of(field, components)});
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
    std::vector<double> values(static_cast<std::size_t>(slots_ * components));
    std::size_t k = 0;
    for (Index i = 0; i < slots_; ++i)
      for (int c = 0; c < components; ++c) values[k++] = JstBody::value(field, i, c);
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

/// A linear operator of the body as trial steps see it: displacements to rates of velocity, about F.
class Operator {
 public:
  /// `trial` shares its fields with the body; `F` per slot, and x, which hourglass forces see.
  Operator(JstBody& body, BodyState const& trial, Machine const& machine, std::vector<double> F,
           std::vector<double> x = {})
      : body_(body), trial_(trial), machine_(machine), D_(trial.dimension), F_(std::move(F)), x_(std::move(x)) {
    rest_.resize(static_cast<std::size_t>(body.particles()) * D_);
    rest_ = rates_at(rest_);
  }

  /// Viscous forces act this many times as much.
  void multiply_damping(double factor) {
    auto& k = trial_.constants;
    auto const& own = body_.state().constants;
    k.eps4 = factor * own.eps4;
    k.hourglass.ahead = factor * own.hourglass.ahead;
    k.hourglass.bulk_ahead = factor * own.hourglass.bulk_ahead;
  }

  /// |K u| / |u| of the last of some power iterations, which leave the dominant mode in u.
  double dominant(std::vector<double>& u, int rounds) {
    double const size = 1e-6 * trial_.constants.h_min;  // small against what changes the tangent, large to round-off
    double ratio = 0;
    for (int round = 0; round < rounds; ++round) {
      double const most = largest_of(u);
      if (!(most > 0) || !std::isfinite(most)) return 0;
      for (double& value : u) value *= size / most;
      double const before = square(u);
      u = rates_at(u);
      ratio = std::sqrt(square(u) / before);
    }
    return ratio;
  }

 private:
  std::size_t at(Index i, int c) const { return static_cast<std::size_t>(i) * D_ + c; }
  double square(std::vector<double> const& u) const {
    double sum = 0;
    for (Index i = 0; i < body_.particles(); ++i)
      for (int c = 0; c < D_; ++c) {
        double const value = u[at(i, c)];
        sum += body_.volume(i) * value * value;
      }
    return sum;
  }
  /// Rates after the displacement u of the kept F, minus those without.
  std::vector<double> rates_at(std::vector<double> const& u) {
    for (Index i = 0; i < body_.particles(); ++i)
      for (int c = 0; c < D_; ++c) {
        JstBody::set(trial_.v, i, c, u[at(i, c)]);
        JstBody::set(trial_.rate, i, c, 0);
        if (!x_.empty()) JstBody::set(trial_.x, i, c, x_[at(i, c)]);
        for (int d = 0; d < D_; ++d) JstBody::set(trial_.F, i, c * D_ + d, F_[at(i, c) * D_ + d]);
      }
    machine_.step(trial_, 1.0);
    std::vector<double> rates(u.size());
    for (Index i = 0; i < body_.particles(); ++i)
      for (int c = 0; c < D_; ++c) {
        auto const k = at(i, c);
        rates[k] = JstBody::value(trial_.rate, i, c) - rest_[k];
      }
    return rates;
  }

  JstBody& body_;
  BodyState trial_;
  Machine const& machine_;
  int D_;
  std::vector<double> F_, x_, rest_;
};

/// Values of a field, particle by particle in slot order.
std::vector<double> current(JstBody const& body, FieldRef const& field, int components) {
  std::vector<double> values;
  for (Index i = 0; i < body.particles(); ++i)
    for (int c = 0; c < components; ++c) values.push_back(value_at(field, i, c));
  return values;
}

std::vector<double> places(JstBody const& body) {
  int const D = body.state().dimension;
  std::vector<double> X;
  for (Index i = 0; i < body.particles(); ++i)
    for (int c = 0; c < D; ++c) X.push_back(body.X(i)[static_cast<std::size_t>(c)]);
  return X;
}

std::vector<double> identities(JstBody const& body) {
  int const D = body.state().dimension;
  std::vector<double> F;
  for (Index i = 0; i < body.particles(); ++i)
    for (int c = 0; c < D * D; ++c) F.push_back(c % (D + 1) == 0 ? 1 : 0);
  return F;
}

/// A copy of the state for trial steps: forces alone, no supports, no books.
BodyState trial_of(JstBody& body, FailureSlot& failure) {
  BodyState trial = body.state();
  trial.failure = &failure;
  trial.held_count = trial.loaded_count = 0;
  trial.multipliers = nullptr;
  trial.trial = true;
  trial.constants.project = false;
  trial.constants.variables = Variables::pF;
  return trial;
}

/// Rate of the stabilisation per wave speed [1/m]: largest eigenvalue of eps4 h^3 L* L + eps2 h L.
double damping_per_speed(JstBody& body, Machine const& machine) {
  auto const& k = body.state().constants;
  if (k.biharmonic == Biharmonic::none) return 0;
  FailureSlot failure;
  BodyState trial = trial_of(body, failure);
  constexpr double almost_no_stress = 1e-12;
  trial.constants.eps2 = 0;
  trial.constants.eps4 = 1;
  trial.constants.exact_speed = false;
  // A law so soft that its forces vanish beside the stabilisation.
  trial.material.law = find_law(LinearElastic::name)->index;
  trial.material.value[0] = k.rho0;
  trial.material.value[1] = almost_no_stress * k.rho0 * k.c_p0 * k.c_p0;
  trial.material.value[2] = 0;
  trial.constants.kappa_filtered = 0;
  trial.constants.c_p0 = 1;
  Operator L_star_L(body, trial, machine, identities(body));
  std::vector<double> mode(static_cast<std::size_t>(body.particles() * trial.dimension));
  for (std::size_t i = 0; i < mode.size(); ++i) mode[i] = pseudo_random(i);
  double const sigma2 = L_star_L.dominant(mode, first_rounds) * k.h_min;  // times h^4
  return (k.eps4 * sigma2 + k.eps2 * std::sqrt(sigma2)) / k.h_min;
}

}  // namespace

double largest_step(double frequency, double damping) {
  double const w2 = frequency * frequency;
  if (!(w2 > 0)) return damping > 0 ? 2 / damping : std::numeric_limits<double>::infinity();
  return (-damping + std::sqrt(damping * damping + 4 * w2)) / w2;
}

double largest_step(double eigenvalue) { return largest_step(std::sqrt(eigenvalue), 0); }

StabilityMonitor::StabilityMonitor(JstBody& body, Machine const& machine) : body_(body), machine_(machine) {
  Kept const kept(body.state(), body.state().dimension);
  mode_.resize(static_cast<std::size_t>(body.particles()) * body.state().dimension);
  if (body.options().hourglass()) {
    measure_at_rest();
    kept.restore();
    measure_all_forces(first_rounds, machine.largest_wave_speed(body.state()));
    return;
  }
  damping_ = damping_per_speed(body, machine);
  kept.restore();
  measure(first_rounds, machine.largest_wave_speed(body.state()));
  frequency_per_speed_ = frequency_ / wave_speed_;
}

/// The limit of the undeformed body. The eigenvalue depends on the step in it, which a few measurements find.
void StabilityMonitor::measure_at_rest() {
  constexpr int repeats = 5;
  auto const& k = body_.state().constants;
  FailureSlot failure;
  BodyState trial = trial_of(body_, failure);
  trial.constants.exact_speed = false;  // the speed is that of the state, which this is not
  refresh_mode(mode_);
  Operator forces(body_, trial, machine_, identities(body_), places(body_));
  limit_at_rest_ = k.h_min / k.c_p0;
  speed_at_rest_ = k.c_p0;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    forces.multiply_damping(2 / limit_at_rest_);
    limit_at_rest_ = largest_step(forces.dominant(mode_, first_rounds / repeats));
  }
  limit_ = limit_at_rest_;
}

/// About the state as it is, with the step of the last measurement.
void StabilityMonitor::measure_all_forces(int rounds, double wave_speed) {
  BodyState& state = body_.state();
  int const D = state.dimension;
  Kept const kept(state, D);
  FailureSlot failure;
  refresh_mode(mode_);
  Operator tangent(body_, trial_of(body_, failure), machine_, current(body_, state.F, D * D),
                   current(body_, state.x, D));
  tangent.multiply_damping(2 / limit_);
  limit_ = largest_step(tangent.dominant(mode_, rounds));
  kept.restore();
  wave_speed_ = wave_speed;
  steps_ = 0;
}

void StabilityMonitor::measure(int rounds, double wave_speed) {
  if (body_.options().hourglass()) return measure_all_forces(rounds, wave_speed);
  BodyState& state = body_.state();
  int const D = state.dimension;
  Kept const kept(state, D);
  wave_speed_ = wave_speed;
  refresh_mode(mode_);
  FailureSlot failure;
  BodyState trial = trial_of(body_, failure);
  trial.constants.eps2 = trial.constants.eps4 = 0;
  Operator tangent(body_, trial, machine_, current(body_, state.F, D * D));
  frequency_ = std::sqrt(tangent.dominant(mode_, rounds));
  kept.restore();
  steps_ = 0;
}

void StabilityMonitor::update(double wave_speed) {
  ++steps_;
  bool const changed = std::abs(wave_speed / wave_speed_ - 1) > change;
  if (steps_ >= interval || (changed && steps_ >= haste)) measure(later_rounds, wave_speed);
}

double StabilityMonitor::step(double wave_speed) const {
  if (body_.options().hourglass())
    return std::min(limit_ / std::max(1.0, wave_speed / wave_speed_),
                    limit_at_rest_ / std::max(1.0, trust * wave_speed / speed_at_rest_));
  // A wave speed that has fallen says nothing: the largest one may have been elsewhere than the fastest mode.
  double const measured = frequency_ * std::max(1.0, wave_speed / wave_speed_);
  return largest_step(std::max(measured, trust * frequency_per_speed_ * wave_speed), damping_ * wave_speed);
}

std::vector<double> StabilityMonitor::state() const {
  std::vector<double> s{body_.options().hourglass() ? limit_ : frequency_, wave_speed_, steps_};
  s.insert(s.end(), mode_.begin(), mode_.end());
  return s;
}

void StabilityMonitor::restore(std::vector<double> const& state) {
  (body_.options().hourglass() ? limit_ : frequency_) = state[0];
  wave_speed_ = state[1];
  steps_ = state[2];
  std::copy(state.begin() + 3, state.end(), mode_.begin());
}

}  // namespace piola::jst_sph
