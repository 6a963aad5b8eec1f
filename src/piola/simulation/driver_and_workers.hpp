// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/communicator.hpp"
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/output/summary.hpp"
#include "piola/simulation/build.hpp"
#include <functional>
#include <memory>
#include <optional>
#include <vector>

/// Runs on several ranks. Every rank reads the case and builds the simulation. Then rank 0 runs it as a serial run
/// would, and each collective call of its formulation is broadcast to the other ranks, which execute the same call
/// (driven_by_root, run_worker). Only rank 0 has the loop, the observers, the files and the messages.
namespace piola {

/// Throws comm::CollectiveError on all ranks unless all have generated identical particles and materials. Collective.
void require_identical_case(Assembly const& assembly);

/// Collective, also for ranks with an error. Throws comm::CollectiveError on all ranks if one has an error.
void agree_to_continue();

/// On rank 0 of several ranks: wraps the formulation so that its collective calls run on all ranks. Otherwise returns
/// it unchanged.
std::unique_ptr<Formulation> driven_by_root(std::unique_ptr<Formulation> formulation);

/// On rank 0 of several ranks: makes the other ranks evaluate their part of the probes (ProbeSet), then calls look().
/// Otherwise only calls look(). `time` [s].
void evaluate_probes_collectively(double time, std::function<void()> const& look);

/// On rank 0 of several ranks: makes the other ranks write their part of a frame, then calls write(). Otherwise only
/// calls write(). `failed`: see fields_of_frames().
void write_frame_collectively(bool failed, std::function<void()> const& write);

/// On the other ranks: executes the commands of rank 0 until it sends the end; returns the exit code that it sends.
int run_worker(Simulation& simulation);

/// On rank 0 of several ranks: the traffic of each rank per step since the first one. Otherwise empty.
std::vector<RankTraffic> traffic_on_ranks();

/// Shuts down a rank with an exit code and a message: informs the other ranks and returns the error with which the
/// whole run ends. Empty if they do not respond in time, because they wait for this rank: then call comm::abort_all.
std::optional<comm::RankError> shut_down(comm::RankError const& own);

}  // namespace piola
