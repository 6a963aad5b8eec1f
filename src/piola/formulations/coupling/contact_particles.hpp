// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/contracts.hpp"
#include "piola/formulations/common/mirrored_assembly.hpp"
#include "piola/formulations/coupled_particles.hpp"
#include "piola/formulations/coupling/coupled_formulations.hpp"
#include "piola/formulations/coupling/held_directions.hpp"
#include "piola/math/tensor.hpp"
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace piola {

/// Vectors at few of all particles, by index: forces [N] or impulses [N s].
struct SparseVectors {
  std::vector<Vec<3>> values;
  std::vector<Index> loaded;  ///< indices with a value, ascending; other values are not read
};

/// Particles that contact and ties act on: those of surfaces, with their images behind mirror planes, by index into
/// SurfaceContactSystem::ids(); then others of bodies that are in colour contact. Late ones, of bodies whose surfaces
/// may be lost, come last and have no state until read_late(). Reads their state from the formulations of the run and
/// applies impulses to it.
class ContactParticles {
 public:
  using Formulations = std::vector<CoupledParticles*>;  ///< by group
  /// surface_ids: ids in `continued`.
  ContactParticles(MirroredAssembly const& continued, std::vector<std::int64_t> const& surface_ids);
  /// Appends a particle of the run without a surface. Call before append_late().
  void append(std::int64_t id) {
    PIOLA_EXPECTS(read_ == ids_.size());
    ids_.push_back(id);
    ++read_;
  }
  /// As append(), of a late particle.
  void append_late(std::int64_t id) { ids_.push_back(id); }
  /// Has the state of late particles read from now on. Returns whether any was not read before.
  bool read_late();
  /// Finds the particles in the formulations. Call once, after the last append_late().
  void assign(std::vector<FormulationGroup> const& groups);

  std::size_t group_count() const { return groups_.size(); }
  std::size_t count() const { return ids_.size(); }
  std::vector<std::int64_t> const& ids() const { return ids_; }  ///< in the run, by index; -1: an image
  /// Indices of the particles of the run, by id.
  std::map<std::int64_t, Index> indices() const;
  std::vector<double> const& masses() const { return mass_; }  ///< of particles with a state [kg]
  std::vector<double> surface_masses() const;                  ///< of the particles of surfaces [kg]
  std::vector<Vec<3>> const& x() const { return x_; }          ///< [m]
  std::vector<Vec<3>> const& v() const { return v_; }          ///< [m/s]

  void read_masses(Formulations const& formulations);
  void read_motion(Formulations const& formulations);
  /// Place on a flat face of a body.
  struct FacePlace {
    Index at;                      ///< index of the particle
    std::array<double, 3> normal;  ///< outward unit vector
    double area;                   ///< [m^(D-1)]
  };
  /// Changes the areas, see CoupledParticles::read_face_areas(). Places on images get areas and normals of their
  /// sources.
  void read_face_areas(Formulations const& formulations, std::vector<FacePlace>& places) const;
  /// Particles that have lost their surface, as marks by index; empty if there are no new ones.
  std::vector<char> find_lost_surfaces(Formulations const& formulations);
  /// Adds the forces on images to their sources: the energy is a function of the particles of the run.
  void fold_images(SparseVectors& forces) const;
  /// Applies `factor` times these vectors as impulses [N s] at `time`. Held directions keep their velocity.
  void apply(Formulations const& formulations, SparseVectors const& impulses, double factor, double time,
             HeldDirections& held);

 private:
  struct GroupParticles {
    std::vector<Index> at;            ///< indices
    std::vector<std::int64_t> local;  ///< ids in the group
    std::int64_t lost = 0;            ///< particles without a surface at the last check
  };
  /// Image of a particle at a mirror plane: x' = sign x + shift of its source.
  struct Image {
    Index at, source;
    std::array<double, 3> sign, shift;
  };
  void place_images();
  std::span<std::int64_t const> read_of(GroupParticles const& group) const;

  std::size_t surface_count_;
  std::size_t read_;  ///< number of particles that have a state
  std::vector<std::int64_t> ids_;
  std::vector<Image> images_;           ///< by `at`
  std::vector<GroupParticles> groups_;  ///< by formulation
  std::vector<double> mass_;
  std::vector<Vec<3>> x_, v_;
};

}  // namespace piola
