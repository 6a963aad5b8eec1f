// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace piola {

/// Observed order, limit and estimated errors of one quantity at two or three spacings.
///
/// Three values that change in one direction have an observed order p and a limit q0 (Richardson), which solve
/// q(h) = q0 + c h^p. Errors are estimated as the grid convergence index of Roache, Annu. Rev. Fluid Mech. 29 (1997)
/// 123-160: 1.25 times the distance to q0. An order above 2, that of the formulations, is reported, but 2 is used. Two
/// values: an order of 2 is assumed, and the factor is 3. Values that change in different directions: three times their
/// largest difference, as Eca and Hoekstra, J. Comput. Phys. 262 (2014) 104-130.
struct Convergence {
  enum class Kind {
    monotonic,    ///< the values approach a limit, with an order of at least 0.5
    two_values,   ///< no order can be observed
    unchanged,    ///< they differ by round-off only
    slow,         ///< an order below 0.5: no estimate
    oscillating,  ///< they change in different directions: no order
    diverging,    ///< the change grows from step to step: no estimate
    missing       ///< a run has no value
  };
  Kind kind = Kind::missing;
  std::vector<double> values = {};          ///< from the coarsest spacing to the finest
  std::optional<double> order = {};         ///< observed
  std::optional<double> extrapolated = {};  ///< for spacing 0
  std::vector<double> errors = {};          ///< estimated error of each value; empty: unknown
  double spread = 0;                        ///< largest minus smallest value
  /// Whether there is an estimate of the error.
  bool has_errors() const { return !errors.empty(); }
};

/// `spacings`: two or three, falling; only their ratios count. `values`: as many, finite, or none of them if a run has
/// no value.
Convergence convergence_of(std::span<double const> spacings, std::span<double const> values);

}  // namespace piola
