// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/coarse_talk.hpp"
#include "piola/base/problems.hpp"
#include "piola/formulations/make.hpp"
#include "piola/input/formulations_of.hpp"
#include "piola/setup/solid_bodies.hpp"
#include "piola/simulation/build.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>

namespace piola {
namespace {

/// The same shape with particles so many times as far from each other.
ShapeSpec coarser(BodySpec const& body, double times) {
  ShapeSpec coarse = body.shape;
  bool const packed = coarse.kind == ShapeSpec::Kind::solid && coarse.arrangement == ShapeSpec::Arrangement::packed;
  if (packed || coarse.kind == ShapeSpec::Kind::points)
    throw InputError(fmt::format("body '{}' has {} particles, of which no coarser ones are made", body.name,
                                 packed ? "packed" : "given"));
  coarse.spacing *= times;
  if (coarse.kind == ShapeSpec::Kind::solid) coarse.solid_particles = std::make_shared<SolidParticles>();
  constexpr int least = 2;
  int const ends = coarse.placement == ShapeSpec::Placement::cell_centred ? 0 : 1;
  for (std::size_t d = 0; d < static_cast<std::size_t>(coarse.dimension); ++d)
    if (coarse.particles[d] > least)
      coarse.particles[d] = std::max(least, static_cast<int>(std::lround((coarse.particles[d] - ends) / times)) + ends);
  return coarse;
}

struct Told {
  double particles, numbers, collectives;  ///< of a body
  bool touching;                           ///< others of the same cells
};

std::vector<Told> told_of(CaseSpec spec, double times) {
  for (BodySpec& body : spec.bodies) body.shape = coarser(body, times);
  Assembly const assembly = assemble(spec);
  auto const formulation = make_formulation(assembly);
  std::vector<Told> all;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    Body const& body = assembly.particles.bodies[b];
    Talk const talk = formulation->talk(b).value_or(Talk{});
    all.push_back(
        {static_cast<double>(body.last - body.first), talk.to_all, talk.collectives, talk.near && talk.near->touching});
  }
  return all;
}

/// Numbers that a body of so many particles tells, by what two smaller ones tell.
double continued(Told const& small, Told const& large, double particles) {
  if (!(large.numbers > 0)) return 0;
  double power = 1;
  if (small.numbers > 0 && large.particles > small.particles)
    power = std::log(large.numbers / small.numbers) / std::log(large.particles / small.particles);
  return large.numbers * std::pow(particles / large.particles, std::clamp(power, 0.0, 1.0));
}

}  // namespace

bool may_meet(CaseSpec const& spec) { return spec.bodies.size() > 1 || bodies_are_pushed(spec); }

void count_meetings(CaseSpec const& spec, ParticleSet const& particles, Estimate& cost,
                    std::array<double, 2> const& sizes) {
  CaseSpec bare = spec;  // what holds and loads bodies says nothing about who is near whom
  bare.supports.clear();
  bare.loads.clear();
  bare.probes.clear();
  auto const all = static_cast<double>(particles.size());
  std::array<std::vector<Told>, 2> told;
  for (std::size_t k = 0; k < sizes.size(); ++k)
    told[k] = told_of(bare, std::max(1.0, std::pow(all / sizes[k], 1.0 / particles.dimension)));
  for (std::size_t b = 0; b < particles.bodies.size(); ++b) {
    if (!cost.talk[b]) continue;
    auto const n = static_cast<double>(particles.bodies[b].last - particles.bodies[b].first);
    cost.talk[b]->to_all = continued(told[0][b], told[1][b], n);
    cost.talk[b]->collectives = told[1][b].collectives;
    if (cost.talk[b]->near) cost.talk[b]->near->touching = told[1][b].touching;
  }
}

}  // namespace piola
