// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/host_loops.hpp"
#include "piola/kernels/registry.hpp"
#include "piola/neighbours/pair_table_views.hpp"
#include "piola/particles/ordering.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace piola {

/// r.r
inline double squared(std::array<double, 3> const& r) { return r[0] * r[0] + r[1] * r[1] + r[2] * r[2]; }

/// Copies of a body's particles that are neighbours, too: copy k is in the slot after the body's own and those before.
struct CopiedParticles {
  std::vector<std::array<double, 3>> X;
  std::vector<Index> source;  ///< slots
};

/// Supports of one body's kernel sums.
struct PairOptions {
  Kernel const* kernel = nullptr;
  double h_gradient = 0;       ///< smoothing length of the gradient [m]
  double h_laplacian = 0;      ///< of the Laplacian [m]; 0: no Laplacian; otherwise at least h_gradient
  int lanes = 1;               ///< lane count of the back end that will use the tables
  bool stencils = true;        ///< use lattice patterns where the body is a regular lattice
  bool kernel_table = false;   ///< tables hold the kernel of the Laplacian's support (filter)
  CopiedParticles copies{};    ///< bodies without lattice patterns only
  std::optional<Range> own{};  ///< bodies without lattice patterns: particles to make tables for; nothing: all
};

/// Per-particle corrections; SoA. Lattice particles with equal neighbours have equal corrections, which are stored
/// once. See pair_table_views.hpp for the operators.
struct Corrections {
  std::vector<std::int32_t> kind;  ///< regular bodies: per slot, where its corrections are; empty: slot by slot
  Index first = 0;                 ///< then the slot of the first ones
  std::size_t at(Index slot) const {
    return static_cast<std::size_t>(kind.empty() ? slot - first : kind[static_cast<std::size_t>(slot)]);
  }
  std::vector<std::array<double, 6>> C;      ///< inverse of M_a = sum s r (x) r (eq. 21), symmetric: XX YY ZZ XY YZ XZ
  std::vector<std::array<double, 3>> G;      ///< sum s r
  std::vector<std::array<double, 3>> alpha;  ///< eq. (A.2), for r = X_b - X_a
  std::vector<double> beta;
  std::vector<double> diagonal;  ///< sum (l + alpha.r + beta r.r)
  std::vector<int> neighbours;
  int neighbours_of(Index slot) const { return neighbours[at(slot)]; }
};

/// Neighbours of the particles of one body in the reference configuration, and the tables that loops use.
class ReferencePairs {
 public:
  /// Finds neighbours and corrections. Throws InputError if a particle has too few neighbours for them, naming the
  /// particle, its place and what to do.
  ReferencePairs(ParticleSet const& set, Body const& body, SlotOrder const& order, PairOptions const& options);

  bool regular() const { return regular_; }
  StencilTable stencil() const;
  ListTable list() const;
  Corrections const& corrections() const { return corrections_; }
  /// Scaling d of the doubly stochastic filter s_ab = d_a W_ab d_b, per slot: sum_b s_ab V_b = 1 with b = a included,
  /// by d <- sqrt(d / sum_b W_ab V_b d_b). Row sums are then within 1e-8 of 1; the filter's diagonal makes them exact.
  struct Filter {
    std::vector<double> scale;  ///< d
    std::vector<double> sum;    ///< sum_{b != a} s_ab V_b
  };
  /// Communication of make_filter() on a distributed body, where only local particles are scaled.
  struct FilterShare {
    Range own;
    std::function<void(std::vector<double>&)> tell;  ///< updates the ghost values
    std::function<void(double&)> allreduce_max;      ///< allreduce of the maximum
  };
  Filter make_filter(std::vector<double> const& volume, FilterShare const* share = nullptr) const;
  /// Releases all data except the tables and the numbers of neighbours. No other member may be called afterwards.
  void keep_tables();
  std::size_t bytes() const;

 private:
  /// Lattice neighbours at exactly the support radius do not count, whatever the round-off of their positions.
  static constexpr double edge = 1 - 1e-9;
  struct Pair {
    Index b;
    std::int32_t offset;  ///< regular bodies
    std::array<double, 3> r;
    double r2;
    bool inner;
  };
  /// Slots per part, the unit of work of a thread in set-up. Results do not depend on the number of threads.
  static constexpr Index part_size = 4096;
  Index parts() const { return (own_.last - own_.first + part_size - 1) / part_size; }
  /// f(part, first slot, end) for all parts at once; of slots that hold a local particle only.
  template <class F>
  void each_part(F const& f) const;
  void find_offsets(Body const& body);
  /// Classifies slots by the memory offsets of their neighbours: sets corrections_.kind, kinds_ and distance_.
  void find_kinds(ParticleSet const& set, SlotOrder const& order);
  void search(SlotOrder const& order);
  /// Slot of the particle of which `slot` holds a copy; `slot` itself for a particle.
  Index source_of(Index slot) const {
    return slot < slots_ ? slot : options_.copies.source[static_cast<std::size_t>(slot - slots_)];
  }
  /// f(pair) for the neighbours of a particle in a slot of a kind.
  template <class F>
  void visit_kind(Index a, std::size_t kind, F const& f) const;
  template <class F>
  void visit(Index a, F const& f) const;
  double s_of(double r2) const;
  double l_of(double r2) const;
  double kernel_of(double r2) const;
  struct TooFewNeighbours;
  void correct(ParticleSet const& set, Body const& body, SlotOrder const& order);
  /// Finds the corrections stored at `at`, for the particle in slot a. Returns false if its neighbours are too few.
  bool correct(Index a, std::size_t at, TooFewNeighbours& refusal);
  void make_stencils();
  void make_list();

  /// Arrays of a StencilTable.
  struct StencilArrays {
    std::vector<StencilOffset> offsets;
    std::vector<StencilEntry> entries;
    std::vector<StencilPattern> patterns;
    std::vector<std::int32_t> pattern_of;
    std::vector<double> weights, kernel;
  };
  /// Arrays of a ListTable.
  struct ListArrays {
    std::vector<std::int64_t> begin;
    std::vector<std::int32_t> inner;
    std::vector<Index> neighbour;
    std::vector<double> s, l, kernel;
  };

  static constexpr Index absent = std::numeric_limits<Index>::max();

  PairOptions options_;
  int dimension_;
  bool regular_;
  double kernel_volume_;
  double s_scale_ = 0, l_scale_ = 0, kernel_scale_ = 0;
  Index particles_, slots_;
  Range own_;                             // particles that tables are made for
  std::vector<std::array<double, 3>> X_;  // irregular bodies: per slot, and of copies
  std::array<int, 3> lattice_;
  std::vector<std::array<int, 3>> lattice_offset_;
  std::vector<char> offset_inner_;
  std::size_t kinds_ = 0;                  // regular bodies: of slots, that of empty ones is the last
  std::vector<Index> distance_;            // regular bodies, [kind][offset]: to the neighbour in memory, or absent
  std::vector<std::int64_t> found_begin_;  // irregular bodies, from own_.first on
  std::vector<Index> found_;
  Corrections corrections_;
  StencilArrays stencils_;  // regular bodies
  ListArrays lists_;        // irregular bodies
};

template <class F>
void ReferencePairs::each_part(F const& f) const {
  exec_host::parallel_for_chunks(parts(), own_.last - own_.first, [&](Index part) {
    Index const first = own_.first + part * part_size;
    f(part, first, std::min(first + part_size, own_.last));
  });
}

template <class F>
void ReferencePairs::visit_kind(Index a, std::size_t kind, F const& f) const {
  Index const* const distance = distance_.data() + kind * stencils_.offsets.size();
  for (std::size_t k = 0; k < stencils_.offsets.size(); ++k) {
    if (distance[k] == absent) continue;
    auto const& o = stencils_.offsets[k];
    f(Pair{a + distance[k], static_cast<std::int32_t>(k), {o.r[0], o.r[1], o.r[2]}, o.r2, offset_inner_[k] != 0});
  }
}

/// f(pair) for every neighbour of the particle in slot a, in an order that depends on the particles alone: of lattice
/// offsets, or of ids with copies last.
template <class F>
void ReferencePairs::visit(Index a, F const& f) const {
  if (regular_) return visit_kind(a, corrections_.at(a), f);
  auto const slot = static_cast<std::size_t>(a), row = static_cast<std::size_t>(a - own_.first);
  double const inner = options_.kernel->support * options_.h_gradient * edge;
  for (std::int64_t k = found_begin_[row]; k < found_begin_[row + 1]; ++k) {
    Index const b = found_[static_cast<std::size_t>(k)];
    auto const &Xa = X_[slot], &Xb = X_[static_cast<std::size_t>(b)];
    std::array const r{Xb[0] - Xa[0], Xb[1] - Xa[1], Xb[2] - Xa[2]};
    double const r2 = squared(r);
    f(Pair{b, -1, r, r2, r2 < inner * inner});
  }
}

}  // namespace piola
