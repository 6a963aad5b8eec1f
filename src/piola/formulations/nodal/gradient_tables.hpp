// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/common/unique_lane_groups.hpp"
#include "piola/formulations/nodal/facet_fluxes.hpp"
#include "piola/formulations/nodal/set_up.hpp"

namespace piola::nodal {

/// Builds the data of the loops of D dimensions from cells, fits and gradients, in metres.
template <int D>
class GradientTables {
 public:
  GradientTables(SetUp const& from, ScaledBody const& scaled, LocalFits<D>& fits, FacetFluxes<D> const& fluxes,
                 Reference& to);
  /// mass: over that of a spacing. lattice: the one that loops use, if any. Moves the pairs out of the fits, except
  /// those of a body whose cells may fail.
  void operator()(LazyZeroArray<double> const& mass, std::optional<LatticeShape> const& lattice);
  /// Writes the gradients of these particles again, after cells have failed. Afterwards the lists of Reference are
  /// valid, and its `own`, `k` and `hoop` for these particles.
  void refill(std::vector<std::size_t> const& particles);
  bool is_local(std::size_t a) const { return a >= first_ && a < last_; }

 private:
  static constexpr auto dimension = static_cast<std::size_t>(D);
  static constexpr auto terms = static_cast<std::size_t>(Quadratic<D>::terms);
  static constexpr auto second = static_cast<std::size_t>(Quadratic<D>::second);
  static constexpr auto numbers = dimension + second;  ///< of a gradient (G, K)
  using Gradient = std::array<double, numbers>;

  template <class F>
  void for_each_local(F const& f) const;
  void fill_seen();
  void fill_images();
  void fill_cell(std::size_t a, double mass);
  void fill_own(std::size_t a);
  void fill_second(std::size_t a, double* k) const;
  void fill_hoop(std::size_t a);
  void fill_pairs();
  void take_lists();
  void fill_lattice(LatticeShape const& shape);
  struct LatticeRow {
    LatticeShape const& shape;
    std::vector<std::array<int, 3>> const& offsets;
    LazyZeroArray<double> const& second_of;  ///< k of the first particle of each kind
  };
  void fill_group(LatticeRow const& row, Index place, Index a);

  double volume(std::size_t a) const;
  double first_derivative(std::size_t a, std::size_t k, std::size_t J) const;
  double reaction(std::size_t a, std::size_t k, std::size_t J) const;
  /// (G_ab, K_ab) of pair k of a, with k of a.
  Gradient gradient(std::size_t a, std::size_t k, double const* second_of) const;
  /// Position of a in the pairs of b. Precondition: they are neighbours.
  std::size_t opposite(std::size_t a, std::size_t b) const;
  std::size_t place_of(std::size_t b) const;
  double parity(std::size_t a) const;
  bool odd(std::size_t a, int m, int n) const;

  SetUp const& from_;
  ScaledBody const& scaled_;
  LocalFits<D>& fits_;
  FacetFluxes<D> const& fluxes_;
  Reference& to_;
  std::size_t slots_, first_, last_;  ///< all slots; own particles
  std::vector<std::size_t> kept_;     ///< of each image, how many before it are neighbours
};

extern template class GradientTables<1>;
extern template class GradientTables<2>;
extern template class GradientTables<3>;

}  // namespace piola::nodal
