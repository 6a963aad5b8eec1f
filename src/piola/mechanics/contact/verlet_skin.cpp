// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/verlet_skin.hpp"
#include <algorithm>

namespace piola::contact {
namespace {

constexpr double thickness_in_spacings = 0.5;
/// Rotating planes move a little farther than their particles; this fraction of the skin allows for that.
constexpr double fraction_of_skin = 1.0 / 3;

}  // namespace

VerletSkin::VerletSkin(std::vector<Surface> const& surfaces) {
  for (Surface const& surface : surfaces)
    if (!surface.points.empty()) thickness_ = std::max(thickness_, thickness_in_spacings * surface.spacing);
}

bool VerletSkin::is_valid(ContactModel const& model, std::vector<Vec<3>> const& x) const {
  if (positions_.empty()) return false;
  HostParticles const& hosts = model.points.hosts();
  double const most = fraction_of_skin * thickness_ * fraction_of_skin * thickness_;
  for (Index k = 0; k < hosts.count(); ++k)
    if (!(square_of(x[at(hosts.self(k))] - positions_[at(k)]) < most)) return false;
  for (std::size_t r = 0; r < model.rigids.size(); ++r)
    if (!(travel_from(poses_[r], model.rigids[r]) < fraction_of_skin * thickness_)) return false;
  return true;
}

void VerletSkin::set(ContactModel const& model, std::vector<Vec<3>> const& x) {
  HostParticles const& hosts = model.points.hosts();
  positions_.clear();
  for (Index k = 0; k < hosts.count(); ++k) positions_.push_back(x[at(hosts.self(k))]);
  poses_.clear();
  for (RigidSurface const& rigid : model.rigids) poses_.push_back(pose_of(rigid));
}

}  // namespace piola::contact
