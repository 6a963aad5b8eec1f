// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/scalar.hpp"
#include <type_traits>

namespace piola::inline PIOLA_BACKEND {

/// Vector of D components; T is `double` or a pack of lanes.
template <int D, class T = double>
struct Vec {
  T c[D]{};
  PIOLA_INLINE_FN T& operator[](int i) { return c[i]; }
  PIOLA_INLINE_FN T const& operator[](int i) const { return c[i]; }
};

/// D x D tensor, row by row: A(i, j) = A_ij.
template <int D, class T = double>
struct Mat {
  T c[D * D]{};
  PIOLA_INLINE_FN T& operator()(int i, int j) { return c[i * D + j]; }
  PIOLA_INLINE_FN T const& operator()(int i, int j) const { return c[i * D + j]; }
};

/// Symmetric tensor: diagonal first, then XY YZ XZ (2D: XY).
template <int D, class T = double>
struct SymMat {
  static constexpr int size = D * (D + 1) / 2;
  T c[size]{};
  /// Position of the component (i, j) in c.
  static constexpr int at(int i, int j) { return i == j ? i : (D == 2 ? 2 : (i + j == 1 ? 3 : (i + j == 3 ? 4 : 5))); }
  PIOLA_INLINE_FN T& operator()(int i, int j) { return c[at(i, j)]; }
  PIOLA_INLINE_FN T const& operator()(int i, int j) const { return c[at(i, j)]; }
};

template <int D, class T>
PIOLA_INLINE_FN Vec<D, T> operator+(Vec<D, T> a, Vec<D, T> const& b) {
  for (int i = 0; i < D; ++i) a[i] = a[i] + b[i];
  return a;
}
template <int D, class T>
PIOLA_INLINE_FN Vec<D, T> operator-(Vec<D, T> a, Vec<D, T> const& b) {
  for (int i = 0; i < D; ++i) a[i] = a[i] - b[i];
  return a;
}
template <int D, class T, class S>
  requires std::is_convertible_v<S, T> PIOLA_INLINE_FN Vec<D, T>
operator*(S const& s, Vec<D, T> a) {
  for (int i = 0; i < D; ++i) a[i] = s * a[i];
  return a;
}
template <int D, class T>
PIOLA_INLINE_FN T dot(Vec<D, T> const& a, Vec<D, T> const& b) {
  T sum = a[0] * b[0];
  for (int i = 1; i < D; ++i) sum = sum + a[i] * b[i];
  return sum;
}
template <class T>
PIOLA_INLINE_FN Vec<3, T> cross(Vec<3, T> const& a, Vec<3, T> const& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

template <int D, class T>
PIOLA_INLINE_FN Mat<D, T> operator+(Mat<D, T> A, Mat<D, T> const& B) {
  for (int k = 0; k < D * D; ++k) A.c[k] = A.c[k] + B.c[k];
  return A;
}
template <int D, class T>
PIOLA_INLINE_FN Mat<D, T> operator-(Mat<D, T> A, Mat<D, T> const& B) {
  for (int k = 0; k < D * D; ++k) A.c[k] = A.c[k] - B.c[k];
  return A;
}
template <int D, class T, class S>
  requires std::is_convertible_v<S, T> PIOLA_INLINE_FN Mat<D, T>
operator*(S const& s, Mat<D, T> A) {
  for (int k = 0; k < D * D; ++k) A.c[k] = s * A.c[k];
  return A;
}
template <int D, class T>
PIOLA_INLINE_FN Vec<D, T> operator*(Mat<D, T> const& A, Vec<D, T> const& b) {
  Vec<D, T> r;
  for (int i = 0; i < D; ++i) {
    r[i] = A(i, 0) * b[0];
    for (int j = 1; j < D; ++j) r[i] = r[i] + A(i, j) * b[j];
  }
  return r;
}
/// A B for any square tensor-like B with operator()(i, j), e.g. a symmetric one.
template <int D, class T, template <int, class> class Tensor>
PIOLA_INLINE_FN Mat<D, T> operator*(Mat<D, T> const& A, Tensor<D, T> const& B) {
  Mat<D, T> r;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      r(i, j) = A(i, 0) * B(0, j);
      for (int k = 1; k < D; ++k) r(i, j) = r(i, j) + A(i, k) * B(k, j);
    }
  return r;
}
template <int D, class T>
PIOLA_INLINE_FN Mat<D, T> transpose(Mat<D, T> const& A) {
  Mat<D, T> r;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) r(i, j) = A(j, i);
  return r;
}
template <int D, class T>
PIOLA_INLINE_FN Mat<D, T> outer(Vec<D, T> const& a, Vec<D, T> const& b) {
  Mat<D, T> r;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) r(i, j) = a[i] * b[j];
  return r;
}
template <int D, class T = double>
PIOLA_INLINE_FN Mat<D, T> identity() {
  Mat<D, T> r;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) r(i, j) = T(i == j ? 1.0 : 0.0);
  return r;
}
template <int D, class T>
PIOLA_INLINE_FN T trace(Mat<D, T> const& A) {
  T sum = A(0, 0);
  for (int i = 1; i < D; ++i) sum = sum + A(i, i);
  return sum;
}
/// A : B = A_ij B_ij
template <int D, class T>
PIOLA_INLINE_FN T contract(Mat<D, T> const& A, Mat<D, T> const& B) {
  T sum = A.c[0] * B.c[0];
  for (int k = 1; k < D * D; ++k) sum = sum + A.c[k] * B.c[k];
  return sum;
}
/// Cofactor H = det(A) A^-T (eq. 2 of Lee et al.: maps area vectors).
template <class T>
PIOLA_INLINE_FN Mat<3, T> cofactor(Mat<3, T> const& A) {
  Mat<3, T> H;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      int const p = (i + 1) % 3, q = (i + 2) % 3, r = (j + 1) % 3, s = (j + 2) % 3;
      H(i, j) = A(p, r) * A(q, s) - A(p, s) * A(q, r);
    }
  return H;
}
template <class T>
PIOLA_INLINE_FN T determinant(Mat<3, T> const& A) {
  return A(0, 0) * (A(1, 1) * A(2, 2) - A(1, 2) * A(2, 1)) - A(0, 1) * (A(1, 0) * A(2, 2) - A(1, 2) * A(2, 0)) +
         A(0, 2) * (A(1, 0) * A(2, 1) - A(1, 1) * A(2, 0));
}
template <class T>
PIOLA_INLINE_FN Mat<1, T> inverse(Mat<1, T> const& A) {
  return {{1.0 / A.c[0]}};
}
template <class T>
PIOLA_INLINE_FN Mat<2, T> inverse(Mat<2, T> const& A) {
  T const scale = 1.0 / (A(0, 0) * A(1, 1) - A(0, 1) * A(1, 0));
  return {{scale * A(1, 1), -scale * A(0, 1), -scale * A(1, 0), scale * A(0, 0)}};
}
template <class T>
PIOLA_INLINE_FN Mat<3, T> inverse(Mat<3, T> const& A) {
  return (1.0 / determinant(A)) * transpose(cofactor(A));
}
/// Tensor cross product (A x B)_iI = eps_ijk eps_IJK A_jJ B_kK; H = 1/2 F x F, J = 1/3 H:F.
template <class T>
PIOLA_INLINE_FN Mat<3, T> tensor_cross(Mat<3, T> const& A, Mat<3, T> const& B) {
  Mat<3, T> r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      int const p = (i + 1) % 3, q = (i + 2) % 3, s = (j + 1) % 3, t = (j + 2) % 3;
      r(i, j) = A(p, s) * B(q, t) - A(p, t) * B(q, s) + A(q, t) * B(p, s) - A(q, s) * B(p, t);
    }
  return r;
}

}  // namespace piola::inline PIOLA_BACKEND
