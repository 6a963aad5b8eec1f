// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string_view>

namespace piola {

/// A kernel chosen at run time; used where pairs are made, never inside a loop over steps.
struct Kernel {
  std::string_view name;
  std::string_view about;
  double support;                  ///< in units of h
  double (*sigma)(int dimension);  ///< normalisation
  double (*w)(int dimension, double q);
  double (*dw)(int dimension, double q);
};

/// All kernels, those of list.hpp.
std::span<Kernel const> kernels();
/// The kernel of that name, or nullptr.
Kernel const* find_kernel(std::string_view name);

}  // namespace piola
