// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <span>

namespace piola {

/// The particles of a formulation as contact and ties see them, which change velocities between steps, when all
/// formulations are at the same time. All ranks pass the same ids, those of the formulation, and get the same values.
class CoupledParticles {
 public:
  virtual ~CoupledParticles() = default;
  virtual void read_motion(std::span<std::int64_t const> ids, std::span<std::array<double, 3>> x,
                           std::span<std::array<double, 3>> v) const = 0;                      ///< [m], [m/s]
  virtual void read_masses(std::span<std::int64_t const> ids, std::span<double> m) const = 0;  ///< [kg]
  /// Changes the areas of particles on flat faces of boxes, with these outward normals, to those by which a uniform
  /// pressure causes uniform stress [m^(D-1)]. Leaves them where the formulation has no such areas.
  virtual void read_face_areas(std::span<std::int64_t const> /*ids*/,
                               std::span<std::array<double, 3> const> /*normals*/, std::span<double> /*areas*/) const {}
  /// Adds to velocities, also to prescribed ones [m/s].
  virtual void add_velocities(std::span<std::int64_t const> ids, std::span<std::array<double, 3> const> change) = 0;
  /// Number of particles that have lost their surface points since the start, because they or a neighbour became
  /// Eulerian or came off. Formulations with contact of their own keep such particles apart from other bodies;
  /// ContactCoupling does so for the rest.
  virtual std::int64_t surfaces_lost() const { return 0; }
  virtual bool has_lost_surface(std::int64_t /*id*/) const { return false; }
};

}  // namespace piola
