// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/integration_constraint.hpp"
#include "piola/formulations/nodal/neighbour_records.hpp"
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace piola::nodal {

/// The matrix of the system for the divergence theorem, (M x)_b = sum_a s_ab V_a (x_b - (least-squares quadratic of x
/// about a)(X_b)), b = a included, for D columns at once. All lengths in spacings; D numbers per particle.
template <int D>
class ProjectionMatrix {
 public:
  static constexpr int values = Quadratic<D>::values;

  /// halo: of ghosts, without fields, if the body is distributed: the matrix then has the rows of local particles.
  ProjectionMatrix(LocalFits<D> const& fits, LazyZeroArray<ScaledCell> const& cells, Backend const& backend,
                   LatticeLayout const* lattice, HaloPlan const* halo);
  ProjectionMatrix(ProjectionMatrix const&) = delete;
  ProjectionMatrix& operator=(ProjectionMatrix const&) = delete;

  /// Collective.
  void apply(LazyZeroArray<double> const& x, LazyZeroArray<double>& image);
  LazyZeroArray<double> const& diagonal() const { return diagonal_; }
  /// Inverse entry (m, n) of the normal equations of particle i.
  double inverse(Index i, int m, int n) const {
    int const row = std::min(m, n), column = std::max(m, n);
    return inverse_.at(groups_ ? groups_->place(i) : i, row * values - row * (row - 1) / 2 + column - row);
  }
  /// Moves out the quadratics of the last product: values x D per particle. Call after the last apply().
  std::unique_ptr<Field> take_coefficients() { return std::move(coefficients_); }

 private:
  void allocate(LatticeLayout const* lattice);
  void distribute(HaloPlan const& halo);
  void fill(LocalFits<D> const& fits, LazyZeroArray<ScaledCell> const& cells);
  /// Upper triangle, row by row.
  static constexpr int triangle = values * (values + 1) / 2;
  using Inverse = std::array<double, static_cast<std::size_t>(triangle)>;
  void fill_sums_and_inverses(LocalFits<D> const& fits, LazyZeroArray<double>& explained);
  Inverse fill_sums(LocalFits<D> const& fits, std::size_t a, LazyZeroArray<double>& explained);

  Backend const& backend_;
  Index particles_, slots_;
  Range own_;
  FieldList fields_;
  NeighbourRecords records_;
  std::optional<UniqueLaneGroups> groups_;  ///< of a lattice: groups with equal inverses
  Field inverse_, weights_;
  std::unique_ptr<Field> coefficients_;
  LazyZeroArray<std::int64_t> begin_;
  LazyZeroArray<double> diagonal_;
  std::optional<HaloPlan> halo_;
  FailureSlot failure_;
  BodyState state_{&fields_, D};
};

extern template class ProjectionMatrix<1>;
extern template class ProjectionMatrix<2>;
extern template class ProjectionMatrix<3>;

}  // namespace piola::nodal
