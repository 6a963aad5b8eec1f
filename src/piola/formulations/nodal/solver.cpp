// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/solver.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/domain/slot_collectives.hpp"
#include "piola/formulations/common/body_resultants.hpp"
#include "piola/formulations/common/field_checkpoint.hpp"
#include "piola/formulations/common/sample_local.hpp"
#include "piola/formulations/common/set_up_checks.hpp"
#include "piola/formulations/common/slots_by_id.hpp"
#include "piola/formulations/nodal/observe.hpp"
#include "piola/formulations/nodal/stability.hpp"
#include "piola/mechanics/body_boundary_conditions.hpp"
#include "piola/mechanics/prescribed.hpp"
#include "piola/mechanics/resultants.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace piola::nodal {
namespace {

/// One or more bodies that do not touch each other.
class Solver final : public Formulation, public SetUpChecked {
 public:
  explicit Solver(Assembly const& assembly)
      : set_(assembly.particles),
        backend_(choose_backend(assembly.backend.c_str())),
        actions_(assembly.supports, assembly.loads, assembly.rigid_shapes) {
    for (std::size_t k = 0; k < set_.bodies.size(); ++k) {
      Options const options =
          read_options(assembly.formulations[k], materials_of(assembly, k), set_.dimension, assembly.cfl);
      bodies_.push_back(std::make_unique<NodalBody>(assembly, set_, k, options, backend_));
      monitors_.push_back(std::make_unique<StabilityMonitor>(*bodies_.back(), backend_));
    }
    pushed_ = assembly.coupled;
    if (pushed_) slots_ = SlotsById(set_, bodies_);
  }

  double stable_time_step() const override { return clip_step_to_end_time_of(bodies_, time_, steady_time_step()); }
  double steady_time_step() const override { return least_step(&StabilityMonitor::step); }

  StepEstimate step_estimate_of_run() const override {
    StepEstimate rule;
    rule.first = steady_time_step();
    rule.settled = least_step(&StabilityMonitor::calm_step);
    if (time_ == 0) rule.growth = StabilityMonitor::growth_at_start;
    if (bodies_.front()->options().cfl > 0) {
      rule.limit = fmt::format("run.cfl h / c with run.cfl = {}", bodies_.front()->options().cfl);
      return rule;
    }
    rule.limit =
        "the stability limit of the fastest mode, measured (run.cfl, without a default here, would replace it)";
    return rule;
  }

  void step(double time, double dt) override {
    actions_.begin_step(bodies_, dt);
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      bodies_[k]->set_observed(false);
      int const halvings = bodies_[k]->step(backend_, time, dt);
      repeated_ += halvings;
      monitors_[k]->update(dt, halvings);
    }
    actions_.end_step(bodies_);
    time_ = time + dt;
    ends_step_ = true;
    if (comm::is_parallel() && failed()) tell_failures();
  }

  void damp(double factor) override {
    for (auto const& body : bodies_) {
      body->set_observed(false);
      body->damp(factor);
    }
  }
  void read_motion(std::span<std::int64_t const> ids, std::span<std::array<double, 3>> x,
                   std::span<std::array<double, 3>> v) const override {
    add_coupled_particles(bodies_, slots_, ids, x, v);
  }
  void read_masses(std::span<std::int64_t const> ids, std::span<double> m) const override {
    read_masses_of(bodies_, slots_, ids, m, [](auto const& body, Index slot) { return body.replicated_mass(slot); });
  }
  void add_velocities(std::span<std::int64_t const> ids, std::span<std::array<double, 3> const> change) override {
    add_velocities_of(bodies_, set_.dimension, slots_, ids, change);
    for (auto const& body : bodies_) body->set_observed(false);
    std::vector<char> moved(bodies_.size(), 0);
    slots_.visit(ids, [&](std::size_t, std::size_t body, Index slot) {
      if (bodies_[body]->boundary().moves_surface(slot)) moved[body] = 1;
    });
    if (std::find(moved.begin(), moved.end(), 1) != moved.end()) actions_.settle(bodies_);
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      if (moved[k] == 0) continue;
      bodies_[k]->boundary().project_out_reactions(bodies_[k]->state());
      if (!ends_step_) continue;
      bodies_[k]->boundary().add_resultants_to(actions_);
      bodies_[k]->boundary().reset_impulses();
    }
    ends_step_ = false;
  }
  double kinetic_energy() const override {
    return sum_over_bodies(bodies_, [](auto const& body) { return body.kinetic_energy(); });
  }

  std::optional<Failure> failure() const override;
  Diagnostics diagnose() const override {
    NodalObservation all;
    all.repeated_steps = repeated_;
    for (auto const& body : bodies_) {
      refresh(*body);
      observe(*body, all);
    }
    Diagnostics d = finish(all);
    d.actions = actions_.over_ranks(bodies_).report();
    return d;
  }

  std::vector<FieldInfo> fields() const override {
    return output_field_names(
        std::any_of(bodies_.begin(), bodies_.end(), [](auto const& b) { return b->stores_history(); }));
  }
  void sample(std::string_view field, std::span<double> values) const override {
    int number = 0;
    for (auto const& body : bodies_) {
      refresh(*body);
      nodal::sample(*body, number++, field, values);
    }
  }

  void sample_local(std::string_view field, std::span<double> values) const override {
    sample_local_bodies(*this, bodies_, field, values, [&](auto& body, int number, std::span<double> own) {
      refresh(body);
      sample_local_slots(body, number, field, own);
    });
  }

  void save(StateWriter& writer) const override;
  void load(StateReader& reader) override;
  std::optional<std::vector<std::int64_t>> local_particles() const override { return local_ids(bodies_); }

  int stages_per_step() const override { return 1; }
  std::vector<std::pair<std::string, double>> timings() const override;
  std::vector<SetUpCheck> set_up_checks() const override;
  std::size_t memory_bytes() const override {
    std::size_t total = set_.bytes();
    for (auto const& body : bodies_) total += body->bytes();
    for (auto const& monitor : monitors_) total += monitor->bytes();
    return total;
  }

 private:
  /// Updates the fields for observers; the state for steps is unchanged. Collective if the body is distributed.
  void refresh(NodalBody& body) const {
    if (body.observed()) return;
    body.set_observed(true);
    FailureSlot failure;
    BodyState seen = body.state();
    seen.failure = &failure;
    backend_.observe(seen);
  }
  bool failed() const {
    return std::any_of(bodies_.begin(), bodies_.end(),
                       [](auto const& body) { return body->state().failure->index < body->particles(); });
  }
  double calm_time_step() const;
  /// The smallest step of all bodies, shortened by the energy tolerance [s].
  double least_step(double (StabilityMonitor::*of_body)() const) const {
    double dt = std::numeric_limits<double>::infinity();
    for (auto const& monitor : monitors_) dt = std::min(dt, ((*monitor).*of_body)());
    return std::min(dt, std::max(calm_time_step(), StabilityMonitor::least_of_limit * dt));
  }
  void tell_failures();

  ParticleSet set_;
  SlotsById slots_;
  Backend const& backend_;
  std::vector<std::unique_ptr<NodalBody>> bodies_;
  std::vector<std::unique_ptr<StabilityMonitor>> monitors_;
  ActionsOnBodies actions_;
  bool pushed_ = false;                    ///< by contact or ties
  bool ends_step_ = false;                 ///< whether the next push() ends the last step or begins the next one
  double time_ = 0;                        ///< at the end of the last step [s]
  double repeated_ = 0;                    ///< steps that were taken again in halves
  std::vector<double> failed_neighbours_;  ///< on ranks, per body: of the particle that failed
};

/// The longest step that keeps the energy of all bodies as well as is wanted [s]; infinite where nothing moves.
double Solver::calm_time_step() const {
  double energy = 0, energy_oscillation = 0;
  for (std::size_t k = 0; k < monitors_.size(); ++k) {
    energy += monitors_[k]->energy();
    double const tolerance = bodies_[k]->options().energy_tolerance;
    if (tolerance > 0)
      energy_oscillation += monitors_[k]->energy_oscillation() / (StabilityMonitor::share_of_tolerance * tolerance);
  }
  return energy_oscillation > 0 && energy > 0 ? std::sqrt(energy / energy_oscillation)
                                              : std::numeric_limits<double>::infinity();
}

/// Replicates the values of the first failed particle for its error message.
void Solver::tell_failures() {
  failed_neighbours_.assign(bodies_.size(), 0);
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    NodalBody& body = *bodies_[k];
    Index const slot = body.state().failure->index;
    if (slot >= body.particles()) continue;
    refresh(body);
    auto const& s = body.state();
    int const D = set_.dimension;
    for (auto const& [field, components] : {std::pair{s.x, D}, {s.v, D}, {s.F, D * D}, {s.cell, 4}})
      allgather_selected_slots(field, body.own(), std::array{slot}, components);
    if (is_local(body.own(), slot)) failed_neighbours_[k] = body.reference().neighbours(slot);
  }
  comm::allreduce_or(failed_neighbours_);
}

std::optional<Failure> Solver::failure() const {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    auto const& body = bodies_[k];
    FailureSlot const& slot = *body->state().failure;
    if (slot.index >= body->particles()) continue;
    if (!comm::is_parallel()) refresh(*body);
    double const least = NodalBody::value(body->state().cell, slot.index, 2);
    Failure f;
    f.what = least <= 0 ? "is inverted" : "has a deformation that is not a number";
    f.particle = body->id(slot.index);
    f.body = body->body().name;
    f.X = body->X(slot.index);
    f.x = body->x(slot.index);
    auto const v = body->v(slot.index);
    f.values = {
        {"least det F in its cell", least},
        {"det F", determinant(body->F(slot.index))},
        {"neighbours", failed_neighbours_.empty() ? body->reference().neighbours(slot.index) : failed_neighbours_[k]},
        {"speed [m/s]", std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])}};
    return f;
  }
  return std::nullopt;
}

std::vector<std::pair<std::string, double>> Solver::timings() const {
  SetUpCosts sum;
  for (auto const& body : bodies_) {
    auto const& c = body->reference().costs;
    sum = {sum.cells + c.cells, sum.fits + c.fits, sum.integration_correction + c.integration_correction,
           sum.masses + c.masses, sum.tables + c.tables};
  }
  return {{"set_up_cells", sum.cells},
          {"set_up_fits", sum.fits},
          {"set_up_closure", sum.integration_correction},
          {"set_up_masses", sum.masses},
          {"set_up_tables", sum.tables}};
}

std::vector<SetUpCheck> Solver::set_up_checks() const {
  std::vector<SetUpCheck> all;
  for (auto const& body : bodies_) {
    auto const& checks = body->reference().checks;
    all.insert(all.end(), checks.begin(), checks.end());
  }
  return all;
}

void Solver::save(StateWriter& writer) const {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    NodalBody const& body = *bodies_[k];
    body.each_evolved([&](std::string const& name, FieldRef const& field, int components) {
      save_local(writer, fmt::format("body{}_{}", k, name), body, field, components);
    });
    writer.put(fmt::format("body{}_step_limit", k), monitors_[k]->state());
    writer.put(fmt::format("body{}_energy_books", k),
               std::array{body.boundary().external_work().over_ranks(), body.damping_loss()});
  }
  writer.put("actions", actions_.over_ranks(bodies_).state());
  writer.put("time", std::array{time_, repeated_});
}

void Solver::load(StateReader& reader) {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    NodalBody& body = *bodies_[k];
    body.set_observed(false);
    body.each_evolved([&](std::string const& name, FieldRef const& field, int components) {
      load_local(reader, fmt::format("body{}_{}", k, name), body, field, components);
    });
    monitors_[k]->load(reader, fmt::format("body{}_step_limit", k));
    std::array<double, 2> energy_totals{};
    reader.get(fmt::format("body{}_energy_books", k), energy_totals);
    body.boundary().external_work().set(energy_totals[0]);
    body.set_damping_loss(energy_totals[1]);
  }
  load_part(reader, "actions", actions_);
  std::array<double, 2> clock{};
  reader.get("time", clock);
  time_ = clock[0];
  repeated_ = clock[1];
  // push() may precede the next step and needs the held directions.
  for (auto const& body : bodies_) body->boundary().begin_step(body->state(), time_, 0);
}

}  // namespace

std::unique_ptr<Formulation> make(Assembly const& assembly) { return std::make_unique<Solver>(assembly); }

}  // namespace piola::nodal
