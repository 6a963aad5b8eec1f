// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/piola_material.h"
#include "piola/math/tensor.hpp"
#include <array>
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

/// Description of a law with a history, whose parameters, like its texts, are those of its LawInfo.
template <std::size_t N>
constexpr piola_material with_history(char const* name, int properties, std::array<piola_history, N> const& history,
                                      decltype(piola_material::check) check, decltype(piola_material::update) update,
                                      decltype(piola_material::start) start = nullptr) {
  return {PIOLA_MATERIAL_INTERFACE,
          name,
          "",
          PIOLA_COROTATED_CAUCHY,
          properties,
          0,
          nullptr,
          static_cast<int>(N),
          history.data(),
          check,
          start,
          update};
}

/// Result of piola_material::check: writes the problem, which is empty if parameters go together.
inline int put_message(std::string const& problem, char* message, int size) {
  message[problem.copy(message, static_cast<std::size_t>(size) - 1)] = 0;
  return problem.empty() ? 0 : 1;
}

}  // namespace piola::block_laws
