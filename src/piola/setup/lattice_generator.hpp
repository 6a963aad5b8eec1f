// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/host_loops.hpp"
#include "piola/setup/shapes.hpp"
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace piola {

/// The lattice on which the particles of a body are generated: points first + i * spacing [m].
struct GenerationLattice {
  std::array<double, 3> first{};
  std::array<double, 3> spacing{1, 1, 1};
  std::array<int, 3> count{1, 1, 1};
};
/// Lattice of a box, or of a sphere or cylinder whose particles are generated on a lattice.
GenerationLattice lattice_of(ShapeSpec const& shape);

/// Number of cells over a length, capped at the largest int, which the caller refuses.
int cells_over(double length, double spacing);
/// Whether direction d is the axis of a cylinder.
bool along_axis(ShapeSpec const& shape, int d);

struct GeneratedParticle {
  std::array<double, 3> X;  ///< [m]
  double volume;            ///< tributary [m^Dim]
};

/// Generates the particles of a body on a lattice. Ids and counts have 64 bits. Cell volumes of jittered bodies, random
/// positions and faces of cracks are set later.
class LatticeGenerator {
 public:
  explicit LatticeGenerator(ShapeSpec const& shape);

  GenerationLattice const& lattice() const { return lattice_; }
  double kernel_volume() const { return cell_; }
  std::int64_t size() const;  ///< number of particles
  GeneratedParticle at(std::array<int, 3> const& place) const;

  /// Successive particles of a row (j, k): places [first, last), ids from `id` on.
  struct Run {
    std::int64_t id, first, last;
    int j, k;
  };
  std::vector<Run> runs() const;
  /// Calls put(number of a run, i) for all places of the runs, in parallel.
  template <class Put>
  static void each_run(std::vector<Run> const& runs, Put const& put) {
    std::int64_t particles = 0;
    for (Run const& run : runs) particles += run.last - run.first;
    auto const shared = static_cast<Index>(std::min(particles, std::int64_t{std::numeric_limits<Index>::max()}));
    exec_host::parallel_for_chunks(static_cast<Index>(runs.size()), shared, [&](Index r) {
      auto const run = static_cast<std::size_t>(r);
      for (std::int64_t i = runs[run].first; i < runs[run].last; ++i) put(run, i);
    });
  }

 private:
  ShapeSpec shape_;
  GenerationLattice lattice_;
  double cell_ = 1;
};

}  // namespace piola
