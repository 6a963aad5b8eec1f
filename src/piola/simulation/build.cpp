// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/build.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/domain/error_agreement.hpp"
#include "piola/exec/heap_tuning.hpp"
#include "piola/exec/reproducible_sum.hpp"
#include "piola/exec/threads.hpp"
#include "piola/formulations/derived_fields.hpp"
#include "piola/formulations/make_formulation.hpp"
#include "piola/guards/warnings.hpp"
#include "piola/input/contact_capabilities.hpp"
#include "piola/input/formula_loop.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include "piola/math/hash.hpp"
#include "piola/model/case_particles.hpp"
#include "piola/model/region_checks.hpp"
#include "piola/neighbours/particle_cells.hpp"
#include "piola/particles/body_extents.hpp"
#include "piola/particles/part_properties.hpp"
#include "piola/setup/contact_surface.hpp"
#include <algorithm>
#include <bit>
#include <span>
#include <string_view>

namespace piola {
namespace {

template <std::size_t N>
std::array<double, N> values_at(std::array<Expression, N> const& formulas, std::array<double, 3> const& X) {
  std::array<double, N> out{};
  for (std::size_t c = 0; c < N; ++c) out[c] = formulas[c](X);
  return out;
}

/// Evaluates the formulas of one body at the reference positions of its particles.
void set_initial_state(BodySpec const& from, Body const& body, Assembly& a) {
  auto const& X = a.particles.X.seen();
  auto const put = [&](auto const& formulas, auto& values) {
    for_each_with_formulas(formulas, body, [&](auto const& mine, std::size_t i) { values[i] = values_at(mine, X[i]); });
  };
  put(from.initial_velocity, a.initial_velocity);
  if (from.initial_displacement) {
    a.initial_displacement.resize(X.size());
    put(*from.initial_displacement, a.initial_displacement);
  }
  if (from.initial_deformation_gradient) {
    constexpr std::array<double, 9> identity{1, 0, 0, 0, 1, 0, 0, 0, 1};
    if (a.initial_deformation_gradient.empty()) a.initial_deformation_gradient.resize(X.size(), identity);
    put(*from.initial_deformation_gradient, a.initial_deformation_gradient);
  }
  if (from.initial_temperature) {
    a.initial_temperature.resize(X.size());
    for_each_with_formulas(*from.initial_temperature, body,
                           [&](Expression const& T, std::size_t i) { a.initial_temperature[i] = T(X[i]); });
  }
}

/// The formulation takes deformation gradients either from the displacement or as given, for all bodies.
void report_mixed_start(CaseSpec const& spec, Problems& problems) {
  auto const given = [](BodySpec const& body) { return body.initial_deformation_gradient.has_value(); };
  if (std::none_of(spec.bodies.begin(), spec.bodies.end(), given)) return;
  for (BodySpec const& body : spec.bodies) {
    if (!body.initial_displacement || given(body)) continue;
    problems.add({}, "body '" + body.name +
                         "' has an initial displacement while another body has an initial deformation gradient " +
                         "(all displaced bodies need one then) - give initial_deformation_gradient for this body, too");
  }
}

std::size_t index_of_body(std::string const& name, ParticleSet const& particles) {
  return static_cast<std::size_t>(body_named(particles, name) - particles.bodies.data());
}

/// The middle of some particles at the start [m].
std::array<double, 3> middle_of(std::vector<std::int64_t> const& ids, ParticleSet const& particles) {
  exec::ReproducibleSums<4> sums;
  for (auto const id : ids) {
    auto const i = static_cast<std::size_t>(id);
    double const volume = particles.volume[i];
    auto const& X = particles.X[i];
    double const of_particle[]{volume, volume * X[0], volume * X[1], volume * X[2]};
    sums.add(of_particle);
  }
  double const volume = sums.value(0);
  if (!(volume > 0)) return {};
  return {sums.value(1) / volume, sums.value(2) / volume, sums.value(3) / volume};
}

Support support_of(SupportSpec const& spec, CaseSpec const& from, ParticleSet const& particles) {
  Body const& body = particles.bodies[index_of_body(spec.body, particles)];
  auto const ids = supported_particles(particles, body, spec);
  Support support{.particles = ids,
                  .fix = spec.fix,
                  .frame = spec.frame,
                  .normal = spec.normal,
                  .velocity = spec.velocity,
                  .until = spec.until,
                  .name = spec.name,
                  .about = middle_of(ids, particles)};
  if (!holds_surface(from, spec)) return support;
  if (spec.patch && spec.patch->part == Face::Part::patch) support.patch = spec.patch->axis;
  support.whole_patch = support.patch >= 0 && !spec.where;
  exec::ReproducibleSums<4> sums;
  for (FaceWeight const& share : supported_weights(particles, body, spec)) {
    support.normals.push_back(share.normal);
    double const area = share.area;
    double const of_share[]{area, area * share.middle[0], area * share.middle[1], area * share.middle[2]};
    sums.add(of_share);
  }
  for (int c = 0; c < 3; ++c) support.about[static_cast<std::size_t>(c)] = sums.value(1 + c) / sums.value(0);
  return support;
}

double density_of(MaterialParameters const& material) {
  LawInfo const law = law_of(material);
  auto const density = std::find_if(law.parameters.begin(), law.parameters.end(),
                                    [](Parameter const& p) { return p.name == "density"; });
  return density == law.parameters.end() ? 0 : material.value[density - law.parameters.begin()];
}

/// Densities of a body and of its parts.
std::vector<double> densities_of(BodySpec const& body) {
  std::vector<double> densities{density_of(body.material)};
  for (PartSpec const& part : body.parts) densities.push_back(density_of(part.material));
  return densities;
}

/// Acceleration of the particles of a load per unit of its value.
Load load_of(LoadSpec const& spec, CaseSpec const& from, ParticleSet const& particles) {
  std::size_t const b = index_of_body(spec.body, particles);
  std::vector<double> const densities = densities_of(from.bodies[b]);
  auto const density = [&](std::int64_t id) { return densities[part_of(particles, static_cast<std::size_t>(id))]; };
  Load load{.particles = loaded_particles(particles, particles.bodies[b], spec),
            .factor = {},
            .value = spec.value,
            .until = spec.until,
            .pressure = spec.kind == LoadSpec::Kind::pressure,
            .follows = spec.follower,
            .name = spec.name};
  if (spec.kind == LoadSpec::Kind::non_reflecting) load.absorbs = spec.absorption;
  load.about = middle_of(load.particles, particles);
  if (!spec.on_face()) {
    bool const force = spec.kind == LoadSpec::Kind::body_force;
    for (std::int64_t const id : load.particles) load.factor.push_back(force ? 1 / density(id) : 1);
    return load;
  }
  bool const flat = spec.face.part == Face::Part::flat;
  if (spec.face.part == Face::Part::patch) load.patch = spec.face.axis;
  load.whole_patch = load.patch >= 0 && !spec.where;
  for (FaceWeight const& share : loaded_weights(particles, particles.bodies[b], spec)) {
    double const mass = density(share.particle) * particles.volume[static_cast<std::size_t>(share.particle)];
    load.factor.push_back(share.area / mass);
    if (flat)
      load.normal = share.normal;
    else
      load.normals.push_back(share.normal);
  }
  return load;
}

double mass_of(BodySpec const& spec, Body const& body, ParticleSet const& particles) {
  std::vector<double> const densities = densities_of(spec);
  auto const parts = part_properties(particles, body, spec.parts.size());
  double mass = 0;
  for (std::size_t k = 0; k < parts.size(); ++k) mass += parts[k].volume * densities[k];
  return mass;
}

std::string formulation_names(CaseSpec const& spec) {
  std::vector<std::string_view> known;
  std::string text;
  for (BodySpec const& body : spec.bodies) {
    if (std::find(known.begin(), known.end(), body.formulation.name) != known.end()) continue;
    known.push_back(body.formulation.name);
    text += (text.empty() ? "" : " + ") + body.formulation.name;
  }
  return text;
}

// The fields depend on the law and on the settings, so that they are taken from the formulation.
void check_fields(CaseSpec const& spec, Formulation const& formulation, std::string const& name) {
  Problems problems;
  Observables const& observables = formulation.observables();
  auto const all_fields = observables.fields();
  for (ProbeSpec const& probe : spec.probes) {
    auto const body = std::find_if(spec.bodies.begin(), spec.bodies.end(),
                                   [&](BodySpec const& candidate) { return candidate.name == probe.body; });
    auto const fields = body == spec.bodies.end()
                            ? all_fields
                            : observables.fields_of(static_cast<std::size_t>(body - spec.bodies.begin()));
    auto const has = [&](std::string_view field) {
      if (DerivedField const* const derived = find_derived(field)) field = derived->from;
      return field == "Position" ||
             std::any_of(fields.begin(), fields.end(), [&](FieldInfo const& info) { return info.name == field; });
    };
    for (std::string const& word : probe.quantities) {
      auto const quantity = find_quantity(word);
      if (!quantity || has(quantity->field)) continue;
      std::vector<std::string> known;
      known.reserve(fields.size());
      for (FieldInfo const& info : fields) known.push_back(info.name);
      problems.add(place_of(probe.places, "quantities"),
                   "probe " + in_quotes(probe.name) + " asks for " + in_quotes(word) + ", but " +
                       (body == spec.bodies.end() ? name : body->formulation.name) + " has no field " +
                       in_quotes(quantity->field) + " here (allowed: quantities of " + joined(known) + ") - remove it");
    }
  }
  problems.raise_if_any();
}

/// For the motion alone: checks of a case, which make particles as well, need no volumes of single ones.
void measure_volumes(CaseSpec const& spec, ParticleSet& particles) {
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    auto const formulation = find_formulation(spec.bodies[b].formulation.name);
    if (spec.bodies[b].shape.jitter > 0 && formulation && formulation->cell_volumes)
      take_cell_volumes(particles, particles.bodies[b]);
  }
}

/// Nothing, unless some body has parts.
void take_parts(CaseSpec const& spec, std::size_t body, Assembly& a) {
  auto const& bodies = spec.bodies;
  if (std::all_of(bodies.begin(), bodies.end(), [](BodySpec const& b) { return b.parts.empty(); })) return;
  a.parts.emplace_back();
  for (PartSpec const& part : bodies[body].parts) a.parts.back().push_back(part.material);
}

/// Diagonal of the box around the initial velocities of particles: no two approach faster [m/s].
double fastest_approach(Assembly const& a) {
  double square = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    double low = 0, high = 0;
    for (auto const& v : a.initial_velocity) {
      low = std::min(low, v[c]);
      high = std::max(high, v[c]);
    }
    square += (high - low) * (high - low);
  }
  return std::sqrt(square);
}

/// Modulus of pressure waves for the stiffness of contact [Pa]. Where heat changes the pressure, it is rho U^2 with the
/// speed U = c + s V/2 of the shock that two equal bodies with the approach V cause; s = 1.5 as in most metals.
double contact_modulus(MaterialParameters const& material, double approach) {
  constexpr double s = 1.5;
  double modulus = 0;
  with_any_law(material, [&](auto const& law) {
    modulus = law.kappa + 4.0 / 3 * law.mu;
    double const faster = has_thermal_pressure(material) ? 1 + s * approach / (2 * std::sqrt(modulus / law.rho0)) : 1;
    modulus *= faster * faster;
  });
  return modulus;
}

/// Surfaces of the bodies that accept external impulses; empty for the others.
std::vector<contact::Surface> surfaces_of(CaseSpec const& spec, Assembly const& a) {
  std::vector<contact::Surface> surfaces(spec.bodies.size());
  double const approach = fastest_approach(a);
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    bool first = false;
    for (std::size_t other = 0; other < spec.bodies.size(); ++other)
      first = first || starts_with_surface_contact(spec, other, b);
    if (!has_surface(spec, b) && !is_tied(spec, b) && !first) continue;
    surfaces[b] = contact_surface(spec.bodies[b].shape, a.particles, a.particles.bodies[b]);
    surfaces[b].modulus = contact_modulus(a.materials[b], approach);
  }
  return surfaces;
}

}  // namespace

void refuse_ranks(CaseSpec const& spec, Problems& problems) {
  for (FormulationInfo const& info : formulations_of(spec))
    if (!info.ranks) problems.add({}, refusal_of_ranks(info));
}

Assembly assemble(CaseSpec const& spec) {
  Problems problems;
  ParticleSet particles = make_particles(spec, problems);
  check_with_particles(spec, particles, problems);
  report_mixed_start(spec, problems);
  problems.raise_if_any();
  return assemble(spec, std::move(particles));
}

Assembly assemble(CaseSpec const& spec, ParticleSet particles) {
  PIOLA_EXPECTS(spec.bodies.size() == particles.bodies.size());
  Assembly a;
  Problems problems;
  if (comm::is_parallel()) refuse_ranks(spec, problems);
  report_mixed_start(spec, problems);
  problems.raise_if_any();
  a.particles = std::move(particles);
  measure_volumes(spec, a.particles);
  a.cfl = spec.run.cfl;
  a.backend = spec.run.backend;
  a.repartition = spec.run.repartition;
  a.minimises = spec.run.minimises();
  a.initial_velocity.resize(a.particles.X.size());
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    a.materials.push_back(spec.bodies[b].material);
    take_parts(spec, b, a);
    a.formulations.push_back(spec.bodies[b].formulation);
    set_initial_state(spec.bodies[b], a.particles.bodies[b], a);
  }
  for (SupportSpec const& support : spec.supports) a.supports.push_back(support_of(support, spec, a.particles));
  for (LoadSpec const& load : spec.loads) a.loads.push_back(load_of(load, spec, a.particles));
  for (MirrorSpec const& mirror : spec.mirrors)
    a.mirrors.push_back(
        {index_of_body(mirror.body, a.particles), mirror.face.axis, mirror.face.upper, mirror.antisymmetric});
  for (std::size_t b = 0; b < a.particles.bodies.size(); ++b)
    if (touches_axis(a.particles, a.particles.bodies[b])) a.mirrors.push_back({b, 0, false, false});
  a.rigid_shapes.assign(spec.rigids.begin(), spec.rigids.end());
  a.springs.assign(spec.springs.begin(), spec.springs.end());
  if (spec.contact) a.contact = *spec.contact;
  a.contact_pairs.assign(spec.contact_pairs.begin(), spec.contact_pairs.end());
  a.ties.assign(spec.ties.begin(), spec.ties.end());
  if (bodies_are_pushed(spec)) a.surfaces = surfaces_of(spec, a);
  return a;
}

namespace {

/// Throws comm::CollectiveError on all ranks unless all have the same particles and materials. Collective.
void require_identical_case(Assembly const& assembly) {
  std::uint64_t hash = 0;
  auto const add = [&](double value) { hash = hash_mix(hash + std::bit_cast<std::uint64_t>(value)); };
  auto const add_points = [&](auto const& points) {
    for (auto const& point : points)
      for (double const value : point) add(value);
  };
  add_points(assembly.particles.X);
  add_points(assembly.initial_velocity);
  for (double const volume : assembly.particles.volume) add(volume);
  for (MaterialParameters const& material : assembly.materials)
    for (auto const& values : {std::span<double const>(material.value), std::span<double const>(material.table.x),
                               std::span<double const>(material.table.y)})
      for (double const value : values) add(value);
  if (comm::all_equal(hash)) return;
  throw comm::CollectiveError(
      {bad_input,
       "the ranks have read different cases (the same particles, motions and materials are needed on all) - give "
       "all of them the same words, and files that every machine sees under the same path"});
}

Simulation build_from(CaseSpec spec, Assembly assembly) {
  Simulation simulation;
  simulation.threads = exec_host::threads();
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    simulation.mass += mass_of(spec.bodies[b], assembly.particles.bodies[b], assembly.particles);
  }
  for (RigidShape const& shape : assembly.rigid_shapes) simulation.mass += shape.mass;
  if (comm::is_parallel()) require_identical_case(assembly);
  exec_host::set_lazy_allocation(comm::size());
  simulation.formulation = make_formulation(assembly);
  simulation.formulation_name = formulation_names(spec);
  comm::agree_after([&] { check_fields(spec, *simulation.formulation, simulation.formulation_name); });
  double const step = std::min(simulation.formulation->step_estimate().stable, spec.run.max_step);
  StartEstimate prospect{.step = step};
  if (any_contact(spec)) prospect.start = simulation.formulation->diagnose();
  comm::agree_after([&] {
    if (prospect.start) refuse_unpaid_contact(spec, assembly.particles, *prospect.start);
    simulation.warnings = warnings_of(spec, assembly, prospect);
  });
  for (SetUpCheck& check : simulation.formulation->statistics().set_up_checks)
    if (!check.warning.empty()) simulation.warnings.push_back(std::move(check.warning));
  simulation.particles = std::move(assembly.particles);
  simulation.spec = std::move(spec);
  assembly = {};
  exec_host::trim_heap();
  return simulation;
}

}  // namespace

Simulation build(CaseSpec spec) {
  exec_host::set_threads(spec.run.threads);
  Assembly assembly;
  comm::agree_after([&] { assembly = assemble(spec); });
  return build_from(std::move(spec), std::move(assembly));
}

Simulation build(CaseSpec spec, ParticleSet particles) {
  exec_host::set_threads(spec.run.threads);
  Assembly assembly;
  comm::agree_after([&] { assembly = assemble(spec, std::move(particles)); });
  return build_from(std::move(spec), std::move(assembly));
}

}  // namespace piola
