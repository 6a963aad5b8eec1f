// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/solver.hpp"
#include "piola/base/errors.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/domain/slot_collectives.hpp"
#include "piola/formulations/common/body_resultants.hpp"
#include "piola/formulations/common/field_checkpoint.hpp"
#include "piola/formulations/common/sample_local.hpp"
#include "piola/formulations/common/slots_by_id.hpp"
#include "piola/formulations/jst_sph/body.hpp"
#include "piola/formulations/jst_sph/observe.hpp"
#include "piola/formulations/jst_sph/stability.hpp"
#include "piola/mechanics/prescribed.hpp"
#include "piola/mechanics/resultants.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace piola::jst_sph {
namespace {

/// JST-SPH of one or more bodies that do not touch each other.
class Solver final : public Formulation {
  /// Fraction of the stability limit that is used: power iterations come from below.
  static constexpr double margin = 0.85;
  /// The first step takes this fraction of the limit and each further one may be longer by `growth`: a violent start,
  /// and jumps of the step, would excite the modes near the limit and let the energy of a sample exceed the earlier
  /// one.
  static constexpr double first_share = 0.05, growth = 1.08;

 public:
  explicit Solver(Assembly const& assembly)
      : set_(assembly.particles),
        backend_(&choose_backend(assembly.backend.c_str())),
        actions_(assembly.supports, assembly.loads, assembly.rigid_shapes) {
    for (std::size_t k = 0; k < set_.bodies.size(); ++k) {
      Options const options = read_options(assembly.formulations[k], assembly.materials[k], assembly.cfl);
      bodies_.push_back(std::make_unique<JstBody>(assembly, set_, k, options, *backend_));
      alpha_.push_back(options.cfl);
      monitors_.push_back(options.cfl > 0 ? nullptr : std::make_unique<StabilityMonitor>(*bodies_.back(), *backend_));
    }
    find_largest_speeds();
    if (assembly.coupled) slots_ = SlotsById(set_, bodies_);
  }

  double stable_time_step() const override {
    double dt = steady_time_step();
    bool const monitored = std::any_of(monitors_.begin(), monitors_.end(), [](auto const& m) { return m != nullptr; });
    if (monitored) dt = std::min(dt, last_step_ > 0 ? growth * last_step_ : first_share * dt);
    return clip_step_to_end_time_of(bodies_, time_, dt);
  }

  double steady_time_step() const override {
    double dt = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      double const c = largest_speed_[k], h = bodies_[k]->state().constants.h_min;
      dt = std::min(dt, monitors_[k] ? margin * monitors_[k]->step(c) : alpha_[k] * h / c);  // (44)
    }
    return dt;
  }

  StepEstimate step_estimate_of_run() const override {
    StepEstimate rule;
    rule.settled = rule.first = steady_time_step();
    if (monitors_.front() == nullptr) {
      rule.limit = fmt::format("waves: run.cfl h / c with run.cfl = {}", alpha_.front());
      return rule;
    }
    rule.first = first_share * rule.settled;
    rule.growth = growth;
    rule.limit =
        "the stability limit of the fastest mode, measured (run.cfl, without a default here, would replace it)";
    return rule;
  }

  void step(double time, double dt) override {
    actions_.begin_step(bodies_, dt);
    for (auto const& body : bodies_) body->step(*backend_, time, dt);
    actions_.end_step(bodies_);
    time_ = time + dt;
    last_step_ = dt;
    for (std::size_t k = 0; k < bodies_.size(); ++k) largest_speed_[k] = bodies_[k]->state().largest_wave_speed;
    for (std::size_t k = 0; k < monitors_.size(); ++k)
      if (monitors_[k]) monitors_[k]->update(largest_speed_[k]);
    if (comm::is_parallel()) share_failures();
  }

  void damp(double factor) override {
    for (auto const& body : bodies_) body->damp(factor);
  }
  void read_motion(std::span<std::int64_t const> ids, std::span<std::array<double, 3>> x,
                   std::span<std::array<double, 3>> v) const override {
    add_coupled_particles(bodies_, slots_, ids, x, v);
  }
  void read_masses(std::span<std::int64_t const> ids, std::span<double> m) const override {
    read_masses_of(bodies_, slots_, ids, m,
                   [](auto const& body, Index slot) { return body.volume(slot) * body.state().constants.rho0; });
  }
  void add_velocities(std::span<std::int64_t const> ids, std::span<std::array<double, 3> const> change) override {
    add_velocities_of(bodies_, set_.dimension, slots_, ids, change);
  }
  double kinetic_energy() const override {
    return sum_over_bodies(bodies_, [](auto const& body) { return body.kinetic_energy(); });
  }

  std::optional<Failure> failure() const override;
  Diagnostics diagnose() const override {
    JstObservation all;
    for (auto const& body : bodies_) {
      refresh(*body);
      observe(*body, all);
    }
    Diagnostics d = finish(all);
    d.actions = actions_.over_ranks(bodies_).report();
    return d;
  }

  std::vector<FieldInfo> fields() const override { return output_field_names(); }
  void sample(std::string_view field, std::span<double> values) const override {
    int number = 0;
    for (auto const& body : bodies_) {
      refresh(*body);
      jst_sph::sample(*body, number++, field, values);
    }
  }

  std::optional<std::vector<std::int64_t>> local_particles() const override { return local_ids(bodies_); }
  void sample_local(std::string_view field, std::span<double> values) const override {
    sample_local_bodies(*this, bodies_, field, values, [&](auto const& body, int number, std::span<double> own) {
      refresh(body);
      sample_local_slots(body, number, field, own);
    });
  }

  void save(StateWriter& writer) const override;
  void load(StateReader& reader) override;

  int stages_per_step() const override { return bodies_.front()->options().integrator == Integrator::verlet ? 1 : 2; }
  std::size_t memory_bytes() const override {
    std::size_t total = set_.bytes();
    for (auto const& body : bodies_) total += body->bytes();
    for (auto const& monitor : monitors_) total += monitor ? monitor->bytes() : 0;
    return total;
  }

 private:
  void find_largest_speeds() {
    largest_speed_.clear();
    for (auto const& body : bodies_) largest_speed_.push_back(backend_->largest_wave_speed(body->state()));
  }
  /// Updates the data for observers; the state for steps is unchanged. Displacement variables keep F of the last stage;
  /// observers need that of x. Collective if the body is distributed.
  void refresh(JstBody const& body) const {
    BodyState seen = body.state();
    if (body.options().variables == Variables::displacement) backend_->update_deformation(seen);
  }
  static constexpr int no_wave_speed = 3;  ///< a code of FailureSlot
  static FailureSlot failure_of(JstBody const& body, double largest_speed);
  void share_failures();
  void tell_failures();
  static double neighbours_of(JstBody const& body, Index slot);
  void place_stages(JstBody& body) const;

  ParticleSet set_;
  SlotsById slots_;
  Backend const* backend_;
  ActionsOnBodies actions_;
  std::vector<std::unique_ptr<JstBody>> bodies_;
  std::vector<double> alpha_;                                ///< of eq. (44), per body; 0: from the monitor
  std::vector<std::unique_ptr<StabilityMonitor>> monitors_;  ///< per body, or nothing where the case gives alpha
  std::vector<double> largest_speed_;                        ///< wave speed of the state, per body [m/s]
  std::vector<double> failed_neighbours_;                    ///< on ranks, per body: of the first particle that failed
  double last_step_ = 0;                                     ///< [s]
  double time_ = 0;                                          ///< at the end of the last step [s]
};

/// The particle that the loops have recorded, else the first whose wave speed is NaN, which would make the step NaN.
FailureSlot Solver::failure_of(JstBody const& body, double largest_speed) {
  FailureSlot const recorded = *body.state().failure;
  if (recorded.index < body.particles() || !std::isnan(largest_speed)) return recorded;
  FailureSlot found = recorded;
  for (Index i = body.own().first; i < body.own().last; ++i) {
    if (!std::isnan(JstBody::value(body.state().wave_speed, i)) || !found.is_after(i)) continue;
    found.index = i;
    found.code = no_wave_speed;
  }
  return found;
}

std::optional<Failure> Solver::failure() const {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    auto const& body = bodies_[k];
    FailureSlot const slot = failure_of(*body, largest_speed_[k]);
    if (slot.index >= body->particles()) continue;
    Mat<3> F = body->F(slot.index);
    double const J = determinant(F);
    Failure f;
    f.what = slot.code == 2               ? "has an evolved volume ratio J that is not positive"
             : J <= 0                     ? "is inverted"
             : slot.code == no_wave_speed ? "has a wave speed that is not a number"
                                          : "has a deformation that is not a number";
    f.particle = body->id(slot.index);
    f.body = body->body().name;
    f.X = body->X(slot.index);
    f.x = body->x(slot.index);
    auto const v = body->v(slot.index);
    f.values = {{"det F", J},
                {"J", body->J(slot.index)},
                {"neighbours", failed_neighbours_.empty() ? neighbours_of(*body, slot.index) : failed_neighbours_[k]},
                {"speed [m/s]", std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])},
                {"wave speed [m/s]", JstBody::value(body->state().wave_speed, slot.index)}};
    return f;
  }
  return std::nullopt;
}

void Solver::save(StateWriter& writer) const {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    JstBody const& body = *bodies_[k];
    body.each_evolved([&](std::string const& name, FieldRef const& field, int components) {
      save_local(writer, fmt::format("body{}_{}", k, name), body, field, components);
    });
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

/// Replicates the values of the first failed particle for its error message.
void Solver::tell_failures() {
  failed_neighbours_.assign(bodies_.size(), 0);
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    JstBody const& body = *bodies_[k];
    FailureSlot found = failure_of(body, largest_speed_[k]);
    allreduce_first_failure(found);
    if (found.index >= body.particles()) continue;
    *body.state().failure = found;
    body.each_evolved([&](std::string const&, FieldRef const& field, int components) {
      allgather_selected_slots(field, body.own(), std::array{found.index}, components);
    });
    failed_neighbours_[k] = neighbours_of(body, found.index);
  }
  comm::allreduce_or(failed_neighbours_);
}

/// 0 for remote particles, whose lists only their rank has.
double Solver::neighbours_of(JstBody const& body, Index slot) {
  bool const own = slot >= body.own().first && slot < body.own().last;
  return own ? body.pairs().corrections().neighbours_of(slot) : 0;
}

/// Finds the first failure over all ranks; then sends its values to rank 0.
void Solver::share_failures() {
  bool failed = false;
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    FailureSlot& slot = *bodies_[k]->state().failure;
    if (smooths_volume(bodies_[k]->state().constants))
      allreduce_first_failure(slot);  // others are replicated with the forces
    failed = failed || slot.index < bodies_[k]->particles() || std::isnan(largest_speed_[k]);
  }
  if (failed) tell_failures();
}

void Solver::load(StateReader& reader) {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    JstBody& body = *bodies_[k];
    body.each_evolved([&](std::string const& name, FieldRef const& field, int components) {
      load_local(reader, fmt::format("body{}_{}", k, name), body, field, components);
    });
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
