// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/partition.hpp"
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace piola {

/// When particles are repartitioned to balance the work of the ranks (run.repartition).
struct Repartition {
  bool never = false;
  int every = 0;  ///< steps between repartitions; 0: when the imbalance exceeds LoadBalancer::least
};

/// History of repartitions.
struct RepartitionStatistics {
  std::vector<double> imbalance;  ///< before each repartition: largest busy time / mean - 1
  double last = 0;                ///< at the last evaluation
};

/// RAII timer: adds the CPU time of its scope [s], divided by the number of threads and without communication. Equals
/// the wall time on dedicated cores and still measures the work on shared ones. `sum` must outlive it.
class WorkTimer {
 public:
  explicit WorkTimer(double& sum);
  WorkTimer(WorkTimer const&) = delete;
  WorkTimer& operator=(WorkTimer const&) = delete;
  ~WorkTimer();

 private:
  double& sum_;
  double before_;
};

/// Returns largest / mean - 1 of the values; 0 if all are zero.
double imbalance_of(std::span<double const> busy);

/// Measures the busy time of the ranks and decides when to repartition. Measured times affect partitions alone, never
/// results. Tests draw partitions at random by the environment variable PIOLA_DRAWN_CUTS (the seed).
class LoadBalancer {
 public:
  static constexpr int window = 200;      ///< steps over which busy times are compared
  static constexpr int apart = 500;       ///< least number of steps between two repartitions
  static constexpr double least = 0.1;    ///< imbalance above which a repartition is considered
  static constexpr double gained = 0.02;  ///< fraction of the largest busy time that a repartition must save

  explicit LoadBalancer(Repartition when) : when_(when) {}

  /// Busy time of this rank without waiting for other ranks [s]; steps add to it.
  double& busy() { return busy_; }
  /// Call once before each step. Returns whether to repartition, alike on all ranks. Collective once per window, or
  /// before every forced repartition.
  bool due();
  /// Busy time of each rank in the last window that due() evaluated [s].
  std::span<double const> seconds() const { return seconds_; }
  struct Plan {
    std::vector<Partition> cuts;  ///< of each body
    double longest;               ///< expected busy time of the most loaded rank per window [s]
  };
  /// Proposes partitions. now: present partition of each body. work: relative work of each of its blocks, scaled here
  /// by the busy time of the rank that owns the block.
  Plan plan(std::vector<Partition> const& now, std::vector<std::vector<double>> work) const;
  /// Whether a repartition pays after which the most loaded rank is busy for `longest` [s] per window.
  bool pays(double longest) const;
  void record_repartition();
  RepartitionStatistics const& repartition_statistics() const { return statistics_; }

 private:
  Repartition when_;
  double busy_ = 0;
  std::int64_t steps_ = 0, last_cut_ = -apart;
  std::vector<double> seconds_;
  RepartitionStatistics statistics_;
};

}  // namespace piola
