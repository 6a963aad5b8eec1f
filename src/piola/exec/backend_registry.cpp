// SPDX-License-Identifier: Apache-2.0
#include "piola/exec/backend_registry.hpp"
#include "piola/base/contracts.hpp"
#include <fmt/format.h>

namespace piola::exec_host {
namespace {

#if defined(__x86_64__)
bool has_v3() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
}
bool has_v4() {
  return has_v3() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512cd");
}
#else
bool has_v3() { return false; }
bool has_v4() { return false; }
#endif

std::string_view best_of_processor() { return has_v4() ? "v4" : has_v3() ? "v3" : "scalar"; }

}  // namespace

bool processor_can_run(std::string_view backend) {
  if (backend == "v3") return has_v3();
  if (backend == "v4") return has_v4();
  return backend == "scalar" || backend == "native";
}

std::vector<std::string> usable_backends() {
  std::vector<std::string> usable;
#define PIOLA_NAME(backend) \
  if (processor_can_run(#backend)) usable.emplace_back(#backend);
  PIOLA_EACH_BACKEND(PIOLA_NAME)
#undef PIOLA_NAME
  return usable;
}

std::string backend_text(std::string_view asked) {
  PIOLA_EXPECTS(!asked.empty());
  auto const usable = usable_backends();
  std::string const name = asked == "auto" && !usable.empty() ? usable.front() : std::string(asked);
  return name + " of a processor with " + std::string(best_of_processor());
}

std::string not_usable(std::string_view backend, char const* const* usable) {
  PIOLA_EXPECTS(usable != nullptr);
  if (*usable == nullptr)
    return "this program was built for another processor (it has no instruction set that this one can run) - build it "
           "here with tools/quickstart, or for every processor of the family with cmake --preset release";
  std::string known = "auto";
  for (auto name = usable; *name != nullptr; ++name) known += fmt::format(", {}", *name);
  return fmt::format("instruction set '{}' is unknown or not usable on this processor (usable: {})", backend, known);
}

}  // namespace piola::exec_host
