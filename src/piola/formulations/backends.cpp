// SPDX-License-Identifier: Apache-2.0
// The back ends of every formulation, and how one is chosen: see exec/backend_registry.hpp.
#include "piola/exec/backend_registry.hpp"
#include "piola/formulations/adaptle/state.hpp"
#include "piola/formulations/jst_sph/state.hpp"
#include "piola/formulations/nodal/state.hpp"
#include "piola/formulations/taylor_sph/state.hpp"

PIOLA_CHOOSE_BACKEND(adaptle)
PIOLA_CHOOSE_BACKEND(jst_sph)
PIOLA_CHOOSE_BACKEND(nodal)
PIOLA_CHOOSE_BACKEND(taylor_sph)
