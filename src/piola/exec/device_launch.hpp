// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/parallel.hpp"

/// What machine.cu of every formulation launches its passes with.
namespace piola::inline PIOLA_MACHINE {
namespace exec {

template <class Pass>
Pass const& as(void const* pass) {
  return *static_cast<Pass const*>(pass);
}

/// A sweep by itself: sums go to scratch in device memory instead of a core's cache.
template <class Sweep>
struct WithScratch {
  Sweep sweep;
  Scratch scratch;
  PIOLA_FN void operator()(Index i) const { sweep(i, scratch); }
};

}  // namespace exec
}  // namespace piola::inline PIOLA_MACHINE
