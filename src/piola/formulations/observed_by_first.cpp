// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/observed_by_first.hpp"
#include "piola/parallel/ranks.hpp"
#include <utility>

namespace piola {
namespace {

class ObservedByFirst final : public Formulation {
 public:
  explicit ObservedByFirst(std::unique_ptr<Formulation> formulation) : part_{std::move(formulation)} {}

  double stable_time_step() const override { return part_.of().stable_time_step(); }
  double settled_time_step() const override { return part_.of().settled_time_step(); }
  StepRule step_rule() const override { return part_.of().step_rule(); }
  void step(double time, double dt) override { part_.changed().step(time, dt); }
  void damp(double factor) override { part_.changed().damp(factor); }
  double kinetic_energy() const override { return part_.of().kinetic_energy(); }
  void read_motion(std::span<std::int64_t const> ids, std::span<std::array<double, 3>> x,
                   std::span<std::array<double, 3>> v) const override {
    part_.of().read_motion(ids, x, v);
  }
  void read_masses(std::span<std::int64_t const> ids, std::span<double> m) const override {
    part_.of().read_masses(ids, m);
  }
  void push(std::span<std::int64_t const> ids, std::span<std::array<double, 3> const> change) override {
    part_.changed().push(ids, change);
  }
  std::vector<RigidState> rigids() const override { return part_.of().rigids(); }
  std::optional<Failure> failure() const override { return part_.of().failure(); }
  Diagnostics diagnose() const override {
    part_.gather();
    return ranks::own() == 0 ? part_.of().diagnose() : Diagnostics{};
  }
  std::vector<FieldInfo> fields() const override { return part_.of().fields(); }
  std::vector<FieldInfo> fields_of(std::size_t body) const override { return part_.of().fields_of(body); }
  void sample(std::string_view field, std::span<double> values) const override {
    part_.gather();
    if (ranks::own() == 0) part_.of().sample(field, values);
  }
  void save(StateWriter& writer) const override {
    part_.gather();
    if (ranks::own() == 0) part_.of().save(writer);
  }
  void load(StateReader& reader) override { part_.changed().load(reader); }
  int stages_per_step() const override { return part_.of().stages_per_step(); }
  std::vector<std::pair<std::string, double>> costs() const override { return part_.of().costs(); }
  std::size_t memory_bytes() const override { return part_.of().memory_bytes(); }
  std::optional<Talk> talk(std::size_t body) const override { return part_.of().talk(body); }
  std::optional<Recuts> recuts() const override { return part_.of().recuts(); }

 private:
  /// Observers see a formulation as const, but its memory on rank 0 is not.
  class Part {
   public:
    explicit Part(std::unique_ptr<Formulation> formulation) : state_(std::make_unique<State>()) {
      state_->formulation = std::move(formulation);
    }
    Formulation& of() const { return *state_->formulation; }
    Formulation& changed() const {
      state_->gathered = false;
      return of();
    }
    void gather() const {
      if (!state_->gathered) of().gather();
      state_->gathered = true;
    }

   private:
    struct State {
      std::unique_ptr<Formulation> formulation;
      bool gathered = false;  ///< rank 0 has all particles as they are now
    };
    std::unique_ptr<State> state_;
  };
  Part part_;
};

}  // namespace

std::unique_ptr<Formulation> observed_by_first(std::unique_ptr<Formulation> formulation) {
  if (!ranks::several()) return formulation;
  return std::make_unique<ObservedByFirst>(std::move(formulation));
}

}  // namespace piola
