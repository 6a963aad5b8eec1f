// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <complex>
#include <vector>

/// The discrete advection equation of Appendix C, and its numerical errors.
namespace piola::jst_advection {

using Wave = std::vector<double>;  ///< one value per particle of a periodic row

/// One step of (C.3): two-stage TVD Runge-Kutta with the rate (C.2); alpha = c dt / h.
Wave advance(Wave const& u, double alpha, double eps4);

/// (1/n) sum u_a exp(-2 pi i m a / n).
std::complex<double> fourier_coefficient(Wave const& u, int m);

/// The m from 1 to n/2 with the largest coefficient.
int dominant_mode(Wave const& u);

/// Root mean square.
double level(Wave const& u);

/// Damping and lag of a mode: u_t + c u_x = dispersion (c h^2/6) u_xxx - diffusion c h^3 u_xxxx, (C.4).
struct NumericalError {
  double dispersion = 0;  ///< alpha^2 - 1 to leading order
  double diffusion = 0;   ///< eps4 - alpha^3/8 to leading order
};

/// From the ratio of a mode's coefficient to that at the start, after it travelled `distance` = c t / h spacings.
/// `kh`: wave number times spacing. Valid while the mode lags by less than half a wave.
NumericalError numerical_error(std::complex<double> ratio, double kh, double distance);

}  // namespace piola::jst_advection
