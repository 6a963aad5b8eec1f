// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/contact_model.hpp"
#include <vector>

namespace piola::contact {

/// Margin of the search of contacts (Verlet skin), and how long lists with it are valid: until a particle or a rigid
/// shape has moved by a part of it.
class VerletSkin {
 public:
  explicit VerletSkin(std::vector<Surface> const& surfaces);
  double thickness() const { return thickness_; }  ///< [m]
  /// Whether lists are still valid at positions x [m].
  bool is_valid(ContactModel const& model, std::vector<Vec<3>> const& x) const;
  /// The lists are those of positions x [m].
  void set(ContactModel const& model, std::vector<Vec<3>> const& x);
  void invalidate() { positions_.clear(); }

 private:
  double thickness_ = 0;
  std::vector<Vec<3>> positions_;  ///< of host particles when the lists were made [m]
  std::vector<RigidPose> poses_;   ///< of rigid shapes then
};

}  // namespace piola::contact
