// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/piola_material.h"
#include "piola/math/tensor.hpp"

/// Tensors of single points in the arrays of piola_points.
namespace piola::block_laws {

inline Mat<3> matrix_at(double const* array, piola_points const& at, int p) {
  Mat<3> r;
  for (int c = 0; c < 9; ++c) r.c[c] = array[c * at.stride + p];
  return r;
}
inline SymMat<3> symmetric_at(double const* array, piola_points const& at, int p) {
  SymMat<3> r;
  for (int c = 0; c < 6; ++c) r.c[c] = array[c * at.stride + p];
  return r;
}
template <class Tensor>
void put(Tensor const& tensor, double* array, piola_points const& at, int p) {
  constexpr int components = static_cast<int>(sizeof(tensor.c) / sizeof(double));
  for (int c = 0; c < components; ++c) array[c * at.stride + p] = tensor.c[c];
}

}  // namespace piola::block_laws
