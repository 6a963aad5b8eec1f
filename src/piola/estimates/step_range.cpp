// SPDX-License-Identifier: Apache-2.0
#include "piola/estimates/step_range.hpp"
#include "piola/input/contact_capabilities.hpp"
#include <cmath>
#include <fmt/format.h>

namespace piola {

// Factors are about those between trial steps and runs of the shipped cases.
StepExcess step_excess(CaseSpec const& spec, double change) {
  constexpr double of_kernels = 6, of_surfaces = 2.5, of_strain = 1.5, steady = 0.02;
  auto const more = [](double factor, std::string_view why) {
    return StepExcess{
        factor, fmt::format("steps are known as a range: {} (up to {:g} times as many in cases known)", why, factor)};
  };
  if (any_contact(spec))
    return more(has_kernel_contact(spec) ? of_kernels : of_surfaces, "contact and impact make them shorter");
  if (std::abs(change) > steady) return more(of_strain, "their length was still changing when the trial ended");
  return {};
}

}  // namespace piola
