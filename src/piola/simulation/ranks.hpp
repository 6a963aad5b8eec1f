// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/output/summary.hpp"
#include "piola/parallel/ranks.hpp"
#include "piola/simulation/build.hpp"
#include <functional>
#include <memory>
#include <optional>
#include <vector>

/// A run that several ranks share. Every rank reads the case and builds the simulation; then rank 0 runs it as if it
/// were alone, and each call of its formulation that needs the others makes them do the same (conducted, follow). So
/// nothing else of a run knows of ranks: rank 0 has the loop, the observers, the files and the words.
namespace piola {

/// Throws InputError with all that this case asks for and that runs on one rank only; nothing on one rank.
void refuse_on_ranks(Assembly const& assembly, int count = ranks::count());

/// Throws ranks::Disagreement on all ranks unless all have made the same particles of the same materials. Collective.
void compare_on_ranks(Assembly const& assembly);

/// All ranks come here, those with trouble, too; throws ranks::Disagreement if one has some.
void agree_to_go_on();

/// On rank 0 of several: the formulation as the run sees it. Elsewhere, and on one rank, the formulation itself.
std::unique_ptr<Formulation> conducted(std::unique_ptr<Formulation> formulation);

/// On rank 0 of several: the others look at their shares of the probes (ProbeRow), too; then look(). Elsewhere look()
/// alone. `time` [s].
void with_probes_of_all(double time, std::function<void()> const& look);

/// On rank 0 of several: the others write their shares of a frame, too; then write(). Elsewhere write() alone.
void with_frame_of_all(std::function<void()> const& write);

/// On the other ranks: does what rank 0 does until that says the end; returns the exit code that it says.
int follow(Simulation& simulation);

/// On rank 0 of several that follow: what each of them said in a step since the first one. Elsewhere nothing.
std::vector<RankTraffic> traffic_on_ranks();

/// Before a rank leaves with an exit code and a message: tells the others; returns what the whole run ends with.
/// Nothing, if they cannot be told, because they wait for what this rank was to do: then only ranks::abort_all ends
/// them.
std::optional<ranks::Trouble> leave(ranks::Trouble const& own);

}  // namespace piola
