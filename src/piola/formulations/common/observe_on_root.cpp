// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/common/observe_on_root.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include <utility>

namespace piola {
namespace {

class ReplicatedFormulation final : public Formulation {
 public:
  explicit ReplicatedFormulation(std::unique_ptr<Formulation> formulation) : formulation_(std::move(formulation)) {}

  double stable_time_step() const override { return of().stable_time_step(); }
  double steady_time_step() const override { return of().steady_time_step(); }
  StepEstimate step_estimate_of_run() const override { return of().step_estimate_of_run(); }
  void step(double time, double dt) override { of().step(time, dt); }
  void damp(double factor) override { of().damp(factor); }
  double kinetic_energy() const override { return of().kinetic_energy(); }
  void read_motion(std::span<std::int64_t const> ids, std::span<std::array<double, 3>> x,
                   std::span<std::array<double, 3>> v) const override {
    of().read_motion(ids, x, v);
  }
  void read_masses(std::span<std::int64_t const> ids, std::span<double> m) const override { of().read_masses(ids, m); }
  void add_velocities(std::span<std::int64_t const> ids, std::span<std::array<double, 3> const> change) override {
    of().add_velocities(ids, change);
  }
  std::vector<RigidState> rigids() const override { return of().rigids(); }
  std::optional<Failure> failure() const override { return of().failure(); }
  Diagnostics diagnose() const override { return comm::rank() == 0 ? of().diagnose() : Diagnostics{}; }
  std::vector<FieldInfo> fields() const override { return of().fields(); }
  std::vector<FieldInfo> fields_of(std::size_t body) const override { return of().fields_of(body); }
  void sample(std::string_view field, std::span<double> values) const override {
    if (comm::rank() == 0) of().sample(field, values);
  }
  void save(StateWriter& writer) const override {
    if (comm::rank() == 0) of().save(writer);
  }
  void load(StateReader& reader) override { of().load(reader); }
  int stages_per_step() const override { return of().stages_per_step(); }
  std::vector<std::pair<std::string, double>> timings() const override { return of().timings(); }
  std::size_t memory_bytes() const override { return of().memory_bytes(); }
  std::optional<RepartitionStatistics> repartition_statistics() const override { return of().repartition_statistics(); }

 private:
  Formulation& of() const { return *formulation_; }
  std::unique_ptr<Formulation> formulation_;
};

}  // namespace

std::unique_ptr<Formulation> observe_on_root(std::unique_ptr<Formulation> formulation) {
  PIOLA_EXPECTS(formulation != nullptr);
  if (!comm::is_parallel()) return formulation;
  return std::make_unique<ReplicatedFormulation>(std::move(formulation));
}

}  // namespace piola
