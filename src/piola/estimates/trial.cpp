// SPDX-License-Identifier: Apache-2.0
#include "piola/estimates/trial.hpp"
#include "piola/simulation/time_loop.hpp"
#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace piola {
namespace {

/// Notes the length of each step that nothing but stability has chosen.
class StepLengths final : public Observer {
 public:
  void observe(Formulation const&, TimeState const& moment) override {
    if (!moment.cut_to_end) lengths_.push_back(moment.dt);
  }
  /// Mean of the `k`-th last quarter of the steps, 0 being the last [s]; 0 if there are none.
  double mean_of_quarter(std::size_t k) const {
    std::size_t const n = lengths_.size(), some = std::max<std::size_t>(1, n / 4);
    if (n < (k + 1) * some) return 0;
    auto const last = lengths_.end() - static_cast<std::ptrdiff_t>(k * some);
    return std::accumulate(last - static_cast<std::ptrdiff_t>(some), last, 0.0) / static_cast<double>(some);
  }

 private:
  std::vector<double> lengths_;
};

}  // namespace

Trial take_trial_steps(Formulation& formulation, RunSpec const& run, std::int64_t most, double seconds) {
  std::atomic<int> const nobody_asks{0};
  WallLimit wall(seconds, WallLimit::Clock::now());
  StepLengths lengths;
  std::array<Observer*, 1> const observers{&lengths};
  TimeState moment;
  LoopResult march_result = march(formulation, run, moment, observers, {nobody_asks, wall, {.step = most}});
  Trial trial{.steps = moment.step, .time = moment.time, .over = march_result.ending == RunStatus::completed};
  trial.failure = std::move(march_result.failure);
  trial.step = lengths.mean_of_quarter(0);
  trial.earlier = lengths.mean_of_quarter(1);
  if (!(trial.step > 0)) trial.step = moment.dt;
  if (!(trial.earlier > 0)) trial.earlier = trial.step;
  return trial;
}

}  // namespace piola
