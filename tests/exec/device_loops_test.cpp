// SPDX-License-Identifier: Apache-2.0
#include "piola/exec/device_loops.hpp"
#include "piola/exec/host_loops.hpp"
#include "exec/thread_count.hpp"
#include "math/random.hpp"
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <numeric>
#include <omp.h>
#include <set>
#include <vector>

namespace piola {
namespace {

using testing::thread_counts;
using testing::Threads;

TEST(Threads, AreAsManyAsAskedFor) {
  Threads const keep(1);
  EXPECT_EQ(exec_host::set_threads(2), 2);
  EXPECT_EQ(exec_host::threads(), 2);
  EXPECT_GE(exec_host::set_threads(0), 1);
}

/// The number of the thread that worked on each particle: that loops are shared is not taken on trust.
struct Worker {
  int* of;
  void operator()(Index i) const { of[i] = omp_get_thread_num(); }
};

TEST(Threads, AllWorkOnSmallBodiesInTests) {
  for (int const threads : thread_counts) {
    Threads const keep(threads);
    std::vector<int> worker(128, -1);
    exec::for_each(Range{0, 128}, Worker{worker.data()});
    std::set<int> workers(worker.begin(), worker.end());
    workers.erase(-1);  // particles of a group of lanes beside its first
    EXPECT_EQ(workers.size(), static_cast<std::size_t>(threads));
  }
}

TEST(Threads, TakePartWhereEachHasEnoughToDo) {
  Threads const keep(4);
  exec_host::set_min_grain_size(2048);
  EXPECT_EQ(exec_host::team_size(0), 1);
  EXPECT_EQ(exec_host::team_size(2047), 1);
  EXPECT_EQ(exec_host::team_size(2048), 2);
  EXPECT_EQ(exec_host::team_size(1'000'000), 4);
}

struct Visit {
  int* seen;
  void operator()(Index i) const { ++seen[i]; }
};

TEST(ForEach, VisitsEveryParticleOfTheRangeOnce) {
  for (int const threads : thread_counts) {
    Threads const keep(threads);
    std::vector<int> seen(1000, 0);
    exec::for_each(Range{3, 997}, Visit{seen.data()});
    for (int i = 0; i < 1000; ++i) EXPECT_EQ(seen[static_cast<std::size_t>(i)], i >= 3 && i < 997 ? 1 : 0);
  }
}

struct VisitBlock {
  int* seen;
  int* block_of;
  void operator()(Range b, Index k) const {
    for (Index i = b.first; i < b.last; ++i) {
      ++seen[i];
      block_of[i] = k;
    }
  }
};

TEST(ForEachBlock, CutsTheRangeIntoBlocksOfOneSize) {
  std::vector<int> seen(200, 0), block_of(200, -1);
  Range const r{10, 190};
  exec::for_each_block(r, VisitBlock{seen.data(), block_of.data()});
  EXPECT_EQ(exec::block_count(r), 3);
  for (int i = 10; i < 190; ++i) {
    EXPECT_EQ(seen[static_cast<std::size_t>(i)], 1);
    EXPECT_EQ(block_of[static_cast<std::size_t>(i)], (i - 10) / exec::block_size);
  }
  EXPECT_EQ(exec::block_count(Range{5, 5}), 0);
}

struct SweepDouble {
  static constexpr int sums = 2;
  double const* in;
  void operator()(Index i, exec::Scratch const& out) const {
    *out.at(i, 0) = 2 * in[i];
    *out.at(i, 1) = -in[i];
  }
};
struct UseSums {
  double* out;
  void operator()(Index i, exec::Scratch const& in) const { out[i] = *in.at(i, 0) + 10 * *in.at(i, 1); }
};

TEST(ForEachThen, HandsTheSumsOfEveryParticleToTheSecondPass) {
  std::vector<double> in(300), out(300, 0);
  std::iota(in.begin(), in.end(), 1.0);
  UseSums const use{out.data()};
  exec::for_each_then(Range{0, 300}, SweepDouble{in.data()}, exec::erased(use));
  for (std::size_t i = 0; i < 300; ++i) EXPECT_EQ(out[i], -8 * in[i]);
}

struct SumTwo {
  double const* value;
  void operator()(Index i, Lanes* sums) const {
    sums[0] = sums[0] + value[i];
    sums[1] = sums[1] + value[i] * value[i];
  }
};

exec::Totals<2> total(std::vector<double> const& value, int threads) {
  Threads const keep(threads);
  Range const r{0, static_cast<Index>(value.size())};
  std::vector<double> partial(static_cast<std::size_t>(exec::leaf_count(r)) * 2);
  return exec::reduce<2>(r, SumTwo{value.data()}, partial.data());
}

TEST(Reduce, IsExactForWholeNumbers) {
  for (std::size_t const n : {0U, 1U, 63U, 64U, 65U, 1000U, 4097U}) {
    std::vector<double> value(n);
    std::iota(value.begin(), value.end(), 1.0);
    auto const N = static_cast<double>(n);
    exec::Totals<2> const t = total(value, 2);
    EXPECT_EQ(t.v[0], N * (N + 1) / 2) << n;
    EXPECT_EQ(t.v[1], N * (N + 1) * (2 * N + 1) / 6) << n;
  }
}

TEST(Reduce, HasTheSameBitsWhereverLeavesStand) {
  testing::Random random(3);
  std::vector<std::array<double, 16>> leaves(311);
  for (auto& leaf : leaves)
    for (double& v : leaf) v = std::exp(random.in(-20, 20)) * random.in(-1, 1);
  auto const sum = [&] {
    std::vector<double> value;
    for (auto const& leaf : leaves) value.insert(value.end(), leaf.begin(), leaf.end());
    return total(value, 3);
  };
  exec::Totals<2> const before = sum();
  std::reverse(leaves.begin() + 7, leaves.end());
  exec::Totals<2> const after = sum();
  EXPECT_EQ(std::memcmp(before.v, after.v, sizeof before.v), 0);
}

TEST(Reduce, HasTheSameBitsForAnyNumberOfThreads) {
  testing::Random random(1);
  std::vector<double> value(5000);
  for (double& v : value) v = std::exp(random.in(-20, 20)) * random.in(-1, 1);  // every order gives other bits
  exec::Totals<2> const one = total(value, 1);
  double plain = 0;
  for (double const v : value) plain += v;
  EXPECT_NE(plain, one.v[0]) << "the data do not show the order of the sum";
  for (int repeat = 0; repeat < 10; ++repeat)
    for (int const threads : thread_counts) {
      exec::Totals<2> const more = total(value, threads);
      EXPECT_EQ(std::memcmp(one.v, more.v, sizeof one.v), 0) << threads;
    }
}

struct Fail {
  FailureSlot* slot;
  Index first;
  void operator()(Index i) const {
    if (i >= first && i % 3 == 0) exec::record(slot, i, static_cast<int>(i) + 1);
  }
};

TEST(Record, KeepsTheLowestIndexForAnyNumberOfThreads) {
  for (int repeat = 0; repeat < 50; ++repeat)
    for (int const threads : thread_counts) {
      Threads const keep(threads);
      FailureSlot slot;
      exec::for_each(Range{0, 4000}, Fail{&slot, 1000});
      EXPECT_EQ(slot.index, 1002);
      EXPECT_EQ(slot.code, 1003);
    }
}

TEST(Record, IsEmptyWithoutFailures) {
  FailureSlot slot;
  exec::for_each(Range{0, 4000}, Fail{&slot, 5000});
  EXPECT_EQ(slot.index, FailureSlot::none);
}

/// Sums of the host, shared by threads; plain ones would differ in their last bits.
TEST(SumsOf, HaveTheSameBitsForAnyNumberOfThreads) {
  auto const term = [](Index k) { return std::sin(1.7 * k) * std::exp(0.01 * (k % 1000)); };
  double const one = [&] {
    Threads const keep(1);
    return exec_host::parallel_sum(5001, term);
  }();
  for (int const threads : testing::thread_counts) {
    Threads const keep(threads);
    EXPECT_EQ(exec_host::parallel_sum(5001, term), one) << threads;
  }
  double plain = 0;
  for (Index k = 0; k < 5001; ++k) plain += term(k);
  EXPECT_NEAR(plain, one, 1e-8 * 22026);
}

TEST(FailureSlot, KeepsTheLowestId) {
  std::vector<std::int64_t> const id{7, 3, 9, -1};  // the last slot holds no particle
  FailureSlot slot;
  slot.id = id.data();
  for (Index const i : {3, 2, 0, 1, 2}) exec::record(&slot, i, 10 + i);
  EXPECT_EQ(slot.index, 1);
  EXPECT_EQ(slot.code, 11);
  slot.clear();
  EXPECT_EQ(slot.index, FailureSlot::none);
  EXPECT_EQ(slot.id, id.data());
}

}  // namespace
}  // namespace piola
