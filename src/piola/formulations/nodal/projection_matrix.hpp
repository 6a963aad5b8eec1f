// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/closure.hpp"
#include "piola/formulations/nodal/gathered.hpp"
#include <algorithm>
#include <optional>
#include <vector>

namespace piola::nodal {

/// The matrix of the system for the divergence theorem, (M x)_b = sum_a s_ab V_a (x_b - (least-squares quadratic of x
/// about a)(X_b)), b = a included, for D columns at once. All lengths in spacings; D numbers per particle.
template <int D>
class ProjectionMatrix {
 public:
  static constexpr int values = Quadratic<D>::values;

  /// halo: of neighbours, without fields, where ranks share the body: each has its own rows then, and what is said
  /// about particles is of its own.
  ProjectionMatrix(Fits<D> const& fits, std::vector<ScaledCell> const& cells, Machine const& machine,
                   LatticeLayout const* lattice, HaloPlan const* halo);
  ProjectionMatrix(ProjectionMatrix const&) = delete;
  ProjectionMatrix& operator=(ProjectionMatrix const&) = delete;

  /// Collective on ranks.
  void apply(PartFilled<double> const& x, PartFilled<double>& image);
  PartFilled<double> const& diagonal() const { return diagonal_; }
  /// Of the normal equations of particle i.
  double inverse(Index i, int m, int n) const {
    int const row = std::min(m, n), column = std::max(m, n);
    return inverse_.at(i, row * values - row * (row - 1) / 2 + column - row);
  }
  /// Of the quadratics of the last product: values x D per particle.
  PartFilled<double> coefficients() const;

 private:
  template <class F>
  void each_own(F const& f) const;
  void allocate(LatticeLayout const* lattice);
  void share(HaloPlan const& halo);
  void fill(Fits<D> const& fits, std::vector<ScaledCell> const& cells);
  void fill_sums(Fits<D> const& fits, std::size_t a, PartFilled<double>& explained);
  void copy_sums(std::size_t from, std::size_t a);

  Machine const& machine_;
  Index particles_, slots_;
  Range own_;
  Fields fields_{D};
  Gathered gathered_;
  Field inverse_, weights_, coefficients_;
  std::vector<std::int64_t> begin_;
  PartFilled<double> diagonal_;
  std::optional<HaloPlan> halo_;
  FailureSlot failure_;
  BodyState state_;
};

extern template class ProjectionMatrix<1>;
extern template class ProjectionMatrix<2>;
extern template class ProjectionMatrix<3>;

}  // namespace piola::nodal
