// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/memory.hpp"
#include "piola/formulations/adaptle/state.hpp"
#include "piola/particles/particle_set.hpp"
#include <span>
#include <vector>

namespace piola::adaptle {

/// Sets s = -W'(r)/r and W(r) of a kernel of smoothing length h [m], at the squared distance `square` [m2].
using KernelFunction = void (*)(double h, double square, double& s, double& W);
/// The function of one of LaneKernels.
KernelFunction kernel_function(piola::Kernel const& kernel, int dimension);

/// Reference neighbours of a body on a regular lattice, as patterns of groups of lanes, and the memory of the neighbour
/// data.
class LatticeStencils {
 public:
  /// own: local slots.
  struct BodyInput {
    Body const& geometry;
    Range own;
    double h;
    KernelFunction kernel;
  };
  /// begin, neighbour: lists of the local particles. Bodies that are no lattice, or whose groups of lanes have too few
  /// common neighbours, keep their lists: is_lattice() is false. components: of a record. Collective.
  LatticeStencils(ParticleSet const& set, BodyInput const& body, std::span<Offset const> begin,
                  std::span<Index const> neighbour, int lanes, bool rounded, int components);

  bool is_lattice() const { return has_rows_; }
  MaterialRows view();
  std::size_t bytes() const;

 private:
  void find_offsets(BodyInput const& body, int dimension, bool rounded);
  std::int32_t offset_between(std::array<int, 3> const& from, std::array<int, 3> const& to) const;
  /// Criterion for lists or patterns: neighbours, and lanes computed for them, over all ranks.
  struct Fill {
    std::int64_t present = 0, all = 0;
    bool lattice = true;  ///< all neighbours are at common offsets
  };
  Fill find_patterns(ParticleSet const& set, BodyInput const& body, std::span<Offset const> begin,
                     std::span<Index const> neighbour, int lanes);
  void add_pattern(std::span<std::int32_t const> entries, int lanes);
  void allocate(Body const& body, int components);

  std::array<int, 3> reach_{};
  std::vector<std::int32_t> number_;  ///< index of each offset in the box of +- reach_; negative: no neighbour
  std::vector<StencilOffset> offsets_;
  std::vector<StencilEntry> entries_;
  std::vector<StencilPattern> patterns_;
  std::vector<std::int32_t> pattern_of_;
  std::vector<double> weights_, kernel_;
  bool has_rows_ = false;
  Index first_ = 0, farthest_ = 0, margin_ = 0;
  std::ptrdiff_t stride_ = 0;
  Memory record_;
};

/// The squared distance between two lattice particles [m2]: bit-identical for all pairs of one offset.
double lattice_square(Body const& body, std::array<int, 3> const& from, std::array<int, 3> const& to);

}  // namespace piola::adaptle
