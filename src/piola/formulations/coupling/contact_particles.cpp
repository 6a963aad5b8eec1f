// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/coupling/contact_particles.hpp"
#include "piola/base/contracts.hpp"
#include "piola/math/array_conversion.hpp"
#include <algorithm>
#include <optional>
#include <utility>

namespace piola {

ContactParticles::ContactParticles(MirroredAssembly const& continued, std::vector<std::int64_t> const& surface_ids)
    : surface_count_(surface_ids.size()), read_(surface_ids.size()) {
  for (auto const id : surface_ids) {
    MirroredAssembly::Origin const origin = continued.origin(id);
    ids_.push_back(origin.image ? -1 : origin.id);
  }
  std::map<std::int64_t, Index> const sources = indices();
  for (std::size_t k = 0; k < surface_ids.size(); ++k) {
    MirroredAssembly::Origin const origin = continued.origin(surface_ids[k]);
    if (!origin.image) continue;
    auto const source = sources.find(origin.id);
    PIOLA_EXPECTS(source != sources.end());  // the host of a point has an image like the point
    images_.push_back({static_cast<Index>(k), source->second, origin.sign, origin.shift});
  }
}

std::map<std::int64_t, Index> ContactParticles::indices() const {
  std::map<std::int64_t, Index> all;
  for (std::size_t k = 0; k < ids_.size(); ++k)
    if (ids_[k] >= 0) all.emplace_hint(all.end(), ids_[k], static_cast<Index>(k));
  return all;
}

void ContactParticles::assign(std::vector<FormulationGroup> const& groups) {
  for (FormulationGroup const& group : groups) {
    GroupParticles particles;
    for (std::size_t k = 0; k < ids_.size(); ++k) {
      auto const local = ids_[k] < 0 ? std::nullopt : group.id_in_part(ids_[k]);
      if (!local) continue;
      particles.at.push_back(static_cast<Index>(k));
      particles.local.push_back(*local);
    }
    groups_.push_back(std::move(particles));
  }
  mass_.resize(read_);
  x_.resize(read_);
  v_.resize(read_);
}

bool ContactParticles::read_late() {
  if (read_ == ids_.size()) return false;
  read_ = ids_.size();
  mass_.resize(read_);
  x_.resize(read_);
  v_.resize(read_);
  return true;
}

/// Ids in the group of its particles that have a state.
std::span<std::int64_t const> ContactParticles::read_of(GroupParticles const& group) const {
  auto const last = std::lower_bound(group.at.begin(), group.at.end(), static_cast<Index>(read_));
  return std::span(group.local).first(static_cast<std::size_t>(last - group.at.begin()));
}

std::vector<double> ContactParticles::surface_masses() const {
  return {mass_.begin(), mass_.begin() + static_cast<std::ptrdiff_t>(surface_count_)};
}

void ContactParticles::read_masses(Formulations const& formulations) {
  std::vector<double> m;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    GroupParticles const& group = groups_[g];
    m.resize(read_of(group).size());
    formulations[g]->read_masses(read_of(group), m);
    for (std::size_t k = 0; k < m.size(); ++k) mass_[static_cast<std::size_t>(group.at[k])] = m[k];
  }
}

void ContactParticles::read_motion(Formulations const& formulations) {
  std::vector<std::array<double, 3>> x, v;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    GroupParticles const& group = groups_[g];
    x.resize(read_of(group).size());
    v.resize(x.size());
    formulations[g]->read_motion(read_of(group), x, v);
    for (std::size_t k = 0; k < x.size(); ++k) {
      x_[static_cast<std::size_t>(group.at[k])] = vector_of(x[k]);
      v_[static_cast<std::size_t>(group.at[k])] = vector_of(v[k]);
    }
  }
  place_images();
}

void ContactParticles::read_face_areas(Formulations const& formulations, std::vector<FacePlace>& places) const {
  std::map<Index, Image const*> image_of;
  for (Image const& image : images_) image_of[image.at] = &image;
  for (FacePlace& place : places) {
    auto const image = image_of.find(place.at);
    if (image == image_of.end()) continue;
    place.at = image->second->source;
    for (std::size_t c = 0; c < 3; ++c) place.normal[c] *= image->second->sign[c];
  }
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    std::map<Index, std::int64_t> local;
    for (std::size_t k = 0; k < groups_[g].at.size(); ++k) local[groups_[g].at[k]] = groups_[g].local[k];
    std::vector<std::size_t> numbers;
    std::vector<std::int64_t> ids;
    std::vector<std::array<double, 3>> normals;
    std::vector<double> areas;
    for (std::size_t k = 0; k < places.size(); ++k) {
      auto const found = local.find(places[k].at);
      if (found == local.end()) continue;
      numbers.push_back(k);
      ids.push_back(found->second);
      normals.push_back(places[k].normal);
      areas.push_back(places[k].area);
    }
    formulations[g]->read_face_areas(ids, normals, areas);
    for (std::size_t k = 0; k < numbers.size(); ++k) places[numbers[k]].area = areas[k];
  }
}

void ContactParticles::place_images() {
  for (Image const& image : images_) {
    auto const at = static_cast<std::size_t>(image.at), source = static_cast<std::size_t>(image.source);
    for (int c = 0; c < 3; ++c) {
      double const sign = image.sign[static_cast<std::size_t>(c)];
      x_[at][c] = sign * x_[source][c] + image.shift[static_cast<std::size_t>(c)];
      v_[at][c] = sign * v_[source][c];
    }
    mass_[at] = mass_[source];
  }
}

std::vector<char> ContactParticles::find_lost_surfaces(Formulations const& formulations) {
  std::vector<char> lost;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    GroupParticles& group = groups_[g];
    CoupledParticles const& particles = *formulations[g];
    if (particles.surfaces_lost() == group.lost) continue;
    group.lost = particles.surfaces_lost();
    lost.resize(ids_.size());
    for (std::size_t k = 0; k < group.at.size(); ++k)
      if (particles.has_lost_surface(group.local[k])) lost[static_cast<std::size_t>(group.at[k])] = 1;
  }
  return lost;
}

void ContactParticles::fold_images(SparseVectors& forces) const {
  if (images_.empty()) return;
  std::vector<Index> real;
  auto image = images_.begin();
  for (Index const k : forces.loaded) {
    while (image != images_.end() && image->at < k) ++image;
    if (image == images_.end() || image->at != k) {
      real.push_back(k);
      continue;
    }
    Vec<3>&from = forces.values[static_cast<std::size_t>(k)],
    &to = forces.values[static_cast<std::size_t>(image->source)];
    for (int c = 0; c < 3; ++c) to[c] += image->sign[static_cast<std::size_t>(c)] * from[c];
    from = {};
    real.push_back(image->source);
  }
  std::sort(real.begin(), real.end());
  real.erase(std::unique(real.begin(), real.end()), real.end());
  forces.loaded = std::move(real);
}

void ContactParticles::apply(Formulations const& formulations, SparseVectors const& impulses, double factor,
                             double time, HeldDirections& held) {
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    GroupParticles const& group = groups_[g];
    std::vector<std::int64_t> ids;
    std::vector<std::array<double, 3>> change;
    auto loaded = impulses.loaded.begin();
    for (std::size_t k = 0; k < group.at.size() && loaded != impulses.loaded.end(); ++k) {
      while (loaded != impulses.loaded.end() && *loaded < group.at[k]) ++loaded;
      if (loaded == impulses.loaded.end() || *loaded != group.at[k]) continue;
      auto const i = static_cast<std::size_t>(group.at[k]);
      Vec<3> const impulse = held.constrain(i, time, factor * impulses.values[i], x_[i], v_[i]);
      ids.push_back(group.local[k]);
      change.push_back(array_of((1 / mass_[i]) * impulse));
      v_[i] = v_[i] + (1 / mass_[i]) * impulse;
    }
    formulations[g]->add_velocities(ids, change);
  }
}

}  // namespace piola
