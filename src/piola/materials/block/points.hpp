// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/piola_material.h"
#include "piola/math/tensor.hpp"
#include <span>
#include <string>

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

/// The tensor with all its components.
inline Mat<3> full(SymMat<3> const& s) { return identity<3>() * s; }

/// C = F^T F.
inline SymMat<3> right_cauchy_green(Mat<3> const& F) {
  SymMat<3> C;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) C(i, j) = F(0, i) * F(0, j) + F(1, i) * F(1, j) + F(2, i) * F(2, j);
  return C;
}

/// Description of a law whose parameters, like its texts, are those of its LawInfo.
constexpr piola_material describe(char const* name, int stress, int properties, std::span<piola_history const> history,
                                  decltype(piola_material::check) check, decltype(piola_material::update) update,
                                  decltype(piola_material::start) start = nullptr) {
  return {PIOLA_MATERIAL_INTERFACE,         name,           "",    stress, properties, 0, nullptr,
          static_cast<int>(history.size()), history.data(), check, start,  update};
}

/// Result of piola_material::check: writes the problem, which is empty if parameters go together.
inline int put_message(std::string const& problem, char* message, int size) {
  message[problem.copy(message, static_cast<std::size_t>(size) - 1)] = 0;
  return problem.empty() ? 0 : 1;
}

}  // namespace piola::block_laws
