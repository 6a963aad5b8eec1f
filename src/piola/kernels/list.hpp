// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/kernels/cubic_spline.hpp"
#include "piola/kernels/quartic_spline.hpp"
#include "piola/kernels/quintic_spline.hpp"
#include "piola/kernels/registry.hpp"
#include "piola/kernels/wendland_c2.hpp"
#include "piola/kernels/wendland_c4.hpp"
#include <array>
#include <string_view>

namespace piola::inline PIOLA_BACKEND {

template <class... K>
struct KernelList {
  static constexpr std::array<std::string_view, sizeof...(K)> names{K::name...};
};

/// All kernels: adding one is its header and its name here. The first is the usual one.
using Kernels = KernelList<CubicSpline, QuarticSpline, QuinticSpline, WendlandC2, WendlandC4>;
/// Kernels that loops over moving neighbours can evaluate, lane by lane.
using LaneKernels = KernelList<CubicSpline, WendlandC2>;

/// f.template operator()<K>() for the kernel of the list that was chosen.
template <class F, class... K>
void with_kernel(Kernel const& chosen, KernelList<K...>, F const& f) {
  static_cast<void>(((chosen.name == K::name && (f.template operator()<K>(), true)) || ...));
}

}  // namespace piola::inline PIOLA_BACKEND
