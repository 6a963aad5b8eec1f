// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/parallel/shares.hpp"
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace piola {

/// When a run that ranks share is cut anew, so that all of them have as much to do (run.repartition).
struct Repartition {
  bool never = false;
  int every = 0;  ///< steps; 0: when a rank is busier than the others
};

/// How often it was, and why.
struct Recuts {
  std::vector<double> imbalance;  ///< before each: busy time of the busiest rank above the mean, as a share of that
  double last = 0;                ///< when it was looked at for the last time
};

/// Adds the processor time of its life to a sum, divided by threads and without that of messages and collectives [s].
/// It is as long as the wall time of a rank that has its cores for itself; of one that has not it still tells its work.
class BusyWatch {
 public:
  explicit BusyWatch(double& sum);
  BusyWatch(BusyWatch const&) = delete;
  BusyWatch& operator=(BusyWatch const&) = delete;
  ~BusyWatch();

 private:
  double& sum_;
  double before_;
};

/// The largest above the mean, as a share of the mean; 0 if nothing is above zero.
double imbalance_of(std::span<double const> busy);

/// How long ranks are busy with their own shares, and when this is a reason to cut anew. Times decide about cuts alone,
/// never about numbers. Tests of ranks have cuts drawn at random, by the environment variable PIOLA_DRAWN_CUTS.
class WorkBalance {
 public:
  static constexpr int window = 200;      ///< steps over which busy times are compared
  static constexpr int apart = 500;       ///< steps between two cuts
  static constexpr double least = 0.1;    ///< imbalance that is worth a cut
  static constexpr double gained = 0.02;  ///< share of the time of the busiest rank that a cut must save

  explicit WorkBalance(Repartition when) : when_(when) {}

  /// Time of what this rank alone does for its share, without waiting for others [s]: steps add to it.
  double& busy() { return busy_; }
  /// Once before each step: whether there is a reason to cut anew, the same on all ranks. Collective once in a window,
  /// or before every forced cut.
  bool due();
  /// Of each rank, in the steps that due() has looked at [s].
  std::span<double const> seconds() const { return seconds_; }
  struct Plan {
    std::vector<Shares> cuts;  ///< of each body
    double longest;            ///< expected of the busiest rank, over as many steps as before [s]
  };
  /// now: who has what of each body; work: of each of its blocks, relative to others. What a rank has had is worth the
  /// time that it was busy with it.
  Plan plan(std::vector<Shares> const& now, std::vector<std::vector<double>> work) const;
  /// Whether a cut is worth it after which the busiest rank would be busy for so long [s].
  bool pays(double longest) const;
  void was_cut();
  Recuts const& recuts() const { return recuts_; }

 private:
  Repartition when_;
  double busy_ = 0;
  std::int64_t steps_ = 0, last_cut_ = -apart;
  std::vector<double> seconds_;
  Recuts recuts_;
};

}  // namespace piola
