// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/integration_constraint.hpp"
#include "piola/formulations/nodal/set_up.hpp"
#include <array>
#include <vector>

namespace piola::nodal {

/// Cells and surface of a body in slot order and in units of its spacings. With mirror planes it is the whole body:
/// images follow the body's own particles, and data of a particle on a plane are those of the whole body.
struct ScaledBody {
  Points X;
  LazyZeroArray<ScaledCell> cells;
  std::vector<SurfacePatch> patches;
  std::array<double, 3> h{1, 1, 1};
  double h_volume = 1;        ///< product of the spacings
  std::size_t particles = 0;  ///< without images
};

constexpr std::size_t moment_axis[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};

/// Frees the memory of the cells of all particles except `of`.
void keep_cells(ScaledBody& body, IndexSet const& of);

/// Measures the cells of the body and continues it behind its mirror planes.
ScaledBody scaled_body(SetUp const& from);

}  // namespace piola::nodal
