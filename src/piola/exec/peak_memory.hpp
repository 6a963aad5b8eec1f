// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"

/// Peak rates of this machine, for the roofline of `piola bench`.
namespace piola::inline PIOLA_BACKEND {
namespace exec {

/// Executes 16 independent chains of `rounds` fused multiply-adds on packs of lanes; returns a number that depends on
/// all of them, so that none is left out. Operations: 16 * rounds vector instructions.
inline constexpr int fma_chains = 16;
inline double run_fma_chains(long rounds) {
  Lanes chain[fma_chains];
  for (int k = 0; k < fma_chains; ++k) chain[k] = Lanes(1.0 + 0.01 * k);
  Lanes const factor(0.999999), summand(1e-6);
  for (long r = 0; r < rounds; ++r)
    for (int k = 0; k < fma_chains; ++k) chain[k] = chain[k] * factor + summand;
  double sum = 0;
  for (int k = 0; k < fma_chains; ++k) sum += lane(chain[k], 0);
  return sum;
}

/// Copies n doubles (a multiple of the lane count) from one array to another.
struct CopyLanes {
  double const* from;
  double* to;
  void operator()(Index i) const { store(load<Lanes>(from + i), to + i); }
};
inline void copy(double const* from, double* to, Index n) { for_each(Range{0, n}, CopyLanes{from, to}); }

}  // namespace exec
}  // namespace piola::inline PIOLA_MACHINE
