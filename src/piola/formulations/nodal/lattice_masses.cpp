// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/lattice_masses.hpp"
#include "piola/formulations/nodal/masses.hpp"
#include <algorithm>
#include <cmath>

namespace piola::nodal {
namespace {

/// Particles along one axis.
struct Line {
  std::vector<double> at;  ///< coordinates in spacings, in increasing order
  LazyZeroArray<double> mass;

  Line(ScaledBody const& body, std::size_t axis) {
    for (auto const& X : body.X) at.push_back(X[axis]);
    std::sort(at.begin(), at.end());
    constexpr double equal = 0.25;  // spacings
    at.erase(std::unique(at.begin(), at.end(), [](double a, double b) { return b - a < equal; }), at.end());
    Points X;
    for (double const coordinate : at) X.push_back({coordinate, 0, 0});
    LazyZeroArray<ScaledCell> cells(at.size());
    for (std::size_t a = 0; a < body.X.size(); ++a) {
      auto const& cell = body.cells[a];
      cells[index(body.X[a][axis])] = {std::sqrt(12 * cell.spread[axis]), {cell.centroid[axis]}, {cell.spread[axis]}};
    }
    mass = exact_masses<1>(X, cells, {.least = 0, .lattice = std::nullopt, .match = false});
  }
  std::size_t index(double coordinate) const {
    auto const next = std::lower_bound(at.begin(), at.end(), coordinate - 0.5);
    return static_cast<std::size_t>(next - at.begin());
  }
};

}  // namespace

std::optional<LazyZeroArray<double>> lattice_masses(ScaledBody const& body, int dimension, double least) {
  constexpr std::size_t fewest = 4;  // three across need more inertia than the body has, see docs/theory/nodal.md
  LazyZeroArray<double> mass(body.X.size());
  std::fill(mass.begin(), mass.end(), 1.0);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis) {
    Line const line(body, axis);
    if (line.at.size() < fewest) return std::nullopt;
    for (std::size_t a = 0; a < mass.size(); ++a) mass[a] *= line.mass[line.index(body.X[a][axis])];
  }
  for (std::size_t a = 0; a < mass.size(); ++a)
    if (mass[a] < least * body.cells[a].volume) return std::nullopt;
  return mass;
}

}  // namespace piola::nodal
