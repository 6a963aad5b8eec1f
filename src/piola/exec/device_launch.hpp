// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"

/// Helpers with which backend.cu of every formulation launches its passes.
namespace piola::inline PIOLA_BACKEND {
namespace exec {

template <class Pass>
Pass const& as(void const* pass) {
  return *static_cast<Pass const*>(pass);
}

/// A sweep that is not fused with a point-wise pass: its sums go to scratch in device memory instead of the cache of a
/// core.
template <class Sweep>
struct WithScratch {
  Sweep sweep;
  Scratch scratch;
  PIOLA_FN void operator()(Index i) const { sweep(i, scratch); }
};

}  // namespace exec
}  // namespace piola::inline PIOLA_BACKEND
