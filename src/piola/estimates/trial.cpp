// SPDX-License-Identifier: Apache-2.0
#include "piola/estimates/trial.hpp"
#include "piola/base/contracts.hpp"
#include "piola/simulation/time_loop.hpp"
#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace piola {
namespace {

/// Notes the wall time of each step, and its length if nothing but stability has chosen it. Asks for an end.
class TrialObserver final : public Observer {
 public:
  explicit TrialObserver(TrialLimits const& limits) : limits_(limits) {}
  void observe(Formulation const&, TimeState const& moment) override {
    if (!moment.cut_to_end) lengths_.push_back(moment.dt);
    ends_.push_back(moment.stepping_seconds);
    if (moment.step >= limits_.fewest && moment.stepping_seconds >= limits_.seconds) enough_ = 1;
  }
  std::atomic<int> const& enough() const { return enough_; }
  /// Mean of the `k`-th last quarter of the steps, 0 being the last [s]; 0 if there are none.
  double mean_of_quarter(std::size_t k) const {
    std::size_t const n = lengths_.size(), some = std::max<std::size_t>(1, n / 4);
    if (n < (k + 1) * some) return 0;
    auto const last = lengths_.end() - static_cast<std::ptrdiff_t>(k * some);
    return std::accumulate(last - static_cast<std::ptrdiff_t>(some), last, 0.0) / static_cast<double>(some);
  }
  /// Mean wall time of the last half of the steps [s]; 0 if there are none.
  double step_seconds() const {
    std::size_t const n = ends_.size(), before = n / 2;
    if (n == 0) return 0;
    return (ends_.back() - (before > 0 ? ends_[before - 1] : 0)) / static_cast<double>(n - before);
  }

 private:
  TrialLimits limits_;
  std::vector<double> lengths_, ends_;
  std::atomic<int> enough_{0};
};

}  // namespace

Trial take_trial_steps(Formulation& formulation, RunSpec const& run, TrialLimits const& limits) {
  PIOLA_EXPECTS(limits.fewest >= 0 && limits.most >= 0 && limits.seconds >= 0);
  WallLimit wall(limits.longest, WallLimit::Clock::now());
  TrialObserver steps(limits);
  std::array<Observer*, 1> const observers{&steps};
  TimeState moment;
  LoopResult march_result = march(formulation, run, moment, observers, {steps.enough(), wall, {.step = limits.most}});
  Trial trial{.steps = moment.step, .time = moment.time, .over = march_result.ending == RunStatus::completed};
  trial.failure = std::move(march_result.failure);
  trial.step = steps.mean_of_quarter(0);
  trial.earlier = steps.mean_of_quarter(1);
  if (!(trial.step > 0)) trial.step = moment.dt;
  if (!(trial.earlier > 0)) trial.earlier = trial.step;
  trial.step_seconds = steps.step_seconds();
  return trial;
}

}  // namespace piola
