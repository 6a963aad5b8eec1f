// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/state.hpp"
#include <string_view>

namespace piola {

// Each is defined by machine.cpp, compiled for that instruction set.
#define PIOLA_DECLARE_MACHINE(NAME) \
  namespace jst_sph::NAME {         \
  extern Machine const machine;     \
  }
#if defined(PIOLA_HAS_MACHINE_SCALAR)
PIOLA_DECLARE_MACHINE(scalar)
#endif
#if defined(PIOLA_HAS_MACHINE_V2)
PIOLA_DECLARE_MACHINE(v2)
#endif
#if defined(PIOLA_HAS_MACHINE_V3)
PIOLA_DECLARE_MACHINE(v3)
#endif
#if defined(PIOLA_HAS_MACHINE_V4)
PIOLA_DECLARE_MACHINE(v4)
#endif
#if defined(PIOLA_HAS_MACHINE_NATIVE)
PIOLA_DECLARE_MACHINE(native)
#endif

namespace jst_sph {
namespace {

struct Candidate {
  Machine const* machine;
  bool usable;
};

bool cpu_has_v2() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt");
#else
  return false;
#endif
}
bool cpu_has_v3() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
#else
  return false;
#endif
}
bool cpu_has_v4() {
#if defined(__x86_64__)
  return cpu_has_v3() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512cd");
#else
  return false;
#endif
}

/// Best first.
constexpr int most = 6;
struct Candidates {
  Candidate list[most];
  int count = 0;
  char const* names[most + 1]{};
  int usable = 0;
  void add(Machine const& machine, bool is_usable) {
    list[count++] = {&machine, is_usable};
    if (is_usable) names[usable++] = machine.name;
  }
  Candidates() {
    (void)&cpu_has_v2;
    (void)&cpu_has_v3;
    (void)&cpu_has_v4;
#if defined(PIOLA_HAS_MACHINE_V4)
    add(v4::machine, cpu_has_v4());
#endif
#if defined(PIOLA_HAS_MACHINE_V3)
    add(v3::machine, cpu_has_v3());
#endif
#if defined(PIOLA_HAS_MACHINE_V2)
    add(v2::machine, cpu_has_v2());
#endif
#if defined(PIOLA_HAS_MACHINE_NATIVE)
    add(native::machine, true);
#endif
#if defined(PIOLA_HAS_MACHINE_SCALAR)
    add(scalar::machine, true);
#endif
  }
};

Candidates const& candidates() {
  static Candidates const all;
  return all;
}

}  // namespace

Machine const* find_machine(char const* name) {
  std::string_view const wanted = name;
  auto const& all = candidates();
  for (int k = 0; k < all.count; ++k)
    if (all.list[k].usable && (wanted == "auto" || wanted == all.list[k].machine->name)) return all.list[k].machine;
  return nullptr;
}

char const* const* machine_names() { return candidates().names; }

}  // namespace jst_sph
}  // namespace piola
