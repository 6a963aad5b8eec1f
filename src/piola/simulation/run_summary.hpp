// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/history.hpp"
#include "piola/output/summary.hpp"
#include "piola/simulation/build.hpp"
#include "piola/simulation/journal.hpp"
#include "piola/simulation/moment.hpp"

namespace piola {

/// What came out of a run, but for what the guards and a relaxation have to say. Quantities that cannot be measured are
/// told to the journal if the run was completed.
Summary summarise(Simulation const& simulation, Moment const& moment, Ending ending, HistoryTable const& history,
                  Journal& journal);

/// Largest rise of (total energy - external work) above any earlier row, by the largest total energy of the history.
double energy_increase(HistoryTable const& history);
/// Its largest fall below any earlier row, likewise: what stabilisation, viscosity and friction took.
double energy_decrease(HistoryTable const& history);

}  // namespace piola
