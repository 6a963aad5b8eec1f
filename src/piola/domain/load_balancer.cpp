// SPDX-License-Identifier: Apache-2.0
#include "piola/domain/load_balancer.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/error_agreement.hpp"
#include "piola/exec/cpu_time.hpp"
#include "piola/exec/threads.hpp"
#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <random>

namespace piola {
namespace {

/// CPU time without communication since the start of the program, mean per thread [s].
double time_of_its_own() {
  return (exec_host::processor_time() - comm::comm_statistics().processor) / exec_host::threads();
}

/// Seconds per unit of work of each rank. Ranks with little work have uncertain times, so values are clamped to a
/// factor of 4 about the mean.
std::vector<double> paces(std::span<double const> seconds, std::span<double const> work) {
  constexpr double farthest = 4;
  double const all = std::accumulate(work.begin(), work.end(), 0.0);
  double const mean = all > 0 ? std::accumulate(seconds.begin(), seconds.end(), 0.0) / all : 0;
  std::vector<double> pace(work.size(), mean > 0 ? mean : 1);
  for (std::size_t r = 0; r < work.size() && mean > 0; ++r)
    if (work[r] > 0) pace[r] = std::clamp(seconds[r] / work[r], mean / farthest, mean * farthest);
  return pace;
}

/// Random work of a block for tests, equal on all ranks. Most blocks have none, so that partitions differ much in
/// length.
double drawn_work(char const* seed, std::int64_t step, std::size_t block) {
  std::seed_seq seeds{static_cast<std::uint32_t>(std::atoi(seed)), static_cast<std::uint32_t>(step),
                      static_cast<std::uint32_t>(block)};
  std::uint32_t drawn[1];
  seeds.generate(drawn, drawn + 1);
  bool const works = drawn[0] % 10 < 3;
  return works ? static_cast<double>(1 + drawn[0] % 97) : 0.0;
}

}  // namespace

WorkTimer::WorkTimer(double& sum) : sum_(sum), before_(time_of_its_own()) {}
WorkTimer::~WorkTimer() { sum_ += time_of_its_own() - before_; }

double imbalance_of(std::span<double const> busy) {
  double const sum = std::accumulate(busy.begin(), busy.end(), 0.0);
  if (!(sum > 0)) return 0;
  return *std::max_element(busy.begin(), busy.end()) * static_cast<double>(busy.size()) / sum - 1;
}

bool LoadBalancer::due() {
  if (when_.never) return false;
  std::int64_t const done = steps_++;
  if (done == 0 || done % (when_.every > 0 ? when_.every : window) != 0) return false;
  seconds_.assign(static_cast<std::size_t>(comm::size()), 0);
  seconds_[static_cast<std::size_t>(comm::rank())] = busy_;
  busy_ = 0;
  comm::allreduce_or(seconds_);
  statistics_.last = imbalance_of(seconds_);
  return when_.every > 0 || (statistics_.last > least && done - last_cut_ >= apart);
}

LoadBalancer::Plan LoadBalancer::plan(std::vector<Partition> const& now, std::vector<std::vector<double>> work) const {
  PIOLA_EXPECTS(work.size() == now.size());
  PIOLA_EXPECTS(seconds_.size() == static_cast<std::size_t>(comm::size()));
  auto const count = static_cast<std::size_t>(comm::size());
  // f(rank, work of a block of its own)
  auto const each_block = [&](auto const& f) {
    for (std::size_t b = 0; b < now.size(); ++b)
      for (std::size_t r = 0; r < count; ++r) {
        Range const part = now[b].of(static_cast<int>(r));
        PIOLA_EXPECTS(work[b].size() == static_cast<std::size_t>(exec::block_count(now[b].whole())));
        Index const first = (part.first - now[b].whole().first) / exec::block_size;
        for (Index k = 0; k < exec::block_count(part); ++k) f(r, work[b][static_cast<std::size_t>(first + k)]);
      }
  };
  std::vector<double> had(count, 0);
  each_block([&](std::size_t r, double w) { had[r] += w; });
  std::vector<double> const pace = paces(seconds_, had);
  char const* const seed = std::getenv("PIOLA_DRAWN_CUTS");
  std::size_t number = 0;
  each_block([&](std::size_t r, double& w) { w = seed == nullptr ? w * pace[r] : drawn_work(seed, steps_, number++); });
  Plan plan{{}, 0};
  std::vector<double> busy(count, 0);
  for (std::size_t b = 0; b < now.size(); ++b) {
    std::vector<Index> const first = partition_by_work(work[b], busy);
    plan.cuts.emplace_back(now[b].whole(), first);
    for (std::size_t r = 0; r < count; ++r) {
      auto const last = r + 1 < count ? static_cast<std::size_t>(first[r + 1]) : work[b].size();
      for (auto k = static_cast<std::size_t>(first[r]); k < last; ++k) busy[r] += work[b][k];
    }
  }
  plan.longest = *std::max_element(busy.begin(), busy.end());
  return plan;
}

bool LoadBalancer::pays(double longest) const {
  PIOLA_EXPECTS(when_.every > 0 || !seconds_.empty());
  return when_.every > 0 || longest < (1 - gained) * *std::max_element(seconds_.begin(), seconds_.end());
}

void LoadBalancer::record_repartition() {
  PIOLA_EXPECTS(steps_ > 0);
  last_cut_ = steps_ - 1;
  statistics_.imbalance.push_back(statistics_.last);
}

}  // namespace piola
