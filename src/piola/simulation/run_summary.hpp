// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/observers/run_log.hpp"
#include "piola/observers/time_state.hpp"
#include "piola/output/history.hpp"
#include "piola/output/summary.hpp"
#include "piola/simulation/build.hpp"

namespace piola {

/// Summary of a run, without guards and relaxation. Quantities that cannot be measured are reported to the journal if
/// the run was completed.
Summary summarise(Simulation const& simulation, TimeState const& moment, RunStatus ending, HistoryTable const& history,
                  RunLog& journal);

/// Largest rise of (total energy - external work) above any earlier row, by the largest total energy of the history.
double energy_increase(HistoryTable const& history);
/// Largest fall of (total energy - external work) below any earlier row, divided likewise: dissipation by
/// stabilisation, viscosity and friction.
double energy_decrease(HistoryTable const& history);

}  // namespace piola
