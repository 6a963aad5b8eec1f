// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"
#include <cmath>
#include <random>

/// Random tensors for tests. They are equal on every computer, as no standard distribution is used.
namespace piola::testing {

class Random {
 public:
  explicit Random(std::uint32_t seed) : bits_(seed) {}
  /// Uniformly distributed in [low, high).
  double in(double low, double high) { return low + (high - low) * static_cast<double>(bits_()) / 4294967296.0; }
  Vec<3> vector(double size) { return {{in(-size, size), in(-size, size), in(-size, size)}}; }
  Mat<3> matrix(double size) {
    Mat<3> A;
    for (double& c : A.c) c = in(-size, size);
    return A;
  }
  /// Rotation about a random axis by a random angle (Rodrigues).
  Mat<3> rotation();

 private:
  std::mt19937 bits_;
};

/// Rotation by `angle` about the axis `n` (of any length).
inline Mat<3> rotation_about(Vec<3> n, double angle) {
  n = (1 / std::sqrt(dot(n, n))) * n;
  Mat<3> const W{{0, -n[2], n[1], n[2], 0, -n[0], -n[1], n[0], 0}};
  return identity<3>() + std::sin(angle) * W + (1 - std::cos(angle)) * (W * W);
}

inline Mat<3> Random::rotation() { return rotation_about(vector(1) + Vec<3>{{0, 0, 2}}, in(-3, 3)); }

inline Mat<3> diagonal(double a, double b, double c) { return {{a, 0, 0, 0, b, 0, 0, 0, c}}; }

/// Largest absolute component.
inline double size(Mat<3> const& A) {
  double most = 0;
  for (double const c : A.c) most = std::fmax(most, std::fabs(c));
  return most;
}

}  // namespace piola::testing
