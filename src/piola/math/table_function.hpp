// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

namespace piola {

/// A function given by a table of points. Between them it is a straight line, or a cubic without overshoot. Immutable,
/// so that any number of threads may evaluate it.
class TableFunction {
 public:
  enum class Interpolation { linear, smooth };
  /// The value outside the table: that of its end, zero, or not a number.
  enum class Outside { hold, zero, error };
  /// The function itself, or its derivative.
  enum class Gives { value, slope };
  struct Options {
    Interpolation interpolation = Interpolation::linear;
    Outside before = Outside::hold, after = Outside::hold;
    Gives gives = Gives::value;
  };

  /// Preconditions: at least two points, as many y as x, x increasing, all finite.
  TableFunction(std::vector<double> x, std::vector<double> y, Options options);

  /// Value at x, in logarithmic time. The slope of straight lines at a point of the table is that to its right, at the
  /// last point that to its left.
  double operator()(double x) const;

 private:
  double inside(double x) const;
  double outside(double end, Outside what) const;

  std::vector<double> x_, y_;
  std::vector<double> slope_;  ///< at the points; smooth
  Options options_;
};

/// Slopes at the points of a table for cubic Hermite interpolation that is monotone where the points are: the weighted
/// harmonic mean of the neighbouring secants (F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300-304,
/// eq. 5), and at the ends the three-point formula, limited to keep the shape (C. Moler, Numerical Computing with
/// MATLAB, SIAM 2004, section 3.6). PCHIP of SLATEC, MATLAB and SciPy computes the same.
std::vector<double> monotone_slopes(std::vector<double> const& x, std::vector<double> const& y);

}  // namespace piola
