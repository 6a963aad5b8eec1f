// SPDX-License-Identifier: Apache-2.0
#include "piola/exec/instruction_sets.hpp"
#include "piola/formulations/nodal/state.hpp"

namespace piola::nodal {

#define PIOLA_DECLARE_MACHINE(NAME) \
  namespace NAME {                  \
  extern Machine const machine;     \
  }
PIOLA_EACH_MACHINE(PIOLA_DECLARE_MACHINE)

namespace {

exec_host::MachineChoice<Machine> const& choice() {
#define PIOLA_POINT_TO_MACHINE(NAME) &NAME::machine,
  static exec_host::MachineChoice<Machine> const all({PIOLA_EACH_MACHINE(PIOLA_POINT_TO_MACHINE)});
  return all;
}

}  // namespace

Machine const* find_machine(char const* name) { return choice().find(name); }

char const* const* machine_names() { return choice().names(); }

}  // namespace piola::nodal
