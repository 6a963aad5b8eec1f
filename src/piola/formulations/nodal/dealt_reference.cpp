// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/dealt_reference.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <unordered_map>
#include <utility>

namespace piola::nodal {
namespace {

/// Permutation from one order of particles to another.
class SlotPermutation {
 public:
  SlotPermutation(SlotOrder const& from, SlotOrder const& to) : old_(to.id.size()), new_(to.id.size()) {
    PIOLA_EXPECTS(from.slots() == to.slots() && from.particles == to.particles);
    std::unordered_map<std::int64_t, std::size_t> at;
    for (std::size_t i = 0; i < static_cast<std::size_t>(from.particles); ++i) at[from.id[i]] = i;
    for (std::size_t i = 0; i < old_.size(); ++i) {
      old_[i] = i < static_cast<std::size_t>(to.particles) ? at.at(to.id[i]) : i;
      new_[old_[i]] = i;
    }
  }

  std::size_t slots() const { return old_.size(); }
  std::size_t old_slot(std::size_t slot) const { return old_[slot]; }
  /// New slot of a slot or an image; images follow the slots and stay.
  Index new_slot(Index old) const {
    auto const k = static_cast<std::size_t>(old);
    return k < new_.size() ? static_cast<Index>(new_[k]) : old;
  }
  /// Permutes values with a fixed number per slot; values after the slots stay.
  template <class T>
  void deal(LazyZeroArray<T>& values, std::size_t size = 1) const {
    if (values.empty()) return;
    LazyZeroArray<T> const before = values;
    for (std::size_t i = 0; i < std::min(slots(), values.size() / size); ++i)
      std::copy_n(before.begin() + static_cast<std::ptrdiff_t>(old_[i] * size), size,
                  values.begin() + static_cast<std::ptrdiff_t>(i * size));
  }

 private:
  std::vector<std::size_t> old_, new_;
};

void deal_lists(Reference& r, SlotPermutation const& dealing) {
  std::vector<Index> neighbour;
  std::vector<double> weight;
  LazyZeroArray<std::int64_t> begin(1);
  for (std::size_t i = 0; i < dealing.slots(); ++i) {
    std::size_t const a = dealing.old_slot(i);
    for (auto k = static_cast<std::size_t>(r.begin[a]); k < static_cast<std::size_t>(r.begin[a + 1]); ++k) {
      neighbour.push_back(dealing.new_slot(r.neighbour[k]));
      weight.push_back(r.weight[k]);
    }
    begin.push_back(std::ssize(neighbour));
  }
  r.neighbour = std::move(neighbour);
  r.weight = std::move(weight);
  r.begin = std::move(begin);
}

}  // namespace

Reference dealt_reference(Reference r, SlotOrder const& from, SlotOrder const& to) {
  PIOLA_EXPECTS(!r.lattice && r.group_of_k.empty());
  SlotPermutation const dealing(from, to);
  for (auto* values : {&r.V, &r.mass, &r.L, &r.g, &r.k, &r.own, &r.centroid, &r.share})
    dealing.deal(*values, values->size() / dealing.slots());
  std::size_t const places = dealing.slots() + r.images.size();  // images have values of their own there
  for (auto* values : {&r.mu, &r.X}) dealing.deal(*values, values->size() / places);
  for (auto& parts : r.parts) dealing.deal(parts);
  for (ConstrainedFacet& place : r.held)
    for (auto& weight : place.weights) weight.slot = dealing.new_slot(weight.slot);
  for (Index& source : r.source_of_image) source = dealing.new_slot(source);
  deal_lists(r, dealing);
  return r;
}

}  // namespace piola::nodal
