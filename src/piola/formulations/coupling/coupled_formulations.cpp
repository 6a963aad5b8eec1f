// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/coupling/coupled_formulations.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/formulations/coupled_particles.hpp"
#include "piola/formulations/coupling/contact_coupling.hpp"
#include "piola/formulations/coupling/prefixed_state.hpp"
#include "piola/mechanics/resultants.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace piola {
namespace {

template <std::size_t N>
void add(std::array<double, N>& sum, std::array<double, N> const& more) {
  for (std::size_t c = 0; c < N; ++c) sum[c] += more[c];
}

/// Adds up columns by name, in the order of their first appearance; of largest values takes the larger one.
void add_columns(std::vector<std::pair<std::string, double>>& sum,
                 std::vector<std::pair<std::string, double>> const& more) {
  for (auto const& column : more) {
    auto const same =
        std::find_if(sum.begin(), sum.end(), [&](auto const& known) { return known.first == column.first; });
    if (same == sum.end())
      sum.push_back(column);
    else if (column.first.ends_with("_max"))
      same->second = std::max(same->second, column.second);
    else
      same->second += column.second;
  }
}

/// The total energy minus external work that does not rise by itself. A formulation whose energies are half a step
/// apart supplies such a sum.
double balanced_energy(Diagnostics const& d) {
  for (auto const& [name, value] : d.more)
    if (name == "centred_energy") return value;
  return d.total_energy();
}

void add_totals(Diagnostics& sum, Diagnostics const& d, bool first) {
  sum.kinetic_energy += d.kinetic_energy;
  sum.strain_energy += d.strain_energy;
  sum.stabilisation_loss += d.stabilisation_loss;
  sum.projection_loss += d.projection_loss;
  sum.external_work += d.external_work;
  sum.damping_loss += d.damping_loss;
  add(sum.linear_momentum, d.linear_momentum);
  add(sum.angular_momentum, d.angular_momentum);
  sum.jacobian_min = first ? d.jacobian_min : std::min(sum.jacobian_min, d.jacobian_min);
  sum.jacobian_max = first ? d.jacobian_max : std::max(sum.jacobian_max, d.jacobian_max);
  sum.pressure_min = first ? d.pressure_min : std::min(sum.pressure_min, d.pressure_min);
  sum.pressure_max = first ? d.pressure_max : std::max(sum.pressure_max, d.pressure_max);
  sum.pressure_oscillation = std::max(sum.pressure_oscillation, d.pressure_oscillation);
  add_columns(sum.more, d.more);
}

/// Not std::min: a step that is not a number must reach the time loop.
double smaller_or_nan(double step, double other) { return std::isnan(step) || other >= step ? step : other; }

class CoupledFormulations : public Formulation, public Observables {
 public:
  CoupledFormulations(Assembly const& whole, std::vector<FormulationGroup> parts,
                      std::vector<std::unique_ptr<Formulation>> formulations)
      : parts_(std::move(parts)),
        formulations_(std::move(formulations)),
        nothing_(whole.supports, whole.loads, whole.rigid_shapes) {
    for (auto const& formulation : formulations_) coupled_.push_back(formulation->coupled_particles());
    if (!whole.surfaces.empty()) contact_ = std::make_unique<ContactCoupling>(whole, parts_);
    if (contact_) contact_->start(coupled_);
    support_count_ = whole.supports.size();
    for (Load const& load : whole.loads) load_count_ += load.name.empty() ? 0 : 1;
    for (FormulationGroup& part : parts_) {
      counts_.push_back(static_cast<double>(part.assembly.particles.size()));
      body_count_ += part.blocks.size();
      part.assembly = Assembly{};  // each formulation keeps its own data
    }
  }

  double stable_time_step() const override {
    double step = std::numeric_limits<double>::infinity();
    for (auto const& formulation : formulations_) step = smaller_or_nan(step, formulation->stable_time_step());
    return contact_ ? contact_->limit(step) : step;
  }
  StepEstimate step_estimate() const override;
  StepBound step_bound() const override;

  /// Contact and ties act before and after the steps of the parts, when all bodies are at the same time.
  void step(double time, double dt) override {
    if (contact_) contact_->begin(coupled_, time, dt);
    for (auto const& formulation : formulations_) formulation->step(time, dt);
    if (contact_) contact_->finish(coupled_, time + dt, dt);
  }
  void damp(double factor) override {
    for (auto const& formulation : formulations_) formulation->damp(factor);
    if (contact_) contact_->damp(factor);
  }
  double kinetic_energy() const override {
    double sum = 0;
    for (auto const& formulation : formulations_) sum += formulation->kinetic_energy();
    return contact_ ? sum + contact_->kinetic_energy() : sum;
  }
  std::vector<RigidState> rigids() const override { return contact_ ? contact_->rigids() : std::vector<RigidState>{}; }
  std::optional<Failure> failure() const override;
  Diagnostics diagnose() const override;
  Observables const& observables() const override { return *this; }
  std::vector<FieldInfo> fields() const override;
  std::vector<FieldInfo> fields_of(std::size_t body) const override;
  void sample(std::string_view field, std::span<double> values) const override;
  std::optional<std::vector<std::int64_t>> local_particles() const override;
  void sample_local(std::string_view field, std::span<double> values) const override;
  void save(StateWriter& writer) const override {
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      PrefixedStateWriter part(writer, parts_[k].name + ".", {k, parts_.size()});
      formulations_[k]->save(part);
    }
    if (contact_) contact_->save(writer);
  }
  void load(StateReader& reader) override {
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      PrefixedStateReader part(reader, parts_[k].name + ".", {k, parts_.size()});
      formulations_[k]->load(part);
    }
    if (!contact_) return;
    contact_->load(reader);
    contact_->start(coupled_);
  }
  RunStatistics statistics() const override;
  CoupledParticles* coupled_particles() override { return nullptr; }

 private:
  std::vector<std::int64_t> owned_of(std::size_t part) const;
  std::vector<Action> actions_of(std::vector<Diagnostics> const& of_parts) const;
  std::vector<FieldInfo> with_contact(std::vector<FieldInfo> all) const;

  std::vector<FormulationGroup> parts_;
  std::vector<std::unique_ptr<Formulation>> formulations_;
  std::vector<CoupledParticles*> coupled_;    ///< of formulations_
  std::unique_ptr<ContactCoupling> contact_;  ///< if there is surface contact
  Resultants nothing_;                        ///< all that can act, in the order of the case, at rest
  std::vector<double> counts_;                ///< particles by part
  std::size_t body_count_ = 0, support_count_ = 0, load_count_ = 0;
};

StepEstimate CoupledFormulations::step_estimate() const {
  StepEstimate rule;
  rule.settled = std::numeric_limits<double>::infinity();
  double first = rule.settled, stable = rule.settled;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    StepEstimate const here = formulations_[k]->step_estimate();
    first = std::min(first, here.first);
    stable = smaller_or_nan(stable, here.stable);
    if (!(here.settled < rule.settled)) continue;
    rule = here;
    rule.limit += " (" + parts_[k].formulation + ")";
  }
  if (double const tied = contact_ ? contact_->settled(rule.settled) : rule.settled; tied < rule.settled) {
    rule.settled = tied;
    rule.limit += ", with ties between bodies";
  }
  rule.first = std::min(first, rule.settled);
  rule.stable = contact_ ? contact_->settled(stable) : stable;
  if (contact_ && contact_->limit(stable) < rule.stable) rule.limit += ", at present also by contact";
  return rule;
}

StepBound CoupledFormulations::step_bound() const {
  StepBound shortest{.step = std::numeric_limits<double>::infinity(), .text = {}};
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    StepBound here = formulations_[k]->observables().step_bound();
    if (!(here.step < shortest.step)) continue;
    if (here.particle >= 0) here.particle = parts_[k].id_in_whole(here.particle);
    shortest = std::move(here);
    shortest.text += " (" + parts_[k].formulation + ")";
  }
  return contact_ ? contact_->bound(std::move(shortest)) : shortest;
}

/// Stages: the mean over all particles. At most one part can repartition.
RunStatistics CoupledFormulations::statistics() const {
  RunStatistics all;
  double stages = 0, particles = 0;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    RunStatistics part = formulations_[k]->statistics();
    stages += counts_[k] * static_cast<double>(part.stages_per_step);
    particles += counts_[k];
    for (auto const& [name, seconds] : part.seconds) all.seconds.emplace_back(parts_[k].name + "_" + name, seconds);
    all.memory_bytes += part.memory_bytes;
    std::move(part.set_up_checks.begin(), part.set_up_checks.end(), std::back_inserter(all.set_up_checks));
    if (!all.repartition) all.repartition = std::move(part.repartition);
  }
  all.stages_per_step = static_cast<int>(std::lround(particles > 0 ? stages / particles : 0));
  all.memory_bytes += contact_ ? contact_->bytes() : 0;
  return all;
}

std::optional<Failure> CoupledFormulations::failure() const {
  std::optional<Failure> first;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    auto here = formulations_[k]->failure();
    if (!here) continue;
    if (here->particle >= 0) here->particle = parts_[k].id_in_whole(here->particle);
    if (!first || here->particle < first->particle) first = std::move(here);
  }
  if (!first && contact_) first = contact_->failure();
  return first;
}

Diagnostics CoupledFormulations::diagnose() const {
  Diagnostics sum;
  sum.bodies.resize(body_count_);
  std::vector<Diagnostics> all;
  double balanced = 0;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    all.push_back(formulations_[k]->diagnose());
    Diagnostics const& d = all.back();
    add_totals(sum, d, k == 0);
    balanced += balanced_energy(d);
    for (std::size_t b = 0; b < std::min(d.bodies.size(), parts_[k].blocks.size()); ++b)
      sum.bodies[parts_[k].blocks[b].body] = d.bodies[b];
  }
  for (auto& [name, value] : sum.more)
    if (name == "centred_energy") value = balanced;
  sum.actions = actions_of(all);
  if (contact_) contact_->report(sum);
  return sum;
}

/// Supports, named loads and rigid shapes in the order of the case, then pairs of bodies in contact. Parts of the same
/// support or shape are summed.
std::vector<Action> CoupledFormulations::actions_of(std::vector<Diagnostics> const& of_parts) const {
  std::vector<Action> sum = contact_ ? contact_->actions() : nothing_.report();
  auto const take = [&](Action const& action, std::size_t place) {
    add(sum[place].force, action.force);
    add(sum[place].moment, action.moment);
  };
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    FormulationGroup const& part = parts_[k];
    std::vector<Action> const& actions = of_parts[k].actions;
    std::size_t next = 0;
    for (std::size_t const s : part.supports)
      if (next < actions.size()) take(actions[next++], s);
    for (std::size_t const l : part.named_loads)
      if (next < actions.size()) take(actions[next++], support_count_ + l);
    for (std::size_t const r : part.rigid_shapes)
      if (next < actions.size()) take(actions[next++], support_count_ + load_count_ + r);
  }
  if (contact_)
    for (Action& pair : contact_->pairs()) sum.push_back(std::move(pair));
  return sum;
}

std::vector<FieldInfo> CoupledFormulations::fields() const {
  std::vector<FieldInfo> all;
  for (auto const& formulation : formulations_)
    for (FieldInfo& info : formulation->observables().fields())
      if (std::none_of(all.begin(), all.end(), [&](FieldInfo const& known) { return known.name == info.name; }))
        all.push_back(std::move(info));
  return with_contact(std::move(all));
}

std::vector<FieldInfo> CoupledFormulations::with_contact(std::vector<FieldInfo> all) const {
  if (contact_)
    for (FieldInfo& info : contact_fields()) all.push_back(std::move(info));
  return all;
}

std::vector<FieldInfo> CoupledFormulations::fields_of(std::size_t body) const {
  for (std::size_t k = 0; k < parts_.size(); ++k)
    if (parts_[k].body_in_part(body)) return with_contact(formulations_[k]->observables().fields());
  return {};
}

/// The field of this name among `fields`, valid during their lifetime; nullptr if there is none.
FieldInfo const* find_field(std::span<FieldInfo const> fields, std::string_view name) {
  auto const found = std::find_if(fields.begin(), fields.end(), [&](FieldInfo const& f) { return f.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

void CoupledFormulations::sample(std::string_view field, std::span<double> values) const {
  bool const wanted = comm::rank() == 0;  // other ranks take part
  std::fill(values.begin(), values.end(), 0.0);
  if (contact_ && contact_->sample(field, values)) return;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    Observables const& part = formulations_[k]->observables();
    auto const fields = part.fields();
    FieldInfo const* const info = find_field(fields, field);
    if (info == nullptr) continue;
    std::vector<double> own(wanted ? static_cast<std::size_t>(counts_[k]) * static_cast<std::size_t>(info->components)
                                   : 0);
    part.sample(field, own);
    if (!wanted) continue;
    for (auto const& block : parts_[k].blocks)
      std::copy_n(own.begin() + block.here * info->components, block.count * info->components,
                  values.begin() + block.there * info->components);
  }
}

std::optional<std::vector<std::int64_t>> CoupledFormulations::local_particles() const {
  if (!comm::is_parallel()) return std::nullopt;
  std::vector<std::int64_t> all;
  for (std::size_t k = 0; k < parts_.size(); ++k)
    for (std::int64_t const id : owned_of(k)) all.push_back(parts_[k].id_in_whole(id));
  return all;
}

void CoupledFormulations::sample_local(std::string_view field, std::span<double> values) const {
  if (!comm::is_parallel()) return sample(field, values);
  auto const width = static_cast<std::size_t>(info_of(fields(), field).components);
  if (contact_ && find_field(contact_fields(), field) != nullptr) {
    double particles = 0;
    for (double const count : counts_) particles += count;
    std::vector<double> all(static_cast<std::size_t>(particles) * width, 0);  // every rank has them
    contact_->sample(field, all);
    auto const mine = *local_particles();
    for (std::size_t k = 0; k < mine.size(); ++k)
      std::copy_n(&all[static_cast<std::size_t>(mine[k]) * width], width, &values[k * width]);
    return;
  }
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    Observables const& part = formulations_[k]->observables();
    auto const ids = part.local_particles();
    auto const here = values.first((ids ? ids->size() : static_cast<std::size_t>(counts_[k])) * width);
    values = values.subspan(here.size());
    if (find_field(part.fields(), field) != nullptr)
      part.sample_local(field, here);
    else
      std::fill(here.begin(), here.end(), 0.0);
  }
}

/// Ids of local particles of a part, numbered in the part.
std::vector<std::int64_t> CoupledFormulations::owned_of(std::size_t part) const {
  if (auto ids = formulations_[part]->observables().local_particles()) return *std::move(ids);
  std::vector<std::int64_t> all(static_cast<std::size_t>(counts_[part]));
  std::iota(all.begin(), all.end(), std::int64_t{0});
  return all;
}

}  // namespace

std::unique_ptr<Formulation> make_coupled_formulations(Assembly const& whole, std::vector<FormulationGroup> parts,
                                                       std::vector<std::unique_ptr<Formulation>> formulations) {
  PIOLA_EXPECTS(!parts.empty() && parts.size() == formulations.size());
  return std::make_unique<CoupledFormulations>(whole, std::move(parts), std::move(formulations));
}

}  // namespace piola
