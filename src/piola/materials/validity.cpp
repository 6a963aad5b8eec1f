// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/validity.hpp"
#include <array>

namespace piola {
namespace {

struct Validity {
  std::string_view law, text;
};

constexpr std::array validities{
    Validity{
        "linear_elastic",
        "strains below 0.02 and rotations below 0.05 rad. Beyond, the stress is wrong by about strain plus rotation, "
        "Cauchy's stress is not symmetric, and a rotation by r counts as a strain of r^2/2; a run under jst_sph or "
        "nodal warns of it. For more take saint_venant_kirchhoff or neo_hookean"},
    Validity{"neo_hookean", "rubber, nearly incompressible, J > 0"},
    Validity{"mooney_rivlin", "rubber, nearly incompressible, J > 0"},
    Validity{"saint_venant_kirchhoff", "large rotation, moderate strain: stretches above 0.6"},
    Validity{"compressible_neo_hookean", "large strain with change of volume, Poisson's ratio from 0 on, J > 0"}};

}  // namespace

std::string_view validity_of_law(std::string_view name) {
  for (Validity const& entry : validities)
    if (entry.law == name) return entry.text;
  return "";
}

}  // namespace piola
