// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/reference_pairs.hpp"
#include <algorithm>
#include <unordered_set>

namespace piola {
namespace {

/// Rows of numbers, each different one kept once, in the order of their first appearance.
class DistinctRows {
 public:
  explicit DistinctRows(std::size_t width) : width_(width), place_(16, Equal{this}, Equal{this}) {}
  DistinctRows(DistinctRows const&) = delete;
  DistinctRows& operator=(DistinctRows const&) = delete;
  /// The number of a row.
  std::int32_t number(Index const* row) {
    // Most rows are like the one before.
    if (last_ >= 0 && std::equal(row, row + width_, at(last_))) return last_;
    rows_.insert(rows_.end(), row, row + width_);
    auto const [found, is_new] = place_.insert(count_);
    last_ = *found;
    if (is_new)
      ++count_;
    else
      rows_.resize(rows_.size() - width_);
    return last_;
  }
  std::int32_t count() const { return count_; }
  Index const* at(std::int32_t number) const { return rows_.data() + static_cast<std::size_t>(number) * width_; }
  std::vector<Index>& rows() { return rows_; }

 private:
  struct Equal {
    DistinctRows const* of;
    std::size_t operator()(std::int32_t number) const {
      std::uint64_t hash = 0;
      for (std::size_t k = 0; k < of->width_; ++k)
        hash = (hash ^ static_cast<std::uint32_t>(of->at(number)[k])) * 0x9E3779B97F4A7C15U + (hash >> 29);
      return static_cast<std::size_t>(hash ^ (hash >> 32));
    }
    bool operator()(std::int32_t a, std::int32_t b) const {
      return std::equal(of->at(a), of->at(a) + of->width_, of->at(b));
    }
  };
  std::size_t width_;
  std::vector<Index> rows_;
  std::unordered_set<std::int32_t, Equal, Equal> place_;
  std::int32_t count_ = 0, last_ = -1;
};

/// Which slot is at each point of a lattice, and how far from a slot its neighbours at given offsets are.
class SlotsOfLattice {
 public:
  SlotsOfLattice(std::array<int, 3> const& lattice, std::vector<std::array<int, 3>> const& offsets)
      : lattice_(lattice), offsets_(offsets), stride_{1, lattice[0], std::ptrdiff_t{lattice[0]} * lattice[1]} {
    slot_.assign(static_cast<std::size_t>(stride_[2] * lattice[2]), SlotOrder::no_particle);
    for (auto const& o : offsets) {
      step_.push_back(number(o));
      for (std::size_t c = 0; c < 3; ++c) reach_[c] = std::max(reach_[c], o[c]);
    }
  }
  void put(std::array<int, 3> const& at, Index slot) { slot_[static_cast<std::size_t>(number(at))] = slot; }
  /// row[k]: from slot a, at `from`, to its neighbour at offset k, or `absent`.
  void read(std::array<int, 3> const& from, Index a, Index absent, std::vector<Index>& row) const {
    auto const here = number(from);
    bool deep = true;  // all neighbours are within the lattice
    for (std::size_t c = 0; c < 3; ++c) deep = deep && from[c] >= reach_[c] && from[c] + reach_[c] < lattice_[c];
    for (std::size_t k = 0; k < offsets_.size(); ++k) {
      bool inside = true;
      for (std::size_t c = 0; c < 3 && !deep; ++c) {
        int const to = from[c] + offsets_[k][c];
        inside = inside && to >= 0 && to < lattice_[c];
      }
      Index const b = inside ? slot_[static_cast<std::size_t>(here + step_[k])] : SlotOrder::no_particle;
      row[k] = b == SlotOrder::no_particle ? absent : b - a;
    }
  }

 private:
  std::ptrdiff_t number(std::array<int, 3> const& at) const { return at[0] + at[1] * stride_[1] + at[2] * stride_[2]; }
  std::array<int, 3> lattice_;
  std::vector<std::array<int, 3>> const& offsets_;
  std::array<std::ptrdiff_t, 3> stride_;
  std::array<int, 3> reach_{};
  std::vector<std::ptrdiff_t> step_;
  std::vector<Index> slot_;
};

/// The kinds that a part of the slots has found, each a row of distances.
struct KindsOfPart {
  std::vector<Index> rows;
  std::int32_t count = 0;
};

/// Adds the kinds of all parts to `all`, whose rows have `width` numbers; the new number of each kind of each part.
std::vector<std::vector<std::int32_t>> merged(std::vector<KindsOfPart> const& parts, std::size_t width,
                                              DistinctRows& all) {
  std::vector<std::vector<std::int32_t>> of_part;
  for (KindsOfPart const& part : parts) {
    auto& numbers = of_part.emplace_back();
    for (std::size_t k = 0; k < static_cast<std::size_t>(part.count); ++k)
      numbers.push_back(all.number(part.rows.data() + k * width));
  }
  return of_part;
}

}  // namespace

void ReferencePairs::find_offsets(Body const& body) {
  double const radius = options_.kernel->support * std::max(options_.h_gradient, options_.h_laplacian) * edge;
  double const inner = options_.kernel->support * options_.h_gradient * edge;
  std::array<int, 3> reach{};
  for (std::size_t c = 0; c < 3; ++c) {
    int const wanted = lattice_[c] > 1 ? static_cast<int>(radius / body.spacing[c]) : 0;
    reach[c] = std::min(wanted, lattice_[c] - 1);
  }
  // Along the rows that are next to each other in memory first.
  auto const axis = row_axes(body);
  std::array<int, 3> offset{};
  auto& i = offset[axis[0]];
  auto& j = offset[axis[1]];
  auto& k = offset[axis[2]];
  for (k = -reach[axis[2]]; k <= reach[axis[2]]; ++k)
    for (j = -reach[axis[1]]; j <= reach[axis[1]]; ++j)
      for (i = -reach[axis[0]]; i <= reach[axis[0]]; ++i) {
        std::array const r{offset[0] * body.spacing[0], offset[1] * body.spacing[1], offset[2] * body.spacing[2]};
        double const r2 = squared(r);
        if ((i == 0 && j == 0 && k == 0) || r2 > radius * radius) continue;
        bool const is_inner = r2 <= inner * inner;
        double const s = is_inner ? s_of(r2) : 0;
        lattice_offset_.push_back(offset);
        stencils_.offsets.push_back({s, {s * r[0], s * r[1], s * r[2]}, {r[0], r[1], r[2]}, r2, l_of(r2)});
        offset_inner_.push_back(is_inner ? 1 : 0);
        if (options_.kernel_table) stencils_.kernel.push_back(kernel_of(r2));
      }
}

void ReferencePairs::find_kinds(ParticleSet const& set, SlotOrder const& order) {
  auto const& lattice_index = set.lattice_index.seen();
  auto const at = [&](Index slot) -> std::array<int, 3> const& {
    return lattice_index[static_cast<std::size_t>(order.id[static_cast<std::size_t>(slot)])];
  };
  SlotsOfLattice slots(lattice_, lattice_offset_);
  for (Index a = 0; a < particles_; ++a) slots.put(at(a), a);
  std::size_t const width = stencils_.offsets.size();
  auto& kind = corrections_.kind;
  kind.assign(static_cast<std::size_t>(slots_), 0);
  // Each part numbers its kinds by itself first.
  std::vector<KindsOfPart> found(static_cast<std::size_t>(parts()));
  each_part([&](Index part, Index first, Index end) {
    DistinctRows mine(width);
    std::vector<Index> row(width);
    for (Index a = first; a < end; ++a) {
      slots.read(at(a), a, absent, row);
      kind[static_cast<std::size_t>(a)] = mine.number(row.data());
    }
    found[static_cast<std::size_t>(part)] = {std::move(mine.rows()), mine.count()};
  });
  DistinctRows all(width);
  auto const of_part = merged(found, width, all);
  each_part([&](Index part, Index first, Index end) {
    for (Index a = first; a < end; ++a) {
      auto& of_slot = kind[static_cast<std::size_t>(a)];
      of_slot = of_part[static_cast<std::size_t>(part)][static_cast<std::size_t>(of_slot)];
    }
  });
  // Empty slots have no neighbours.
  for (Index a = particles_; a < slots_; ++a) kind[static_cast<std::size_t>(a)] = all.count();
  kinds_ = static_cast<std::size_t>(all.count()) + 1;
  distance_.swap(all.rows());
  distance_.resize(kinds_ * width, absent);
}

}  // namespace piola
