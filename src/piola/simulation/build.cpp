// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/build.hpp"
#include "piola/base/problems.hpp"
#include "piola/exec/threads.hpp"
#include "piola/formulations/make.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace piola {
namespace {

/// Values of N expressions at every particle of a body, written into `out`; the first one that is not finite is reported.
template <std::size_t N>
void evaluate(std::array<Expression, N> const& expressions, std::string_view what, ParticleSet const& particles, Body const& body,
              std::vector<std::array<double, N>>& out, Problems& problems) {
  for (std::int64_t id = body.first; id < body.last; ++id) {
    auto const i = static_cast<std::size_t>(id);
    for (std::size_t c = 0; c < N; ++c) {
      out[i][c] = expressions[c](particles.X[i]);
      if (std::isfinite(out[i][c])) continue;
      auto const& X = particles.X[i];
      problems.add({}, fmt::format("body '{}': {} = \"{}\" is {} at X = ({}, {}, {}) m (must be finite) - correct the formula", body.name, what,
                                   expressions[c].text(), out[i][c], X[0], X[1], X[2]));
      return;
    }
  }
}

void set_initial_state(CaseSpec const& spec, Assembly& a, Problems& problems) {
  auto const count = static_cast<std::size_t>(a.particles.size());
  constexpr std::array<double, 9> identity{1, 0, 0, 0, 1, 0, 0, 0, 1};
  a.initial_velocity.resize(count);
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    BodySpec const& from = spec.bodies[b];
    Body const& body = a.particles.bodies[b];
    evaluate(from.initial_velocity, "initial_velocity", a.particles, body, a.initial_velocity, problems);
    if (from.initial_displacement) {
      a.initial_displacement.resize(count);
      evaluate(*from.initial_displacement, "initial_displacement", a.particles, body, a.initial_displacement, problems);
    }
    if (from.initial_deformation_gradient) {
      a.initial_deformation_gradient.resize(count, identity);
      evaluate(*from.initial_deformation_gradient, "initial_deformation_gradient", a.particles, body, a.initial_deformation_gradient, problems);
    }
  }
}

Support select(SupportSpec const& from, ParticleSet const& particles, Problems& problems) {
  Support support{{}, from.fix};
  for (Body const& body : particles.bodies) {
    if (body.name != from.body) continue;
    for (std::int64_t id = body.first; id < body.last; ++id) {
      if (from.where(particles.X[static_cast<std::size_t>(id)]) != 0) support.particles.push_back(id);
    }
  }
  if (support.particles.empty()) {
    problems.add({}, fmt::format("support of body '{}': where = \"{}\" selects no particle - widen the region", from.body, from.where.text()));
  }
  return support;
}

double total_mass(Assembly const& a) {
  double mass = 0;
  for (std::size_t b = 0; b < a.materials.size(); ++b) {
    LawInfo const law = laws()[static_cast<std::size_t>(a.materials[b].law)];
    auto const density = std::find_if(law.parameters.begin(), law.parameters.end(), [](Parameter const& p) { return p.name == "density"; });
    if (density == law.parameters.end()) continue;
    double volume = 0;
    for (std::int64_t id = a.particles.bodies[b].first; id < a.particles.bodies[b].last; ++id) volume += a.particles.volume[static_cast<std::size_t>(id)];
    mass += volume * a.materials[b].value[density - law.parameters.begin()];
  }
  return mass;
}

std::string names_of(std::vector<FormulationSpec> const& formulations) {
  std::vector<std::string> names;
  std::string text;
  for (FormulationSpec const& f : formulations) {
    if (std::find(names.begin(), names.end(), f.name) != names.end()) continue;
    names.push_back(f.name);
    text += (text.empty() ? "" : " + ") + f.name;
  }
  return text;
}

}  // namespace

Assembly assemble(CaseSpec const& spec) {
  Problems problems;
  Assembly a;
  a.cfl = spec.run.cfl;
  a.machine = spec.run.machine;
  for (BodySpec const& body : spec.bodies) {
    fill(body.shape, body.name, a.particles);
    a.materials.push_back(body.material);
    a.formulations.push_back(body.formulation);
  }
  set_initial_state(spec, a, problems);
  for (SupportSpec const& support : spec.supports) a.supports.push_back(select(support, a.particles, problems));
  problems.raise_if_any();
  return a;
}

Simulation build(CaseSpec spec) {
  Simulation simulation;
  simulation.threads = exec_host::set_threads(spec.run.threads);
  Assembly assembly = assemble(spec);
  simulation.mass = total_mass(assembly);
  simulation.formulation_name = names_of(assembly.formulations);
  simulation.formulation = make_formulation(assembly);
  simulation.particles = std::move(assembly.particles);
  simulation.spec = std::move(spec);
  return simulation;
}

}  // namespace piola
