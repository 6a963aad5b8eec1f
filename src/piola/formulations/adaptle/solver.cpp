// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/solver.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/formulations/adaptle/observe.hpp"
#include "piola/formulations/adaptle/options.hpp"
#include "piola/formulations/adaptle/particles.hpp"
#include "piola/formulations/adaptle/step_bound.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include "piola/formulations/common/field_checkpoint.hpp"
#include "piola/formulations/coupled_particles.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include "piola/mechanics/prescribed.hpp"
#include <cmath>
#include <fmt/format.h>

namespace piola::adaptle {
namespace {

/// Eulerian particles on the axis would form a jet.
void check_axis(Assembly const& assembly, Problems& problems) {
  if (!assembly.particles.axisymmetric) return;
  if (comm::is_parallel())
    problems.add({},
                 "adaptle: geometry is \"axisymmetric\", and the run has several ranks (allowed: one, with threads) "
                 "- run it without mpirun");
  for (std::size_t b = 0; b < assembly.formulations.size(); ++b) {
    Body const& body = assembly.particles.bodies[b];
    bool const turns = !assembly.formulations[b].says("description", "total_lagrangian");
    for (auto id = body.first; turns && id < body.last; ++id) {
      if (assembly.particles.X[at(id)][0] > 1e-3 * body.spacing[0]) continue;
      problems.add({}, fmt::format("adaptle: geometry is \"axisymmetric\", and body \"{}\" has particles on the axis "
                                   "that may turn Eulerian (allowed: half a spacing beside it) - give a box "
                                   "body.shape.placement = \"cell_centred\", a disc a body.shape.spacing that divides "
                                   "its diameter by an even number",
                                   body.name));
      break;
    }
  }
}

void check(Assembly const& assembly) {
  Problems problems;
  for (std::size_t b = 0; b < assembly.materials.size(); ++b)
    if (!is_hypoelastic(assembly.materials[b]))
      problems.add({},
                   fmt::format("adaptle: the law of body \"{}\" has no rate form (allowed: {}) - choose another law or "
                               "formulation",
                               assembly.particles.bodies[b].name, joined(info().laws)));
  for (std::size_t b = 0; b < assembly.materials.size(); ++b)
    with_solid(assembly.materials[b], [&](auto const& law) {
      if (law.yield_stress({}, 0, law.kappa) > 0) return;
      problems.add(
          {}, fmt::format("adaptle: the material of body \"{}\" has no strength{}", assembly.particles.bodies[b].name,
                          law.brittle ? " under pressure (allowed: hugoniot_elastic_limit above pressure_at_limit) - "
                                        "check both"
                                      : " (allowed: a stress above 0 at which it yields) - give it one, such as "
                                        "athermal_stress or yield_stress"));
    });
  if (!assembly.initial_deformation_gradient.empty())
    problems.add({},
                 "adaptle: there is an initial deformation gradient (deformation follows from positions here) - "
                 "give initial_displacement instead");
  check_axis(assembly, problems);
  for (Support const& support : assembly.supports)
    if (support.frame != Support::Frame::axes)
      problems.add({}, "adaptle: a support has a normal (allowed: fix along axes) - use fix, or a rigid plane");
  for (Load const& load : assembly.loads)
    if (load.follows)
      problems.add({},
                   "adaptle: a pressure follows the deformed face (allowed: pressures along the normal of the start) - "
                   "remove follower, or take nodal, jst_sph or taylor_sph");
  problems.raise_if_any();
}

class Solver final : public Formulation, public Observables, public CoupledParticles {
 public:
  explicit Solver(Assembly const& assembly)
      : set_(assembly.particles),
        particles_(assembly, read_options(assembly), choose_backend(assembly.backend.c_str())) {}

  double stable_time_step() const override {
    double const time = particles_.energy_totals().time;
    return clip_step_to_end_time(particles_.stable_time_step(), particles_.boundary().next_end_time(time) - time);
  }
  StepEstimate step_estimate() const override {
    StepEstimate rule;
    rule.stable = rule.settled = rule.first = particles_.stable_time_step();
    rule.limit =
        fmt::format("waves: run.cfl h / c with run.cfl = {}; in the run also by viscosity, accelerations and contact",
                    particles_.system().settings.cfl);
    return rule;
  }
  StepBound step_bound() const override { return find_step_bound(particles_); }
  void step(double time, double dt) override { particles_.step(time, dt); }
  void damp(double factor) override { particles_.damp(factor); }
  CoupledParticles* coupled_particles() override { return this; }
  void read_motion(std::span<std::int64_t const> ids, std::span<std::array<double, 3>> x,
                   std::span<std::array<double, 3>> v) const override {
    particles_.read_motion(ids, x, v);
  }
  void read_masses(std::span<std::int64_t const> ids, std::span<double> m) const override {
    for (std::size_t k = 0; k < ids.size(); ++k) m[k] = particles_.data().contact_mass(ids[k]);
  }
  void add_velocities(std::span<std::int64_t const> ids, std::span<std::array<double, 3> const> change) override {
    for (std::size_t k = 0; k < ids.size(); ++k) {
      auto const slot = static_cast<Index>(ids[k]);
      if (!particles_.system().is_local(slot)) continue;
      for (std::size_t c = 0; c < 3; ++c) particles_.fields().v.at(slot, static_cast<int>(c)) += change[k][c];
    }
  }
  std::int64_t surfaces_lost() const override { return particles_.lost_surfaces().count(); }
  bool has_lost_surface(std::int64_t id) const override {
    auto const& lost = particles_.lost_surfaces().by_slot();
    return !lost.empty() && lost[at(id)] != 0;
  }
  double kinetic_energy() const override { return particles_.kinetic_energy(); }
  std::optional<Failure> failure() const override;
  Diagnostics diagnose() const override { return observe(particles_, set_); }
  Observables const& observables() const override { return *this; }
  std::vector<FieldInfo> fields() const override { return output_field_names(); }
  std::vector<FieldInfo> fields_of(std::size_t /*body*/) const override { return fields(); }
  std::vector<RigidState> rigids() const override { return {}; }
  void sample(std::string_view field, std::span<double> values) const override {
    adaptle::sample(particles_, field, values);
  }
  std::optional<std::vector<std::int64_t>> local_particles() const override {
    return comm::is_parallel() ? std::optional(particles_.distribution().partition().ids()) : std::nullopt;
  }
  void sample_local(std::string_view field, std::span<double> values) const override {
    comm::is_parallel() ? adaptle::sample_local_slots(particles_, field, values) : sample(field, values);
  }
  void save(StateWriter& writer) const override;
  void load(StateReader& reader) override;
  RunStatistics statistics() const override {
    StepTimings const& s = particles_.seconds();
    RunStatistics all;
    all.seconds = {
        {"neighbour_lists", s.lists}, {"sweeps", s.sweeps}, {"points", s.points}, {"conversion", s.conversion}};
    all.memory_bytes = particles_.bytes();
    all.repartition = particles_.distribution().statistics();
    return all;
  }

 private:
  /// The rows of a field of the local particles, whose ids are given.
  DistributedRows rows_of(int components, std::vector<Index> const& ids) const {
    return {0, particles_.system().particles, ids, components};
  }
  std::vector<Index> local_ids() const {
    auto const ids = particles_.distribution().partition().ids();
    return {ids.begin(), ids.end()};
  }
  /// f(value, slot, component) for a field of the particles of this rank.
  template <class Values, class F>
  void each_value(int components, Values& mine, F const& f) const {
    auto const width = at(components);
    particles_.distribution().partition().each(comm::rank(), [&](Index i, std::size_t k) {
      for (std::size_t c = 0; c < width; ++c) f(mine[k * width + c], i, static_cast<int>(c));
    });
  }

  ParticleSet set_;
  Particles particles_;
};

std::optional<Failure> Solver::failure() const {
  FailureSlot const& slot = particles_.failure();
  System const& s = particles_.system();
  bool const neighbour_overflow = particles_.neighbour_overflow();
  if (slot.index == FailureSlot::none && !neighbour_overflow) return std::nullopt;
  Index const i = slot.index == FailureSlot::none ? 0 : slot.index;
  Fields const& p = particles_.fields();
  Failure f;
  f.what = neighbour_overflow              ? "has more than 4096 neighbours"
           : slot.code == not_a_number     ? "has a position, velocity or stress that is not a number"
           : slot.code == negative_density ? "has no positive density"
                                           : "is inverted";
  f.particle = i;
  f.body = set_.bodies[static_cast<std::size_t>(s.body_of[i])].name;
  f.X = point_at(s.field.X, i, 3);
  f.x = point_at(s.field.x, i, 3);
  auto const v = point_at(s.field.v, i, 3);
  f.values = {{"rho / rho0", p.rho.at(i) / s.body[s.body_of[i]].rho0},
              {"KernelType", p.phi.at(i)},
              {"speed [m/s]", std::hypot(v[0], v[1], v[2])},
              {"damage", p.damage.at(i)},
              {"plastic strain", p.plastic_strain.at(i)},
              {"contact overlap", particles_.energy_totals().overlap}};
  return f;
}

void Solver::save(StateWriter& writer) const {
  std::vector<Index> const ids = local_ids();
  ParticleData const& data = particles_.data();
  data.each_saved([&](FieldRef const& field, int components) {
    std::vector<double> mine(ids.size() * at(components));
    each_value(components, mine,
               [&](double& value, Index i, int c) { value = data.is_saved(field, i) ? value_at(field, i, c) : 0; });
    writer.put_rows(field.name, rows_of(components, ids), mine);
  });
  writer.put("books", particles_.energy_totals().state());
  writer.put("rigid_centres", particles_.boundary().rigid_shapes().centres());
  writer.put("actions", particles_.boundary().resultants().state());
}

/// Kernel types are replicated.
void Solver::load(StateReader& reader) {
  ParticleData const& data = particles_.data();
  std::vector<Index> const ids = local_ids();
  data.each_saved([&](FieldRef const& field, int components) {
    if (data.is_replicated(field)) {
      std::vector<double> all(at(particles_.system().particles));
      reader.get(field.name, all);
      for (Index i = 0; i < particles_.system().particles; ++i) value_at(field, i) = all[at(i)];
      return;
    }
    std::vector<double> mine(ids.size() * at(components));
    reader.get_rows(field.name, rows_of(components, ids), mine);
    each_value(components, mine, [&](double value, Index i, int c) {
      if (data.is_saved(field, i)) value_at(field, i, c) = value;
    });
  });
  load_part(reader, "books", particles_.energy_totals());
  reader.get("rigid_centres", particles_.boundary().rigid_shapes().centres());
  std::vector<double> actions = particles_.boundary().resultants().state();
  reader.get("actions", actions);
  particles_.boundary().restore_resultants(actions);
  particles_.resumed();
}

}  // namespace

std::unique_ptr<Formulation> make(Assembly const& assembly) {
  check(assembly);
  return std::make_unique<Solver>(assembly);
}

}  // namespace piola::adaptle
