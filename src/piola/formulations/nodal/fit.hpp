// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/lattice_layout.hpp"
#include "piola/formulations/nodal/quadratic.hpp"
#include "piola/math/lanes.hpp"
#include <array>
#include <cstdint>
#include <vector>

/// Weighted least-squares quadratics through the neighbours of each particle. All lengths in spacings.
/// Theory: docs/theory/nodal.md, section 3.
namespace piola::nodal {

using Points = std::vector<std::array<double, 3>>;

/// Neighbours of every particle, both directions of each pair, in increasing order.
struct Pairs {
  std::vector<std::int64_t> begin;  ///< per particle, one more at the end
  std::vector<Index> neighbour;
  std::vector<double> weight;  ///< the same in both directions

  std::size_t first(std::size_t a) const { return static_cast<std::size_t>(begin[a]); }
  std::size_t end(std::size_t a) const { return static_cast<std::size_t>(begin[a + 1]); }
  std::size_t at(std::size_t k) const { return static_cast<std::size_t>(neighbour[k]); }
};

/// Per particle of a lattice the first one that is as far from every face, or at least `beyond` spacings as well.
std::vector<Index> alike_in_lattice(LatticeShape const& shape, int beyond);

/// All pairs of a lattice nearer than the usual reach, with their weights.
Pairs lattice_pairs(LatticeShape const& shape);

/// All pairs nearer than the larger of their two reaches.
Pairs find_pairs(Points const& X, std::vector<double> const& reach);

/// The fits of a cloud:  e_ab = s_ab A_a^-1 p(r_ab),  A_a = sum_b s_ab p p^T,  p without the constant,
/// s = (1 - (r/R)^2)^2 / r^3 with R = 2.4, or more where neighbours do not determine a quadratic well.
template <int D>
class Fits {
 public:
  static constexpr int terms = Quadratic<D>::terms;
  using Monomials = std::array<double, static_cast<std::size_t>(terms)>;

  /// lattice: the one that the points fill, if they do; a neighbourhood is fitted once then, however often it occurs.
  explicit Fits(Points const& X, std::optional<LatticeShape> const& lattice = std::nullopt);

  /// Whether all reaches are the usual one, and the neighbours of a lattice those of its loops.
  bool usual() const { return usual_; }
  /// A particle whose neighbours determine no quadratic at any reach; -1: none.
  Index hopeless() const { return hopeless_; }
  Pairs const& pairs() const { return pairs_; }
  Points const& X() const { return X_; }
  /// (A^-1)_kl of a particle.
  double inverse(std::size_t a, int k, int l) const {
    return inverse_[a * static_cast<std::size_t>(terms * terms) + static_cast<std::size_t>(k * terms + l)];
  }
  /// The first particle whose neighbours stand as those of a, in the same order: of a lattice; a itself in other
  /// clouds.
  std::size_t alike(std::size_t a) const { return alike_.empty() ? a : static_cast<std::size_t>(alike_[a]); }
  /// p of a pair, without the constant.
  Monomials monomials_of(std::size_t a, std::size_t b) const;
  /// e_ab: how the derivatives at a, first and second, depend on the value at b.
  Monomials derivatives(std::size_t a, std::size_t pair) const;
  /// s of a particle with itself, in fits that count its own value: that of a neighbour at distance one.
  double own_weight(std::size_t a) const;

 private:
  void fit_lattice(LatticeShape const& shape);
  void fit_cloud();
  bool fit(std::size_t a);

  Points X_;
  std::vector<double> reach_;
  Pairs pairs_;
  std::vector<double> inverse_;
  std::vector<Index> alike_;
  Index hopeless_ = -1;
  bool usual_ = true;
};

extern template class Fits<1>;
extern template class Fits<2>;
extern template class Fits<3>;

}  // namespace piola::nodal
