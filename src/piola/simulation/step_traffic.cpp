// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/step_traffic.hpp"
#include <algorithm>
#include <array>

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
  std::array const mine{sum_.messages / steps,           sum_.bytes / steps,
                        sum_.collectives / steps,        sum_.message_seconds / steps,
                        sum_.collective_seconds / steps, sum_.replicated_bytes / steps};
  std::vector<double> const all = comm::gather(mine);
  std::vector<RankTraffic> each;
  for (std::size_t k = 0; k + mine.size() <= all.size(); k += mine.size())
    each.push_back({all[k], all[k + 1], all[k + 2], all[k + 3], all[k + 4], all[k + 5]});
  return each;
}

}  // namespace piola
