// SPDX-License-Identifier: Apache-2.0
#include "piola/exec/instruction_sets.hpp"

namespace piola::exec_host {
namespace {

#if defined(__x86_64__)
bool has_v2() { return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt"); }
bool has_v3() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
}
bool has_v4() {
  return has_v3() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512cd");
}
#else
bool has_v2() { return false; }
bool has_v3() { return false; }
bool has_v4() { return false; }
#endif

}  // namespace

bool processor_can_run(std::string_view machine) {
  if (machine == "v2") return has_v2();
  if (machine == "v3") return has_v3();
  if (machine == "v4") return has_v4();
  return machine == "scalar" || machine == "native";
}

}  // namespace piola::exec_host
