// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_advection/wave.hpp"
#include <cmath>
#include <numbers>

namespace piola::jst_advection {
namespace {

/// (C.2) times dt.
Wave rate(Wave const& u, double alpha, double eps4) {
  std::size_t const n = u.size();
  Wave r(n);
  for (std::size_t a = 0; a < n; ++a) {
    double const before2 = u[(a + n - 2) % n], before = u[(a + n - 1) % n];
    double const after = u[(a + 1) % n], after2 = u[(a + 2) % n];
    double const fourth = after2 - 4 * after + 6 * u[a] - 4 * before + before2;
    r[a] = -0.5 * alpha * (after - before) - alpha * eps4 * fourth;
  }
  return r;
}

}  // namespace

Wave advance(Wave const& u, double alpha, double eps4) {
  Wave const first = rate(u, alpha, eps4);
  Wave star = u, next = u;
  for (std::size_t a = 0; a < u.size(); ++a) star[a] += first[a];
  Wave const second = rate(star, alpha, eps4);
  for (std::size_t a = 0; a < u.size(); ++a) next[a] += 0.5 * (first[a] + second[a]);
  return next;
}

std::complex<double> fourier_coefficient(Wave const& u, int m) {
  auto const n = static_cast<double>(u.size());
  std::complex<double> sum = 0;
  for (std::size_t a = 0; a < u.size(); ++a)
    sum += u[a] * std::polar(1.0, -2 * std::numbers::pi * m * static_cast<double>(a) / n);
  return sum / n;
}

int dominant_mode(Wave const& u) {
  int best = 1;
  double most = 0;
  for (int m = 1; 2 * m <= static_cast<int>(u.size()); ++m) {
    double const size = std::abs(fourier_coefficient(u, m));
    if (size > most) best = m;
    most = std::max(most, size);
  }
  return best;
}

double level(Wave const& u) {
  double sum = 0;
  for (double const value : u) sum += value * value;
  return std::sqrt(sum / static_cast<double>(u.size()));
}

NumericalError numerical_error(std::complex<double> ratio, double kh, double distance) {
  if (!(distance > 0) || !(std::abs(ratio) > 0)) return {};
  // log(ratio) = distance (-i k - dispersion i k^3/6 - diffusion k^4), with k in units of 1/h
  double const lag = std::arg(ratio * std::polar(1.0, kh * distance));
  return {-6 * lag / (distance * kh * kh * kh), -std::log(std::abs(ratio)) / (distance * std::pow(kh, 4))};
}

}  // namespace piola::jst_advection
