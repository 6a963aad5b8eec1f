// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/build.hpp"
#include "piola/base/problems.hpp"
#include "piola/exec/threads.hpp"
#include "piola/input/check_case.hpp"
#include <algorithm>

namespace piola {
namespace {

/// Calls visit(id) for every particle of a body.
template <class Visit>
void for_each_id(Body const& body, Visit const& visit) {
  for (std::int64_t id = body.first; id < body.last; ++id) visit(static_cast<std::size_t>(id));
}

template <std::size_t N>
std::array<double, N> values_at(std::array<Expression, N> const& formulas, std::array<double, 3> const& X) {
  std::array<double, N> out{};
  for (std::size_t c = 0; c < N; ++c) out[c] = formulas[c](X);
  return out;
}

void set_initial_state(BodySpec const& from, Body const& body, FormulationInput& input) {
  auto const& particles = *input.particles;
  for_each_id(body, [&](std::size_t i) { input.velocity[i] = values_at(from.initial_velocity, particles.X[i]); });
  if (from.initial_displacement) {
    if (input.x.empty()) input.x = particles.X;
    for_each_id(body, [&](std::size_t i) {
      auto const u = values_at(*from.initial_displacement, particles.X[i]);
      for (std::size_t c = 0; c < 3; ++c) input.x[i][c] += u[c];
    });
  }
  if (from.initial_deformation_gradient) {
    constexpr std::array<double, 9> identity{1, 0, 0, 0, 1, 0, 0, 0, 1};
    if (input.F.empty()) input.F.resize(particles.X.size(), identity);
    for_each_id(body, [&](std::size_t i) { input.F[i] = values_at(*from.initial_deformation_gradient, particles.X[i]); });
  }
}

void add_support(SupportSpec const& support, FormulationInput& input) {
  for (Body const& body : input.particles->bodies) {
    if (body.name != support.body) continue;
    for (std::int64_t id : select_particles(*input.particles, body, &support.where)) {
      for (int c = 0; c < 3; ++c) {
        if (support.fix[static_cast<std::size_t>(c)]) input.supports.push_back({id, c});
      }
    }
  }
}

double mass_of(MaterialParameters const& material, Body const& body, ParticleSet const& particles) {
  LawInfo const law = laws()[static_cast<std::size_t>(material.law)];
  auto const density = std::find_if(law.parameters.begin(), law.parameters.end(), [](Parameter const& p) { return p.name == "density"; });
  if (density == law.parameters.end()) return 0;
  double volume = 0;
  for_each_id(body, [&](std::size_t i) { volume += particles.volume[i]; });
  return volume * material.value[density - law.parameters.begin()];
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

}  // namespace

FormulationInput formulation_input(CaseSpec const& spec, ParticleSet const& particles) {
  FormulationInput input;
  input.particles = &particles;
  input.cfl = spec.run.cfl;
  input.machine = spec.run.machine;
  input.velocity.resize(particles.X.size());
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    input.material.push_back(spec.bodies[b].material);
    input.formulation.push_back(spec.bodies[b].formulation);
    set_initial_state(spec.bodies[b], particles.bodies[b], input);
  }
  for (SupportSpec const& support : spec.supports) add_support(support, input);
  return input;
}

Simulation build(CaseSpec spec) {
  Simulation simulation;
  simulation.threads = exec_host::set_threads(spec.run.threads);
  simulation.particles = make_particles(spec);
  Problems problems;
  check_regions(spec, simulation.particles, problems);
  problems.raise_if_any();
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    simulation.mass += mass_of(spec.bodies[b].material, simulation.particles.bodies[b], simulation.particles);
  }
  simulation.formulation = make_formulation(formulation_input(spec, simulation.particles));
  simulation.formulation_name = formulation_names(spec);
  simulation.spec = std::move(spec);
  return simulation;
}

}  // namespace piola
