// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/stability.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/formulations/common/distributed_mode.hpp"
#include "piola/materials/laws.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

namespace piola::jst_sph {
namespace {

constexpr int later_rounds = 3;  ///< power iterations from the mode of the last measurement
constexpr int interval = 50;     ///< steps between measurements: they cost 4 right-hand sides
constexpr int haste = 10;        ///< or these, when the largest wave speed has changed by `change`
constexpr double change = 0.2;
/// A measured frequency counts at least as this fraction of the one from the wave speed: it may be out of date within a
/// few steps of a violent deformation.
constexpr double trust = 0.65;

/// Values of the fields that a trial step writes, to be put back.
class Kept {
 public:
  /// Saves local slots only: ghosts written by trial steps are updated before they are read.
  explicit Kept(JstBody const& body) : slots_(body.state().slots) {
    auto const keep = [&](FieldRef const& field, int components) {
      if (field.data != nullptr) parts_.push_back({field, components, values_of(field, components)});
    };
    body.each_evolved([&](std::string_view, FieldRef const& field, int components) { keep(field, components); });
    keep(body.state().volume_ratio, 1);
  }
  void restore() const {
    for (auto const& part : parts_) put(part.field, part.components, part.values);
  }
  /// The saved values of a field, from the first local slot on.
  double const* values_of(FieldRef const& field) const {
    auto const found =
        std::find_if(parts_.begin(), parts_.end(), [&](Part const& part) { return part.field.data == field.data; });
    return found->values.data();
  }

 private:
  struct Part {
    FieldRef field;
    int components;
    std::vector<double> values;
  };
  std::vector<double> values_of(FieldRef const& field, int components) const {
    std::vector<double> values(static_cast<std::size_t>(slots_.last - slots_.first) *
                               static_cast<std::size_t>(components));
    exec_host::parallel_for(slots_.last - slots_.first, [&](Index k) {
      double* const to = &values[static_cast<std::size_t>(k) * static_cast<std::size_t>(components)];
      for (int c = 0; c < components; ++c) to[c] = JstBody::value(field, slots_.first + k, c);
    });
    return values;
  }
  void put(FieldRef const& field, int components, std::vector<double> const& values) const {
    exec_host::parallel_for(slots_.last - slots_.first, [&](Index k) {
      double const* const from = &values[static_cast<std::size_t>(k) * static_cast<std::size_t>(components)];
      for (int c = 0; c < components; ++c) JstBody::set(field, slots_.first + k, c, from[c]);
    });
  }
  Range slots_;
  std::vector<Part> parts_;
};

/// A linear operator of the body as trial steps see it: displacements to rates of velocity, about a state.
class Operator {
 public:
  /// `trial` shares its fields with the body. `about`: the state that the operator is about; null: the undeformed body.
  Operator(JstBody& body, BodyState const& trial, Backend const& backend, Kept const* about)
      : body_(body), trial_(trial), backend_(backend), D_(trial.dimension) {
    if (about != nullptr) F_ = about->values_of(trial_.F);
    rest_.resize(size_of_mode(body));
    rates_at(rest_, {});
  }

  /// |K u| / |u| of the last of some power iterations, which leave the dominant mode in u, of the particles of this
  /// rank.
  double dominant(std::vector<double>& u, int rounds) {
    double const size = 1e-6 * trial_.constants.h_min;  // small relative to changes of the tangent, large relative to
                                                        // round-off
    Squares squares;
    for (int round = 0; round < rounds; ++round) {
      double const most = global_max_norm(body_, u);
      if (!(most > 0) || !std::isfinite(most)) return 0;
      each_particle([&](Index i) {
        for (int c = 0; c < D_; ++c) u[at(i, c)] *= size / most;
      });
      bool const last = round == rounds - 1;
      if (last) squares.before = square(u);
      rates_at(u, rest_);
      if (last) squares.after = square(u);
    }
    if (body_.shared()) comm::allreduce_sum(squares);
    return std::sqrt(squares.after.value() / squares.before.value());
  }

 private:
  /// Index in displacements, modes and saved fields.
  std::size_t at(Index i, int c) const { return mode_place(body_, i, c); }
  template <class F>
  void each_particle(F const& f) const {
    exec_host::parallel_for(body_.own(), f);
  }
  struct Squares {
    exec::ReproducibleSums<1> before, after;
    void add(Squares const& other) {
      before.add(other.before);
      after.add(other.after);
    }
  };
  /// Over the local particles.
  exec::ReproducibleSums<1> square(std::vector<double> const& u) const {
    Range const own = body_.own();
    return exec_host::parallel_sums<1>(own.last - own.first, [&](Index k, double* x) {
      Index const i = own.first + k;
      double sum = 0;
      for (int c = 0; c < D_; ++c) sum += u[at(i, c)] * u[at(i, c)];
      *x = body_.volume(i) * sum;
    });
  }
  /// Makes of the displacement u its rates, minus those without displacement if there are any to take away.
  void rates_at(std::vector<double>& u, std::vector<double> const& rest) {
    each_particle([&](Index i) {
      for (int c = 0; c < D_; ++c) {
        auto const k = at(i, c);
        JstBody::set(trial_.v, i, c, u[k]);
        JstBody::set(trial_.rate, i, c, 0);
        for (int d = 0; d < D_; ++d)
          JstBody::set(trial_.F, i, c * D_ + d,
                       F_ != nullptr ? F_[k * static_cast<std::size_t>(D_) + static_cast<std::size_t>(d)]
                       : c == d      ? 1.0
                                     : 0.0);
      }
    });
    backend_.step(trial_, 1.0);
    each_particle([&](Index i) {
      for (int c = 0; c < D_; ++c) {
        auto const k = at(i, c);
        u[k] = JstBody::value(trial_.rate, i, c) - (rest.empty() ? 0 : rest[k]);
      }
    });
  }

  JstBody& body_;
  BodyState trial_;
  Backend const& backend_;
  int D_;
  double const* F_ = nullptr;
  std::vector<double> rest_;
};

/// A copy of the state for trial steps: forces alone, no supports, no energy balance. A step of 1 s with displacements
/// as velocities: a force that depends on the rate of F would count as stiffness.
BodyState trial_of(JstBody& body, FailureSlot& failure) {
  BodyState trial = body.state();
  trial.failure = &failure;
  trial.boundary.held_count = trial.boundary.loaded_count = 0;
  trial.boundary.multipliers = nullptr;
  trial.trial = true;
  trial.constants.project = false;
  return trial;
}

/// Rate of the stabilisation per wave speed [1/m]: largest eigenvalue of eps4 h^3 L* L + eps2 h L.
double damping_per_speed(JstBody& body, Backend const& backend) {
  auto const& k = body.state().constants;
  if (k.eps2 == 0 && k.eps4 == 0) return 0;
  Kept const kept(body);
  FailureSlot failure;
  BodyState trial = trial_of(body, failure);
  constexpr double almost_no_stress = 1e-12;
  trial.constants.eps2 = 0;
  trial.constants.eps4 = 1;
  trial.constants.exact_speed = false;
  // A law so soft that its forces vanish relative to the stabilisation.
  trial.material.law = find_law(LinearElastic::name)->index;
  trial.material.value[0] = k.rho0;
  trial.material.value[1] = almost_no_stress * k.rho0 * k.c_p0 * k.c_p0;
  trial.material.value[2] = 0;
  trial.constants.kappa_filtered = 0;
  trial.constants.c_p0 = 1;
  Operator L_star_L(body, trial, backend, nullptr);
  std::vector<double> mode(size_of_mode(body));
  each_of_mode(body, mode, [](double& value, std::uint64_t number) { value = pseudo_random(number); });
  double const sigma2 = L_star_L.dominant(mode, StabilityMonitor::first_rounds) * k.h_min;  // times h^4
  kept.restore();
  return (k.eps4 * sigma2 + k.eps2 * std::sqrt(sigma2)) / k.h_min;
}

}  // namespace

double largest_step(double frequency, double damping) {
  double const w2 = frequency * frequency;
  if (!(w2 > 0)) return damping > 0 ? 2 / damping : std::numeric_limits<double>::infinity();
  return (-damping + std::sqrt(damping * damping + 4 * w2)) / w2;
}

StabilityMonitor::StabilityMonitor(JstBody& body, Backend const& backend) : body_(body), backend_(backend) {
  mode_.resize(size_of_mode(body));
  damping_ = damping_per_speed(body, backend);
  measure(first_rounds, backend.largest_wave_speed(body.state()));
  frequency_per_speed_ = frequency_ / wave_speed_;
}

void StabilityMonitor::measure(int rounds, double wave_speed) {
  Kept const kept(body_);
  wave_speed_ = wave_speed;
  refresh_mode(body_, mode_);
  FailureSlot failure;
  BodyState trial = trial_of(body_, failure);
  trial.constants.eps2 = trial.constants.eps4 = 0;
  Operator tangent(body_, trial, backend_, &kept);
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
  // A lower wave speed does not lower the frequency: the largest one may have been elsewhere than the fastest mode.
  double const measured = frequency_ * std::max(1.0, wave_speed / wave_speed_);
  return largest_step(std::max(measured, trust * frequency_per_speed_ * wave_speed), damping_ * wave_speed);
}

std::vector<double> StabilityMonitor::state() const {
  std::vector<double> s{frequency_, wave_speed_, steps_};
  return with_mode(body_, std::move(s), mode_);
}

void StabilityMonitor::restore(std::vector<double> const& state) {
  auto const numbers = without_mode(body_, 3, state, mode_);
  frequency_ = numbers[0];
  wave_speed_ = numbers[1];
  steps_ = numbers[2];
}

}  // namespace piola::jst_sph
