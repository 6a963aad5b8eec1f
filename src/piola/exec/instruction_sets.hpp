// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/problems.hpp"
#include <string>
#include <string_view>
#include <vector>

namespace piola::exec_host {

/// Whether this processor supports the instruction set of that name (see base/machine.hpp).
bool processor_can_run(std::string_view machine);

/// Describes the instruction set of a run ("auto" too) and of the processor: "v3 of a processor with v4". Two runs have
/// equal bits only if this text is equal. The processor counts too, because mathematical functions of the system choose
/// by processor.
std::string machine_text(std::string_view asked);

/// Error text of an InputError for an instruction set that is not among `usable` (names that end with nullptr).
std::string not_usable(std::string_view machine, char const* const* usable);

/// The back ends of one formulation, one per instruction set of this program that the processor supports. `Machine` has
/// a member `name`; the objects must outlive the choice.
template <class Machine>
class MachineChoice {
 public:
  /// `all`: best first.
  explicit MachineChoice(std::vector<Machine const*> const& all) {
    for (Machine const* machine : all) {
      if (!processor_can_run(machine->name)) continue;
      usable_.push_back(machine);
      names_.push_back(machine->name);
    }
    names_.push_back(nullptr);
  }
  /// The back end of that name, the best one for "auto"; nullptr if it is not usable here.
  Machine const* find(std::string_view name) const {
    for (Machine const* machine : usable_)
      if (name == "auto" || name == machine->name) return machine;
    return nullptr;
  }
  /// As find(); throws InputError if it is not usable here.
  Machine const& choose(std::string_view name) const {
    if (Machine const* machine = find(name)) return *machine;
    throw InputError(not_usable(name, names()));
  }
  char const* const* names() const { return names_.data(); }

 private:
  std::vector<Machine const*> usable_;
  std::vector<char const*> names_;
};

}  // namespace piola::exec_host

// PIOLA_EACH_MACHINE(use): use(NAME) for every instruction set in this program, best first. Each is defined by a
// formulation's machine.cpp, compiled for that instruction set.
#if defined(PIOLA_HAS_MACHINE_V4)
#define PIOLA_USE_V4(use) use(v4)
#else
#define PIOLA_USE_V4(use)
#endif
#if defined(PIOLA_HAS_MACHINE_V3)
#define PIOLA_USE_V3(use) use(v3)
#else
#define PIOLA_USE_V3(use)
#endif
#if defined(PIOLA_HAS_MACHINE_NATIVE)
#define PIOLA_USE_NATIVE(use) use(native)
#else
#define PIOLA_USE_NATIVE(use)
#endif
#if defined(PIOLA_HAS_MACHINE_SCALAR)
#define PIOLA_USE_SCALAR(use) use(scalar)
#else
#define PIOLA_USE_SCALAR(use)
#endif
#define PIOLA_EACH_MACHINE(use) PIOLA_USE_V4(use) PIOLA_USE_V3(use) PIOLA_USE_NATIVE(use) PIOLA_USE_SCALAR(use)

// PIOLA_CHOOSE_MACHINE(formulation): find_machine(), machine_names() and choose_machine(), which the formulation's
// state.hpp declares.
#define PIOLA_DECLARE_MACHINE(NAME) \
  namespace NAME {                  \
  extern Machine const machine;     \
  }
#define PIOLA_POINT_TO_MACHINE(NAME) &NAME::machine,
#define PIOLA_CHOOSE_MACHINE(FORMULATION)                                                             \
  namespace piola::FORMULATION {                                                                      \
  PIOLA_EACH_MACHINE(PIOLA_DECLARE_MACHINE)                                                           \
  static exec_host::MachineChoice<Machine> const& machines() {                                        \
    static exec_host::MachineChoice<Machine> const all({PIOLA_EACH_MACHINE(PIOLA_POINT_TO_MACHINE)}); \
    return all;                                                                                       \
  }                                                                                                   \
  Machine const* find_machine(char const* name) { return machines().find(name); }                     \
  char const* const* machine_names() { return machines().names(); }                                   \
  Machine const& choose_machine(char const* name) { return machines().choose(name); }                 \
  }
