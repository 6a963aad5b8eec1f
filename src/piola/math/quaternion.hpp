// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"
#include <cmath>

namespace piola::inline PIOLA_BACKEND {

/// A rotation as a unit quaternion w + x i + y j + z k; the identity by default.
struct Quaternion {
  double w = 1;
  Vec<3> v;
};

/// First b, then a.
inline Quaternion operator*(Quaternion const& a, Quaternion const& b) {
  return {a.w * b.w - dot(a.v, b.v), a.w * b.v + b.w * a.v + cross(a.v, b.v)};
}

/// By an angle [rad] about a unit vector.
inline Quaternion turn_about(Vec<3> const& axis, double angle) {
  return {std::cos(0.5 * angle), std::sin(0.5 * angle) * axis};
}

/// By the angle and about the axis of a rotation vector [rad].
inline Quaternion turn_by(Vec<3> const& vector) {
  double const angle = std::sqrt(dot(vector, vector));
  return angle > 0 ? turn_about((1 / angle) * vector, angle) : Quaternion{};
}

/// Removes the drift of the length by rounding over many products.
inline Quaternion of_unit_length(Quaternion const& q) {
  double const scale = 1 / std::sqrt(q.w * q.w + dot(q.v, q.v));
  return {scale * q.w, scale * q.v};
}

/// R with R a the turned vector.
inline Mat<3> matrix_of(Quaternion const& q) {
  auto const [x, y, z] = q.v.c;
  return {{1 - 2 * (y * y + z * z), 2 * (x * y - q.w * z), 2 * (x * z + q.w * y),  //
           2 * (x * y + q.w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - q.w * x),  //
           2 * (x * z - q.w * y), 2 * (y * z + q.w * x), 1 - 2 * (x * x + y * y)}};
}

/// The rotation vector of a turn, of a length up to pi [rad].
inline Vec<3> rotation_vector(Quaternion const& q) {
  double const sine = std::sqrt(dot(q.v, q.v));
  if (!(sine > 0)) return {};
  double const half = std::atan2(sine, q.w < 0 ? -q.w : q.w);
  return ((q.w < 0 ? -2 : 2) * half / sine) * q.v;
}

}  // namespace piola::inline PIOLA_BACKEND
