// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"

namespace piola::inline PIOLA_BACKEND {

/// The eigenvalues of C = F^T F as q + p t, where t^3 - 3 t = 2 r; the smallest root is t = -1 - d.
template <class T>
struct StretchRoots {
  T q, p, d;
};

/// With q = tr C / 3, B = C - q I, p = sqrt(B:B / 6) and r = det(B / p) / 2; then d sqrt(3 + d) = sqrt(2 (1 - r)). This
/// form has no multiple root, so two Newton steps from a rational start reach round-off for every r in [-1, 1], with no
/// trigonometry.
template <class T>
PIOLA_INLINE_FN StretchRoots<T> stretch_roots(Mat<3, T> const& F) {
  Mat<3, T> B = transpose(F) * F;
  T const q = trace(B) * (1.0 / 3.0);
  for (int i = 0; i < 3; ++i) B(i, i) = B(i, i) - q;
  T const p = square_root(contract(B, B) * (1.0 / 6.0));
  T const safe = maximum(p, T(1e-150));
  T const scale = 1.0 / safe;
  T const r = minimum(maximum(0.5 * determinant(scale * B), T(-1.0)), T(1.0));
  T const m = square_root(2.0 * (1.0 - r));
  T d = m / (1.7320508075688772 + m * (0.160685 - 0.013355 * m));  // 6e-4 off at most
  for (int k = 0; k < 2; ++k) {
    T const s = square_root(3.0 + d);
    d = d - 2.0 * s * (d * s - m) / (6.0 + 3.0 * d);
  }
  return {q, p, d};
}

/// Smallest eigenvalue of C = F^T F, i.e. the square of the smallest principal stretch.
template <class T>
PIOLA_INLINE_FN T smallest_stretch_squared(Mat<3, T> const& F) {
  auto const [q, p, d] = stretch_roots(F);
  return q - p * (1.0 + d);
}

/// All eigenvalues of C = F^T F, smallest first. Near a double root the two larger ones carry the square root of the
/// round-off.
template <class T>
PIOLA_INLINE_FN Vec<3, T> principal_stretches_squared(Mat<3, T> const& F) {
  auto const [q, p, d] = stretch_roots(F);
  // t^3 - 3 t = 2 r divided by its smallest root t_1 = -1 - d: t^2 + t_1 t + t_1^2 - 3 = 0.
  T const middle = 0.5 * (1.0 + d), apart = square_root(maximum(3.0 - 3.0 * (middle * middle), T(0.0)));
  return {{q - p * (1.0 + d), q + p * (middle - apart), q + p * (middle + apart)}};
}

}  // namespace piola::inline PIOLA_BACKEND
