// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/observed_by_first.hpp"
#include "piola/parallel/ranks.hpp"
#include <utility>

namespace piola {
namespace {

class ObservedByFirst final : public Formulation {
 public:
  explicit ObservedByFirst(std::unique_ptr<Formulation> formulation) : formulation_(std::move(formulation)) {}

  double stable_time_step() const override { return of().stable_time_step(); }
  double settled_time_step() const override { return of().settled_time_step(); }
  StepRule step_rule() const override { return of().step_rule(); }
  void step(double time, double dt) override { of().step(time, dt); }
  void damp(double factor) override { of().damp(factor); }
  double kinetic_energy() const override { return of().kinetic_energy(); }
  void read_motion(std::span<std::int64_t const> ids, std::span<std::array<double, 3>> x,
                   std::span<std::array<double, 3>> v) const override {
    of().read_motion(ids, x, v);
  }
  void read_masses(std::span<std::int64_t const> ids, std::span<double> m) const override { of().read_masses(ids, m); }
  void push(std::span<std::int64_t const> ids, std::span<std::array<double, 3> const> change) override {
    of().push(ids, change);
  }
  std::vector<RigidState> rigids() const override { return of().rigids(); }
  std::optional<Failure> failure() const override { return of().failure(); }
  Diagnostics diagnose() const override { return ranks::own() == 0 ? of().diagnose() : Diagnostics{}; }
  std::vector<FieldInfo> fields() const override { return of().fields(); }
  std::vector<FieldInfo> fields_of(std::size_t body) const override { return of().fields_of(body); }
  void sample(std::string_view field, std::span<double> values) const override {
    if (ranks::own() == 0) of().sample(field, values);
  }
  void save(StateWriter& writer) const override {
    if (ranks::own() == 0) of().save(writer);
  }
  void load(StateReader& reader) override { of().load(reader); }
  int stages_per_step() const override { return of().stages_per_step(); }
  std::vector<std::pair<std::string, double>> costs() const override { return of().costs(); }
  std::size_t memory_bytes() const override { return of().memory_bytes(); }
  std::optional<Talk> talk(std::size_t body) const override { return of().talk(body); }
  std::optional<Recuts> recuts() const override { return of().recuts(); }

 private:
  Formulation& of() const { return *formulation_; }
  std::unique_ptr<Formulation> formulation_;
};

}  // namespace

std::unique_ptr<Formulation> observed_by_first(std::unique_ptr<Formulation> formulation) {
  if (!ranks::several()) return formulation;
  return std::make_unique<ObservedByFirst>(std::move(formulation));
}

}  // namespace piola
