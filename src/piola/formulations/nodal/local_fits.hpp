// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/slot_collectives.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/exec/lazy_zero_array.hpp"
#include "piola/formulations/nodal/index_set.hpp"
#include "piola/formulations/nodal/lattice_layout.hpp"
#include "piola/formulations/nodal/quadratic.hpp"
#include "piola/math/lanes.hpp"
#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

/// Weighted least-squares quadratics through the neighbours of each particle. All lengths in spacings.
/// Theory: docs/theory/nodal.md, section 3.
namespace piola::nodal {

using Points = std::vector<std::array<double, 3>>;

/// Neighbours of every particle, or of some, both directions of each pair, in increasing order.
struct Pairs {
  std::vector<std::int64_t> begin;  ///< per particle, one more at the end; particles not chosen have an empty range
  std::vector<Index> neighbour;
  std::vector<double> weight;  ///< equal in both directions

  std::size_t first(std::size_t a) const { return static_cast<std::size_t>(begin[a]); }
  std::size_t end(std::size_t a) const { return static_cast<std::size_t>(begin[a + 1]); }
  std::size_t at(std::size_t k) const { return static_cast<std::size_t>(neighbour[k]); }
  /// Largest distance of neighbours in the order of particles.
  Index farthest() const;
};

/// Neighbours at exactly the support radius do not count, whatever the round-off of positions in a lattice.
inline constexpr double nearly = 1 - 1e-9;

double square_of_distance(std::array<double, 3> const& a, std::array<double, 3> const& b);
inline double square_of_distance(Points const& X, std::size_t a, std::size_t b) {
  return square_of_distance(X[a], X[b]);
}

/// Largest support radius: beyond it a body has too few particles across.
inline constexpr double longest_reach = 5;

/// Distance from a face beyond which particles of a lattice have all neighbours.
inline constexpr int beyond_reach = static_cast<int>(usual_reach) + 1;

/// Per particle of a lattice: the first one with equal distances from all faces, where distances of `beyond` spacings
/// or more count as equal.
std::vector<Index> representatives_in_lattice(LatticeShape const& shape, int beyond);

/// Steps along the directions of a lattice to the neighbours nearer than `reach` (exclusive), in the order of slots.
std::vector<std::array<int, 3>> offsets_in_reach(int dimension, double reach);

/// Pairs of the particles `rows` of a lattice nearer than `reach` (exclusive), without weights and without a search.
Pairs lattice_pairs(LatticeShape const& shape, double reach, IndexSet const& rows);

/// For a distributed lattice: the local particles, their neighbours, and the first particle of each kind.
IndexSet lattice_rows(LatticeShape const& shape, double reach, Range own, std::vector<std::size_t> const& first);

/// Deterministic parallel scatter. Calls f(a, mine) for the particles of `rows` in ascending order; f may add to
/// entries b with |b - a| <= reach, and only where mine(b) is true. Each thread owns a part of `range` and processes
/// every a that can reach it, so each entry gets its summands in the same order for any number of threads and ranks.
template <class F>
void scatter_in_order(Range range, IndexSet const& rows, Index reach, F const& f) {
  Index const n = range.last - range.first, parts = exec_host::team_size(n);
  exec_host::parallel_for_chunks(parts, n, [&](Index part) {
    auto const border = [&](Index k) {
      return range.first + static_cast<Index>(static_cast<std::int64_t>(n) * k / parts);
    };
    std::int64_t const first = border(part), end = border(part + 1);
    auto const mine = [&](std::size_t b) {
      return b >= static_cast<std::size_t>(first) && b < static_cast<std::size_t>(end);
    };
    for (Index k = 0; k < rows.size(); ++k)
      if (auto const a = static_cast<std::int64_t>(rows[k]); a >= first - reach && a < end + reach)
        f(static_cast<std::size_t>(a), mine);
  });
}

/// Pairs of the particles `rows` nearer than the larger of their two support radii.
Pairs find_pairs(Points const& X, std::span<double const> reach, IndexSet const& rows);

/// Removes pairs of these rows for which `drop` is true. Returns whether there was one.
bool drop_pairs(Pairs& pairs, IndexSet const& rows, std::function<bool(std::size_t, std::size_t)> const& drop);

/// The particles of a range, their neighbours, and the particles marked already.
IndexSet with_neighbours(Pairs const& pairs, Range range, std::vector<bool> marked);
/// Ghosts: neighbours of local particles that are not local.
std::vector<Index> ghost_neighbours(Pairs const& pairs, Range own);

/// The fits of a cloud:  e_ab = s_ab A_a^-1 p(r_ab),  A_a = sum_b s_ab p p^T,  p without the constant,
/// s = (1 - (r/R)^2)^2 / r^3 with R = 2.4, or more where neighbours do not determine a quadratic well.
template <int D>
class LocalFits {
 public:
  static constexpr int terms = Quadratic<D>::terms;
  using Monomials = std::array<double, static_cast<std::size_t>(terms)>;

  /// lattice: the lattice that the points fill, if any; each distinct neighbourhood is then fitted once. shared: the
  /// points are distributed, and each rank fits its local points and their neighbours; then collective.
  /// blocked: whether two points do not see each other, see LineOfSight: then they are no neighbours in a cloud.
  using Blocked = std::function<bool(std::size_t, std::size_t)>;
  explicit LocalFits(Points const& X, std::optional<LatticeShape> const& lattice = std::nullopt,
                     std::optional<DistributedSlots> const& shared = std::nullopt, Blocked blocked = {});

  /// Local points of this rank, or all.
  Range own() const { return shared_ ? shared_->own() : Range{0, static_cast<Index>(X_.size())}; }
  std::optional<DistributedSlots> const& shared() const { return shared_; }
  /// Points with fits and pairs on this rank: local points and their neighbours.
  IndexSet const& rows() const { return rows_; }
  bool has(std::size_t a) const { return pairs_.end(a) > pairs_.first(a); }

  /// Whether all support radii are `usual_reach`, and the neighbours on a lattice are those of its loops.
  bool usual() const { return usual_; }
  /// A particle whose neighbours determine no quadratic at any support radius; -1: none.
  Index unsolvable() const { return hopeless_; }
  Pairs const& pairs() const { return pairs_; }
  /// Moves the pairs out. No other member may be called afterwards.
  Pairs take_pairs() { return std::move(pairs_); }
  Points const& X() const { return X_; }
  /// X_b - X_a; on a lattice whole numbers.
  std::array<double, 3> difference(std::size_t a, std::size_t b) const;
  /// Whether b is a itself, or has a weight in the fit of a; without a fit of a here, whether it is within the larger
  /// of their support radii and not blocked.
  bool sees(std::size_t a, std::size_t b) const;
  /// 1 - (r/R)^2 of two particles.
  double nearness(std::size_t a, std::size_t b) const;
  /// Enlarges the support radii of the points whose entry in `good` is 0, and repeats the fits. Returns whether there
  /// was none. Collective if the points are distributed, with entries that count for local points.
  bool refine(std::vector<char> const& good);
  struct Refit {
    bool sees_others;  ///< others than before
    bool solvable;     ///< they determine a gradient
  };
  /// Fit of a point of a cloud to the neighbours that cracks do not hide from it now: quadratic, or linear if that is
  /// all that they determine. Collective work is not needed.
  Refit refit(std::size_t a, std::function<bool(std::size_t)> const& is_hidden);
  /// Local points whose support radius is above the usual one.
  Index enlarged() const;
  /// (A^-1)_kl of a particle.
  double inverse(std::size_t a, int k, int l) const {
    return inverse_[(kind_.empty() ? a : static_cast<std::size_t>(kind_[a])) * static_cast<std::size_t>(terms * terms) +
                    static_cast<std::size_t>(k * terms + l)];
  }
  /// The first particle of a lattice with an identical neighbourhood in the same order; a itself in clouds.
  std::size_t representative(std::size_t a) const {
    return representative_.empty() ? a : static_cast<std::size_t>(representative_[a]);
  }
  /// p of a pair, without the constant.
  Monomials monomials_of(std::size_t a, std::size_t b) const;
  /// e_ab: the weight of the value at b in the first and second derivatives at a.
  Monomials derivatives(std::size_t a, std::size_t pair) const;

 private:
  void fit_lattice(LatticeShape const& shape);
  void fit_cloud();
  void find_cloud();
  /// Enlarges the support radii of failed fits. Returns whether all fits are good.
  bool lengthen(std::vector<char> const& fits);
  template <int N>
  void add_normal_matrix(std::size_t a, double (&A)[N * N]) const;
  /// Computes the inverse of particle a and stores it at `at`.
  bool fit(std::size_t a, std::size_t at);
  /// Largest entry on the diagonal of the inverse that is stored at `at`.
  double worst_of(std::size_t at) const;
  /// As fit() for a linear field: second derivatives are zero.
  bool fit_linear(std::size_t a);

  Points const& X_;
  std::optional<DistributedSlots> shared_;
  Blocked blocked_;
  IndexSet rows_;
  std::vector<double> reach_;
  Pairs pairs_;
  LazyZeroArray<double> inverse_;
  std::optional<LatticeShape> lattice_;  ///< of points whose neighbours are those of its loops
  std::vector<Index> representative_;
  std::vector<std::int32_t> kind_;  ///< of a lattice: index of the inverse of a particle
  Index hopeless_ = -1;
  bool usual_ = true;
  bool dropped_ = false;  ///< some pair was blocked
};

extern template class LocalFits<1>;
extern template class LocalFits<2>;
extern template class LocalFits<3>;

}  // namespace piola::nodal
