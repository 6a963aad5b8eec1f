// SPDX-License-Identifier: Apache-2.0
#include "piola/parallel/row_plan.hpp"
#include "piola/base/contracts.hpp"
#include "piola/parallel/ranks.hpp"
#include <algorithm>
#include <cstdint>
#include <cstring>

namespace piola {
namespace {

/// to[k] has from[rows[k]].
void pack(std::span<std::byte const> from, std::span<Index const> rows, std::span<std::byte> to, std::size_t row) {
  for (std::size_t k = 0; k < rows.size(); ++k)
    std::memcpy(&to[k * row], &from[static_cast<std::size_t>(rows[k]) * row], row);
}

/// The way back.
void unpack(std::span<std::byte const> from, std::span<Index const> rows, std::span<std::byte> to, std::size_t row) {
  for (std::size_t k = 0; k < rows.size(); ++k)
    std::memcpy(&to[static_cast<std::size_t>(rows[k]) * row], &from[k * row], row);
}

}  // namespace

RowPlan::RowPlan(RowsOfRanks const& rows, Index block) : count_(rows.count), block_(block) {
  PIOLA_EXPECTS(block > 0);
  auto const n = static_cast<std::size_t>(ranks::count());
  Index const own_rows = rows.places ? static_cast<Index>(rows.places->size()) : count_;
  std::int64_t const blocks = (std::int64_t{count_} + block_ - 1) / block_;
  std::vector<std::vector<Index>> leaving(n), of_rank(n);
  for (Index k = 0; k < own_rows; ++k) {
    Index const place = rows.places ? (*rows.places)[static_cast<std::size_t>(k)] : k;
    PIOLA_EXPECTS(place >= 0 && place < count_);
    auto const rank =
        static_cast<std::size_t>(std::int64_t{place / block_} * ranks::count() / blocks);  // whose stretch it is in
    of_rank[rank].push_back(k);
    leaving[rank].push_back(place - of(static_cast<int>(rank)).first);
  }
  for (auto const& part : of_rank) {
    leaving_count_.push_back(static_cast<Index>(part.size()));
    packed_.insert(packed_.end(), part.begin(), part.end());
  }
  for (auto const& part : ranks::deal(leaving)) {
    arriving_count_.push_back(static_cast<Index>(part.size()));
    arriving_.insert(arriving_.end(), part.begin(), part.end());
  }
  PIOLA_ENSURES(static_cast<Index>(arriving_.size()) == own().last - own().first);
}

Range RowPlan::of(int rank) const {
  std::int64_t const blocks = (std::int64_t{count_} + block_ - 1) / block_, n = ranks::count();
  auto const start = [&](std::int64_t r) {
    return static_cast<Index>(std::min<std::int64_t>(count_, (blocks * r + n - 1) / n * block_));
  };
  return {start(rank), start(rank + 1)};
}
Range RowPlan::own() const { return of(ranks::own()); }

void RowPlan::collect(std::span<std::byte const> rows, std::span<std::byte> whole, std::size_t row) const {
  PIOLA_EXPECTS(rows.size() == packed_.size() * row && whole.size() == arriving_.size() * row);
  std::vector<std::byte> out(rows.size());
  pack(rows, packed_, out, row);
  if (!ranks::several()) return unpack(out, arriving_, whole, row);
  std::vector<std::byte> in(whole.size());
  ranks::deal_items(out.data(), leaving_count_, in.data(), arriving_count_, row);
  unpack(in, arriving_, whole, row);
}

void RowPlan::hand_out(std::span<std::byte const> whole, std::span<std::byte> rows, std::size_t row) const {
  PIOLA_EXPECTS(rows.size() == packed_.size() * row && whole.size() == arriving_.size() * row);
  std::vector<std::byte> out(whole.size());
  pack(whole, arriving_, out, row);
  if (!ranks::several()) return unpack(out, packed_, rows, row);
  std::vector<std::byte> in(rows.size());
  ranks::deal_items(out.data(), arriving_count_, in.data(), leaving_count_, row);
  unpack(in, packed_, rows, row);
}

}  // namespace piola
