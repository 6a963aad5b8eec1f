// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/set_up_loop.hpp"
#include "piola/setup/shapes.hpp"
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace piola {

/// The lattice on which a body is born: points first + i * spacing [m].
struct BirthLattice {
  std::array<double, 3> first{};
  std::array<double, 3> spacing{1, 1, 1};
  std::array<int, 3> count{1, 1, 1};
};
/// Of boxes, and of spheres and cylinders that are born on one.
BirthLattice lattice_of(ShapeSpec const& shape);

/// Cells over a length; a number that no lattice can have is kept at the largest int and refused by the caller.
int cells_over(double length, double spacing);
/// Whether direction d is the axis of a cylinder.
bool along_axis(ShapeSpec const& shape, int d);

/// The places first[c] <= i_c < last[c] of a lattice.
struct LatticeBox {
  std::array<int, 3> first{}, last{};
};

struct Birth {
  std::array<double, 3> X;  ///< [m]
  double volume;            ///< tributary [m^Dim]
};

/// Particles of a body, row by row.
struct BornParticles {
  std::vector<std::int64_t> id;  ///< counted from the body's first
  std::vector<std::array<double, 3>> X;
  std::vector<std::array<int, 3>> lattice_index;
  std::vector<double> volume;
  double kernel_volume = 0;  ///< of each
};

/// The particles of a body on a lattice, made box by box: in whatever boxes a body is cut, each particle has the same
/// id, place, shift and volumes as in the whole. Ids and counts have 64 bits. What a whole body is needed for is not
/// done here: volumes of the cells of jittered bodies, random places, both faces of cracks.
class Births {
 public:
  explicit Births(ShapeSpec const& shape);

  BirthLattice const& lattice() const { return lattice_; }
  double kernel_volume() const { return cell_; }
  LatticeBox everywhere() const { return {{}, lattice_.count}; }
  std::int64_t size() const { return first_of_plane(lattice_.count[2]); }  ///< particles of the whole
  std::int64_t count(LatticeBox const& box) const;
  BornParticles in(LatticeBox const& box) const;
  Birth at(std::array<int, 3> const& place) const;

  /// Successive particles of a row (j, k): places [first, last), ids from `id` on.
  struct Run {
    std::int64_t id, first, last;
    int j, k;
  };
  std::vector<Run> runs(LatticeBox const& box) const;
  /// put(number of a run, i) for all places of the runs, by all threads.
  template <class Put>
  static void each_run(std::vector<Run> const& runs, Put const& put) {
    std::int64_t particles = 0;
    for (Run const& run : runs) particles += run.last - run.first;
    auto const shared = static_cast<Index>(std::min(particles, std::int64_t{std::numeric_limits<Index>::max()}));
    exec_host::for_each_part_in_set_up(static_cast<Index>(runs.size()), shared, [&](Index r) {
      auto const run = static_cast<std::size_t>(r);
      for (std::int64_t i = runs[run].first; i < runs[run].last; ++i) put(run, i);
    });
  }

 private:
  std::int64_t first_of_plane(int k) const;

  ShapeSpec shape_;
  BirthLattice lattice_;
  double cell_ = 1;
  std::int64_t in_plane_ = 0;              ///< of a box
  std::vector<std::int64_t> plane_begin_;  ///< of anything else: particles of the planes before, one more at the end
};

}  // namespace piola
