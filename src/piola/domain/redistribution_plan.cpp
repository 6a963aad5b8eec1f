// SPDX-License-Identifier: Apache-2.0
#include "piola/domain/redistribution_plan.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
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

RedistributionPlan::RedistributionPlan(DistributedRows const& rows, Index block) : count_(rows.count), block_(block) {
  PIOLA_EXPECTS(rows.count >= 0);
  PIOLA_EXPECTS(block > 0);
  auto const n = static_cast<std::size_t>(comm::size());
  Index const own_rows = rows.places ? static_cast<Index>(rows.places->size()) : count_;
  std::int64_t const blocks = (std::int64_t{count_} + block_ - 1) / block_;
  std::vector<std::vector<Index>> leaving(n), of_rank(n);
  for (Index k = 0; k < own_rows; ++k) {
    Index const place = rows.places ? (*rows.places)[static_cast<std::size_t>(k)] : k;
    PIOLA_EXPECTS(place >= 0 && place < count_);
    auto const rank =
        static_cast<std::size_t>(std::int64_t{place / block_} * comm::size() / blocks);  // whose stretch it is in
    of_rank[rank].push_back(k);
    leaving[rank].push_back(place - of(static_cast<int>(rank)).first);
  }
  for (auto const& part : of_rank) {
    scattered_.counts.push_back(static_cast<Index>(part.size()));
    scattered_.rows.insert(scattered_.rows.end(), part.begin(), part.end());
  }
  for (auto const& part : comm::alltoall(leaving)) {
    stretch_.counts.push_back(static_cast<Index>(part.size()));
    stretch_.rows.insert(stretch_.rows.end(), part.begin(), part.end());
  }
  PIOLA_ENSURES(static_cast<Index>(stretch_.rows.size()) == own().last - own().first);
}

Range RedistributionPlan::of(int rank) const {
  PIOLA_EXPECTS(rank >= 0 && rank < comm::size());
  std::int64_t const blocks = (std::int64_t{count_} + block_ - 1) / block_, n = comm::size();
  auto const start = [&](std::int64_t r) {
    return static_cast<Index>(std::min<std::int64_t>(count_, (blocks * r + n - 1) / n * block_));
  };
  return {start(rank), start(rank + 1)};
}
Range RedistributionPlan::own() const { return of(comm::rank()); }

void RedistributionPlan::move(std::span<std::byte const> from, Side const& there, std::span<std::byte> to,
                              Side const& here, std::size_t row) const {
  PIOLA_EXPECTS(from.size() == there.rows.size() * row && to.size() == here.rows.size() * row);
  if (!comm::is_parallel()) return copy_rows(from, there.rows, to, here.rows, row);
  std::vector<std::byte> out(from.size()), in(to.size());
  copy_rows(from, there.rows, out, {}, row);
  comm::alltoall_items(out.data(), there.counts, in.data(), here.counts, row);
  copy_rows(in, {}, to, here.rows, row);
}

}  // namespace piola
