// SPDX-License-Identifier: Apache-2.0
#include "piola/domain/partition.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace piola {
namespace {

/// Runs of blocks whose work is bounded.
class Runs {
 public:
  Runs(std::span<double const> work, std::span<double const> before) : sum_(work.size() + 1, 0), before_(before) {
    bool const idle = std::all_of(before.begin(), before.end(), [](double w) { return w == 0; });
    least_ = idle && work.size() >= before.size() ? 1 : 0;
    bool const none = std::none_of(work.begin(), work.end(), [](double w) { return w > 0; });
    for (std::size_t k = 0; k < work.size(); ++k) sum_[k + 1] = sum_[k] + (none ? 1 : work[k]);
  }

  Index blocks() const { return static_cast<Index>(sum_.size()) - 1; }
  int ranks() const { return static_cast<int>(before_.size()); }
  double total() const { return sum_.back(); }
  /// Blocks that each rank must have.
  Index least() const { return least_; }
  double before(int rank) const { return before_[static_cast<std::size_t>(rank)]; }
  double up_to(Index block) const { return sum_[static_cast<std::size_t>(block)]; }
  bool fits(int rank, Index first, Index last, double bound) const {
    return last <= first || before(rank) + (up_to(last) - up_to(first)) <= bound;
  }

  /// The last end of a run from `first`, not beyond `end`.
  Index longest_from(int rank, Index first, Index end, double bound) const {
    Index last = first;
    for (Index step = end - first; step > 0;) {
      if (last + step <= end && fits(rank, first, last + step, bound))
        last += step;
      else
        step /= 2;
    }
    return last;
  }
  /// First block of each rank from which this rank and the later ones can take all remaining blocks; nothing if rank 0
  /// cannot.
  std::vector<Index> earliest(double bound) const {
    std::vector<Index> first(before_.size() + 1, blocks());
    for (int r = ranks() - 1; r >= 0; --r) {
      Index const last = first[static_cast<std::size_t>(r) + 1];
      Index start = last;
      for (Index step = last; step > 0;) {
        if (start - step >= 0 && fits(r, start - step, last, bound))
          start -= step;
        else
          step /= 2;
      }
      if (last - start < least_) return {};
      // Leaves enough blocks for the lower ranks.
      first[static_cast<std::size_t>(r)] = std::max(start, least_ * r);
    }
    return first.front() == 0 ? first : std::vector<Index>{};
  }

 private:
  std::vector<double> sum_;
  std::span<double const> before_;
  Index least_ = 0;
};

/// The least bound on the work of a rank that runs of blocks can keep.
double least_bound(Runs const& runs) {
  double low = 0, high = runs.total();
  for (int r = 0; r < runs.ranks(); ++r) high = std::max(high, runs.total() + runs.before(r));
  for (int k = 0; k < 60; ++k) {
    double const middle = 0.5 * (low + high);
    (runs.earliest(middle).empty() ? low : high) = middle;
  }
  return high;
}

/// The block at which the sum comes nearest to what is wanted.
Index nearest(Runs const& runs, Index low, Index high, double wanted) {
  Index best = low;
  for (Index k = low; k <= high; ++k)
    if (std::abs(runs.up_to(k) - wanted) < std::abs(runs.up_to(best) - wanted)) best = k;
  return best;
}

}  // namespace

Range even_range_of_rank(Index slots, int rank, int ranks) {
  PIOLA_EXPECTS(slots >= 0);
  PIOLA_EXPECTS(rank >= 0 && rank < ranks);
  std::int64_t const blocks = (std::int64_t{slots} + exec::block_size - 1) / exec::block_size;
  auto const start = [&](int r) {
    return static_cast<Index>(std::min<std::int64_t>(slots, blocks * r / ranks * exec::block_size));
  };
  return {start(rank), start(rank + 1)};
}

Partition::Partition(Range whole, int ranks) {
  PIOLA_EXPECTS(whole.first <= whole.last && ranks >= 1);
  for (int r = 0; r < ranks; ++r)
    starts_.push_back(whole.first + even_range_of_rank(whole.last - whole.first, r, ranks).first);
  starts_.push_back(whole.last);
}

Partition::Partition(Range whole, std::vector<Index> const& first_block) {
  PIOLA_EXPECTS(whole.first <= whole.last);
  PIOLA_EXPECTS(!first_block.empty() && first_block.front() == 0);
  PIOLA_EXPECTS(std::is_sorted(first_block.begin(), first_block.end()));
  std::int64_t const slots = whole.last - whole.first;
  for (Index const block : first_block)
    starts_.push_back(whole.first + static_cast<Index>(std::min(slots, std::int64_t{block} * exec::block_size)));
  starts_.push_back(whole.last);
}

Partition Partition::from_zero() const {
  Partition moved = *this;
  for (Index& start : moved.starts_) start -= starts_.front();
  PIOLA_ENSURES(moved.whole().first == 0);
  return moved;
}

std::vector<Index> partition_by_work(std::span<double const> work, std::span<double const> before) {
  PIOLA_EXPECTS(!before.empty());
  PIOLA_EXPECTS(std::all_of(work.begin(), work.end(), [](double w) { return w >= 0 && std::isfinite(w); }));
  Runs const runs(work, before);
  double const bound = least_bound(runs);
  std::vector<Index> const earliest = runs.earliest(bound);
  double const mean = (runs.total() + std::accumulate(before.begin(), before.end(), 0.0)) / runs.ranks();
  std::vector<Index> first{0};
  double wanted = 0;
  for (int r = 1; r < runs.ranks(); ++r) {
    wanted = std::min(runs.total(), wanted + std::max(0.0, mean - runs.before(r - 1)));
    Index const most = runs.blocks() - runs.least() * (runs.ranks() - r);
    Index const low = std::max(earliest[static_cast<std::size_t>(r)], first.back() + runs.least());
    first.push_back(nearest(runs, low, runs.longest_from(r - 1, first.back(), most, bound), wanted));
  }
  PIOLA_ENSURES(first.size() == before.size() && first.front() == 0);
  return first;
}

}  // namespace piola
