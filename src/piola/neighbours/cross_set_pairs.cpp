// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/cross_set_pairs.hpp"
#include "piola/base/contracts.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>

namespace piola {
namespace {

using Point = std::array<double, 3>;

struct Candidate {
  double distance;
  Index source;
};

/// Smoothing lengths grow in these steps, at most to this multiple.
constexpr double growth = 1.1, largest_growth = 4;
constexpr double weighty = 0.8;

/// The sources around one target after the other.
class Search {
 public:
  explicit Search(CrossSetPairRequest const& request)
      : request_(request),
        widest_(request.h.empty() ? 1 : *std::max_element(request.h.begin(), request.h.end())),
        near_(request.sources, request.support * widest_ * (1 + request.skin)) {}

  /// Leaves candidates in `found`, in their order in the set; returns the smoothing length that has enough of them.
  double operator()(Index target) {
    auto const t = static_cast<std::size_t>(target);
    double h = request_.h[t];
    collect(near_, target, h);
    // Where h has to grow, the sources for which it does shall have some weight.
    bool const enough = within(h) >= request_.least[t];
    while (!enough && within(h, weighty) < request_.least[t]) {
      h *= growth;
      // Written so that a length of zero, or one that is not a number, is refused, too.
      if (!(h <= largest_growth * request_.h[t] && h > 0)) refuse(target, within(h, weighty));
      if (!far_) far_.emplace(request_.sources, largest_growth * request_.support * widest_ * (1 + request_.skin));
      collect(*far_, target, h);
    }
    return h;
  }
  /// Number of sources within `share` of the support. Sources on its edge do not count, because the kernel vanishes
  /// there.
  int within(double h, double share = 1 - 1e-6) const {
    double const reach = request_.support * h * share;
    return static_cast<int>(
        std::count_if(found.begin(), found.end(), [&](Candidate const& c) { return c.distance < reach; }));
  }
  std::vector<Candidate> found;

 private:
  void collect(CellGrid const& grid, Index target, double h) {
    found.clear();
    Point const& x = request_.targets[static_cast<std::size_t>(target)];
    double const reach = request_.support * h * (1 + request_.skin);
    grid.visit(x, [&](Index source) {
      Point const& y = request_.sources[static_cast<std::size_t>(source)];
      double const a = x[0] - y[0], b = x[1] - y[1], c = x[2] - y[2], square = a * a + b * b + c * c;
      if (square > reach * reach || (request_.visible && !request_.visible(target, source))) return;
      found.push_back({std::sqrt(square), source});
    });
    std::sort(found.begin(), found.end(), [](auto const& a, auto const& b) { return a.source < b.source; });
  }
  [[noreturn]] void refuse(Index target, int has) const {
    auto const t = static_cast<std::size_t>(target);
    Point const& x = request_.targets[t];
    throw TooFewSources(
        fmt::format("neighbours: the particle at ({:.4g}, {:.4g}, {:.4g}) m has {} of the other set around it ({} are "
                    "needed) - make the body wider or the spacing smaller",
                    x[0], x[1], x[2], has, request_.least[t]),
        target);
  }

  CrossSetPairRequest const& request_;
  double widest_;
  CellGrid near_;
  std::optional<CellGrid> far_;  // for the few targets that need a wider search
};

}  // namespace

void CrossSetPairs::build(CrossSetPairRequest const& request, int lanes, Index filler) {
  PIOLA_EXPECTS(lanes >= 1);
  PIOLA_EXPECTS(request.target_in_slot.size() % static_cast<std::size_t>(lanes) == 0);
  PIOLA_EXPECTS(request.h.size() == request.targets.size());
  PIOLA_EXPECTS(request.least.size() == request.targets.size());
  PIOLA_EXPECTS(request.slot_of_source.size() == request.sources.size());
  PIOLA_EXPECTS(request.support > 0 && request.skin >= 0);
  Search search(request);
  std::size_t const slots = request.target_in_slot.size(), width = static_cast<std::size_t>(lanes);
  begin_.assign(1, 0);
  source_.clear();
  inverse_h_.assign(slots, 1 / std::max(request.h.empty() ? 1.0 : request.h.front(), 1e-300));
  count_.assign(request.targets.size(), 0);
  std::vector<std::vector<Index>> rows(width);
  for (std::size_t first = 0; first < slots; first += width) {
    std::size_t longest = 0;
    for (std::size_t l = 0; l < width; ++l) {
      auto& row = rows[l];
      row.clear();
      Index const target = request.target_in_slot[first + l];
      if (target < 0) continue;
      double const h = search(target);
      count_[static_cast<std::size_t>(target)] = search.within(h);
      inverse_h_[first + l] = 1 / h;
      for (Candidate const& c : search.found) row.push_back(request.slot_of_source[static_cast<std::size_t>(c.source)]);
      longest = std::max(longest, row.size());
    }
    for (std::size_t k = 0; k < longest; ++k)
      for (auto const& row : rows) source_.push_back(k < row.size() ? row[k] : filler);
    if (longest > static_cast<std::size_t>(std::numeric_limits<Index>::max() - begin_.back()))
      throw InputError(
          "neighbours: more pairs than one process can list (allowed: 2^31 per lane) - use larger spacings");
    begin_.push_back(begin_.back() + static_cast<Index>(longest));
  }
}

std::size_t CrossSetPairs::bytes() const {
  return (begin_.size() + source_.size()) * sizeof(Index) + inverse_h_.size() * sizeof(double) +
         count_.size() * sizeof(int);
}

}  // namespace piola
