// SPDX-License-Identifier: Apache-2.0
#include "piola/kernels/list.hpp"

namespace piola {
namespace {

/// w and dw of a kernel: most have one shape for every dimension.
template <class K>
double w_of(int dimension, double q) {
  if constexpr (requires { K::w(dimension, q); })
    return K::w(dimension, q);
  else
    return K::w(q);
}
template <class K>
double dw_of(int dimension, double q) {
  if constexpr (requires { K::dw(dimension, q); })
    return K::dw(dimension, q);
  else
    return K::dw(q);
}

template <class... K>
constexpr std::array<Kernel, sizeof...(K)> entries(KernelList<K...>) {
  return {Kernel{K::name, K::about, K::support, &K::sigma, &w_of<K>, &dw_of<K>}...};
}

constexpr auto all = entries(Kernels{});

}  // namespace

std::span<Kernel const> kernels() { return all; }

Kernel const* find_kernel(std::string_view name) {
  for (auto const& kernel : all)
    if (kernel.name == name) return &kernel;
  return nullptr;
}

}  // namespace piola
