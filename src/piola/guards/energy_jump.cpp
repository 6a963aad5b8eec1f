// SPDX-License-Identifier: Apache-2.0
#include "piola/guards/energy_jump.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace piola {
namespace {

/// Kinetic energy grows by this factor, or the step falls by it, between two evaluations of all energies. Energies that
/// a load brings to a body at rest then cost about ten evaluations.
constexpr double growth = 4;
/// Steps from one sum of kinetic energy to the next.
constexpr std::int64_t interval = 10;
/// Steps in a row in which a jump must be found where loads do work: energy that is a step ahead of the work of a
/// constant force exceeds it in the first three.
constexpr double steps_in_a_row = 5;
/// How long a jump must last where loads do work, in times of a pressure wave across the finest spacing: a support that
/// is driven at once gives its particles kinetic energy in the first step, and the work of the waves that it sends
/// equals that energy after one such time.
constexpr double lasting_crossings = 2;
/// From here on the end of a run is no onset of a load.
constexpr std::int64_t first_steps = 50;

/// Whether anything but the bodies themselves may bring energy.
bool may_do_work(CaseSpec const& spec) {
  auto const moves = [](RigidSpec const& rigid) {
    return rigid.turns() || std::any_of(rigid.velocity.begin(), rigid.velocity.end(),
                                        [](Expression const& component) { return component.text() != "0"; });
  };
  return !spec.loads.empty() || std::any_of(spec.rigids.begin(), spec.rigids.end(), moves) ||
         has_driven_support(spec) || starts_under_pressure(spec);
}

}  // namespace

EnergyJumpGuard::EnergyJumpGuard(CaseSpec const& spec, ParticleSet const& particles, EnergyScale const& scale)
    : particles_(particles),
      scale_(scale),
      checkpoints_(spec.output.checkpoints_every),
      limit_(std::max(1.0, spec.run.guards.energy_rise_stop)),
      stop_(spec.run.guards.energy_rise_stop),
      loaded_(may_do_work(spec)),
      pressed_(starts_under_pressure(spec)) {
  PIOLA_EXPECTS(spec.bodies.size() == particles.bodies.size());
  if (double const time = crossing_time(spec, particles); std::isfinite(time)) lasting_ = lasting_crossings * time;
}

bool EnergyJumpGuard::is_strange(Formulation const& formulation, TimeState const& moment) const {
  if (moment.step == 0 || rises_ > 0) return true;
  if (!moment.cut_to_end && !(growth * moment.dt >= shortest_)) return true;
  return moment.step % interval == 0 && !(formulation.kinetic_energy() <= growth * known_);
}

void EnergyJumpGuard::observe(Formulation const& formulation, TimeState const& moment, Diagnostics const* row,
                              bool last) {
  if (std::isinf(stop_)) return;
  bool const kept = checkpoints_.due(moment.time);
  if (row != nullptr)
    look(formulation, moment, *row, last);
  else if (last || kept || is_strange(formulation, moment))
    look(formulation, moment, formulation.diagnose(), last);
}

void EnergyJumpGuard::look(Formulation const& formulation, TimeState const& moment, Diagnostics const& now, bool last) {
  double const own = energy_without_work(now);
  if (!std::isfinite(own)) return object(formulation, moment, now);
  scale_.observe(now, moment);
  double const had = std::max(scale_.without_motion(), kinetic_);
  known_ = scale_.value();
  if (moment.step > 0 && !moment.cut_to_end) shortest_ = std::min(shortest_, moment.dt);
  if (own < lowest_) {
    lowest_ = own;
    lowest_time_ = moment.time;
    lowest_step_ = static_cast<double>(moment.step);
  }
  // If total energy is conserved, kinetic energy may come from an internal energy below zero, which is unphysical.
  double const out_of_nothing = pressed_ ? 0 : now.kinetic_energy - 2 * scale_.without_motion();
  double const created = std::max(own - lowest_, out_of_nothing);
  if (!(created > limit_ * had)) {
    rises_ = 0;
    kinetic_ = std::max(kinetic_, now.kinetic_energy);
    return;
  }
  if (rises_ == 0) {
    risen_time_ = moment.time;
    risen_step_ = moment.dt;
  }
  rises_ += 1;
  bool const lasts = moment.time - risen_time_ >= lasting_ || growth * moment.dt < risen_step_;
  bool const found = !loaded_ || (rises_ >= steps_in_a_row && lasts) || (last && moment.step >= first_steps);
  if (found) object(formulation, moment, now);
}

void EnergyJumpGuard::object(Formulation const& formulation, TimeState const& moment, Diagnostics const& now) {
  bool const number = std::isfinite(energy_without_work(now));
  StopRequest o;
  std::optional<Suspect> fastest;  // on rank 0
  evaluate_on_root(formulation, particles_,
                   [&](FieldCache& fields) { fastest = most_moved(fields, particles_, {}, moment.time); });
  if (fastest) {
    take_particle(o.failure, *fastest, particles_);
    o.failure.what = number ? "is the fastest where the energy jumps without a load"
                            : "is the fastest, and the energy is not a number";
  } else {
    o.failure.what = number ? "energy jumps without a load" : "energy is not a number";
  }
  o.failure.values = {{"total energy [J]", now.total_energy()}, {"kinetic energy [J]", now.kinetic_energy},
                      {"work of loads [J]", now.external_work}, {"lowest before [J]", lowest_},
                      {"then at t [s]", lowest_time_},          {"and step", lowest_step_}};
  o.causes = fmt::format(
      "this state and all that would follow are nonsense: often a particle is crushed, or bodies are pressed into each "
      "other, within one step - try half of run.cfl, more particles there, and for adaptle bodies that start two "
      "smoothing lengths apart or have surface contact; run.guards.energy_rise_stop is {}",
      number_text(stop_));
  stop_request_ = std::move(o);
}

void EnergyJumpGuard::save(StateWriter& writer) const {
  writer.put("guard_jump", std::array{lowest_, lowest_time_, lowest_step_, kinetic_, known_, shortest_, rises_,
                                      risen_time_, risen_step_});
  scale_.save(writer, "guard_jump_scale");
}

void EnergyJumpGuard::load(NamedState& reader, double time) {
  checkpoints_.start_after(time);
  if (!reader.has("guard_jump")) return;  // checkpoints of older versions have none
  std::array<double, 9> v{};
  reader.get("guard_jump", v);
  lowest_ = v[0];
  lowest_time_ = v[1];
  lowest_step_ = v[2];
  kinetic_ = v[3];
  known_ = v[4];
  shortest_ = v[5];
  rises_ = v[6];
  risen_time_ = v[7];
  risen_step_ = v[8];
  scale_.load(reader, "guard_jump_scale");
}

}  // namespace piola
