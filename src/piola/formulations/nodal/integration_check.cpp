// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/integration_check.hpp"
#include "piola/base/errors.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace piola::nodal {
namespace {

/// Limit of a spurious force in a body under uniform stress, in areas of a face between two particles times the stress.
/// Converged solves leave at most 2e-3.
constexpr double most_missing = 4e-3;
/// [1/spacing]. 1 to 3.2 on lattices, packings and random clouds; thirteen and more where the solve fails.
constexpr double steepest_gradient = 10;

}  // namespace

void check_integration(SetUp const& from, IntegrationCorrection const& integration_correction,
                       std::vector<SetUpCheck>& checks) {
  auto const& n = from.body.lattice;
  bool const wrong =
      !(integration_correction.residual <= most_missing) || !(integration_correction.steepest <= steepest_gradient);
  std::string const found = fmt::format(
      "body '{}': gradients miss the divergence theorem by {:.3g} faces of a particle after {} iterations (at most "
      "{}), the largest is {:.3g} / spacing (at most {})",
      from.body.name, integration_correction.residual, integration_correction.iterations, most_missing,
      integration_correction.steepest, steepest_gradient);
  if (wrong)
    throw InputError(
        fmt::format("{} - nodal cannot set up this body of {} x {} x {} spacings, which may be too long for its width: "
                    "change the numbers of particles a little, or take jitter = 0.001, more particles across, or the "
                    "formulation jst_sph",
                    found, std::max(n[0] - 1, 0), std::max(n[1] - 1, 0), std::max(n[2] - 1, 0)));
  std::string const of_body = from.body.name + ".closure_";
  checks.push_back({of_body + "iterations", static_cast<double>(integration_correction.iterations),
                    integration_correction.converged
                        ? ""
                        : found + ": the set-up did not converge, so forces may be wrong by that"});
  checks.push_back({of_body + "residual", integration_correction.residual, ""});
  checks.push_back({of_body + "largest_gradient", integration_correction.steepest, ""});
}

}  // namespace piola::nodal
