// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/solver.hpp"
#include "piola/formulations/common/bodies_solver.hpp"
#include "piola/formulations/nodal/cell_failure.hpp"
#include "piola/formulations/nodal/conduction.hpp"
#include "piola/formulations/nodal/energy_descent.hpp"
#include "piola/formulations/nodal/implicit_pressure.hpp"
#include "piola/formulations/nodal/observe.hpp"
#include "piola/formulations/nodal/stability.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace piola::nodal {
namespace {

std::string law_failure_text(MaterialRange const& range, int code) {
  std::string const law(law_of(range.material).name);
  if (code == failure_of_law) return fmt::format("gets a stress from the law {} that is not a number", law);
  return fmt::format("is in a group of particles at which the law {} fails with the code {}", law,
                     code - failure_of_law);
}

/// One or more bodies that do not touch each other.
class Solver final : public BodiesSolver<NodalBody, StabilityMonitor> {
 public:
  explicit Solver(Assembly const& assembly)
      : BodiesSolver(assembly), backend_(choose_backend(assembly.backend.c_str())) {
    for (std::size_t k = 0; k < set_.bodies.size(); ++k) {
      Options options = read_options(assembly.formulations[k], materials_of(assembly, k), set_.dimension, assembly.cfl);
      if (assembly.minimises) {
        options.fluctuation_viscosity = 0;
        options.shock_viscosity = 0;
        options.viscous = false;
        options.implicit_pressure = false;
        options.failure = options.converts = false;
      }
      bodies_.push_back(std::make_unique<NodalBody>(assembly, set_, k, options, backend_));
      monitors_.push_back(std::make_unique<StabilityMonitor>(*bodies_.back(), backend_));
      failures_.push_back(std::make_unique<CellFailure>(*bodies_.back(), backend_));
      conductions_.push_back(options.conducts ? std::make_unique<Conduction>(*bodies_.back()) : nullptr);
      if (assembly.minimises) descents_.emplace_back(*bodies_.back(), backend_);
    }
    if (assembly.coupled) slots_ = SlotsById(set_, bodies_);
  }

  double stable_time_step() const override {
    return clip_step_to_end_time_of(
        bodies_, time_, least_step(descents_.empty() ? &StabilityMonitor::step : &StabilityMonitor::calm_step));
  }

  StepEstimate step_estimate() const override {
    StepEstimate rule;
    rule.stable = rule.first = least_step(&StabilityMonitor::step);
    rule.settled = least_step(&StabilityMonitor::calm_step);
    if (time_ == 0) rule.growth = StabilityMonitor::growth_at_start;
    if (bodies_.front()->options().cfl > 0) {
      rule.limit = fmt::format("run.cfl h / c with run.cfl = {}", bodies_.front()->options().cfl);
      return rule;
    }
    rule.limit = measured_limit;
    return rule;
  }

  StepBound step_bound() const override;

  void step(double time, double dt) override {
    actions_.begin_step(bodies_, dt);
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      bodies_[k]->set_observed(false);
      failures_[k]->begin_step(dt);
      int const halvings = bodies_[k]->step(backend_, time, dt);
      repeated_ += halvings;
      bool const failed = bodies_[k]->state().failure->index < bodies_[k]->particles();
      if (failures_[k]->end_step(dt, failed)) monitors_[k]->expect_change();
      tell_frequencies(k);
      monitors_[k]->update(dt, halvings);
      if (conductions_[k] != nullptr && !failed) conductions_[k]->advance(dt);
    }
    end_step(time + dt);
  }
  Descent descend(double time, double dt) override;

  void damp(double factor) override {
    for (auto const& body : bodies_) {
      body->set_observed(false);
      body->damp(factor);
    }
  }
  void add_velocities(std::span<std::int64_t const> ids, std::span<std::array<double, 3> const> change) override;

  std::int64_t surfaces_lost() const override {
    std::int64_t all = 0;
    for (auto const& failure : failures_) all += failure->surfaces_lost();
    return all;
  }
  bool has_lost_surface(std::int64_t id) const override {
    bool lost = false;
    slots_.visit(std::array{id},
                 [&](std::size_t, std::size_t body, Index slot) { lost = failures_[body]->has_lost_surface(slot); });
    return lost;
  }
  void read_face_areas(std::span<std::int64_t const> ids, std::span<std::array<double, 3> const> normals,
                       std::span<double> areas) const override {
    slots_.visit(ids, [&](std::size_t k, std::size_t body, Index slot) {
      areas[k] = bodies_[body]->face_area(slot, normals[k]);
    });
  }
  Diagnostics diagnose() const override {
    NodalDiagnosticsSum all;
    all.repeated_steps = repeated_;
    return diagnose_from(std::move(all));
  }
  std::vector<FieldInfo> fields() const override {
    auto const any = [&](auto const& of) { return std::any_of(bodies_.begin(), bodies_.end(), of); };
    auto all = output_field_names(any([](auto const& b) { return b->stores_history(); }),
                                  any([](auto const& b) { return b->state().has.converts; }));
    for (auto const& body : bodies_) add_fields_of_laws(*body, all);
    return all;
  }

  void save(StateWriter& writer) const override;
  void load(StateReader& reader) override;
  RunStatistics statistics() const override;

 private:
  void tell_frequencies(std::size_t k) {
    monitors_[k]->set_other_frequencies(failures_[k]->contact_frequency2(), failures_[k]->eulerian_frequency2());
  }
  void end_step(double time) {
    actions_.end_step(bodies_);
    time_ = time;
    ends_step_ = true;
    if (comm::is_parallel() && any_failed()) replicate_failures();
  }
  void update_output_fields(NodalBody& body) const override {
    if (body.observed()) return;
    body.set_observed(true);
    FailureSlot failure;
    BodyState seen = body.state();
    seen.failure = &failure;
    backend_.update_output_fields(seen);
  }
  void describe(std::size_t body, FailureSlot const& slot, Failure& failure) const override;
  void replicate(NodalBody& body, Index slot) const override;
  double neighbours_of(NodalBody const& body, Index slot) const override { return body.reference().neighbours(slot); }
  bool any_failed() const {
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

  Backend const& backend_;
  std::vector<std::unique_ptr<CellFailure>> failures_;    ///< per body
  std::vector<std::unique_ptr<Conduction>> conductions_;  ///< per body; null: heat stays where it arises
  std::vector<EnergyDescent> descents_;                   ///< per body, if the run minimises
  bool ends_step_ = false;  ///< whether the next add_velocities() ends the last step or begins the next one
  double repeated_ = 0;     ///< steps that were taken again in halves
};

Descent Solver::descend(double time, double dt) {
  PIOLA_EXPECTS(!descents_.empty());
  Descent all;
  actions_.begin_step(bodies_, dt);
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    bodies_[k]->set_observed(false);
    Descent const one = descents_[k].iterate(time, dt);
    all.unbalanced = std::hypot(all.unbalanced, one.unbalanced);
    all.released += one.released;
  }
  end_step(time + dt);
  return all;
}

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

StepBound Solver::step_bound() const {
  double const step = least_step(&StabilityMonitor::step);
  std::size_t least = 0;
  for (std::size_t k = 1; k < monitors_.size(); ++k)
    if (monitors_[k]->step() < monitors_[least]->step()) least = k;
  if (step < monitors_[least]->step()) return {.step = step, .text = "energy_tolerance"};
  return {.step = step, .text = fmt::format("{}, of body '{}'", step_estimate().limit, bodies_[least]->body().name)};
}

void Solver::add_velocities(std::span<std::int64_t const> ids, std::span<std::array<double, 3> const> change) {
  BodiesSolver::add_velocities(ids, change);
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

void Solver::replicate(NodalBody& body, Index slot) const {
  update_output_fields(body);
  auto const& s = body.state();
  int const D = set_.dimension;
  for (auto const& [field, components] : {std::pair{s.x, D}, {s.v, D}, {s.F, D * D}, {s.cell, 4}})
    allgather_selected_slots(field, body.own(), std::array{slot}, components);
}

void Solver::describe(std::size_t k, FailureSlot const& slot, Failure& f) const {
  NodalBody& body = *bodies_[k];
  if (!comm::is_parallel()) update_output_fields(body);
  double const least = NodalBody::value(body.state().cell, slot.index, 2);
  f.what = slot.code == ImplicitPressure::not_converged
               ? std::string("is in a body whose implicit pressure does not converge")
           : slot.code == AbsorbingSurface::not_converged
               ? std::string("is on a non-reflecting patch whose dashpots do not converge")
           : slot.code >= failure_of_law         ? law_failure_text(body.material(slot.index), slot.code)
           : slot.code == NodalBody::behind_axis ? "is behind the axis (a hole closes?)"
           : least <= 0                          ? "is inverted"
                                                 : "has a deformation that is not a number";
  f.values = {{"least det F in its cell", least},
              {"det F", determinant(body.F(slot.index))},
              {"neighbours", neighbours_of_failed(k, slot.index)},
              {"speed [m/s]", speed_of(body, slot.index)}};
}

RunStatistics Solver::statistics() const {
  RunStatistics all = BodiesSolver::statistics();
  SetUpCosts sum;
  for (auto const& body : bodies_) {
    auto const& checks = body->reference().checks;
    all.set_up_checks.insert(all.set_up_checks.end(), checks.begin(), checks.end());
    auto const& c = body->reference().costs;
    sum = {sum.cells + c.cells, sum.fits + c.fits, sum.gradients + c.gradients, sum.masses + c.masses,
           sum.tables + c.tables};
  }
  all.seconds = {{"set_up_cells", sum.cells},
                 {"set_up_fits", sum.fits},
                 {"set_up_gradients", sum.gradients},
                 {"set_up_masses", sum.masses},
                 {"set_up_tables", sum.tables}};
  return all;
}

void Solver::save(StateWriter& writer) const {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    NodalBody const& body = *bodies_[k];
    save_fields(writer, k);
    failures_[k]->save(writer, fmt::format("body{}_pieces", k));
    writer.put(fmt::format("body{}_step_limit", k), monitors_[k]->state());
    if (!descents_.empty()) writer.put(fmt::format("body{}_direction", k), descents_[k].state());
    writer.put(fmt::format("body{}_energy_books", k),
               std::array{body.boundary().external_work().over_ranks(), body.damping_loss()});
    if (body.boundary().absorbs())
      writer.put(fmt::format("body{}_radiated_energy", k), std::array{body.boundary().radiated_energy()});
  }
  writer.put("actions", actions_.over_ranks(bodies_).state());
  writer.put("time", std::array{time_, repeated_});
}

void Solver::load(StateReader& reader) {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    NodalBody& body = *bodies_[k];
    body.set_observed(false);
    load_fields(reader, k);
    failures_[k]->load(reader, fmt::format("body{}_pieces", k));
    monitors_[k]->load(reader, fmt::format("body{}_step_limit", k));
    tell_frequencies(k);
    if (!descents_.empty()) descents_[k].load(reader, fmt::format("body{}_direction", k));
    std::array<double, 2> energy_totals{};
    reader.get(fmt::format("body{}_energy_books", k), energy_totals);
    body.boundary().external_work().set(energy_totals[0]);
    body.set_damping_loss(energy_totals[1]);
    if (!body.boundary().absorbs()) continue;
    std::array<double, 1> radiated{};
    reader.get(fmt::format("body{}_radiated_energy", k), radiated);
    body.boundary().set_radiated_energy(radiated[0]);
  }
  load_part(reader, "actions", actions_);
  std::array<double, 2> clock{};
  reader.get("time", clock);
  time_ = clock[0];
  repeated_ = clock[1];
  // add_velocities() may precede the next step and needs the held directions.
  for (auto const& body : bodies_) body->boundary().begin_step(body->state(), time_, 0);
}

}  // namespace

std::unique_ptr<Formulation> make(Assembly const& assembly) { return std::make_unique<Solver>(assembly); }

}  // namespace piola::nodal
