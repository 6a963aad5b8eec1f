// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/step_traffic.hpp"
#include <algorithm>

namespace piola {

void StepTraffic::begin_step() { before_ = Snapshot(); }

void StepTraffic::end_step() {
  Snapshot const now;
  ++steps_;
  sum_.messages += static_cast<double>(now.traffic.messages - before_.traffic.messages);
  sum_.bytes += static_cast<double>(now.traffic.bytes - before_.traffic.bytes);
  sum_.collectives += static_cast<double>(now.spent.collectives - before_.spent.collectives);
  sum_.message_seconds += now.spent.in_exchanges - before_.spent.in_exchanges;
  sum_.collective_seconds += now.spent.in_collectives - before_.spent.in_collectives;
  sum_.replicated_bytes += static_cast<double>(now.spent.replicated_bytes - before_.spent.replicated_bytes);
}

std::vector<RankTraffic> StepTraffic::of_ranks() const {
  if (!comm::is_parallel()) return {};
  double const steps = static_cast<double>(std::max<std::int64_t>(1, steps_));
  return comm::allgather_item(RankTraffic{sum_.messages / steps, sum_.bytes / steps, sum_.collectives / steps,
                                          sum_.message_seconds / steps, sum_.collective_seconds / steps,
                                          sum_.replicated_bytes / steps});
}

}  // namespace piola
