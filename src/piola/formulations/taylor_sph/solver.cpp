// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/taylor_sph/solver.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/formulations/common/body_resultants.hpp"
#include "piola/formulations/common/diagnostics_sum.hpp"
#include "piola/formulations/common/field_checkpoint.hpp"
#include "piola/formulations/coupled_particles.hpp"
#include "piola/formulations/taylor_sph/body.hpp"
#include "piola/formulations/taylor_sph/observe.hpp"
#include "piola/formulations/taylor_sph/options.hpp"
#include "piola/materials/laws.hpp"
#include "piola/mechanics/prescribed.hpp"
#include "piola/mechanics/resultants.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace piola::taylor_sph {
namespace {

void check(Assembly const& assembly) {
  Problems problems;
  for (auto const& material : assembly.materials)
    with_law(material, [&](auto const& law) {
      using Law = std::decay_t<decltype(law)>;
      if constexpr (!RateForm<Law>)
        problems.add(
            {}, fmt::format("taylor_sph: the law {} has no rate form (allowed: {}) - choose another law or formulation",
                            Law::name, joined(info().laws)));
    });
  if (!assembly.initial_deformation_gradient.empty())
    problems.add({}, "taylor_sph: there is an initial deformation gradient (stress starts at zero here) - remove it");
  problems.raise_if_any();
}

/// Taylor-SPH of one or more independent bodies.
class Solver final : public Formulation, public SingleRankObservables, public CoupledParticles {
 public:
  explicit Solver(Assembly const& assembly)
      : particles_(assembly.particles.size()),
        D_(assembly.particles.dimension),
        actions_(assembly.supports, assembly.loads, assembly.rigid_shapes) {
    Backend const& backend = choose_backend(assembly.backend.c_str());
    for (std::size_t k = 0; k < assembly.particles.bodies.size(); ++k) {
      bool const whole = is_whole_lattice(assembly.particles, assembly.particles.bodies[k]);
      Options const options = read_options(assembly.formulations[k], D_, assembly.cfl, whole);
      bodies_.push_back(std::make_unique<TaylorBody>(assembly, k, options, backend));
    }
    set_ = assembly.particles;
  }

  double stable_time_step() const override { return clip_step_to_end_time_of(bodies_, time_, step_limit()); }
  StepEstimate step_estimate() const override {
    StepEstimate rule;
    rule.stable = rule.settled = rule.first = step_limit();
    rule.limit = fmt::format("waves: run.cfl spacing / c with run.cfl = {}", bodies_.front()->options().cfl);
    return rule;
  }
  StepBound step_bound() const override {
    auto const& least =
        *std::ranges::min_element(bodies_, {}, [](auto const& body) { return body->stable_time_step(); });
    return {.step = step_limit(), .text = step_estimate().limit + fmt::format(", of body '{}'", least->body().name)};
  }
  void step(double time, double dt) override {
    actions_.begin(dt);
    for (auto const& body : bodies_) {
      body->step(time, dt);
      body->add_actions(actions_);
    }
    time_ = time + dt;
  }

  void damp(double factor) override {
    for (auto const& body : bodies_) body->damp(factor);
  }
  CoupledParticles* coupled_particles() override { return this; }
  void read_motion(std::span<std::int64_t const> ids, std::span<std::array<double, 3>> x,
                   std::span<std::array<double, 3>> v) const override {
    visit(ids, [&](std::size_t k, TaylorBody const& body, Index i) {
      x[k] = body.particles().place(i);
      v[k] = body.particles().v(i);
    });
  }
  void read_masses(std::span<std::int64_t const> ids, std::span<double> m) const override {
    visit(ids, [&](std::size_t k, TaylorBody const& body, Index i) { m[k] = body.particles().mass(i); });
  }
  void add_velocities(std::span<std::int64_t const> ids, std::span<std::array<double, 3> const> change) override {
    visit(ids, [&](std::size_t k, TaylorBody& body, Index i) { body.add_velocities(i, change[k]); });
    for (auto const& body : bodies_) body->velocities_changed();
  }
  double kinetic_energy() const override {
    return sum_over_bodies(bodies_, [](auto const& body) { return body.kinetic_energy(); });
  }

  std::optional<Failure> failure() const override;
  Diagnostics diagnose() const override {
    DiagnosticsSum all;
    std::array<double, 5> more{};
    for (auto const& body : bodies_) {
      add_diagnostics(*body, set_, all);
      more[0] += body->state().filter_loss + body->state().exchange_loss;
      more[1] += static_cast<double>(body->remeshing().list_updates);
      more[2] += static_cast<double>(body->remeshing().triangulations);
      more[3] += body->staggering_energy();
      for (double const p : strain_drift(*body)) more[4] = std::max(more[4], p);
    }
    Diagnostics d = all.finish();
    d.stabilisation_loss = more[0];
    d.actions = actions_.report();
    d.more = {{"list_updates", more[1]},
              {"triangulations", more[2]},
              {"centred_energy", d.total_energy() - more[3]},
              {"strain_drift", more[4]}};
    return d;
  }

  Observables const& observables() const override { return *this; }
  std::vector<FieldInfo> fields() const override { return output_field_names(); }
  void sample(std::string_view field, std::span<double> values) const override {
    for (std::size_t k = 0; k < bodies_.size(); ++k)
      taylor_sph::sample(*bodies_[k], static_cast<int>(k), field, values);
  }

  void save(StateWriter& writer) const override;
  void load(StateReader& reader) override;

  RunStatistics statistics() const override {
    SetupSeconds sum;
    for (auto const& body : bodies_) {
      sum.triangulation += body->seconds().triangulation;
      sum.lists += body->seconds().lists;
    }
    RunStatistics all;
    all.stages_per_step = 2;
    all.seconds = {{"triangulation", sum.triangulation}, {"neighbour_lists", sum.lists}};
    all.memory_bytes = sum_over_bodies(bodies_, [](auto const& body) { return body.bytes(); });
    return all;
  }

 private:
  /// The smallest stable step of all bodies [s].
  double step_limit() const {
    double dt = std::numeric_limits<double>::infinity();
    for (auto const& body : bodies_) dt = std::min(dt, body->stable_time_step());
    return dt;
  }
  /// f(k, body, its particle) for each ids[k].
  template <class F>
  void visit(std::span<std::int64_t const> ids, F const& f) const {
    for (std::size_t k = 0; k < ids.size(); ++k) {
      auto const body = static_cast<std::size_t>(set_.body[static_cast<std::size_t>(ids[k])]);
      f(k, *bodies_[body], static_cast<Index>(ids[k] - set_.bodies[body].first));
    }
  }

  std::int64_t particles_;
  int D_;
  ParticleSet set_;
  Resultants actions_;
  std::vector<std::unique_ptr<TaylorBody>> bodies_;
  double time_ = 0;  ///< at the end of the last step [s]
};

std::optional<Failure> Solver::failure() const {
  for (auto const& body : bodies_) {
    FailureSlot const& slot = *body->state().failure;
    bool const wild = slot.index != FailureSlot::none;
    if (!wild && !body->detached() && !body->inverted()) continue;
    Index const i = wild               ? body->particles().particle_in(slot.index)
                    : body->detached() ? body->detached()->particle
                                       : body->worst_corner();
    Failure f;
    f.what = wild               ? "has a velocity or stress that is not a number"
             : body->detached() ? body->detached()->what
                                : "is at a cell that is turned inside out, crushed or torn";
    f.particle = body->body().first + i;
    f.body = body->body().name;
    f.X = body->particles().X(i);
    f.x = body->particles().x(i);
    auto const v = body->particles().v(i);
    f.values = {{"rho0 / rho", body->particles().volume_ratio(i)},
                {"virtual neighbours", body->neighbours(i)},
                {"speed [m/s]", std::hypot(v[0], v[1], v[2])},
                {"cfl", body->options().cfl}};
    return f;
  }
  return std::nullopt;
}

void Solver::save(StateWriter& writer) const {
  for (std::size_t k = 0; k < bodies_.size(); ++k) save_body(*bodies_[k], k, writer);
  writer.put("time", std::array{time_});
  writer.put("actions", actions_.state());
}

void Solver::load(StateReader& reader) {
  for (std::size_t k = 0; k < bodies_.size(); ++k) load_body(*bodies_[k], k, reader);
  std::array<double, 1> time{};
  reader.get("time", time);
  time_ = time[0];
  load_part(reader, "actions", actions_);
}

}  // namespace

std::unique_ptr<Formulation> make(Assembly const& assembly) {
  check(assembly);
  return std::make_unique<Solver>(assembly);
}

}  // namespace piola::taylor_sph
