// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field_view.hpp"
#include "piola/formulations/nodal/lattice.hpp"
#include "piola/formulations/nodal/quadratic.hpp"

/// Sums over the neighbours of particles that fill a lattice. Lanes are consecutive particles of rows along the first
/// direction, so a neighbour of all lanes is one contiguous load. Lanes without that neighbour have zero gradients;
/// what lies there in memory is finite.
namespace piola::nodal::inline PIOLA_BACKEND {

template <int D>
struct LatticeSums {
  static constexpr int numbers = D + Quadratic<D>::second;  ///< of a gradient

  LatticeTable table;
  View x;       ///< component after component
  View stress;  ///< (P, Q), row after row; component after component

  /// Component c of F_a and H_a: sum_b (x_b - x_a) (G_ab, K_ab).
  PIOLA_INLINE_FN void of_motion(Index i, int c, Lanes (&sum)[numbers]) const {
    double const* const at = x.data + c * x.component_stride + i;
    double const* gradient = table.motion + first_of(i);
    Lanes const own = load<Lanes>(at);
    for (int n = 0; n < numbers; ++n) sum[n] = Lanes(0.0);
    for (int o = 0; o < table.offsets; ++o, gradient += numbers * lane_count) {
      Lanes const moved = load<Lanes>(at + table.offset[o]) - own;
      for (int n = 0; n < numbers; ++n) sum[n] = sum[n] + moved * load<Lanes>(gradient + n * lane_count);
    }
  }

  /// Force of the neighbours' stresses: sum_b V_b (P_b G_ba + Q_b K_ba). The sums of every third number are apart:
  /// three chains of additions for each component.
  PIOLA_INLINE_FN Vec<D, Lanes> of_stress(Index i) const {
    constexpr int chains = numbers % 3 == 0 ? 3 : 1;
    double const* gradient = table.force + first_of(i);
    Lanes sum[D][chains];
    for (int c = 0; c < D; ++c)
      for (int k = 0; k < chains; ++k) sum[c][k] = Lanes(0.0);
    for (int o = 0; o < table.offsets; ++o) {
      double const* const at = stress.data + i + table.offset[o];
      for (int n = 0; n < numbers; n += chains, gradient += chains * lane_count)
        for (int c = 0; c < D; ++c)
          for (int k = 0; k < chains; ++k)
            sum[c][k] = sum[c][k] + load<Lanes>(at + (c * numbers + n + k) * stress.component_stride) *
                                        load<Lanes>(gradient + k * lane_count);
    }
    Vec<D, Lanes> force;
    for (int c = 0; c < D; ++c) {
      force[c] = sum[c][0];
      for (int k = 1; k < chains; ++k) force[c] = force[c] + sum[c][k];
    }
    return force;
  }

 private:
  PIOLA_INLINE_FN std::ptrdiff_t first_of(Index i) const {
    return static_cast<std::ptrdiff_t>(table.group[i / lane_count]) * table.offsets * (numbers * lane_count);
  }
};

}  // namespace piola::nodal::inline PIOLA_BACKEND
