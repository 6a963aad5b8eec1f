// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/block/own_laws.hpp"
#include <array>

namespace piola::block_laws {

std::span<LawInfo const* const> own_laws() {
  static std::array const all{&arruda_boyce,           &ogden,       &viscoelastic, &drucker_prager,
                              &holmquist_johnson_cook, &orthotropic, &p_alpha};
  return all;
}

}  // namespace piola::block_laws
