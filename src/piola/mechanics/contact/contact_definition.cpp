// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/contact_definition.hpp"
#include "piola/base/contracts.hpp"
#include <utility>

namespace piola::contact {

ContactDefinition::ContactDefinition(ParticleSet const& particles, SurfacePoints const& points,
                                     std::vector<RigidSurface> const& rigids, PairSettings settings)
    : axisymmetric_(particles.axisymmetric),
      bodies_(points.surfaces().size()),
      rigids_(rigids.size()),
      points_(at(points.count())),
      settings_(std::move(settings)) {
  PIOLA_EXPECTS(settings_.size() >= bodies_);
  std::vector<Surface> const& surfaces = points.surfaces();
  for (std::size_t b = 0; b < bodies_; ++b) {
    PIOLA_EXPECTS(settings_[b].size() >= objects());
    Surface const& surface = surfaces[b];
    rules_.emplace_back();
    for (std::size_t o = 0; o < bodies_; ++o)
      rules_.back().push_back(pair_rule(settings_[b][o].factor, surface.modulus, surface.spacing, surfaces[o].modulus,
                                        surfaces[o].spacing));
    self_.emplace_back();
    if (settings_[b][b].is_active) self_.back() = SelfContactExclusions(particles, b, points.hosts(), surface.spacing);
    for (PairSetting const& pair : settings_[b])
      has_friction_ = has_friction_ || (pair.is_active && pair.friction.any());
    set_up_rigids(b, surface, rigids);
  }
}

/// Finds the rigid shapes that are thin or narrow for a body.
void ContactDefinition::set_up_rigids(std::size_t body, Surface const& surface,
                                      std::vector<RigidSurface> const& rigids) {
  covered_.emplace_back(rigids_);
  thin_.emplace_back(rigids_);
  for (std::size_t r = 0; r < rigids_; ++r) {
    PairSetting const& pair = with_rigid(body, r);
    if (surface.points.empty() || !pair.is_active) continue;
    double const dp = surface.spacing;
    thin_[body][r] = thin_along(rigids[r], thin_below * dp);
    any_thin_ = any_thin_ || is_thin(body, r);
    ShapePoints const points(rigids[r], dp);
    if (!points.any()) continue;
    covered_[body][r] = points.cover() ? 1 : 0;
    // The edges of a resolved shape get the weight of one of two passes, in addition to the points of the body.
    double const q = is_thin(body, r) || points.cover() ? 1 : 0.5;
    shape_passes_.push_back(
        {body,
         r,
         points,
         {2 * dp, penalty_stiffness(q, pair.factor, surface.modulus, dp), 0.5 * dp, 0.7 * dp, 1.1 * dp},
         axisymmetric_});
  }
}

void ContactDefinition::exclude(Index point, std::size_t object, bool out) {
  PIOLA_EXPECTS(at(point) < points_ && object < objects());
  excluded_.resize(points_ * objects());
  excluded_[at(point) * objects() + object] = out ? 1 : 0;
}

void ContactDefinition::remove(Index point) {
  PIOLA_EXPECTS(at(point) < points_);
  removed_.resize(points_);
  removed_[at(point)] = 1;
}

}  // namespace piola::contact
