// SPDX-License-Identifier: Apache-2.0
#include "piola/kernels/registry.hpp"
#include "piola/kernels/cubic_spline.hpp"
#include "piola/kernels/quartic_spline.hpp"
#include "piola/kernels/quintic_spline.hpp"
#include "piola/kernels/wendland_c2.hpp"
#include "piola/kernels/wendland_c4.hpp"
#include <array>

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

template <class K>
constexpr Kernel entry() {
  return {K::name, K::about, K::support, &K::sigma, &w_of<K>, &dw_of<K>};
}

constexpr std::array all{entry<CubicSpline>(), entry<QuarticSpline>(), entry<QuinticSpline>(), entry<WendlandC2>(),
                         entry<WendlandC4>()};

}  // namespace

std::span<Kernel const> kernels() { return all; }

Kernel const* find_kernel(std::string_view name) {
  for (auto const& kernel : all)
    if (kernel.name == name) return &kernel;
  return nullptr;
}

}  // namespace piola
