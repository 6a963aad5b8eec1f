// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>

namespace piola::app {

/// The number of the signal that asks the program to stop: SIGINT, SIGTERM, SIGHUP, or SIGUSR2, which asks a run to
/// write a checkpoint and stop; 0: none came.
extern std::atomic<int> stop_signal;
/// Not 0: SIGUSR1 asks a run to write a checkpoint and go on. Whoever writes it puts this back to 0.
extern std::atomic<int> checkpoint_signal;

/// From now on SIGINT, SIGTERM and SIGHUP ask to stop. A second one of them ends the program at once with the exit
/// status 128 + its number, even while a step hangs: from the keyboard always, from a program if it comes half a second
/// later or more, since tools that stop programs often signal twice. SIGHUP stays ignored where it is (nohup).
void catch_stop_signals();

/// Waits so many seconds; false as soon as a signal has asked to stop.
bool wait_unless_stopped(double seconds);

/// From now on signals that ask to stop do nothing: rank 0 of a run ends the others.
void ignore_stop_signals();

/// From now on SIGUSR1 and SIGUSR2 are noted; without this they end the program.
void catch_checkpoint_signals();

}  // namespace piola::app
