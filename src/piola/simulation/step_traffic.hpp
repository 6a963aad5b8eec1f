// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/error_agreement.hpp"
#include "piola/output/summary.hpp"
#include <cstdint>
#include <vector>

namespace piola {

/// Counts the communication of this rank within steps, without that of observers.
class StepTraffic {
 public:
  void begin_step();
  void end_step();
  /// Means per step of each rank; empty on one rank. Collective.
  std::vector<RankTraffic> of_ranks() const;

 private:
  struct Snapshot {
    comm::Traffic traffic = comm::traffic();
    comm::CommStatistics spent = comm::comm_statistics();
  };
  Snapshot before_;
  std::int64_t steps_ = 0;
  RankTraffic sum_;
};

}  // namespace piola
