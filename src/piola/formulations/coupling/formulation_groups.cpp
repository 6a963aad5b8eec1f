// SPDX-License-Identifier: Apache-2.0
#include "piola/base/contracts.hpp"
#include "piola/formulations/coupling/coupled_formulations.hpp"
#include <algorithm>
#include <utility>

namespace piola {
namespace {

using Blocks = std::vector<FormulationGroup::Block>;

/// Values of an array by particle that belong to the part. An empty array stays empty.
template <class T>
std::vector<T> gathered(std::vector<T> const& whole, Blocks const& blocks) {
  std::vector<T> out;
  if (whole.empty()) return out;
  for (auto const& block : blocks)
    out.insert(out.end(), whole.begin() + block.there, whole.begin() + block.there + block.count);
  return out;
}

ParticleSet particles_of(ParticleSet const& whole, FormulationGroup const& part) {
  Blocks const& blocks = part.blocks;
  if (blocks.size() == whole.bodies.size()) return whole;  // copy-on-write
  ParticleSet set;
  set.dimension = whole.dimension;
  set.axisymmetric = whole.axisymmetric;
  set.X = gathered(whole.X.seen(), blocks);
  set.lattice_index = gathered(whole.lattice_index.seen(), blocks);
  set.volume = gathered(whole.volume.seen(), blocks);
  set.kernel_volume = gathered(whole.kernel_volume.seen(), blocks);
  set.part = gathered(whole.part.seen(), blocks);
  set.crack_side = gathered(whole.crack_side.seen(), blocks);
  for (auto const& block : blocks) {
    Body body = whole.bodies[block.body];
    body.first = block.here;
    body.last = block.here + block.count;
    std::vector<int>& owners = set.body.own();
    owners.insert(owners.end(), static_cast<std::size_t>(block.count), static_cast<int>(set.bodies.size()));
    set.bodies.push_back(std::move(body));
  }
  for (Crack crack : whole.cracks) {
    auto const body = part.body_in_part(static_cast<std::size_t>(crack.body));
    if (!body) continue;
    crack.body = static_cast<int>(*body);
    set.cracks.push_back(crack);
  }
  return set;
}

void take_supports(Assembly const& whole, FormulationGroup& part) {
  for (std::size_t k = 0; k < whole.supports.size(); ++k) {
    Support support = whole.supports[k];
    std::vector<std::int64_t> ids;
    std::vector<std::array<double, 3>> normals;
    for (std::size_t i = 0; i < support.particles.size(); ++i) {
      auto const here = part.id_in_part(support.particles[i]);
      if (!here) continue;
      ids.push_back(*here);
      if (support.on_surface()) normals.push_back(support.normals[i]);
    }
    if (ids.empty()) continue;
    support.particles = std::move(ids);
    support.normals = std::move(normals);
    part.assembly.supports.push_back(std::move(support));
    part.supports.push_back(k);
  }
}

void take_loads(Assembly const& whole, FormulationGroup& part) {
  std::size_t named = 0;  // of the whole so far
  for (Load const& from : whole.loads) {
    std::size_t const number = named;
    named += from.name.empty() ? 0 : 1;
    Load load = from;
    load.particles.clear();
    load.factor.clear();
    load.normals.clear();
    for (std::size_t i = 0; i < from.particles.size(); ++i) {
      auto const here = part.id_in_part(from.particles[i]);
      if (!here) continue;
      load.particles.push_back(*here);
      load.factor.push_back(from.factor[i]);
      if (!from.normals.empty()) load.normals.push_back(from.normals[i]);
    }
    if (load.particles.empty()) continue;
    if (!load.name.empty()) part.named_loads.push_back(number);
    part.assembly.loads.push_back(std::move(load));
  }
}

/// Adds contact rules and rigid shapes for a formulation with kernel contact.
void take_contact(Assembly const& whole, FormulationGroup& part) {
  Assembly& a = part.assembly;
  auto const info = find_formulation(part.formulation);
  if (info && info->contact && whole.contact.law != ContactRule::Law::surface) {
    a.contact = whole.contact;
    a.contact_pairs = whole.contact_pairs;
    for (std::size_t k = 0; k < whole.rigid_shapes.size(); ++k) {
      if (whole.rigid_shapes[k].turns()) continue;  // only surface contact with these
      a.rigid_shapes.push_back(whole.rigid_shapes[k]);
      part.rigid_shapes.push_back(k);
    }
  }
}

void fill_part(Assembly const& whole, FormulationGroup& part) {
  Assembly& a = part.assembly;
  a.particles = particles_of(whole.particles, part);
  a.initial_velocity = gathered(whole.initial_velocity, part.blocks);
  a.initial_displacement = gathered(whole.initial_displacement, part.blocks);
  a.initial_temperature = gathered(whole.initial_temperature, part.blocks);
  a.initial_deformation_gradient = gathered(whole.initial_deformation_gradient, part.blocks);
  for (auto const& block : part.blocks) {
    a.materials.push_back(whole.materials[block.body]);
    if (!whole.parts.empty()) a.parts.push_back(whole.parts[block.body]);
    a.formulations.push_back(whole.formulations[block.body]);
  }
  take_supports(whole, part);
  take_loads(whole, part);
  for (MirrorPlane mirror : whole.mirrors) {
    auto const body = part.body_in_part(mirror.body);
    if (!body) continue;
    mirror.body = *body;
    a.mirrors.push_back(mirror);
  }
  for (contact::TieRule tie : whole.ties) {
    if (tie.rigid) continue;
    auto const first = part.body_in_part(tie.bodies[0]), second = part.body_in_part(tie.bodies[1]);
    if (!first || !second) continue;
    tie.bodies = {*first, *second};
    a.ties.push_back(std::move(tie));
  }
  take_contact(whole, part);
  a.coupled = !whole.surfaces.empty();
  a.cfl = whole.cfl;
  a.backend = whole.backend;
  a.repartition = whole.repartition;
}

}  // namespace

std::int64_t FormulationGroup::id_in_whole(std::int64_t id) const {
  PIOLA_EXPECTS(id >= 0);
  for (Block const& block : blocks)
    if (id >= block.here && id < block.here + block.count) return id - block.here + block.there;
  return id;
}

std::optional<std::int64_t> FormulationGroup::id_in_part(std::int64_t id) const {
  for (Block const& block : blocks)
    if (id >= block.there && id < block.there + block.count) return id - block.there + block.here;
  return std::nullopt;
}

std::optional<std::size_t> FormulationGroup::body_in_part(std::size_t body) const {
  for (std::size_t b = 0; b < blocks.size(); ++b)
    if (blocks[b].body == body) return b;
  return std::nullopt;
}

std::string group_name(Assembly const& whole, std::size_t body) {
  PIOLA_EXPECTS(body < whole.formulations.size());
  std::string const& formulation = whole.formulations[body].name;
  auto const info = find_formulation(formulation);
  bool const alone = info && info->contact && whole.contact.law == ContactRule::Law::surface;
  return alone ? formulation + "." + whole.particles.bodies[body].name : formulation;
}

std::vector<FormulationGroup> split_by_formulation(Assembly const& whole) {
  PIOLA_EXPECTS(whole.formulations.size() == whole.particles.bodies.size());
  std::vector<FormulationGroup> parts;
  for (std::size_t b = 0; b < whole.formulations.size(); ++b) {
    Body const& body = whole.particles.bodies[b];
    std::string const name = group_name(whole, b);
    auto part = std::find_if(parts.begin(), parts.end(), [&](FormulationGroup const& p) { return p.name == name; });
    if (part == parts.end()) {
      part = parts.emplace(parts.end());
      part->formulation = whole.formulations[b].name;
      part->name = name;
    }
    std::int64_t const here = part->blocks.empty() ? 0 : part->blocks.back().here + part->blocks.back().count;
    part->blocks.push_back({b, here, body.first, body.last - body.first});
  }
  for (FormulationGroup& part : parts) fill_part(whole, part);
  return parts;
}

}  // namespace piola
