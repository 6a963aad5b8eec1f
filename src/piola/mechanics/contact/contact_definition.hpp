// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/circle.hpp"
#include "piola/mechanics/contact/friction.hpp"
#include "piola/mechanics/contact/self_contact_exclusions.hpp"
#include "piola/mechanics/contact/shape_points.hpp"
#include "piola/mechanics/contact/surface_points.hpp"
#include <algorithm>
#include <array>
#include <vector>

namespace piola::contact {

/// Search distance: gaps below this number of spacings limit the step.
inline constexpr double near = 0.25;
/// Approach of two surfaces that bounds a step, in spacings.
inline constexpr double approach_in_a_step = 0.1;

/// Contact setting between a body and another one, itself, or a rigid shape.
struct PairSetting {
  bool is_active = false;  ///< whether they are in surface contact
  double factor = 0.5;     ///< C_s
  FrictionLaw friction;
};
/// [body][other]: bodies first, then rigid shapes; symmetric.
using PairSettings = std::vector<std::vector<PairSetting>>;

/// Points of a rigid shape that are tested against the planes of a body, where the body's own points are too coarse.
struct ShapePass {
  std::size_t body, rigid;
  ShapePoints points;
  PairRule rule;
  bool axisymmetric = false;  ///< points stand for rings

  /// Factor on the area of a point at the radius x [m].
  double around(double x) const { return axisymmetric ? circle(std::max(x, 0.0)) : 1; }
};

/// Which surface points can be in contact with which objects, and by which law. Objects are the bodies, then the rigid
/// shapes.
class ContactDefinition {
 public:
  ContactDefinition(ParticleSet const& particles, SurfacePoints const& points, std::vector<RigidSurface> const& rigids,
                    PairSettings settings);

  std::size_t objects() const { return bodies_ + rigids_; }
  std::size_t object_of(std::size_t rigid) const { return bodies_ + rigid; }
  PairSetting const& pair(std::size_t body, std::size_t object) const { return settings_[body][object]; }
  PairSetting const& with_rigid(std::size_t body, std::size_t rigid) const { return settings_[body][bodies_ + rigid]; }
  PairRule const& rule(std::size_t body, std::size_t other) const { return rules_[body][other]; }
  bool has_friction() const { return has_friction_; }  ///< whether any pair has it

  /// Along which axes a rigid shape is thin for a body.
  std::array<bool, 3> const& thin_axes(std::size_t body, std::size_t rigid) const { return thin_[body][rigid]; }
  bool is_thin(std::size_t body, std::size_t rigid) const {
    std::array<bool, 3> const& t = thin_[body][rigid];
    return t[0] || t[1] || t[2];
  }
  bool any_thin() const { return any_thin_; }
  std::vector<ShapePass> const& shape_passes() const { return shape_passes_; }

  /// Excludes the contact of a point with an object, or includes it again.
  void exclude(Index point, std::size_t object, bool out);
  /// Removes a point from all contacts.
  void remove(Index point);
  bool is_removed(Index point) const { return !removed_.empty() && removed_[at(point)] != 0; }
  bool is_excluded(Index point, std::size_t object) const {
    return !excluded_.empty() && excluded_[at(point) * objects() + object] != 0;
  }
  /// Whether a point of a body can be in contact with a rigid shape.
  bool allows(Index point, std::size_t body, std::size_t rigid) const {
    return !is_removed(point) && with_rigid(body, rigid).is_active && !is_excluded(point, object_of(rigid));
  }
  /// Whether the point itself is tested against the shape; false if points of the shape cover all of it.
  bool tests(Index point, std::size_t body, std::size_t rigid) const {
    return allows(point, body, rigid) && covered_[body][rigid] == 0;
  }
  /// Whether self-contact of a body is excluded between two of its host particles.
  bool are_neighbours(std::size_t body, Index host, Index other) const { return self_[body].hold(host, other); }

 private:
  void set_up_rigids(std::size_t body, Surface const& surface, std::vector<RigidSurface> const& rigids);

  bool axisymmetric_;
  std::size_t bodies_, rigids_, points_;  ///< numbers of them
  PairSettings settings_;
  bool has_friction_ = false;
  std::vector<std::vector<PairRule>> rules_;
  std::vector<SelfContactExclusions> self_;  ///< by body: empty without self-contact
  std::vector<char> excluded_;               ///< by point and object, or empty
  std::vector<char> removed_;                ///< by point, or empty
  std::vector<ShapePass> shape_passes_;
  std::vector<std::vector<char>> covered_;              ///< [body][rigid]: see ShapePoints::cover()
  std::vector<std::vector<std::array<bool, 3>>> thin_;  ///< [body][rigid]
  bool any_thin_ = false;
};

}  // namespace piola::contact
