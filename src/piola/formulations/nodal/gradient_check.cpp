// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/gradient_check.hpp"
#include "piola/base/errors.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace piola::nodal {
namespace {

/// Rounding leaves 1e-14 to 1e-12 of the largest gradient.
constexpr double most_missing = 1e-9;

}  // namespace

void check_gradients(SetUp const& from, GradientQuality const& found, std::vector<SetUpCheck>& checks) {
  double const allowed = most_missing * std::max(1.0, found.steepest);
  if (!(found.closure <= allowed) || !(found.rows <= allowed))
    throw InputError(fmt::format(
        "body '{}': gradients miss the divergence theorem by {:.3g} faces of a particle, and those of quadratic fields "
        "by {:.3g} / spacing (allowed: {:.2g}) - this is an error of the program: please report it with the case; "
        "jitter = 0.001 or a little more particles may avoid it",
        from.body.name, found.closure, found.rows, allowed));
  std::string const of_body = from.body.name + ".";
  checks.push_back({of_body + "closure_residual", found.closure, ""});
  checks.push_back({of_body + "gradient_error", found.rows, ""});
  checks.push_back({of_body + "largest_gradient", found.steepest, ""});
  checks.push_back({of_body + "enlarged_supports", found.enlarged, ""});
}

}  // namespace piola::nodal
