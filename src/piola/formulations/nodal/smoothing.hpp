// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/set_up.hpp"
#include <vector>

namespace piola::nodal {

/// A smoother of values of cells for output. Symmetric, and doubly stochastic in the volumes of the cells:
///   (S f)_a = f_a (1 - sum_b s_ab V_b) + sum_b s_ab V_b f_b,   s_ab = d_a W_ab d_b,
/// with W of support 2.4 spacings and d such that every row sums to one: constants stay, and so does sum V f.
/// Theory: docs/theory/nodal.md, section 7.
class Smoothing {
 public:
  /// For all particles; or, on a distributed body, for the local ones, with a halo of ghosts without fields. Then all
  /// members are collective.
  Smoothing(Reference const& reference, int dimension, Range own, HaloPlan const* halo = nullptr);

  /// Returns S^2 f, values per slot, of local particles.
  LazyZeroArray<double> operator()(LazyZeroArray<double> f) const;

 private:
  template <class F>
  void each_particle(F const& f) const;
  void find_weights(Reference const& reference, std::size_t dimension);
  void balance();
  LazyZeroArray<double> once(LazyZeroArray<double> f) const;
  void tell(LazyZeroArray<double>& values) const;

  /// The particle of pair k, or the source of an image.
  std::size_t owner(std::size_t k) const { return static_cast<std::size_t>(reference_.owner(neighbour_[k])); }

  Reference const& reference_;
  LazyZeroArray<std::int64_t> const& begin_;
  std::vector<Index> const& neighbour_;
  LazyZeroArray<double> const& V_;
  Range range_;
  HaloPlan const* halo_;
  std::vector<double> weight_;  ///< W per pair, then d_a W d_b V_b
  LazyZeroArray<double> own_;   ///< 1 - sum_b s_ab V_b
};

}  // namespace piola::nodal
