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
  if (!(found.divergence <= allowed) || !(found.rows <= allowed))
    throw InputError(fmt::format(
        "body '{}': gradients miss the divergence theorem by {:.3g} faces of a particle, and those of quadratic fields "
        "by {:.3g} / spacing (allowed: {:.2g}) - this is an error of the program: please report it with the case; "
        "jitter = 0.001 or a little more particles may avoid it",
        from.body.name, found.divergence, found.rows, allowed));
  std::string const of_body = from.body.name + ".";
  checks.push_back({of_body + "divergence_error", found.divergence, ""});
  checks.push_back({of_body + "gradient_error", found.rows, ""});
  checks.push_back({of_body + "largest_gradient", found.steepest, ""});
  checks.push_back({of_body + "enlarged_supports", found.enlarged, ""});
}

void check_surface(SetUp const& from, ScaledBody const& body, std::vector<SetUpCheck>& checks) {
  if (!from.body.outline.patches) return;
  checks.push_back({from.body.name + ".farthest_surface_move", body.farthest_move, ""});
  std::string warning;
  if (body.unmoved > 0)
    warning = fmt::format(
        "body '{}': {:.0f} corners of cells are too far from the surface to be moved onto it, so that cells there are "
        "steps of a sixth of a spacing - use smaller spacings if the surface has details of this size",
        from.body.name, body.unmoved);
  checks.push_back({from.body.name + ".unmoved_corners", body.unmoved, warning});
}

}  // namespace piola::nodal
