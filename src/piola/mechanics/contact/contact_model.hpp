// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/contact_definition.hpp"
#include "piola/mechanics/contact/rigid_surface.hpp"
#include "piola/mechanics/contact/surface_points.hpp"
#include <utility>
#include <vector>

namespace piola::contact {

/// Input of an evaluation of contact: surface points of bodies, rigid shapes in their poses, and the definition of
/// their contacts.
struct ContactModel {
  ContactModel(ParticleSet const& particles, std::vector<Surface> surfaces, std::vector<RigidSurface> shapes,
               PairSettings settings)
      : points(particles, std::move(surfaces)),
        rigids(std::move(shapes)),
        definition(particles, points, rigids, std::move(settings)) {
    if (definition.has_friction()) points.track_motion();
  }
  bool allows(Index point, std::size_t rigid) const { return definition.allows(point, points[point].body, rigid); }
  bool tests(Index point, std::size_t rigid) const { return definition.tests(point, points[point].body, rigid); }
  /// Ends an evaluation at x [m], from which the next one measures displacements.
  void set_last(std::vector<Vec<3>> const& x) {
    points.set_last(x);
    last_poses.clear();
    for (RigidSurface const& rigid : rigids) last_poses.push_back(pose_of(rigid));
  }

  SurfacePoints points;
  std::vector<RigidSurface> rigids;
  ContactDefinition definition;
  std::vector<RigidPose> last_poses;  ///< of rigid shapes at the last evaluation
  double dt = 0;                      ///< since the last evaluation [s]
};

}  // namespace piola::contact
