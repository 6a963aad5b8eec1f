// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>

namespace piola::app {

/// The number of the last stop signal: SIGINT, SIGTERM, SIGHUP, or SIGUSR2, which asks a run to write a checkpoint and
/// stop; 0: none.
extern std::atomic<int> stop_signal;
/// Nonzero after SIGUSR1, which requests a checkpoint without stopping. Reset to 0 by the code that writes it.
extern std::atomic<int> checkpoint_signal;

/// Installs handlers for SIGINT, SIGTERM and SIGHUP that request a stop. A second one ends the program at once with the
/// exit status 128 + its number, even while a step hangs: from the keyboard always, from a program if it comes half a
/// second later or more, since tools that stop programs often signal twice. SIGHUP stays ignored if it is (nohup).
void catch_stop_signals();

/// Waits for `seconds` [s]; returns false as soon as a stop signal has come.
bool wait_unless_stopped(double seconds);

/// Ignores further stop signals: rank 0 of a run stops the other ranks.
void ignore_stop_signals();

/// Installs handlers that say so if the program crashes in the code of a user's material law.
void tell_crashes_of_laws();

/// Installs handlers for SIGUSR1 and SIGUSR2, which otherwise end the program.
void catch_checkpoint_signals();

}  // namespace piola::app
