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

/// The places first[c] <= i_c < last[c] of a lattice.
struct LatticeBox {
  std::array<int, 3> first{}, last{};
};

struct GeneratedParticle {
  std::array<double, 3> X;  ///< [m]
  double volume;            ///< tributary [m^Dim]
};

/// Particles of a body, row by row.
struct GeneratedParticles {
  std::vector<std::int64_t> id;  ///< relative to the first particle of the body
  std::vector<std::array<double, 3>> X;
  std::vector<std::array<int, 3>> lattice_index;
  std::vector<double> volume;
  double kernel_volume = 0;  ///< of each
};

/// Generates lattice particles box by box. Id, position, jitter and volumes of a particle do not depend on the choice
/// of boxes. Ids and counts have 64 bits. Excludes what needs the whole body: cell volumes of jittered bodies, random
/// positions, faces of cracks.
class LatticeGenerator {
 public:
  explicit LatticeGenerator(ShapeSpec const& shape);

  GenerationLattice const& lattice() const { return lattice_; }
  double kernel_volume() const { return cell_; }
  LatticeBox everywhere() const { return {{}, lattice_.count}; }
  std::int64_t size() const { return first_of_plane(lattice_.count[2]); }  ///< particles of the whole body
  std::int64_t count(LatticeBox const& box) const;
  GeneratedParticles in(LatticeBox const& box) const;
  GeneratedParticle at(std::array<int, 3> const& place) const;

  /// Successive particles of a row (j, k): places [first, last), ids from `id` on.
  struct Run {
    std::int64_t id, first, last;
    int j, k;
  };
  std::vector<Run> runs(LatticeBox const& box) const;
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
  std::int64_t first_of_plane(int k) const;

  ShapeSpec shape_;
  GenerationLattice lattice_;
  double cell_ = 1;
  std::int64_t in_plane_ = 0;              ///< of a box
  std::vector<std::int64_t> plane_begin_;  ///< of anything else: particles of the planes before, one more at the end
};

}  // namespace piola
