// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_advection/solver.hpp"

namespace piola::jst_advection {

void setting_warning(Assembly const& assembly, std::size_t, BodyWarnings& setting_warnings) {
  std::string const why = " has no effect here (only the velocity is carried along) - remove it";
  if (!assembly.initial_displacement.empty())
    setting_warnings.add("initial_displacement", "initial_displacement" + why);
  if (!assembly.initial_deformation_gradient.empty())
    setting_warnings.add("initial_deformation_gradient", "initial_deformation_gradient" + why);
}

}  // namespace piola::jst_advection
