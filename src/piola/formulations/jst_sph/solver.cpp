// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/solver.hpp"
#include "piola/formulations/common/bodies_solver.hpp"
#include "piola/formulations/jst_sph/body.hpp"
#include "piola/formulations/jst_sph/observe.hpp"
#include "piola/formulations/jst_sph/stability.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace piola::jst_sph {
namespace {

/// JST-SPH of one or more bodies that do not touch each other.
class Solver final : public BodiesSolver<JstBody, StabilityMonitor> {
  /// Fraction of the stability limit that is used: power iterations come from below.
  static constexpr double margin = 0.85;
  /// The first step takes this fraction of the limit and each further one may be longer by `growth`: a violent start,
  /// and jumps of the step, would excite the modes near the limit and let the energy of a sample exceed the earlier
  /// one.
  static constexpr double first_share = 0.05, growth = 1.08;

 public:
  explicit Solver(Assembly const& assembly)
      : BodiesSolver(assembly), backend_(choose_backend(assembly.backend.c_str())) {
    for (std::size_t k = 0; k < set_.bodies.size(); ++k) {
      Options const options = read_options(assembly.formulations[k], assembly.materials[k], assembly.cfl);
      bodies_.push_back(std::make_unique<JstBody>(assembly, set_, k, options, backend_));
      monitors_.push_back(options.cfl > 0 ? nullptr : std::make_unique<StabilityMonitor>(*bodies_.back(), backend_));
    }
    find_largest_speeds();
    if (assembly.coupled) slots_ = SlotsById(set_, bodies_);
  }

  double stable_time_step() const override {
    double dt = step_limit();
    bool const monitored = std::any_of(monitors_.begin(), monitors_.end(), [](auto const& m) { return m != nullptr; });
    if (monitored) dt = std::min(dt, last_step_ > 0 ? growth * last_step_ : first_share * dt);
    return clip_step_to_end_time_of(bodies_, time_, dt);
  }

  StepEstimate step_estimate() const override {
    StepEstimate rule;
    rule.stable = rule.settled = rule.first = step_limit();
    if (monitors_.front() == nullptr) {
      rule.limit = fmt::format("waves: run.cfl h / c with run.cfl = {}", bodies_.front()->options().cfl);
      return rule;
    }
    rule.first = first_share * rule.settled;
    rule.growth = growth;
    rule.limit = measured_limit;
    return rule;
  }

  StepBound step_bound() const override;

  void step(double time, double dt) override {
    actions_.begin_step(bodies_, dt);
    for (auto const& body : bodies_) body->step(backend_, time, dt);
    actions_.end_step(bodies_);
    time_ = time + dt;
    last_step_ = dt;
    for (std::size_t k = 0; k < bodies_.size(); ++k) largest_speed_[k] = bodies_[k]->state().largest_wave_speed;
    for (std::size_t k = 0; k < monitors_.size(); ++k)
      if (monitors_[k]) monitors_[k]->update(largest_speed_[k]);
    if (comm::is_parallel() && any_failed()) replicate_failures();
  }

  void damp(double factor) override {
    for (auto const& body : bodies_) body->damp(factor);
  }

  Diagnostics diagnose() const override { return diagnose_from(JstDiagnosticsSum{}); }
  std::vector<FieldInfo> fields() const override { return output_field_names(); }

  void save(StateWriter& writer) const override;
  void load(StateReader& reader) override;

  RunStatistics statistics() const override {
    RunStatistics all = BodiesSolver::statistics();
    all.stages_per_step = bodies_.front()->options().integrator == Integrator::verlet ? 1 : 2;
    return all;
  }

 private:
  /// The smallest step of all bodies at their present wave speeds [s].
  double step_limit() const {
    double dt = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < bodies_.size(); ++k) dt = std::min(dt, step_limit_of(k));
    return dt;
  }
  double step_limit_of(std::size_t k) const {
    double const c = largest_speed_[k], h = bodies_[k]->state().constants.h_min;
    return monitors_[k] ? margin * monitors_[k]->step(c) : bodies_[k]->options().cfl * h / c;  // (44)
  }
  void find_largest_speeds() {
    largest_speed_.clear();
    for (auto const& body : bodies_) largest_speed_.push_back(backend_.largest_wave_speed(body->state()));
  }
  /// Displacement variables keep F of the last stage; output needs that of x.
  void update_output_fields(JstBody& body) const override {
    if (!body.state().has.displacement) return;
    BodyState seen = body.state();
    backend_.update_deformation(seen);
  }
  static constexpr int no_wave_speed = 3;  ///< a code of FailureSlot
  FailureSlot failed_particle(std::size_t body) const override;
  void describe(std::size_t body, FailureSlot const& slot, Failure& failure) const override;
  void replicate(JstBody& body, Index slot) const override {
    body.each_evolved([&](std::string_view, FieldRef const& field, int components) {
      allgather_selected_slots(field, body.own(), std::array{slot}, components);
    });
  }
  double neighbours_of(JstBody const& body, Index slot) const override {
    return body.pairs().corrections().neighbours_of(slot);
  }
  bool any_failed();
  void place_stages(JstBody& body) const;

  Backend const& backend_;
  std::vector<double> largest_speed_;  ///< wave speed of the state, per body [m/s]
  double last_step_ = 0;               ///< [s]
};

/// Names the first particle with the largest wave speed of the body with the shortest step.
StepBound Solver::step_bound() const {
  std::size_t least = 0;
  for (std::size_t k = 1; k < bodies_.size(); ++k)
    if (step_limit_of(k) < step_limit_of(least)) least = k;
  JstBody const& body = *bodies_[least];
  std::int64_t fastest = std::numeric_limits<std::int64_t>::max();
  for (Index i = body.own().first; i < body.own().last; ++i)
    if (JstBody::value(body.state().wave_speed, i) == largest_speed_[least]) fastest = std::min(fastest, body.id(i));
  comm::allreduce(fastest, [](void const* other, void* mine) {
    auto& first = *static_cast<std::int64_t*>(mine);
    first = std::min(first, *static_cast<std::int64_t const*>(other));
  });
  bool const known = fastest < std::numeric_limits<std::int64_t>::max();
  return {.step = step_limit_of(least),
          .text = fmt::format("{}, with a wave speed of {:.4g} m/s", step_estimate().limit, largest_speed_[least]),
          .particle = known ? fastest : -1};
}

/// The particle that the loops have recorded, else the first whose wave speed is NaN, which would make the step NaN.
FailureSlot Solver::failed_particle(std::size_t k) const {
  JstBody const& body = *bodies_[k];
  FailureSlot found = *body.state().failure;
  if (found.index < body.particles() || !std::isnan(largest_speed_[k])) return found;
  for (Index i = body.own().first; i < body.own().last; ++i) {
    if (!std::isnan(JstBody::value(body.state().wave_speed, i)) || !found.is_after(i)) continue;
    found.index = i;
    found.code = no_wave_speed;
  }
  return found;
}

void Solver::describe(std::size_t k, FailureSlot const& slot, Failure& f) const {
  JstBody const& body = *bodies_[k];
  double const J = determinant(body.F(slot.index));
  f.what = slot.code == 2               ? "has an evolved volume ratio J that is not positive"
           : J <= 0                     ? "is inverted"
           : slot.code == no_wave_speed ? "has a wave speed that is not a number"
                                        : "has a deformation that is not a number";
  f.values = {{"det F", J},
              {"J", body.J(slot.index)},
              {"neighbours", neighbours_of_failed(k, slot.index)},
              {"speed [m/s]", speed_of(body, slot.index)},
              {"wave speed [m/s]", JstBody::value(body.state().wave_speed, slot.index)}};
}

void Solver::save(StateWriter& writer) const {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    JstBody const& body = *bodies_[k];
    save_fields(writer, k);
    auto const& totals = body.state().totals;
    std::array const energy_totals{totals.stabilisation_loss, totals.projection_loss, body.external_work().over_ranks(),
                                   totals.damping_loss};
    writer.put(fmt::format("body{}_energy_books", k), energy_totals);
    writer.put(fmt::format("body{}_supports", k), body.boundary().state());
    if (monitors_[k]) writer.put(fmt::format("body{}_step_limit", k), monitors_[k]->state());
  }
  std::array const clock{time_, last_step_};
  writer.put("time", clock);
  writer.put("actions", actions_.over_ranks(bodies_).state());
}

/// The positions of a stage are, between steps, those of the particles.
void Solver::place_stages(JstBody& body) const {
  if (body.options().variables != Variables::displacement) return;
  for (Index i = body.own().first; i < body.own().last; ++i)
    for (int c = 0; c < set_.dimension; ++c) JstBody::set(body.state().u, i, c, JstBody::value(body.state().x, i, c));
}

/// Whether a particle of some rank has failed. Collective.
bool Solver::any_failed() {
  bool failed = false;
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    FailureSlot& slot = *bodies_[k]->state().failure;
    if (smooths_volume(bodies_[k]->state().constants))
      allreduce_first_failure(slot);  // others are replicated with the forces
    failed = failed || slot.index < bodies_[k]->particles() || std::isnan(largest_speed_[k]);
  }
  return failed;
}

void Solver::load(StateReader& reader) {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    JstBody& body = *bodies_[k];
    load_fields(reader, k);
    place_stages(body);
    std::array<double, 4> energy_totals{};
    reader.get(fmt::format("body{}_energy_books", k), energy_totals);
    body.state().totals = {energy_totals[0], energy_totals[1], energy_totals[3]};
    body.external_work().set(energy_totals[2]);
    load_part(reader, fmt::format("body{}_supports", k), body.boundary());
    if (!monitors_[k]) continue;
    std::vector<double> monitor = monitors_[k]->state();
    reader.get_on_root(fmt::format("body{}_step_limit", k), monitor);
    monitors_[k]->restore(monitor);
  }
  std::array<double, 2> clock{};
  reader.get("time", clock);
  load_part(reader, "actions", actions_);
  find_largest_speeds();
  time_ = clock[0];
  last_step_ = clock[1];
}

}  // namespace

std::unique_ptr<Formulation> make(Assembly const& assembly) { return std::make_unique<Solver>(assembly); }

}  // namespace piola::jst_sph
