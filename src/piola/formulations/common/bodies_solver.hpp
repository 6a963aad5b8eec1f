// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/domain/slot_collectives.hpp"
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/common/body_resultants.hpp"
#include "piola/formulations/common/field_checkpoint.hpp"
#include "piola/formulations/common/sample_local.hpp"
#include "piola/formulations/common/slots_by_id.hpp"
#include "piola/formulations/coupled_particles.hpp"
#include "piola/formulations/formulation.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace piola {

/// One or more bodies of one formulation that do not touch each other, distributed over ranks by slots: what does not
/// depend on the scheme. Derived solvers make the bodies, take the steps, and add their own state to checkpoints.
///
/// A Body owns its fields and visits the evolved ones: each_evolved(). Where contact or ties act on it, all ranks know
/// the masses of all particles: replicated_mass(). Its namespace has add_diagnostics(), finish(), sample_on_root() and
/// sample_local_slots(). A Monitor measures the step limit of one body.
template <class Body, class Monitor>
class BodiesSolver : public Formulation, public Observables, public CoupledParticles {
 public:
  double kinetic_energy() const final {
    return sum_over_bodies(bodies_, [](auto const& body) { return body.kinetic_energy(); });
  }
  std::optional<Failure> failure() const final;
  RunStatistics statistics() const override {
    RunStatistics all;
    all.memory_bytes = set_.bytes();
    for (auto const& body : bodies_) all.memory_bytes += body->bytes();
    for (auto const& monitor : monitors_) all.memory_bytes += monitor ? monitor->bytes() : 0;
    return all;
  }

  Observables const& observables() const final { return *this; }
  std::vector<FieldInfo> fields_of(std::size_t /*body*/) const final { return fields(); }
  void sample(std::string_view field, std::span<double> values) const final {
    int number = 0;
    for (auto const& body : bodies_) {
      update_output_fields(*body);
      sample_on_root(std::as_const(*body), number++, field, values);
    }
  }
  std::optional<std::vector<std::int64_t>> local_particles() const final {
    if (!comm::is_parallel()) return std::nullopt;
    std::vector<std::int64_t> ids;
    for (auto const& body : bodies_)
      for (Index i = body->own().first; i < body->own().last; ++i) ids.push_back(body->id(i));
    return ids;
  }
  void sample_local(std::string_view field, std::span<double> values) const final;
  std::vector<RigidState> rigids() const final { return {}; }

  CoupledParticles* coupled_particles() final { return this; }
  /// Collective.
  void read_motion(std::span<std::int64_t const> ids, std::span<std::array<double, 3>> x,
                   std::span<std::array<double, 3>> v) const final;
  void read_masses(std::span<std::int64_t const> ids, std::span<double> m) const final {
    PIOLA_EXPECTS(m.size() == ids.size());
    slots_.visit(ids,
                 [&](std::size_t k, std::size_t body, Index slot) { m[k] = bodies_[body]->replicated_mass(slot); });
  }
  /// Changes of particles of other ranks have no effect.
  void add_velocities(std::span<std::int64_t const> ids, std::span<std::array<double, 3> const> change) override;

 protected:
  explicit BodiesSolver(Assembly const& assembly)
      : set_(assembly.particles), actions_(assembly.supports, assembly.loads, assembly.rigid_shapes) {}

  /// Computes the fields of a body that output needs and steps do not; the state for steps is unchanged. Collective if
  /// it is distributed.
  virtual void update_output_fields(Body& body) const = 0;
  /// The first failed particle of a body as this rank knows it.
  virtual FailureSlot failed_particle(std::size_t body) const { return *bodies_[body]->state().failure; }
  /// Gives a failure its text and values.
  virtual void describe(std::size_t body, FailureSlot const& slot, Failure& failure) const = 0;
  /// Replicates the values of one particle that describe() uses. Collective.
  virtual void replicate(Body& body, Index slot) const = 0;
  /// Number of neighbours of a local particle.
  virtual double neighbours_of(Body const& body, Index slot) const = 0;

  /// Calls replicate() for the first failed particle of each body. Collective.
  void replicate_failures();
  double neighbours_of_failed(std::size_t body, Index slot) const {
    if (!failed_neighbours_.empty()) return failed_neighbours_[body];
    return is_local(*bodies_[body], slot) ? neighbours_of(*bodies_[body], slot) : 0;
  }
  static bool is_local(Body const& body, Index slot) { return slot >= body.own().first && slot < body.own().last; }
  static double speed_of(Body const& body, Index slot) {  ///< [m/s]
    auto const v = body.v(slot);
    return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  }
  /// Adds all bodies to a DiagnosticsSum of the scheme and finishes it. Collective.
  template <class Sum>
  Diagnostics diagnose_from(Sum all) const {
    for (auto const& body : bodies_) {
      update_output_fields(*body);
      add_diagnostics(std::as_const(*body), all);
    }
    Diagnostics d = finish(std::move(all));
    d.actions = actions_.over_ranks(bodies_).report();
    return d;
  }
  /// The evolved fields of a body in checkpoints. Collective.
  void save_fields(StateWriter& writer, std::size_t body) const {
    Body const& from = *bodies_[body];
    from.each_evolved([&](std::string_view name, FieldRef const& field, int components) {
      save_local(writer, fmt::format("body{}_{}", body, name), from, field, components);
    });
  }
  void load_fields(StateReader& reader, std::size_t body) {
    Body const& to = *bodies_[body];
    to.each_evolved([&](std::string_view name, FieldRef const& field, int components) {
      load_local(reader, fmt::format("body{}_{}", body, name), to, field, components);
    });
  }

  /// StepEstimate::limit of bodies with monitors.
  static constexpr char const* measured_limit =
      "the stability limit of the fastest mode, measured (run.cfl, without a default here, would replace it)";

  ParticleSet set_;
  ActionsOnBodies actions_;
  std::vector<std::unique_ptr<Body>> bodies_;
  std::vector<std::unique_ptr<Monitor>> monitors_;  ///< per body, or nullptr where the case prescribes the step
  SlotsById slots_;                                 ///< if contact or ties act on the bodies
  double time_ = 0;                                 ///< at the end of the last step [s]

 private:
  std::vector<double> failed_neighbours_;  ///< on ranks, per body: of the first particle that failed
};

template <class Body, class Monitor>
std::optional<Failure> BodiesSolver<Body, Monitor>::failure() const {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    Body const& body = *bodies_[k];
    FailureSlot const slot = failed_particle(k);
    if (slot.index >= body.particles()) continue;
    Failure f;
    f.particle = body.id(slot.index);
    f.body = body.body().name;
    f.X = body.X(slot.index);
    f.x = body.x(slot.index);
    describe(k, slot, f);
    return f;
  }
  return std::nullopt;
}

template <class Body, class Monitor>
void BodiesSolver<Body, Monitor>::replicate_failures() {
  failed_neighbours_.assign(bodies_.size(), 0);
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    Body& body = *bodies_[k];
    FailureSlot found = failed_particle(k);
    allreduce_first_failure(found);
    if (found.index >= body.particles()) continue;
    *body.state().failure = found;
    replicate(body, found.index);
    if (is_local(body, found.index)) failed_neighbours_[k] = neighbours_of(body, found.index);
  }
  comm::allreduce_or(failed_neighbours_);
}

template <class Body, class Monitor>
void BodiesSolver<Body, Monitor>::sample_local(std::string_view field, std::span<double> values) const {
  if (!comm::is_parallel()) return sample(field, values);
  auto const components = static_cast<std::size_t>(info_of(fields(), field).components);
  int number = 0;
  for (auto const& body : bodies_) {
    auto const numbers = static_cast<std::size_t>(body->own().last - body->own().first) * components;
    update_output_fields(*body);
    sample_local_slots(std::as_const(*body), number++, field, values.first(numbers));
    values = values.subspan(numbers);
  }
}

template <class Body, class Monitor>
void BodiesSolver<Body, Monitor>::read_motion(std::span<std::int64_t const> ids, std::span<std::array<double, 3>> x,
                                              std::span<std::array<double, 3>> v) const {
  PIOLA_EXPECTS(x.size() == ids.size() && v.size() == ids.size());
  std::vector<Range> own;
  for (auto const& body : bodies_) own.push_back(body->own());
  slots_.parallel_visit(ids, [&](std::size_t k, std::size_t body, Index slot) {
    bool const mine = slot >= own[body].first && slot < own[body].last;
    x[k] = mine ? bodies_[body]->x(slot) : std::array<double, 3>{};
    v[k] = mine ? bodies_[body]->v(slot) : std::array<double, 3>{};
  });
  if (!comm::is_parallel()) return;
  std::vector<std::array<double, 3>> both(x.begin(), x.end());
  both.insert(both.end(), v.begin(), v.end());
  static_assert(sizeof(both[0]) == 3 * sizeof(double));
  if (!both.empty()) comm::allreduce_or({both.front().data(), 3 * both.size()});
  auto const middle = both.begin() + static_cast<std::ptrdiff_t>(x.size());
  std::copy(both.begin(), middle, x.begin());
  std::copy(middle, both.end(), v.begin());
}

template <class Body, class Monitor>
void BodiesSolver<Body, Monitor>::add_velocities(std::span<std::int64_t const> ids,
                                                 std::span<std::array<double, 3> const> change) {
  PIOLA_EXPECTS(change.size() == ids.size());
  slots_.visit(ids, [&](std::size_t k, std::size_t body, Index slot) {
    for (int c = 0; c < set_.dimension; ++c)
      value_at(bodies_[body]->state().v, slot, c) += change[k][static_cast<std::size_t>(c)];
  });
}

}  // namespace piola
