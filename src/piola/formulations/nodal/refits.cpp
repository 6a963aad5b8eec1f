// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/refits.hpp"
#include <algorithm>

namespace piola::nodal {

/// Returns the points of the cells whose condition has changed, images included.
template <int D>
std::vector<std::size_t> RefitsOf<D>::set_conditions(std::vector<Change> const& changes) {
  std::vector<std::size_t> failed;
  for (Change const& change : changes) failed.push_back(static_cast<std::size_t>(change.slot));
  for (Change const& change : changes) cracks_.set(static_cast<std::size_t>(change.slot), change.condition);
  for (std::size_t k = 0; k < source_of_image_.size(); ++k) {
    auto const found = std::lower_bound(changes.begin(), changes.end(), source_of_image_[k],
                                        [](Change const& change, Index slot) { return change.slot < slot; });
    if (found == changes.end() || found->slot != source_of_image_[k]) continue;
    failed.push_back(scaled_.particles + k);
    cracks_.set(failed.back(), found->condition);
  }
  return failed;
}

template <int D>
Refits::Found RefitsOf<D>::set(std::vector<Change> const& changes) {
  std::vector<std::size_t> const failed = set_conditions(changes);
  // Points that see others than before: those of this rank, and those that it has no fits of, which may.
  std::vector<std::size_t> near, changed;
  for (std::size_t const k : failed) cracks_.each_near(k, longest_reach, [&](std::size_t a) { near.push_back(a); });
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  Found found;
  std::vector<std::size_t> affected = failed;
  for (std::size_t const a : near) {
    if (!fits_.has(a)) {
      affected.push_back(a);
      continue;
    }
    auto const [sees_others, solvable] =
        fits_.refit(a, [view = CrackLines::View(cracks_, a)](std::size_t b) { return view.hides(b); });
    if (!sees_others) continue;
    affected.push_back(a);
    changed.push_back(a);
    if (!solvable && tables_->is_local(a) && cracks_.condition(a) != CellCondition::detached)
      found.unsolvable.push_back(static_cast<Index>(a));
  }
  std::vector<std::size_t> rows = changed;
  for (std::size_t const a : failed)
    if (fits_.has(a)) rows.push_back(a);
  for (std::size_t const a : affected)
    fluxes_.each_beside(a, [&](std::size_t b) {
      if (fits_.has(b)) rows.push_back(b);
    });
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  std::vector<std::size_t> refilled;
  for (std::size_t const a : rows)
    if (fluxes_.refill(a) || std::binary_search(changed.begin(), changed.end(), a)) refilled.push_back(a);
  tables_->refill(refilled);
  for (std::size_t const a : refilled)
    if (tables_->is_local(a)) found.changed.push_back(static_cast<Index>(a));
  return found;
}

template <int D>
std::vector<Index> RefitsOf<D>::near(Index slot, double reach) const {
  std::vector<Index> found;
  cracks_.each_near(static_cast<std::size_t>(slot), reach, [&](std::size_t a) {
    if (a < scaled_.particles) found.push_back(static_cast<Index>(a));
  });
  return found;
}

template class RefitsOf<1>;
template class RefitsOf<2>;
template class RefitsOf<3>;

}  // namespace piola::nodal
