// SPDX-License-Identifier: Apache-2.0
#include "piola/parallel/row_plan.hpp"
#include "piola/base/contracts.hpp"
#include "piola/parallel/ranks.hpp"
#include <algorithm>
#include <cstdint>
#include <cstring>

namespace piola {
namespace {

/// Rows to[to_rows[k]] become from[from_rows[k]]; no numbers of rows: they are k.
void copy_rows(std::span<std::byte const> from, std::span<Index const> from_rows, std::span<std::byte> to,
               std::span<Index const> to_rows, std::size_t row) {
  auto const at = [&](std::span<Index const> rows, std::size_t k) {
    return (rows.empty() ? k : static_cast<std::size_t>(rows[k])) * row;
  };
  std::size_t const count = std::max(from_rows.size(), to_rows.size());
  for (std::size_t k = 0; k < count; ++k) std::memcpy(&to[at(to_rows, k)], &from[at(from_rows, k)], row);
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
  if (!ranks::several()) return copy_rows(rows, packed_, whole, arriving_, row);
  std::vector<std::byte> out(rows.size()), in(whole.size());
  copy_rows(rows, packed_, out, {}, row);
  ranks::deal_items(out.data(), leaving_count_, in.data(), arriving_count_, row);
  copy_rows(in, {}, whole, arriving_, row);
}

void RowPlan::hand_out(std::span<std::byte const> whole, std::span<std::byte> rows, std::size_t row) const {
  PIOLA_EXPECTS(rows.size() == packed_.size() * row && whole.size() == arriving_.size() * row);
  if (!ranks::several()) return copy_rows(whole, arriving_, rows, packed_, row);
  std::vector<std::byte> out(whole.size()), in(rows.size());
  copy_rows(whole, arriving_, out, {}, row);
  ranks::deal_items(out.data(), arriving_count_, in.data(), leaving_count_, row);
  copy_rows(in, {}, rows, packed_, row);
}

}  // namespace piola
