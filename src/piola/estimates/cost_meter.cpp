// SPDX-License-Identifier: Apache-2.0
#include "piola/estimates/cost_meter.hpp"
#include "piola/exec/heap_tuning.hpp"
#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>

namespace piola {
namespace {

/// A value of /proc/self/status: "VmRSS:", resident memory, or "VmHWM:", its maximum [bytes].
double resident_bytes(std::string_view key) {
  std::ifstream status("/proc/self/status");
  double kilobytes = 0;
  for (std::string word; status >> word;)
    if (word == key && status >> kilobytes) return 1024 * kilobytes;
  return 0;
}

}  // namespace

CostMeter::CostMeter() {
  exec_host::trim_heap();                       // else arrays would take freed memory that is still resident
  std::ofstream("/proc/self/clear_refs") << 5;  // resets the maximum
  before_ = resident_bytes("VmRSS:");
  start_ = Clock::now();
}

double CostMeter::bytes() const { return std::max(0.0, resident_bytes("VmHWM:") - before_); }

}  // namespace piola
