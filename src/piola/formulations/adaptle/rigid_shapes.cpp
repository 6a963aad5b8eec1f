// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/rigid_shapes.hpp"
#include "piola/base/contracts.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include <algorithm>

namespace piola::adaptle {

RigidShapes::RigidShapes(std::vector<RigidShape> const& shapes, System& system) : shapes_(shapes) {
  if (shapes_.empty()) return;
  power_ = LazyZeroArray<double>(at(system.particles) + 16);  // loops read whole lanes
  pose_.resize(shapes_.size());
  Index blocks = 0;
  for (int b = 0; b < system.bodies; ++b) blocks += exec::block_count({system.body[b].first, system.body[b].last});
  action_.resize(at(blocks) * 6 * shapes_.size());
  for (RigidShape const& shape : shapes_) centre_.insert(centre_.end(), shape.centre.begin(), shape.centre.end());
  system.rigid.pose = pose_.data();
  system.rigid.count = static_cast<int>(pose_.size());
  system.rigid.power = power_.data();
  system.rigid.action = action_.data();
}

void RigidShapes::move(double time, double dt) {
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    RigidShape const& from = shapes_[k];
    RigidPoseAtHalfTime& to = pose_[k];
    to.kind = static_cast<int>(from.kind);
    to.radius = from.radius;
    for (std::size_t c = 0; c < 3; ++c) {
      to.velocity[c] = from.velocity[c]({}, time + 0.5 * dt);
      to.centre[c] = centre_[3 * k + c] + 0.5 * dt * to.velocity[c];
      to.axis[c] = from.axis[c];
      to.half[c] = from.half_lengths[c];
      centre_[3 * k + c] += dt * to.velocity[c];
    }
  }
}

std::vector<exec::ReproducibleSums<6>> RigidShapes::actions() const {
  std::vector<exec::ReproducibleSums<6>> sums(shapes_.size());
  for (std::size_t block = 0; block < action_.size(); block += 6) sums[block / 6 % shapes_.size()].add(&action_[block]);
  return sums;
}

void RigidShapes::clear_actions() { std::fill(action_.begin(), action_.end(), 0); }

std::array<double, 3> RigidShapes::centre_at_half_time(std::size_t shape) const {
  PIOLA_EXPECTS(shape < pose_.size());
  return std::to_array(pose_[shape].centre);
}

}  // namespace piola::adaptle
