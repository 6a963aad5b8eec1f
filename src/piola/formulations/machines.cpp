// SPDX-License-Identifier: Apache-2.0
// The machines of every formulation, and how one is chosen: see exec/instruction_sets.hpp.
#include "piola/exec/instruction_sets.hpp"
#include "piola/formulations/adaptle/state.hpp"
#include "piola/formulations/jst_sph/state.hpp"
#include "piola/formulations/nodal/state.hpp"
#include "piola/formulations/taylor_sph/state.hpp"

PIOLA_CHOOSE_MACHINE(adaptle)
PIOLA_CHOOSE_MACHINE(jst_sph)
PIOLA_CHOOSE_MACHINE(nodal)
PIOLA_CHOOSE_MACHINE(taylor_sph)
