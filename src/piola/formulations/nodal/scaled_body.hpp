// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/lazy_zero_array.hpp"
#include "piola/formulations/nodal/index_set.hpp"
#include "piola/formulations/nodal/local_fits.hpp"
#include "piola/formulations/nodal/set_up.hpp"
#include "piola/neighbours/particle_cells.hpp"
#include <array>
#include <vector>

namespace piola::nodal {

/// A cell in units of the spacings.
struct ScaledCell {
  double volume;
  std::array<double, 3> centroid;
  std::array<double, 6> spread;  ///< XX YY ZZ YZ XZ XY
};

constexpr std::size_t moment_axis[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};

/// Index of the moments of a patch or a cell (XX YY ZZ YZ XZ XY) for second derivative `at` of D dimensions.
template <int D>
constexpr std::size_t moment_of_second(int at) {
  return D == 2 && at == 2 ? 5 : static_cast<std::size_t>(at);
}

/// Cells, surface and facets of a body in slot order and in units of its spacings. With mirror planes it is the whole
/// body: images follow the body's own particles, and data of a particle on a plane are those of the whole body.
struct ScaledBody {
  Points X;
  LazyZeroArray<ScaledCell> cells;
  std::vector<SectionMoments> sections;  ///< of the cells of axisymmetric bodies
  std::vector<SurfacePatch> patches;
  std::vector<CellFacet> facets;
  std::array<double, 3> h{1, 1, 1};
  /// Product of the spacings; of axisymmetric bodies times the circle with the radius of one spacing [m^D or m^3].
  double h_volume = 1;
  std::size_t particles = 0;              ///< without images
  double farthest_move = 0, unmoved = 0;  ///< see BodyCells
};

/// Moments of a patch or facet about a place `by` away from the one that they are about.
std::array<double, 10> moments_about(std::array<double, 10> const& moments, std::array<double, 3> const& by);

/// Frees the memory of the cells of all particles except `of`.
void keep_cells(ScaledBody& body, IndexSet const& of);

/// Measures the cells of the body and continues it behind its mirror planes. lattice: the one that its particles fill
/// in slot order, if only the facets of the first particle of each kind are needed.
ScaledBody scaled_body(SetUp const& from, std::optional<LatticeShape> const& lattice);

/// The items of each particle, as positions in a list of items.
class ItemsOfParticles {
 public:
  /// each(f) must call f(particle, item) for all items of all particles. It is called twice and must do the same.
  template <class Each>
  ItemsOfParticles(std::size_t particles, Each const& each) : begin_(particles + 1, 0) {
    each([&](Index particle, std::size_t) { ++begin_[static_cast<std::size_t>(particle) + 1]; });
    for (std::size_t a = 0; a < particles; ++a) begin_[a + 1] += begin_[a];
    items_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    each([&](Index particle, std::size_t item) { items_[next[static_cast<std::size_t>(particle)]++] = item; });
  }
  std::span<std::size_t const> of(std::size_t particle) const {
    return std::span(items_).subspan(begin_[particle], begin_[particle + 1] - begin_[particle]);
  }

 private:
  std::vector<std::size_t> begin_, items_;
};

}  // namespace piola::nodal
